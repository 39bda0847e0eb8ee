//! Injectivity: a regular self-similar map is injective exactly when its outer boundary winds once round the
//! origin.
//!
//! **Theorem** (Reif 1995; Zorin 2000, *SIAM J. Numer. Anal.* 37; Umlauf 2000; Peters and Reif 2008, chapter
//! 5). Let the map `X` of the annulus be regular, extended by `X(2 t) = X(t) / lambda`, `0 < lambda < 1`, and
//! let the image of its outer boundary miss the origin and have winding number w about it. Then the extension
//! covers the punctured plane `|w|` times; it is injective if and only if `|w| = 1`.
//!
//! *Why.* The inner boundary is the outer one scaled by lambda, so it has the same winding number, and the
//! number of times the annulus covers the origin, the difference of the two (all preimages count with one
//! sign), is zero: the origin is never met. The map of the punctured plane to itself is a local homeomorphism
//! that commutes with the scalings, hence a local homeomorphism of the quotients, which are tori. Of compact
//! spaces this is a covering, with `|w|` sheets by its action on loops. If `|w|` is not 1 no injective
//! extension exists, regular or not: the boundary would be a Jordan curve about the origin.
//!
//! **The winding number** without angles. Parts of the boundary curve of sector 0 are found each in one of
//! the four open half-planes `x > 0`, `y > 0`, `x < 0`, `y < 0`, numbered by quarter turns. Consecutive parts
//! share a point, so their half-planes differ by at most a quarter; c is the sum of these differences. Each
//! end of the curve has an argument within a quarter turn of its half-plane's, so the change of argument lies
//! in `(c/4 - 1/2, c/4 + 1/2)` turns. By rotation symmetry it is `k / N + j` for an integer j, of which that
//! range holds at most one; the N sectors together wind `k + N j` times.
//!
//! **Open fans.** Let X be regular on an open fan, `X(t/2) = diag(lambda_1, lambda_2) X(t)`, and let the
//! images of the first and the last spoke be simple curves from the origin to infinity that do not meet. They
//! divide the plane into two parts. Gluing the part that does not begin on X's side of them to the fan, by a
//! homeomorphism that commutes with the scalings, makes a local homeomorphism of a closed fan, to which the
//! theorem above applies: it is injective exactly if the boundary of the annulus, closed within the part that
//! was added, winds once. Coordinate half-planes are mapped to themselves by the scalings. That is made use
//! of twice:
//!
//! * a spoke lies in one of them, with its coordinate there increasing outwards: it is a simple curve;
//! * the last spoke lies in one of them, H, and the first in the complement of H: they do not meet.
//!
//! Let H be the half-plane of quarter b and J positive. The argument of the end on the last spoke is then in
//! `(b-1, b+1)` quarters, that of the beginning, one turn less than beyond H, in `[b-3, b-1]`: the half-plane
//! a in which it was found is one of `b-3 .. b-1`. The boundary turns by c half-planes; closed on the way
//! from `b-1 .. b+1` up to the next beginning it winds once if and only if its end comes out at that very
//! place, not whole turns away from it: if and only if `|a + c - b| <= 1`. For a negative J the same holds of
//! the mirror image, with `a` one of `b+1 .. b+3`. (The two do not overlap, and a regular map cannot have the
//! number of the wrong orientation: it would cover the plane no times.)

use super::{PlaneNet, Subdivision};
use crate::{Enclose, Interval, Status};
use eigenring_spectral::PatchIndex;
use eigenring_spline::bernstein::{Polynomial, halves};
use eigenring_spline::uniform::to_bernstein;
use serde::{Deserialize, Serialize};

/// The parts of each boundary curve of sector 0, from the own spoke to the next, that lie in half-planes.
pub type WindingEvidence = Vec<Subdivision>;

/// What is known of the winding number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Winding {
    /// Whether the map, given that it is regular, is injective. Refuted holds without that.
    pub status: Status,
    /// How often the outer boundary winds round the origin.
    pub number: Option<i64>,
    /// The parts of the boundary curve of one sector.
    pub parts: usize,
}

/// A curve in the plane in Bernstein form: its coefficients as points.
pub(super) type BoundaryCurve<S> = [Vec<S>; 2];

