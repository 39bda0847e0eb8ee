//! The corner angle of the natural configuration.
//!
//! theta is the angle at F, between V and E, in the triangle V E F of the first quad (V the centre, the
//! origin); it is half the angle of the quad's outermost corner. `theta < pi/2` says that no corner is
//! concave; Ma, Wang and Ma (2023, section 4.3) ask for `theta <= pi/2 - pi/(2 N)`.

use super::PlaneNet;
use crate::{Enclose, Interval, Status};
use eigenring_scheme::{Lattice, Site};
use serde::{Deserialize, Serialize};

/// The corner angle and what is known of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Corner {
    /// theta in radians.
    pub theta: Interval,
    /// `pi/2 - pi/(2 N)`.
    pub bound: Interval,
    /// Whether `theta < pi/2`, from the sign of an inner product.
    pub convex: Status,
    /// Whether theta is within its bound.
    pub within: Status,
}

/// The corner angle; `None` around a face, which has no such quad.
pub fn corner<S: Enclose>(net: &PlaneNet<S>) -> Option<Corner> {
    let numbering = net.annulus().numbering;
    if numbering.lattice != Lattice::Vertex {
        return None;
    }
    let at = |x, y| {
        let index = numbering.index(Site { sector: 0, x, y })?;
        Some([net.x[index], net.y[index]])
    };
    let ([ex, ey], [fx, fy]) = (at(2, 0)?, at(2, 2)?);
    let (to_v, to_e) = ([-fx, -fy], [ex - fx, ey - fy]);
    let cosine = to_v[0] * to_e[0] + to_v[1] * to_e[1];
    let sine = to_v[0] * to_e[1] - to_v[1] * to_e[0];
    let (cosine, sine) = (cosine.enclosure(), sine.enclosure().abs());
    let theta = Interval::argument(cosine, sine);
    let n = net.sectors() as i64;
    let bound = Interval::pi() * Interval::integer(n - 1) / Interval::integer(2 * n);
    let convex = match () {
        () if cosine.certainly_positive() => Status::Proven,
        () if cosine.hi() <= 0.0 => Status::Refuted,
        () => Status::Undecided,
    };
    let within = match () {
        () if theta.certainly_le(bound) => Status::Proven,
        () if theta.certainly_gt(bound) => Status::Refuted,
        () => Status::Undecided,
    };
    Some(Corner {
        theta,
        bound,
        convex,
        within,
    })
}
