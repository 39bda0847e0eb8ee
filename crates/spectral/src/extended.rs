//! Numbers of 256 bits, about 77 digits.
//!
//! Eigenvalues of a scheme of high order lie closer together than doubles can tell, and are badly
//! conditioned: at order 20 and valence 5 two of them agree to twelve digits at 1/256, and at order 32
//! perturbing the matrix by `eps` moves some by `1e14 eps`, more than the `4e-27` that two are apart. The
//! rules are generic over the [`Scalar`], and [`Extended`] runs them with errors of some units of `2^-256`.
//!
//! The size is fixed, so that nothing is allocated: a decomposition of 240 unknowns takes 10^8 operations.

use eigenring_scheme::{Same, Scalar};
use eigenring_spline::BigRational;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Words of the mantissa.
const WORDS: usize = 4;

/// The exponent of what is no finite number: a quotient by zero.
const INFINITE: i32 = 1 << 28;

/// A floating-point number `+- mantissa 2^(exponent - 256)` whose mantissa, of four words with the lowest
/// first, has its highest bit set; all words are 0 for zero. Results are truncated, and their exponents are
/// not bounded in practice.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extended {
    negative: bool,
    exponent: i32,
    mantissa: [u64; WORDS],
}

/// The rounding unit, with room for the units that an operation may lose.
pub(crate) const UNIT: f64 = 64.0 / (1_u128 << 127) as f64 / (1_u128 << 127) as f64;

impl Extended {
    /// The nearest double; infinite for a quotient by zero.
    pub fn to_f64(self) -> f64 {
        let [rest @ .., top] = self.mantissa;
        // the lowest bit stands for all that follow, for rounding
        let top = top | u64::from(rest.iter().any(|&word| word != 0));
        let sign = if self.negative { -1.0 } else { 1.0 };
        // in three steps, so that no factor is beyond the range of doubles
        let power = |e: i32| f64::from_bits(((e.clamp(-700, 700) + 1023) as u64) << 52);
        let exponent = (self.exponent - 64).clamp(-2000, 2000);
        sign * top as f64 * power(exponent / 3) * power(exponent / 3) * power(exponent - 2 * (exponent / 3))
    }

    /// The absolute value.
    pub fn abs(self) -> Self {
        Extended {
            negative: false,
            ..self
        }
    }

    fn is_zero(&self) -> bool {
        self.mantissa[WORDS - 1] == 0
    }

    /// `+- words 2^(exponent - 64 len)`, normalised, for more words than a mantissa has.
    #[inline]
    fn from_words<const LEN: usize>(negative: bool, exponent: i32, words: [u64; LEN]) -> Self {
        let Some(top) = (0..LEN).rev().find(|&i| words[i] != 0) else {
            return Self::default();
        };
        let shift = words[top].leading_zeros();
        let mut mantissa = [0; WORDS];
        for (i, word) in mantissa.iter_mut().enumerate() {
            // the i-th word of the mantissa is the (top - 3 + i)-th of the given
            let at = |back: usize| (top + i).checked_sub(back).map_or(0, |j| words[j]);
            let (this, below) = (at(WORDS - 1), at(WORDS));
            *word = if shift == 0 {
                this
            } else {
                this << shift | below >> (64 - shift)
            };
        }
        Extended {
            negative,
            exponent: exponent - 64 * (LEN - 1 - top) as i32 - shift as i32,
            mantissa,
        }
    }

