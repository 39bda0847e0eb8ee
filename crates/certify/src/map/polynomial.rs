//! Bivariate polynomials in Bernstein form on the unit square.
//!
//! `f(u, v) = sum_ij b_ij B_i^m(u) B_j^n(v)`. The Bernstein polynomials are non-negative and sum to one, so the values lie
//! between the smallest and the largest coefficient, and the coefficients at the corners are values. On the halves of the
//! square the bounds are sharper, with an error that falls quadratically with the size (Garloff 1986).
//!
//! Coefficients are stored with `i` (the degree in u) running fastest. With `b_ij` scaled by the binomials
//! `C(m, i) C(n, j)` a product is a convolution (Farouki and Rajan 1988).

use super::Coefficient;
use eigenring_scheme::Scalar;

/// A polynomial in Bernstein form, see the module page.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial<S> {
    /// The degrees in u and in v.
    degree: [usize; 2],
    coefficients: Vec<S>,
}

impl<S: Scalar + Copy> Polynomial<S> {
    /// The polynomial of a tensor-product spline patch with `(d+1)^2` control values, from the conversion matrix of its
    /// degree ([`to_bernstein`](eigenring_spectral::bspline::to_bernstein)).
    pub fn from_control(control: &[S], conversion: &[Vec<S>]) -> Self {
        let width = conversion.len();
        let along_u: Vec<Vec<S>> = control
            .chunks(width)
            .map(|row| {
                conversion
                    .iter()
                    .map(|weights| combine(weights, row.iter().copied()))
                    .collect()
            })
            .collect();
        let coefficients = conversion
            .iter()
            .flat_map(|weights| {
                (0..width)
                    .map(|i| combine(weights, along_u.iter().map(move |row| row[i])))
                    .collect::<Vec<S>>()
            })
            .collect();
        Polynomial {
            degree: [width - 1; 2],
            coefficients,
        }
    }

    /// The coefficients, the index in u running fastest.
    pub fn coefficients(&self) -> &[S] {
        &self.coefficients
    }

    /// The coefficients with another scalar.
    pub fn map<T>(&self, f: impl FnMut(&S) -> T) -> Polynomial<T> {
        Polynomial {
            degree: self.degree,
            coefficients: self.coefficients.iter().map(f).collect(),
        }
    }

    /// The derivative by u.
    pub fn by_u(&self) -> Self {
        let [m, n] = self.degree;
        let factor = S::ratio(m as i64, 1);
        let rows = self.coefficients.chunks(m + 1);
        let coefficients = rows
            .flat_map(|row| row.windows(2).map(move |pair| factor * (pair[1] - pair[0])))
            .collect();
        Polynomial {
            degree: [m - 1, n],
            coefficients,
        }
    }

    /// The derivative by v.
    pub fn by_v(&self) -> Self {
        let [m, n] = self.degree;
        let factor = S::ratio(n as i64, 1);
        let pairs = self.coefficients.iter().zip(&self.coefficients[m + 1..]);
        Polynomial {
            degree: [m, n - 1],
            coefficients: pairs.map(|(&low, &high)| factor * (high - low)).collect(),
        }
    }

    fn zip(&self, other: &Self, f: impl Fn(S, S) -> S) -> Self {
        assert_eq!(
            self.degree, other.degree,
            "only polynomials of equal degrees are combined by coefficient"
        );
        let pairs = self.coefficients.iter().zip(&other.coefficients);
        Polynomial {
            degree: self.degree,
            coefficients: pairs.map(|(&a, &b)| f(a, b)).collect(),
        }
    }

    /// The sum of two polynomials of equal degrees.
    pub fn plus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    /// The difference of two polynomials of equal degrees.
    pub fn minus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    /// The multiple by a number.
    pub fn times(&self, factor: S) -> Self {
        self.map(|&c| factor * c)
    }

    /// The coefficients scaled by their binomials: those of the monomials `u^i (1-u)^(m-i) v^j (1-v)^(n-j)`.
    pub fn scaled(&self) -> Scaled<S> {
        let [m, n] = self.degree;
        let (in_u, in_v) = (binomials::<S>(m), binomials::<S>(n));
        let rows = self.coefficients.chunks(m + 1).zip(&in_v);
        let coefficients = rows
            .flat_map(|(row, &b)| row.iter().zip(&in_u).map(move |(&c, &a)| a * b * c))
            .collect();
        Scaled {
            degree: self.degree,
            coefficients,
        }
    }

