//! Pieces of regular surfaces: control points, and their values.

use super::kernel::Kernel;
use super::net::{Control, control};
use super::partial::Across;
use crate::Error;
use crate::limit::centre::missing;
use crate::limit::local::Local;
use eigenring_spline::curve::Piece;
use nalgebra::Vector3;
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

/// Three coordinates and a zero, so that whole lanes of a processor are added.
pub(crate) type Lanes = [f64; 4];

/// Value, first derivatives by s and t, second by ss, st, tt.
pub(crate) type Jet3 = [Lanes; 6];

/// A piece of the surface.
#[derive(Debug)]
pub(crate) enum Patch {
    /// Of bicubic B-splines.
    Cubic(Box<[Lanes; 16]>),
    /// Of another order or tension.
    Tensor(Arc<Piece>, Vec<Lanes>),
    /// Beside creases that act in some smoothing steps only: the functions along s and t.
    Partial([Arc<Across>; 2], Vec<Lanes>),
}

/// What second derivatives do on a crease that acts in some smoothing steps only.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnCrease {
    /// The power of the distance by which they grow beside it.
    pub power: f64,
    /// Whether their part along the normal does.
    pub grows: bool,
}

impl Patch {
    /// The piece of the face of a part, whose control points are given, as one of the given level.
    pub fn new(local: &Local, points: &[[f64; 3]], kernel: &Kernel, level: usize) -> Result<Self, Error> {
        let control = control(local, kernel).ok_or_else(missing)?;
        Patch::of(&control, points, kernel, level)
    }

    /// The same with the rows of its control points known.
    pub fn of(control: &Control, points: &[[f64; 3]], kernel: &Kernel, level: usize) -> Result<Self, Error> {
        let Control { rows, lines } = control;
        let net = rows.iter().map(|row| {
            let mut sum = [0.0; 4];
            for &(at, w) in row {
                (0..3).for_each(|k| sum[k] += w * points[at as usize][k]);
            }
            sum
        });
        if lines.iter().any(|lines| !lines.is_empty()) {
            let [in_s, in_t] = lines;
            let axes = [kernel.across(level, in_s)?, kernel.across(level, in_t)?];
            return Ok(Patch::Partial(axes, net.collect()));
        }
        if kernel.is_cubic(level) {
            let mut control = Box::new([[0.0; 4]; 16]);
            control.iter_mut().zip(net).for_each(|(at, point)| *at = point);
            return Ok(Patch::Cubic(control));
        }
        Ok(Patch::Tensor(kernel.piece(level)?, net.collect()))
    }

    /// The jet at a place of the unit square.
    #[inline]
    pub fn jet(&self, s: f64, t: f64) -> Jet3 {
        match self {
            Patch::Cubic(control) => tensor(4, &control[..], &basis(s), &basis(t)),
            // usual orders with loops of known length
            Patch::Tensor(piece, control) => match piece.order() {
                3 => of_order::<3>(piece, control, s, t),
                4 => of_order::<4>(piece, control, s, t),
                5 => of_order::<5>(piece, control, s, t),
                6 => of_order::<6>(piece, control, s, t),
                7 => of_order::<7>(piece, control, s, t),
                8 => of_order::<8>(piece, control, s, t),
                order => tensor(order, control, &piece.at(s), &piece.at(t)),
            },
            Patch::Partial([along_s, along_t], control) => {
                tensor(control.len().isqrt(), control, &along_s.at(s), &along_t.at(t))
            }
        }
    }

    /// On a crease that acts in some steps only, what second derivatives do; those of the jet are taken
    /// beside it.
    #[inline]
    pub fn on_crease(&self, s: f64, t: f64) -> Option<OnCrease> {
        match self {
            Patch::Partial(axes, control) => on_crease(axes, control, s, t),
            _ => None,
        }
    }
}

/// Normal parts of second derivatives below this part of their terms are rounding.
const ROUNDING: f64 = 1e-11;

fn on_crease(axes: &[Arc<Across>; 2], control: &[Lanes], s: f64, t: f64) -> Option<OnCrease> {
    let powers = [axes[0].power(s), axes[1].power(t)];
    let power = powers.into_iter().flatten().reduce(f64::min)?;
    let order = control.len().isqrt();
    let (in_s, in_t) = (axes[0].at(s), axes[1].at(t));
    let jet = tensor(order, control, &in_s, &in_t);
    let [xs, xt] = [1, 2].map(|i| vector(&jet[i]));
    let normal = xs.cross(&xt);
    let mut grows = false;
    for (axis, _) in powers.iter().enumerate().filter(|(_, power)| power.is_some()) {
        let (by_s, by_t) = if axis == 0 { (2, 0) } else { (0, 2) };
        let (mut sum, mut size) = (0.0, 0.0);
        for (row, j) in control.chunks_exact(order).zip(0..) {
            for (point, i) in row.iter().zip(0..) {
                // constants have no derivatives: of differences, so that a far origin costs no digits
                let away = vector(point) - vector(&control[0]);
                let weight = in_s[by_s][i] * in_t[by_t][j];
                sum += weight * away.dot(&normal);
                size += weight.abs() * away.norm() * normal.norm();
            }
        }
        grows |= sum.abs() > ROUNDING * size;
    }
    Some(OnCrease { power, grows })
}

/// The first three coordinates.
#[inline]
pub(crate) fn vector(x: &Lanes) -> Vector3<f64> {
    Vector3::new(x[0], x[1], x[2])
}

fn of_order<const K: usize>(piece: &Piece, control: &[Lanes], s: f64, t: f64) -> Jet3 {
    tensor(K, control, &piece.of_order::<K>(s), &piece.of_order::<K>(t))
}

/// The jet of a piece whose control points run along s first.
#[inline(always)]
fn tensor<const M: usize>(order: usize, control: &[Lanes], in_s: &[[f64; M]; 3], in_t: &[[f64; M]; 3]) -> Jet3 {
    let mut jet = [[0.0; 4]; 6];
    for (row, j) in control.chunks_exact(order).zip(0..) {
        let mut sums = [[0.0; 4]; 3];
        for (point, i) in row.iter().zip(0..) {
            for (sum, weights) in sums.iter_mut().zip(in_s) {
                let weight: f64 = weights[i];
                sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
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
