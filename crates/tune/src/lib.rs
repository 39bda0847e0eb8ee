//! How to find a scheme.

pub mod objective;
pub mod quality;
pub mod search;
pub mod spline;
pub mod study;
pub mod global;
pub mod sweep;
