//! An independent model of scheme files, and what it says of certificates.
//!
//! Nothing but [`claims`] knows the library: the model reads the file, folds points, composes passes, finds
//! eigenvalues and samples maps by itself. What it says has a margin: a statement
//! [holds](facts::Truth::Holds), [fails](facts::Truth::Fails), or is left [open](facts::Truth::Open) where
//! doubles and samples cannot tell.

pub mod claims;
pub mod experiment;
pub mod facts;
pub mod local;
pub mod model;
pub mod number;
pub mod regular;
pub mod spline;
