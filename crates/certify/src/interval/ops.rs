//! The field operations, roots and powers of intervals, and the scalar of the schemes they make.

use super::{Interval, round, turn};
use eigenring_spline::{Same, Scalar};
use num_rational::BigRational;
use num_traits::ToPrimitive;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::spanning(round::sum(self.lo, other.lo).0, round::sum(self.hi, other.hi).1)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self::spanning(-self.hi, -self.lo)
    }
}

impl Mul for Interval {
    type Output = Self;
    /// The bounds are those of two products picked by the signs; only two factors that both hold zero inside
    /// need four.
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        if a.is_zero() || b.is_zero() {
            return Self::point(0.0);
        }
        let span = |low: (f64, f64), high: (f64, f64)| {
            Self::spanning(round::product(low.0, low.1).0, round::product(high.0, high.1).1)
        };
        match (a.lo >= 0.0, a.hi <= 0.0, b.lo >= 0.0, b.hi <= 0.0) {
            (true, _, true, _) => span((a.lo, b.lo), (a.hi, b.hi)),
            (true, _, _, true) => span((a.hi, b.lo), (a.lo, b.hi)),
            (true, ..) => span((a.hi, b.lo), (a.hi, b.hi)),
            (_, true, true, _) => span((a.lo, b.hi), (a.hi, b.lo)),
            (_, true, _, true) => span((a.hi, b.hi), (a.lo, b.lo)),
            (_, true, ..) => span((a.lo, b.hi), (a.lo, b.lo)),
            (_, _, true, _) => span((a.lo, b.hi), (a.hi, b.hi)),
            (_, _, _, true) => span((a.hi, b.lo), (a.lo, b.lo)),
            _ => span((a.lo, b.hi), (a.hi, b.hi)).hull(span((a.hi, b.lo), (a.lo, b.lo))),
        }
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.contains_zero() {
            return Self::ENTIRE;
        }
        let (a, b) = if other.lo > 0.0 { (self, other) } else { (-self, -other) };
        let low = if a.lo >= 0.0 { b.hi } else { b.lo };
        let high = if a.hi >= 0.0 { b.lo } else { b.hi };
        Self::spanning(round::quotient(a.lo, low).0, round::quotient(a.hi, high).1)
    }
}

impl AddAssign for Interval {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Interval {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Interval {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl std::iter::Sum for Interval {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::point(0.0), Add::add)
    }
}

impl Interval {
    /// The magnitudes of the members.
    pub fn abs(self) -> Self {
        Self::spanning(self.mig(), self.mag())
    }

    /// The squares of the members, never negative: sharper than a product, which takes its factors for
    /// independent.
    pub fn square(self) -> Self {
        let size = self.abs();
        size * size
    }

    /// The powers of the members with a non-negative exponent, sharp in sign.
    pub fn powi(self, exponent: u32) -> Self {
        if exponent % 2 == 1 {
            // odd powers increase, so each bound comes from its own end
            let end = |bound: f64| Self::point(bound) * Self::point(bound).powi(exponent - 1);
            if self.is_bounded() {
                end(self.lo).hull(end(self.hi))
            } else {
                self * self.powi(exponent - 1)
            }
        } else if exponent == 0 {
            Self::point(1.0)
        } else {
            self.square().powi(exponent / 2)
        }
    }

    /// The square roots of the members; [`Interval::ENTIRE`] where a member may be negative.
    pub fn sqrt(self) -> Self {
        if self.lo < 0.0 {
            return Self::ENTIRE;
        }
        Self::spanning(round::root(self.lo).0, round::root(self.hi).1)
    }
}

impl Same for Interval {
    /// Two points that are equal; of wider intervals nothing is known.
    fn same(&self, other: &Self) -> bool {
        self.is_point() && self == other
    }
}

impl Scalar for Interval {
    fn ratio(p: i64, q: i64) -> Self {
        Self::integer(p) / Self::integer(q)
    }

    fn rational(value: &BigRational) -> Self {
        let Some(near) = value.to_f64().filter(|near| near.is_finite()) else {
            return Interval::ENTIRE;
        };
        // the nearest double, or one close to it: widen until the exact comparison agrees
        let (mut lo, mut hi) = (near, near);
        let exact = BigRational::from_float;
        while exact(lo).is_some_and(|bound| bound > *value) {
            lo = lo.next_down();
        }
        while exact(hi).is_some_and(|bound| bound < *value) {
            hi = hi.next_up();
        }
        Interval::new(lo, hi).unwrap_or(Interval::ENTIRE)
    }

    fn exact(value: f64) -> Self {
        Self::point(value)
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        turn::cos_turn(k.into(), n.into())
    }

    fn sin_turn(k: i64, n: i64) -> Self {
        // a quarter turn is added in 128 bits, where the default could overflow
        turn::cos_turn(4 * i128::from(k) - i128::from(n), 4 * i128::from(n))
    }
}
