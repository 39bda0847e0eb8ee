//! Small systems of numbers that depend on parameters.

use crate::Enclose;
use eigenring_spectral::Matrix;

/// Gaussian elimination, pivots by their size at the centre; `None` if a pivot may be zero. Meant for the few
/// unknowns of a ring of control points.
pub(crate) fn eliminate<S: Enclose>(matrix: Matrix<S>, right: Vec<S>) -> Option<Vec<S>> {
    let size = right.len();
    let mut rows: Vec<Vec<S>> = (0..size)
        .map(|i| matrix.row(i).iter().copied().chain([right[i]]).collect())
        .collect();
    for k in 0..size {
        let magnitude = |row: &Vec<S>| row[k].central().mid().abs();
        let pivot = (k..size).max_by(|&a, &b| magnitude(&rows[a]).total_cmp(&magnitude(&rows[b])))?;
        rows.swap(k, pivot);
        if rows[k][k].enclosure().contains_zero() {
            return None;
        }
        let (upper, lower) = rows.split_at_mut(k + 1);
        for row in lower {
            if row[k].enclosure().is_zero() {
                continue;
            }
            let factor = row[k] / upper[k][k];
            for (entry, &pivot) in row.iter_mut().zip(&upper[k]).skip(k) {
                *entry -= factor * pivot;
            }
        }
    }
    let mut solution = vec![S::zero(); size];
    for k in (0..size).rev() {
        let known = (k + 1..size).fold(rows[k][size], |sum, j| sum - rows[k][j] * solution[j]);
        solution[k] = known / rows[k][k];
    }
    Some(solution)
}
