//! Numbers as they are written in a scheme file: every digit counts.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

/// An exact weight.
pub type Q = BigRational;

/// `p/q`.
pub fn ratio(p: i64, q: i64) -> Q {
    Q::new(p.into(), q.into())
}

/// The nearest double, or nearly so.
pub fn double(x: &Q) -> f64 {
    x.to_f64().expect("a quotient of big integers has a nearest double")
}

/// Reads an integer, a decimal with or without exponent, or a fraction of two such.
pub fn parse(text: &str) -> Option<Q> {
    let text: String = text.chars().filter(|c| !c.is_whitespace() && *c != '_').collect();
    match text.split_once('/') {
        None => decimal(&text),
        Some((p, q)) => {
            let (p, q) = (decimal(p)?, decimal(q)?);
            (!q.is_zero()).then(|| p / q)
        }
    }
}

fn decimal(text: &str) -> Option<Q> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: BigInt = format!("{whole}{decimals}").parse().ok()?;
    let shift = exponent.checked_sub(i32::try_from(decimals.len()).ok()?)?;
    // beyond this nobody means a weight, and the power would fill the memory
    if shift.abs() > 4000 {
        return None;
    }
    let power = (0..shift.abs()).fold(BigInt::one(), |power, _| power * 10);
    Some(if shift < 0 {
        Q::new(digits, power)
    } else {
        Q::from(digits * power)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_digit_counts() {
        assert_eq!(parse("-7/12"), Some(ratio(-7, 12)));
        assert_eq!(parse(" 0.375 "), Some(ratio(3, 8)));
        assert_eq!(parse("2.5e-1"), Some(ratio(1, 4)));
        assert_eq!(parse("-.5"), Some(ratio(-1, 2)));
        assert_eq!(parse("1_000"), Some(ratio(1000, 1)));
        assert_ne!(parse("0.250000000000000000001"), Some(ratio(1, 4)));
        for text in ["", "x", "1/0", "nan", "1e99999"] {
            assert_eq!(parse(text), None, "{text}");
        }
    }
}
