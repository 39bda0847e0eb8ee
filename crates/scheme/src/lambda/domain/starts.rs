//! Points of the domain: the unit square and starts for a search.

use super::Domain;

impl Domain {
    /// Feasible starting points for a search: `count` rows of f3, at the middles of as many equal parts of
    /// its range, and on each feasible interval of f2 in a row `count` points, at the middles of its parts.
    /// So there are `count^2` points, at N = 3 up to twice as many (two intervals), at N = 4 only `count`
    /// (one row). Points on the boundary are left to searches along its edges and curves. Ordered by f3, then
    /// f2.
    pub fn starts(&self, count: usize) -> Vec<[f64; 2]> {
        let middles = || (0..count).map(|i| (i as f64 + 0.5) / count as f64);
        let rows = if self.plane.valence == 4 { count.min(1) } else { count };
        let mut points = Vec::with_capacity(2 * rows * count);
        for v in middles().take(rows) {
            let f3 = self.f3_at(v);
            for interval in self.f2_intervals(f3) {
                points.extend(middles().map(|u| [interval.at(u), f3]));
            }
        }
        points
    }

    /// The f3 at a fraction v of its range.
    pub fn f3_at(&self, v: f64) -> f64 {
        let [lower, upper] = self.f3.map(|end| end.f3);
        (lower + v * (upper - lower)).clamp(lower, upper)
    }

    /// The image (f2, f3) of a point (u, v) of the unit square: v is the fraction of the range of f3, u that
    /// of the interval of f2 with the given number (0 or, where there are two, 1). `None` if there is no such
    /// interval.
    pub fn point(&self, u: f64, v: f64, interval: usize) -> Option<[f64; 2]> {
        let f3 = self.f3_at(v);
        let interval = *self.f2_intervals(f3).get(interval)?;
        Some([interval.at(u), f3])
    }
}

impl super::F2Interval {
    /// The f2 at a fraction u of the interval.
    pub fn at(&self, u: f64) -> f64 {
        (self.lower.f2 + u * (self.upper.f2 - self.lower.f2)).clamp(self.lower.f2, self.upper.f2)
    }

    /// The length.
    pub fn length(&self) -> f64 {
        self.upper.f2 - self.lower.f2
    }
}
