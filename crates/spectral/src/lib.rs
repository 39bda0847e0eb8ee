//! What follows from a scheme.

mod components;
mod eigen;
mod error;
mod matrix;

pub use eigen::{BlockEigenvalue, EQUAL, Eigenspace, MERGED, NULL};
pub use error::Error;
pub use matrix::{Block, Matrix, fourier_block, fourier_blocks, local_matrix, numbering};
