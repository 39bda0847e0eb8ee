//! One parameter direction of a curve or grid.

use super::clamped::Clamped;
use super::rule::{Rows, shift};
use super::{Basis, Ends, MAX_ORDER, MIN_ORDER, Tension};
use crate::Error;

/// The most numbers that a polygon or grid may hold, 1 GiB: refinement beyond that is refused and not
/// attempted.
const MAX_NUMBERS: usize = 1 << 27;

/// A combination of control points: their indices and weights. A closed polygon of fewer points than its
/// order names some more than once.
pub type Weights = Vec<(usize, f64)>;

/// Order, tension, ends and number of points, at one level of refinement; the control points themselves are
/// elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    basis: Basis,
    ends: Ends,
    level: u32,
    first: i64,
    count: usize,
}

impl Axis {
    /// The direction of `count` control points of order `order` with initial tension `u0`.
    ///
    /// # Errors
    /// [`Error::Order`] unless `2 <= order <= MAX_ORDER`, [`Error::Tension`] unless u0 is finite and above
    /// -1, [`Error::Polynomial`] unless it is 1 at order 2 and for clamped ends, [`Error::ControlPoints`] for
    /// fewer than `order` points between two ends or fewer than 3 in a closed polygon.
    pub fn new(order: usize, u0: f64, ends: Ends, count: usize) -> Result<Self, Error> {
        if !(2..=MAX_ORDER).contains(&order) {
            return Err(Error::Order {
                order,
                minimum: 2,
                maximum: MAX_ORDER,
            });
        }
        let tension = Tension::new(u0)?;
        let what = match ends {
            _ if order < MIN_ORDER => Some("order 2"),
            Ends::Clamped => Some("clamped ends"),
            Ends::Open | Ends::Closed => None,
        };
        if let Some(what) = what
            && u0 != 1.0
        {
            return Err(Error::Polynomial { what, tension: u0 });
        }
        let minimum = match ends {
            Ends::Open | Ends::Clamped => order,
            Ends::Closed => 3,
        };
        if !(minimum..=MAX_NUMBERS).contains(&count) {
            return Err(Error::ControlPoints {
                count,
                minimum,
                maximum: MAX_NUMBERS,
            });
        }
        Ok(Axis {
            basis: Basis::new(order, tension),
            ends,
            level: 0,
            first: 0,
            count,
        })
    }

    /// The order k.
    pub fn order(&self) -> usize {
        self.basis.order()
    }

    /// The tension of this level: the next refinement uses it.
    pub fn tension(&self) -> Tension {
        self.basis.tension()
    }

    /// How the polygon ends.
    pub fn ends(&self) -> Ends {
        self.ends
    }

    /// The number of refinements since the control polygon.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// The number of points.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The basis of this level.
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// The length of a parameter interval between knots.
    pub fn step(&self) -> f64 {
        (-f64::from(self.level)).exp2()
    }

    /// The parameter of point i: the peak of its influence.
    pub fn parameter(&self, i: usize) -> f64 {
        if self.ends == Ends::Clamped {
            return self.clamped().parameter(i) * self.step();
        }
        (self.first as f64 + i as f64 + shift(self.order())) * self.step()
    }

    /// The number of intervals between knots on which there is a curve.
    pub fn intervals(&self) -> usize {
        match self.ends {
            Ends::Open | Ends::Clamped => self.count + 1 - self.order(),
            Ends::Closed => self.count,
        }
    }

    /// The parameters on which there is a curve; a closed one continues periodically. The same at every
    /// level.
    pub fn domain(&self) -> (f64, f64) {
        let start = self.start();
        (
            start as f64 * self.step(),
            (start + self.intervals() as i64) as f64 * self.step(),
        )
    }

    /// The first knot of the domain.
    fn start(&self) -> i64 {
        match self.ends {
            Ends::Open => self.first + (self.order() as i64 - 1) / 2,
            Ends::Clamped | Ends::Closed => 0,
        }
    }

    /// The knots of clamped ends.
    fn clamped(&self) -> Clamped {
        Clamped::new(self.order(), self.intervals())
    }

    /// The k points that reach the interval after knot `start + interval`.
    fn active(&self, interval: usize) -> impl Iterator<Item = usize> + use<> {
        let base = match self.ends {
            Ends::Clamped => interval as i64,
            Ends::Open | Ends::Closed => {
                let before = (self.order() as i64).div_euclid(2) + self.order() as i64 % 2 - 1;
                self.start() + interval as i64 - before - self.first
            }
        };
        let count = self.count as i64;
        // open ends need no folding, as the intervals of the domain have all their points
        (0..self.order() as i64).map(move |j| (base + j).rem_euclid(count) as usize)
    }

    /// The limit point at parameter t as a combination of control points: their indices and weights.
    ///
    /// # Errors
    /// [`Error::OutsideSpline`] if t is outside of an open domain, or not finite.
    pub fn weights(&self, t: f64) -> Result<Weights, Error> {
        let (lower, upper) = match self.ends {
            Ends::Open | Ends::Clamped => self.domain(),
            Ends::Closed => (f64::MIN, f64::MAX),
        };
        if !(t >= lower && t <= upper) {
            return Err(Error::OutsideSpline { value: t, lower, upper });
        }
        let (from, to) = self.domain();
        let t = match self.ends {
            Ends::Open | Ends::Clamped => t,
            Ends::Closed => t.rem_euclid(to - from),
        };
        let place = (t - from) / self.step();
        let interval = place.floor().min((self.intervals() - 1) as f64);
        Ok(match self.ends {
            Ends::Clamped => self.clamped_weights(interval as usize, place),
            Ends::Open | Ends::Closed => self.weights_in(interval as usize, &self.basis.values(place - interval)),
        })
    }

