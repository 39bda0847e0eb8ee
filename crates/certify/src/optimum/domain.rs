//! Which boxes of stencils hold no admissible one.
//!
//! Coordinates are the corner radius `R = 2 f2 cos(pi/N)/(lambda - f3)` and f3, in which the bounds that are
//! active most often are sides of a rectangle: `R >= 1` is the bound on theta, and f3 alone decides of `f3 >=
//! 0`, of the last block's `g3 >= -m` and of `d2 >= 0`. The others are evaluated on a box; that one of them
//! certainly fails there excludes the box.
//!
//! **The branch.** With `A, B, C, D` of [`Plane`], every admissible f3 is below C/D at N >= 5. At C/D there
//! is no stencil, and for f3 between C/D and mu (`C/D < mu`, as `D - B = (1+c2)(1-sg) > 0`) h is negative,
//! which `e1 >= 0` forbids. From mu on (up to lambda, by theta) h is not negative, and the determinant `p =
//! f3 g3` of every block has `|p| <= m mu`, so that `g3 <= m mu/f3 <= m`.
//!
//! * At `f3 = mu` g3 is lambda, and `p = lambda mu` is above `m mu`.
//! * Beyond, at N >= 6, the characteristic polynomial of the last block has at m the value
//!   `(m - f3)(m - g3) - h m (1 + c_K)`, which is not positive, so that one of its roots is m or above. It is
//!   m itself only if g3 is, and then the other one is `p/m = f3`, above m.
//! * Beyond, at N = 5, the last block is block 2, which has the root mu, so that
//!   `(mu - f3)(mu - g3) = h mu (1 + c_2)` is not negative. So g3 is mu or above, but `m mu/f3` is below mu.

use super::objective::{edge_weight, planar};
use crate::{Centred, Enclose, Interval};
use eigenring_scheme::lambda::Plane;
use eigenring_spline::Scalar;

/// The admissible stencils of a plane with the paper's bounds and a relative margin of the eigenvalues.
pub(super) struct Domain {
    plane: Plane<Centred<2>>,
    /// `(1 - kappa) mu`.
    largest: Interval,
    /// Holds every admissible (R, f3).
    pub rectangle: [Interval; 2],
}

impl Domain {
    /// `None` where nothing is admissible.
    pub fn new(plane: &Plane<Interval>, margin: Interval) -> Option<Self> {
        let (one, lambda, mu) = (Interval::one(), plane.lambda, plane.mu());
        let largest = (one - margin) * mu;
        let (c1, c2, sg) = (plane.cosine(1), plane.cosine(2), plane.s * lambda);
        let (a, b) = ((one + c1) * mu - (one + c2) * lambda, c1 - c2);
        let (c, d) = (b * mu, one + c1 - (one + c2) * sg);
        // g3 = mu (a - b f3)/(c - d f3) >= -largest, below the pole
        let last_block = (largest * c + mu * a) / (largest * d + mu * b);
        let mut end = last_block.hi().min((c / d).hi());
        // (C - D f3) d2 is a quadratic that opens upwards; where it is negative at C/D, only f3 up to its
        // smaller root are left
        let (square, linear) = (one - sg, lambda * (one + b * sg - sg.square()));
        let constant = sg * lambda.square() * (c1 * sg - c2);
        let pole = c / d;
        if (square * pole.square() - linear * pole + constant).certainly_negative() {
            let root = (linear.square() - Interval::ratio(4, 1) * square * constant).sqrt();
            end = end.min((Interval::ratio(2, 1) * constant / (linear + root)).hi());
        }
        let f3 = Interval::new(0.0, end.min(lambda.lo().next_down()))?;
        // f1 >= 0: R <= cos(pi/N) (1 - f3)/(lambda - f3), which grows with f3
        let radius = plane.cos_half_sector() * (one - Interval::point(f3.hi())) / (lambda - Interval::point(f3.hi()));
        Some(Domain {
            plane: planar(plane),
            largest,
            rectangle: [Interval::new(1.0, radius.hi())?, f3],
        })
    }

    /// Whether no stencil of the box is admissible.
    pub fn excludes(&self, radius: Interval, f3: Interval) -> bool {
        let slack = self.slack(radius, f3);
        slack.iter().any(|slack| slack.enclosure().certainly_negative())
    }

    /// Whether the stencil is certainly admissible, by all bounds.
    pub fn admits(&self, radius: f64, f3: f64) -> bool {
        let [radius, f3] = [radius, f3].map(Interval::point);
        let holds = |slack: &Centred<2>| slack.enclosure().lo() >= 0.0;
        let inside = radius.lo() >= 1.0 && f3.lo() >= 0.0 && f3.certainly_lt(self.plane.lambda.enclosure());
        inside && self.slack(radius, f3).iter().all(holds) && self.inner_blocks(f3).iter().all(holds)
    }

    /// What must not be negative, apart from R - 1 and f3.
    fn slack(&self, radius: Interval, f3: Interval) -> [Centred<2>; 9] {
        let one = Centred::one();
        let (radius, f3) = (Centred::parameter(radius, 0), Centred::parameter(f3, 1));
        let f2 = edge_weight(&self.plane, radius, f3);
        let stencil = self.plane.stencil(f2, f3);
        let (w, h) = (stencil.weights, self.plane.g3_and_h(f3).1);
        let (largest, mu) = (Centred::constant(self.largest), self.plane.mu());
        let vertex = (one + self.plane.phi) * w.beta;
        let z0 = stencil.g3 + h + h + f3 - mu - vertex;
        [
            w.f1,
            w.d1,
            w.d2,
            h,
            w.beta,
            one - vertex,
            stencil.g3 + largest,
            z0 + largest,
            largest - z0,
        ]
    }

    /// What must not be negative for the other eigenvalues of the blocks from 1 to the last, with determinant
    /// `p = f3 g3` and trace `f3 + g3 + h (1 + c_k)`: both roots of a quadratic have moduli up to m if it is
    /// not negative at m and at -m, and `|p| <= m^2`.
    fn inner_blocks(&self, f3: Interval) -> Vec<Centred<2>> {
        let f3 = Centred::constant(f3);
        let (plane, largest) = (&self.plane, Centred::constant(self.largest));
        let (g3, h) = plane.g3_and_h(f3);
        let p = f3 * g3;
        let mut slack = Vec::new();
        // in blocks 1 and 2 the other root is p/lambda and p/mu; all of the others allow less than m^2
        for known in [plane.lambda, plane.mu(), largest] {
            slack.extend([largest * known - p, largest * known + p]);
        }
        for k in 3..=plane.valence as i64 / 2 {
            let trace = f3 + g3 + h * (Centred::one() + plane.cosine(k));
            slack.extend([trace, -trace].map(|trace| largest * largest + trace * largest + p));
        }
        slack
    }
}
