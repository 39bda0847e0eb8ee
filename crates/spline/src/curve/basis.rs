//! The basis of the limit curves.
//!
//! One level multiplies the generating function of the points by
//! `(1+z)^(k-2) (1 + 2 u z + z^2) / (2^(k-2) (1+u))`. Over all levels each factor `(1+z)/2` becomes the box
//! function of width 1, and the last factor, since `u_l` halves its angle, the generalised hat of unit area
//!
//! ```text
//! H(y) = w sin(w (1-|y|)) / (2 (1 - cos w)),   1 - |y|,   w sinh(w (1-|y|)) / (2 (cosh w - 1)),    |y| <= 1
//! ```
//!
//! for `u = cos(w/2), 1, cosh(w/2)`. The limit of a single 1 is their convolution, `B_k = H * N_{k-2}`, where
//! `N_{k-2}` is the uniform polynomial B-spline of k-2 intervals: **the basis of order k is the polynomial
//! one of order k-2, averaged over H**. It is even, has support `[-k/2, k/2]` and k-2 continuous derivatives,
//! and its shifts sum to one. For `u >= 0` it is positive.
//!
//! The average is taken by Gauss-Legendre quadrature between the knots. The integrand there is a polynomial
//! of degree k-3 times an exponential function of a range of at most `2 pi` ([`ARC`]), so that the rule's
//! error is below rounding ([`Basis::new`]). All terms have one sign for `u >= 0`; nothing cancels for any u
//! near 1, where closed forms by powers and sines would.

use super::{Angle, MIN_ORDER, Tension};
use crate::quadrature::{Node, gauss_legendre};
use crate::uniform;

/// The longest piece of quadrature, in units of `1/w`.
const ARC: f64 = std::f64::consts::TAU;

/// Where a hyperbolic hat ends, in units of `1/w`: `exp(-48) < 2e-21` of its area is beyond.
const REACH: f64 = 48.0;

/// The basis of order k and one tension.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    order: usize,
    tension: Tension,
    /// Quadrature on [0, 1].
    rule: Vec<Node>,
}

impl Basis {
    /// The basis of an order of at least 3, or of order 2 at tension 1.
    ///
    /// The n nodes are exact to degree `2n-1 >= k-3+24`. On a piece of length `2 pi/w` the best approximation
    /// of degree 24 to `exp(i w y)` or `exp(w y)` has an error of about `2 (pi/2)^25 / 25! = 1e-20`.
    pub(super) fn new(order: usize, tension: Tension) -> Self {
        Basis {
            order,
            tension,
            rule: gauss_legendre((order + 23) / 2),
        }
    }

    /// The same order with another tension.
    pub(super) fn with_tension(&self, tension: Tension) -> Self {
        Basis {
            tension,
            ..self.clone()
        }
    }

    /// The order k.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The tension.
    pub fn tension(&self) -> Tension {
        self.tension
    }

    /// The k functions that do not vanish between two knots, at the fraction `0 <= f <= 1` of the way: the
    /// weights of k consecutive points in the limit point there.
    pub(super) fn values(&self, f: f64) -> Vec<f64> {
        if self.order < MIN_ORDER {
            return vec![1.0 - f, f];
        }
        let mut values = vec![0.0; self.order];
        for (y, weight) in self.average(f) {
            // the place f - y lies in the interval before (its functions are the first k-2), in this one, or
            // in the next
            let interval = (f - y).floor().clamp(-1.0, 1.0);
            let offset = (interval + 1.0) as usize;
            let fraction = f - y - interval;
            for (sum, value) in values[offset..]
                .iter_mut()
                .zip(uniform::values(self.order - 3, fraction))
            {
                *sum += weight * value;
            }
        }
        values
    }

    /// The limit point at a control point's own parameter as an average of it and its neighbours: the values
    /// at a knot for even orders, half way between two for odd ones. An odd number of weights, symmetric.
    pub fn mask(&self) -> Vec<f64> {
        if self.order.is_multiple_of(2) {
            let mut mask = self.values(0.0);
            mask.pop();
            mask
        } else {
            self.values(0.5)
        }
    }

    /// `integral of y^m H(y)`, the moments of the hat, for m = 0 .. count-1.
    pub(super) fn hat_moments(&self, count: usize) -> Vec<f64> {
        let mut moments = vec![0.0; count];
        for (y, weight) in self.average(0.0) {
            let mut power = weight;
            for moment in &mut moments {
                *moment += power;
                power *= y;
            }
        }
        moments
    }

