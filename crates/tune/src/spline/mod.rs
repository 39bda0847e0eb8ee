//! From tuned samples to spline stencils.
//!
//! Ma, Wang and Ma (2023, section 4.3) represent f2 and f3 as cubic splines of lambda, fitted to samples
//! tuned at 100 lambdas a valence: [`FitProblem`] fits one function under interpolation conditions and
//! bounds, [`choose_knots`] finds the kinks and chooses lambda_b and lambda_d among them, [`fit_stencils`]
//! does f3 first and then f2, whose bounds depend on f3.

mod active_set;
mod dense;
mod error;
mod fit;
mod interior;
mod kinks;
mod kkt;
mod reduce;
mod stencils;

pub use error::{FitError, Side};
pub use fit::{ActiveBound, Bound, Datum, Fit, FitProblem};
pub use kinks::{Candidate, KnotChoice, Slot, Source, choose_knots};
pub use kkt::Kkt;
pub use stencils::{Band, StencilBounds, StencilFit, StencilSample, fit_stencils};

#[cfg(test)]
mod stencil_tests;
#[cfg(test)]
mod tests;
