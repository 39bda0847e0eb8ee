//! Certificates: interval proofs about the spectrum and the characteristic map of a subdivision scheme.

mod certificate;
mod conditions;
mod error;
pub mod exact;
pub mod find;
mod input;
mod interval;
pub mod linear;
pub mod map;
mod mean_value;
pub mod range;
mod rows;
pub mod spectral;
mod status;

pub use certificate::{CERTIFICATE_VERSION, Certificate, Difference, Evidence, Recheck, certify, check, recheck};
pub use error::Error;
pub use input::{Identities, Input, Subject};
pub use interval::Interval;
pub use mean_value::{Centred, Enclose};
pub use status::{Check, NAMES, Requirement, Status, Witness};