    /// The sum of absolute values, or their difference, where `|self| >= |other|`; the sign is that of self.
    #[inline]
    fn combined(self, other: Self, subtract: bool) -> Self {
        let distance = (self.exponent - other.exponent) as u32;
        if distance > 64 * WORDS as u32 {
            return self;
        }
        // a word in front for the carry, and one behind for what is shifted out
        let (words, bits) = ((distance / 64) as usize, distance % 64);
        let mut sum = [0; WORDS + 2];
        sum[1..=WORDS].copy_from_slice(&self.mantissa);
        let mut carry = false;
        for (i, sum) in sum.iter_mut().enumerate().take(WORDS + 1) {
            // word i of the other's mantissa with a zero behind, shifted
            let at = |i: usize| match i {
                1..=WORDS => other.mantissa[i - 1],
                _ => 0,
            };
            let (low, high) = (at(i + words), at(i + words + 1));
            let word = if bits == 0 {
                low
            } else {
                low >> bits | high << (64 - bits)
            };
            let (first, one) = if subtract {
                sum.overflowing_sub(word)
            } else {
                sum.overflowing_add(word)
            };
            let step = u64::from(carry);
            let (second, two) = if subtract {
                first.overflowing_sub(step)
            } else {
                first.overflowing_add(step)
            };
            *sum = second;
            carry = one | two;
        }
        if subtract {
            return Self::from_words(self.negative, self.exponent + 64, sum);
        }
        // one bit at most is carried
        let shift = u32::from(carry);
        let mut mantissa = [0; WORDS];
        for (i, word) in mantissa.iter_mut().enumerate() {
            let above = if i + 1 < WORDS { sum[i + 2] } else { u64::from(carry) };
            *word = (sum[i + 1] >> shift) | ((above << 63) * u64::from(shift));
        }
        Extended {
            exponent: self.exponent + shift as i32,
            mantissa,
            ..self
        }
    }

    /// Times a power of two.
    fn scaled(self, power: i32) -> Self {
        if self.is_zero() {
            return self;
        }
        Extended {
            exponent: (self.exponent + power).clamp(-INFINITE, INFINITE),
            ..self
        }
    }

    /// `sum (-1)^j x^(2j) / (2j + odd)!` for `|x| <= pi/4`: the cosine, or the sine over x.
    fn series(x: Self, odd: i64) -> Self {
        let square = x * x;
        let (mut sum, mut term) = (Self::one(), Self::one());
        // the 29th term is below 1e-82
        for j in 1..30 {
            term = -term * square / Self::ratio((2 * j - 1 + odd) * (2 * j + odd), 1);
            sum += term;
        }
        sum
    }
}

/// The number pi; the words of pi/4 are those of the groups of RFC 3526.
const PI: Extended = Extended {
    negative: false,
    exponent: 2,
    mantissa: [
        0x020b_bea6_3b13_9b22,
        0x2902_4e08_8a67_cc74,
        0xc4c6_628b_80dc_1cd1,
        0xc90f_daa2_2168_c234,
    ],
};

impl Same for Extended {
    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

impl Add for Extended {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        if other.is_zero() {
            return self;
        }
        if self.is_zero() {
            return other;
        }
        let key = |x: &Self| (x.exponent, x.mantissa[3], x.mantissa[2], x.mantissa[1], x.mantissa[0]);
        let subtract = self.negative != other.negative;
        if key(&self) >= key(&other) {
            self.combined(other, subtract)
        } else {
            other.combined(self, subtract)
        }
    }
}

impl Sub for Extended {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Extended {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::default();
        }
        let mut words = [0_u64; 2 * WORDS];
        for (i, &a) in self.mantissa.iter().enumerate() {
            let mut carry = 0;
            for (j, &b) in other.mantissa.iter().enumerate() {
                let term = u128::from(a) * u128::from(b) + u128::from(words[i + j]) + u128::from(carry);
                words[i + j] = term as u64;
                carry = (term >> 64) as u64;
            }
            words[i + WORDS] = carry;
        }
        // both highest bits are set, so that the product's is one of the first two
        let exponent = (self.exponent + other.exponent).clamp(-INFINITE, INFINITE);
        let shift = (words[2 * WORDS - 1] >> 63 == 0) as u32;
        let mut mantissa = [0; WORDS];
        for (i, word) in mantissa.iter_mut().enumerate() {
            *word = (words[WORDS + i] << shift) | ((words[WORDS + i - 1] >> 63) * u64::from(shift));
        }
        Extended {
            negative: self.negative != other.negative,
            exponent: exponent - shift as i32,
            mantissa,
        }
    }
}

