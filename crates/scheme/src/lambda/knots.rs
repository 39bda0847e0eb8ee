//! The knot vector of the spline stencils.

use eigenring_spline::{Error, Knots};
use serde::{Deserialize, Serialize};

/// The five knots that determine the spline space of a valence (Ma, Wang and Ma 2023, Eq. 21): cubic, with
/// the end knots `a`, `e` four times, the triple knots `b`, `c`, `d` where the stencils may have kinks, and a
/// single knot half way between each two neighbours:
///
/// ```text
/// a a a a  (a+b)/2  b b b  (b+c)/2  c c c  (c+d)/2  d d d  (d+e)/2  e e e e        21 knots, 17 coefficients
/// ```
///
/// `c` is lambda_l, the smallest lambda with bounded curvature, or, where that is beyond `e` (from N = 24 on
/// with the paper's 0.9), a kink like the other two.
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
}

impl LambdaKnots {
    /// Degree of the splines.
    pub const DEGREE: usize = 3;
    /// Number of coefficients.
    pub const DIMENSION: usize = 17;

    /// The five knots in order.
    pub fn values(&self) -> [f64; 5] {
        [self.a, self.b, self.c, self.d, self.e]
    }

    /// The spline space.
    ///
    /// # Errors
    /// [`Error::Knots`] unless `a < b < c < d < e` are finite.
    pub fn knots(&self) -> Result<Knots, Error> {
        let [a, b, c, d, e] = self.values();
        for (index, pair) in self.values().windows(2).enumerate() {
            // the middle must lie strictly between, or a knot would become four-fold
            let middle = 0.5 * (pair[0] + pair[1]);
            if !(pair[0] < middle && middle < pair[1]) {
                return Err(Error::Knots {
                    index: index + 1,
                    value: pair[1],
                    reason: "lambda_a < lambda_b < lambda_c < lambda_d < lambda_e",
                });
            }
        }
        let mut knots = vec![a; Self::DEGREE + 1];
        for (left, right) in [(a, b), (b, c), (c, d), (d, e)] {
            knots.push(0.5 * (left + right));
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
        };
        let knots = knots.knots().unwrap();
        let expected = [
            0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 2.0, 3.0, 3.0, 3.0, 3.5, 4.0, 4.0, 4.0, 6.0, 8.0, 8.0, 8.0, 8.0,
        ];
        assert_eq!(knots.values(), expected);
        assert_eq!(knots.dimension(), LambdaKnots::DIMENSION);
    }

    #[test]
    fn every_row_of_the_paper_is_a_knot_vector() {
        for row in PAPER_TABLE_1 {
            assert_eq!(
                row.knots().knots().unwrap().dimension(),
                LambdaKnots::DIMENSION,
                "N = {}",
                row.valence
            );
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
                };
                assert!(matches!(knots.knots(), Err(Error::Knots { .. })), "{k:?}");
            }
        }
    }
}