    /// The four quarters of the square, each as a polynomial on the unit square: first half in u and v, second half in u,
    /// second half in v, both second halves.
    pub fn quarters(&self) -> [Self; 4] {
        let [left, right] = self.halves_in_u();
        let ([a, c], [b, d]) = (left.halves_in_v(), right.halves_in_v());
        [a, b, c, d]
    }

    fn halves_in_u(&self) -> [Self; 2] {
        let width = self.degree[0] + 1;
        let (mut left, mut right) = (
            Vec::with_capacity(self.coefficients.len()),
            Vec::with_capacity(self.coefficients.len()),
        );
        for row in self.coefficients.chunks(width) {
            let [first, second] = halves(row);
            left.extend(first);
            right.extend(second);
        }
        [left, right].map(|coefficients| Polynomial {
            degree: self.degree,
            coefficients,
        })
    }

    fn halves_in_v(&self) -> [Self; 2] {
        let width = self.degree[0] + 1;
        let mut parts = [self.coefficients.clone(), self.coefficients.clone()];
        for i in 0..width {
            let column: Vec<S> = self.coefficients.iter().skip(i).step_by(width).copied().collect();
            for (part, half) in parts.iter_mut().zip(halves(&column)) {
                for (place, value) in part.iter_mut().skip(i).step_by(width).zip(half) {
                    *place = value;
                }
            }
        }
        parts.map(|coefficients| Polynomial {
            degree: self.degree,
            coefficients,
        })
    }

    /// The value at a point of the square, by the algorithm of de Casteljau.
    pub fn value(&self, u: S, v: S) -> S {
        let rows: Vec<S> = self
            .coefficients
            .chunks(self.degree[0] + 1)
            .map(|row| value(row.to_vec(), u))
            .collect();
        value(rows, v)
    }

    /// The coefficients at the four corners, which are values there: (0,0), (1,0), (0,1), (1,1).
    pub fn corners(&self) -> [S; 4] {
        let [m, n] = self.degree;
        let last = n * (m + 1);
        [0, m, last, last + m].map(|index| self.coefficients[index])
    }
}

/// A polynomial with its coefficients scaled by binomials, in which products are cheap.
#[derive(Clone, Debug)]
pub struct Scaled<S> {
    pub(super) degree: [usize; 2],
    pub(super) coefficients: Vec<S>,
}

impl<S: Scalar + Copy> Scaled<S> {
    /// The constant one: products with it raise the degrees.
    pub fn one(degree: [usize; 2]) -> Self {
        let [in_u, in_v] = degree.map(binomials::<S>);
        let coefficients = in_v.iter().flat_map(|&b| in_u.iter().map(move |&a| a * b)).collect();
        Scaled { degree, coefficients }
    }

    /// The product.
    pub fn product(&self, other: &Self) -> Self
    where
        S: Coefficient,
    {
        S::product(self, other)
    }

    fn zip(&self, other: &Self, f: impl Fn(S, S) -> S) -> Self {
        assert_eq!(
            self.degree, other.degree,
            "only polynomials of equal degrees are combined by coefficient"
        );
        let pairs = self.coefficients.iter().zip(&other.coefficients);
        Scaled {
            degree: self.degree,
            coefficients: pairs.map(|(&a, &b)| f(a, b)).collect(),
        }
    }

    /// The sum of two polynomials of equal degrees.
    pub fn plus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    /// The difference of two polynomials of equal degrees.
    pub fn minus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    /// The coefficients without the binomials.
    pub fn unscaled(&self) -> Polynomial<S> {
        let [m, n] = self.degree;
        let (in_u, in_v) = (binomials::<S>(m), binomials::<S>(n));
        let rows = self.coefficients.chunks(m + 1).zip(&in_v);
        let coefficients = rows
            .flat_map(|(row, &b)| row.iter().zip(&in_u).map(move |(&c, &a)| c / (a * b)))
            .collect();
        Polynomial {
            degree: self.degree,
            coefficients,
        }
    }
}

/// The sum of values by weights.
fn combine<S: Scalar + Copy>(weights: &[S], values: impl Iterator<Item = S>) -> S {
    let mut sum = S::zero();
    for (&weight, value) in weights.iter().zip(values) {
        sum += weight * value;
    }
    sum
}

/// The binomials of a row of Pascal's triangle, by sums: exact up to `2^53` in doubles, and enclosed beyond in intervals.
fn binomials<S: Scalar + Copy>(n: usize) -> Vec<S> {
    let mut row = vec![S::one()];
    for _ in 0..n {
        for i in (1..row.len()).rev() {
            row[i] = row[i] + row[i - 1];
        }
        row.push(S::one());
    }
    row
}