/// The outer boundary of sector 0 in order: along the sides `u = 1` of the patches at the far end of the own
/// spoke, then back along the sides `v = 1` of those at the far end of the next. Without rotation symmetry
/// the boundaries of all sectors.
pub(super) fn boundary<S: Enclose>(net: &PlaneNet<S>) -> Vec<BoundaryCurve<S>> {
    let conversion = to_bernstein::<S>(net.annulus().degree);
    let last = 2 * net.annulus().inner - 1;
    let curve = |sector: usize, p: usize, q: usize, side: usize| -> BoundaryCurve<S> {
        let width = net.annulus().degree + 1;
        let coordinates = net.coordinates(PatchIndex { sector, p, q }, &conversion);
        coordinates.map(|f| {
            let c = f.coefficients();
            if side == 0 {
                c.iter().skip(width - 1).step_by(width).copied().collect()
            } else {
                c[width * (width - 1)..].iter().rev().copied().collect()
            }
        })
    };
    let of_sector = |sector: usize| {
        let up = (0..=last).map(move |q| (sector, last, q, 0));
        up.chain((0..=last).rev().map(move |p| (sector, p, last, 1)))
    };
    let all = net.representatives().flat_map(of_sector);
    all.map(|(sector, p, q, side)| curve(sector, p, q, side)).collect()
}

pub(super) fn cut<S: Enclose>([x, y]: &BoundaryCurve<S>) -> Vec<BoundaryCurve<S>> {
    let ([x0, x1], [y0, y1]) = (halves(x), halves(y));
    vec![[x0, y0], [x1, y1]]
}

/// The quarters for which a curve certainly lies in the half-plane around their direction.
fn half_planes<S: Enclose>([x, y]: &BoundaryCurve<S>) -> [bool; 4] {
    let all = |values: &[S], positive: bool| {
        values.iter().map(Enclose::enclosure).all(|c| {
            if positive {
                c.certainly_positive()
            } else {
                c.certainly_negative()
            }
        })
    };
    [all(x, true), all(y, true), all(x, false), all(y, false)]
}

/// Checks the claim.
pub fn winding<S: Enclose>(net: &PlaneNet<S>, evidence: &WindingEvidence) -> Winding {
    let mut parts = 0;
    let closed = net.annulus().numbering.fan.is_closed();
    let number = quarters(net, evidence, &mut parts).and_then(|(start, c)| match net.fourier {
        Some(fourier) => total(c, fourier, net.sectors()),
        // a closed curve turns by a whole number
        None if closed => total(c, 0, 1),
        None => once(start, c, last_half_plane(net)?),
    });
    let status = match number {
        Some(1 | -1) => Status::Proven,
        Some(_) => Status::Refuted,
        None => Status::Undecided,
    };
    Winding { status, number, parts }
}

/// The half-plane at the beginning of the boundary of sector 0, or of all sectors, and the quarters by which
/// half-planes turn along it.
fn quarters<S: Enclose>(net: &PlaneNet<S>, trees: &[Subdivision], parts: &mut usize) -> Option<(i64, i64)> {
    let curves = boundary(net);
    if curves.len() != trees.len() {
        return None;
    }
    let (mut turned, mut start, mut current, mut lost) = (0, None, None, false);
    for (curve, tree) in curves.into_iter().zip(trees) {
        let walk = tree.walk(curve, &cut, &mut |part| {
            let open = half_planes(part);
            // any choice will do; staying where possible makes few steps
            let step = match current {
                None => (0..4).find(|&at| open[at]),
                Some(at) => [0, 1, 3].into_iter().find(|step| open[(at + step) % 4]),
            };
            match (step, current) {
                (None, _) => lost = true,
                (Some(at), None) => (start, current) = (Some(at as i64), Some(at)),
                (Some(step), Some(at)) => {
                    current = Some((at + step) % 4);
                    turned += if step == 3 { -1 } else { step as i64 };
                }
            }
        })?;
        *parts += walk.cells;
    }
    start.filter(|_| !lost).map(|start| (start, turned))
}

/// 1 or -1 if the boundary of an open fan winds once, see the module page: it begins in the half-plane
/// `start`, turns by `c` half-planes, and ends in the half-plane `last`.
fn once(start: i64, c: i64, last: i64) -> Option<i64> {
    let winds = |from: std::ops::RangeInclusive<i64>| {
        let mut begins = from.filter(|a| (a - start).rem_euclid(4) == 0);
        begins.any(|a| (a + c - last).abs() <= 1)
    };
    match (winds(last - 3..=last - 1), winds(last + 1..=last + 3)) {
        (true, false) => Some(1),
        (false, true) => Some(-1),
        _ => None,
    }
}