    /// The weights at a place counted in intervals.
    fn clamped_weights(&self, interval: usize, place: f64) -> Weights {
        self.weights_in(interval, &self.clamped().weights(interval, |_| place))
    }

    fn weights_in(&self, interval: usize, values: &[f64]) -> Weights {
        self.active(interval).zip(values.iter().copied()).collect()
    }

    /// The weights at `per_interval` equally spaced parameters of each interval, and at the end of the
    /// domain: (parameter, weights). The basis is evaluated `per_interval + 1` times only.
    ///
    /// # Errors
    /// [`Error::ControlPoints`] if there would be too many samples.
    pub fn samples(&self, per_interval: usize) -> Result<Vec<(f64, Weights)>, Error> {
        let per_interval = per_interval.max(1);
        room(self.intervals().saturating_mul(per_interval), self.order())?;
        let fraction = |j: usize| j as f64 / per_interval as f64;
        let values: Vec<Vec<f64>> = (0..=per_interval).map(|j| self.basis.values(fraction(j))).collect();
        let at = |interval: usize, j: usize| {
            let t = ((self.start() + interval as i64) as f64 + fraction(j)) * self.step();
            // the functions of two intervals are alike away from the ends only
            let weights = match self.ends {
                Ends::Clamped => self.clamped_weights(interval, interval as f64 + fraction(j)),
                Ends::Open | Ends::Closed => self.weights_in(interval, &values[j]),
            };
            (t, weights)
        };
        let intervals = self.intervals();
        Ok((0..intervals)
            .flat_map(|interval| (0..per_interval).map(move |j| (interval, j)))
            .chain([(intervals - 1, per_interval)])
            .map(|(interval, j)| at(interval, j))
            .collect())
    }

    /// One level of refinement of `count` rows of `width` numbers each, which lie one after the other in
    /// `values`.
    ///
    /// # Errors
    /// [`Error::ControlPoints`] if there would be too many numbers.
    pub(super) fn refine(&self, width: usize, values: Vec<f64>) -> Result<(Axis, Vec<f64>), Error> {
        debug_assert_eq!(values.len(), self.count * width, "as many rows as points");
        room(2 * self.count, width)?;
        let first = self.first;
        let rows = match self.ends {
            Ends::Clamped => Rows {
                first,
                width,
                values: self.clamped().refine(width, &values),
            },
            Ends::Open | Ends::Closed => {
                Rows { first, width, values }.refine(self.order(), self.tension().value(), self.ends)
            }
        };
        let axis = Axis {
            basis: self.basis.with_tension(self.tension().next()),
            ends: self.ends,
            level: self.level + 1,
            first: rows.first,
            count: rows.values.len() / width,
        };
        Ok((axis, rows.values))
    }
}

/// Refuses more numbers than memory may hold.
fn room(count: usize, width: usize) -> Result<(), Error> {
    let maximum = MAX_NUMBERS / width;
    if count <= maximum {
        return Ok(());
    }
    Err(Error::ControlPoints {
        count,
        minimum: 3,
        maximum,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_domain_is_the_same_at_every_level() {
        for order in 2..=9 {
            for ends in [Ends::Open, Ends::Clamped, Ends::Closed] {
                let u0 = if order == 2 || ends == Ends::Clamped { 1.0 } else { 0.5 };
                let mut axis = Axis::new(order, u0, ends, order + 2).unwrap();
                let (domain, intervals) = (axis.domain(), axis.intervals());
                let mut values: Vec<f64> = (0..order + 2).map(|i| i as f64).collect();
                for level in 0..5 {
                    assert_eq!(
                        (axis.domain(), axis.intervals()),
                        (domain, intervals << level),
                        "order {order}"
                    );
                    assert!(axis.parameter(0) <= domain.0 + 0.5);
                    (axis, values) = axis.refine(1, values).unwrap();
                }
            }
        }
    }

    #[test]
    fn a_point_weighs_most_at_its_own_parameter() {
        for order in 3..=9 {
            let axis = Axis::new(order, 1.0, Ends::Closed, 12).unwrap();
            for i in 0..12 {
                let weights = axis.weights(axis.parameter(i)).unwrap();
                let top = weights.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
                assert_eq!(top.0, i, "order {order}");
            }
        }
    }

    #[test]
    fn parameters_out_of_range_are_refused() {
        let open = Axis::new(5, 1.0, Ends::Open, 7).unwrap();
        assert_eq!(open.domain(), (2.0, 5.0));
        for t in [1.999, 5.001, f64::NAN, f64::INFINITY] {
            assert!(matches!(open.weights(t), Err(Error::OutsideSpline { .. })));
        }
        assert!(open.weights(2.0).is_ok() && open.weights(5.0).is_ok());
        let closed = Axis::new(5, 1.0, Ends::Closed, 7).unwrap();
        assert!(closed.weights(-1e9).is_ok() && closed.weights(f64::NAN).is_err());
        assert!(closed.weights(-f64::MIN_POSITIVE).is_ok());
    }

    #[test]
    fn what_memory_cannot_hold_is_refused() {
        assert!(room(MAX_NUMBERS / 6, 6).is_ok());
        assert!(matches!(room(MAX_NUMBERS / 6 + 1, 6), Err(Error::ControlPoints { .. })));
        assert!(matches!(
            Axis::new(3, 1.0, Ends::Closed, usize::MAX),
            Err(Error::ControlPoints { .. })
        ));
    }
}
