//! A point of a face: position, frame of the tangent plane, and derivatives in it.
//!
//! With the map `X(s, t)` and a frame `e_1, e_2` of its tangent plane, `J = (X_s, X_t)` in the frame. A
//! function v of the parameters has the gradient `J^-T (v_s, v_t)` and the covariant Hessian
//! `J^-T (D^2 v - v_1 D^2 X.e_1 - v_2 D^2 X.e_2) J^-1`. A function u of space has on the surface the gradient
//! `grad u . e_i` and the Hessian `e_i^T H e_j + (grad u . n) II_ij`, II the second fundamental form. In the
//! plane z = 0 the frame is the axes, and these are the ordinary derivatives.

use crate::patch::Data;
use crate::solution::Solution;

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// A point of a face.
pub(crate) struct Geometry {
    pub x: [f64; 3],
    /// The determinant of J times the weight.
    pub measure: f64,
    frame: [[f64; 3]; 2],
    normal: [f64; 3],
    /// `J^-1` by rows.
    inverse: [[f64; 2]; 2],
    /// `D^2 X` as ss, st, tt; zero unless wanted.
    second: [[f64; 3]; 3],
}

/// Value, gradient and Hessian of a function of space on the surface, in the frame.
pub(crate) struct Exact {
    pub value: f64,
    pub gradient: [f64; 2],
    pub hessian: [f64; 3],
}

/// A point where the map is not regular.
#[derive(Debug)]
pub(crate) struct Irregular {
    pub at: [f64; 3],
    /// The determinant.
    pub value: f64,
}

impl Geometry {
    /// Where the map has this position and these derivatives, in the order of a [`Jet`](crate::patch::Jet).
    pub fn new(map: &[Data; 6], weight: f64, planar: bool) -> Result<Self, Irregular> {
        let [x, xs, xt, second @ ..] = map.map(|[_, x, y, z]| [x, y, z]);
        let (frame, normal, det) = if planar {
            let det = xs[0] * xt[1] - xs[1] * xt[0];
            ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.0, 0.0, 1.0], det)
        } else {
            let n = cross(xs, xt);
            let (area, length) = (dot(n, n).sqrt(), dot(xs, xs).sqrt());
            let (normal, first) = (n.map(|c| c / area), xs.map(|c| c / length));
            ([first, cross(normal, first)], normal, area)
        };
        if !(det > 0.0) {
            return Err(Irregular { at: x, value: det });
        }
        let j = frame.map(|e| [dot(e, xs), dot(e, xt)]);
        Ok(Geometry {
            x,
            measure: det * weight,
            frame,
            normal,
            inverse: [[j[1][1] / det, -j[0][1] / det], [-j[1][0] / det, j[0][0] / det]],
            second,
        })
    }

    /// Whether the surface turns its front away from the origin.
    pub fn outward(&self) -> bool {
        dot(self.x, self.normal) > 0.0
    }

    /// The gradient of a function with these derivatives in the parameters.
    #[inline(always)]
    pub fn gradient(&self, s: f64, t: f64) -> [f64; 2] {
        let [a, b] = self.inverse;
        [s * a[0] + t * b[0], s * a[1] + t * b[1]]
    }

    /// `J^-T d J^-1` as 11, 12, 22.
    fn form(&self, d: [f64; 3]) -> [f64; 3] {
        let [a, b] = self.inverse;
        let form = |i: usize, j: usize| a[i] * (d[0] * a[j] + d[1] * b[j]) + b[i] * (d[1] * a[j] + d[2] * b[j]);
        [form(0, 0), form(0, 1), form(1, 1)]
    }

    /// The Hessian of a function with these second derivatives in the parameters and this gradient.
    pub fn hessian(&self, second: [f64; 3], gradient: [f64; 2]) -> [f64; 3] {
        let [e, f] = self.frame;
        self.form(std::array::from_fn(|k| {
            second[k] - gradient[0] * dot(self.second[k], e) - gradient[1] * dot(self.second[k], f)
        }))
    }

    /// A function of space on the surface.
    pub fn exact(&self, u: &Solution) -> Exact {
        let at = u(self.x[0], self.x[1]);
        let ([gx, gy], [xx, xy, yy]) = (at.gradient, at.hessian);
        let [e, f] = self.frame;
        let along = |a: [f64; 3], b: [f64; 3]| a[0] * (xx * b[0] + xy * b[1]) + a[1] * (xy * b[0] + yy * b[1]);
        let normal = gx * self.normal[0] + gy * self.normal[1];
        let bend = self.form(self.second.map(|d| normal * dot(d, self.normal)));
        Exact {
            value: at.value,
            gradient: [e, f].map(|axis| gx * axis[0] + gy * axis[1]),
            hessian: [along(e, e) + bend[0], along(e, f) + bend[1], along(f, f) + bend[2]],
        }
    }
}
