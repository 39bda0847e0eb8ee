//! Gauss-Legendre quadrature on the unit interval.

use std::f64::consts::PI;

/// A node in (0, 1) and its weight; the weights of a rule sum to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    pub at: f64,
    pub weight: f64,
}

/// The rule with `order` nodes in increasing order, exact for polynomials of degree `2 order - 1`.
///
/// The nodes are the zeros of the Legendre polynomial `P_n`, found by Newton's method from the asymptotic guess
/// `cos(pi (i - 1/4) / (n + 1/2))`; with `x` a zero, its weight on [-1, 1] is `2 / ((1 - x^2) P_n'(x)^2)`.
pub(crate) fn gauss_legendre(order: usize) -> Vec<Node> {
    let n = order as f64;
    (1..=order)
        .rev()
        .map(|i| {
            let mut x = (PI * (i as f64 - 0.25) / (n + 0.5)).cos();
            // quadratic convergence from an error below 1e-2: four steps reach rounding, the fifth costs nothing
            for _ in 0..5 {
                let (value, slope) = legendre(order, x);
                x -= value / slope;
            }
            let slope = legendre(order, x).1;
            Node {
                at: (1.0 + x) / 2.0,
                weight: 1.0 / ((1.0 - x * x) * slope * slope),
            }
        })
        .collect()
}

/// `P_n(x)` and `P_n'(x)` by the three-term recurrence, for |x| < 1.
fn legendre(order: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (0.0, 1.0);
    for m in 0..order {
        let m = m as f64;
        (previous, value) = (value, ((2.0 * m + 1.0) * x * value - m * previous) / (m + 1.0));
    }
    (value, order as f64 * (x * value - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn every_order_is_exact_for_its_degree_and_no_further() {
        for order in 1..=20 {
            let rule = gauss_legendre(order);
            assert!(rule.is_sorted_by(|a, b| a.at < b.at));
            let moment = |degree: usize| -> f64 { rule.iter().map(|n| n.weight * n.at.powi(degree as i32)).sum() };
            for degree in 0..2 * order {
                assert_relative_eq!(moment(degree), 1.0 / (degree as f64 + 1.0), max_relative = 1e-13);
            }
            if order <= 8 {
                let missed = 1.0 / (2.0 * order as f64 + 1.0) - moment(2 * order);
                assert!(missed > 1e-12, "order {order} misses degree {} by {missed}", 2 * order);
            }
        }
    }
}
