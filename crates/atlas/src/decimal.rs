//! Numbers as text, fast: the shortest digits that give the same double, never with an exponent. They are
//! those that JSON has, and as many as [`Display`](std::fmt::Display) prints, which may end otherwise where
//! two are as close.

use std::fmt::Write;

/// Adds a finite number.
pub(crate) fn push(text: &mut String, x: f64) {
    let mut buffer = ryu::Buffer::new();
    let printed = buffer.format_finite(x);
    let Some((mantissa, exponent)) = printed.split_once('e') else {
        text.push_str(printed.strip_suffix(".0").unwrap_or(printed));
        return;
    };
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or(("", mantissa), |rest| ("-", rest));
    let (first, rest) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let rest = if rest == "0" { "" } else { rest };
    text.push_str(sign);
    let zeros = |text: &mut String, count: usize| text.extend(std::iter::repeat_n('0', count));
    match exponent.parse::<i32>() {
        Ok(below @ ..0) => {
            text.push_str("0.");
            zeros(text, below.unsigned_abs() as usize - 1);
            text.push_str(first);
            text.push_str(rest);
        }
        Ok(above) if above as usize >= rest.len() => {
            text.push_str(first);
            text.push_str(rest);
            zeros(text, above as usize - rest.len());
        }
        // not what the digits of large numbers look like
        _ => {
            let _ = write!(text, "{}", x.abs());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_back_and_as_short_as_the_standard_library_prints_them() {
        let mut bits = 1_u64;
        let random = std::iter::repeat_with(|| {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            f64::from_bits(bits ^ (bits >> 29))
        });
        let powers = (-330..=308).map(|k| 10_f64.powi(k));
        let whole = (0..2000).map(|k| f64::from(k) * 1e13);
        let edge = [
            0.0,
            -0.0,
            f64::MIN_POSITIVE,
            5e-324,
            f64::MAX,
            9_007_199_254_740_993.0,
            1e16,
            123_456.75,
            1.0 / 3.0,
        ];
        for x in random
            .take(20_000)
            .chain(powers)
            .chain(whole)
            .chain(edge)
            .filter(|x| x.is_finite())
        {
            for x in [x, -x, x.fract()] {
                let mut text = String::new();
                push(&mut text, x);
                assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(x.to_bits()), "{text}");
                let display = x.to_string();
                assert_eq!(text.len(), display.len(), "{text} and {display}");
                // but for the last digit the same characters
                let digits = |text: &str| text.trim_end_matches('0').trim_end_matches('.').len();
                let common = digits(&text).saturating_sub(1);
                assert_eq!(text[..common], display[..common]);
            }
        }
    }
}
