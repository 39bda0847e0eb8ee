//! One level of refinement of a sequence of points.

use super::Ends;
use crate::{Lattice, Line};

/// Where the points of order `order` sit: even orders on the knots, odd orders half a step beside them.
pub(super) fn lattice(order: usize) -> Lattice {
    if order.is_multiple_of(2) {
        Lattice::Vertex
    } else {
        Lattice::Face
    }
}

/// The rules of one level of order k with tension u, each with the lattice that it leads to. They are those of
/// [`families::tension`](crate::families::tension) at regular points: for odd orders corner cutting and k-3 averages, for
/// even orders the same product as midpoints, a smoothing with tension and (k-4)/2 without.
fn rules(order: usize, u: f64) -> Vec<(Lattice, Line<f64>)> {
    use Lattice::{Face, Vertex};
    if lattice(order) == Vertex {
        let mut rules = vec![(Vertex, Line::midpoint()), (Vertex, Line::smoothing(u))];
        rules.resize(order / 2, (Vertex, Line::smoothing(1.0)));
        rules
    } else {
        let mut rules = vec![(Face, Line::corner_cutting(u))];
        for _ in 0..(order - 3) / 2 {
            rules.extend([(Vertex, Line::average()), (Face, Line::average())]);
        }
        rules
    }
}

/// Rows of numbers in a line; row i sits at `2 (first + i)` half steps, or at one more on the lattice of faces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rows {
    pub first: i64,
    pub width: usize,
    pub values: Vec<f64>,
}

impl Rows {
    fn count(&self) -> usize {
        self.values.len() / self.width
    }

    /// The rows after one level. Open ends lose the rows that would read beyond them.
    pub fn refine(mut self, order: usize, u: f64, ends: Ends) -> Rows {
        let mut from = lattice(order);
        for (to, line) in rules(order, u) {
            debug_assert!(line.connects(from, to), "the rules of a level follow each other");
            self = self.apply(&line, from, to, ends);
            from = to;
        }
        self
    }

    fn apply(&self, line: &Line<f64>, from: Lattice, to: Lattice, ends: Ends) -> Rows {
        let (count, scale) = (self.count() as i32, line.scale());
        // coordinates count from the first row, which is `scale * 2 * first` half steps off: whole classes of the line
        let source = |x: i32| {
            let index = (x - from.parity()) / 2;
            match ends {
                Ends::Closed => Some(index.rem_euclid(count) as usize),
                Ends::Open => (x >= from.parity() && index < count).then_some(index as usize),
            }
        };
        // a tap reaches at most 4 half steps, so that no open row outside of -2 .. scale * count + 2 can be made
        let range = match ends {
            Ends::Closed => 0..scale * count,
            Ends::Open => -2..scale * count + 2,
        };
        let (mut first, mut values) = (None, Vec::with_capacity(self.values.len() * scale as usize));
        for index in range {
            let x = 2 * index + to.parity();
            let taps: Option<Vec<(usize, f64)>> = line.taps(x).map(|(x, w)| source(x).map(|i| (i, w))).collect();
            let Some(taps) = taps else { continue };
            first.get_or_insert(index);
            let start = values.len();
            values.resize(start + self.width, 0.0);
            for (row, weight) in taps {
                let row = &self.values[row * self.width..(row + 1) * self.width];
                for (sum, value) in values[start..].iter_mut().zip(row) {
                    *sum += weight * value;
                }
            }
        }
        Rows {
            first: i64::from(scale) * self.first + i64::from(first.unwrap_or(0)),
            width: self.width,
            values,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families;

    #[test]
    fn rules_are_the_regular_ones_of_the_family() {
        for order in 3..=families::MAX_ORDER {
            for u in [-0.5, 0.3, 1.0, 2.0] {
                let scheme = families::tension::<f64>(4, order, u).unwrap();
                let passes = scheme.level(0).passes();
                let rules = rules(order, u);
                assert_eq!(passes.len(), rules.len());
                for (pass, (to, line)) in passes.iter().zip(&rules) {
                    assert_eq!((pass.to(), pass.line()), (*to, Some(line)), "order {order}");
                }
            }
        }
    }

    #[test]
    fn an_open_level_has_2n_minus_k_plus_1_points() {
        for order in 3..=12 {
            for count in order..order + 4 {
                // at u = 1 points on a straight line stay at their places for every order
                let shift = f64::from(lattice(order).parity()) / 2.0;
                let rows = Rows {
                    first: 5,
                    width: 1,
                    values: (0..count).map(|i| 5.0 + i as f64 + shift).collect(),
                };
                let fine = rows.refine(order, 1.0, Ends::Open);
                assert_eq!(fine.count(), 2 * count - order + 1);
                for (i, x) in fine.values.iter().enumerate() {
                    let place = (fine.first as f64 + i as f64 + shift) / 2.0;
                    assert!((x - place).abs() < 1e-14, "order {order}: {x} at {place}");
                }
            }
        }
    }
}
