//! Null spaces, duals and echelon forms by elimination, in any numbers that are divided.

use crate::Matrix;
use crate::echelon::PIVOT;
use crate::hessenberg::Number;

/// The reduced echelon form of vectors, by their entries in order, the first `centre` last.
pub(super) fn echelon<T: Number>(mut vectors: Vec<Vec<T>>, centre: usize) -> Vec<Vec<T>> {
    let (mut done, size) = (0, vectors[0].len());
    let length = |v: &[T]| v.iter().map(|x| x.size() * x.size()).sum::<f64>().sqrt();
    for position in (0..size).map(|i| (i + centre) % size) {
        if done == vectors.len() {
            break;
        }
        let relative = |v: &Vec<T>| v[position].size() / length(v);
        let best = (done..vectors.len()).max_by(|&a, &b| relative(&vectors[a]).total_cmp(&relative(&vectors[b])));
        let Some(best) = best.filter(|&best| relative(&vectors[best]) > PIVOT) else {
            continue;
        };
        vectors.swap(done, best);
        let by = T::real(1.0) / vectors[done][position];
        vectors[done].iter_mut().for_each(|x| *x = *x * by);
        let pivot = vectors[done].clone();
        for (_, vector) in vectors.iter_mut().enumerate().filter(|(other, _)| *other != done) {
            let factor = vector[position];
            vector.iter_mut().zip(&pivot).for_each(|(x, &p)| *x = *x - factor * p);
        }
        done += 1;
    }
    vectors
}

/// The combinations of left vectors that are dual to the right ones; `None` if there are none.
pub(super) fn dual<T: Number>(left: &[Vec<T>], right: &[Vec<T>]) -> Option<Vec<Vec<T>>> {
    let count = right.len();
    let mut left = left.to_vec();
    let mut gram: Vec<Vec<T>> = left.iter().map(|l| right.iter().map(|r| dot(l, r)).collect()).collect();
    for column in 0..count {
        let best = (column..count).max_by(|&a, &b| gram[a][column].size().total_cmp(&gram[b][column].size()))?;
        if !(gram[best][column].size() > 0.0) {
            return None;
        }
        gram.swap(column, best);
        left.swap(column, best);
        let by = T::real(1.0) / gram[column][column];
        gram[column].iter_mut().for_each(|x| *x = *x * by);
        left[column].iter_mut().for_each(|x| *x = *x * by);
        let (pivot, vector) = (gram[column].clone(), left[column].clone());
        for other in (0..count).filter(|&other| other != column) {
            let factor = gram[other][column];
            gram[other]
                .iter_mut()
                .zip(&pivot)
                .for_each(|(x, &p)| *x = *x - factor * p);
            left[other]
                .iter_mut()
                .zip(&vector)
                .for_each(|(x, &v)| *x = *x - factor * v);
        }
    }
    Some(left)
}

/// A basis of the null space, which has the given dimension.
pub(super) fn kernel<T: Number>(matrix: &Matrix<T>, dimension: usize) -> Vec<Vec<T>> {
    let n = matrix.rows();
    let (_, steps) = eliminated(matrix, n - dimension);
    let mut free = vec![true; n];
    steps.iter().for_each(|step| free[step.0] = false);
    let vector = |open: usize| {
        let mut v = vec![T::real(0.0); n];
        v[open] = T::real(1.0);
        for (column, row) in steps.iter().rev() {
            let others = (0..n).filter(|j| j != column);
            let sum = others.fold(
                T::real(0.0),
                |sum, j| if v[j].size() == 0.0 { sum } else { sum + row[j] * v[j] },
            );
            v[*column] = T::real(0.0) - sum / row[*column];
        }
        v
    };
    (0..n).filter(|&j| free[j]).map(vector).collect()
}

/// So many steps of elimination with full pivoting: the pivots, and the column and row of each, whose entries
/// in the columns of earlier steps are zero.
pub(super) fn eliminated<T: Number>(matrix: &Matrix<T>, steps: usize) -> (Vec<T>, Vec<(usize, Vec<T>)>) {
    let n = matrix.rows();
    let mut rows: Vec<Vec<T>> = (0..n).map(|i| matrix.row(i).to_vec()).collect();
    let (mut pivots, mut done) = (Vec::new(), Vec::new());
    for _ in 0..steps {
        let mut best = (0.0, 0, 0);
        for (i, row) in rows.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                let size = x.size();
                if size > best.0 {
                    best = (size, i, j);
                }
            }
        }
        let (size, row, column) = best;
        if size == 0.0 {
            break;
        }
        let above = rows.swap_remove(row);
        for below in &mut rows {
            if below[column].size() != 0.0 {
                let factor = below[column] / above[column];
                for (x, &a) in below.iter_mut().zip(&above) {
                    if a.size() != 0.0 {
                        *x = *x - factor * a;
                    }
                }
                below[column] = T::real(0.0);
            }
        }
        pivots.push(above[column]);
        done.push((column, above));
    }
    (pivots, done)
}

pub(super) fn minus<T: Number>(matrix: &Matrix<T>, value: T) -> Matrix<T> {
    let n = matrix.rows();
    Matrix::from_fn(
        n,
        n,
        |i, j| if i == j { matrix[(i, j)] - value } else { matrix[(i, j)] },
    )
}

pub(super) fn transposed<T: Number>(matrix: &Matrix<T>) -> Matrix<T> {
    Matrix::from_fn(matrix.columns(), matrix.rows(), |i, j| matrix[(j, i)])
}

pub(super) fn dot<T: Number>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::real(0.0), |sum, (&x, &y)| sum + x * y)
}

pub(super) fn times<T: Number>(matrix: &Matrix<T>, vector: &[T]) -> Vec<T> {
    (0..matrix.rows()).map(|i| dot(matrix.row(i), vector)).collect()
}

pub(super) fn product<T: Number>(a: &Matrix<T>, b: &Matrix<T>) -> Matrix<T> {
    let b = transposed(b);
    Matrix::from_fn(a.rows(), b.rows(), |i, j| dot(a.row(i), b.row(j)))
}
