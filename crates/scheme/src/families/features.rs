//! Creases, boundaries, darts, corners and cusps of bicubic and of all even orders.
//!
//! In every smoothing step a vertex counts its active edges: boundary edges always, crease edges in the first
//! `cs` steps. With none or one it has the smooth mask (one: a dart), with two the mask of the curve along
//! them, `u/(1+u)` and twice `1/(2(1+u))`, with three or more it stays (a corner). A tagged vertex stays in
//! its first `cs` steps, on a boundary in all. Points of an active spoke have the curve's mask, so that no
//! rule reads across it (Fang, Ma and Wang, *A generalized surface subdivision scheme of arbitrary order with
//! a tension parameter*, section 4; for order 4 at u = 1 these are the rules of Hoppe and others 1994 and of
//! DeRose, Kass and Truong 1998).

use super::tension::{Name, smoothing_names};
use crate::{Corner, Error, Lattice, Level, Line, Pass, Scalar, Site, Stencil};

const EDGE: Site = Site { sector: 0, x: 2, y: 0 };
const FACE: Site = Site { sector: 0, x: 2, y: 2 };

/// A level of even order around a corner, over the names of its weights.
pub(super) fn level(corner: &Corner, order: usize) -> Result<Level<Name>, Error> {
    let fan = corner.sectors();
    let mut passes = vec![Pass::regular(Lattice::Vertex, Lattice::Vertex, Line::new(midpoints()))];
    for step in 0..order / 2 - 1 {
        passes.push(smoothing(corner, step));
    }
    Level::new(fan, passes)
}

fn midpoints() -> Vec<Vec<(i32, Name)>> {
    let [half, one] = [(1, 2), (1, 1)].map(|(p, q)| Name::Number(p, q));
    vec![vec![(0, one)], vec![(-2, half), (2, half)]]
}

fn smoothing(corner: &Corner, step: usize) -> Pass<Name> {
    let fan = corner.sectors();
    let n = fan.sectors();
    let names = smoothing_names(step, n as i64);
    let [side, middle, own, edge_weight, face_weight] = names;
    let acts = |boundary: bool| boundary || corner.steps().is_none_or(|steps| step < steps);
    // the spokes at the ends of an open fan are boundaries or full creases, which act in all steps
    let active: Vec<usize> = (0..fan.spokes())
        .filter(|&spoke| corner.spokes()[spoke].sharp && acts(!fan.is_closed()))
        .collect();
    let along = Line::new(vec![vec![(-2, side), (0, middle), (2, side)]]);
    let across = |spoke: usize| {
        let keeps = active.contains(&spoke);
        let line = along.clone();
        if keeps {
            line.with_near(0, vec![(0, Name::Number(1, 1))])
        } else {
            line
        }
    };
    let lines = (0..fan.spokes()).map(|spoke| [across((spoke + 1) % fan.spokes()), across(spoke)]);
    let on_spoke = |spoke: usize| Site { sector: spoke, ..EDGE };
    let fixed = corner.is_fixed() && acts(!fan.is_closed());
    let centre = match active.as_slice() {
        _ if fixed => Stencil::new().with(Site::CENTRE, Name::Number(1, 1)),
        [] | [_] => Stencil::new()
            .with(Site::CENTRE, own)
            .with_orbit(fan, EDGE, edge_weight)
            .with_orbit(fan, FACE, face_weight),
        &[a, b] => Stencil::new()
            .with(Site::CENTRE, middle)
            .with(on_spoke(a), side)
            .with(on_spoke(b), side),
        _ => Stencil::new().with(Site::CENTRE, Name::Number(1, 1)),
    };
    let pass = if active.is_empty() {
        Pass::regular(Lattice::Vertex, Lattice::Vertex, along.clone())
    } else {
        Pass::by_sector(Lattice::Vertex, Lattice::Vertex, lines.collect())
    };
    // a centre with fewer than two active spokes is an interior one: in an open fan both ends are active
    debug_assert!(fan.is_closed() || active.len() >= 2 || fixed);
    pass.with(Site::CENTRE, centre)
}

/// The bicubic level around a corner: the one of order 4 at `u = 1`, in one pass.
pub(super) fn bicubic<S: Scalar>(corner: &Corner, vertex: Stencil<S>) -> Result<Level<S>, Error> {
    let fan = corner.sectors();
    let sharp = |spoke: usize| corner.spokes()[spoke].sharp;
    let across = |spoke: usize| {
        let line = Line::cubic();
        if sharp(spoke) {
            line.with_near(0, vec![(0, S::one())])
        } else {
            line
        }
    };
    let lines = (0..fan.spokes()).map(|spoke| [across((spoke + 1) % fan.spokes()), across(spoke)]);
    let creases: Vec<usize> = (0..fan.spokes()).filter(|&spoke| sharp(spoke)).collect();
    let stays = || Stencil::new().with(Site::CENTRE, S::one());
    let centre = match creases.as_slice() {
        _ if corner.is_fixed() => stays(),
        [] | [_] => vertex,
        &[a, b] => Stencil::new()
            .with(Site::CENTRE, S::ratio(3, 4))
            .with(Site { sector: a, ..EDGE }, S::ratio(1, 8))
            .with(Site { sector: b, ..EDGE }, S::ratio(1, 8)),
        _ => stays(),
    };
    let pass = if creases.is_empty() {
        Pass::regular(Lattice::Vertex, Lattice::Vertex, Line::cubic())
    } else {
        Pass::by_sector(Lattice::Vertex, Lattice::Vertex, lines.collect())
    };
    Level::new(fan, vec![pass.with(Site::CENTRE, centre)])
}