impl Div for Extended {
    type Output = Self;
    /// The reciprocal by Newton's method, `r (2 - b r)`, from a double; the quotient with a last correction.
    fn div(self, other: Self) -> Self {
        if self.is_zero() {
            return self;
        }
        if other.is_zero() {
            return Extended {
                exponent: INFINITE,
                ..self
            };
        }
        let divisor = Extended { exponent: 0, ..other };
        let mut reciprocal = Self::exact(1.0 / divisor.to_f64());
        for _ in 0..3 {
            reciprocal += reciprocal * (Self::one() - divisor * reciprocal);
        }
        let quotient = self * reciprocal;
        let quotient = quotient + (self - quotient * divisor) * reciprocal;
        quotient.scaled(-other.exponent)
    }
}

impl Neg for Extended {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Extended {
            negative: !self.negative && !self.is_zero(),
            ..self
        }
    }
}

impl AddAssign for Extended {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Extended {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Scalar for Extended {
    fn ratio(p: i64, q: i64) -> Self {
        let whole = |i: i64| Self::from_words(i < 0, 64, [i.unsigned_abs()]);
        if q == 1 { whole(p) } else { whole(p) / whole(q) }
    }

    fn exact(value: f64) -> Self {
        if !value.is_finite() {
            let one = Self::ratio(1, 1);
            return Extended {
                exponent: INFINITE,
                ..one
            };
        }
        let bits = value.to_bits();
        let (biased, fraction) = ((bits >> 52 & 0x7ff) as i32, bits & ((1 << 52) - 1));
        // value = mantissa 2^(exponent - 52 - 1023), below the normal range with exponent 1
        let mantissa = if biased == 0 { fraction } else { fraction | 1 << 52 };
        Self::from_words(value < 0.0, biased.max(1) - 1075 + 64, [mantissa])
    }

    fn rational(value: &BigRational) -> Self {
        if let (Ok(p), Ok(q)) = (i64::try_from(value.numer()), i64::try_from(value.denom())) {
            return Self::ratio(p, q);
        }
        // sums of doubles, each the nearest to what is left
        let (mut sum, mut rest) = (Self::default(), value.clone());
        for _ in 0..6 {
            let nearest = f64::rational(&rest);
            let Some(exact) = BigRational::from_float(nearest) else {
                return Self::exact(nearest);
            };
            sum += Self::exact(nearest);
            rest -= exact;
        }
        sum
    }

    /// By Newton's method for the reciprocal, `y (3 - b y^2)/2`, from a double.
    fn sqrt(self) -> Self {
        if self.is_zero() || self.negative {
            return if self.is_zero() { self } else { Self::exact(f64::NAN) };
        }
        let (half, odd) = (self.exponent.div_euclid(2), self.exponent.rem_euclid(2));
        let radicand = Extended { exponent: odd, ..self };
        let mut inverse = Self::exact(1.0 / radicand.to_f64().sqrt());
        for _ in 0..3 {
            inverse += (inverse * (Self::one() - radicand * inverse * inverse)).scaled(-1);
        }
        let root = radicand * inverse;
        let root = root + ((radicand - root * root) * inverse).scaled(-1);
        root.scaled(half)
    }

