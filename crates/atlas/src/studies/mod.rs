//! What is shown of the lambda-scheme beyond the papers' tables.

mod margin;
mod normalisation;
pub mod optimality;
mod splines;

use crate::error::Error;
use crate::progress::Progress;

/// Which results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Study {
    /// That no stencil is better than the tabulated ones.
    Optimality,
    /// What it costs to keep eigenvalues apart and curvatures of one sign.
    Margin,
    /// The best lambda without a scale of eigenvectors.
    Normalisation,
    /// Spline tables of the valences from 21 to 64.
    Large,
    /// Splines with as many coefficients that lose less.
    Sharp,
    /// What the embedded splines lose, and those with more coefficients.
    Fine,
}

/// The folder of their files.
pub const FOLDER: &str = "studies";

impl Study {
    /// Its files: name and content.
    ///
    /// # Errors
    /// Those of tuning and of proofs.
    pub fn files(self, progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
        match self {
            Study::Optimality => optimality::files(progress),
            Study::Margin => margin::files(progress),
            Study::Normalisation => normalisation::files(progress),
            Study::Large => splines::large(progress),
            Study::Sharp => splines::sharp(progress),
            Study::Fine => splines::fine(progress),
        }
    }
}
