//! Linear systems.

use crate::Interval;
use eigenring_spectral::Matrix;

/// An enclosure of the solutions of `A x = b` for all members of an interval matrix and right side; `None` if
/// the matrix was not proven regular, or the sizes do not fit.
///
/// With an approximate inverse R and solution `x~` the error `e = x - x~` is the fixed point of `e = R (b - A
/// x~) + (I - R A) e`. If the right side maps a box into its interior, the matrix is regular and the error
/// lies in the box (Rump 1980, *Kleine Fehlerschranken bei Matrixproblemen*, theorem 1.3); the box is found
/// by iterating with a slight inflation.
pub fn solve(matrix: &Matrix<Interval>, right: &[Interval]) -> Option<Vec<Interval>> {
    let size = matrix.rows();
    if matrix.columns() != size || right.len() != size {
        return None;
    }
    let inverse = approximate_inverse(&matrix.map(Interval::mid))?;
    let middle: Vec<f64> = (0..size)
        .map(|i| (0..size).map(|j| inverse[(i, j)] * right[j].mid()).sum())
        .collect();
    if middle.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let residual: Vec<Interval> = (0..size)
        .map(|i| {
            let image: Interval = (0..size).map(|j| matrix[(i, j)] * Interval::point(middle[j])).sum();
            right[i] - image
        })
        .collect();
    let start = apply(&inverse, &residual);
    let defect = defect(&inverse, matrix);
    let error = fixed_point(&start, |error| {
        (0..size)
            .map(|i| start[i] + (0..size).map(|j| defect[(i, j)] * error[j]).sum())
            .collect()
    })?;
    Some(
        middle
            .iter()
            .zip(error)
            .map(|(&x, error)| Interval::point(x) + error)
            .collect(),
    )
}

/// `R v`.
pub(super) fn apply(inverse: &Matrix<f64>, vector: &[Interval]) -> Vec<Interval> {
    (0..inverse.rows())
        .map(|i| {
            let terms = inverse.row(i).iter().zip(vector);
            terms.map(|(&r, &v)| Interval::point(r) * v).sum()
        })
        .collect()
}

/// `I - R A`.
pub(super) fn defect(inverse: &Matrix<f64>, matrix: &Matrix<Interval>) -> Matrix<Interval> {
    let size = matrix.rows();
    Matrix::from_fn(size, size, |i, j| {
        let entry: Interval = (0..size)
            .map(|k| Interval::point(inverse[(i, k)]) * matrix[(k, j)])
            .sum();
        Interval::point(f64::from(i == j)) - entry
    })
}

/// A box that `map` takes into its interior, starting at `start`; `None` if none is found. Boxes are inflated
/// by a tenth and an absolute trifle (Rump's epsilon inflation), for at most ten steps, more than which has
/// never been of use.
pub(super) fn fixed_point(start: &[Interval], map: impl Fn(&[Interval]) -> Vec<Interval>) -> Option<Vec<Interval>> {
    const STEPS: usize = 10;
    const SHARPENED: usize = 2;
    let mut image = start.to_vec();
    for _ in 0..STEPS {
        let inflated: Vec<Interval> = image
            .iter()
            .map(|&x| x + Interval::around(0.0, 0.1 * x.width() + f64::MIN_POSITIVE))
            .collect();
        image = map(&inflated);
        if image.iter().any(|x| !x.is_bounded()) {
            return None;
        }
        if inflated
            .iter()
            .zip(&image)
            .all(|(outer, &inner)| outer.encloses_strictly(inner))
        {
            // the fixed point is in the image, hence in its image too: a rough start is made up for
            for _ in 0..SHARPENED {
                let sharper = map(&image);
                image = image
                    .iter()
                    .zip(sharper)
                    .map(|(&a, b)| a.intersect(b).unwrap_or(a))
                    .collect();
            }
            return Some(image);
        }
    }
    None
}

/// The inverse in doubles, by elimination with row pivots; `None` if a pivot vanishes.
pub(crate) fn approximate_inverse(matrix: &Matrix<f64>) -> Option<Matrix<f64>> {
    let size = matrix.rows();
    let mut left: Vec<Vec<f64>> = (0..size).map(|i| matrix.row(i).to_vec()).collect();
    let mut right: Vec<Vec<f64>> = (0..size)
        .map(|i| (0..size).map(|j| f64::from(i == j)).collect())
        .collect();
    for k in 0..size {
        let pivot = (k..size).max_by(|&a, &b| left[a][k].abs().total_cmp(&left[b][k].abs()))?;
        left.swap(k, pivot);
        right.swap(k, pivot);
        let scale = 1.0 / left[k][k];
        if !scale.is_finite() {
            return None;
        }
        for entry in left[k].iter_mut().chain(&mut right[k]) {
            *entry *= scale;
        }
        let (pivot_left, pivot_right) = (left[k].clone(), right[k].clone());
        for i in (0..size).filter(|&i| i != k) {
            let factor = left[i][k];
            if factor != 0.0 {
                for j in 0..size {
                    left[i][j] -= factor * pivot_left[j];
                    right[i][j] -= factor * pivot_right[j];
                }
            }
        }
    }
    Some(Matrix::from_rows(right, size))
}
