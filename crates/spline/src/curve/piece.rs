//! The basis between two knots with its derivatives, made once and evaluated often.
//!
//! Derivatives are differences of lower orders, `B_k' = B_{k-1}(y + 1/2) - B_{k-1}(y - 1/2)`, down to the hat
//! `B_2 = H` and its slope. On one interval the k functions span `1, x, .., x^(k-3), cos wx, sin wx` (or
//! their hyperbolic kind). A basis of that space which does not degenerate as w tends to 0 is
//!
//! ```text
//! x^j / j!  for j <= k-3,      phi_j(x) = sum_m (-+w^2)^m x^(j+2m) / (j+2m)!  for j = k-2, k-1,
//! ```
//!
//! with x from the middle of the interval. The coefficients of a function are its derivatives 0 to k-1 there.

use super::{Angle, Basis, MAX_ORDER, MIN_ORDER, Tension};

/// Values, first and second derivatives of the k functions that do not vanish between two knots, in the order
/// of their control points; what follows the k-th is 0.
pub type Values = [[f64; MAX_ORDER]; 3];

/// Beyond this frequency the series about the middle lose digits, which grow like `exp(w/2)`, and quadrature
/// takes their place: `u = cosh(4) = 27`. No trigonometric basis is beyond.
const FASTEST: f64 = 8.0;

/// The basis of one order and tension between two knots.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    order: usize,
    /// The bases of orders k, k-1, k-2 as far as these are at least 3.
    bases: Vec<Basis>,
    /// `-w^2`, 0, `w^2`.
    square: f64,
    /// What the terms of the two series are divided by, `(n-1) n` for n = k-2+2m and k-1+2m, as factors.
    factors: Vec<[f64; 2]>,
    /// Row after row of k numbers: the j-th derivatives of the functions at the middle. None if quadrature
    /// is more accurate than the series.
    derivatives: Vec<f64>,
    /// `1 / j!`.
    inverse_factorials: Vec<f64>,
}

impl Piece {
    /// The basis of an order from 3 to [`MAX_ORDER`].
    ///
    /// # Errors
    /// [`Error::Order`](crate::Error::Order).
    pub fn new(order: usize, tension: Tension) -> Result<Self, crate::Error> {
        if !(MIN_ORDER..=MAX_ORDER).contains(&order) {
            return Err(crate::Error::Order {
                order,
                minimum: MIN_ORDER,
                maximum: MAX_ORDER,
            });
        }
        let (square, w) = match tension.angle() {
            Angle::Polynomial => (0.0, 0.0),
            Angle::Trigonometric(w) => (-w * w, w),
            Angle::Hyperbolic(w) => (w * w, w),
        };
        let mut inverse_factorials = vec![1.0];
        for j in 1..order {
            inverse_factorials.push(inverse_factorials[j - 1] / j as f64);
        }
        let bases = (order.saturating_sub(2).max(3)..=order)
            .rev()
            .map(|k| Basis::new(k, tension))
            .collect();
        let mut piece = Piece {
            order,
            bases,
            square,
            factors: Vec::new(),
            derivatives: Vec::new(),
            inverse_factorials,
        };
        if w <= FASTEST {
            // the first term left out is below 1e-19 of the first
            let (mut terms, mut size) = (1, 1.0_f64);
            while size > 1e-19 {
                let n = order - 2 + 2 * terms;
                size *= w * w / 4.0 / ((n - 1) * n) as f64;
                terms += 1;
            }
            let factor = |n: usize| 1.0 / ((n - 1) * n) as f64;
            let factors = |m: usize| [order - 2 + 2 * m, order - 1 + 2 * m].map(factor);
            piece.factors = (1..terms).map(factors).collect();
            piece.derivatives = (0..order).flat_map(|j| derivative(order, tension, j, 0.5)).collect();
        }
        Ok(piece)
    }

    /// The order k.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The functions at the fraction `0 <= f <= 1` of the way between the knots; derivatives are by f.
    ///
    /// ```
    /// use eigenring_spline::curve::{Piece, Tension};
    ///
    /// // order 4 at tension 1: cubic B-splines
    /// let piece = Piece::new(4, Tension::new(1.0)?)?;
    /// let [values, first, second] = piece.at(0.0);
    /// assert!((values[1] - 2.0 / 3.0).abs() < 1e-15);
    /// assert!((first[2] - 0.5).abs() < 1e-15 && (second[1] + 2.0).abs() < 1e-14);
    /// # Ok::<(), eigenring_spline::Error>(())
    /// ```
    pub fn at(&self, f: f64) -> Values {
        self.evaluated(self.order, f)
    }

    #[inline(always)]
    fn evaluated<const M: usize>(&self, k: usize, f: f64) -> [[f64; M]; 3] {
        let mut out = [[0.0; M]; 3];
        if self.derivatives.is_empty() {
            let tension = self.bases[0].tension();
            for (j, out) in out.iter_mut().enumerate() {
                let values = match self.bases.get(j) {
                    Some(basis) => raised(basis.values(f), j),
                    None => derivative(k, tension, j, f),
                };
                out[..k].copy_from_slice(&values);
            }
            return out;
        }
        for (out, terms) in out.iter_mut().zip(self.terms::<M>(k, f)) {
            let out = &mut out[..k];
            for (row, factor) in self.derivatives.chunks_exact(k).zip(terms) {
                if factor != 0.0 {
                    out.iter_mut().zip(row).for_each(|(sum, d)| *sum += factor * d);
                }
            }
        }
        out
    }

