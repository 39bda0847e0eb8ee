//! Isogeometric analysis: the basis functions of a subdivision scheme as finite elements, in the plane and on
//! closed surfaces.
//!
//! A [`Study`] solves one problem on the levels of a mesh and measures the errors, or finds the lowest
//! eigenvalues of the Laplacian; [`predicted`] rates depend
//! on the subdominant eigenvalue alone.

mod around;
mod assembly;
mod boundary;
mod cells;
mod eigen;
mod error;
mod geometry;
mod hybrid;
mod integrals;
mod multigrid;
mod nested;
mod norms;
mod ordering;
mod part;
mod patch;
mod problem;
pub mod solution;
mod space;
mod sparse;
mod spectrum;
mod study;
mod tables;
mod tiles;

pub use error::Error;
pub use norms::Norms;
pub use problem::{Dirichlet, Options, Outcome, Problem, Solver};
pub use space::Ends;
pub use spectrum::{Membrane, Spectrum};
pub use study::{Domain, Study};
pub use tiles::Tile;

use eigenring_scheme::{Lattice, Scheme};

/// Whether a scheme around a vertex has tables here: bicubic with one-ring rules, the same at every level.
///
/// # Errors
/// Those of the reach of its stencils.
pub fn accepts(scheme: &Scheme<f64>) -> Result<bool, Error> {
    let one_ring = scheme.limit().special_rings()?.is_none_or(|rings| rings <= 1);
    let bicubic = scheme.lattice() == Lattice::Vertex && scheme.degree() == Some(3);
    Ok(bicubic && one_ring && scheme.leading().is_empty())
}

/// The most annuli of an extraordinary vertex: what they leave out is `lambda^400` of the area.
pub(crate) const MOST_ANNULI: usize = 200;

/// The largest valence: a face at an extraordinary vertex has `2N + 8` functions, so that N of them take the
/// cube of N.
pub(crate) const MOST_VALENCE: usize = 128;

/// Refuses a valence above [`MOST_VALENCE`].
pub(crate) fn check_valence(value: usize) -> Result<(), Error> {
    match value <= MOST_VALENCE {
        true => Ok(()),
        false => Err(Error::Range {
            name: "valence",
            value,
            accepted: "3 to 128",
        }),
    }
}

/// The rates in L2, H1, Linf and H2 that a subdominant eigenvalue predicts in the open space, with
/// `a = log2(1/lambda)`: `min(4, 3a)`, `min(3, 2a)`, `min(4, 2a)`, `min(2, a)`. A count of the errors in the
/// annuli, not a proof; 4, 3, 4, 2 without extraordinary vertices (lambda = 0).
pub fn predicted(lambda: f64) -> [f64; 4] {
    let a = -lambda.log2();
    [(3.0 * a).min(4.0), (2.0 * a).min(3.0), (2.0 * a).min(4.0), a.min(2.0)]
}

#[cfg(test)]
mod tests;
