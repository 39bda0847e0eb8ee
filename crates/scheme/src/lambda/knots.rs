//! The knot vector of the spline stencils.

use eigenring_spline::{Error, Knots};
use serde::{Deserialize, Serialize};

/// The knots that determine the spline space of a valence (Ma, Wang and Ma 2023, Eq. 21): cubic, with the end
/// knots `a`, `e` four times, the triple knots `b`, `c`, `d` where the stencils may have kinks, and in the
/// paper a single knot half way between each two neighbours:
///
/// ```text
/// a a a a  (a+b)/2  b b b  (b+c)/2  c c c  (c+d)/2  d d d  (d+e)/2  e e e e        21 knots, 17 coefficients
/// ```
///
/// `c` is lambda_l, the smallest lambda with bounded curvature, or, where that is beyond `e` (from N = 24 on
/// with the paper's 0.9), a kink like the other two. Finer splines have more single knots, in equal steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LambdaKnots {
    /// Start of the domain, 0.15 in the paper.
    pub a: f64,
    /// First triple knot.
    pub b: f64,
    /// Second triple knot, lambda_l if that is below the end.
    pub c: f64,
    /// Third triple knot.
    pub d: f64,
    /// End of the domain, 0.9 in the paper.
    pub e: f64,
    /// How many single knots there are in each of the four intervals, one in the paper.
    #[serde(
        default = "LambdaKnots::paper_singles",
        skip_serializing_if = "LambdaKnots::are_paper_singles"
    )]
    pub singles: [usize; 4],
}

impl LambdaKnots {
    /// Degree of the splines.
    pub const DEGREE: usize = 3;
    /// The single knots of the paper.
    pub const SINGLES: [usize; 4] = [1; 4];
    /// The most single knots of an interval. Empirical: a sixth of it serves the tables.
    pub const MOST_SINGLES: usize = 64;

    fn paper_singles() -> [usize; 4] {
        Self::SINGLES
    }

    fn are_paper_singles(singles: &[usize; 4]) -> bool {
        *singles == Self::SINGLES
    }

    /// Number of coefficients: 17 in the paper.
    pub fn dimension(&self) -> usize {
        13 + self.singles.iter().sum::<usize>()
    }

    /// The five knots in order.
    pub fn values(&self) -> [f64; 5] {
        [self.a, self.b, self.c, self.d, self.e]
    }

    /// The spline space.
    ///
    /// # Errors
    /// [`Error::Knots`] unless `a < b < c < d < e` are finite, with at most [`LambdaKnots::MOST_SINGLES`]
    /// single knots between two of them, all of which are different doubles.
    pub fn knots(&self) -> Result<Knots, Error> {
        let [a, b, c, d, e] = self.values();
        let mut knots = vec![a; Self::DEGREE + 1];
        for (index, (left, right)) in [(a, b), (b, c), (c, d), (d, e)].into_iter().enumerate() {
            let refused = |reason| Error::Knots {
                index: index + 1,
                value: right,
                reason,
            };
            let singles = self.singles[index];
            if singles > Self::MOST_SINGLES {
                return Err(refused("at most 64 single knots between two triple ones"));
            }
            let mut last = left;
            for i in 1..=singles {
                let part = i as f64 / (singles + 1) as f64;
                let knot = (1.0 - part) * left + part * right;
                // strictly between, or a knot would become four-fold
                if !(last < knot && knot < right) {
                    return Err(refused("lambda_a < lambda_b < lambda_c < lambda_d < lambda_e"));
                }
                knots.push(knot);
                last = knot;
            }
            if !(left < right && right.is_finite()) {
                return Err(refused("lambda_a < lambda_b < lambda_c < lambda_d < lambda_e"));
            }
            knots.extend([right; Self::DEGREE]);
        }
        knots.push(e);
        Knots::new(Self::DEGREE, knots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lambda::PAPER_TABLE_1;

    #[test]
    fn the_structure_is_that_of_the_paper() {
        let knots = LambdaKnots {
            a: 0.0,
            b: 1.0,
            c: 3.0,
            d: 4.0,
            e: 8.0,
            singles: LambdaKnots::SINGLES,
        };
        let finer = LambdaKnots {
            singles: [0, 3, 1, 2],
            ..knots
        };
        assert_eq!((knots.dimension(), finer.dimension()), (17, 19));
        assert_eq!(
            finer.knots().unwrap().values()[4..12],
            [1.0, 1.0, 1.0, 1.5, 2.0, 2.5, 3.0, 3.0]
        );
        assert_eq!(finer.knots().unwrap().dimension(), 19);
        let too_many = LambdaKnots {
            singles: [65, 1, 1, 1],
            ..knots
        };
        assert!(matches!(too_many.knots(), Err(Error::Knots { index: 1, .. })));
        let knots = knots.knots().unwrap();
        let expected = [
            0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 2.0, 3.0, 3.0, 3.0, 3.5, 4.0, 4.0, 4.0, 6.0, 8.0, 8.0, 8.0, 8.0,
        ];
        assert_eq!(knots.values(), expected);
        assert_eq!(knots.dimension(), 17);
    }

    #[test]
    fn every_row_of_the_paper_is_a_knot_vector() {
        for row in PAPER_TABLE_1 {
            assert_eq!(row.knots().knots().unwrap().dimension(), 17, "N = {}", row.valence);
        }
    }

    #[test]
    fn disordered_knots_are_refused() {
        let good = [0.15, 0.2, 0.35, 0.5, 0.9];
        for i in 0..5 {
            for bad in [f64::NAN, f64::INFINITY, good[(i + 1) % 5]] {
                let mut k = good;
                k[i] = bad;
                let knots = LambdaKnots {
                    a: k[0],
                    b: k[1],
                    c: k[2],
                    d: k[3],
                    e: k[4],
                    singles: LambdaKnots::SINGLES,
                };
                assert!(matches!(knots.knots(), Err(Error::Knots { .. })), "{k:?}");
            }
        }
    }
}
