//! Least squares under equalities, as the distance from a point.
//!
//! `min 1/2 |M x - y|^2` subject to `E x = e`, with n unknowns. Let the columns of Z span the null space of E
//! and let x0 be the shortest solution of the equalities: `x = x0 + Z t` meets them to rounding whatever t
//! is. With `M Z = Q R`, `v = R t` and `d = Q^T (y - M x0)`, the objective is `1/2 |v - d|^2` and a constant:
//! the unconstrained optimum is `v = d`, and inequalities `a . x >= b` become `c . v >= b - a . x0` with `c =
//! R^-T Z^T a`. M enters through an orthogonal factorisation, never through `M^T M`, whose condition is the
//! square.

use super::dense::{Frame, add_scaled, dot};

/// A matrix row with consecutive entries `first ..`; all others are zero.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) first: usize,
    pub(super) values: Vec<f64>,
}

impl Row {
    pub(super) fn dot(&self, x: &[f64]) -> f64 {
        dot(&self.values, &x[self.first..])
    }

    /// `y += t row`.
    pub(super) fn add_to(&self, y: &mut [f64], t: f64) {
        add_scaled(&mut y[self.first..], t, &self.values);
    }

    pub(super) fn scaled(mut self, t: f64) -> Self {
        self.values.iter_mut().for_each(|v| *v *= t);
        self
    }

    pub(super) fn norm(&self) -> f64 {
        dot(&self.values, &self.values).sqrt()
    }

    fn dense(&self, n: usize) -> Vec<f64> {
        let mut row = vec![0.0; n];
        self.add_to(&mut row, 1.0);
        row
    }
}

/// The matrices M and E, factorised; right-hand sides come later.
pub(super) struct Factored<'a> {
    n: usize,
    rows: &'a [Row],
    equalities: &'a [Row],
    /// Frame of the independent equalities, and which ones these are.
    range: Frame,
    independent: Vec<usize>,
    /// Columns of Z, in the order of `frame`.
    null: Vec<Vec<f64>>,
    /// `M Z = Q R`.
    frame: Frame,
    /// Dimension of the null space of E.
    free: usize,
}

/// The right-hand sides: x0 and d of the module page.
pub(super) struct Reduced {
    pub(super) origin: Vec<f64>,
    pub(super) target: Vec<f64>,
}

/// Relative length below which an equality is taken to depend on the others. Their entries are basis values,
/// exact to a few units in the last place.
const DEPENDENT: f64 = 1e-11;

impl<'a> Factored<'a> {
    /// Factorises; directions which M shrinks by more than `rank_tolerance` count as undetermined.
    pub(super) fn new(n: usize, rows: &'a [Row], equalities: &'a [Row], rank_tolerance: f64) -> Self {
        let dense: Vec<Vec<f64>> = equalities.iter().map(|row| row.dense(n)).collect();
        let (range, independent) = Frame::pivoted(n, &dense, DEPENDENT);
        let null = range.complement();
        let free = null.len();
        let columns: Vec<Vec<f64>> = null
            .iter()
            .map(|z| rows.iter().map(|row| row.dot(z)).collect())
            .collect();
        let (frame, order) = Frame::pivoted(rows.len(), &columns, rank_tolerance);
        let null = order.iter().map(|&j| null[j].clone()).collect();
        Factored {
            n,
            rows,
            equalities,
            range,
            independent,
            null,
            frame,
            free,
        }
    }

    /// How many directions are determined, of how many.
    pub(super) fn rank(&self) -> (usize, usize) {
        (self.null.len(), self.free)
    }

    /// Takes the right-hand sides y and e; `Err` is the index of an equality that contradicts the others.
    pub(super) fn reduce(&self, y: &[f64], e: &[f64]) -> Result<Reduced, usize> {
        let values: Vec<f64> = self.independent.iter().map(|&i| e[i]).collect();
        let mut origin = self.range.combine(&self.range.solve_transposed(&values));
        let defects: Vec<f64> = self.defects(&origin, e).collect();
        self.restore(&mut origin, &self.range, &defects);
        for (i, (row, value)) in self.equalities.iter().zip(e).enumerate() {
            let size = 1.0 + value.abs() + row.norm();
            if (row.dot(&origin) - value).abs() > 1e-10 * size {
                return Err(i);
            }
        }
        let rest: Vec<f64> = self.rows.iter().zip(y).map(|(row, y)| y - row.dot(&origin)).collect();
        let target = self.frame.project(&rest).0;
        Ok(Reduced { origin, target })
    }

    /// x at v.
    pub(super) fn point(&self, origin: &[f64], v: &[f64]) -> Vec<f64> {
        let mut x = origin.to_vec();
        for (z, t) in self.null.iter().zip(self.frame.solve(v)) {
            add_scaled(&mut x, t, z);
        }
        x
    }

    /// `c = R^-T Z^T a`; exactly zero if the equalities leave `a . x` no freedom.
    pub(super) fn normal(&self, a: &Row) -> Vec<f64> {
        let along: Vec<f64> = self.null.iter().map(|z| a.dot(z)).collect();
        if dot(&along, &along).sqrt() <= DEPENDENT * a.norm() {
            return vec![0.0; along.len()];
        }
        self.frame.solve_transposed(&along)
    }

    /// Moves x by as little as possible onto the equalities and the given rows (`a . x = b`), which must be
    /// independent of them, and returns the frame of all of these rows with the indices of its equalities.
    pub(super) fn settle(&self, x: &mut [f64], e: &[f64], active: &[(&Row, f64)]) -> (Frame, &[usize]) {
        let mut frame = self.range.clone();
        for (row, _) in active {
            let pushed = frame.push(&row.dense(self.n), 0.0);
            debug_assert!(pushed, "an active row depends on the others");
        }
        let bounds = active.iter().map(|(row, b)| b - row.dot(x));
        let defects: Vec<f64> = self.defects(x, e).chain(bounds).collect();
        self.restore(x, &frame, &defects);
        (frame, &self.independent)
    }

    fn defects<'b>(&'b self, x: &'b [f64], e: &'b [f64]) -> impl Iterator<Item = f64> + 'b {
        self.independent.iter().map(|&k| e[k] - self.equalities[k].dot(x))
    }

    /// One step of refinement: adds the shortest vector whose products with the frame's vectors are the given
    /// defects.
    fn restore(&self, x: &mut [f64], frame: &Frame, defects: &[f64]) {
        let step = frame.combine(&frame.solve_transposed(defects));
        add_scaled(x, 1.0, &step);
    }
}
