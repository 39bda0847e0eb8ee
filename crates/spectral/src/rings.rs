//! How many rings an analysis needs: the smallest closed set, or one more where that hides an eigenvalue that
//! matters.
//!
//! Refined points of a closed set of R rings read these rings only, so the matrix of more rings is block
//! triangular: its eigenvalues are those of R rings and those of the diagonal blocks of the rings outside.
//! The latter belong to regular points. A refined point of ring R + 1 reads ring R + 1 by the outermost tap
//! of the line rule only, times the rule along the ring; for a rule of outermost tap `e` these are the
//! eigenvalues `e`, `e/2`, `e/4`, .. of the univariate rule, in every Fourier block (`e = 2^-(k-1)` for
//! uniform B-splines of order k: 1/8 for bicubic ones). Rings further out add zeros.
//!
//! They govern the surface where they are not small: e = 1/4 for biquadratic schemes is as large as the
//! eigenvalues of the quadratic terms, two of which have no vector on the corners of a regular face alone;
//! and where e is an eigenvalue of the inner rings already, one ring more shows whether the common one is
//! defective. The rule: **one ring more is taken unless all eigenvalues outside are strictly below the
//! subsubdominant one**, and so on until none is left.

use crate::{Block, Error, LocalSystem, Matrix, fourier_blocks, local_matrix, numbering};
use eigenring_scheme::Level;

/// Eigenvalues are taken as equal within this, relatively, as in a [`Spectrum`](crate::Spectrum).
const EQUAL: f64 = 1e-9;

/// The local system on as many rings as it takes, and what lies outside of the smallest closed set.
#[derive(Clone, Debug)]
pub struct Sufficient {
    /// The system.
    pub system: LocalSystem,
    /// The largest modulus of the eigenvalues that the next ring outside of the smallest closed set adds.
    pub outer: f64,
}

impl Sufficient {
    /// The system of `level`, whose smallest closed set has `closed` rings.
    ///
    /// # Errors
    /// Those of [`LocalSystem::new`] and [`LocalSystem::eigenvalues`].
    pub fn new(level: &Level<f64>, closed: usize) -> Result<Self, Error> {
        let outer = outer(level, closed)?;
        let (mut rings, mut next) = (closed, outer);
        loop {
            let system = LocalSystem::new(level, rings)?;
            let known = system.eigenvalues()?.subsubdominant().map_or(0.0, |mu| mu.modulus());
            // rings without eigenvalues of their own add exact zeros
            if next == 0.0 || next < known * (1.0 - EQUAL) {
                return Ok(Sufficient { system, outer });
            }
            rings += 1;
            next = self::outer(level, rings)?;
        }
    }
}

/// The largest modulus of the eigenvalues that ring `rings + 1` adds to those of `rings` closed rings.
///
/// # Errors
/// Those of [`fourier_blocks`]; [`Error::Decomposition`] if an iteration fails.
pub fn outer(level: &Level<f64>, rings: usize) -> Result<f64, Error> {
    let inner = numbering(level, rings);
    let (blocks, inner) = if level.is_rotation_symmetric() {
        (fourier_blocks(level, rings + 1)?, inner.sector_points())
    } else {
        (vec![Block::Real(local_matrix(level, rings + 1)?)], inner.count())
    };
    let mut largest = 0.0_f64;
    for (index, block) in blocks.iter().enumerate() {
        // block 0 of a vertex net begins with the centre
        let centre = usize::from(level.is_rotation_symmetric() && index == 0) * (1 - level.lattice().parity() as usize);
        for eigenvalue in block.trailing(inner + centre).eigenvalues()? {
            largest = largest.max(eigenvalue.value.modulus());
        }
    }
    Ok(largest)
}

impl Block<f64> {
    /// The rows and columns from `first` on.
    fn trailing(&self, first: usize) -> Block<f64> {
        fn part<T: Copy>(matrix: &Matrix<T>, first: usize) -> Matrix<T> {
            let size = matrix.rows() - first;
            Matrix::from_fn(size, size, |i, j| matrix[(first + i, first + j)])
        }
        match self {
            Block::Real(matrix) => Block::Real(part(matrix, first)),
            Block::Complex(matrix) => Block::Complex(part(matrix, first)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};

    /// The outermost tap of order k at tension u is that of corner cutting, `1/(2(1+u))`, halved by each of
    /// k-3 averages.
    #[test]
    fn outer_rings_have_the_outermost_tap() {
        for valence in [3, 4, 5, 8] {
            for order in 3..=13 {
                for u0 in [-0.4, 0.01, 0.5, 1.0, 2.0, 50.0] {
                    let scheme = tension::<f64>(valence, order, u0).unwrap();
                    let closed = scheme.closed_rings().unwrap();
                    let expected = 0.5_f64.powi(order as i32 - 2) / (1.0 + u0);
                    let found = outer(scheme.level(0), closed).unwrap();
                    assert!(
                        (found - expected).abs() < 1e-9 * expected,
                        "{order} {u0}: {found} {expected}"
                    );
                    assert_eq!(outer(scheme.level(0), closed + 1).unwrap(), 0.0);
                }
            }
        }
    }

    #[test]
    fn at_tension_one_outer_rings_add_powers_of_one_half() {
        for (valence, order) in [(3, 4), (5, 5), (6, 6), (7, 3)] {
            let scheme = tension::<f64>(valence, order, 1.0).unwrap();
            let closed = scheme.closed_rings().unwrap();
            let list = |rings| {
                let system = LocalSystem::new(scheme.limit(), rings).unwrap();
                let eigenvalues = system.eigenvalues().unwrap().eigenvalues;
                eigenvalues
                    .into_iter()
                    .flat_map(|e| vec![e.modulus(); e.multiplicity])
                    .collect::<Vec<_>>()
            };
            let (inner, mut outside) = (list(closed), list(closed + 1));
            for value in inner {
                let near = |a: &f64, b: &f64| (a - value).abs().total_cmp(&(b - value).abs());
                let nearest = (0..outside.len())
                    .min_by(|&a, &b| near(&outside[a], &outside[b]))
                    .unwrap();
                assert!((outside.remove(nearest) - value).abs() < 1e-6);
            }
            for value in outside {
                let power = -value.log2().round();
                let least = order as f64 - 1.0;
                assert!(
                    value < 1e-4 || power >= least && (value - 0.5_f64.powf(power)).abs() < 1e-6,
                    "{value}"
                );
            }
        }
    }

    #[test]
    fn one_ring_more_where_it_matters() {
        let rings = |scheme: &eigenring_scheme::Scheme<f64>, level: usize| {
            let closed = scheme.closed_rings().unwrap();
            let found = Sufficient::new(scheme.level(level), closed).unwrap();
            found.system.numbering().rings - closed
        };
        for valence in 3..=20 {
            // 1/8 outside, 1/6 or more inside
            assert_eq!(rings(&catmull_clark(valence).unwrap(), 0), 0);
            // 1/4 outside and inside
            assert_eq!(rings(&doo_sabin(valence).unwrap(), 0), 1);
            let small = tension::<f64>(valence, 3, 0.01).unwrap();
            assert_eq!(rings(&small, 0), 1, "1/2.02 outside, less inside");
            assert_eq!(rings(&tension(valence, 6, 1.0).unwrap(), 0), 0);
        }
        assert_eq!(rings(&tension(3, 3, 1.0).unwrap(), 0), 1);
        // 1/4 outside is below the subsubdominant eigenvalue from N = 5 on
        assert_eq!(rings(&tension(5, 3, 1.0).unwrap(), 0), 0);
    }
}
