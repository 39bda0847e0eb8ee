//! Directed rounding built from correctly rounded operations and their exact errors.
//!
//! Rust computes `+ - * /` and square roots rounded to nearest, and no portable way changes that mode. The
//! error of such an operation can be had exactly: that of a sum by the two-sum of Knuth (1969), that of a
//! product, of a quotient or of a root by a fused multiply-add (see Muller et al. 2018, *Handbook of
//! Floating-Point Arithmetic*, chapters 4 and 5). Its sign says on which side of the rounded result the true
//! one lies, so a bound moves to the neighbouring double only when it must, and an operation without error
//! keeps a point a point: a zero that holds exactly stays an exact zero.
//!
//! The residual of a product, a quotient or a root can itself underflow to zero. Below [`RESIDUAL_SAFE`] a
//! zero residual is therefore not taken as a proof of exactness, unless the operation is by one.
//!
//! Every function returns the pair `(below, above)` of bounds of one operation on two doubles that are not
//! NaN; where infinite bounds meet they follow the interval convention `0 * inf = 0`.

/// Products of at least this size have a residual that is representable: `2^-1022 * 2^53`, the smallest
/// normal double with room for the 53 further bits of the residual.
const RESIDUAL_SAFE: f64 = f64::MIN_POSITIVE * 9_007_199_254_740_992.0;

/// Bounds of a true result from the rounded one and the sign of `true - rounded`; `trusted` says whether a
/// zero residual proves exactness, and a residual that is not a number proves nothing. An overflow of finite
/// operands leaves the largest double on the inside.
///
/// Signs of residuals are as good as random, so that the bounds are chosen without branches.
#[inline(always)]
fn bounds(rounded: f64, residual: f64, trusted: bool) -> (f64, f64) {
    let exact = residual == 0.0 && trusted;
    let below = !(residual > 0.0 || exact);
    let above = !(residual < 0.0 || exact);
    if rounded == 0.0 || rounded.is_infinite() {
        return at_an_end(rounded, below, above);
    }
    // doubles of one sign are ordered like their bits
    let bits = rounded.to_bits() as i64;
    let outwards = (bits >> 63) | 1;
    let moved = |by: i64| f64::from_bits((bits + by) as u64);
    (moved(-outwards * i64::from(below)), moved(outwards * i64::from(above)))
}

/// [`bounds`] of zero, whose neighbours are of both signs, and of what overflowed.
#[cold]
fn at_an_end(rounded: f64, below: bool, above: bool) -> (f64, f64) {
    if rounded == f64::INFINITY {
        return (f64::MAX, f64::INFINITY);
    }
    if rounded == f64::NEG_INFINITY {
        return (f64::NEG_INFINITY, f64::MIN);
    }
    let tiny = f64::from_bits(1);
    // a negative zero would be a second representation of the same bound
    (if below { -tiny } else { 0.0 }, if above { tiny } else { 0.0 })
}

/// Bounds of `a + b`. Infinite operands must not be opposite.
#[inline(always)]
pub(super) fn sum(a: f64, b: f64) -> (f64, f64) {
    let rounded = a + b;
    if !(a.is_finite() && b.is_finite()) {
        return (rounded, rounded);
    }
    let from_b = rounded - a;
    let residual = (a - (rounded - from_b)) + (b - from_b);
    bounds(rounded, residual, true)
}

/// Bounds of `a * b`.
#[inline(always)]
pub(super) fn product(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 || b == 0.0 {
        return (0.0, 0.0);
    }
    let rounded = a * b;
    if !(a.is_finite() && b.is_finite()) {
        return (rounded, rounded);
    }
    if rounded == 0.0 {
        // underflow: the sign is still known, and non-negative squares rest on it
        let tiny = f64::from_bits(1);
        return if (a > 0.0) == (b > 0.0) {
            (0.0, tiny)
        } else {
            (-tiny, 0.0)
        };
    }
    let residual = a.mul_add(b, -rounded);
    let trusted = rounded.abs() >= RESIDUAL_SAFE || a.abs() == 1.0 || b.abs() == 1.0;
    bounds(rounded, residual, trusted)
}

/// Bounds of `a / b` for a finite or infinite `a` and a `b` that is not zero.
pub(super) fn quotient(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 || (a.is_finite() && b.is_infinite()) {
        return (0.0, 0.0);
    }
    let rounded = a / b;
    if !a.is_finite() {
        // only ever paired with the bound it belongs to; opposite infinities give the whole line
        return if rounded.is_nan() {
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            (rounded, rounded)
        };
    }
    let residual = (-rounded).mul_add(b, a);
    let signed = if b < 0.0 { -residual } else { residual };
    let trusted = a.abs() >= RESIDUAL_SAFE && rounded.abs() >= f64::MIN_POSITIVE || b.abs() == 1.0;
    bounds(rounded, signed, trusted)
}

/// Bounds of the square root of `a >= 0`.
pub(super) fn root(a: f64) -> (f64, f64) {
    if a == 0.0 || a == f64::INFINITY {
        return (a + 0.0, a);
    }
    let rounded = a.sqrt();
    let residual = (-rounded).mul_add(rounded, a);
    let (below, above) = bounds(rounded, residual, a >= RESIDUAL_SAFE);
    (below.max(0.0), above)
}
