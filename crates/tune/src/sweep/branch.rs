//! The branch of local minima through the global optimum.
//!
//! From one lambda to the next the branch is followed by predictor and corrector: (f2, f3) is extrapolated
//! linearly, and a descent starts there. A local minimum moves continuously with lambda, at kinks with a jump
//! in velocity, so a correction that is long for its step of lambda is suspected of having changed basins,
//! and the step is halved until corrections are short. Where a basin ends (it merges with a saddle point) no
//! step is small enough: the sample is marked, and the branch goes on from where the descent led.

use super::{Error, LambdaSample, Minimum, Options, Problem};
use crate::search;
use serde::{Deserialize, Serialize};

/// The minimum of the branch at one lambda, with the lowest one beside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchSample {
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// `mu / lambda^2`.
    pub s: f64,
    /// The minimum.
    pub minimum: Minimum,
    /// The lowest minimum at this lambda, if that is another one.
    pub lowest: Option<Lowest>,
    /// Whether the branch jumped on its way here from the side of the global optimum.
    pub jumped: bool,
    /// Distinct local minima that the search found.
    pub minima: usize,
    /// Points of the starting grid.
    pub starts: usize,
    /// Evaluations of the value alone.
    pub evaluations: usize,
    /// Evaluations of value and gradient, those for the branch included.
    pub gradient_evaluations: usize,
}

/// A minimum that is not on the branch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lowest {
    /// The face stencil's weight.
    pub f2: f64,
    /// The face stencil's weight.
    pub f3: f64,
    /// The objective.
    pub total: f64,
}

/// A point of the branch.
#[derive(Clone, Copy)]
struct BranchPoint {
    lambda: f64,
    at: [f64; 2],
    /// The derivative of `at` by lambda, as far as known.
    velocity: [f64; 2],
}

impl BranchPoint {
    /// The extrapolation to another lambda.
    fn predict(&self, lambda: f64) -> [f64; 2] {
        let step = lambda - self.lambda;
        [0, 1].map(|i| self.at[i] + step * self.velocity[i])
    }

    /// The next point, with the velocity that led to it.
    fn next(&self, lambda: f64, at: [f64; 2]) -> BranchPoint {
        let velocity = [0, 1].map(|i| (at[i] - self.at[i]) / (lambda - self.lambda));
        let plausible = velocity.iter().all(|v| v.abs() <= VELOCITY);
        BranchPoint {
            lambda,
            at,
            velocity: if plausible { velocity } else { [0.0; 2] },
        }
    }
}

/// A correction of (f2, f3) by more than `SPEED` times the step of lambda plus `SLACK` is suspicious.
/// Velocities change by less than 1 over a step, except at kinks, where steps are halved a few times in vain.
/// At N = 3 basins are 0.03 and more apart.
const SPEED: f64 = 1.0;

/// See [`SPEED`].
const SLACK: f64 = 1e-3;

/// Velocities above this, the effect of jumps, predict nothing. Up to 7 are usual, N = 4 near lambda = 0.15
/// reaches 100.
const VELOCITY: f64 = 10.0;

/// How often a step of lambda is halved before a jump is accepted: to steps of 1e-5.
const HALVINGS: usize = 10;

/// Values that differ relatively by less than this are the same minimum's; rounding of E reaches 1e-10 near
/// mu = 1/8.
const SAME: f64 = 1e-8;

/// By how much a descent that stops short in a narrow valley may miss its minimum, relatively. Observed:
/// 2e-6.
const SHORT: f64 = 1e-5;

/// Connects samples, ascending in lambda, to the branch through the minimum (f2, f3) at `lambda` (which need
/// not be a sample).
///
/// # Errors
/// [`Error::Samples`] for samples that do not belong together, and any [`Error`] about a single lambda.
pub fn branch(
    samples: &[LambdaSample],
    lambda: f64,
    f2: f64,
    f3: f64,
    options: &Options,
) -> Result<Vec<BranchSample>, Error> {
    check(samples)?;
    let origin = BranchPoint {
        lambda,
        at: [f2, f3],
        velocity: [0.0; 2],
    };
    let split = samples.partition_point(|sample| sample.lambda < lambda);
    let (below, above) = samples.split_at(split);
    let mut branch = follow(below.iter().rev(), origin, options)?;
    branch.reverse();
    branch.extend(follow(above.iter(), origin, options)?);
    Ok(branch)
}

