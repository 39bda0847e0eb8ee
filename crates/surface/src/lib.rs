//! Polygon meshes and the subdivision surfaces that they control.
//!
//! A [`Mesh`] is read from a file ([`io`]); its [`Topology`] exists if it is an
//! oriented manifold with boundary, else [`Mesh::defects`] say what is wrong. A [`Refiner`] runs
//! the passes of any scheme on it.

mod active;
mod block;
pub mod defects;
mod dual;
mod dual_block;
mod error;
mod facts;
pub mod features;
pub mod io;
pub mod limit;
mod mesh;
mod passes;
mod refine;
mod refiner;
mod rules;
pub mod shapes;
#[cfg(test)]
mod tests;
mod topology;
mod walk;
mod workers;

pub use defects::{Defect, DefectKind, Element};
pub use error::Error;
pub use facts::{Facts, FeatureCounts, isolation};
pub use dual::CellNet;
pub use features::{Boundary, Features};
pub use limit::{Kind, Place, Sample, Surface};
pub use mesh::Mesh;
pub use refiner::Refiner;
pub use rules::Rules;
pub use topology::{FanAt, NONE, Topology};
pub use workers::{Serial, Workers};
/// Points are nalgebra's.
pub use nalgebra::{Point3, Vector3};
