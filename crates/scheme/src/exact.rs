//! Stencil weights as exact numbers.

use crate::{Same, Scalar};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// The parts of an [`Exact`] number: `rational + cosine cos(2 pi turn)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The rational part.
    pub rational: BigRational,
    /// The factor of the cosine; zero for a rational number.
    pub cosine: BigRational,
    /// The angle as a fraction `(k, n)` of a full turn, `0 <= 2k <= n`, in lowest terms; `(0, 1)` for a
    /// rational number.
    pub turn: (i64, i64),
}

/// The number `a + b cos(2 pi k/n)` with rational a and b of any size, or nothing: an operation that leaves
/// this set (a sum of two different cosines, a product of two, the root of a number that is not a square)
/// gives a number without value, and so does every operation with one.
///
/// All rational schemes and the original Doo-Sabin weights consist of such numbers. Symmetry and the degree
/// of the regular part are derived from them, and equalities are decided in them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exact(Option<Box<Parts>>);

impl Exact {
    /// The value, if it could be represented.
    pub fn parts(&self) -> Option<&Parts> {
        self.0.as_deref()
    }

    /// The value, if it is a rational number.
    pub fn as_rational(&self) -> Option<&BigRational> {
        self.parts()
            .filter(|parts| parts.cosine.is_zero())
            .map(|parts| &parts.rational)
    }

    /// The number in another type; `None` for a number without value.
    pub fn to<S: Scalar>(&self) -> Option<S> {
        let parts = self.parts()?;
        let rational = S::rational(&parts.rational);
        if parts.cosine.is_zero() {
            return Some(rational);
        }
        let (k, n) = parts.turn;
        Some(rational + S::rational(&parts.cosine) * S::cos_turn(k, n))
    }

    fn of(parts: Option<Parts>) -> Self {
        Exact(parts.map(|mut parts| {
            // a cosine with factor zero has no angle
            if parts.cosine.is_zero() {
                parts.turn = (0, 1);
            }
            Box::new(parts)
        }))
    }

    fn of_rational(value: Option<BigRational>) -> Self {
        Self::of(value.map(|rational| Parts {
            rational,
            cosine: BigRational::zero(),
            turn: (0, 1),
        }))
    }

    fn combine(self, other: Self, f: impl Fn(Parts, Parts) -> Option<Parts>) -> Self {
        match (self.0, other.0) {
            (Some(a), Some(b)) => Self::of(f(*a, *b)),
            _ => Exact(None),
        }
    }
}

impl Same for Exact {
    /// Two numbers without value are not known to be the same.
    fn same(&self, other: &Self) -> bool {
        self.0.is_some() && self == other
    }
}

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, |a, b| {
            let turn = match (a.cosine.is_zero(), b.cosine.is_zero()) {
                (true, _) => b.turn,
                (_, true) => a.turn,
                _ if a.turn == b.turn => a.turn,
                _ => return None,
            };
            Some(Parts {
                rational: a.rational + b.rational,
                cosine: a.cosine + b.cosine,
                turn,
            })
        })
    }
}

impl Neg for Exact {
    type Output = Self;
    fn neg(self) -> Self {
        Self::of(self.0.map(|a| Parts {
            rational: -a.rational,
            cosine: -a.cosine,
            turn: a.turn,
        }))
    }
}

impl Sub for Exact {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, |a, b| {
            let (factor, b) = match (a.cosine.is_zero(), b.cosine.is_zero()) {
                (true, _) => (a.rational, b),
                (_, true) => (b.rational, a),
                _ => return None,
            };
            Some(Parts {
                rational: &factor * b.rational,
                cosine: factor * b.cosine,
                turn: b.turn,
            })
        })
    }
}

impl Div for Exact {
    type Output = Self;
    #[expect(
        clippy::suspicious_arithmetic_impl,
        reason = "division by a rational number is multiplication"
    )]
    fn div(self, other: Self) -> Self {
        let divisor = other.as_rational().filter(|divisor| !divisor.is_zero());
        self * Self::of_rational(divisor.map(BigRational::recip))
    }
}

