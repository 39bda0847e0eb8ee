//! Pieces of regular surfaces: control points, and their values.

use super::kernel::Kernel;
use super::net::Control;
use super::partial::Across;
use crate::Error;
use eigenring_spline::curve::{MAX_ORDER, Piece};
use nalgebra::Vector3;
use std::sync::Arc;

/// Derivatives 0 to 3 at the middle of the four basis functions of uniform cubic splines.
const CUBIC: [f64; 16] = [
    1.0 / 48.0,
    23.0 / 48.0,
    23.0 / 48.0,
    1.0 / 48.0,
    -0.125,
    -0.625,
    0.625,
    0.125,
    0.5,
    -0.5,
    -0.5,
    0.5,
    -1.0,
    3.0,
    -3.0,
    1.0,
];

/// Monomials over factorials in the distance from the middle, with first and second derivatives.
#[inline(always)]
fn monomials(f: f64) -> [[f64; 4]; 3] {
    let x = f - 0.5;
    let half = 0.5 * x * x;
    [
        [1.0, x, half, half * x * (1.0 / 3.0)],
        [0.0, 1.0, x, half],
        [0.0, 0.0, 1.0, x],
    ]
}

/// Three coordinates and a zero, so that whole lanes of a processor are added.
pub(crate) type Lanes = [f64; 4];

/// Value, first derivatives by s and t, second by ss, st, tt.
pub(crate) type Jet3 = [Lanes; 6];

/// A piece of the surface. Pieces are evaluated by their derivatives at the middle: of the functions
/// `x^j / j!` a derivative is the function before, which takes half the products that B-splines take.
#[derive(Debug)]
pub(crate) enum Patch {
    /// Derivatives of a bicubic piece at its middle.
    Cubic(Box<[Lanes; 16]>),
    /// Likewise of another order or tension.
    Expanded(Arc<Piece>, Vec<Lanes>),
    /// Control points where the functions themselves are found by quadrature.
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
    /// The piece of a level, from the rows of its control points.
    pub fn new(control: &Control, points: &[[f64; 3]], kernel: &Kernel, level: usize) -> Result<Self, Error> {
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
            expand(4, &CUBIC, &mut control[..]);
            return Ok(Patch::Cubic(control));
        }
        let piece = kernel.piece(level)?;
        let mut control: Vec<Lanes> = net.collect();
        match piece.at_middle() {
            Some(derivatives) => expand(kernel.order, derivatives, &mut control),
            None => return Ok(Patch::Tensor(piece, control)),
        }
        Ok(Patch::Expanded(piece, control))
    }

    /// The jet at a place of the unit square.
    #[inline]
    pub fn jet(&self, s: f64, t: f64) -> Jet3 {
        match self {
            Patch::Cubic(control) => expanded(4, &control[..], &monomials(s), &monomials(t)),
            // usual orders with loops of known length
            Patch::Expanded(piece, control) => match piece.order() {
                3 => of_order::<3>(piece, control, s, t),
                4 => of_order::<4>(piece, control, s, t),
                5 => of_order::<5>(piece, control, s, t),
                6 => of_order::<6>(piece, control, s, t),
                7 => of_order::<7>(piece, control, s, t),
                8 => of_order::<8>(piece, control, s, t),
                order => expanded(order, control, &piece.span::<MAX_ORDER>(s), &piece.span(t)),
            },
            Patch::Tensor(piece, control) => tensor(piece.order(), control, &piece.at(s), &piece.at(t)),
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

/// From control points, along s first, to derivatives at the middle, given those of the functions.
fn expand(order: usize, derivatives: &[f64], control: &mut [Lanes]) {
    let mut line = [[0.0; 4]; MAX_ORDER];
    for (stride, across) in [(1, order), (order, 1)] {
        for first in (0..order).map(|i| i * across) {
            for (at, weights) in derivatives.chunks_exact(order).enumerate() {
                let mut sum = [0.0; 4];
                for (i, &weight) in weights.iter().enumerate() {
                    let point = &control[first + i * stride];
                    sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
                }
                line[at] = sum;
            }
            for (at, &value) in line[..order].iter().enumerate() {
                control[first + at * stride] = value;
            }
        }
    }
}

fn of_order<const K: usize>(piece: &Piece, control: &[Lanes], s: f64, t: f64) -> Jet3 {
    expanded(K, control, &piece.span::<K>(s), &piece.span::<K>(t))
}

/// The jet of a piece from its derivatives at the middle.
#[inline(always)]
fn expanded<const M: usize>(order: usize, control: &[Lanes], in_s: &[[f64; M]; 3], in_t: &[[f64; M]; 3]) -> Jet3 {
    // functions before these have no such derivative; the second of order 3 is no monomial
    let from = [0, 1, 2.min(order - 2)];
    // sums along rows first: more of them at a time than registers hold
    let mut along = [[[0.0; 4]; 3]; M];
    for (sums, row) in along.iter_mut().zip(control.chunks_exact(order)) {
        for ((sum, weights), from) in sums.iter_mut().zip(in_s).zip(from) {
            for (&weight, point) in weights[from..order].iter().zip(&row[from..]) {
                add(sum, weight, point);
            }
        }
    }
    let across = |derivative: usize, in_row: usize| {
        let mut sum = [0.0; 4];
        for j in from[derivative]..order {
            add(&mut sum, in_t[derivative][j], &along[j][in_row]);
        }
        sum
    };
    let (x, xs, xss) = (across(0, 0), across(0, 1), across(0, 2));
    let (xt, xst, xtt) = (across(1, 0), across(1, 1), across(2, 0));
    [x, xs, xt, xss, xst, xtt]
}

#[inline(always)]
fn add(sum: &mut Lanes, weight: f64, point: &Lanes) {
    sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
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
