//! Certificates: interval proofs about the spectrum and the characteristic map of a subdivision scheme.

mod interval;
mod mean_value;

pub use interval::Interval;
pub use mean_value::{Centred, Enclose};
