//! One level of refinement of a sequence of points.

use super::Ends;

/// A rule of one dimension in terms of rows: row `scale i + c` of the result is the sum of `weight` times row
/// `i + offset` over the taps `(offset, weight)` of class c, with as many classes as the result is finer.
///
/// Rows of odd orders sit half a step behind their number; an average leads from one kind to the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    classes: Vec<Vec<(i64, f64)>>,
}

impl Rule {
    /// The taps `(offset, weight)` of each class.
    pub fn classes(&self) -> &[Vec<(i64, f64)>] {
        &self.classes
    }

    /// Rows stay, and between any two their mean is put.
    fn midpoint() -> Self {
        Rule {
            classes: vec![vec![(0, 1.0)], vec![(0, 0.5), (1, 0.5)]],
        }
    }

    /// Smoothing (1, 2u, 1) / (2 (1+u)).
    fn smoothing(u: f64) -> Self {
        let side = 1.0 / (2.0 * (1.0 + u));
        Rule {
            classes: vec![vec![(-1, side), (0, u / (1.0 + u)), (1, side)]],
        }
    }

    /// Corner cutting (1+2u, 1) / (2 (1+u)).
    fn corner_cutting(u: f64) -> Self {
        let far = 1.0 / (2.0 * (1.0 + u));
        let near = 1.0 - far;
        Rule {
            classes: vec![vec![(0, near), (-1, far)], vec![(0, near), (1, far)]],
        }
    }

    /// The mean of a row and the one before, which sits on the knot between rows of odd orders.
    fn mean_before() -> Self {
        Rule {
            classes: vec![vec![(-1, 0.5), (0, 0.5)]],
        }
    }

    /// The mean of a row and the one behind, which sits half a step behind the knot.
    fn mean_behind() -> Self {
        Rule {
            classes: vec![vec![(0, 0.5), (1, 0.5)]],
        }
    }
}

/// Where points sit behind the knot of their number, in steps: 0 for even orders, 1/2 for odd ones.
pub(super) fn shift(order: usize) -> f64 {
    if order.is_multiple_of(2) { 0.0 } else { 0.5 }
}

/// The rules of one level of order k with tension u: for odd orders corner cutting and k-3 averages, for even
/// orders the same product as midpoints, a smoothing with tension and (k-4)/2 without. They are those of the
/// generalised surface scheme at regular points.
pub fn rules(order: usize, u: f64) -> Vec<Rule> {
    if order.is_multiple_of(2) {
        let mut rules = vec![Rule::midpoint(), Rule::smoothing(u)];
        rules.resize(order / 2, Rule::smoothing(1.0));
        rules
    } else {
        let mut rules = vec![Rule::corner_cutting(u)];
        for _ in 0..order.saturating_sub(3) / 2 {
            rules.extend([Rule::mean_before(), Rule::mean_behind()]);
        }
        rules
    }
}

/// Rows of numbers in a line, the first of which has the number `first`.
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
    pub fn refine(self, order: usize, u: f64, ends: Ends) -> Rows {
        rules(order, u).iter().fold(self, |rows, rule| rows.apply(rule, ends))
    }

    fn apply(&self, rule: &Rule, ends: Ends) -> Rows {
        let (count, scale) = (self.count() as i64, rule.classes.len() as i64);
        // numbers count from the first row, whose image is the row `scale * first`
        let source = |index: i64| match ends {
            Ends::Closed => Some(index.rem_euclid(count) as usize),
            Ends::Open | Ends::Clamped => (0..count).contains(&index).then_some(index as usize),
        };
        // all classes read the row of offset 0, so that no other row than these can be made at an open end
        let (mut first, mut values) = (None, Vec::with_capacity(self.values.len() * scale as usize));
        for index in 0..scale * count {
            let (row, class) = (index.div_euclid(scale), index.rem_euclid(scale) as usize);
            let taps = rule.classes[class].iter();
            let taps: Option<Vec<(usize, f64)>> = taps
                .map(|&(offset, weight)| source(row + offset).map(|i| (i, weight)))
                .collect();
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
            first: scale * self.first + first.unwrap_or(0),
            width: self.width,
            values,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_level_has_2n_minus_k_plus_1_points() {
        for order in 3..=12 {
            for count in order..order + 4 {
                // at u = 1 points on a straight line stay at their places for every order
                let shift = shift(order);
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
