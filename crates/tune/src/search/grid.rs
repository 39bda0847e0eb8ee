//! The grid of starting points and its local minima.

use super::{Function, Starts};
use eigenring_scheme::lambda::Domain;

/// Values of a function at the starting points of a domain.
pub(super) struct Grid {
    /// One entry per row of f3, ascending; in it one strip per interval of f2, ascending; in it the points,
    /// ascending in f2.
    rows: Vec<Vec<Strip>>,
}

/// The points on one interval of f2: place and value, infinite where the function is not finite.
type Strip = Vec<([f64; 2], f64)>;

impl Grid {
    pub fn new(function: &impl Function, domain: &Domain, count: usize) -> Self {
        let mut rows: Vec<Vec<Strip>> = Vec::with_capacity(count);
        let points = domain.starts(count);
        for points in points.chunk_by(|a, b| a[1] == b[1]) {
            let valued = points.iter().map(|&[f2, f3]| {
                let value = function.value(f2, f3);
                ([f2, f3], if value.is_finite() { value } else { f64::INFINITY })
            });
            let valued: Strip = valued.collect();
            rows.push(valued.chunks(count).map(<[_]>::to_vec).collect());
        }
        Grid { rows }
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.rows.iter().flatten().map(Vec::len).sum()
    }

    /// Where to start, by rising value. A grid minimum is not above its up to four neighbours, of which equal
    /// ones that come earlier count as lower.
    pub fn starts(&self, starts: Starts) -> Vec<[f64; 2]> {
        let mut chosen = Vec::new();
        for (i, row) in self.rows.iter().enumerate() {
            for (j, strip) in row.iter().enumerate() {
                for (k, &(point, value)) in strip.iter().enumerate() {
                    let minimum = || {
                        let before = k.checked_sub(1).map(|k| strip[k].1);
                        let below = i.checked_sub(1).and_then(|i| self.across(i, row.len(), j, k, point[0]));
                        let above = self.across(i + 1, row.len(), j, k, point[0]);
                        let after = strip.get(k + 1).map(|after| after.1);
                        before.into_iter().chain(below).all(|other| value < other)
                            && after.into_iter().chain(above).all(|other| value <= other)
                    };
                    if value.is_finite() && (starts == Starts::Full || minimum()) {
                        chosen.push((point, value));
                    }
                }
            }
        }
        chosen.sort_by(|a, b| a.1.total_cmp(&b.1));
        chosen.into_iter().map(|(point, _)| point).collect()
    }

    /// The value at the neighbour in another row of point k of strip j of `strips`: the same place in a row
    /// of as many strips, the nearest f2 in a row of another number.
    fn across(&self, row: usize, strips: usize, j: usize, k: usize, f2: f64) -> Option<f64> {
        let row = self.rows.get(row)?;
        if row.len() == strips {
            return row[j].get(k).map(|&(_, value)| value);
        }
        let distance = |point: &&([f64; 2], f64)| (point.0[0] - f2).abs();
        let nearest = row.iter().flatten().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.map(|&(_, value)| value)
    }
}
