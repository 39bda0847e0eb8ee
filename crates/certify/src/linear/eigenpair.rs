//! Simple eigenvalues with their vectors, and what remains when they are divided out.

use super::solve::{apply, approximate_inverse, defect, fixed_point};
use crate::Interval;
use eigenring_spectral::Matrix;

/// An eigenvalue and its vector, which is exactly 1 at the pivot. The pivot is where the approximation was
/// largest, so that no entry is much larger than 1; that none is larger is not claimed.
#[derive(Clone, Debug)]
pub struct Eigenpair {
    /// The eigenvalue.
    pub value: Interval,
    /// The vector.
    pub vector: Vec<Interval>,
    /// Where the vector is exactly 1.
    pub pivot: usize,
}

/// An enclosure of a real eigenpair near the given one, for every member of the matrix; `None` if none was
/// proven to exist, or the sizes do not fit.
///
/// With `x_p = 1` the unknowns are the other entries of x and the eigenvalue. About an approximation with the
/// residual F and the derivative `J = [(A - lambda)_{j != p}, -x]` the error e of both is a zero of
/// `F + J e - e_lambda e_x`, hence, with R an approximate inverse of J, a fixed point of
/// `-R F + (I - R J) e + R e_lambda e_x`. A box that is mapped into its interior holds one
/// (Brouwer; Rump 2001, *Computational error
/// bounds for multiple or nearly multiple eigenvalues*).
///
/// With J(e) the derivative at a point e of the box, `I - R J(e)` is moreover shown to have a norm below 1
/// there. Then
///
/// * R is regular, so that a fixed point is a zero;
/// * so is every mean of the J(e), by which the values at two points differ: the pair is the only one **with
///   both** value and vector in the box (another eigenvalue, with another vector, may lie in the interval of
///   the value);
/// * J is regular at the zero, where a second eigenvector or a Jordan chain `(A - lambda) y = x`, reduced by
///   a multiple of x to `y_p = 0`, would be a null vector of it: the eigenvalue is algebraically **simple**.
pub fn eigenpair(matrix: &Matrix<Interval>, value: f64, vector: &[f64]) -> Option<Eigenpair> {
    let size = matrix.rows();
    if matrix.columns() != size || vector.len() != size {
        return None;
    }
    let pivot = (0..size).max_by(|&a, &b| vector[a].abs().total_cmp(&vector[b].abs()))?;
    let scaled: Vec<f64> = vector.iter().map(|x| x / vector[pivot]).collect();
    if !value.is_finite() || scaled.iter().any(|x| !x.is_finite()) {
        return None;
    }
    // column `pivot` of J is that of the eigenvalue
    let derivative = Matrix::from_fn(size, size, |i, j| {
        if j == pivot {
            return Interval::point(-scaled[i]);
        }
        let shift = if i == j {
            Interval::point(value)
        } else {
            Interval::point(0.0)
        };
        matrix[(i, j)] - shift
    });
    let inverse = approximate_inverse(&derivative.map(Interval::mid))?;
    let residual: Vec<Interval> = (0..size)
        .map(|i| {
            let image: Interval = (0..size).map(|j| matrix[(i, j)] * Interval::point(scaled[j])).sum();
            Interval::point(value) * Interval::point(scaled[i]) - image
        })
        .collect();
    let start = apply(&inverse, &residual);
    let defect = defect(&inverse, &derivative);
    let error = fixed_point(&start, |error| {
        let products: Vec<Interval> = (0..size)
            .map(|j| {
                if j == pivot {
                    Interval::point(0.0)
                } else {
                    error[pivot] * error[j]
                }
            })
            .collect();
        let quadratic = apply(&inverse, &products);
        (0..size)
            .map(|i| start[i] + (0..size).map(|j| defect[(i, j)] * error[j]).sum() + quadratic[i])
            .collect()
    })?;
    let error_size: Vec<f64> = error.iter().map(|e| e.mag()).collect();
    let regular = (0..size).all(|i| {
        let unmoved: Interval = (0..size).map(|j| Interval::point(defect[(i, j)].mag())).sum();
        let moved: Interval = (0..size)
            .map(|j| {
                // column j of J moves by the error of the eigenvalue on its diagonal, the pivot's by that of
                // the vector
                let size = if j == pivot {
                    0.0
                } else {
                    error_size[j] + error_size[pivot]
                };
                Interval::point(inverse[(i, j)].abs()) * Interval::point(size.next_up())
            })
            .sum();
        (unmoved + moved).certainly_lt(Interval::point(1.0))
    });
    if !regular {
        return None;
    }
    let vector = (0..size).map(|i| match i {
        i if i == pivot => Interval::point(1.0),
        i => Interval::point(scaled[i]) + error[i],
    });
    Some(Eigenpair {
        value: Interval::point(value) + error[pivot],
        vector: vector.collect(),
        pivot,
    })
}

/// The matrix on the quotient by an eigenvector x with `x_p = 1`: `A'_ij = a_ij - x_i a_pj` for i, j other
/// than p. Its eigenvalues are those of A without one copy of the vector's own: in the basis of x and the
/// unit vectors other than the one of p, A is block triangular. That x is an eigenvector is taken for
/// granted.
pub fn quotient(matrix: &Matrix<Interval>, vector: &[Interval], pivot: usize) -> Matrix<Interval> {
    let rest: Vec<usize> = (0..matrix.rows()).filter(|&i| i != pivot).collect();
    Matrix::from_fn(rest.len(), rest.len(), |i, j| {
        matrix[(rest[i], rest[j])] - vector[rest[i]] * matrix[(pivot, rest[j])]
    })
}

/// The eigenvector of A that lies above an eigenvector y of the quotient by x. With y extended by 0 at p, `A
/// y = mu y + t x`, `t = sum_j a_pj y_j`, so that `y + t/(mu - lambda) x` is the vector. It is not zero, but
/// it is scaled as y is: an entry of y that is exactly 1 does not stay 1. `None` unless the two eigenvalues
/// are certainly different, or if the sizes do not fit.
pub fn lift(
    matrix: &Matrix<Interval>,
    below: &Eigenpair,
    value: Interval,
    vector: &[Interval],
) -> Option<Vec<Interval>> {
    let gap = value - below.value;
    if !gap.certainly_nonzero() {
        return None;
    }
    if vector.len() + 1 != matrix.columns() || below.vector.len() != matrix.columns() {
        return None;
    }
    let mut extended = vector.to_vec();
    extended.insert(below.pivot, Interval::point(0.0));
    let excess: Interval = matrix
        .row(below.pivot)
        .iter()
        .zip(&extended)
        .map(|(&a, &y)| a * y)
        .sum();
    let factor = excess / gap;
    Some(
        extended
            .iter()
            .zip(&below.vector)
            .map(|(&y, &x)| y + factor * x)
            .collect(),
    )
}
