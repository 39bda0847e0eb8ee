//! Numbers as people write them: exact decimals and fractions of any length.

use crate::{Error, Scalar};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};
use std::fmt;
use std::str::FromStr;

/// A rational number as written, "7/12" or "0.375" or "1e-20": exact in every [`Scalar`] that can be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number(BigRational);

/// The longest text that is read as a number: a double written out in full has 767 digits, and nobody writes
/// more.
const MAX_LENGTH: usize = 2000;

/// The largest power of ten beside a mantissa: beyond it a number is no double, however long its mantissa is.
const MAX_EXPONENT: i32 = 3000;

impl Number {
    /// The number in another type.
    pub fn to<S: Scalar>(&self) -> S {
        S::rational(&self.0)
    }

    /// The nearest double.
    pub fn value(&self) -> f64 {
        self.to()
    }

    /// The exact value.
    pub fn rational(&self) -> &BigRational {
        &self.0
    }

    /// The numbers from this one to another in so many equal steps, both ends included.
    pub fn steps_to(&self, last: &Self, steps: u32) -> Vec<Self> {
        let step = (&last.0 - &self.0) / BigRational::from_integer(steps.max(1).into());
        let value = |index: u32| Number(&self.0 + &step * BigRational::from_integer(index.into()));
        (0..=steps).map(value).collect()
    }

    /// The number with the other sign.
    pub fn negated(&self) -> Self {
        Number(-&self.0)
    }

    /// The decimal number that a double is printed as: the shortest that reads back as the same double.
    ///
    /// # Errors
    /// [`Error::Number`] if it is not finite.
    pub fn from_decimal(value: f64) -> Result<Self, Error> {
        format!("{value:e}").parse()
    }

    /// Digits with an optional sign.
    fn integer(text: &str) -> Option<BigInt> {
        let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let magnitude: BigInt = digits.parse().ok()?;
        Some(if text.starts_with('-') { -magnitude } else { magnitude })
    }

    fn fraction(p: &str, q: &str) -> Option<BigRational> {
        let (p, q) = (Self::integer(p.trim())?, Self::integer(q.trim())?);
        q.is_positive().then(|| BigRational::new(p, q))
    }

    fn decimal(text: &str) -> Option<BigRational> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let (sign, digits) = match whole.strip_prefix(['+', '-']) {
            Some(digits) => (&whole[..1], digits),
            None => ("", whole),
        };
        if !decimals.bytes().all(|b| b.is_ascii_digit()) || exponent.unsigned_abs() > MAX_EXPONENT.unsigned_abs() {
            return None;
        }
        let mantissa = Self::integer(&format!("{sign}{digits}{decimals}"))?;
        let shift = exponent - i32::try_from(decimals.len()).ok()?;
        let power = BigInt::from(10).pow(shift.unsigned_abs());
        Some(if shift < 0 {
            BigRational::new(mantissa, power)
        } else {
            BigRational::from_integer(mantissa * power)
        })
    }
}

impl FromStr for Number {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let refuse = || {
            let shown = text.chars().take(40).collect::<String>();
            let text = if shown.len() < text.len() {
                format!("{shown}..")
            } else {
                shown
            };
            Error::Number { text }
        };
        if text.len() > MAX_LENGTH {
            return Err(refuse());
        }
        let value = match text.split_once('/') {
            Some((p, q)) => Self::fraction(p, q),
            None => Self::decimal(text.trim()),
        };
        let value = value.ok_or_else(refuse)?;
        // every number is also used as a double
        if !f64::rational(&value).is_finite() {
            return Err(refuse());
        }
        Ok(Number(value))
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_zero() || self.0.denom().is_one() {
            return write!(f, "{}", self.0.numer());
        }
        write!(f, "{}/{}", self.0.numer(), self.0.denom())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_and_fractions_are_exact() {
        for (text, p, q) in [
            ("7/12", 7, 12),
            (" -1 / 16 ", -1, 16),
            ("0.375", 375, 1000),
            ("-2.50", -25, 10),
            ("-0.5", -1, 2),
            (".5", 5, 10),
            ("3", 3, 1),
            ("+3", 3, 1),
            ("1e-3", 1, 1000),
            ("2.5e2", 250, 1),
            ("0.0", 0, 1),
        ] {
            let number: Number = text.parse().unwrap();
            assert_eq!(number.0, BigRational::new(p.into(), q.into()), "{text}");
            assert_eq!(number.value(), p as f64 / q as f64);
        }
    }

    #[test]
    fn values_are_the_nearest_doubles() {
        // the standard library reads decimals correctly rounded
        for text in [
            "0.1",
            "0.3333333333333333333333333333",
            "123456789.123456789123456789",
            "1e-310",
            "2.5",
            "5e-324",
        ] {
            let exact: Number = text.parse().unwrap();
            assert_eq!(exact.value(), text.parse::<f64>().unwrap(), "{text}");
            assert_eq!(exact.negated().value(), -text.parse::<f64>().unwrap(), "{text}");
        }
    }

    #[test]
    fn no_digit_is_lost() {
        let long: Number = "0.250000000000000000001".parse().unwrap();
        assert_ne!(long, "1/4".parse().unwrap());
        assert_eq!(long.value(), 0.25);
        let (a, b): (Number, Number) = ("1e-20".parse().unwrap(), "1/100000000000000000000".parse().unwrap());
        assert_eq!(a, b);
        let beyond: Number = "123456789012345678901234567890/246913578024691357802469135780"
            .parse()
            .unwrap();
        assert_eq!(beyond, "1/2".parse().unwrap());
    }

    #[test]
    fn everything_else_is_refused() {
        for text in [
            "",
            "x",
            "1/0",
            "1/-2",
            "nan",
            "inf",
            "1.2.3",
            "--1",
            "-+1",
            "1/2/3",
            "0x10",
            "1e400",
            "1e-99999",
            "1e9999999999",
            "1e",
            ".",
            "-",
            "1_000",
            "1.-2",
        ] {
            assert!(text.parse::<Number>().is_err(), "{text}");
        }
        assert!("1".repeat(MAX_LENGTH + 1).parse::<Number>().is_err());
        assert!(Number::from_decimal(f64::NAN).is_err());
        assert_eq!(Number::from_decimal(0.1).unwrap().to_string(), "1/10");
    }
}