/// The half-plane in which the last spoke of an open fan lies, outside of which the first one lies; `None` if
/// there is none, or they are not known to be simple curves.
fn last_half_plane<S: Enclose>(net: &PlaneNet<S>) -> Option<i64> {
    let conversion = to_bernstein::<S>(net.annulus().degree);
    let width = net.annulus().degree + 1;
    let steps = || net.annulus().inner..2 * net.annulus().inner;
    let sectors = net.sectors();
    let spoke = |last: bool| -> Vec<BoundaryCurve<S>> {
        let patch = |step: usize| match last {
            false => PatchIndex {
                sector: 0,
                p: step,
                q: 0,
            },
            true => PatchIndex {
                sector: sectors - 1,
                p: 0,
                q: step,
            },
        };
        let side = |f: Polynomial<S>| -> Vec<S> {
            let c = f.coefficients().iter().copied();
            if last {
                c.step_by(width).collect()
            } else {
                c.take(width).collect()
            }
        };
        let curve = |step: usize| net.coordinates(patch(step), &conversion).map(side);
        steps().map(curve).collect()
    };
    // the coordinate towards a quarter
    let towards = |curve: &BoundaryCurve<S>, quarter: usize| -> Vec<Interval> {
        let sign = Interval::integer(if quarter < 2 { 1 } else { -1 });
        curve[quarter % 2].iter().map(|c| sign * c.enclosure()).collect()
    };
    let lies = |curves: &[BoundaryCurve<S>], quarter: usize| {
        curves.iter().all(|curve| {
            let values = towards(curve, quarter);
            let inside = values.iter().all(|c| c.certainly_positive());
            inside && values.windows(2).all(|pair| pair[0].certainly_lt(pair[1]))
        })
    };
    let beyond = |curves: &[BoundaryCurve<S>], quarter: usize| {
        let mut values = curves.iter().flat_map(|curve| towards(curve, quarter));
        values.all(|c| c.hi() <= 0.0)
    };
    let (first, last) = (spoke(false), spoke(true));
    if !(0..4).any(|quarter| lies(&first, quarter)) {
        return None;
    }
    (0..4)
        .find(|&quarter| lies(&last, quarter) && beyond(&first, quarter))
        .map(|quarter| quarter as i64)
}

/// `k + n j` for the integer j with `c/4 - 1/2 < k/n + j < c/4 + 1/2`.
fn total(c: i64, k: usize, n: usize) -> Option<i64> {
    let (k, n) = (k as i64, n as i64);
    // in units of 1/(4 n): |4 k + 4 n j - c n| < 2 n
    let offset = c * n - 4 * k;
    let below = offset.div_euclid(4 * n);
    [below, below + 1]
        .into_iter()
        .find(|j| (4 * n * j - offset).abs() < 2 * n)
        .map(|j| k + n * j)
}

#[cfg(test)]
mod tests {
    use super::{once, total};

    #[test]
    fn open_boundaries_wind_once_between_their_ends() {
        // from the direction 0 to the direction 2 over 1, and the other way round
        assert_eq!(
            (once(0, 2, 2), once(0, 1, 2), once(1, 1, 2)),
            (Some(1), Some(1), Some(1))
        );
        assert_eq!((once(0, -2, 2), once(3, -1, 2)), (Some(-1), Some(-1)));
        // three quarters, and all of a turn but a sliver
        assert_eq!((once(0, 3, 3), once(2, 3, 1)), (Some(1), Some(1)));
        // a turn more than that
        assert_eq!((once(0, 6, 2), once(0, 5, 1), once(0, -6, 2)), (None, None, None));
        // a quarter: from 0 to 1 directly, or three quarters backwards
        assert_eq!((once(0, 1, 1), once(0, -3, 1)), (Some(1), Some(-1)));
    }

    #[test]
    fn sectors_add_up_to_whole_turns() {
        assert_eq!(total(0, 1, 5), Some(1));
        assert_eq!(total(1, 1, 3), Some(1));
        assert_eq!(total(0, 2, 5), Some(2));
        // 4/5 of a turn within half a turn of zero is -1/5
        assert_eq!(total(0, 4, 5), Some(-1));
        assert_eq!(total(3, 4, 5), Some(4));
        assert_eq!(total(-4, 1, 3), Some(-2));
        // a half turn either way
        assert_eq!(total(0, 2, 4), None);
    }
}
