//! The squared error of a map over all annuli, and the cup's with weight and adjoint.
//!
//! On annulus m the Hessian is `s^m` times that on Omega_0 and areas are `lambda^{2m}` times smaller. With
//! `p = lambda^2` the sums over m are geometric; a component h of the Hessian with fitted value a contributes
//!
//! ```text
//! sum_m p^m (s^m h - a)^2 = c0 [ (a - rho h)^2 + kappa h^2 ]
//! c0 = 1/(1-p),  rho = (1-p)/(1-p s),  kappa = p (1-p) (s-1)^2 / ((1-p s^2) (1-p s)^2)
//! ```
//!
//! a sum of squares, and `a = rho <h>` with <.> the mean over Omega_0. (c0 cancels against the area.) The
//! squared error sums this over h = z_xx, z_xy, z_yy, each once as in Eq. 11, so it is not invariant under
//! rotation.
//!
//! **Cup.** It is the same in all sectors, where T stays and S turns. With `m` the mean of `exp(4 i phi)`
//! over the sectors (zero unless N = 4), a = c = fit, b = 0 and `tau = rho^2 + kappa`,
//!
//! ```text
//! q = 2 (fit - rho T)^2 + 2 kappa T^2 + tau (3 |S|^2 + m Re S^2)/2,     K = T^2 - |S|^2
//! ```

use super::jet::Spin;
use super::lanes::Lanes;
use super::weight::Weight;
use eigenring_spline::Complex;

/// The constants of the sums over all annuli.
#[derive(Clone, Copy, Debug)]
pub(super) struct Annuli {
    pub rho: f64,
    pub kappa: f64,
    pub tau: f64,
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

/// A weighted squared error (summed over sector classes for a saddle) with its derivatives with respect to
/// the Hessian (in the inner product of its components) and to the fitted value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Error<H> {
    pub value: Lanes,
    pub by_hessian: H,
    pub by_fit: Lanes,
}

/// `1 / fit^2`, or zero for a vanishing fit: the weight then takes its limit n and does not vary.
#[inline(always)]
pub(super) fn inverse_square(fit: f64) -> f64 {
    if fit == 0.0 { 0.0 } else { 1.0 / (fit * fit) }
}

/// `1 / fit`, or zero likewise.
#[inline(always)]
pub(super) fn inverse(fit: f64) -> f64 {
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
        Some(weight) => {
            let (mut w, mut slope) = (Lanes::ZERO, Lanes::ZERO);
            weight.fill(&k.0, &mut w.0, &mut slope.0);
            (w, slope)
        }
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
