//! Derivatives of a map's height over its own (x, y), and how they move when (x, y) moves.
//!
//! A Hessian is split by spin into half its trace `T` and the complex `S = (z_xx - z_yy)/2 + i z_xy`: under a
//! turn of the coordinates by phi, T stays and S is multiplied by `exp(2 i phi)`.
//!
//! **Chain rule.** With the inverse Jacobian `u_x, u_y, v_x, v_y`, `z_x = z_u u_x + z_v v_x`, and the Hessian
//! is the parameter Hessian of `z - z_x x - z_y y` (z_x, z_y held fixed) pulled back by the inverse Jacobian.
//!
//! **Transport.** Let (x, y) move with velocity field V while z stays attached to the parameters. At a fixed
//! parameter
//!
//! ```text
//! H' = -(G^T H + H G) - z_x Hess(V_x) - z_y Hess(V_y),    G = grad V,    J' = J div V
//! ```

use super::fields::Derivatives;
use super::lanes::Lanes;
use eigenring_spline::Complex;

/// A symmetric 2x2 matrix `[[t + s.re, s.im], [s.im, t - s.re]]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spin {
    pub t: Lanes,
    pub s: Complex<Lanes>,
}

impl Spin {
    #[inline(always)]
    fn zip(self, other: Spin, f: impl Fn(Lanes, Lanes) -> Lanes) -> Spin {
        Spin {
            t: f(self.t, other.t),
            s: Complex::new(f(self.s.re, other.s.re), f(self.s.im, other.s.im)),
        }
    }

    /// The inner product of the three components.
    #[inline(always)]
    pub fn dot(self, other: Spin) -> Lanes {
        self.t * other.t + self.s.dot(other.s)
    }
}

/// Gradient and Hessian of a real field over (x, y).
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    pub x: Lanes,
    pub y: Lanes,
    pub hessian: Spin,
}

impl Jet {
    /// `a self + b other`.
    #[inline(always)]
    pub fn combine(self, a: f64, other: Jet, b: f64) -> Jet {
        let mix = |p: Lanes, q: Lanes| p * a + q * b;
        Jet {
            x: mix(self.x, other.x),
            y: mix(self.y, other.y),
            hessian: self.hessian.zip(other.hessian, mix),
        }
    }
}

/// The planar map at the points of a block: its Jacobian and what the chain rule needs of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub jacobian: Lanes,
    /// u_x, v_x.
    to_x: [Lanes; 2],
    /// u_y, v_y.
    to_y: [Lanes; 2],
    /// Second derivatives uu, uv, vv of x and of y.
    bend: [[Lanes; 3]; 2],
    /// Weights of the parameter Hessian's uu, uv, vv in t, s.re, s.im.
    pull: [[Lanes; 3]; 3],
}

impl Frame {
    /// The frame of the map with the given derivatives of x and y.
    #[inline(always)]
    pub fn new(x: &Derivatives, y: &Derivatives) -> Frame {
        let jacobian = x[0] * y[1] - x[1] * y[0];
        let inverse = Lanes::splat(1.0) / jacobian;
        let (ux, vx) = (y[1] * inverse, -y[0] * inverse);
        let (uy, vy) = (-x[1] * inverse, x[0] * inverse);
        let half = 0.5;
        let (uxux, uyuy) = (ux * ux, uy * uy);
        let (vxvx, vyvy) = (vx * vx, vy * vy);
        let (uxvx, uyvy) = (ux * vx, uy * vy);
        Frame {
            jacobian,
            to_x: [ux, vx],
            to_y: [uy, vy],
            bend: [[x[2], x[3], x[4]], [y[2], y[3], y[4]]],
            pull: [
                [(uxux + uyuy) * half, uxvx + uyvy, (vxvx + vyvy) * half],
                [(uxux - uyuy) * half, uxvx - uyvy, (vxvx - vyvy) * half],
                [ux * uy, ux * vy + uy * vx, vx * vy],
            ],
        }
    }

    /// Gradient and Hessian over (x, y) of the field with the given parameter derivatives.
    #[inline(always)]
    pub fn jet(&self, z: &Derivatives) -> Jet {
        let x = z[0] * self.to_x[0] + z[1] * self.to_x[1];
        let y = z[0] * self.to_y[0] + z[1] * self.to_y[1];
        let bent = |i: usize| z[2 + i] - x * self.bend[0][i] - y * self.bend[1][i];
        let (uu, uv, vv) = (bent(0), bent(1), bent(2));
        let pull = |i: usize| self.pull[i][0] * uu + self.pull[i][1] * uv + self.pull[i][2] * vv;
        Jet {
            x,
            y,
            hessian: Spin {
                t: pull(0),
                s: Complex::new(pull(1), pull(2)),
            },
        }
    }
}

/// The velocity field of (x, y), split into divergence, strain, spin and Hessians.
#[derive(Clone, Copy, Debug)]
pub(super) struct Velocity {
    pub divergence: Lanes,
    /// Twice the trace-free symmetric part of grad V.
    strain: Complex<Lanes>,
    /// `dV_y/dx - dV_x/dy`.
    curl: Lanes,
    hessians: [Spin; 2],
}

impl Velocity {
    /// From the jets of the two components.
    #[inline(always)]
    pub fn new(vx: Jet, vy: Jet) -> Velocity {
        Velocity {
            divergence: vx.x + vy.y,
            strain: Complex::new(vx.x - vy.y, vx.y + vy.x),
            curl: vy.x - vx.y,
            hessians: [vx.hessian, vy.hessian],
        }
    }

    /// The rate of change of a field's Hessian at fixed parameters.
    #[inline(always)]
    pub fn transport(&self, field: &Jet) -> Spin {
        let Spin { t, s } = field.hessian;
        let dragged = |of: fn(&Spin) -> Lanes| field.x * of(&self.hessians[0]) + field.y * of(&self.hessians[1]);
        let (d, strain, curl) = (self.divergence, self.strain, self.curl);
        Spin {
            t: -(d * t + strain.dot(s) + dragged(|h| h.t)),
            s: Complex::new(
                -(d * s.re + strain.re * t + curl * s.im + dragged(|h| h.s.re)),
                -(d * s.im + strain.im * t - curl * s.re + dragged(|h| h.s.im)),
            ),
        }
    }
}