/// The two halves of a univariate polynomial.
pub(super) fn halves<S: Scalar + Copy>(coefficients: &[S]) -> [Vec<S>; 2] {
    let half = S::ratio(1, 2);
    let mut rest = coefficients.to_vec();
    let (mut left, mut right) = (Vec::with_capacity(rest.len()), Vec::with_capacity(rest.len()));
    while let (Some(&first), Some(&last)) = (rest.first(), rest.last()) {
        left.push(first);
        right.push(last);
        for i in 1..rest.len() {
            rest[i - 1] = half * (rest[i - 1] + rest[i]);
        }
        rest.pop();
    }
    right.reverse();
    [left, right]
}

fn value<S: Scalar + Copy>(mut coefficients: Vec<S>, t: S) -> S {
    let rest = S::one() - t;
    for count in (1..coefficients.len()).rev() {
        for i in 0..count {
            coefficients[i] = rest * coefficients[i] + t * coefficients[i + 1];
        }
    }
    coefficients[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Interval;
    use crate::interval::oracle::Operands;
    use eigenring_spectral::{TensorPatch, bspline::to_bernstein};
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn polynomial(degree: usize, seed: f64) -> Polynomial<f64> {
        let control: Vec<f64> = (0..(degree + 1).pow(2))
            .map(|i| (seed * (i as f64 + 1.7)).sin())
            .collect();
        Polynomial::from_control(&control, &to_bernstein(degree))
    }

    proptest! {
        #[test]
        fn algebra_is_that_of_values(d in 2..6_usize, e in 1..5_usize, seed in 0.1..3.0_f64, u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
            let (f, g) = (polynomial(d, seed), polynomial(e, seed + 1.0));
            let product = f.by_u().scaled().product(&g.scaled()).unscaled();
            prop_assert!((product.value(u, v) - f.by_u().value(u, v) * g.value(u, v)).abs() < 1e-12);
            let raised = f.scaled().product(&Scaled::one([e, 2])).unscaled();
            prop_assert!((raised.value(u, v) - f.value(u, v)).abs() < 1e-13);
            let sum = f.plus(&f.times(3.0)).minus(&f);
            prop_assert!((sum.value(u, v) - 3.0 * f.value(u, v)).abs() < 1e-13);
            let quarters = f.quarters();
            for (index, quarter) in quarters.iter().enumerate() {
                let (a, b) = (f64::from(index as u32 % 2), f64::from(index as u32 / 2));
                prop_assert!((quarter.value(u, v) - f.value((a + u) / 2.0, (b + v) / 2.0)).abs() < 1e-14);
            }
            for (corner, (u, v)) in f.corners().into_iter().zip([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]) {
                prop_assert_eq!(corner, f.value(u, v));
            }
        }

        #[test]
        fn patches_and_their_derivatives(d in 2..7_usize, seed in 0.1..3.0_f64, u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
            let control: Vec<f64> = (0..(d + 1).pow(2)).map(|i| (seed * (i as f64 + 1.7)).sin()).collect();
            let jet = TensorPatch { degree: d, control: control.clone() }.jet(u, v);
            let f = Polynomial::from_control(&control, &to_bernstein(d));
            prop_assert!((f.value(u, v) - jet.value).abs() < 1e-13);
            prop_assert!((f.by_u().value(u, v) - jet.first[0]).abs() < 1e-12);
            prop_assert!((f.by_v().value(u, v) - jet.first[1]).abs() < 1e-12);
            prop_assert!((f.by_u().by_v().value(u, v) - jet.second[1]).abs() < 1e-11);
            prop_assert!((f.by_v().by_v().value(u, v) - jet.second[2]).abs() < 1e-11);
            // the same in intervals holds the value
            let points: Vec<Interval> = control.iter().map(|&c| Interval::point(c)).collect();
            let g = Polynomial::from_control(&points, &to_bernstein(d));
            let value = g.value(Interval::point(u), Interval::point(v));
            prop_assert!((value.mid() - jet.value).abs() < 1e-13 && value.width() < 1e-12);
        }
    }

    fn rational(value: f64) -> BigRational {
        BigRational::from_float(value).expect("finite")
    }

    /// The value of a Bernstein form in exact arithmetic, by its definition.
    fn exact_value([m, n]: [usize; 2], coefficients: &[f64], [u, v]: [f64; 2]) -> BigRational {
        let basis = |degree: usize, t: f64| -> Vec<BigRational> {
            let (t, rest) = (rational(t), rational(1.0) - rational(t));
            let power = |x: &BigRational, e: usize| (0..e).fold(rational(1.0), |product, _| product * x);
            let binomials = binomials::<f64>(degree).into_iter().map(rational).enumerate();
            binomials
                .map(|(i, b)| b * power(&t, i) * power(&rest, degree - i))
                .collect()
        };
        let (in_u, in_v) = (basis(m, u), basis(n, v));
        let rows = coefficients.chunks(m + 1).zip(&in_v);
        rows.flat_map(|(row, b)| row.iter().zip(&in_u).map(move |(&c, a)| rational(c) * a * b))
            .sum()
    }

    fn holds(interval: Interval, exact: &BigRational) -> bool {
        let low = interval.lo() == f64::NEG_INFINITY || rational(interval.lo()) <= *exact;
        low && (interval.hi() == f64::INFINITY || *exact <= rational(interval.hi()))
    }

    /// What a proof of a sign rests on: on every part the values lie between the coefficients, those at its
    /// corners are values, and raising the degree, products and derivatives are those of the function, at all
    /// sizes of coefficients.
    #[test]
    fn coefficients_of_parts_bound_the_values_there() {
        let mut operands = Operands::new(21);
        for round in 0..300 {
            let degree = [1 + operands.below(4), 1 + operands.below(4)];
            let count = (degree[0] + 1) * (degree[1] + 1);
            let mut number = || match round % 3 {
                0 => operands.fraction() * operands.sign(),
                1 => f64::from_bits(operands.bits() >> (12 + operands.below(40))) * operands.sign(),
                _ => operands.double().clamp(-1e150, 1e150),
            };
            let members: Vec<f64> = (0..count).map(|_| number()).collect();
            let mut around = |x: f64| match operands.below(3) {
                0 => Interval::around(x, x.abs() * operands.fraction() * 1e-3),
                _ => Interval::point(x),
            };
            let f = Polynomial {
                degree,
                coefficients: members.iter().map(|&x| around(x)).collect(),
            };
            let raised = f.scaled().product(&Scaled::one([2, 3])).unscaled();
            let square = f.scaled().product(&f.scaled()).unscaled();
            for (which, part) in f.quarters().iter().enumerate() {
                let corner = [(which % 2) as f64 / 2.0, (which / 2) as f64 / 2.0];
                let hull = part
                    .coefficients()
                    .iter()
                    .copied()
                    .reduce(Interval::hull)
                    .expect("some");
                for at in 0..6 {
                    let t = match at {
                        0..4 => [(at % 2) as f64, (at / 2) as f64],
                        _ => [operands.below(17) as f64 / 16.0, operands.below(17) as f64 / 16.0],
                    };
                    let at_point = [corner[0] + t[0] / 2.0, corner[1] + t[1] / 2.0];
                    let exact = exact_value(degree, &members, at_point);
                    let [u, v] = t.map(Interval::point);
                    assert!(
                        holds(hull, &exact) && holds(part.value(u, v), &exact),
                        "{f:?} {at_point:?}"
                    );
                    if at < 4 {
                        assert!(holds(part.corners()[at], &exact));
                    }
                    let [u, v] = at_point.map(Interval::point);
                    assert!(
                        holds(f.value(u, v), &exact) && holds(raised.value(u, v), &exact),
                        "{f:?} {at_point:?}"
                    );
                    assert!(holds(square.value(u, v), &(&exact * &exact)), "{f:?} {at_point:?}");
                }
            }
            // differences of values of a polynomial that is linear in u are derivatives
            if degree[0] == 1 {
                let v = operands.below(9) as f64 / 8.0;
                let slope = exact_value(degree, &members, [1.0, v]) - exact_value(degree, &members, [0.0, v]);
                assert!(holds(f.by_u().value(Interval::point(0.5), Interval::point(v)), &slope));
            }
        }
    }

    #[test]
    fn binomials_of_large_rows_are_enclosed() {
        assert_eq!(binomials::<f64>(5), [1.0, 5.0, 10.0, 10.0, 5.0, 1.0]);
        // C(128, 64) = 23951146041928082866135587776380551750
        let middle = binomials::<Interval>(128)[64];
        let exact = Interval::parse("23951146041928082866135587776380551750").expect("a decimal");
        assert!(middle.encloses(exact) && middle.width() < 1e-12 * middle.mid());
    }
}
