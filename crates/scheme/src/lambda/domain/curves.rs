//! The boundary curves, over any scalar.
//!
//! With `T = g3 + 2h + f3`, `A0 = g3 + 2h - mu + phi (f3-mu)` and `W = (1+phi) h mu (1-c2)`, the vertex
//! stencil has
//!
//! ```text
//! (1+phi) beta = W / (2 f2 + phi h f3/f2 - A0),     z0 = T - mu - (1+phi) beta
//! ```
//!
//! so that each of its constraints compares `(1+phi) beta` with a number v that does not depend on f2,
//!
//! ```text
//! 1 - alpha - beta >= 0    (1+phi) beta <= 1
//! z0 >= -m                 (1+phi) beta <= T - kappa mu
//! z0 <= m                  (1+phi) beta >= T - (2-kappa) mu
//! ```
//!
//! and, multiplied out, becomes a sign of the quadratic `2 f2^2 - b f2 + phi h f3` with `b = A0 + W/v`. Its
//! smaller root is computed as the product of the roots over the larger one, which loses no digits where `h
//! f3` is small.

use super::{ConstraintCurve, Domain, Root};
use crate::lambda::Plane;
use crate::{Dual, Scalar};

/// What the curves need at one f3.
pub(super) struct Row<S> {
    pub(super) g3: S,
    pub(super) h: S,
    /// `g3 + 2h + f3`.
    pub(super) t: S,
    /// `A0` of the module page.
    pub(super) a0: S,
    /// `W` of the module page.
    pub(super) w: S,
    /// `phi h f3`.
    pub(super) product: S,
}

impl<S: Scalar + Copy> Row<S> {
    pub(super) fn new(plane: &Plane<S>, f3: S) -> Self {
        let (one, mu, phi) = (S::one(), plane.mu(), plane.phi);
        let (g3, h) = plane.g3_and_h(f3);
        let sum = g3 + h + h;
        Row {
            g3,
            h,
            t: sum + f3,
            a0: sum - mu + phi * (f3 - mu),
            w: (one + phi) * h * mu * (one - plane.cosine(2)),
            product: phi * h * f3,
        }
    }

    /// `b` of the quadratic for `(1+phi) beta = value`.
    pub(super) fn linear(&self, value: S) -> S {
        self.a0 + self.w / value
    }

    /// A root of `2 x^2 - b x + product`.
    fn root(&self, b: S, root: Root) -> S {
        let radical = b + (b * b - S::ratio(8, 1) * self.product).sqrt();
        match root {
            Root::Larger => radical * S::ratio(1, 4),
            Root::Smaller => S::ratio(2, 1) * self.product / radical,
        }
    }
}

impl Row<f64> {
    /// Both roots of `2 x^2 - b x + product`, if they are real and positive; a negative b gives none.
    pub(super) fn roots(&self, b: f64) -> Option<[f64; 2]> {
        let real = b > 0.0 && b * b >= 8.0 * self.product;
        real.then(|| [self.root(b, Root::Smaller), self.root(b, Root::Larger)])
    }
}

impl Domain {
    /// The plane over another scalar, its numbers taken as the exact ones they represent.
    fn plane_over<S: Scalar + Copy>(&self) -> Plane<S> {
        Plane {
            valence: self.plane.valence,
            lambda: S::exact(self.plane.lambda),
            s: S::exact(self.plane.s),
            phi: S::exact(self.plane.phi),
        }
    }

    /// `f2 = curve(f3)` over any scalar. Meant for f3 at which the curve exists, see [`Domain::curve`];
    /// elsewhere the root of a negative number is taken. At N = 4, where f3 is fixed, derivatives along f3
    /// have no meaning.
    pub fn curve_over<S: Scalar + Copy>(&self, curve: ConstraintCurve, f3: S) -> S {
        let plane = self.plane_over::<S>();
        let (one, two, mu, kappa) = (S::one(), S::ratio(2, 1), plane.mu(), S::exact(self.margin));
        let row = Row::new(&plane, f3);
        match curve {
            ConstraintCurve::F1 => (one - f3) / two,
            ConstraintCurve::D1 => row.h * f3 / (one - row.g3 - two * row.h),
            ConstraintCurve::Theta => (plane.lambda - f3) / (two * plane.cos_half_sector()),
            ConstraintCurve::Centre(root) => row.root(row.linear(one), root),
            ConstraintCurve::Z0Lower(root) => row.root(row.linear(row.t - kappa * mu), root),
            ConstraintCurve::Z0Upper(root) => row.root(row.linear(row.t - (two - kappa) * mu), root),
        }
    }

    /// `f2 = curve(f3)` and its slope, or `None` where the curve does not exist.
    pub fn curve(&self, curve: ConstraintCurve, f3: f64) -> Option<(f64, f64)> {
        let dual = self.curve_over(curve, Dual::<f64>::variable(f3, 0));
        (dual.value.is_finite() && dual.parts[0].is_finite()).then(|| (dual.value, dual.parts[0]))
    }
}