    /// Nodes y in `[-1, 1]` and weights, H(y) included, of the average at the fraction f. Weights sum to one.
    fn average(&self, f: f64) -> Vec<(f64, f64)> {
        let w = match self.tension.angle() {
            Angle::Polynomial => 0.0,
            Angle::Trigonometric(w) | Angle::Hyperbolic(w) => w,
        };
        let reach = match self.tension.angle() {
            Angle::Hyperbolic(w) => (REACH / w).min(1.0),
            _ => 1.0,
        };
        let mut nodes = Vec::new();
        for (side, knot) in [(1.0, f), (-1.0, 1.0 - f)] {
            for (from, to) in [(0.0, knot.min(reach)), (knot.min(reach), reach)] {
                let parts = (w * (to - from) / ARC).ceil().max(1.0);
                let length = (to - from) / parts;
                for part in 0..parts as usize {
                    for &Node { at, weight } in &self.rule {
                        let a = from + (part as f64 + at) * length;
                        nodes.push((side * a, weight * length * self.hat(a)));
                    }
                }
            }
        }
        nodes
    }

    /// The derivative of H at `0 < a < 1`.
    pub(super) fn hat_slope(&self, a: f64) -> f64 {
        let u = self.tension.value();
        match self.tension.angle() {
            Angle::Polynomial => -1.0,
            Angle::Trigonometric(w) => -w * w * (w * (1.0 - a)).cos() / (4.0 * (1.0 - u) * (1.0 + u)),
            Angle::Hyperbolic(w) => {
                let fall = (-w).exp_m1();
                -w * w / 2.0 * (-w * a).exp() * (1.0 + (-2.0 * w * (1.0 - a)).exp()) / (fall * fall)
            }
        }
    }

    /// H at `0 <= a <= 1`.
    pub(super) fn hat(&self, a: f64) -> f64 {
        let u = self.tension.value();
        match self.tension.angle() {
            Angle::Polynomial => 1.0 - a,
            // 2 (1 - cos w) = 4 (1 - u^2)
            Angle::Trigonometric(w) => w * (w * (1.0 - a)).sin() / (4.0 * (1.0 - u) * (1.0 + u)),
            // sinh and cosh without their common growth
            Angle::Hyperbolic(w) => {
                let fall = (-w).exp_m1();
                w / 2.0 * (-w * a).exp() * -(-2.0 * w * (1.0 - a)).exp_m1() / (fall * fall)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TENSIONS: [f64; 13] = [
        -0.9,
        -0.3,
        0.0,
        0.01,
        0.7,
        1.0 - 1e-9,
        1.0 - 2e-16,
        1.0,
        1.0 + 1e-12,
        2.0,
        50.0,
        1e6,
        1e300,
    ];

    #[test]
    fn functions_sum_to_one_and_are_positive() {
        for order in 3..=32 {
            for u in TENSIONS {
                let basis = Basis::new(order, Tension::new(u).unwrap());
                for f in [0.0, 1.0 / 1024.0, 0.125, 0.5, 0.6875, 1.0] {
                    let values = basis.values(f);
                    let sum: f64 = values.iter().sum();
                    assert!(
                        (sum - 1.0).abs() < 1e-14 / (1.0 + u).min(1.0),
                        "order {order}, u = {u}, f = {f}: {sum}"
                    );
                    assert!(u < 0.0 || values.iter().all(|&v| v >= 0.0), "order {order}, u = {u}");
                    let mirrored = basis.values(1.0 - f);
                    for (a, b) in values.iter().zip(mirrored.iter().rev()) {
                        assert!((a - b).abs() < 1e-14 / (1.0 + u).min(1.0), "order {order}, u = {u}");
                    }
                }
                let mask = basis.mask();
                assert!(mask.len() % 2 == 1 && mask.len() + 1 - order % 2 == order);
                assert!((mask.iter().sum::<f64>() - 1.0).abs() < 1e-14 / (1.0 + u).min(1.0));
            }
        }
    }

    #[test]
    fn the_functions_end_continuously() {
        for order in 3..=32 {
            for u in TENSIONS {
                let basis = Basis::new(order, Tension::new(u).unwrap());
                let (end, start) = (basis.values(1.0), basis.values(0.0));
                assert!(end[0].abs() < 1e-15 && start[order - 1].abs() < 1e-15);
                for j in 1..order {
                    assert!(
                        (end[j] - start[j - 1]).abs() < 1e-14 / (1.0 + u).min(1.0),
                        "order {order}, u = {u}"
                    );
                }
            }
        }
    }
}
