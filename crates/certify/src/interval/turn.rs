//! Cosines of rational turns, enclosed by integer arithmetic.
//!
//! `cos(2 pi k / n)` is folded exactly, in integers, into the first octant: `+-cos x` or `+-sin x` with `0 <=
//! x <= pi / 4` and the turns whose cosine is rational (multiples of a quarter and of a sixth) split off.
//! What is left is summed as a Taylor series in fixed point with unit `2^-124`, which leaves far more digits
//! than a double has, so that the bounds returned are adjacent doubles or nearly so.
//!
//! **Error.** All quantities are at most one. `r = t / (6 n)` and `x = pi r` are rounded down with an error
//! below one unit and below two units, `x^2` below five (`2 x * 2 + 1` and the truncation). With `e_j` the
//! error of the term `T_j = T_(j-1) x^2 / c_j`, `c_j >= 2`: `e_j <= (e_(j-1) + 5 + 1) / 2 + 1`, so `e_j <= 8`
//! for every `j`. As `34! > 2^124`, at most 20 terms are summed before a term is zero in fixed point; the
//! rest of the alternating series is below the next term, less than 10 units. The total is below `8 * 21 + 10
//! < 2^8` units; [`SLACK`] grants four times that.

use super::Interval;

/// Bits after the point.
const BITS: u32 = 124;
/// One.
const ONE: u128 = 1 << BITS;
/// `floor(pi * 2^124)`.
const PI: u128 = 0x3243_F6A8_885A_308D_3131_98A2_E037_0734;
/// Bound of the error of a series in units, see the module page.
const SLACK: u128 = 1 << 10;

/// An enclosure of `cos(2 pi k / n)` for `|n| < 2^66`, a point where the cosine is rational; the whole line
/// for `n = 0`.
pub(super) fn cos_turn(k: i128, n: i128) -> Interval {
    let n = n.unsigned_abs();
    if n == 0 {
        return Interval::ENTIRE;
    }
    // the turn in units of 1 / (12 n), folded to [0, 1/4] by evenness and by the half turn
    let mut turn = (k.unsigned_abs() % n) * 12;
    if turn > 6 * n {
        turn = 12 * n - turn;
    }
    let negative = turn > 3 * n;
    if negative {
        turn = 6 * n - turn;
    }
    let cosine = if turn == 0 {
        Interval::point(1.0)
    } else if turn == 2 * n {
        Interval::point(0.5)
    } else if turn == 3 * n {
        Interval::point(0.0)
    } else if 2 * turn > 3 * n {
        let x = angle(3 * n - turn, 6 * n);
        enclose(series(x, x, 2))
    } else {
        enclose(series(angle(turn, 6 * n), ONE, 1))
    };
    if negative { -cosine } else { cosine }
}

/// Enclosures of the sine and the cosine of a double in `[0, 1)`.
pub(super) fn sin_cos(x: f64) -> [Interval; 2] {
    debug_assert!((0.0..1.0).contains(&x));
    // the scale is a power of two: only bits below the unit are lost
    let x = (x * ONE as f64) as u128;
    [enclose(series(x, x, 2)), enclose(series(x, ONE, 1))]
}

/// `pi t / d` for `t / d <= 1/4`, rounded down.
fn angle(t: u128, d: u128) -> u128 {
    // t / d digit by digit; d is at most 6 * 2^66, so twice the remainder fits
    let (mut quotient, mut rest) = (0, t);
    for _ in 0..BITS {
        rest *= 2;
        quotient *= 2;
        if rest >= d {
            rest -= d;
            quotient += 1;
        }
    }
    product(PI, quotient)
}

/// `first (1 - x^2 / (c (c + 1)) + x^4 / (c (c + 1) (c + 2) (c + 3)) - ...)`: the cosine of `x` for `first =
/// 1, c = 1`, its sine for `first = x, c = 2`.
fn series(x: u128, first: u128, mut c: u128) -> u128 {
    let square = product(x, x);
    let (mut sum, mut term, mut adds) = (first, first, false);
    while term > 0 {
        term = product(term, square) / (c * (c + 1));
        c += 2;
        sum = if adds { sum + term } else { sum - term };
        adds = !adds;
    }
    sum
}

/// `a b` rounded down, for `a` and `b` below four (their product below 8).
fn product(a: u128, b: u128) -> u128 {
    const LOW: u128 = u64::MAX as u128;
    let (a1, a0, b1, b0) = (a >> 64, a & LOW, b >> 64, b & LOW);
    let middle = a1 * b0 + ((a0 * b0) >> 64);
    let middle_low = (middle & LOW) + a0 * b1;
    let high = a1 * b1 + (middle >> 64) + (middle_low >> 64);
    (high << (128 - BITS)) | ((middle_low & LOW) >> (BITS - 64))
}

/// Bounds of a fixed-point number that is right within [`SLACK`].
fn enclose(value: u128) -> Interval {
    let scale = f64::from_bits((1023 - BITS as u64) << 52);
    let (low, high) = (value.saturating_sub(SLACK), value + SLACK);
    let (mut below, mut above) = (low as f64, high as f64);
    // the conversion rounds to nearest; both are below 2^127, so the way back is exact
    if below as u128 > low {
        below = below.next_down();
    }
    if (above as u128) < high {
        above = above.next_up();
    }
    // the cosine of an octant is at most one; the scale is a power of two and nothing underflows
    Interval::spanning(below * scale, (above * scale).min(1.0))
}
