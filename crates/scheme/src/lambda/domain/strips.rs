//! The domain cut into strips along f3: a map of its arcs and vertices.
//!
//! Inside a strip the same curves bound the same number of intervals of f2, so the boundary of the domain
//! consists of the strips' arcs and of the edges at the ends of the range of f3. The vertices lie at the
//! strips' ends: there one curve takes over from another, or a lower and an upper curve meet, and with them
//! an interval ends or the gap between two intervals closes (with a vertical tangent, if the two are the
//! roots of one quadratic).

use super::{ConstraintCurve, Domain, F2Interval};

/// A range of f3 over which the same curves bound the feasible f2.
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// From and to which f3; neighbouring strips share an end up to rounding.
    pub f3: [f64; 2],
    /// Lower and upper curve of each interval of f2, ascending; empty where nothing is feasible (phi other
    /// than 6).
    pub curves: Vec<[ConstraintCurve; 2]>,
}

type Structure = Vec<[ConstraintCurve; 2]>;

fn structure(intervals: &[F2Interval]) -> Structure {
    intervals.iter().map(|i| [i.lower.curve, i.upper.curve]).collect()
}

impl Domain {
    /// The strips, ascending in f3. Their ends are found to a few rounding units; strips that lie between two
    /// neighbouring rows of 256 with equal structure are not seen.
    pub fn strips(&self) -> Vec<Strip> {
        let at = |f3: f64| structure(&self.f2_intervals(f3));
        let [low, high] = self.f3.map(|end| end.f3);
        let mut strips = vec![Strip {
            f3: [low, low],
            curves: at(low),
        }];
        if low == high {
            return strips;
        }
        let mut from = low;
        for row in 1..=Self::ROWS {
            let to = self.f3_at(f64::from(row) / f64::from(Self::ROWS));
            cut(&mut strips, [from, to], at(to), &at);
            from = to;
        }
        strips
    }
}

/// Extends the last strip, which reaches from.., to ..to, with as many changes between as there are.
fn cut(strips: &mut Vec<Strip>, [from, to]: [f64; 2], curves: Structure, at: &impl Fn(f64) -> Structure) {
    let Some(last) = strips.last_mut() else { return };
    if last.curves == curves {
        last.f3[1] = to;
        return;
    }
    let middle = 0.5 * (from + to);
    // structures flicker among the last few roundings
    if to - from <= 4.0 * f64::EPSILON * to.abs() || middle <= from || middle >= to {
        strips.push(Strip { f3: [to, to], curves });
        return;
    }
    cut(strips, [from, middle], at(middle), at);
    cut(strips, [middle, to], curves, at);
}
