//! How to find a scheme: the tuning of the lambda-scheme, and the measures by which schemes are compared.
//!
//! From the inside out: [`objective`] says how good the stencil (f2, f3) at one lambda is, [`search`] finds
//! its minima over the feasible domain, [`sweep`] does so at many lambdas and connects the minima to a
//! branch, [`global`] finds the best lambda, [`spline`] fits the spline stencils, and [`study`] is all of
//! this for one valence. [`quality`] measures any scheme, and [`minimise`] finds the best of a family of
//! which no more is known than its measures. The output of tuning is an ordinary scheme: nothing else needs
//! to know how its stencils were found.
//!
//! The stencils of one lambda, as a sweep finds them at each of its samples:
//!
//! ```
//! use eigenring_scheme::lambda::{Bounds, Domain, Plane};
//! use eigenring_tune::objective::{Objective, Settings};
//! use eigenring_tune::search::{Starts, search};
//!
//! let plane = Plane::new(5, 0.55, 1.0)?; // valence, lambda, s = mu / lambda^2
//! let objective = Objective::new(plane, Settings::default())?;
//! let domain = Domain::new(plane, Bounds::Paper, 0.0)?;
//! let optimum = search(&objective, &domain, Starts::Grid)?.lowest().clone();
//! let (value, gradient) = objective.value_and_gradient(optimum.f2, optimum.f3)?;
//! assert_eq!(value, optimum.total);
//! // a bound is active, or the objective is flat there
//! assert!(!optimum.active.is_empty() || gradient.iter().all(|slope| slope.abs() < 1e-3));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod global;
pub mod minimise;
pub mod objective;
pub mod quality;
pub mod search;
pub mod spline;
pub mod study;
pub mod sweep;
