//! A bound of the spectral radius that does not ask for eigenvectors.

use crate::Interval;
use eigenring_spectral::Matrix;

/// Whether all eigenvalues of all members of an interval matrix B are proven to have a modulus **strictly**
/// below `radius`, with the triangular or full matrix `factor` as evidence. A matrix with an eigenvalue of
/// modulus `radius` is never shown to have a smaller one, Jordan block or not: equality with a threshold is
/// excluded where `radius` is at most the threshold.
///
/// Let `P = L^T L` and `W = r^2 P - B^T P B`, which is symmetric. If W is positive definite, an eigenvector v
/// of B with eigenvalue z, real or complex, has `0 < v* W v = (r^2 - |z|^2) |L v|^2`, hence `|L v| > 0` and
/// `|z| < r` (the inequality of Stein 1952; whether L is regular does not matter). W is positive definite if,
/// for some numbers `d_i > 0`,
///
/// ```text
/// w_ii d_i > sum_{j != i} |w_ij| d_j      for every i:
/// ```
///
/// the symmetric matrix `d_i w_ij d_j` then has positive diagonal entries that exceed the rest of their row
/// (Gershgorin). Each side is enclosed with outward rounding, so that what overflows or underflows fails: the
/// left side is then bounded by zero from below, or the right side by infinity from above.
///
/// Any L may be tried: the one from the solution of `P - B^T P B / r^2 = I` gives a W near `r^2 I`, as far as
/// doubles can tell.
pub fn radius_below(matrix: &Matrix<Interval>, factor: &Matrix<f64>, radius: f64) -> bool {
    let size = matrix.rows();
    if [matrix.columns(), factor.rows(), factor.columns()] != [size; 3] {
        return false;
    }
    if !(radius > 0.0 && radius.is_finite()) {
        return false;
    }
    let factor = factor.map(Interval::point);
    // L B and r L; W = (r L)^T (r L) - (L B)^T (L B)
    let image = Matrix::from_fn(size, size, |i, j| -> Interval {
        (0..size)
            .filter(|&k| !factor[(i, k)].is_zero())
            .map(|k| factor[(i, k)] * matrix[(k, j)])
            .sum()
    });
    let scaled = factor.map(|entry| Interval::point(radius) * entry);
    let entry = |i: usize, j: usize| -> Interval {
        (0..size)
            .map(|k| scaled[(k, i)] * scaled[(k, j)] - image[(k, i)] * image[(k, j)])
            .sum()
    };
    let form = Matrix::from_fn(
        size,
        size,
        |i, j| if j < i { Interval::point(0.0) } else { entry(i, j) },
    );
    // any positive finite numbers will do; these make the diagonal of the scaled matrix about 1
    let scale: Vec<Interval> = (0..size)
        .map(|i| Interval::point(form[(i, i)].mid().max(f64::MIN_POSITIVE).sqrt().recip()))
        .collect();
    (0..size).all(|i| {
        let others: Interval = (0..size)
            .filter(|&j| j != i)
            .map(|j| Interval::point((form[(i.min(j), i.max(j))] * scale[j]).mag()))
            .sum();
        (form[(i, i)] * scale[i]).certainly_gt(others)
    })
}
