//! Polynomials in Bernstein form: halves and values of one variable, and the algebra of two on the unit
//! square.
//!
//! `f(u, v) = sum_ij b_ij B_i^m(u) B_j^n(v)`. The Bernstein polynomials are non-negative and sum to one, so
//! the values lie between the smallest and the largest coefficient, and the coefficients at the corners are
//! values. On the halves of the square the bounds are sharper, with an error that falls quadratically with
//! the size (Garloff 1986).
//!
//! Coefficients are stored with `i` (the degree in u) running fastest. With `b_ij` scaled by the binomials
//! `C(m, i) C(n, j)` a product is a convolution (Farouki and Rajan 1988).

use crate::{Dual, Scalar};

/// A polynomial of two variables in Bernstein form, see the module page.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial<S> {
    /// The degrees in u and in v.
    degree: [usize; 2],
    coefficients: Vec<S>,
}

impl<S: Scalar + Copy> Polynomial<S> {
    /// The polynomial with the given coefficients: `f(i, j)` for index i in u and j in v.
    pub fn from_fn(degree: [usize; 2], mut f: impl FnMut(usize, usize) -> S) -> Self {
        Polynomial {
            degree,
            coefficients: table(degree, &mut f),
        }
    }

    /// The polynomial of a tensor-product spline patch with `(d+1)^2` control values, from the conversion
    /// matrix of its degree ([`to_bernstein`](crate::uniform::to_bernstein)).
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

    /// The degrees in u and in v.
    pub fn degree(&self) -> [usize; 2] {
        self.degree
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
        if m == 0 {
            return self.times(S::zero());
        }
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
        if n == 0 {
            return self.times(S::zero());
        }
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

    /// The sum of two polynomials.
    ///
    /// # Panics
    /// For different degrees.
    pub fn plus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    /// The difference of two polynomials.
    ///
    /// # Panics
    /// For different degrees.
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

    /// The four quarters of the square, each as a polynomial on the unit square: first half in u and v,
    /// second half in u, second half in v, both second halves.
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
    degree: [usize; 2],
    coefficients: Vec<S>,
}

/// A scalar that can be the coefficient of a product. An implementation may have a faster way than
/// [`convolution`] for it.
pub trait Coefficient: Scalar + Copy {
    /// The product of two polynomials with coefficients scaled by binomials.
    fn product(a: &Scaled<Self>, b: &Scaled<Self>) -> Scaled<Self> {
        convolution(a, b)
    }
}

impl Coefficient for f64 {}
impl<S: Scalar + Copy, const D: usize> Coefficient for Dual<S, D> {}

/// The product of two polynomials with coefficients scaled by binomials, as a convolution.
pub fn convolution<S: Scalar + Copy>(a: &Scaled<S>, b: &Scaled<S>) -> Scaled<S> {
    let ([m, n], [p, q]) = (a.degree, b.degree);
    let width = m + p + 1;
    let mut coefficients = vec![S::zero(); width * (n + q + 1)];
    for (j, row) in a.coefficients.chunks(m + 1).enumerate() {
        for (l, other) in b.coefficients.chunks(p + 1).enumerate() {
            let sums = &mut coefficients[(j + l) * width..][..width];
            for (i, &value) in row.iter().enumerate() {
                for (sum, &factor) in sums[i..].iter_mut().zip(other) {
                    *sum += value * factor;
                }
            }
        }
    }
    Scaled {
        degree: [m + p, n + q],
        coefficients,
    }
}

impl<S: Copy> Scaled<S> {
    /// The polynomial with the given coefficients: `f(i, j)` for index i in u and j in v.
    pub fn from_fn(degree: [usize; 2], mut f: impl FnMut(usize, usize) -> S) -> Self {
        Scaled {
            degree,
            coefficients: table(degree, &mut f),
        }
    }

    /// The degrees in u and in v.
    pub fn degree(&self) -> [usize; 2] {
        self.degree
    }

    /// The coefficients, the index in u running fastest.
    pub fn coefficients(&self) -> &[S] {
        &self.coefficients
    }

    /// The coefficients with another scalar.
    pub fn map<T>(&self, f: impl FnMut(S) -> T) -> Scaled<T> {
        Scaled {
            degree: self.degree,
            coefficients: self.coefficients.iter().copied().map(f).collect(),
        }
    }

