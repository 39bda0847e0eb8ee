//! Gauss-Legendre quadrature on the unit interval.
//!
//! The nodes of the rule with n points are the zeros of the Legendre polynomial `P_n`, moved from `[-1, 1]`
//! to `[0, 1]`. With `x` a zero, its weight there is `1 / ((1 - x^2) P_n'(x)^2)` (Abramowitz and Stegun 1964,
//! 25.4.29). The rule is exact for polynomials of degree `2n - 1`.
//!
//! Both numbers are found in doubles, to a few units of the last place; near the ends the weights lose digits
//! like `n^2`. The tabulated optima of the lambda-scheme were found with these very nodes, and flat minima
//! move by more than their rounding.

use std::f64::consts::PI;

/// A node in (0, 1) and its weight; the weights of a rule sum to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Where the function is taken.
    pub at: f64,
    /// What its value counts.
    pub weight: f64,
}

/// The rule with `count` nodes in increasing order, exact for polynomials of degree `2 count - 1`; without
/// nodes, an empty one. The zeros are found by Newton's method from the asymptotic guess `cos(pi (i - 1/4) /
/// (n + 1/2))`.
pub fn gauss_legendre(count: usize) -> Vec<Node> {
    let n = count as f64;
    (1..=count)
        .rev()
        .map(|i| {
            let mut x = (PI * (i as f64 - 0.25) / (n + 0.5)).cos();
            // quadratic convergence from an error below 1e-2: four steps reach rounding, the fifth costs
            // nothing
            for _ in 0..5 {
                let (value, slope) = legendre(count, x);
                x -= value / slope;
            }
            let slope = legendre(count, x).1;
            Node {
                at: (1.0 + x) / 2.0,
                weight: 1.0 / ((1.0 - x * x) * slope * slope),
            }
        })
        .collect()
}

