//! Stencils tuned at many lambdas, and the branch through them.
//!
//! Ma, Wang and Ma (2023, section 4.1) tune at 100 values of lambda a valence, in two uniform parts that meet
//! at `lambda_l` ([`Range`]). Work comes in two phases.
//!
//! 1. [`sample`] finds all local minima at one lambda. It depends on nothing else, so samples can be computed
//!    in any order, in parallel, and stored.
//! 2. [`branch()`] connects them. The lowest minimum may jump from one lambda to the next (at N = 3 between
//!    two basins near 0.446 and 0.656), and no continuous spline can follow it; the branch starts at the
//!    global optimum over lambda ([`global`](crate::global)) and follows that local minimum continuously in
//!    both directions.

mod branch;
mod error;
#[cfg(test)]
mod tests;

pub(crate) use branch::check;
pub use branch::{BranchSample, Lowest, branch};
pub use error::Error;

use crate::objective::{Objective, Settings};
use crate::search::{self, Optimum, Search, Starts};
use eigenring_scheme::lambda::{Bounds, Domain, Plane, Relaxation};
use serde::{Deserialize, Serialize};

/// What can be chosen about tuning; the defaults are the paper's, with a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The bound on the last block's eigenvalues.
    pub bounds: Bounds,
    /// The relative margin kappa of the eigenvalue bounds. At many lambda the optimum lies on such a bound,
    /// where bounded curvature is not strict; the default 2e-6 keeps it strict and leaves half of the margin
    /// to the splines fitted later.
    pub margin: f64,
    /// The ratio `alpha / beta`.
    pub phi: f64,
    /// The objective's constants.
    pub settings: Settings,
    /// From where to descend.
    pub starts: Starts,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            bounds: Bounds::Paper,
            margin: 2e-6,
            phi: 6.0,
            settings: Settings::default(),
            starts: Starts::Grid,
        }
    }
}

/// What is minimised at one lambda, and where.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The admissible (f2, f3).
    pub domain: Domain,
    /// The function.
    pub objective: Objective,
}

impl Problem {
    /// The problem at a valence and lambda, with the s of [`Relaxation`].
    ///
    /// # Errors
    /// [`Error::Scheme`] and [`Error::Objective`].
    pub fn new(valence: usize, lambda: f64, options: &Options) -> Result<Self, Error> {
        Self::on_plane(Relaxation::new(valence)?.plane(lambda)?, options)
    }

    /// The problem on a plane, with the phi of the options.
    ///
    /// # Errors
    /// [`Error::Scheme`] and [`Error::Objective`].
    pub fn on_plane(plane: Plane<f64>, options: &Options) -> Result<Self, Error> {
        let plane = Plane {
            phi: options.phi,
            ..plane
        };
        Ok(Problem {
            domain: Domain::new(plane, options.bounds, options.margin)?,
            objective: Objective::new(plane, options.settings)?,
        })
    }

    /// Searches the domain.
    ///
    /// # Errors
    /// [`Error::Search`].
    pub fn search(&self, starts: Starts) -> Result<Search, Error> {
        Ok(search::search(&self.objective, &self.domain, starts)?)
    }

    /// Follows a nearby minimum; see [`search::continue_from`].
    ///
    /// # Errors
    /// [`Error::Search`].
    pub fn continue_from(&self, start: [f64; 2]) -> Result<(Optimum, usize), Error> {
        Ok(search::continue_from(&self.objective, &self.domain, start)?)
    }

    /// An optimum with everything that is reported about it.
    ///
    /// # Errors
    /// [`Error::Objective`].
    pub fn describe(&self, optimum: &Optimum) -> Result<Minimum, Error> {
        let &Optimum {
            f2,
            f3,
            total,
            kkt_residual,
            ..
        } = optimum;
        let parts = self.objective.parts(f2, f3)?;
        Ok(Minimum {
            f2,
            f3,
            total,
            parts: [parts.cup.value, parts.saddle_re.value, parts.saddle_im.value],
            active: optimum.active_names().into_iter().map(String::from).collect(),
            multipliers: optimum.active.iter().map(|bound| bound.multiplier).collect(),
            kkt_residual,
            theta: self.domain.theta(f2, f3),
        })
    }
}

