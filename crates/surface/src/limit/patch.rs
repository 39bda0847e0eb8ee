//! Pieces of regular surfaces: control points, and their values.

use super::kernel::Kernel;
use super::net::control;
use crate::Error;
use crate::limit::centre::missing;
use crate::limit::local::Local;
use eigenring_spline::curve::Piece;
use std::sync::Arc;

/// Values and derivatives of the four basis functions of uniform cubic splines at `t`. Written out, since a
/// patch is evaluated a million times a second and must not allocate.
#[inline]
pub(crate) fn basis(t: f64) -> [[f64; 4]; 3] {
    let u = 1.0 - t;
    let (t2, u2) = (t * t, u * u);
    let sixth = 1.0 / 6.0;
    [
        [
            u2 * u * sixth,
            (3.0 * t2 * t - 6.0 * t2 + 4.0) * sixth,
            (3.0 * u2 * u - 6.0 * u2 + 4.0) * sixth,
            t2 * t * sixth,
        ],
        [-0.5 * u2, 1.5 * t2 - 2.0 * t, 2.0 * u - 1.5 * u2, 0.5 * t2],
        [u, 3.0 * t - 2.0, 3.0 * u - 2.0, t],
    ]
}

/// Value, first derivatives by s and t, second by ss, st, tt.
pub(crate) type Jet3 = [[f64; 3]; 6];

/// A piece of the surface.
#[derive(Debug)]
pub(crate) enum Patch {
    /// Of bicubic B-splines.
    Cubic(Box<[[f64; 3]; 16]>),
    /// Of another order or tension.
    Tensor(Arc<Piece>, Vec<[f64; 3]>),
}

impl Patch {
    /// The piece of the face of a part, whose control points are given, as one of the given level.
    pub fn new(local: &Local, points: &[[f64; 3]], kernel: &Kernel, level: usize) -> Result<Self, Error> {
        let rows = control(local, kernel).ok_or_else(missing)?;
        let net = rows.iter().map(|row| {
            let mut sum = [0.0; 3];
            for &(at, w) in row {
                (0..3).for_each(|k| sum[k] += w * points[at as usize][k]);
            }
            sum
        });
        if kernel.is_cubic(level) {
            let mut control = Box::new([[0.0; 3]; 16]);
            control.iter_mut().zip(net).for_each(|(at, point)| *at = point);
            return Ok(Patch::Cubic(control));
        }
        Ok(Patch::Tensor(kernel.piece(level)?, net.collect()))
    }

    /// The jet at a place of the unit square.
    #[inline]
    pub fn jet(&self, s: f64, t: f64) -> Jet3 {
        match self {
            Patch::Cubic(control) => jet(&control[..], &basis(s), &basis(t)),
            Patch::Tensor(piece, control) => {
                let (in_s, in_t) = (piece.at(s), piece.at(t));
                tensor(piece.order(), control, &in_s, &in_t)
            }
        }
    }
}

/// The jet of a bicubic piece whose control points run along s first.
#[inline]
fn jet(control: &[[f64; 3]], in_s: &[[f64; 4]; 3], in_t: &[[f64; 4]; 3]) -> Jet3 {
    tensor(4, control, in_s, in_t)
}

#[inline(always)]
fn tensor<const M: usize>(order: usize, control: &[[f64; 3]], in_s: &[[f64; M]; 3], in_t: &[[f64; M]; 3]) -> Jet3 {
    let mut jet = [[0.0; 3]; 6];
    for (row, j) in control.chunks_exact(order).zip(0..) {
        let mut sums = [[0.0; 3]; 3];
        for (point, i) in row.iter().zip(0..) {
            for (sum, weights) in sums.iter_mut().zip(in_s) {
                sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += weights[i] * x);
            }
        }
        let parts = [(0, 0), (0, 1), (1, 0), (0, 2), (1, 1), (2, 0)];
        for (jet, (by_t, by_s)) in jet.iter_mut().zip(parts) {
            let weight = in_t[by_t][j];
            jet.iter_mut().zip(&sums[by_s]).for_each(|(jet, x)| *jet += weight * x);
        }
    }
    jet
}