/// `P_n(x)` and `P_n'(x)` by the three-term recurrence, for |x| < 1.
fn legendre(count: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (0.0, 1.0);
    for m in 0..count {
        let m = m as f64;
        (previous, value) = (value, ((2.0 * m + 1.0) * x * value - m * previous) / (m + 1.0));
    }
    (value, count as f64 * (x * value - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BigRational, Scalar};
    use num_bigint::BigInt;

    fn rational(value: f64) -> BigRational {
        BigRational::from_float(value).expect("finite")
    }

    fn power_of_two(exponent: u64) -> BigInt {
        BigInt::from(1) << exponent
    }

    /// `P_n(x)` and `P_n'(x)` without rounding, at an x in (-1, 1). With `x = a/d` the numbers `m! d^m P_m`
    /// are integers.
    fn exact(count: usize, x: &BigRational) -> (BigRational, BigRational) {
        let (a, d) = (x.numer(), x.denom());
        let square = d * d;
        let (mut previous, mut value) = (BigInt::from(0), BigInt::from(1));
        let mut scale = BigInt::from(1);
        for m in 0..count {
            let next = (2 * m + 1) * a * &value - m * m * &square * previous;
            (previous, value) = (value, next);
            scale = scale * (m + 1) * d;
        }
        // n (x P_n - P_{n-1}) / (x^2 - 1), all of it times n! d^n and the denominators of x
        let slope = count * (a * &value - count * &square * previous) * d;
        let slope = BigRational::new(slope, (a * a - square) * &scale);
        (BigRational::new(value, scale), slope)
    }

    /// A step of Newton's method in rational numbers, from the node as it is, gives the zero and its weight.
    #[test]
    fn nodes_and_weights_are_the_exact_ones_to_a_few_units() {
        let (one, two) = (BigRational::from_integer(1.into()), BigRational::from_integer(2.into()));
        for count in (1..=12).chain([15, 20, 27]) {
            for Node { at, weight } in gauss_legendre(count) {
                let x = rational(at) * &two - &one;
                let (value, slope) = exact(count, &x);
                // the square of a rounding error is below 2^-100; more digits would only make the rest slow
                let grid = power_of_two(120);
                let x = BigRational::new(((x - value / slope) * &grid).round().to_integer(), grid);
                let slope = exact(count, &x).1;
                let expected = f64::rational(&(&one / ((&one - &x * &x) * &slope * &slope)));
                let place = f64::rational(&((&x + &one) / &two));
                assert!((at - place).abs() < 4e-16, "{count} nodes: {at}");
                // what a node is off by counts x / (1 - x^2) times
                assert!(
                    (weight / expected - 1.0).abs() < 1e-16 * (8 + count * count) as f64,
                    "{count} nodes: {at}"
                );
            }
        }
    }

    #[test]
    fn every_rule_is_exact_for_its_degree_and_no_further() {
        for count in 1..=40 {
            let rule = gauss_legendre(count);
            let moment = |degree: usize| -> f64 { rule.iter().map(|n| n.weight * n.at.powi(degree as i32)).sum() };
            for degree in 0..2 * count {
                let found = moment(degree) * (degree + 1) as f64;
                assert!((found - 1.0).abs() < 1e-13, "{count} nodes, degree {degree}: {found}");
            }
            if count <= 8 {
                let missed = 1.0 / (2.0 * count as f64 + 1.0) - moment(2 * count);
                assert!(missed > 1e-12, "{count} nodes miss degree {} by {missed}", 2 * count);
            }
        }
        assert!(gauss_legendre(0).is_empty());
    }

    #[test]
    fn rules_are_sorted_and_symmetric() {
        for count in 1..=64 {
            let rule = gauss_legendre(count);
            assert!(rule.is_sorted_by(|a, b| a.at < b.at) && rule[0].at > 0.0);
            for (node, mirrored) in rule.iter().zip(rule.iter().rev()) {
                assert!((node.weight / mirrored.weight - 1.0).abs() < 1e-16 * (8 + count * count) as f64);
                assert!((node.at + mirrored.at - 1.0).abs() < 1e-15);
            }
        }
    }

    /// Abramowitz and Stegun, *Handbook of Mathematical Functions*, 1964, Table 25.4: abscissas and weights
    /// on [-1, 1], 15 decimals.
    #[test]
    fn published_values() {
        let tables: [&[(f64, f64)]; 5] = [
            &[(0.577350269189626, 1.0)],
            &[(0.774596669241483, 0.555555555555556), (0.0, 0.888888888888889)],
            &[
                (0.861136311594053, 0.347854845137454),
                (0.339981043584856, 0.652145154862546),
            ],
            &[
                (0.906179845938664, 0.236926885056189),
                (0.538469310105683, 0.478628670499366),
                (0.0, 0.568888888888889),
            ],
            &[
                (0.973906528517172, 0.066671344308688),
                (0.865063366688985, 0.149451349150581),
                (0.679409568299024, 0.219086362515982),
                (0.433395394129247, 0.269266719309996),
                (0.148874338981631, 0.295524224714753),
            ],
        ];
        for (table, count) in tables.into_iter().zip([2, 3, 4, 5, 10]) {
            let rule = gauss_legendre(count);
            for ((x, weight), node) in table.iter().zip(rule.iter().rev()) {
                // half a unit of the last printed place, and some units that doubles add
                assert!((2.0 * node.at - 1.0 - x).abs() < 1.5e-15, "{count} nodes: {x}");
                assert!((2.0 * node.weight - weight).abs() < 3e-15, "{count} nodes: {x}");
            }
        }
    }

    /// Five nodes in radicals: `x^2 = (5 -+ 2 sqrt(10/7)) / 9`, weights `(322 +- 13 sqrt 70) / 900`.
    #[test]
    fn five_nodes_are_radicals() {
        let (near, far) = ((10.0_f64 / 7.0).sqrt(), 70.0_f64.sqrt());
        let (x, y) = ((5.0 - 2.0 * near).sqrt() / 3.0, (5.0 + 2.0 * near).sqrt() / 3.0);
        let (p, q) = ((322.0 + 13.0 * far) / 900.0, (322.0 - 13.0 * far) / 900.0);
        let expected = [(-y, q), (-x, p), (0.0, 128.0 / 225.0), (x, p), (y, q)];
        for (node, (t, w)) in gauss_legendre(5).iter().zip(expected) {
            assert!((node.at - (1.0 + t) / 2.0).abs() < 5e-16 && (node.weight - w / 2.0).abs() < 1e-15);
        }
    }
}
