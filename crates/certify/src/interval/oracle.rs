//! What tests hold intervals against: doubles as exact integers, and the operands at which rounding goes
//! wrong.
//!
//! Every double is an integer multiple of the smallest one, `2^-1074`. In these units sums, products and
//! comparisons are exact in integers, without the common divisors of rational arithmetic, so that a hundred
//! thousand operations are quick.

use super::Interval;
use num_bigint::BigInt;

/// Binary digits of the unit: a double times `2^UNIT` is an integer.
pub(crate) const UNIT: u32 = 1074;

/// A finite double in units of `2^-1074`.
pub(crate) fn units(value: f64) -> BigInt {
    assert!(value.is_finite(), "{value}");
    let bits = value.to_bits();
    let (exponent, fraction) = (bits >> 52 & 0x7ff, bits & ((1 << 52) - 1));
    let mantissa = if exponent == 0 { fraction } else { fraction | 1 << 52 };
    let magnitude = BigInt::from(mantissa) << (exponent.max(1) - 1);
    if value < 0.0 { -magnitude } else { magnitude }
}

/// Whether the number `exact 2^-(1074 + more)` is in an interval.
pub(crate) fn between(interval: Interval, exact: &BigInt, more: u32) -> bool {
    let below = interval.lo() == f64::NEG_INFINITY || units(interval.lo()) << more <= *exact;
    below && (interval.hi() == f64::INFINITY || *exact <= units(interval.hi()) << more)
}

/// A fixed sequence of operands.
pub(crate) struct Operands(u64);

impl Operands {
    pub(crate) fn new(seed: u64) -> Self {
        Operands(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// The generator xorshift64* (Vigna 2016).
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.bits() >> 11) as usize % count
    }

    /// In `[0, 1)`.
    pub(crate) fn fraction(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 2f64.powi(53)
    }

    pub(crate) fn sign(&mut self) -> f64 {
        if self.bits() >> 63 == 0 { 1.0 } else { -1.0 }
    }

    /// A finite double: zeros, subnormals, powers of two and their neighbours, the thresholds of the
    /// roundings, the largest ones, small integers, ordinary numbers and any pattern of bits.
    pub(crate) fn double(&mut self) -> f64 {
        let magnitude = match self.below(12) {
            0 => 0.0,
            1 => f64::from_bits(1 + self.below(4) as u64),
            2 => f64::from_bits(self.bits() >> (12 + self.below(50))),
            3 => self.beside(f64::MIN_POSITIVE),
            4 => self.beside(1.0),
            5 => {
                let exponent = [-1000, -969, -537, -53, 53, 511, 512, 1000, 1023][self.below(9)];
                self.beside(2f64.powi(exponent))
            }
            6 => {
                let exponent = self.below(2098) as i32 - 1074;
                // two factors, since a power below the normal ones may be flushed on the way
                let power = 2f64.powi(exponent.max(-1000)) * 2f64.powi(exponent.min(-1000) + 1000);
                self.beside(power)
            }
            7 => f64::from_bits(f64::MAX.to_bits() - self.below(3) as u64),
            8 => self.below(20) as f64,
            9 => self.below(1 << 20) as f64 / 1024.0,
            10 => self.fraction(),
            _ => match f64::from_bits(self.bits()) {
                any if any.is_finite() => any,
                _ => 1.5,
            },
        };
        magnitude * self.sign()
    }

    /// A double at most two away.
    fn beside(&mut self, value: f64) -> f64 {
        f64::from_bits(value.to_bits().saturating_add_signed(self.below(5) as i64 - 2)).min(f64::MAX)
    }

    /// A partner of an operand: any, or one for which results nearly cancel or are exact.
    pub(crate) fn partner(&mut self, x: f64) -> f64 {
        let found = match self.below(8) {
            0 => -self.beside(x.abs()) * x.signum(),
            1 => self.beside(x.abs()),
            2 => 1.0 / x,
            3 => x * (1.0 + self.fraction()),
            4 => x / 2f64.powi(53 + self.below(3) as i32),
            _ => self.double(),
        };
        if found.is_finite() { found } else { self.double() }
    }

    /// An interval, which may be a point or not bounded, and members: its finite ends and something between.
    pub(crate) fn interval(&mut self, of: f64) -> (Interval, Vec<f64>) {
        let other = match self.below(4) {
            0 => of,
            1 => self.beside(of.abs()) * of.signum(),
            _ => self.double(),
        };
        let (mut lo, mut hi) = if of <= other { (of, other) } else { (other, of) };
        let inside = (lo / 2.0 + hi / 2.0).clamp(lo, hi);
        match self.below(16) {
            0 => lo = f64::NEG_INFINITY,
            1 => hi = f64::INFINITY,
            _ => {}
        }
        let mut members = vec![of, other, inside, self.double().clamp(lo, hi)];
        members.retain(|x| x.is_finite());
        (Interval::new(lo, hi).expect("in order"), members)
    }
}
