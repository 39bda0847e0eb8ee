//! One part of the objective at a block of Gauss points: weight, squared error and their adjoint.
//!
//! On annulus m the Hessian is `s^m` times that on Omega_0 and areas are `lambda^{2m}` times smaller. With `p = lambda^2` the
//! sums over m are geometric; a component h of the Hessian with fitted value a contributes
//!
//! ```text
//! sum_m p^m (s^m h - a)^2 = c0 [ (a - rho h)^2 + kappa h^2 ]
//! c0 = 1/(1-p),  rho = (1-p)/(1-p s),  kappa = p (1-p) (s-1)^2 / ((1-p s^2) (1-p s)^2)
//! ```
//!
//! a sum of squares, and `a = rho <h>` with <.> the mean over Omega_0. (c0 cancels against the area.) The squared error sums
//! this over h = z_xx, z_xy, z_yy, each once as in Eq. 11, so it is not invariant under rotation.
//!
//! **Cup.** It is the same in all sectors, where T stays and S turns. With `m` the mean of `exp(4 i phi)` over the sectors (zero unless
//! N = 4), a = c = fit, b = 0 and `tau = rho^2 + kappa`,
//!
//! ```text
//! q = 2 (fit - rho T)^2 + 2 kappa T^2 + tau (3 |S|^2 + m Re S^2)/2,     K = T^2 - |S|^2
//! ```
//!
//! **Saddles.** Sector phi carries `Re, Im exp(2 i phi) Z`. Let T be the complex half trace of Z and `v = S[Z]/2`, `y = S[conj Z]/2`. The
//! saddles have `S = exp(4 i phi) v + y` and `-i exp(4 i phi) v + i y`, so that on average only y remains: (a, b, c) = (fit, 0, -fit) and (0, fit, 0).
//! With `t = exp(4 i phi)`, sign = +1 for the real and -1 for the imaginary part, `g = fit - rho y`,
//! `B = kappa (3 y + sign conj y) - rho (3 g + sign conj g)`,
//!
//! ```text
//! q = q0 + Re(t q1 + t^2 q2),  K = k0 + Re(t k1)           (K signed so that the ideal saddle has K = fit^2 > 0)
//! q0 = tau (|T|^2 + 3/2 |v|^2) + (3 |g|^2 + sign Re g^2)/2 + kappa (3 |y|^2 + sign Re y^2)/2
//! q1 = sign (tau T^2 + v conj B),  q2 = sign tau v^2 / 2
//! k0 = |v|^2 + |y|^2 - |T|^2/2,  k1 = sign (2 v conj y - T^2/2)
//! ```
//!
//! At N = 4, where t = -1 in all sectors, v and y are combined first, `y <- y - sign v, v <- 0`: each saddle is one of two independent
//! modes, and the other one must not enter even as a sum that cancels.
//!
//! So the sectors enter through the sums of w, w t, w t^2 (value) and w' q, w' q t (adjoint) alone.

use super::complex::Complex;
use super::fields::Turn;
use super::jet::Spin;
use super::lanes::Lanes;
use super::weight::Weight;

/// The constants of the sums over all annuli.
#[derive(Clone, Copy, Debug)]
pub(super) struct Annuli {
    pub rho: f64,
    kappa: f64,
    tau: f64,
    /// The mean of `exp(4 i phi)` over the sectors.
    pub mean_turn: f64,
}

impl Annuli {
    pub fn new(lambda: f64, s: f64, mean_turn: f64) -> Annuli {
        let p = lambda * lambda;
        let rho = (1.0 - p) / (1.0 - p * s);
        let excess = (s - 1.0) / (1.0 - p * s);
        let kappa = p * (1.0 - p) * excess * excess / (1.0 - p * s * s);
        Annuli {
            rho,
            kappa,
            tau: rho * rho + kappa,
            mean_turn,
        }
    }
}

/// The Hessian of the complex Z at a block of points: half trace and the two spin components of the module page.
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
}

#[inline(always)]
fn scaled(z: Complex<Lanes>, factor: f64) -> Complex<Lanes> {
    Complex::new(z.re * factor, z.im * factor)
}

/// A weighted squared error (summed over sector classes for a saddle) with its derivatives with respect to the Hessian
/// (in the inner product of its components) and to the fitted value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Error<H> {
    pub value: Lanes,
    pub by_hessian: H,
    pub by_fit: Lanes,
}

/// `1 / fit^2`, or zero for a vanishing fit: the weight then takes its limit n and does not vary.
#[inline(always)]
fn inverse_square(fit: f64) -> f64 {
    if fit == 0.0 { 0.0 } else { 1.0 / (fit * fit) }
}

