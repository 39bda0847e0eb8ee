//! The squared error of the two saddles at a block of Gauss points, with its adjoint.
//!
//! Sector phi carries `Re, Im exp(2 i phi) Z`. Let T be the complex half trace of Z and `v = S[Z]/2`, `y =
//! S[conj Z]/2`. The saddles have `S = exp(4 i phi) v + y` and `-i exp(4 i phi) v + i y`, so that on average
//! only y remains: (a, b, c) = (fit, 0, -fit) and (0, fit, 0). With `t = exp(4 i phi)`, sign = +1 for the
//! real and -1 for the imaginary part, `g = fit - rho y`, `B = kappa (3 y + sign conj y) - rho (3 g + sign
//! conj g)`,
//!
//! ```text
//! q = q0 + Re(t q1 + t^2 q2),  K = k0 + Re(t k1)         (K signed so that the ideal saddle has fit^2 > 0)
//! q0 = tau (|T|^2 + 3/2 |v|^2) + (3 |g|^2 + sign Re g^2)/2 + kappa (3 |y|^2 + sign Re y^2)/2
//! q1 = sign (tau T^2 + v conj B),  q2 = sign tau v^2 / 2
//! k0 = |v|^2 + |y|^2 - |T|^2/2,  k1 = sign (2 v conj y - T^2/2)
//! ```
//!
//! At N = 4, where t = -1 in all sectors, v and y are combined first, `y <- y - sign v, v <- 0`: each saddle
//! is one of two independent modes, and the other one must not enter even as a sum that cancels.
//!
//! So the sectors enter through the sums of w, w t, w t^2 (value) and w' q, w' q t (adjoint) alone.

use super::fields::Turns;
use super::jet::Spin;
use super::lanes::Lanes;
use super::maps::{Annuli, Error, inverse, inverse_square};
use super::sectors::{Sums, Weights};
use eigenring_spline::Complex;

/// The Hessian of the complex Z at a block of points: half trace and the two spin components of the module
/// page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Saddle {
    pub t: Complex<Lanes>,
    pub v: Complex<Lanes>,
    pub y: Complex<Lanes>,
}

impl Saddle {
    pub const ZERO: Saddle = {
        let zero = Complex {
            re: Lanes::ZERO,
            im: Lanes::ZERO,
        };
        Saddle {
            t: zero,
            v: zero,
            y: zero,
        }
    };

    /// From the Hessians of real and imaginary part.
    #[inline(always)]
    pub fn new(re: Spin, im: Spin) -> Saddle {
        let half = |a: Lanes, b: Lanes| Complex::new(a * 0.5, b * 0.5);
        Saddle {
            t: Complex::new(re.t, im.t),
            v: half(re.s.re - im.s.im, re.s.im + im.s.re),
            y: half(re.s.re + im.s.im, re.s.im - im.s.re),
        }
    }

    /// For `mean_turn = -1`, all sectors having t = -1: S as one component.
    #[inline(always)]
    fn folded(&self, sign: f64) -> Saddle {
        Saddle {
            t: self.t,
            v: Saddle::ZERO.v,
            y: self.y - scaled(self.v, sign),
        }
    }

    /// Folded at N = 4 only.
    #[inline(always)]
    fn by_class(&self, sign: f64, annuli: &Annuli) -> Saddle {
        if annuli.mean_turn == 0.0 {
            *self
        } else {
            self.folded(sign)
        }
    }

    /// The transpose of [`Saddle::folded`], for adjoints.
    #[inline(always)]
    fn unfolded(&self, sign: f64) -> Saddle {
        Saddle {
            v: scaled(self.y, -sign),
            ..*self
        }
    }

    /// The inner product of the six real components.
    #[inline(always)]
    pub fn dot(&self, other: &Saddle) -> Lanes {
        self.t.dot(other.t) + self.v.dot(other.v) + self.y.dot(other.y)
    }

    /// `(k0, k1)` of the signed Gauss curvature, not divided by the fitted one.
    #[inline(always)]
    pub fn curvature(&self, sign: f64) -> (Lanes, Complex<Lanes>) {
        let Saddle { t, v, y } = *self;
        let k0 = v.norm_square() + y.norm_square() - t.norm_square() * 0.5;
        let k1 = scaled(v * y.conj(), 2.0 * sign) - scaled(t * t, 0.5 * sign);
        (k0, k1)
    }

