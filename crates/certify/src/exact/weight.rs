//! Stencil weights as exact numbers.

use eigenring_scheme::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A rational number with 128-bit parts: in lowest terms, the denominator positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction {
    /// Numerator.
    pub numerator: i128,
    /// Denominator.
    pub denominator: i128,
}

impl Fraction {
    const ZERO: Fraction = Fraction {
        numerator: 0,
        denominator: 1,
    };

    /// `p / q` in lowest terms; `None` if q is zero or a part does not fit.
    fn new(p: i128, q: i128) -> Option<Self> {
        let divisor = i128::try_from(gcd(p.unsigned_abs(), q.unsigned_abs())).ok()?;
        if q == 0 {
            return None;
        }
        let (p, q) = (p / divisor, q / divisor);
        let (p, q) = if q < 0 {
            (p.checked_neg()?, q.checked_neg()?)
        } else {
            (p, q)
        };
        Some(Fraction {
            numerator: p,
            denominator: q,
        })
    }

    fn add(self, other: Self) -> Option<Self> {
        // over the least common denominator, so that sums of like fractions do not grow
        let divisor = gcd(self.denominator.unsigned_abs(), other.denominator.unsigned_abs()) as i128;
        let (own, others) = (other.denominator / divisor, self.denominator / divisor);
        let sum = self
            .numerator
            .checked_mul(own)?
            .checked_add(other.numerator.checked_mul(others)?)?;
        Fraction::new(sum, self.denominator.checked_mul(own)?)
    }

    fn times(self, other: Self) -> Option<Self> {
        // crosswise reduction first, for the same reason
        let (a, b) = (
            Fraction::new(self.numerator, other.denominator)?,
            Fraction::new(other.numerator, self.denominator)?,
        );
        Fraction::new(
            a.numerator.checked_mul(b.numerator)?,
            a.denominator.checked_mul(b.denominator)?,
        )
    }

    fn inverse(self) -> Option<Self> {
        Fraction::new(self.denominator, self.numerator)
    }

    fn negated(self) -> Option<Self> {
        Fraction::new(self.numerator.checked_neg()?, self.denominator)
    }

    fn is_zero(self) -> bool {
        self.numerator == 0
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

/// The parts of a [`Weight`]: `rational + cosine cos(2 pi turn/parts)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The rational part.
    pub rational: Fraction,
    /// The factor of the cosine; zero for a rational weight.
    pub cosine: Fraction,
    /// The angle as a fraction of a full turn, `0 <= turn < parts`, in lowest terms.
    pub turn: (i64, i64),
}

/// The number `a + b cos(2 pi k/n)`, exact, or nothing: an operation that leaves this set (a sum of two different cosines, the
/// root of a number that is not a square, more than 127 bits) gives a weight without value, and so does every operation with
/// one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Weight(Option<Parts>);

impl Weight {
    /// The value, if it could be represented.
    pub fn parts(self) -> Option<Parts> {
        self.0
    }

    fn rational(value: Option<Fraction>) -> Self {
        Weight(value.map(|rational| Parts {
            rational,
            cosine: Fraction::ZERO,
            turn: (0, 1),
        }))
    }

    fn combine(self, other: Self, f: impl Fn(Parts, Parts) -> Option<Parts>) -> Self {
        Weight(self.0.zip(other.0).and_then(|(a, b)| f(a, b)))
    }
}

/// A cosine with factor zero has no angle.
fn normal(rational: Fraction, cosine: Fraction, turn: (i64, i64)) -> Parts {
    let turn = if cosine.is_zero() { (0, 1) } else { turn };
    Parts { rational, cosine, turn }
}

impl Add for Weight {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, |a, b| {
            let turn = match (a.cosine.is_zero(), b.cosine.is_zero()) {
                (true, _) => b.turn,
                (_, true) => a.turn,
                _ if a.turn == b.turn => a.turn,
                _ => return None,
            };
            Some(normal(a.rational.add(b.rational)?, a.cosine.add(b.cosine)?, turn))
        })
    }
}

impl Neg for Weight {
    type Output = Self;
    fn neg(self) -> Self {
        Weight(
            self.0
                .and_then(|a| Some(normal(a.rational.negated()?, a.cosine.negated()?, a.turn))),
        )
    }
}

impl Sub for Weight {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Weight {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, |a, b| {
            let (factor, b) = match (a.cosine.is_zero(), b.cosine.is_zero()) {
                (true, _) => (a.rational, b),
                (_, true) => (b.rational, a),
                _ => return None,
            };
            Some(normal(factor.times(b.rational)?, factor.times(b.cosine)?, b.turn))
        })
    }
}

impl Div for Weight {
    type Output = Self;
    #[expect(
        clippy::suspicious_arithmetic_impl,
        reason = "division by a rational number is multiplication"
    )]
    fn div(self, other: Self) -> Self {
        let inverse = other
            .0
            .filter(|b| b.cosine.is_zero())
            .and_then(|b| b.rational.inverse());
        self * Weight::rational(inverse)
    }
}

impl AddAssign for Weight {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Weight {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Scalar for Weight {
    fn ratio(p: i64, q: i64) -> Self {
        Weight::rational(Fraction::new(p.into(), q.into()))
    }

    fn exact(value: f64) -> Self {
        Weight::rational(dyadic(value))
    }

    fn sqrt(self) -> Self {
        let root = |x: i128| {
            let root = x.checked_isqrt()?;
            (root * root == x).then_some(root)
        };
        let rational = self.0.filter(|a| a.cosine.is_zero()).map(|a| a.rational);
        Weight::rational(rational.and_then(|a| Fraction::new(root(a.numerator)?, root(a.denominator)?)))
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        // the smaller of the two angles with this cosine, in lowest terms
        let (n, k) = if n < 0 {
            (-i128::from(n), -i128::from(k))
        } else {
            (n.into(), k.into())
        };
        if n == 0 {
            return Weight(None);
        }
        let k = k.rem_euclid(n);
        let k = k.min(n - k);
        let divisor = gcd(k.unsigned_abs(), n.unsigned_abs()) as i128;
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
            Some((p, q)) => Weight::ratio(p, q),
            None => Weight(Some(Parts {
                rational: Fraction::ZERO,
                cosine: Fraction {
                    numerator: 1,
                    denominator: 1,
                },
                turn,
            })),
        }
    }
}

/// The rational number that a double is; `None` if it is not finite or does not fit.
fn dyadic(value: f64) -> Option<Fraction> {
    if value == 0.0 {
        return Some(Fraction::ZERO);
    }
    if !value.is_finite() {
        return None;
    }
    let bits = value.abs().to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32, i128::from(bits & ((1 << 52) - 1)));
    let (mantissa, exponent) = match exponent {
        0 => (fraction, -1074),
        exponent => (fraction | 1 << 52, exponent - 1075),
    };
    let mantissa = if value < 0.0 { -mantissa } else { mantissa };
    let trailing = mantissa.trailing_zeros() as i32;
    let (mantissa, exponent) = (mantissa >> trailing, exponent + trailing);
    let power = |exponent: i32| (exponent < 126).then(|| 1_i128 << exponent);
    if exponent >= 0 {
        Fraction::new(mantissa.checked_mul(power(exponent)?)?, 1)
    } else {
        Fraction::new(mantissa, power(-exponent)?)
    }
}
