//! Orthonormal frames of a few dense vectors.
//!
//! The fits have 17 unknowns, so vectors in a list are matrix enough. Gram-Schmidt is run twice on every
//! vector: "twice is enough" (Kahan and Parlett; Giraud, Langou and Rozloznik 2005) for orthogonality to
//! rounding, unless the vector depends on the others, which is noticed and reported instead.

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// `y += t x`.
pub(super) fn add_scaled(y: &mut [f64], t: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += t * x;
    }
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Vectors `c_j = sum_{k <= j} r[j][k] q_k` with orthonormal `q_k`: a QR factorisation that grows column by
/// column.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    pub(super) q: Vec<Vec<f64>>,
    r: Vec<Vec<f64>>,
}

impl Frame {
    /// Components of `c` along the frame, and what is left of it.
    pub(super) fn project(&self, c: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut rest = c.to_vec();
        let mut components = vec![0.0; self.q.len()];
        for _ in 0..2 {
            for (q, component) in self.q.iter().zip(&mut components) {
                let t = dot(q, &rest);
                *component += t;
                add_scaled(&mut rest, -t, q);
            }
        }
        (components, rest)
    }

    /// Appends a vector; refuses (`false`) one of which at most `tolerance` is left.
    pub(super) fn push(&mut self, c: &[f64], tolerance: f64) -> bool {
        let (mut components, mut rest) = self.project(c);
        let length = norm(&rest);
        if length <= tolerance {
            return false;
        }
        rest.iter_mut().for_each(|x| *x /= length);
        components.push(length);
        self.q.push(rest);
        self.r.push(components);
        true
    }

    /// Appends the given vectors, the one that adds most first, until nothing longer than `tolerance` times
    /// the longest is left. Returns their indices in the order of the frame.
    pub(super) fn push_pivoted(&mut self, columns: &[Vec<f64>], tolerance: f64) -> Vec<usize> {
        let mut rest: Vec<Vec<f64>> = columns.iter().map(|c| self.project(c).1).collect();
        let smallest = tolerance * columns.iter().map(|c| norm(c)).fold(0.0, f64::max);
        let mut order = Vec::new();
        let mut left: Vec<usize> = (0..columns.len()).collect();
        while !left.is_empty() {
            // the first of equals, so that the order is determined
            let mut best = 0;
            for (k, &j) in left.iter().enumerate() {
                if dot(&rest[j], &rest[j]) > dot(&rest[left[best]], &rest[left[best]]) {
                    best = k;
                }
            }
            let j = left.remove(best);
            if norm(&rest[j]) <= smallest || !self.push(&columns[j], smallest) {
                break;
            }
            order.push(j);
            let q = &self.q[self.q.len() - 1];
            for &k in &left {
                let t = dot(q, &rest[k]);
                add_scaled(&mut rest[k], -t, q);
            }
        }
        order
    }

    /// The combination `x_j` of the vectors with components `y` along the frame: `sum_j x_j c_j = sum_k y_k
    /// q_k`.
    pub(super) fn solve(&self, y: &[f64]) -> Vec<f64> {
        let mut x = y.to_vec();
        for j in (0..self.r.len()).rev() {
            x[j] /= self.r[j][j];
            let t = x[j];
            let (above, _) = x.split_at_mut(j);
            add_scaled(above, -t, &self.r[j]);
        }
        x
    }

    /// The components `y` along the frame of the point `v = sum_k y_k q_k` with `c_j . v = b_j`.
    pub(super) fn solve_transposed(&self, b: &[f64]) -> Vec<f64> {
        let mut y: Vec<f64> = Vec::with_capacity(b.len());
        for (row, b) in self.r.iter().zip(b) {
            let known = dot(row, &y);
            y.push((b - known) / row[y.len()]);
        }
        y
    }

    /// `sum_k y_k q_k` for a frame of vectors of the given length.
    pub(super) fn combine(&self, length: usize, y: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; length];
        for (q, &y) in self.q.iter().zip(y) {
            add_scaled(&mut sum, y, q);
        }
        sum
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
        let mut frame = Frame::default();
        for c in &columns {
            assert!(frame.push(c, 1e-12));
        }
        for (i, p) in frame.q.iter().enumerate() {
            for (j, q) in frame.q.iter().enumerate() {
                assert!((dot(p, q) - f64::from(i == j)).abs() < 1e-15);
            }
        }
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
        let v = frame.combine(6, &frame.solve_transposed(&image));
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
        let mut frame = Frame::default();
        assert_eq!(frame.push_pivoted(&columns, 1e-12), [3, 1]);
        assert!(!frame.push(&columns[2], 1e-12));
        assert!(frame.push(&[0.0, 1e-6, 0.0], 1e-12));
    }
}
