//! Coordinates in units of the domain, and the way back into it.

use eigenring_scheme::lambda::{ConstraintCurve, Domain, F2Interval};
use eigenring_spline::Dual;

/// A domain with its two units of length.
pub(super) struct Frame<'a> {
    pub domain: &'a Domain,
    /// Units of f2 and f3: the longest interval of f2 on a few rows, and the range of f3 (zero at N = 4,
    /// where f3 does not vary).
    pub unit: [f64; 2],
    /// The range of f3.
    pub f3: [f64; 2],
}

/// On which side of a curve the domain lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The curve is a lower end of an interval of f2.
    Lower,
    /// The curve is an upper end.
    Upper,
}

/// A boundary curve near a point p, in units of the domain: `x = offset + slope y + bend y^2/2 + ...`
/// relative to p.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub curve: ConstraintCurve,
    pub side: Side,
    pub offset: f64,
    pub slope: f64,
    pub bend: f64,
}

impl<'a> Frame<'a> {
    pub fn new(domain: &'a Domain) -> Self {
        let f3 = domain.f3_range().map(|end| end.f3);
        // rows enough to know the order of magnitude, which is all that a unit needs
        let lengths = (0..=4).flat_map(|row| domain.f2_intervals(domain.f3_at(f64::from(row) / 4.0)));
        let width = lengths.map(|interval| interval.length()).fold(0.0, f64::max);
        Frame {
            domain,
            // a domain that is a point has no unit of its own
            unit: [if width > 0.0 { width } else { 1.0 }, f3[1] - f3[0]],
            f3,
        }
    }

    /// Whether f3 is fixed.
    pub fn is_flat(&self) -> bool {
        self.unit[1] == 0.0
    }

    /// The point of the domain at the nearest f3 of its range and the nearest f2 there.
    pub fn project(&self, [f2, f3]: [f64; 2]) -> Option<[f64; 2]> {
        let f3 = f3.clamp(self.f3[0], self.f3[1]);
        let mut nearest: Option<f64> = None;
        for F2Interval { lower, upper } in self.domain.f2_intervals(f3) {
            let candidate = f2.clamp(lower.f2, upper.f2);
            if nearest.is_none_or(|other| (candidate - f2).abs() < (other - f2).abs()) {
                nearest = Some(candidate);
            }
        }
        nearest.map(|f2| [f2, f3])
    }

    /// The step from `from` to `to`, in units of the domain.
    pub fn step(&self, from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
        let y = if self.is_flat() {
            0.0
        } else {
            (to[1] - from[1]) / self.unit[1]
        };
        [(to[0] - from[0]) / self.unit[0], y]
    }

    /// The larger component of a step.
    pub fn distance(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let [x, y] = self.step(from, to);
        x.abs().max(y.abs())
    }

    /// The point at a step from `from`.
    pub fn moved(&self, from: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
        [from[0] + x * self.unit[0], from[1] + y * self.unit[1]]
    }

    /// How far a step may change f3 before it leaves the range.
    pub fn room(&self, f3: f64) -> [f64; 2] {
        if self.is_flat() {
            return [0.0; 2];
        }
        self.f3.map(|end| (end - f3) / self.unit[1])
    }

    /// The curves that end the intervals of f2 at the f3 of a point and at `reach` on both sides of it. Two
    /// curves that meet nearby are both seen.
    pub fn arcs(&self, point: [f64; 2], reach: f64) -> Vec<Arc> {
        let mut arcs: Vec<Arc> = Vec::with_capacity(6);
        for y in [0.0, -reach, reach] {
            let f3 = (point[1] + y * self.unit[1]).clamp(self.f3[0], self.f3[1]);
            for F2Interval { lower, upper } in self.domain.f2_intervals(f3) {
                for (curve, side) in [(lower.curve, Side::Lower), (upper.curve, Side::Upper)] {
                    if arcs.iter().all(|arc| arc.curve != curve) {
                        arcs.extend(self.arc(curve, side, point));
                    }
                }
            }
        }
        arcs
    }

    /// A curve near a point; `None` if it does not exist at the point's f3.
    fn arc(&self, curve: ConstraintCurve, side: Side, [f2, f3]: [f64; 2]) -> Option<Arc> {
        let y = Dual::<Dual<f64>>::variable(Dual::variable(f3, 0), 0);
        let along = self.domain.curve_over(curve, y);
        let [unit2, unit3] = self.unit;
        let arc = Arc {
            curve,
            side,
            offset: (along.value.value - f2) / unit2,
            slope: along.parts[0].value * unit3 / unit2,
            bend: along.parts[0].parts[0] * unit3 * unit3 / unit2,
        };
        (arc.offset.is_finite() && arc.slope.is_finite() && arc.bend.is_finite()).then_some(arc)
    }
}
