//! What follows from a scheme: its local matrix, Fourier blocks, eigenstructure, limit stencils and maps.
//!
//! A [`LocalSystem`] is the local subdivision matrix of a level, in Fourier blocks where its rules are
//! rotation-symmetric. It gives the [`Spectrum`], [`Mode`]s with their dual functionals, and limit stencils;
//! [`Maps`] are the characteristic and second-order maps on the regular [`Annulus`]. Matrices, blocks and
//! patches are generic over the scalar; decompositions are in `f64`.

mod annulus;
mod components;
mod echelon;
mod eigen;
mod error;
mod maps;
mod matrix;
mod natural;
mod rings;
mod spectrum;
mod system;

pub use annulus::{Annulus, PatchIndex};
pub use eigen::{BlockEigenvalue, EQUAL, Eigenspace, MERGED, NULL};
pub use error::Error;
pub use maps::{Graph, Maps};
pub use matrix::{Block, Matrix, fourier_block, fourier_blocks, local_matrix, numbering};
pub use natural::{Natural, NaturalMode};
pub use rings::{Sufficient, outer};
pub use spectrum::{Eigenvalue, Spectrum};
pub use system::{LocalSystem, Mode};
