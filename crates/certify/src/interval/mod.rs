//! Intervals of real numbers with double bounds: the arithmetic of every proof in this crate.
//!
//! An [`Interval`] `[lo, hi]` stands for "a real number that is not below `lo` and not above `hi`". Each
//! operation returns an interval that holds every result the operation can have on members of its operands
//! (Moore 1966; Neumaier 1990, *Interval Methods for Systems of Equations*, section 1.4). Bounds are rounded
//! outwards, and only where the double operation was not exact, so that points stay points as long as
//! possible: `0 * x = 0`, `1 * x = x`, and sums and products of small rationals with power-of-two
//! denominators are exact. An entry of a matrix that is zero by construction is then an exact zero, which is
//! what structural arguments need.
//!
//! **No NaN, no panic.** Where a result is not defined (a division by an interval that holds zero, a root of
//! an interval that reaches below zero, a NaN handed in) the result is [`Interval::ENTIRE`]: nothing is
//! known, and whatever is concluded from it is undecided. Bounds may be infinite. One thing is concluded all
//! the same: an interval stands for a real number, so that an exact zero times it is zero. Whoever multiplies
//! what may not be defined by an exact zero has to know that it is defined.
//!
//! Intervals are not ordered. The comparisons here say what is certain: `a.certainly_lt(b)` being false says
//! nothing about `a >= b`.

mod angle;
mod decimal;
#[cfg(test)]
mod extremes;
mod ops;
#[cfg(test)]
pub(crate) mod oracle;
mod round;
mod turn;

use serde::{Deserialize, Serialize};
use std::fmt;

/// A closed interval of real numbers with double bounds, see the module page.
///
/// Stored as the pair of its bounds; an infinite bound is `null` (JSON has no infinities).
#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Bounds", into = "Bounds")]
pub struct Interval {
    lo: f64,
    hi: f64,
}

/// Bounds as stored.
type Bounds = [Option<f64>; 2];

impl Interval {
    /// The whole real line: nothing is known.
    pub const ENTIRE: Interval = Interval {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    };

    /// Exactly the number a double represents; [`Interval::ENTIRE`] for an infinity or a NaN.
    pub fn point(value: f64) -> Self {
        if value.is_finite() {
            // adding zero turns the negative zero into the positive one
            Interval {
                lo: value + 0.0,
                hi: value + 0.0,
            }
        } else {
            Self::ENTIRE
        }
    }

    /// The interval of the given bounds, or `None` where they are no interval (NaN, or in the wrong order).
    pub fn new(lo: f64, hi: f64) -> Option<Self> {
        let proper = lo <= hi && lo < f64::INFINITY && hi > f64::NEG_INFINITY;
        proper.then_some(Interval {
            lo: lo + 0.0,
            hi: hi + 0.0,
        })
    }

    /// The interval of two bounds known to be in order.
    fn spanning(lo: f64, hi: f64) -> Self {
        debug_assert!(lo <= hi, "[{lo}, {hi}]");
        Self::new(lo, hi).unwrap_or(Self::ENTIRE)
    }

    /// `[value - radius, value + radius]`, rounded outwards.
    pub fn around(value: f64, radius: f64) -> Self {
        Self::point(value) + Self::new(-radius.abs(), radius.abs()).unwrap_or(Self::ENTIRE)
    }

    /// `[-1, 1]`.
    pub fn unit() -> Self {
        Interval { lo: -1.0, hi: 1.0 }
    }

    /// An enclosure of a number written as a decimal: a point where a double has that value, adjacent doubles
    /// otherwise. `None` where the text is not a decimal number.
    pub fn parse(text: &str) -> Option<Self> {
        decimal::parse(text)
    }

    /// An enclosure of an integer, a point up to `2^53` and where a double has its value.
    pub fn integer(value: i64) -> Self {
        let nearest = value as f64;
        match (nearest as i128).cmp(&(value as i128)) {
            std::cmp::Ordering::Equal => Self::point(nearest),
            std::cmp::Ordering::Less => Self::spanning(nearest, nearest.next_up()),
            std::cmp::Ordering::Greater => Self::spanning(nearest.next_down(), nearest),
        }
    }

    /// An enclosure of pi: adjacent doubles.
    pub fn pi() -> Self {
        // the double nearest to pi is below it: 3.141592653589793115... against 3.141592653589793238...
        let below = std::f64::consts::PI;
        Self::spanning(below, below.next_up())
    }

    /// Lower bound.
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// Upper bound.
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// A finite double inside the interval, near its middle. Not rounded outwards: the middle is only
    /// approximate.
    pub fn mid(self) -> f64 {
        let mid = if self.lo.is_infinite() || self.hi.is_infinite() {
            if self.lo.is_infinite() && self.hi.is_infinite() {
                0.0
            } else {
                self.lo.max(f64::MIN) / 2.0 + self.hi.min(f64::MAX) / 2.0
            }
        } else {
            self.lo + (self.hi / 2.0 - self.lo / 2.0)
        };
        mid.clamp(self.lo.max(f64::MIN), self.hi.min(f64::MAX)) + 0.0
    }

    /// A bound of the distance of the members from [`Interval::mid`].
    pub fn radius(self) -> f64 {
        let mid = self.mid();
        round::sum(self.hi, -mid).1.max(round::sum(mid, -self.lo).1)
    }

