//! Subdivision surfaces with knot intervals.

mod blending;
mod characteristic;
pub mod eigen_polyhedron;
mod error;
pub mod first_level;
mod hybrid;
mod intervals;
pub mod lemmas;
mod limits;
mod net;
pub mod ngon;
pub mod nurss;
mod primal;
mod refine;
mod row;
mod spokes;
mod star;
mod surface;

pub use blending::{Blending, Peak};
pub use characteristic::CharacteristicMap;
pub use eigen_polyhedron::{EigenPolyhedron, safe_ratio};
pub use error::{Error, MAX_SPOKES, Marked, Place};
pub use first_level::FirstLevel;
pub use hybrid::{Blocks, Converted, HybridNet, Outside};
pub use intervals::KnotIntervals;
pub use limits::{Limits, VertexLimit};
pub use net::Net;
pub use ngon::NGon;
pub use primal::{Step, eigen_polyhedron_step, nurss_step};
pub use refine::{NAMES, Refined, Refinement, Scheme, refined};
pub use spokes::Spokes;
pub use star::Star;
pub use surface::elements::{Element, Piece, grid};
pub use surface::vertices::VertexElements;
pub use surface::{Sample, Surface};
