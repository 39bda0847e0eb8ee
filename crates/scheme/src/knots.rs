//! The rules of cubic B-splines with knot intervals, across one spoke.
//!
//! The univariate rules are those of [`eigenring_spline::intervals`]; here they become a [`Line`], whose taps
//! differ near the spoke.

use crate::{Line, Scalar, Taps};
use eigenring_spline::intervals;
use std::collections::BTreeMap;

/// The intervals on both sides of a spoke, from the first edge on; the last one holds for all further edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Intervals {
    /// Beyond the spoke, at least one.
    pub before: Vec<f64>,
    /// On this side, at least one.
    pub after: Vec<f64>,
    /// Whether points are doubled along the spoke, with a strip of zero width between that is never split.
    pub doubled: bool,
}

impl Intervals {
    /// The interval of the edge from point j to point j+1, point 0 being the first on this side.
    fn edge(&self, j: i32) -> f64 {
        let at = |side: &[f64], index: i32| side.get(index as usize).or(side.last()).copied().unwrap_or(1.0);
        // with doubled points, edge -1 is the strip
        match (self.doubled, j) {
            (_, 0..) => at(&self.after, j),
            (true, -1) => 0.0,
            (true, _) => at(&self.before, -2 - j),
            (false, _) => at(&self.before, -1 - j),
        }
    }

    fn edge_point<S: Scalar>(&self, j: i32) -> BTreeMap<i32, S> {
        let weights = intervals::edge([-1, 0, 1].map(|by| self.edge(j + by)));
        (j..).zip(weights).collect()
    }

    fn vertex_point<S: Scalar>(&self, j: i32) -> BTreeMap<i32, S> {
        let weights = intervals::vertex::<S>([-2, -1, 0, 1].map(|by| self.edge(j + by)));
        let mut point: BTreeMap<i32, S> = (j - 1..).zip(weights).collect();
        point.retain(|_, weight| !weight.same(&S::zero()));
        point
    }

    /// The rule on this side of the spoke, in half steps: uniform beyond the edges that are listed.
    pub fn line<S: Scalar>(&self) -> Line<S> {
        // the place of point j: 2 j around a vertex, 2 j + 1 and -2 j - 1 on the two sides of doubled points
        let place = |j: i32| match (self.doubled, j) {
            (false, _) => 2 * j,
            (true, _) => 2 * j + 1,
        };
        let taps =
            |point: BTreeMap<i32, S>| -> Taps<S> { point.into_iter().map(|(j, weight)| (place(j), weight)).collect() };
        let [eighth, half] = [(1, 8), (1, 2)].map(|(p, q)| S::ratio(p, q));
        let middle = || S::ratio(3, 4);
        let uniform = if self.doubled {
            // the first point on this side keeps its place
            vec![
                vec![(-3, eighth.clone()), (1, middle()), (5, eighth)],
                vec![(-1, half.clone()), (3, half)],
            ]
        } else {
            vec![
                vec![(-4, eighth.clone()), (0, middle()), (4, eighth)],
                vec![(-2, half.clone()), (2, half)],
            ]
        };
        let first = self.after[0];
        if !self.doubled && first > 0.0 && self.before.iter().chain(&self.after).all(|&d| d == first) {
            return Line::new(uniform);
        }
        // a vertex sees two edges on either side of it, an edge one beside itself
        let mut line = Line::new(uniform);
        for j in 0..self.after.len() as i32 + 1 {
            line = line.with_near(place(2 * j), taps(self.vertex_point(j)));
            line = line.with_near(place(2 * j + 1), taps(self.edge_point(j)));
        }
        line
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The blossom of a cubic polynomial with coefficients c (lowest first).
    fn blossom(c: [f64; 4], [a, b, d]: [f64; 3]) -> f64 {
        c[0] + c[1] * (a + b + d) / 3.0 + c[2] * (a * b + a * d + b * d) / 3.0 + c[3] * a * b * d
    }

    proptest! {
        /// Control points of a cubic polynomial are values of its blossom at three knots; refined ones at
        /// three refined knots.
        #[test]
        fn rules_are_those_of_blossoms(
            before in 0.1..3.0_f64, far in 0.1..3.0_f64, after in 0.1..3.0_f64, beyond in 0.1..3.0_f64,
            c in proptest::array::uniform4(-1.0..1.0_f64), doubled in any::<bool>(),
        ) {
            let intervals = Intervals { before: vec![before, far], after: vec![after, beyond], doubled };
            let knot = |j: i32| if j >= 0 {
                (0..j).map(|i| intervals.edge(i)).sum::<f64>()
            } else {
                -(j..0).map(|i| intervals.edge(i)).sum::<f64>()
            };
            let point = |j: i32| blossom(c, [knot(j - 1), knot(j), knot(j + 1)]);
            // the refined knots from the spoke on, and the one before: the strip of doubled points is not
            // halved
            let fine = |j: i32| match j {
                0.. => knot(j / 2) + f64::from(j % 2) * intervals.edge(j / 2) / 2.0,
                _ if doubled => knot(-1),
                _ => knot(-1) / 2.0,
            };
            let line = intervals.line::<f64>();
            for j in 0..6 {
                let expected = blossom(c, [fine(j - 1), fine(j), fine(j + 1)]);
                let place = if doubled { 2 * j + 1 } else { 2 * j };
                let index = |x: i32| if doubled { (x - 1) / 2 } else { x / 2 };
                let found: f64 = line.taps(place).map(|(x, w)| w * point(index(x))).sum();
                prop_assert!((found - expected).abs() < 1e-12, "{} {} {}", j, found, expected);
            }
        }
    }

    #[test]
    fn zero_intervals_are_multiple_knots() {
        let triple = Intervals {
            before: vec![0.0],
            after: vec![0.0, 1.0],
            doubled: false,
        };
        let at = |x: i32| triple.line::<f64>().taps(x).collect::<Vec<_>>();
        assert_eq!(at(0), [(0, 1.0)]);
        let clamped = Intervals {
            before: vec![0.0, 1.0],
            after: vec![1.0],
            doubled: false,
        };
        let sum: f64 = clamped.line::<f64>().taps(0).map(|(_, w)| w).sum();
        assert!((sum - 1.0).abs() < 1e-15);
    }
}