    /// A bound of `hi - lo`.
    pub fn width(self) -> f64 {
        if self.is_bounded() {
            round::sum(self.hi, -self.lo).1
        } else {
            f64::INFINITY
        }
    }

    /// The largest magnitude of a member.
    pub fn mag(self) -> f64 {
        self.hi.abs().max(self.lo.abs())
    }

    /// The smallest magnitude of a member.
    pub fn mig(self) -> f64 {
        if self.contains_zero() {
            0.0
        } else {
            self.hi.abs().min(self.lo.abs())
        }
    }

    /// Whether both bounds are finite.
    pub fn is_bounded(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    /// Whether the interval is one number, known exactly.
    pub fn is_point(self) -> bool {
        self.lo == self.hi
    }

    /// Whether the interval is exactly zero.
    pub fn is_zero(self) -> bool {
        self.lo == 0.0 && self.hi == 0.0
    }

    /// Whether the number of the given double is in the interval. False for a NaN.
    pub fn contains(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// Whether zero is in the interval.
    pub fn contains_zero(self) -> bool {
        self.contains(0.0)
    }

    /// Whether every member of `inner` is a member.
    pub fn encloses(self, inner: Self) -> bool {
        self.lo <= inner.lo && inner.hi <= self.hi
    }

    /// Whether `inner` lies in the interior: what a fixed-point theorem of Brouwer type asks for.
    pub fn encloses_strictly(self, inner: Self) -> bool {
        let below = self.lo < inner.lo || self.lo == f64::NEG_INFINITY && inner.lo > f64::NEG_INFINITY;
        let above = inner.hi < self.hi || self.hi == f64::INFINITY && inner.hi < f64::INFINITY;
        below && above
    }

    /// Whether the two have no common member.
    pub fn disjoint(self, other: Self) -> bool {
        self.hi < other.lo || other.hi < self.lo
    }

    /// Whether every member is positive.
    pub fn certainly_positive(self) -> bool {
        self.lo > 0.0
    }

    /// Whether every member is negative.
    pub fn certainly_negative(self) -> bool {
        self.hi < 0.0
    }

    /// Whether no member is zero.
    pub fn certainly_nonzero(self) -> bool {
        !self.contains_zero()
    }

    /// Whether every member is below every member of the other.
    pub fn certainly_lt(self, other: Self) -> bool {
        self.hi < other.lo
    }

    /// Whether no member is above any member of the other.
    pub fn certainly_le(self, other: Self) -> bool {
        self.hi <= other.lo
    }

    /// Whether every member is above every member of the other.
    pub fn certainly_gt(self, other: Self) -> bool {
        other.certainly_lt(self)
    }

    /// The sign where it is certain: `Some(1)`, `Some(-1)`, `Some(0)` for an exact zero, `None` where it is
    /// open.
    pub fn sign(self) -> Option<i8> {
        if self.lo > 0.0 {
            Some(1)
        } else if self.hi < 0.0 {
            Some(-1)
        } else {
            self.is_zero().then_some(0)
        }
    }

    /// The smallest interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        Interval {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// The common members, `None` where there are none. Two enclosures of one number always intersect.
    pub fn intersect(self, other: Self) -> Option<Self> {
        Self::new(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// The smaller of the two numbers.
    pub fn min(self, other: Self) -> Self {
        Interval {
            lo: self.lo.min(other.lo),
            hi: self.hi.min(other.hi),
        }
    }

    /// The larger of the two numbers.
    pub fn max(self, other: Self) -> Self {
        Interval {
            lo: self.lo.max(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// The two halves, which share the middle.
    pub fn split(self) -> [Self; 2] {
        let mid = self.mid();
        [Interval { hi: mid, ..self }, Interval { lo: mid, ..self }]
    }
}

impl From<Interval> for Bounds {
    fn from(interval: Interval) -> Self {
        [interval.lo, interval.hi].map(|bound| bound.is_finite().then_some(bound))
    }
}

impl TryFrom<Bounds> for Interval {
    type Error = String;
    fn try_from([lo, hi]: Bounds) -> Result<Self, String> {
        let (lo, hi) = (lo.unwrap_or(f64::NEG_INFINITY), hi.unwrap_or(f64::INFINITY));
        Interval::new(lo, hi).ok_or_else(|| format!("an interval has its lower bound first: [{lo}, {hi}]"))
    }
}

impl fmt::Display for Interval {
    /// The bounds with the shortest digits that read back as the same doubles.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_point() {
            write!(f, "{}", digits(self.lo))
        } else {
            write!(f, "[{}, {}]", digits(self.lo), digits(self.hi))
        }
    }
}

/// A number for people.
pub(crate) struct Digits(f64);

/// See [`Digits`].
pub(crate) fn digits(value: f64) -> Digits {
    Digits(value)
}

impl fmt::Display for Digits {
    /// The shortest digits that read back as the same double, with an exponent where most of them would be
    /// zeros.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            0.0 => write!(f, "0"),
            size if (1e-9..1e16).contains(&size) => write!(f, "{}", self.0),
            _ => write!(f, "{:e}", self.0),
        }
    }
}

impl fmt::Debug for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{:e}, {:e}]", self.lo, self.hi)
    }
}

#[cfg(test)]
mod tests;
