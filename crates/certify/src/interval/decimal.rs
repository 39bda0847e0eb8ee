//! Decimal numbers as written, enclosed: the point itself where a double has exactly that value, adjacent
//! doubles otherwise.
//!
//! The standard library reads a decimal correctly rounded and writes a double with all its digits (a double
//! has at most 767 significant ones), so comparing the two digit strings says on which side of the double the
//! written number lies.

use super::Interval;
use std::cmp::Ordering;

/// Enough decimals after the first digit to write any double exactly.
const ALL_DIGITS: usize = 800;

/// An enclosure of the number written as a decimal, `None` where it is not a finite decimal number.
pub(super) fn parse(text: &str) -> Option<Interval> {
    let text = text.trim();
    let digits = Digits::of(text)?;
    let nearest: f64 = text.parse().ok()?;
    let magnitude = nearest.abs();
    if magnitude.is_infinite() {
        let beyond = Interval::spanning(f64::MAX, f64::INFINITY);
        return Some(if digits.negative { -beyond } else { beyond });
    }
    let written = Digits::of(&format!("{magnitude:.ALL_DIGITS$e}"))?;
    let enclosure = match digits.compare_magnitude(&written) {
        Ordering::Equal => Interval::point(magnitude),
        Ordering::Less => Interval::spanning(magnitude.next_down().max(0.0), magnitude),
        Ordering::Greater => Interval::spanning(magnitude, magnitude.next_up()),
    };
    Some(if digits.negative { -enclosure } else { enclosure })
}

/// `+-0.d1 d2 d3 ... * 10^exponent` with `d1` and the last digit not zero; no digits for zero.
struct Digits {
    negative: bool,
    digits: Vec<u8>,
    exponent: i64,
}

impl Digits {
    fn of(text: &str) -> Option<Self> {
        let (negative, unsigned) = match text.as_bytes().first()? {
            b'-' => (true, &text[1..]),
            b'+' => (false, &text[1..]),
            _ => (false, text),
        };
        let (mantissa, exponent) = match unsigned.find(['e', 'E']) {
            Some(at) => (&unsigned[..at], unsigned[at + 1..].parse::<i32>().ok()?),
            None => (unsigned, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let all: Vec<u8> = whole.bytes().chain(fraction.bytes()).collect();
        if all.is_empty() || !all.iter().all(u8::is_ascii_digit) {
            return None;
        }
        let Some(first) = all.iter().position(|&d| d != b'0') else {
            return Some(Digits {
                negative,
                digits: Vec::new(),
                exponent: 0,
            });
        };
        let last = all.iter().rposition(|&d| d != b'0').unwrap_or(first);
        let exponent = whole.len() as i64 - first as i64 + exponent as i64;
        Some(Digits {
            negative,
            digits: all[first..=last].to_vec(),
            exponent,
        })
    }

    fn compare_magnitude(&self, other: &Self) -> Ordering {
        match (self.digits.is_empty(), other.digits.is_empty()) {
            (true, true) => Ordering::Equal,
            (true, false) => Ordering::Less,
            (false, true) => Ordering::Greater,
            // a digit string that continues another is the larger one: its last digit is not zero
            (false, false) => self
                .exponent
                .cmp(&other.exponent)
                .then_with(|| self.digits.cmp(&other.digits)),
        }
    }
}
