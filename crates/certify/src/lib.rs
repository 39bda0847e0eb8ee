//! Certificates: interval proofs about the spectrum and the characteristic map of a subdivision scheme.
//!
//! [`certify`] takes an exact scheme ([`Input`]) at a valence and says of each of a list of statements
//! ([`Statement`]) whether it is proven, refuted, open, or only computed. [`recheck()`] proves a stored
//! [`Certificate`] again; [`range`] does both for a continuous range of lambda, [`parameter`] for one of a
//! parameter of a scheme file, [`valences`] for all valences at once.
//!
//! **Search and proof are apart.** [`find`] and [`map::find`] look for evidence in doubles: approximate
//! eigenvectors, subdivisions, places. The checks take scheme and evidence and use nothing but [`Interval`]s,
//! [`Centred`] forms and [`exact`] numbers. Wrong evidence leaves a statement undecided; it cannot make it
//! proven or refuted.
//!
//! ```
//! use eigenring_certify::{Input, Statement, Status, certify, recheck};
//!
//! let input = Input::from_spec(&"catmull-clark".parse()?, 5)?;
//! let certificate = certify(input, 5)?;
//! let status = |name| certificate.check(name).map(|check| check.status);
//! assert_eq!(status(Statement::Injective), Some(Status::Proven));
//! // an eigenvalue of block 2 is 1.12 lambda^2: curvature is unbounded
//! assert_eq!(status(Statement::BoundedCurvature), Some(Status::Refuted));
//! // the evidence alone gives the same
//! assert!(recheck(&certificate)?.confirmed());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod boundary;
mod certificate;
mod conditions;
mod document;
mod error;
pub mod exact;
pub mod find;
mod input;
mod interval;
mod levels;
pub mod linear;
pub mod map;
mod mean_value;
pub mod optimum;
pub mod parameter;
mod patches;
mod proof;
pub mod range;
mod recheck;
mod rows;
pub mod spectral;
mod status;
pub mod valences;

pub use certificate::{Balanced, CERTIFICATE_VERSION, Certificate, Evidence, certify, check};
pub use document::Document;
pub use error::Error;
pub use input::{Identities, Input, Subject};
pub use interval::Interval;
pub use mean_value::{Centred, Enclose};
pub use patches::Patches;
pub use recheck::{Difference, Recheck, recheck, recheck_text};
pub use status::{Check, Requirement, Statement, Status, Witness};
