//! The knot intervals around one extraordinary vertex.

use crate::Error;
use crate::error::MAX_SPOKES;
use eigenring_scheme::is_interval;

/// The intervals `d_i` of the edges V-E_i around a vertex V, and `a_i` of the next edges outward,
/// counter-clockwise and with indices mod n: 0 or 1e-60 to 1e60, at three spokes or more.
#[derive(Clone, Debug, PartialEq)]
pub struct Spokes {
    d: Vec<f64>,
    a: Vec<f64>,
}

impl Spokes {
    /// Checks and keeps intervals.
    ///
    /// # Errors
    /// [`Error::Counts`], [`Error::Interval`].
    pub fn new(d: Vec<f64>, a: Vec<f64>) -> Result<Self, Error> {
        if !(3..=MAX_SPOKES).contains(&d.len()) || a.len() != d.len() {
            return Err(Error::Counts {
                spokes: d.len(),
                next: a.len(),
                least: 3,
            });
        }
        for (of, intervals) in [("spoke", &d), ("the edge beyond spoke", &a)] {
            if let Some(i) = intervals.iter().position(|&x| !is_interval(x)) {
                return Err(Error::Interval {
                    what: format!("{of} {i}"),
                    value: intervals[i],
                });
            }
        }
        Ok(Spokes { d, a })
    }

    /// Intervals of which the next ones are the same, as they are after a level.
    ///
    /// # Errors
    /// As [`Spokes::new`].
    pub fn stationary(d: Vec<f64>) -> Result<Self, Error> {
        Spokes::new(d.clone(), d)
    }

    /// The same spokes after a level: all further edges have the interval of the first.
    #[must_use]
    pub fn after_a_level(&self) -> Self {
        Spokes {
            d: self.d.clone(),
            a: self.d.clone(),
        }
    }

    /// The number n of spokes.
    pub fn valence(&self) -> usize {
        self.d.len()
    }

    /// The intervals of the spokes.
    pub fn intervals(&self) -> &[f64] {
        &self.d
    }

    /// Those of the next edges.
    pub fn next(&self) -> &[f64] {
        &self.a
    }

    /// The interval of spoke i, for any i.
    pub fn d(&self, i: isize) -> f64 {
        self.d[self.index(i)]
    }

    /// That of the next edge.
    pub fn a(&self, i: isize) -> f64 {
        self.a[self.index(i)]
    }

    /// The number of a spoke in 0..n.
    pub fn index(&self, i: isize) -> usize {
        i.rem_euclid(self.d.len() as isize) as usize
    }
}
