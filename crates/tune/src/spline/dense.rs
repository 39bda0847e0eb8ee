//! Orthonormal frames of a few dense vectors, by Householder's QR factorisation.
//!
//! The fits have 17 unknowns, so a frame that grows is factorised again. A projection is done twice: "twice
//! is enough" (Kahan and Parlett; Giraud, Langou and Rozloznik 2005) for what is left to be orthogonal to
//! rounding.

use nalgebra::{DMatrix, DVector};

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// `y += t x`.
pub(super) fn add_scaled(y: &mut [f64], t: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += t * x;
    }
}

/// Independent vectors `c_j = sum_{k <= j} r_kj q_k` with orthonormal `q_k` and `r_jj > 0`.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// The vectors and the `q_k`, a column each.
    columns: DMatrix<f64>,
    q: DMatrix<f64>,
    r: DMatrix<f64>,
}

fn matrix(length: usize, columns: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(length, columns.len(), |i, j| columns[j][i])
}

impl Frame {
    fn factorised(columns: DMatrix<f64>) -> Self {
        let qr = columns.clone().qr();
        Frame {
            q: qr.q(),
            r: qr.r(),
            columns,
        }
    }

    /// The frame of vectors of the given length, which must be independent.
    pub(super) fn new(length: usize, columns: &[Vec<f64>]) -> Self {
        Self::factorised(matrix(length, columns))
    }

    /// The frame of as many independent ones of the given vectors as there are, with their indices in the
    /// order of the frame. The next is that with the largest entry left; it ends when at most `tolerance`
    /// times the longest vector is left of it.
    pub(super) fn pivoted(length: usize, columns: &[Vec<f64>], tolerance: f64) -> (Self, Vec<usize>) {
        let whole = matrix(length, columns);
        let smallest = tolerance * whole.column_iter().map(|c| c.norm()).fold(0.0, f64::max);
        let factors = whole.clone().col_piv_qr();
        let mut order = DMatrix::from_fn(1, columns.len(), |_, j| j);
        factors.p().permute_columns(&mut order);
        let r = factors.r();
        let kept = (0..r.nrows()).take_while(|&k| r[(k, k)].abs() > smallest).count();
        let order: Vec<usize> = order.iter().copied().take(kept).collect();
        (Self::factorised(whole.select_columns(&order)), order)
    }

    /// How many vectors it has.
    pub(super) fn len(&self) -> usize {
        self.r.ncols()
    }

    /// Appends a vector; refuses (`false`) one of which at most `tolerance` is left.
    pub(super) fn push(&mut self, c: &[f64], tolerance: f64) -> bool {
        let last = self.len();
        let mut columns = self.columns.clone().insert_column(last, 0.0);
        columns.column_mut(last).copy_from_slice(c);
        if last == columns.nrows() {
            return false;
        }
        let longer = Self::factorised(columns);
        if longer.r[(last, last)] <= tolerance {
            return false;
        }
        *self = longer;
        true
    }

    /// An orthonormal basis of what is orthogonal to the frame.
    pub(super) fn complement(&self) -> Vec<Vec<f64>> {
        let n = self.columns.nrows();
        // a column of zeros is left as it is: the remaining columns of the product of reflections complete it
        let square = self.columns.clone().resize_horizontally(n, 0.0);
        let q = square.qr().q();
        (self.len()..n).map(|j| q.column(j).iter().copied().collect()).collect()
    }

    /// Components of `c` along the frame, and what is left of it.
    pub(super) fn project(&self, c: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut rest = DVector::from_column_slice(c);
        let mut components = DVector::zeros(self.len());
        for _ in 0..2 {
            let along = self.q.tr_mul(&rest);
            rest -= &self.q * &along;
            components += along;
        }
        (components.data.into(), rest.data.into())
    }

    /// The combination `x_j` of the vectors with components `y` along the frame: `sum_j x_j c_j = sum_k y_k
    /// q_k`.
    pub(super) fn solve(&self, y: &[f64]) -> Vec<f64> {
        let mut x = DVector::from_column_slice(y);
        assert!(self.r.solve_upper_triangular_mut(&mut x), "frames are independent");
        x.data.into()
    }

    /// The components `y` along the frame of the point `v = sum_k y_k q_k` with `c_j . v = b_j`.
    pub(super) fn solve_transposed(&self, b: &[f64]) -> Vec<f64> {
        let mut y = DVector::from_column_slice(b);
        assert!(self.r.tr_solve_upper_triangular_mut(&mut y), "frames are independent");
        y.data.into()
    }

    /// `sum_k y_k q_k`.
    pub(super) fn combine(&self, y: &[f64]) -> Vec<f64> {
        (&self.q * DVector::from_column_slice(y)).data.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hilbert(n: usize) -> Vec<Vec<f64>> {
        (0..n)
            .map(|j| (0..n).map(|i| 1.0 / (i + j + 1) as f64).collect())
            .collect()
    }

    #[test]
    fn frames_are_orthonormal_and_solve() {
        let columns = hilbert(6); // condition 1.5e7
        let mut frame = Frame::new(6, &columns[..2]);
        for c in &columns[2..] {
            assert!(frame.push(c, 1e-12));
        }
        let defect = frame.q.tr_mul(&frame.q) - DMatrix::identity(6, 6);
        assert!(defect.amax() < 2e-15, "{}", defect.amax());
        let x = [1.0, -2.0, 3.0, 0.5, -0.25, 4.0];
        let mut image = vec![0.0; 6];
        for (c, &x) in columns.iter().zip(&x) {
            add_scaled(&mut image, x, c);
        }
        let solved = frame.solve(&frame.project(&image).0);
        for (a, b) in solved.iter().zip(&x) {
            assert!((a - b).abs() < 1e-8);
        }
        // the matrix is symmetric: the transposed system has the same solution
        let v = frame.combine(&frame.solve_transposed(&image));
        for (a, b) in v.iter().zip(&x) {
            assert!((a - b).abs() < 1e-8);
        }
    }

    #[test]
    fn dependent_vectors_are_left_out() {
        let columns = [
            vec![1.0, 0.0, 0.0],
            vec![2.0, 0.0, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![3.0, 0.0, 4.0],
        ];
        let (mut frame, order) = Frame::pivoted(3, &columns, 1e-12);
        assert_eq!(order, [3, 1]);
        assert!(!frame.push(&columns[2], 1e-12));
        assert_eq!(frame.complement().len(), 1);
        assert!(frame.complement()[0][1].abs() > 1.0 - 1e-15);
        assert!(frame.push(&[0.0, 1e-6, 0.0], 1e-12));
        assert!(!frame.push(&[0.0, 1.0, 1.0], 0.0), "nothing is left of a fourth vector");
        assert!(frame.complement().is_empty());
    }

    #[test]
    fn a_frame_without_vectors() {
        let frame = Frame::new(3, &[]);
        let (components, rest) = frame.project(&[1.0, 2.0, 3.0]);
        assert!(components.is_empty() && rest == [1.0, 2.0, 3.0]);
        assert!(frame.solve(&[]).is_empty() && frame.combine(&[]) == [0.0; 3]);
        assert_eq!(frame.complement().len(), 3);
        let (frame, order) = Frame::pivoted(3, &[], 1e-12);
        assert!(frame.len() == 0 && order.is_empty());
    }
}
