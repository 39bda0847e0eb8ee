//! Angles: the arc tangent of an interval and the argument of a box of the plane.
//!
//! For a double `t` in `[0, 1]` let `a` be the library's approximation of `atan t`, of whatever quality, and
//! `s, c` enclosures of its sine and cosine. The addition theorem gives
//!
//! ```text
//! atan t = a + atan r,   r = (t c - s) / (c + t s),
//! ```
//!
//! and `|atan r|` lies between `|r| - |r|^3 / 3` and `|r|` (the series alternates). Larger arguments are
//! reflected, `atan t = pi/2 - atan(1/t)`, and an interval is mapped by its ends, the function being
//! increasing.

use super::{Interval, turn};
use eigenring_spline::Scalar;

impl Interval {
    /// The arc tangents of the members.
    pub fn atan(self) -> Self {
        let half_turn = Self::pi() * Self::point(0.5);
        let end = |bound: f64| {
            if bound.is_finite() {
                Some(at(Self::point(bound)))
            } else {
                None
            }
        };
        let lo = end(self.lo).map_or((-half_turn).lo, Self::lo);
        let hi = end(self.hi).map_or(half_turn.hi, Self::hi);
        Self::spanning(lo, hi)
    }

    /// The arguments in `[-pi, pi]` of the points `(x, y)`, all of `[-pi, pi]` where the points may lie on
    /// the negative x-axis or be the origin.
    pub fn argument(x: Self, y: Self) -> Self {
        let half_turn = Self::pi() * Self::point(0.5);
        // each coordinate occurs once in a quotient, so its range is sharp
        if x.certainly_positive() && x.mig() >= y.mag() {
            (y / x).atan()
        } else if y.certainly_positive() {
            half_turn - (x / y).atan()
        } else if y.certainly_negative() {
            -half_turn - (x / y).atan()
        } else if x.certainly_positive() {
            (y / x).atan()
        } else {
            Self::pi() * Self::unit()
        }
    }
}

/// The arc tangent of a number known by a narrow enclosure; wide ones are better mapped by their ends.
fn at(t: Interval) -> Interval {
    if t.lo < 0.0 {
        return -at(-t);
    }
    if t.hi > 1.0 {
        let half_turn = Interval::pi() * Interval::point(0.5);
        return half_turn - at(Interval::point(1.0) / t);
    }
    // whatever the library says, the series of the sine and the cosine are for [0, 1)
    let guess = t.mid().atan().clamp(0.0, 0.875);
    let [sin, cos] = turn::sin_cos(guess);
    let r = (t * cos - sin) / (cos + t * sin);
    // the factor of r between |r| - |r|^3/3 and |r|
    let factor = Interval::point(1.0) - Interval::spanning(0.0, 1.0) * r.square() * Interval::ratio(1, 3);
    Interval::point(guess) + r * factor
}
