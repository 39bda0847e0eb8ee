//! The levels of the tension scheme beyond the leading ones, all of them at once.
//!
//! Leading levels are listed until the tension is 1 to rounding. Those beyond have tensions `u_L, u_(L+1),
//! ..` that are not 1 but tend to it: with `u' = sqrt((1+u)/2)`,
//!
//! ```text
//! 1 - u' = (1 - u) / (2 (1 + u')),
//! ```
//!
//! so that u' lies between u and 1, and `|1 - u|` shrinks at least by the factor `q = 1/(2 (1 + min(u_L,
//! 1)))` a level, which is nearly 1/4. The weights are rational functions of u without poles above -1. By the
//! mean value theorem each differs from its limit by at most its largest slope over the tensions left times
//! `|1 - u|`; rules run on a [`Dual`] of an interval enclose both. With K the largest sum of slopes of a row,
//!
//! ```text
//! |S_l - S|_oo  <=  K |1 - u_l|  <=  K |1 - u_L| q^(l-L)      for all l >= L.
//! ```

use crate::{Error, Interval};
use eigenring_scheme::families::{tension_after_leading, tension_level};
use eigenring_scheme::{Corner, Dual, Level, Scalar};

/// The levels beyond the leading ones; see the module page.
#[derive(Clone, Debug)]
pub struct Tail {
    /// The rules at any tension that these levels have, the limit's 1 included.
    pub level: Level<Interval>,
    /// The same with their derivatives by the tension.
    slopes: Level<Dual<Interval>>,
    /// `|1 - u_L|` at the first of them.
    distance: Interval,
    /// The factor q.
    ratio: Interval,
}

impl Tail {
    /// The tail of the tension scheme around a corner; `None` for an initial tension of 1, where there is
    /// none.
    ///
    /// # Errors
    /// Those of the rules.
    pub fn new(corner: &Corner, order: usize, u0: f64) -> Result<Option<Self>, Error> {
        let Some(first) = tension_after_leading::<Interval>(u0) else {
            return Ok(None);
        };
        let one = Interval::one();
        let tensions = first.hull(one);
        let least = Interval::point(tensions.lo());
        Ok(Some(Tail {
            level: tension_level(corner, order, tensions)?,
            slopes: tension_level(corner, order, Dual::variable(tensions, 0))?,
            distance: Interval::point((one - first).mag()),
            ratio: one / (Interval::ratio(2, 1) * (one + least)),
        }))
    }

    /// A bound of the 1-norm by which the functional that the levels of the tail leave of an eigenvalue
    /// lambda differs from the left eigenvector w of the limit level, of which `size` is the 1-norm; `None`
    /// if lambda is not proven to be large enough.
    ///
    /// The functional is `l = lim w S_(L+m-1) .. S_L / lambda^m`. With `D_l = S_l - S` and `w S = lambda w`
    /// the differences of the sequence are `w D_(L+m) S_(L+m-1) .. S_L / lambda^(m+1)`, of 1-norm at most
    /// `(size/lambda) K |1-u_L| (M q/lambda)^m`, M bounding `|S_l|_oo`. **If `M q < lambda`** they form a
    /// geometric series, the limit exists, and
    ///
    /// ```text
    /// |l - w|_1  <=  (size/lambda) K |1 - u_L| / (1 - M q/lambda).
    /// ```
    ///
    /// # Errors
    /// Those of running the rules.
    pub fn drift(&self, lambda: Interval, size: Interval) -> Result<Option<f64>, Error> {
        let sites = self.level.row_sites()?;
        let zero = Interval::zero();
        let (mut norm, mut slope) = (0.0_f64, 0.0_f64);
        for row in self.slopes.rows(&sites)? {
            let sum = |size: fn(&Dual<Interval>) -> f64| -> Interval {
                row.values()
                    .fold(zero, |sum, weight| sum + Interval::point(size(weight)))
            };
            norm = norm.max(sum(|weight| weight.value.mag()).hi());
            slope = slope.max(sum(|weight| weight.parts[0].mag()).hi());
        }
        let (norm, slope) = (Interval::point(norm), Interval::point(slope));
        let left = Interval::one() - norm * self.ratio / lambda;
        if !(left.certainly_positive() && lambda.certainly_positive()) {
            return Ok(None);
        }
        let drift = size / lambda * slope * self.distance / left;
        Ok(drift.is_bounded().then_some(drift.mag()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::Centre;

    /// Further levels in exact steps of the tension stay within what is claimed of all of them.
    #[test]
    fn levels_of_the_tail_are_enclosed_and_tend_to_the_limit_as_claimed() {
        for (order, u0) in [(3, -0.9), (4, 0.3), (5, 7.0), (6, 0.0)] {
            let centre = if order % 2 == 0 { Centre::Vertex } else { Centre::Face };
            let corner = Corner::closed(centre, 5).unwrap();
            // a tail that begins early has room to be wrong in
            let start = Interval::point(0.875);
            let tensions = start.hull(Interval::one());
            let tail = Tail {
                level: tension_level(&corner, order, tensions).unwrap(),
                slopes: tension_level(&corner, order, Dual::variable(tensions, 0)).unwrap(),
                distance: Interval::point(0.125),
                ratio: Interval::one() / Interval::point(3.75),
            };
            let sites = tail.level.row_sites().unwrap();
            let enclosure = tail.level.rows(&sites).unwrap();
            let slope: f64 = tail
                .slopes
                .rows(&sites)
                .unwrap()
                .iter()
                .map(|row| row.values().map(|weight| weight.parts[0].mag()).sum())
                .fold(0.0, f64::max);
            let rows = |u: f64| tension_level(&corner, order, u).unwrap().rows(&sites).unwrap();
            let limit = rows(1.0);
            let (mut u, mut bound) = (0.875_f64, slope * 0.125);
            for _ in 0..12 {
                for ((row, limit), enclosure) in rows(u).iter().zip(&limit).zip(&enclosure) {
                    let distance: f64 = row.iter().map(|(site, w)| (w - limit[site]).abs()).sum();
                    assert!(distance <= bound + 1e-14, "{order} {u}: {distance} {bound}");
                    for (site, &weight) in row {
                        let known = enclosure[site] + Interval::around(0.0, 1e-15);
                        assert!(known.contains(weight));
                    }
                }
                (u, bound) = (((1.0 + u) / 2.0).sqrt(), bound * tail.ratio.hi());
            }
            // the one that is used begins where doubles end
            let tail = Tail::new(&corner, order, u0).unwrap().unwrap();
            assert!(tail.distance.mag() < 1e-15 && (tail.ratio.mid() - 0.25).abs() < 1e-15);
            let lambda = Interval::point(0.5);
            assert!(tail.drift(lambda, Interval::one()).unwrap().unwrap() < 1e-13);
            // an eigenvalue of a quarter is too small for the series
            assert_eq!(tail.drift(Interval::point(0.25), Interval::one()).unwrap(), None);
        }
        let corner = Corner::closed(Centre::Vertex, 5).unwrap();
        assert!(Tail::new(&corner, 4, 1.0).unwrap().is_none());
    }
}
