//! The number type of rules and closed forms.
//!
//! A scheme's weights, its small solves and its patches are written once, over [`Scalar`], and then run with `f64`
//! (numerics), [`Dual`](crate::Dual) (exact derivatives), intervals (proofs) or both combined. Scalars are deliberately
//! **not comparable**: an interval cannot always say which of two numbers is larger, so every branch is decided in `f64`
//! by the caller and passed in.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A field with square roots and the cosines of rational turns; see the module page for why there is no ordering.
pub trait Scalar:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// The number `p / q`, as exactly as the type allows. `q` must not be zero.
    fn ratio(p: i64, q: i64) -> Self;

    /// The given double, taken as the exact number it represents.
    fn exact(value: f64) -> Self;

    /// Square root of a non-negative number.
    fn sqrt(self) -> Self;

    /// `cos(2 pi k / n)`. `n` must not be zero.
    fn cos_turn(k: i64, n: i64) -> Self;

    /// `sin(2 pi k / n)`, by default from [`Scalar::cos_turn`] a quarter turn earlier.
    fn sin_turn(k: i64, n: i64) -> Self {
        Self::cos_turn(4 * k - n, 4 * n)
    }

    /// The additive unit; an exact zero in every implementation.
    fn zero() -> Self {
        Self::ratio(0, 1)
    }

    /// The multiplicative unit; an exact one in every implementation.
    fn one() -> Self {
        Self::ratio(1, 1)
    }
}

impl Scalar for f64 {
    fn ratio(p: i64, q: i64) -> Self {
        p as f64 / q as f64
    }

    fn exact(value: f64) -> Self {
        value
    }

    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    /// Folded into the first octant first, so that symmetric turns give equal magnitudes, and multiples of a quarter turn
    /// and of a sixth give 0, 1/2 and 1 exactly.
    fn cos_turn(k: i64, n: i64) -> Self {
        let n = n.unsigned_abs() as u128;
        // the turn in units of 1/(12 n), folded to [0, 1/2] by evenness
        let mut turn = (k.unsigned_abs() as u128 % n) * 12;
        if turn > 6 * n {
            turn = 12 * n - turn;
        }
        let (sign, turn) = if turn > 3 * n {
            (-1.0, 6 * n - turn)
        } else {
            (1.0, turn)
        };
        let angle = |turn: u128| std::f64::consts::TAU * (turn as f64 / (12 * n) as f64);
        sign * if turn == 3 * n {
            0.0
        } else if turn == 2 * n {
            0.5
        } else if 2 * turn > 3 * n {
            angle(3 * n - turn).sin()
        } else {
            angle(turn).cos()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosines_are_exact_where_they_are_rational() {
        for n in 1..40_i64 {
            assert_eq!(f64::cos_turn(0, n), 1.0);
            assert_eq!(f64::cos_turn(n, 2 * n), -1.0);
            assert_eq!(f64::cos_turn(n, 4 * n), 0.0);
            assert_eq!(f64::cos_turn(n, 6 * n), 0.5);
            assert_eq!(f64::cos_turn(n, 3 * n), -0.5);
            assert_eq!(f64::sin_turn(n, 4 * n), 1.0);
            assert_eq!(f64::sin_turn(n, 12 * n), 0.5);
        }
    }

    #[test]
    fn cosines_are_those_of_the_library_and_symmetric() {
        for n in 1..60_i64 {
            for k in -2 * n..=2 * n {
                let angle = std::f64::consts::TAU * k as f64 / n as f64;
                // the direct evaluation loses an ulp of the angle, up to 4 pi
                assert!((f64::cos_turn(k, n) - angle.cos()).abs() < 4e-15);
                assert!((f64::sin_turn(k, n) - angle.sin()).abs() < 4e-15);
                assert_eq!(f64::cos_turn(k, n), f64::cos_turn(-k, n));
                assert_eq!(f64::cos_turn(k, n), f64::cos_turn(n - k, n));
                assert_eq!(f64::sin_turn(k, n), -f64::sin_turn(-k, n));
            }
        }
    }
}
