//! Several Gauss points at a time.
//!
//! All points run through the same formulas, so the evaluation handles [`WIDTH`] of them in one array; the compiler turns
//! the arrays into vector registers without any target flag.

use eigenring_scheme::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Points per block; see the measurement in `benches/objective.rs`.
pub(super) const WIDTH: usize = 4;

/// One number for each of [`WIDTH`] points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lanes(pub [f64; WIDTH]);

impl Lanes {
    pub const ZERO: Lanes = Lanes([0.0; WIDTH]);

    #[inline(always)]
    pub fn splat(value: f64) -> Self {
        Lanes([value; WIDTH])
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Lanes(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Lanes(self.0.map(f64::abs))
    }

    /// Lane by lane, `yes` where `self` is not negative and `no` elsewhere.
    #[inline(always)]
    pub fn select_non_negative(self, yes: Self, no: Self) -> Self {
        Lanes(std::array::from_fn(
            |i| {
                if self.0[i] >= 0.0 { yes.0[i] } else { no.0[i] }
            },
        ))
    }

    /// The sum of the lanes, in index order.
    pub fn sum(self) -> f64 {
        self.0.iter().sum()
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Mul<f64> for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * Lanes::splat(factor)
    }
}

impl Div for Lanes {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(self.0.map(|a| -a))
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Scalar for Lanes {
    fn ratio(p: i64, q: i64) -> Self {
        Lanes::splat(f64::ratio(p, q))
    }

    #[inline(always)]
    fn exact(value: f64) -> Self {
        Lanes::splat(value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes(self.0.map(f64::sqrt))
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        Lanes::splat(f64::cos_turn(k, n))
    }

    #[inline(always)]
    fn zero() -> Self {
        Lanes::ZERO
    }
}
