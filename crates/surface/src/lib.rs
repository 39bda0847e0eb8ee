//! Polygon meshes and the subdivision surfaces that they control.
//!
//! A [`Mesh`] is read from a file ([`io`]) or one of the [`shapes`]; its [`Topology`] exists if it is an
//! oriented manifold with boundary, else [`Mesh::defects`] say what is wrong. A [`Refiner`] runs the passes
//! of any scheme on it, and a [`Surface`] has its exact limit points, derivatives and curvature.
//!
//! ```
//! use eigenring_scheme::{Definition, Spec};
//! use eigenring_surface::{Kind, Place, Refiner, Rules, Surface, shapes};
//!
//! let rules = Rules::new(Definition::Family("catmull-clark".parse::<Spec>()?));
//! let cube = shapes::cube();
//! let refined = Refiner::new(&rules).refined(&cube, 3)?;
//! assert_eq!((refined.points().len(), refined.face_count()), (386, 384));
//!
//! let surface = Surface::new(&cube, &rules)?;
//! // a distance of 1e-18 from a corner of the cube, in parameters of the face
//! let beside = surface.at(Place { face: 0, sub: 0, corner: 0, s: 1e-18, t: 1e-18 })?;
//! let corner = surface.at(Place { face: 0, sub: 0, corner: 0, s: 0.0, t: 0.0 })?;
//! assert!((beside.position - corner.position).norm() < 1e-12 && corner.kind == Kind::Flat);
//! assert!(beside.gauss.is_some_and(|gauss| gauss > 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Rules at boundaries and creases, for dual schemes and beside irregular vertices, and what to expect of
//! them: `docs/surfaces.md`. Nothing here has threads or paths: work that falls into parts is handed to
//! [`Workers`].

mod active;
mod block;
pub mod defects;
mod dual;
mod error;
mod facts;
pub mod features;
pub mod io;
pub mod limit;
pub mod lines;
mod mesh;
mod passes;
pub mod raster;
mod refine;
mod refiner;
mod rules;
pub mod shapes;
#[cfg(test)]
mod tests;
mod topology;
mod walk;
mod workers;

pub use block::layout::Layout;
pub use defects::{Defect, DefectKind, Element};
pub use dual::CellNet;
pub use error::Error;
pub use facts::{Facts, FeatureCounts, isolation};
pub use features::{Boundary, Features};
pub use limit::{Kind, Place, Sample, Surface};
pub use mesh::Mesh;
/// Points are nalgebra's.
pub use nalgebra::{Point3, Vector3};
pub use refine::quads;
pub use refiner::Refiner;
pub use rules::Rules;
pub use topology::{FanAt, NONE, Topology};
pub use workers::{Serial, Workers};