    /// Folded into the first octant, as for doubles.
    fn cos_turn(k: i64, n: i64) -> Self {
        let n = n.abs();
        // the turn in units of 1/(4n), folded to [0, 1/2] by evenness, then to [0, 1/4]
        let mut turn = 4 * k.rem_euclid(n);
        if turn > 2 * n {
            turn = 4 * n - turn;
        }
        let (negative, turn) = if turn > n { (true, 2 * n - turn) } else { (false, turn) };
        let angle = |turn: i64| PI * Self::ratio(turn, 2 * n);
        let value = if turn == n {
            Self::zero()
        } else if 2 * turn > n {
            let x = angle(n - turn);
            x * Self::series(x, 1)
        } else {
            Self::series(angle(turn), 0)
        };
        if negative { -value } else { value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of `x - y`, as a multiple of 2^-256.
    fn error(x: Extended, y: Extended) -> f64 {
        (x - y).to_f64().abs() * 2.0_f64.powi(256)
    }

    #[test]
    fn cosines_add_up() {
        for n in 1..40_i64 {
            for k in 0..n {
                let (c, s) = (Extended::cos_turn(k, n), Extended::sin_turn(k, n));
                assert!((c.to_f64() - f64::cos_turn(k, n)).abs() < 1e-15);
                assert!(error(c * c + s * s, Extended::one()) < 256.0);
                // cos 2a = 2 cos^2 a - 1
                let double = Extended::ratio(2, 1) * c * c - Extended::one();
                assert!(error(double, Extended::cos_turn(2 * k, n)) < 512.0);
            }
        }
        // cos(pi/5) = (1 + sqrt 5)/4
        let golden = (Extended::one() + Extended::ratio(5, 1).sqrt()) / Extended::ratio(4, 1);
        assert!(error(Extended::cos_turn(1, 10), golden) < 128.0);
    }

    #[test]
    fn ratios_keep_all_digits() {
        let third = Extended::ratio(1, 3);
        assert!(error(third * Extended::ratio(3, 1), Extended::one()) < 4.0);
        let large = (1_i64 << 62) + 1;
        assert_eq!(
            Extended::ratio(large, 1) - Extended::ratio(1_i64 << 62, 1),
            Extended::one()
        );
        assert_eq!(Extended::ratio(-7, 2), -Extended::exact(3.5));
        let value = BigRational::new((-1).into(), 3.into());
        assert!(error(Extended::rational(&value), -third) < 4.0);
        let long = BigRational::new((-1_i128 << 90).into(), (3_i128 << 90).into())
            + BigRational::new(1.into(), (7_i128 << 80).into());
        let beside = Extended::ratio(1, 7).scaled(-80);
        assert!(error(Extended::rational(&long), beside - third) < 8.0);
    }

    /// Against rational numbers of any size.
    #[test]
    fn operations_are_those_of_rational_numbers() {
        let doubles = [
            1.0,
            -1.0,
            0.1,
            -1.0 / 3.0,
            1e-17,
            7.25e8,
            -3.3e-30,
            2.0_f64.powi(-200),
            5e-324,
        ];
        let exact = |x: f64| BigRational::from_float(x).unwrap();
        let close = |found: Extended, expected: BigRational, scale: f64| {
            let difference = (found - Extended::rational(&expected)).to_f64().abs();
            assert!(difference <= 2.0_f64.powi(-250) * scale, "{expected}: {difference}");
        };
        for a in doubles {
            assert_eq!(Extended::exact(a).to_f64(), a);
            for b in doubles {
                let (x, y) = (Extended::exact(a), Extended::exact(b));
                let scale = a.abs().max(b.abs());
                close(x + y, exact(a) + exact(b), scale);
                close(x - y, exact(a) - exact(b), scale);
                if a.abs() > 1e-300 && b.abs() > 1e-300 {
                    close(x * y, exact(a) * exact(b), (a * b).abs());
                    close(x / y, exact(a) / exact(b), (a / b).abs());
                    // what is nearly the same leaves what is left
                    close(
                        x * y - Extended::exact(a * b),
                        exact(a) * exact(b) - exact(a * b),
                        (a * b).abs(),
                    );
                }
            }
            let root = Extended::exact(a.abs()).sqrt();
            close(root * root, exact(a.abs()), a.abs());
        }
        // borrows through all words
        let tiny = Extended::exact(2.0_f64.powi(-256));
        assert_eq!((Extended::one() - tiny) + tiny, Extended::one());
        assert_eq!(
            (Extended::one() - (Extended::one() - tiny)).to_f64(),
            2.0_f64.powi(-256)
        );
        assert!((Extended::one() / Extended::zero()).to_f64().is_infinite());
        assert_eq!(Extended::exact(0.0), -Extended::zero());
    }
}