/// `1 / fit`, or zero likewise.
#[inline(always)]
fn inverse(fit: f64) -> f64 {
    if fit == 0.0 { 0.0 } else { 1.0 / fit }
}

/// The cup's weighted squared error.
#[inline(always)]
pub(super) fn cup(cup: &Spin, fit: f64, annuli: &Annuli, weight: Option<&Weight>) -> Error<Spin> {
    let Annuli {
        rho,
        kappa,
        tau,
        mean_turn,
    } = *annuli;
    let Spin { t, s } = *cup;
    let g = Lanes::splat(fit) - t * rho;
    let (re2, im2) = (s.re * s.re, s.im * s.im);
    let q = g * g * 2.0
        + t * t * (2.0 * kappa)
        + re2 * (0.5 * tau * (3.0 + mean_turn))
        + im2 * (0.5 * tau * (3.0 - mean_turn));
    let scale = inverse_square(fit);
    let k = (t * t - re2 - im2) * scale;
    let (w, slope) = match weight {
        Some(weight) => weight.at(k),
        None => (Lanes::splat(1.0), Lanes::ZERO),
    };
    let v = slope * q;
    let by_curvature = v * (2.0 * scale);
    Error {
        value: w * q,
        by_hessian: Spin {
            t: w * (t * (4.0 * kappa) - g * (4.0 * rho)) + by_curvature * t,
            s: Complex::new(
                (w * (tau * (3.0 + mean_turn)) - by_curvature) * s.re,
                (w * (tau * (3.0 - mean_turn)) - by_curvature) * s.im,
            ),
        },
        by_fit: w * g * 4.0 - v * k * (2.0 * inverse(fit)),
    }
}

/// The weighted squared error of the saddle with the given sign, summed over the sector classes.
#[inline(always)]
pub(super) fn saddle<const GRADIENT: bool>(
    saddle: &Saddle,
    sign: f64,
    fit: f64,
    annuli: &Annuli,
    turns: &[Turn],
    weight: Option<&Weight>,
) -> Error<Saddle> {
    let Annuli {
        rho,
        kappa,
        tau,
        mean_turn,
    } = *annuli;
    let one_class = mean_turn != 0.0;
    let saddle = if one_class { saddle.folded(sign) } else { *saddle };
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
    let (k0, k1) = saddle.curvature(sign);
    let (k0, k1) = (k0 * scale, scaled(k1, scale));
    let sums = match weight {
        Some(weight) => sum_weights::<GRADIENT>(turns, weight, [k0, k1.re, k1.im, q0, q1.re, q1.im, q2.re, q2.im]),
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

/// Sums over the sector classes of w, w t, w t^2 and, with u = q dw/dk, of u and u t.
struct Sums {
    w0: Lanes,
    w1: Complex<Lanes>,
    w2: Complex<Lanes>,
    v0: Lanes,
    v1: Complex<Lanes>,
}

impl Sums {
    const ZERO: Sums = Sums {
        w0: Lanes::ZERO,
        w1: Saddle::ZERO.t,
        w2: Saddle::ZERO.t,
        v0: Lanes::ZERO,
        v1: Saddle::ZERO.t,
    };

    fn unweighted(turns: &[Turn]) -> Sums {
        let sum = |of: fn(&Turn) -> Complex<f64>| {
            let sum = turns.iter().map(of).fold(Complex::zero(), |a, b| a + b);
            Complex::new(Lanes::splat(sum.re), Lanes::splat(sum.im))
        };
        Sums {
            w0: Lanes::splat(turns.len() as f64),
            w1: sum(|turn| turn.t),
            w2: sum(|turn| turn.square),
            ..Sums::ZERO
        }
    }
}

/// The inner loop of the whole computation: two square roots and one division per point and class.
#[inline(always)]
fn sum_weights<const GRADIENT: bool>(turns: &[Turn], weight: &Weight, coefficients: [Lanes; 8]) -> Sums {
    let [k0, k1re, k1im, q0, q1re, q1im, q2re, q2im] = coefficients;
    let mut sums = Sums::ZERO;
    for Turn { t, square } in turns {
        let k = k0 + k1re * t.re - k1im * t.im;
        let (w, slope) = weight.at(k);
        sums.w0 += w;
        sums.w1.re += w * t.re;
        sums.w1.im += w * t.im;
        sums.w2.re += w * square.re;
        sums.w2.im += w * square.im;
        if GRADIENT {
            let q = q0 + q1re * t.re - q1im * t.im + q2re * square.re - q2im * square.im;
            let u = slope * q;
            sums.v0 += u;
            sums.v1.re += u * t.re;
            sums.v1.im += u * t.im;
        }
    }
    sums
}
