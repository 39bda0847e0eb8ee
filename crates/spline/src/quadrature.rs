//! Gauss-Legendre quadrature on the unit interval.
//!
//! The nodes of the rule with n points are the zeros of the Legendre polynomial `P_n`, moved from `[-1, 1]`
//! to `[0, 1]`. With `x` a zero, its weight there is `1 / ((1 - x^2) P_n'(x)^2)` (Abramowitz and Stegun 1964,
//! 25.4.29). The rule is exact for polynomials of degree `2n - 1`.
//!
//! Both numbers are found to the last digit. In doubles the zeros come out to a few units of the last place,
//! and the weights multiply that by `x / (1 - x^2)`, which near the ends grows with `n^2`: at n = 27 a
//! hundred units were lost. So Newton's method in doubles is followed by one step in sums of two doubles, and
//! the weight is taken at the zero as such a sum.

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
/// nodes, an empty one.
///
/// Nodes and weights are the doubles next to the exact numbers, and the weights are symmetric.
pub fn gauss_legendre(count: usize) -> Vec<Node> {
    let mut rule = vec![Node { at: 0.5, weight: 0.0 }; count];
    for i in 0..count.div_ceil(2) {
        let x = if 2 * i + 1 == count {
            // the middle zero of an odd polynomial
            Pair::from(0.0)
        } else {
            zero(count, i)
        };
        let slope = legendre(count, x).1;
        let one = Pair::from(1.0);
        let weight = (one.plus(x).times(one.minus(x)).times(slope).times(slope)).reciprocal();
        let half = |y: Pair| y.high / 2.0;
        (rule[i].at, rule[count - 1 - i].at) = (half(one.minus(x)), half(one.plus(x)));
        (rule[i].weight, rule[count - 1 - i].weight) = (weight.high, weight.high);
    }
    rule
}

/// The zero of `P_n` that has `i` greater ones, by Newton's method from the asymptotic guess
/// `cos(pi (i + 3/4) / (n + 1/2))`.
fn zero(count: usize, i: usize) -> Pair {
    let mut x = (PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
    // quadratic convergence from an error below 1e-2: four steps reach rounding, the fifth costs nothing
    for _ in 0..5 {
        let (value, slope) = legendre(count, Pair::from(x));
        x -= value.high / slope.high;
    }
    // from an error of rounding the sixth leaves its square
    let (value, slope) = legendre(count, Pair::from(x));
    Pair::sum(x, -value.high / slope.high)
}

/// `P_n(x)` and `P_n'(x)` by the three-term recurrence, for |x| < 1.
fn legendre(count: usize, x: Pair) -> (Pair, Pair) {
    let whole = |m: usize| Pair::from(m as f64);
    let (mut previous, mut value) = (whole(0), whole(1));
    for m in 0..count {
        let next = whole(2 * m + 1).times(x).times(value).minus(whole(m).times(previous));
        (previous, value) = (value, next.times(whole(m + 1).reciprocal()));
    }
    let one = whole(1);
    let length = one.plus(x).times(one.minus(x));
    let slope = whole(count)
        .times(previous.minus(x.times(value)))
        .times(length.reciprocal());
    (value, slope)
}

/// The sum of two doubles, of which `high` is the nearest to it: about 106 bits (Dekker 1971, *Numer. Math.*
/// 18).
#[derive(Clone, Copy)]
struct Pair {
    high: f64,
    low: f64,
}

impl From<f64> for Pair {
    fn from(high: f64) -> Self {
        Pair { high, low: 0.0 }
    }
}

impl Pair {
    /// `a + b` without error (Knuth).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Pair {
            high,
            low: (a - (high - part)) + (b - part),
        }
    }

    /// `a b` without error, for what does not underflow.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Pair {
            high,
            low: a.mul_add(b, -high),
        }
    }

    fn plus(self, other: Self) -> Self {
        let sum = Pair::sum(self.high, other.high);
        Pair::sum(sum.high, sum.low + (self.low + other.low))
    }

    fn minus(self, other: Self) -> Self {
        self.plus(Pair {
            high: -other.high,
            low: -other.low,
        })
    }

    fn times(self, other: Self) -> Self {
        let product = Pair::product(self.high, other.high);
        Pair::sum(
            product.high,
            product.low + (self.high * other.low + self.low * other.high),
        )
    }

    /// One step of Newton's method, `y (2 - x y)`, from the quotient of doubles.
    fn reciprocal(self) -> Self {
        let rough = Pair::from(1.0 / self.high);
        rough.times(Pair::from(2.0).minus(self.times(rough)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BigRational, Scalar};
    use num_bigint::{BigInt, Sign};

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

    /// The exact polynomial changes its sign within half a unit of the last place of each node, and the
    /// weight there, after a step of Newton's method in rational numbers, rounds to the double given.
    #[test]
    fn nodes_and_weights_are_the_doubles_next_to_the_exact_ones() {
        let (one, two) = (BigRational::from_integer(1.into()), BigRational::from_integer(2.into()));
        for count in (1..=12).chain([15, 20, 27]) {
            for Node { at, weight } in gauss_legendre(count) {
                let at_middle = |other: f64| exact(count, &(rational(at) + rational(other) - &one)).0;
                let (below, above) = (at_middle(at.next_down()), at_middle(at.next_up()));
                let signs = (below.numer().sign(), above.numer().sign());
                assert!(
                    matches!(signs, (Sign::Minus, Sign::Plus) | (Sign::Plus, Sign::Minus)),
                    "{count} nodes: {at}"
                );
                let x = rational(at) * &two - &one;
                let (value, slope) = exact(count, &x);
                // the square of a rounding error is below 2^-100; more digits would only make the rest slow
                let grid = power_of_two(120);
                let x = BigRational::new(((x - value / slope) * &grid).round().to_integer(), grid);
                let slope = exact(count, &x).1;
                let expected = &one / ((&one - &x * &x) * &slope * &slope);
                assert_eq!(weight, f64::rational(&expected), "{count} nodes: {at}");
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
                // a power of degree d multiplies the rounding of a node by d, and powi rounds log d times
                // more
                assert!(
                    (found - 1.0).abs() < 1e-16 * (4 + degree) as f64,
                    "{count} nodes, degree {degree}: {found}"
                );
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
                assert_eq!(node.weight, mirrored.weight);
                // the greater one has the coarser digits
                assert!((node.at + mirrored.at - 1.0).abs() <= f64::EPSILON / 2.0);
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
                // half a unit of the last printed place, and what doubles add
                assert!((2.0 * node.at - 1.0 - x).abs() < 6e-16, "{count} nodes: {x}");
                assert!((2.0 * node.weight - weight).abs() < 6e-16, "{count} nodes: {x}");
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
            assert!((node.at - (1.0 + t) / 2.0).abs() < 3e-16 && (node.weight - w / 2.0).abs() < 3e-16);
        }
    }
}