/// One valence, ascending lambda, no sample without minima.
pub(crate) fn check(samples: &[LambdaSample]) -> Result<(), Error> {
    for (index, sample) in samples.iter().enumerate() {
        let ordered = index == 0 || {
            let before = &samples[index - 1];
            before.lambda < sample.lambda && before.valence == sample.valence
        };
        if !(ordered && sample.lambda.is_finite() && !sample.minima.is_empty()) {
            return Err(Error::Samples {
                index,
                lambda: sample.lambda,
                valence: sample.valence,
            });
        }
    }
    Ok(())
}

fn follow<'a>(
    samples: impl Iterator<Item = &'a LambdaSample>,
    origin: BranchPoint,
    options: &Options,
) -> Result<Vec<BranchSample>, Error> {
    let mut point = origin;
    let mut followed = Vec::new();
    for sample in samples {
        let (next, reached) = connect(sample, point, options)?;
        point = reached;
        followed.push(next);
    }
    Ok(followed)
}

/// The branch at one sample, coming from a neighbouring point.
fn connect(sample: &LambdaSample, from: BranchPoint, options: &Options) -> Result<(BranchSample, BranchPoint), Error> {
    let mut walk = Walk {
        valence: sample.valence,
        options,
        evaluations: 0,
        jumped: false,
    };
    let reached = walk.step(from, sample.lambda, HALVINGS)?;
    let (problem, optimum) = (reached.problem, reached.optimum);
    let at = [optimum.f2, optimum.f3];
    // a minimum that the search has found too is taken as it was found; in the narrow valleys of N = 3 near
    // mu = 1/8 one of the two descents may have stopped short, and the better one counts
    let known = |minimum: &&Minimum| {
        let other = [minimum.f2, minimum.f3];
        let near = (other[0] - at[0]).abs().max((other[1] - at[1]).abs()) <= SLACK;
        let lower = (optimum.total * (1.0 - SHORT)..optimum.total).contains(&minimum.total);
        search::same_minimum(&problem.domain, at, other) || near && lower
    };
    let minimum = match sample.minima.iter().find(known) {
        Some(minimum) => minimum.clone(),
        None => problem.describe(&optimum)?,
    };
    let lowest = sample
        .minima
        .first()
        .filter(|lowest| lowest.total < minimum.total * (1.0 - SAME));
    let connected = BranchSample {
        lambda: sample.lambda,
        s: sample.s,
        lowest: lowest.map(|lowest| Lowest {
            f2: lowest.f2,
            f3: lowest.f3,
            total: lowest.total,
        }),
        minimum,
        jumped: walk.jumped,
        minima: sample.minima.len(),
        starts: sample.starts,
        evaluations: sample.evaluations,
        gradient_evaluations: sample.gradient_evaluations + walk.evaluations,
    };
    Ok((connected, reached.point))
}

struct Walk<'a> {
    valence: usize,
    options: &'a Options,
    evaluations: usize,
    jumped: bool,
}

/// Where a step has led.
struct Reached {
    point: BranchPoint,
    problem: Problem,
    optimum: search::Optimum,
}

impl Walk<'_> {
    /// Follows the minimum from a point to another lambda, in halves if it is corrected too far.
    fn step(&mut self, from: BranchPoint, lambda: f64, halvings: usize) -> Result<Reached, Error> {
        let problem = Problem::new(self.valence, lambda, self.options)?;
        let predicted = from.predict(lambda);
        let (optimum, evaluations) = problem.continue_from(predicted)?;
        self.evaluations += evaluations;
        let at = [optimum.f2, optimum.f3];
        let correction = (at[0] - predicted[0]).abs().max((at[1] - predicted[1]).abs());
        let short = correction <= SPEED * (lambda - from.lambda).abs() + SLACK;
        if short || halvings == 0 {
            self.jumped |= !short;
            let point = if lambda == from.lambda {
                BranchPoint { at, ..from }
            } else {
                from.next(lambda, at)
            };
            return Ok(Reached {
                point,
                problem,
                optimum,
            });
        }
        let halfway = self.step(from, 0.5 * (from.lambda + lambda), halvings - 1)?;
        self.step(halfway.point, lambda, halvings - 1)
    }
}
