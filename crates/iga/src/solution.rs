//! Manufactured solutions with their derivatives.

use std::f64::consts::PI;

/// Value and derivatives at a point.
#[derive(Clone, Copy, Debug)]
pub struct Values {
    /// The value.
    pub value: f64,
    /// The gradient.
    pub gradient: [f64; 2],
    /// The Hessian: xx, xy, yy.
    pub hessian: [f64; 3],
    /// `laplace^2 u`, on which plates are loaded.
    pub bilaplacian: f64,
}

/// A function of the plane that is known with its derivatives.
pub type Solution = dyn Fn(f64, f64) -> Values + Sync;

/// The names of the solutions.
pub const NAMES: [&str; 5] = ["sin", "exp", "mix", "lin", "quadratic"];

/// The solution of a name: `sin(pi x) sin(pi y)`, `e^((x+y)/2)`, `cos(2x-y) + x y^2/2`, `1+2x-3y` (also
/// called `linear`) and `x^2 - 2xy + 3y^2`.
pub fn named(name: &str) -> Option<fn(f64, f64) -> Values> {
    Some(match name {
        "sin" => |x, y| {
            let ((sx, cx), (sy, cy)) = ((PI * x).sin_cos(), (PI * y).sin_cos());
            let (value, second) = (sx * sy, PI * PI);
            let gradient = [PI * cx * sy, PI * sx * cy];
            Values {
                value,
                gradient,
                hessian: [-second * value, second * cx * cy, -second * value],
                bilaplacian: 4.0 * second * second * value,
            }
        },
        "exp" => |x, y| {
            let value = (0.5 * (x + y)).exp();
            Values {
                value,
                gradient: [0.5 * value; 2],
                hessian: [0.25 * value; 3],
                bilaplacian: 0.25 * value,
            }
        },
        "mix" => |x, y| {
            let (sine, cosine) = (2.0 * x - y).sin_cos();
            Values {
                value: cosine + 0.5 * x * y * y,
                gradient: [-2.0 * sine + 0.5 * y * y, sine + x * y],
                hessian: [-4.0 * cosine, 2.0 * cosine + y, -cosine + x],
                bilaplacian: 25.0 * cosine,
            }
        },
        "lin" | "linear" => |x, y| Values {
            value: 1.0 + 2.0 * x - 3.0 * y,
            gradient: [2.0, -3.0],
            hessian: [0.0; 3],
            bilaplacian: 0.0,
        },
        "quadratic" => |x, y| Values {
            value: x * x - 2.0 * x * y + 3.0 * y * y,
            gradient: [2.0 * x - 2.0 * y, 6.0 * y - 2.0 * x],
            hessian: [2.0, -2.0, 6.0],
            bilaplacian: 0.0,
        },
        _ => return None,
    })
}
