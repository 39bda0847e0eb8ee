//! Certificates: interval proofs about the spectrum and the characteristic map of a subdivision scheme.

pub mod exact;
mod interval;
pub mod linear;
mod mean_value;

pub use interval::Interval;
pub use mean_value::{Centred, Enclose};
