//! Where axes are ticked, and what is written there.

use crate::scene::number;

/// A tick: its value and its text, which is empty for minor ticks.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub value: f64,
    pub text: String,
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten: the finest such step with at most `most` of them, or
/// the next finer one if that leaves a single tick, from which no scale can be read.
pub(crate) fn linear(low: f64, high: f64, most: usize) -> Vec<Tick> {
    let span = high - low;
    let finest = (span / most.max(1) as f64).log10().floor() as i32 - 1;
    let steps = (finest..).flat_map(|exponent| [1.0, 2.0, 5.0].map(|factor| (factor * 10f64.powi(exponent), exponent)));
    let count = |step: f64| (high / step + SLACK).floor() - (low / step - SLACK).ceil() + 1.0;
    let mut chosen = (span, finest);
    for (step, exponent) in steps {
        let fits = count(step) <= most.max(2) as f64;
        if !(fits && count(step) < 2.0) {
            chosen = (step, exponent);
        }
        if fits {
            break;
        }
    }
    let (step, exponent) = chosen;
    let first = (low / step - SLACK).ceil() as i64;
    let last = (high / step + SLACK).floor() as i64;
    let largest = low.abs().max(high.abs()).log10().floor() as i32;
    let text = |value: f64| {
        if value == 0.0 {
            "0".to_owned()
        } else if !(-3..=4).contains(&largest) {
            let mantissa = value / 10f64.powi(largest);
            let decimals = (largest - exponent).max(0) as usize;
            format!("${}·10^{{{largest}}}$", number(mantissa, decimals))
        } else {
            // not trimmed: the ticks of one axis have the same decimals
            format!("${value:.*}$", (-exponent).max(0) as usize)
        }
    };
    (first..=last)
        .map(|k| {
            let value = k as f64 * step;
            Tick {
                value,
                text: text(value),
            }
        })
        .collect()
}

/// A round number at or below the range, and its text: what is left of the range has few digits.
pub(crate) fn base(low: f64, high: f64) -> (f64, String) {
    let exponent = (high - low).log10().ceil() as i32;
    let unit = 10f64.powi(exponent);
    // a low end that is such a number but for rounding is its own base
    let base = (low / unit + 1e-6).floor() * unit;
    (base, format!("${}$", number(base, (-exponent).max(0) as usize)))
}

/// An end of the range that misses a tick by rounding has it.
const SLACK: f64 = 1e-9;

/// Ticks at powers of ten, with minor ones between; over less than two decades also at 2 and 5.
pub(crate) fn logarithmic(low: f64, high: f64, most: usize) -> Vec<Tick> {
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let decades = (first..=last).filter(|&k| (low * (1.0 - SLACK)..=high * (1.0 + SLACK)).contains(&10f64.powi(k)));
    let stride = decades.count().div_ceil(most.max(2)).max(1) as i32;
    let short = high / low < 100.0;
    let mut ticks = Vec::new();
    for k in first..=last {
        for digit in 1..10 {
            let value = f64::from(digit) * 10f64.powi(k);
            if !(low * (1.0 - SLACK)..=high * (1.0 + SLACK)).contains(&value) || (digit > 1 && stride > 1) {
                continue;
            }
            let major = digit == 1 && k.rem_euclid(stride) == 0 || short && matches!(digit, 2 | 5);
            let text = match (major, k) {
                (false, _) => String::new(),
                (true, -3..=3) if short => format!("${}$", number(value, 3)),
                (true, _) if digit == 1 => format!("$10^{{{k}}}$"),
                (true, _) => format!("${digit}·10^{{{k}}}$"),
            };
            ticks.push(Tick { value, text });
        }
    }
    ticks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(ticks: &[Tick]) -> Vec<String> {
        let major = ticks.iter().filter(|tick| !tick.text.is_empty());
        major.map(|tick| tick.text.replace('$', "")).collect()
    }

    #[test]
    fn nice_steps() {
        assert_eq!(
            texts(&linear(0.15, 0.9, 8)),
            ["0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9"]
        );
        assert_eq!(
            texts(&linear(0.0, 1.0, 6)),
            ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"].map(|t| if t == "0.0" { "0" } else { t })
        );
        assert_eq!(texts(&linear(-10.0, 10.0, 5)), ["-10", "-5", "0", "5", "10"]);
        assert_eq!(texts(&linear(3.0, 20.0, 6)), ["5", "10", "15", "20"]);
        assert_eq!(texts(&linear(0.0, 2e-6, 3)), ["0", "1·10^{-6}", "2·10^{-6}"]);
        assert_eq!(texts(&linear(12.0, 90.0, 3)), ["20", "40", "60", "80"]);
        assert_eq!(texts(&linear(0.5, 0.50001, 3)), ["0.500000", "0.500005", "0.500010"]);
        assert_eq!(texts(&linear(0.0, 40000.0, 3)), ["0", "20000", "40000"]);
        assert_eq!(texts(&linear(0.0, 400000.0, 3)), ["0", "2·10^{5}", "4·10^{5}"]);
    }

    #[test]
    fn what_is_left_of_a_narrow_range_has_few_digits() {
        for (low, high, expected) in [
            (0.5, 0.5 + 1e-9, "0.5"),
            (0.353_553_390_593, 0.353_553_390_6, "0.35355339059"),
            (-3.000_02, -3.0, "-3.0001"),
            (81_234_567.0, 81_234_568.5, "81234560"),
        ] {
            let (base, text) = base(low, high);
            assert_eq!(text.replace('$', ""), expected);
            let left = (low - base, high - base);
            assert!(
                left.0 > -1e-5 * (high - low) && left.1 < 11.0 * (high - low),
                "{left:?}"
            );
            assert!(
                texts(&linear(left.0, left.1, 5)).iter().all(|text| text.len() < 16),
                "{low} {high}"
            );
        }
    }

    #[test]
    fn decades() {
        assert_eq!(texts(&logarithmic(1e-3, 1e3, 7)).len(), 7);
        assert_eq!(
            texts(&logarithmic(1e-12, 1e4, 5)),
            ["10^{-12}", "10^{-8}", "10^{-4}", "10^{0}", "10^{4}"]
        );
        assert_eq!(texts(&logarithmic(1.0, 9.0, 5)), ["1", "2", "5"]);
        assert!(logarithmic(1e-3, 1e3, 7).len() > 50);
    }

    #[test]
    fn two_or_more_but_no_more_than_asked() {
        for most in 2..12 {
            for (low, high) in [(0.0, 1.0), (-0.37, 12.1), (1e-9, 3e-9), (-5e7, 1e8), (99.0, 101.0)] {
                let count = linear(low, high, most).len();
                assert!(
                    count >= 2 && (count <= most || most < 5),
                    "{low} {high} {most}: {count}"
                );
            }
        }
    }
}
