//! Several Gauss points at a time.
//!
//! All points run through the same formulas, so the evaluation handles [`WIDTH`] of them in one array; the
//! compiler turns the arrays into vector registers of the processor that it runs on (see `evaluate`).

use eigenring_spline::{BigRational, Same, Scalar};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Points per block: what one register of the baseline of x86-64 and of aarch64 holds. Wider blocks have been
/// measured and lose to the spilling of registers.
pub(super) const WIDTH: usize = 2;

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
    fn zip(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for (a, b) in self.0.iter_mut().zip(other.0) {
            *a = f(*a, b);
        }
        self
    }
}

/// A sum over all points, in two parts: those of points with even and with odd numbers. Its bits do not
/// depend on how many points are a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Total([f64; 2]);

impl Total {
    pub const ZERO: Total = Total([0.0; 2]);

    /// The sum of both parts.
    pub fn sum(self) -> f64 {
        self.0[0] + self.0[1]
    }
}

impl Total {
    /// Adds all terms of a point before those of the next.
    #[inline(always)]
    pub fn add(&mut self, terms: &[Lanes]) {
        for pair in 0..WIDTH / 2 {
            for term in terms {
                self.0[0] += term.0[2 * pair];
                self.0[1] += term.0[2 * pair + 1];
            }
        }
    }
}

impl AddAssign<Lanes> for Total {
    #[inline(always)]
    fn add_assign(&mut self, lanes: Lanes) {
        self.add(&[lanes]);
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
        self * -1.0
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

impl Same for Lanes {
    fn same(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl Scalar for Lanes {
    fn rational(value: &BigRational) -> Self {
        Lanes([f64::rational(value); WIDTH])
    }

    fn ratio(p: i64, q: i64) -> Self {
        Lanes::splat(f64::ratio(p, q))
    }

    #[inline(always)]
    fn exact(value: f64) -> Self {
        Lanes::splat(value)
    }

    fn sqrt(self) -> Self {
        self.zip(Lanes::ZERO, |a, _| a.sqrt())
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        Lanes::splat(f64::cos_turn(k, n))
    }

    #[inline(always)]
    fn zero() -> Self {
        Lanes::ZERO
    }
}
