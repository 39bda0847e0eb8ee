//! What follows from a scheme: its local matrix, Fourier blocks, eigenstructure, limit stencils and maps.
//!
//! A [`LocalSystem`] is the local subdivision matrix of a level, in Fourier blocks where its rules are
//! rotation-symmetric. It gives the [`Spectrum`], [`Mode`]s with their dual functionals, and limit stencils;
//! [`Maps`] are the characteristic and second-order maps on the regular [`Annulus`]. Matrices, blocks and
//! patches are generic over the scalar; decompositions are in `f64`.
//!
//! From rules to numbers, for Catmull-Clark around a vertex of valence 5 (Ball and Storry 1988):
//!
//! ```
//! use eigenring_scheme::families::catmull_clark;
//! use eigenring_spectral::{Annulus, LocalSystem, Maps};
//!
//! let scheme = catmull_clark::<f64>(5)?;
//! let spectrum = LocalSystem::new(scheme.limit(), scheme.closed_rings()?)?.spectrum()?;
//! let lambda = spectrum.subdominant().expect("more than one point").modulus();
//! assert!((lambda - 0.549988354518297).abs() < 1e-14);
//! // the net of the characteristic map, on as many rings as a regular annulus takes
//! let maps = Maps::on(&scheme, Annulus::at_least(&scheme, 2)?)?;
//! assert!((maps.lambda - lambda).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod annulus;
mod components;
mod core;
mod echelon;
mod eigen;
mod error;
mod extended;
mod hessenberg;
mod jordan;
mod maps;
mod matrix;
mod natural;
mod repeated;
mod rings;
mod second_order;
mod spectrum;
mod stam;
mod system;

pub use annulus::{Annulus, PatchIndex};
pub use eigen::{BlockEigenvalue, EQUAL, Eigenspace, MERGED, NULL};
pub use error::Error;
pub use extended::Extended;
pub use jordan::Chain;
pub use maps::{Graph, Maps};
pub use matrix::{Block, Matrix, fourier_block, fourier_blocks, local_matrix, numbering};
pub use natural::{Natural, NaturalMode};
pub use rings::{Sufficient, outer};
pub use second_order::SecondOrder;
pub use spectrum::{Eigenvalue, Spectrum};
pub use stam::{Stam, stam_points};
pub use system::{LocalSystem, Mode};