    /// The derivatives 0 to k-1 of the k functions at the middle, row after row of k numbers; `None` where
    /// the functions are evaluated by quadrature. A spline's own derivatives there, sums of these times its
    /// control points, are its coefficients by the functions of [`Piece::span`].
    pub fn at_middle(&self) -> Option<&[f64]> {
        (!self.derivatives.is_empty()).then_some(&self.derivatives)
    }

    /// The functions `1, x, .., x^(k-3) / (k-3)!, phi_(k-2), phi_(k-1)` at a fraction of the way, with
    /// x = f - 1/2, and their first and second derivatives. K is the order, for loops of known length, or
    /// more, and what follows is 0. The j-th function has no d-th derivative for j < d and j < k-2.
    ///
    /// # Panics
    /// If K is less than the order.
    #[inline]
    pub fn span<const K: usize>(&self, f: f64) -> [[f64; K]; 3] {
        if K == self.order {
            return self.terms(K, f);
        }
        assert!(K > self.order, "more functions than asked for");
        self.terms(self.order, f)
    }

    #[inline(always)]
    fn terms<const M: usize>(&self, k: usize, f: f64) -> [[f64; M]; 3] {
        let x = f - 0.5;
        let [mut values, mut first, mut second] = [[0.0; M]; 3];
        let mut power = 1.0;
        for (to, inverse) in values[..k].iter_mut().zip(&self.inverse_factorials) {
            *to = power * inverse;
            power *= x;
        }
        let step = self.square * x * x;
        let (mut before, mut last) = (1.0, 1.0);
        for [one, other] in self.factors.iter().rev() {
            before = 1.0 + before * (step * one);
            last = 1.0 + last * (step * other);
        }
        let (before, last) = (values[k - 2] * before, values[k - 1] * last);
        // phi_(j-2) = x^(j-2) / (j-2)! -+ w^2 phi_j
        let lowest = if k > 3 { values[k - 4] } else { 0.0 };
        let lower = [lowest + self.square * before, values[k - 3] + self.square * last];
        first[1..k - 2].copy_from_slice(&values[..k - 3]);
        if k > 4 {
            second[2..k - 2].copy_from_slice(&values[..k - 4]);
        }
        values[k - 2..k].copy_from_slice(&[before, last]);
        first[k - 2..k].copy_from_slice(&[lower[1], before]);
        second[k - 2..k].copy_from_slice(&lower);
        [values, first, second]
    }
}

/// Differences, so many times: from the functions of an order to derivatives of a higher one.
fn raised(values: Vec<f64>, times: usize) -> Vec<f64> {
    (0..times).fold(values, |lower, _| {
        let before = std::iter::once(0.0).chain(lower.iter().copied());
        let own = lower.iter().copied().chain(std::iter::once(0.0));
        before.zip(own).map(|(before, own)| before - own).collect()
    })
}

/// The j-th derivatives of the functions of an order, j < k.
fn derivative(order: usize, tension: Tension, j: usize, f: f64) -> Vec<f64> {
    let hat = Basis::new(3, tension);
    match order - j {
        1 => raised(vec![hat.hat_slope(f), -hat.hat_slope(1.0 - f)], j - 1),
        2 => raised(vec![hat.hat(f), hat.hat(1.0 - f)], j),
        k => raised(Basis::new(k, tension).values(f), j),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TENSIONS: [f64; 12] = [
        -0.9,
        -0.3,
        0.0,
        0.3,
        1.0 - 1e-9,
        1.0,
        1.0 + 1e-12,
        1.5,
        5.0,
        26.0,
        50.0,
        1e6,
    ];

    #[test]
    fn values_are_those_of_the_quadrature() {
        let mut worst = 0.0_f64;
        for order in 3..=MAX_ORDER {
            for u in TENSIONS {
                let tension = Tension::new(u).unwrap();
                let piece = Piece::new(order, tension).unwrap();
                for f in [0.0, 0.125, 0.5, 0.75, 1.0] {
                    let values = piece.at(f);
                    for (j, found) in values.iter().enumerate() {
                        if order - j == 1 && (f == 0.0 || f == 1.0) {
                            continue;
                        }
                        let expected = derivative(order, tension, j, f);
                        let size = expected.iter().fold(1.0_f64, |a, b| a.max(b.abs()));
                        for (a, b) in found.iter().zip(&expected) {
                            worst = worst.max((a - b).abs() / size * (1.0 + u).min(1.0));
                        }
                    }
                }
            }
        }
        assert!(worst < 1e-14, "{worst:e}");
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        for order in 3..=9 {
            for u in TENSIONS {
                let piece = Piece::new(order, Tension::new(u).unwrap()).unwrap();
                let (f, h) = (0.4, 1e-4);
                let [before, at, after] = [f - h, f, f + h].map(|f| piece.at(f));
                for i in 0..order {
                    let first = (after[0][i] - before[0][i]) / (2.0 * h);
                    let second = (after[1][i] - before[1][i]) / (2.0 * h);
                    let size = at[1].iter().chain(&at[2]).fold(1.0_f64, |a, b| a.max(b.abs()));
                    let loose = 1e-4 * size * (1.0 + piece.square.abs());
                    assert!((first - at[1][i]).abs() < loose, "order {order}, u = {u}");
                    assert!((second - at[2][i]).abs() < loose, "order {order}, u = {u}");
                }
            }
        }
    }
}
