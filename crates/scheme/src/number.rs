//! Numbers as people write them: exact decimals and fractions.

use crate::{Error, Scalar};
use std::fmt;
use std::str::FromStr;

/// A rational number as written, "7/12" or "0.375": exact in every [`Scalar`] that can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Number {
    numerator: i64,
    denominator: i64,
}

impl Number {
    /// The number in another type.
    pub fn to<S: Scalar>(self) -> S {
        S::ratio(self.numerator, self.denominator)
    }

    /// The nearest double (within one unit in the last place for more than 15 digits).
    pub fn value(self) -> f64 {
        self.to()
    }

    /// The decimal number that a double is printed as: the shortest that reads back as the same double.
    ///
    /// # Errors
    /// [`Error::Number`] if it is not finite or needs more than 18 digits before or after the point.
    pub fn from_decimal(value: f64) -> Result<Self, Error> {
        format!("{value}").parse()
    }
}

impl FromStr for Number {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let refuse = || Error::Number { text: text.to_owned() };
        if let Some((p, q)) = text.split_once('/') {
            let numerator = p.trim().parse().map_err(|_| refuse())?;
            let denominator = q.trim().parse().map_err(|_| refuse())?;
            if denominator <= 0 {
                return Err(refuse());
            }
            return Ok(Number { numerator, denominator });
        }
        let text = text.trim();
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().map_err(|_| refuse())?),
            None => (text, 0),
        };
        let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = whole.trim_start_matches(['+', '-']);
        let plain = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
        if !plain(digits) || !plain(decimals) || digits.len() + decimals.len() == 0 || whole.len() > digits.len() + 1 {
            return Err(refuse());
        }
        let mut numerator: i64 = format!("{digits}{decimals}").parse().map_err(|_| refuse())?;
        if whole.starts_with('-') {
            numerator = -numerator;
        }
        let mut shift = exponent.checked_sub(decimals.len() as i32).ok_or_else(refuse)?;
        while shift < 0 && numerator % 10 == 0 && numerator != 0 {
            (numerator, shift) = (numerator / 10, shift + 1);
        }
        if numerator == 0 {
            shift = 0;
        }
        let power = 10_i64.checked_pow(shift.unsigned_abs()).ok_or_else(refuse)?;
        if shift < 0 {
            return Ok(Number {
                numerator,
                denominator: power,
            });
        }
        Ok(Number {
            numerator: numerator.checked_mul(power).ok_or_else(refuse)?,
            denominator: 1,
        })
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.denominator {
            1 => write!(f, "{}", self.numerator),
            denominator => write!(f, "{}/{denominator}", self.numerator),
        }
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
            (".5", 5, 10),
            ("3", 3, 1),
            ("1e-3", 1, 1000),
            ("2.5e2", 250, 1),
            ("0.0", 0, 1),
            ("1e-30", 0, 0),
        ] {
            let number = text.parse::<Number>();
            if q == 0 {
                assert!(number.is_err());
                continue;
            }
            let number = number.unwrap();
            assert_eq!((number.numerator, number.denominator), (p, q), "{text}");
            assert_eq!(number.value(), p as f64 / q as f64);
        }
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
            "1/2/3",
            "0x10",
            "99999999999999999999",
        ] {
            assert!(text.parse::<Number>().is_err(), "{text}");
        }
        assert!(Number::from_decimal(f64::NAN).is_err());
        assert_eq!(Number::from_decimal(0.1).unwrap().to_string(), "1/10");
    }
}
