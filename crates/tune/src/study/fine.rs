//! Splines with more coefficients, where 17 of them lose too much.
//!
//! The paper has one single knot between two neighbouring triple ones. Between them the tuned stencils are
//! smooth but where the set of active bounds changes a third time or more often. There the splines of the
//! paper lose up to a tenth of the objective; so single knots are added, one after the other, in the
//! interval in which most is lost at the time, until less than [`ENOUGH`] is lost at every sample or an
//! interval has almost as many knots as samples. Interpolation at lambda_C* and the bounds are those of the
//! usual fit.

use super::{TINY, objective};
use crate::objective::Objective;
use crate::spline::{FitError, StencilFit};
use crate::sweep::{BranchSample, Options};
use eigenring_scheme::lambda::{LambdaEntry, LambdaKnots};

/// What splines may lose at a sample: `E/E_sample - 1`.
pub const ENOUGH: f64 = 0.01;

/// Single knots that are tried beyond those of the paper. Empirical: the tables need up to a third of it.
const MOST: usize = 48;

/// The samples with their objectives: none where E is next to nothing.
pub(super) struct Fine<'a> {
    samples: &'a [BranchSample],
    objectives: Vec<Option<Objective>>,
}

impl<'a> Fine<'a> {
    pub fn new(valence: usize, samples: &'a [BranchSample], options: &Options) -> Result<Self, super::Error> {
        let of = |sample: &BranchSample| {
            let counts = sample.minimum.total > TINY;
            counts.then(|| objective(valence, sample.lambda, options)).transpose()
        };
        Ok(Fine {
            samples,
            objectives: samples.iter().map(of).collect::<Result<_, _>>()?,
        })
    }

    /// The lambda of the sample at which an entry loses most, and what it loses: infinite without an E.
    fn worst(&self, entry: &LambdaEntry) -> (f64, f64) {
        let mut worst = (f64::NAN, 0.0);
        for (sample, objective) in self.samples.iter().zip(&self.objectives) {
            let Some(objective) = objective else { continue };
            let value = entry
                .weights(sample.lambda)
                .ok()
                .and_then(|(f2, f3)| objective.value(f2, f3).ok());
            let loss = value.map_or(f64::INFINITY, |value| value / sample.minimum.total - 1.0);
            if loss > worst.1 {
                worst = (sample.lambda, loss);
            }
        }
        worst
    }

    /// The knots with fewest single ones that lose less than [`ENOUGH`], else those that lose least. `fit`
    /// gives the splines of knots, `entry` the tabulated form of them.
    pub fn fit(
        &self,
        knots: LambdaKnots,
        usual: StencilFit,
        fit: impl Fn(&LambdaKnots) -> Result<StencilFit, FitError>,
        entry: impl Fn(LambdaKnots, &StencilFit) -> LambdaEntry,
    ) -> Result<(LambdaKnots, StencilFit), FitError> {
        let mut worst = self.worst(&entry(knots, &usual));
        let mut next = knots;
        let mut best = (knots, usual, worst.1);
        for _ in 0..MOST {
            let (lambda, loss) = worst;
            if loss <= ENOUGH {
                break;
            }
            let ends = knots.values();
            let interval = ends[1..4].partition_point(|&end| end < lambda);
            let inside = |sample: &&BranchSample| (ends[interval]..=ends[interval + 1]).contains(&sample.lambda);
            let room = self.samples.iter().filter(inside).count().saturating_sub(2);
            if next.singles[interval] >= room.min(LambdaKnots::MOST_SINGLES) {
                break;
            }
            next.singles[interval] += 1;
            let found = fit(&next)?;
            worst = self.worst(&entry(next, &found));
            if worst.1 < best.2 {
                best = (next, found, worst.1);
            }
        }
        Ok((best.0, best.1))
    }
}
