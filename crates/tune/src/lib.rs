//! How to find a scheme: the tuning of the lambda-scheme, and the measures by which schemes are compared.
//!
//! From the inside out: [`objective`] says how good the stencil (f2, f3) at one lambda is, [`search`] finds
//! its minima over the feasible domain, [`sweep`] does so at many lambdas and connects the minima to a
//! branch, [`global`] finds the best lambda, [`spline`] fits the spline stencils, and [`study`] is all of
//! this for one valence. [`quality`] measures any scheme. The output of tuning is an ordinary scheme: nothing
//! else needs to know how its stencils were found.

pub mod global;
pub mod objective;
pub mod quality;
pub mod search;
pub mod spline;
pub mod study;
pub mod sweep;