    /// Coefficient by coefficient.
    ///
    /// # Panics
    /// For different degrees.
    pub fn zip<T: Copy, U>(&self, other: &Scaled<T>, mut f: impl FnMut(S, T) -> U) -> Scaled<U> {
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

    /// The sum of two polynomials.
    ///
    /// # Panics
    /// For different degrees.
    pub fn plus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    /// The difference of two polynomials.
    ///
    /// # Panics
    /// For different degrees.
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

/// Numbers by two indices, the first running fastest.
fn table<S>([m, n]: [usize; 2], f: &mut impl FnMut(usize, usize) -> S) -> Vec<S> {
    let mut values = Vec::with_capacity((m + 1) * (n + 1));
    for j in 0..=n {
        values.extend((0..=m).map(|i| f(i, j)));
    }
    values
}

/// The sum of values by weights.
fn combine<S: Scalar + Copy>(weights: &[S], values: impl Iterator<Item = S>) -> S {
    let mut sum = S::zero();
    for (&weight, value) in weights.iter().zip(values) {
        sum += weight * value;
    }
    sum
}

/// The binomials of a row of Pascal's triangle, by sums: exact up to `2^53` in doubles, and enclosed beyond
/// in intervals.
pub fn binomials<S: Scalar + Copy>(n: usize) -> Vec<S> {
    let mut row = vec![S::one()];
    for _ in 0..n {
        for i in (1..row.len()).rev() {
            row[i] = row[i] + row[i - 1];
        }
        row.push(S::one());
    }
    row
}

/// The two halves of a polynomial of one variable, each on the unit interval: the algorithm of de Casteljau
/// at 1/2.
pub fn halves<S: Scalar + Copy>(coefficients: &[S]) -> [Vec<S>; 2] {
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

/// The value at t of a polynomial of one variable, by the algorithm of de Casteljau; zero without
/// coefficients.
pub fn value<S: Scalar + Copy>(mut coefficients: Vec<S>, t: S) -> S {
    let rest = S::one() - t;
    for count in (1..coefficients.len()).rev() {
        for i in 0..count {
            coefficients[i] = rest * coefficients[i] + t * coefficients[i + 1];
        }
    }
    coefficients.first().copied().unwrap_or(S::zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TensorPatch;
    use crate::uniform::to_bernstein;
    use proptest::prelude::*;

    fn control(degree: usize, seed: f64) -> Vec<f64> {
        let count = (degree + 1).pow(2);
        (0..count).map(|i| (seed * (i as f64 + 1.7)).sin()).collect()
    }

    fn polynomial(degree: usize, seed: f64) -> Polynomial<f64> {
        Polynomial::from_control(&control(degree, seed), &to_bernstein(degree))
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
            let patch = TensorPatch { degree: d, control: control(d, seed) };
            let (jet, f) = (patch.jet(u, v), patch.bernstein());
            prop_assert!((f.value(u, v) - jet.value).abs() < 1e-13);
            prop_assert!((f.by_u().value(u, v) - jet.first[0]).abs() < 1e-12);
            prop_assert!((f.by_v().value(u, v) - jet.first[1]).abs() < 1e-12);
            prop_assert!((f.by_u().by_v().value(u, v) - jet.second[1]).abs() < 1e-11);
            prop_assert!((f.by_v().by_v().value(u, v) - jet.second[2]).abs() < 1e-11);
        }
    }

    #[test]
    fn one_variable() {
        // B_1^3 = 3 t (1-t)^2
        let coefficients = [0.0, 1.0, 0.0, 0.0];
        for t in [0.0, 0.125, 0.5, 0.75, 1.0] {
            let expected = |t: f64| 3.0 * t * (1.0 - t) * (1.0 - t);
            assert_eq!(value(coefficients.to_vec(), t), expected(t));
            let [left, right] = halves(&coefficients);
            assert_eq!(value(left, t), expected(t / 2.0));
            assert_eq!(value(right, t), expected((1.0 + t) / 2.0));
        }
        assert_eq!(value::<f64>(Vec::new(), 0.5), 0.0);
        assert_eq!(binomials::<f64>(5), [1.0, 5.0, 10.0, 10.0, 5.0, 1.0]);
    }

    #[test]
    fn constants_have_no_slope() {
        let constant = Polynomial::from_fn([0, 0], |_, _| 2.0);
        assert_eq!(constant.by_u(), Polynomial::from_fn([0, 0], |_, _| 0.0));
        assert_eq!(constant.by_v(), constant.by_u());
    }
}
