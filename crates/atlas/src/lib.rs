//! Schemes by name, and everything that the `eigenring` command prints of them, as a library.
//!
//! This first line is replaced once the crate is complete.

pub mod cache;
pub mod certificates;
pub mod compare;
pub mod curve;
pub mod difference;
mod error;
pub mod figures;
pub mod files;
pub mod index;
pub mod matrix;
pub mod progress;
pub mod report;
pub mod results;
pub mod run;
pub mod schemes;
pub mod spectrum;
pub mod stencil;
pub mod table;
pub mod tension;
pub mod tune;

pub use error::{Accepted, Error, accepted_in};
