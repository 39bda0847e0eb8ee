//! Forward derivatives: a value together with its derivatives in `D` directions.

use crate::{Same, Scalar};
use num_rational::BigRational;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// `value + sum_j parts[j] eps_j` with `eps_i eps_j = 0`: running a formula on duals gives its value and its
/// exact derivatives in `D` directions. The inner scalar may be an interval, which gives mean-value
/// enclosures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S, const D: usize = 1> {
    /// The value of the function.
    pub value: S,
    /// The derivatives, one per direction.
    pub parts: [S; D],
}

impl<S: Scalar + Copy, const D: usize> Dual<S, D> {
    /// A constant: all derivatives zero.
    pub fn constant(value: S) -> Self {
        Dual {
            value,
            parts: [S::zero(); D],
        }
    }

    /// The independent variable of the given direction: derivative one there, zero elsewhere.
    pub fn variable(value: S, direction: usize) -> Self {
        let mut dual = Self::constant(value);
        dual.parts[direction] = S::one();
        dual
    }

    #[inline]
    fn zip(self, other: Self, value: S, part: impl Fn(S, S) -> S) -> Self {
        let mut parts = self.parts;
        for (p, q) in parts.iter_mut().zip(other.parts) {
            *p = part(*p, q);
        }
        Dual { value, parts }
    }
}

impl<S: Scalar + Copy, const D: usize> Add for Dual<S, D> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip(other, self.value + other.value, |p, q| p + q)
    }
}

impl<S: Scalar + Copy, const D: usize> Sub for Dual<S, D> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.zip(other, self.value - other.value, |p, q| p - q)
    }
}

impl<S: Scalar + Copy, const D: usize> Mul for Dual<S, D> {
    type Output = Self;
    #[inline]
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        self.zip(other, a * b, |p, q| p * b + a * q)
    }
}

impl<S: Scalar + Copy, const D: usize> Div for Dual<S, D> {
    type Output = Self;
    #[inline]
    #[expect(
        clippy::suspicious_arithmetic_impl,
        reason = "the quotient rule subtracts and multiplies"
    )]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        self.zip(other, quotient, |p, q| (p - quotient * q) / other.value)
    }
}

impl<S: Scalar + Copy, const D: usize> Neg for Dual<S, D> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Dual {
            value: -self.value,
            parts: self.parts.map(|p| -p),
        }
    }
}

impl<S: Scalar + Copy, const D: usize> AddAssign for Dual<S, D> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Scalar + Copy, const D: usize> SubAssign for Dual<S, D> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<S: Same, const D: usize> Same for Dual<S, D> {
    fn same(&self, other: &Self) -> bool {
        let pairs = self.parts.iter().zip(&other.parts);
        self.value.same(&other.value) && pairs.fold(true, |all, (p, q)| all && p.same(q))
    }
}

impl<S: Scalar + Copy, const D: usize> Scalar for Dual<S, D> {
    fn ratio(p: i64, q: i64) -> Self {
        Self::constant(S::ratio(p, q))
    }

    fn exact(value: f64) -> Self {
        Self::constant(S::exact(value))
    }

    fn rational(value: &BigRational) -> Self {
        Self::constant(S::rational(value))
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Dual {
            value: root,
            parts: self.parts.map(|p| p / (root + root)),
        }
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        Self::constant(S::cos_turn(k, n))
    }

    fn sin_turn(k: i64, n: i64) -> Self {
        Self::constant(S::sin_turn(k, n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn formula<S: Scalar + Copy>(x: S, y: S) -> S {
        let mut sum = (x * y - S::ratio(1, 3)) / (x + y * y) + (x * x + y).sqrt();
        sum += S::cos_turn(1, 5) * y;
        sum -= -x;
        sum
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_central_differences(x in 0.5..2.0_f64, y in 0.5..2.0_f64) {
            let dual = formula(Dual::<f64, 2>::variable(x, 0), Dual::variable(y, 1));
            // the optimal step of central differences is the cube root of the rounding unit
            let step = 6e-6;
            let dx = (formula(x + step, y) - formula(x - step, y)) / (2.0 * step);
            let dy = (formula(x, y + step) - formula(x, y - step)) / (2.0 * step);
            prop_assert_eq!(dual.value, formula(x, y));
            prop_assert!((dual.parts[0] - dx).abs() < 1e-8);
            prop_assert!((dual.parts[1] - dy).abs() < 1e-8);
        }
    }

    #[test]
    fn nested_duals_give_second_derivatives() {
        let x = Dual::<Dual<f64>>::variable(Dual::variable(3.0, 0), 0);
        let cube = x * x * x;
        assert_eq!(cube.parts[0].parts[0], 18.0);
    }
}
