//! How to find a scheme.

pub mod objective;
pub mod search;
pub mod spline;