    #[inline(always)]
    fn relative_curvature(&self, sign: f64, scale: f64) -> (Lanes, Complex<Lanes>) {
        let (k0, k1) = self.curvature(sign);
        (k0 * scale, scaled(k1, scale))
    }
}

/// `(k0, k1)` relative to the fitted Gauss curvature, on which the weights depend.
#[inline(always)]
pub(super) fn curvature(saddle: &Saddle, sign: f64, fit: f64, annuli: &Annuli) -> (Lanes, Complex<Lanes>) {
    saddle
        .by_class(sign, annuli)
        .relative_curvature(sign, inverse_square(fit))
}

#[inline(always)]
fn scaled(z: Complex<Lanes>, factor: f64) -> Complex<Lanes> {
    Complex::new(z.re * factor, z.im * factor)
}

/// The weighted squared error of the saddle with the given sign, summed over the sector classes. `weights`
/// are those of the same saddle and fit; without them all weights are 1.
#[inline(always)]
pub(super) fn error<const GRADIENT: bool>(
    saddle: &Saddle,
    sign: f64,
    fit: f64,
    annuli: &Annuli,
    turns: &Turns,
    weights: Option<Weights>,
) -> Error<Saddle> {
    let Annuli {
        rho,
        kappa,
        tau,
        mean_turn,
    } = *annuli;
    let one_class = mean_turn != 0.0;
    let saddle = saddle.by_class(sign, annuli);
    let Saddle { t, v, y } = saddle;
    let g = Complex::new(Lanes::splat(fit) - y.re * rho, -y.im * rho);
    // 3 z + sign conj(z), and (3 |z|^2 + sign Re z^2)/2
    let (along, across) = (3.0 + sign, 3.0 - sign);
    let spread = |z: Complex<Lanes>| Complex::new(z.re * along, z.im * across);
    let square = |z: Complex<Lanes>| z.re * z.re * (0.5 * along) + z.im * z.im * (0.5 * across);
    let b = scaled(spread(y), kappa) - scaled(spread(g), rho);

    let q0 = (t.norm_square() + v.norm_square() * 1.5) * tau + square(g) + square(y) * kappa;
    let q1 = scaled(scaled(t * t, tau) + v * b.conj(), sign);
    let q2 = scaled(v * v, 0.5 * sign * tau);
    let scale = inverse_square(fit);
    let (k0, k1) = saddle.relative_curvature(sign, scale);
    let sums = match weights {
        Some(weights) => Sums::weighted::<GRADIENT>(turns, weights, q0, q1, q2),
        None => Sums::unweighted(turns),
    };
    let Sums { w0, w1, w2, v0, v1 } = sums;
    let value = w0 * q0 + w1.real_of_product(q1) + w2.real_of_product(q2);
    if !GRADIENT {
        return Error {
            value,
            by_hessian: Saddle::ZERO,
            by_fit: Lanes::ZERO,
        };
    }

    let (w1v, v1v) = (w1 * v, v1 * v);
    let (a0, a1) = (w0 * (2.0 * tau) - v0 * scale, scaled(w1, 2.0 * tau) - scaled(v1, scale));
    let by_t = t.scale(a0) + scaled((a1 * t).conj(), sign);
    let by_v = v.scale(w0 * (3.0 * tau))
        + scaled(w1.conj() * b + scaled((w2 * v).conj(), tau), sign)
        + scaled(v.scale(v0) + scaled(v1.conj() * y, sign), 2.0 * scale);
    let by_y = b.scale(w0)
        + scaled(
            Complex::new(w1v.re * across_plus(sign), w1v.im * across_minus(sign)),
            tau,
        )
        + scaled(y.scale(v0) + scaled(v1v, sign), 2.0 * scale);
    let by_curvature = v0 * k0 + v1.real_of_product(k1);
    let by_hessian = Saddle {
        t: by_t,
        v: by_v,
        y: by_y,
    };
    Error {
        value,
        by_hessian: if one_class {
            by_hessian.unfolded(sign)
        } else {
            by_hessian
        },
        by_fit: (w0 * g.re - w1v.re * (rho * sign)) * along - by_curvature * (2.0 * inverse(fit)),
    }
}

/// `3 sign z + conj(z)` has the factors `3 sign + 1` and `3 sign - 1`.
#[inline(always)]
fn across_plus(sign: f64) -> f64 {
    3.0 * sign + 1.0
}

#[inline(always)]
fn across_minus(sign: f64) -> f64 {
    3.0 * sign - 1.0
}