/// A local minimum at one lambda.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Minimum {
    /// The face stencil's weight.
    pub f2: f64,
    /// The face stencil's weight.
    pub f3: f64,
    /// The objective.
    pub total: f64,
    /// Its parts: cup, real and imaginary saddle.
    pub parts: [f64; 3],
    /// Names of the bounds on which it lies.
    pub active: Vec<String>,
    /// Their multipliers, see [`search::ActiveBound`].
    pub multipliers: Vec<f64>,
    /// See [`Optimum::kkt_residual`].
    pub kkt_residual: f64,
    /// The angle at F in the natural configuration.
    pub theta: f64,
}

/// All minima that were found at one lambda.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LambdaSample {
    /// The valence.
    pub valence: usize,
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// `mu / lambda^2`.
    pub s: f64,
    /// By rising value, at least one.
    pub minima: Vec<Minimum>,
    /// Points of the starting grid.
    pub starts: usize,
    /// Descents made.
    pub descents: usize,
    /// Evaluations of the value alone.
    pub evaluations: usize,
    /// Evaluations of value and gradient.
    pub gradient_evaluations: usize,
}

/// The local minima at one lambda.
///
/// # Errors
/// Any [`Error`] about a single lambda.
pub fn sample(valence: usize, lambda: f64, options: &Options) -> Result<LambdaSample, Error> {
    let problem = Problem::new(valence, lambda, options)?;
    let search = problem.search(options.starts)?;
    let minima: Result<Vec<_>, _> = search.optima.iter().map(|optimum| problem.describe(optimum)).collect();
    Ok(LambdaSample {
        valence,
        lambda,
        s: problem.domain.plane().s,
        minima: minima?,
        starts: search.starts,
        descents: search.descents,
        evaluations: search.evaluations,
        gradient_evaluations: search.gradient_evaluations,
    })
}

/// Where to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// `lambda_a`.
    pub start: f64,
    /// `lambda_e`.
    pub end: f64,
    /// Equal steps from the start to `lambda_l`.
    pub below: usize,
    /// Equal steps from `lambda_l` to the end.
    pub above: usize,
}

impl Default for Range {
    /// The paper's 100 samples of [0.15, 0.9]; that there are 49 steps below and 50 above follows from its
    /// tabulated knots.
    fn default() -> Self {
        Range {
            start: 0.15,
            end: 0.9,
            below: 49,
            above: 50,
        }
    }
}

impl Range {
    /// The sample values, ascending: `start + i (lambda_l-start)/below` for i = 0..=below, then `lambda_l + i
    /// (end-lambda_l)/above` for i = 1..=above. If `lambda_l` is not inside, as for N > 23 with the default
    /// range, as many in equal steps.
    ///
    /// # Errors
    /// [`Error::Range`], and [`Error::Scheme`] for a valence below 3.
    pub fn lambdas(&self, valence: usize) -> Result<Vec<f64>, Error> {
        let &Range {
            start,
            end,
            below,
            above,
        } = self;
        if !(0.125 < start && start < end && end < 1.0 && below > 0 && above > 0) {
            return Err(Error::Range {
                start,
                end,
                below,
                above,
            });
        }
        let middle = Relaxation::new(valence)?.lambda_l();
        let part = |from: f64, to: f64, steps: usize| {
            (0..=steps).map(move |i| {
                if i == steps {
                    to
                } else {
                    from + i as f64 * (to - from) / steps as f64
                }
            })
        };
        Ok(if start < middle && middle < end {
            part(start, middle, below)
                .chain(part(middle, end, above).skip(1))
                .collect()
        } else {
            part(start, end, below + above).collect()
        })
    }
}

/// The paper's sample values of a valence: [`Range::lambdas`] of the default range.
///
/// # Errors
/// [`Error::Scheme`] for a valence below 3.
pub fn sample_lambdas(valence: usize) -> Result<Vec<f64>, Error> {
    Range::default().lambdas(valence)
}
