//! Splines and quadrature, over any number type.
//!
//! This is the base of the workspace: it knows nothing of subdivision schemes, matrices or files.
//!
//! * **Numbers.** A [`Scalar`] is a field with square roots and cosines of rational turns, without an order,
//!   so that one formula runs on doubles, on [`Dual`]s for derivatives, and on any type that encloses or
//!   computes exactly; a [`Complex`] number has two of them. [`Same`] says what is known to be equal.
//! * **Functions of one variable** on any open knots: [`Knots`] are the space, a [`Spline`] has coefficients.
//! * **Uniform B-splines** on one knot interval and their Bernstein form: [`uniform`].
//! * **Curves and grids** of any order and tension, refined, evaluated exactly and made to reproduce conics:
//!   [`curve`].
//! * **Patches**: a [`TensorPatch`] of uniform B-splines with its [`Jet`]s, and a [`bernstein::Polynomial`],
//!   which is cut into quarters, multiplied and bounded.
//! * **Quadrature**: [`quadrature::gauss_legendre`].
//!
//! ```
//! use eigenring_spline::TensorPatch;
//! use eigenring_spline::quadrature::gauss_legendre;
//!
//! // the volume under a bicubic patch is the mean of its Bernstein coefficients
//! let patch = TensorPatch { degree: 3, control: (0..16).map(|i| f64::from(i % 5)).collect() };
//! let rule = gauss_legendre(2);
//! let volume: f64 = rule
//!     .iter()
//!     .flat_map(|u| rule.iter().map(move |v| (u, v)))
//!     .map(|(u, v)| u.weight * v.weight * patch.jet(u.at, v.at).value)
//!     .sum();
//! let polynomial = patch.bernstein();
//! let mean = polynomial.coefficients().iter().sum::<f64>() / 16.0;
//! assert!((volume - mean).abs() < 1e-14);
//! ```

pub mod bernstein;
mod complex;
pub mod curve;
mod dual;
mod error;
pub mod intervals;
mod knots;
mod patch;
pub mod quadrature;
mod scalar;
pub mod uniform;

pub use complex::Complex;
pub use dual::Dual;
pub use error::Error;
pub use knots::{Basis, Knots, Spline};
/// The rational numbers that [`Scalar::rational`] takes.
pub use num_rational::BigRational;
pub use patch::{Jet, TensorPatch};
pub use scalar::{Same, Scalar};