impl AddAssign for Exact {
    fn add_assign(&mut self, other: Self) {
        *self = self.clone() + other;
    }
}

impl SubAssign for Exact {
    fn sub_assign(&mut self, other: Self) {
        *self = self.clone() - other;
    }
}

impl Scalar for Exact {
    fn ratio(p: i64, q: i64) -> Self {
        let value = (q != 0).then(|| BigRational::new(p.into(), q.into()));
        Self::of_rational(value)
    }

    fn exact(value: f64) -> Self {
        Self::of_rational(BigRational::from_float(value))
    }

    fn rational(value: &BigRational) -> Self {
        Self::of_rational(Some(value.clone()))
    }

    fn sqrt(self) -> Self {
        let root = self
            .as_rational()
            .filter(|square| !square.is_negative())
            .and_then(|square| {
                let root = BigRational::new(square.numer().sqrt(), square.denom().sqrt());
                (&root * &root == *square).then_some(root)
            });
        Self::of_rational(root)
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        if n == 0 {
            return Exact(None);
        }
        // the smaller of the two angles with this cosine, in lowest terms
        let n = i128::from(n).abs();
        let k = i128::from(k).rem_euclid(n);
        let k = k.min(n - k);
        let divisor = gcd(k, n);
        let turn = ((k / divisor) as i64, (n / divisor) as i64);
        let known = match turn {
            (0, _) => Some((1, 1)),
            (1, 2) => Some((-1, 1)),
            (1, 4) => Some((0, 1)),
            (1, 6) => Some((1, 2)),
            (1, 3) => Some((-1, 2)),
            _ => None,
        };
        match known {
            Some((p, q)) => Self::ratio(p, q),
            None => Self::of(Some(Parts {
                rational: BigRational::zero(),
                cosine: BigRational::one(),
                turn,
            })),
        }
    }
}

fn gcd(mut a: i128, mut b: i128) -> i128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn rational(p: i64, q: i64) -> BigRational {
        BigRational::new(p.into(), q.into())
    }

    fn value(number: Exact) -> Option<BigRational> {
        number.as_rational().cloned()
    }

    proptest! {
        #[test]
        fn rational_operations_are_those_of_fractions(
            a in any::<i64>(), b in 1..i64::MAX, c in any::<i64>(), d in 1..i64::MAX,
            x in proptest::num::f64::NORMAL,
        ) {
            let (p, q) = (Exact::ratio(a, b), Exact::ratio(c, d));
            let (r, s) = (rational(a, b), rational(c, d));
            prop_assert_eq!(value(p.clone() + q.clone()), Some(&r + &s));
            prop_assert_eq!(value(p.clone() - q.clone()), Some(&r - &s));
            prop_assert_eq!(value(p.clone() * q.clone()), Some(&r * &s));
            if c != 0 {
                prop_assert_eq!(value(p.clone() / q), Some(&r / &s));
            }
            prop_assert_eq!(value((p.clone() * p).sqrt()), Some(r.abs()));
            prop_assert_eq!(value(Exact::exact(x)), BigRational::from_float(x));
        }
    }

    #[test]
    fn cosines_have_one_form_and_leave_the_set_without_a_value() {
        for n in 1..40_i64 {
            for k in -n..=n {
                let cosine = Exact::cos_turn(k, n);
                assert!(cosine.same(&Exact::cos_turn(-k, n)) && cosine.same(&Exact::cos_turn(3 * (k + n), 3 * n)));
                assert!((cosine.to::<f64>().unwrap() - f64::cos_turn(k, n)).abs() < 1e-15);
            }
        }
        let (a, b) = (Exact::cos_turn(1, 5), Exact::cos_turn(2, 5));
        assert!((a.clone() - a.clone()).same(&Exact::zero()));
        let lost = a.clone() + b;
        assert!(lost.parts().is_none() && !lost.same(&lost) && (lost * Exact::zero()).parts().is_none());
        assert!((a.clone() * a).parts().is_none() && Exact::ratio(2, 1).sqrt().parts().is_none());
        assert!(Exact::ratio(1, 0).parts().is_none() && Exact::exact(f64::NAN).parts().is_none());
    }
}
