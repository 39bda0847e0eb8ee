//! The number type of rules and closed forms.
//!
//! A scheme's weights, its small solves and its patches are written once, over [`Scalar`], and then run with
//! `f64` (numerics), [`Dual`](crate::Dual) (exact derivatives), exact numbers (equalities), intervals
//! (proofs) or combinations. Scalars are deliberately **not ordered**: an interval cannot always say which of
//! two numbers is larger, so every branch is decided in `f64` by the caller and passed in. What they can say
//! is whether two of them are known to be [the same](Same), which is what symmetry and the degree of the
//! regular part are derived from.

use num_rational::BigRational;
use num_traits::ToPrimitive;
use std::cell::Cell;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A weight that can tell whether another one is known to be the same number.
pub trait Same: Clone {
    /// Whether both are known to be the same number. False says nothing: two enclosures of one number that is
    /// not representable are not known to be the same.
    fn same(&self, other: &Self) -> bool;
}

impl Same for f64 {
    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

/// A field with square roots and the cosines of rational turns; see the module page for why there is no
/// ordering.
pub trait Scalar:
    Same
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
    /// A rational number of any size, as exactly as the type allows.
    fn rational(value: &BigRational) -> Self;

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
    #[inline]
    fn ratio(p: i64, q: i64) -> Self {
        p as f64 / q as f64
    }

    #[inline]
    fn exact(value: f64) -> Self {
        value
    }

    /// The nearest double; infinite beyond the largest.
    fn rational(value: &BigRational) -> Self {
        nearest(value)
    }

    #[inline]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    /// Folded into the first octant first, so that symmetric turns give equal magnitudes, and multiples of a
    /// quarter turn and of a sixth give 0, 1/2 and 1 exactly. Each thread remembers some: tuning asks for the
    /// same few a million times.
    fn cos_turn(k: i64, n: i64) -> Self {
        KNOWN_TURNS.with(|known| {
            let slot = &known[(k.wrapping_mul(31).wrapping_add(n) as usize) % known.len()];
            let (of, parts, value) = slot.get();
            if (of, parts) == (k, n) {
                return value;
            }
            let value = cosine_of_turn(k, n);
            slot.set((k, n, value));
            value
        })
    }
}

thread_local! {
    /// k, n and `cos(2 pi k / n)`; at first n = 0, which nobody asks for.
    static KNOWN_TURNS: [Cell<(i64, i64, f64)>; 64] = const { [const { Cell::new((i64::MIN, 0, f64::NAN)) }; 64] };
}

fn cosine_of_turn(k: i64, n: i64) -> f64 {
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

/// The double nearest to a rational number, of two equally near ones the even one.
fn nearest(value: &BigRational) -> f64 {
    let rough = value.to_f64().unwrap_or(f64::NAN);
    if !rough.is_finite() {
        return rough;
    }
    // the conversion may be off by one place: compare with the neighbours, exactly
    let distance = |candidate: f64| {
        BigRational::from_float(candidate).map(|exact| {
            let difference = exact - value;
            if difference < BigRational::from_integer(0.into()) {
                -difference
            } else {
                difference
            }
        })
    };
    let even = |candidate: f64| candidate.to_bits() & 1;
    [rough, rough.next_down(), rough.next_up()]
        .into_iter()
        .filter_map(|candidate| distance(candidate).map(|distance| (distance, even(candidate), candidate)))
        .min_by(|a, b| a.0.cmp(&b.0).then(a.1.cmp(&b.1)))
        .map_or(rough, |(_, _, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rational_numbers_become_the_nearest_double() {
        for p in -40..40_i64 {
            for q in 1..40_i64 {
                assert_eq!(
                    f64::rational(&BigRational::new(p.into(), q.into())),
                    p as f64 / q as f64
                );
            }
        }
    }

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
