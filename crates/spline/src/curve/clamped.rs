//! Ends where a polynomial curve meets its control polygon: k-fold knots.
//!
//! Knots of order k over m intervals are `t_j = clamp(j - (k-1), 0, m)`, j = 0 .. m+2k-2. One recursion
//! serves both questions: with the same x at every step it is de Boor's for the k functions that do not
//! vanish on an interval, with other arguments `x_1, .., x_{k-1}` it gives the weights of the polar form
//! there (Ramshaw 1989). A refined control point is the polar form at k-1 consecutive knots of the finer
//! sequence, which is the Oslo algorithm (Cohen, Lyche, Riesenfeld 1980).

/// A clamped sequence of knots: the integers from 0 to m, the ends k-fold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clamped {
    order: usize,
    intervals: usize,
}

impl Clamped {
    pub fn new(order: usize, intervals: usize) -> Self {
        Clamped { order, intervals }
    }

    fn knot(&self, j: usize) -> f64 {
        (j + 1).saturating_sub(self.order).min(self.intervals) as f64
    }

    /// Weights of the points `interval .. interval + k` in the polar form of the curve's piece between the
    /// knots `interval` and `interval + 1` at the arguments `x(1), .., x(k-1)`.
    pub fn weights(&self, interval: usize, x: impl Fn(usize) -> f64) -> Vec<f64> {
        // the knot at which the interval begins
        let start = interval + self.order - 1;
        let mut weights = vec![0.0; self.order];
        weights[0] = 1.0;
        for r in 1..self.order {
            let x = x(r);
            let mut carried = 0.0;
            for (s, weight) in weights[..r].iter_mut().enumerate() {
                let (before, behind) = (self.knot(start + 1 + s - r), self.knot(start + 1 + s));
                // the interval itself lies between the two knots
                let part = *weight / (behind - before);
                *weight = carried + (behind - x) * part;
                carried = (x - before) * part;
            }
            weights[r] = carried;
        }
        weights
    }

    /// Where point i belongs: the mean of its k-1 inner knots (Greville 1967).
    pub fn parameter(&self, i: usize) -> f64 {
        let inner = (i + 1..i + self.order).map(|j| self.knot(j));
        inner.sum::<f64>() / (self.order - 1) as f64
    }

    /// The rows of a control polygon after every interval is halved: `2m + k-1` from `m + k-1`, of `width`
    /// numbers each.
    pub fn refine(&self, width: usize, values: &[f64]) -> Vec<f64> {
        let fine = Clamped::new(self.order, 2 * self.intervals);
        let count = fine.intervals + self.order - 1;
        let mut refined = vec![0.0; count * width];
        for (j, row) in refined.chunks_exact_mut(width).enumerate() {
            let knot = |r: usize| fine.knot(j + r) / 2.0;
            // the piece that the first of its knots begins; all weights are then in [0, 1]
            let interval = (knot(0) as usize).min(self.intervals - 1);
            for (i, weight) in self.weights(interval, knot).into_iter().enumerate() {
                let start = (interval + i) * width;
                for (sum, value) in row.iter_mut().zip(&values[start..start + width]) {
                    *sum += weight * value;
                }
            }
        }
        refined
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_averages() {
        for order in 2..=32 {
            for intervals in [1, 2, 5, 40] {
                let (coarse, fine) = (Clamped::new(order, intervals), Clamped::new(order, 2 * intervals));
                for j in 0..fine.intervals + order - 1 {
                    let knot = |r: usize| fine.knot(j + r) / 2.0;
                    let interval = (knot(0) as usize).min(intervals - 1);
                    let weights = coarse.weights(interval, knot);
                    assert!(
                        weights.iter().all(|&w| (0.0..=1.0).contains(&w)),
                        "order {order}, row {j}"
                    );
                    assert!(
                        (weights.iter().sum::<f64>() - 1.0).abs() < 1e-14,
                        "order {order}, row {j}"
                    );
                }
            }
        }
    }
}
