//! The generalised tension scheme of arbitrary order.
//!
//! Fang, Ma and Wang, *A generalized surface subdivision scheme of arbitrary order with a tension parameter*,
//! Computer-Aided Design. Order k gives surfaces of degree k-1 on regular nets: uniform B-splines at tension
//! `u = 1`, trigonometric ones at `u = cos a`, hyperbolic ones at `u = cosh a`. The tension goes from level
//! to level by the half-angle formula `u' = sqrt((1+u)/2)`, so the limit level is that of `u = 1`.
//!
//! **Even orders** (around a vertex): bilinear refinement, one smoothing that knows the tension, `(k-4)/2`
//! uniform ones. At a vertex of valence N the smoothings keep `((N-4)(1+2u) + N u^2) / (N (1+u)^2)` and
//! `(N-3)/N`, and take `8u / (N^2 (1+u)^2)` and `2/N^2` of **each** edge neighbour, `4 / (N^2 (1+u)^2)` and
//! `1/N^2` of **each** face neighbour.
//!
//! **Odd orders** (around a face of valence N): corner cutting in which the N-gon's new corner keeps
//! `(N u^2 + (2N-4) u + 1) / (N (1+u)^2)` and takes `(1+2u) / (N (1+u)^2)` of each of its two neighbours in
//! the face and `1 / (N (1+u)^2)` of each other corner; then `(k-3)/2` uniform smoothings. The published
//! smoothing mask 1/4, 1/8, 1/16 has no unique opposite corner beside an N-gon; here a point becomes the
//! mean of the centroids of its four faces, with the N-gon's true centroid, which is the mask where all
//! faces are quadrilaterals.

use super::doo_sabin::CORNER;
use crate::{Error, Fan, Lattice, Level, Line, Pass, Same, Scalar, Scheme, Site, Stencil};

/// The largest order, that of curves: the local matrix of order k has about `N k^2 / 4` rows.
pub use eigenring_spline::curve::MAX_ORDER;

/// Levels that are told apart from the limit level: `u - 1` shrinks by 4 a level, and u is at most the
/// largest double.
const MAX_LEADING: usize = 600;

/// The scheme of order `order` with initial tension `u0`, around a vertex (even orders) or a face (odd
/// orders).
///
/// # Errors
/// [`Error::Valence`] below 3, [`Error::Order`] unless 3 <= order <= [`MAX_ORDER`], [`Error::Tension`] unless
/// u0 is finite and above -1.
pub fn tension<S: Scalar>(valence: usize, order: usize, u0: f64) -> Result<Scheme<S>, Error> {
    let names = names(valence, order)?;
    check_tension(u0)?;
    let mut tensions = tensions::<S>(u0);
    let limit = tensions.pop().unwrap_or_else(S::one);
    Ok(Scheme::new(
        format!("tension:order={order},u0={u0}"),
        tensions.into_iter().map(|u| valued(&names, u)).collect(),
        valued(&names, limit),
    ))
}

/// A level around a closed fan over the names of its weights.
pub(super) fn names(valence: usize, order: usize) -> Result<Level<Name>, Error> {
    if valence < 3 {
        return Err(Error::Valence { valence });
    }
    check_order(order)?;
    match order % 2 {
        0 => even(valence, order),
        _ => odd(valence, order),
    }
}

/// Whether there is a scheme of this order and initial tension.
///
/// # Errors
/// [`Error::Order`] and [`Error::Tension`], as [`tension`].
pub fn check_parameters(order: usize, u0: f64) -> Result<(), Error> {
    check_order(order)?;
    check_tension(u0)
}

fn check_order(order: usize) -> Result<(), Error> {
    if (3..=MAX_ORDER).contains(&order) {
        Ok(())
    } else {
        Err(Error::Order {
            order,
            maximum: MAX_ORDER,
        })
    }
}

pub(super) fn check_tension(u0: f64) -> Result<(), Error> {
    if u0.is_finite() && u0 > -1.0 {
        Ok(())
    } else {
        Err(Error::Tension { tension: u0 })
    }
}

/// A level at a tension.
pub(super) fn valued<S: Scalar>(names: &Level<Name>, u: S) -> Level<S> {
    let values = Values::new(names.fan().sectors(), u);
    names.map(|name| values.of(*name))
}

/// The tension of the next level: the half-angle formula.
pub(super) fn next_tension<S: Scalar>(u: S) -> S {
    ((S::one() + u) / S::ratio(2, 1)).sqrt()
}

/// The tensions of all levels, the limit's, which is 1, last.
pub(super) fn tensions<S: Scalar>(u0: f64) -> Vec<S> {
    tensions_from(S::exact(u0), u0)
}

/// The same from any number, of which `rough` is the value in doubles.
pub(crate) fn tensions_from<S: Scalar>(u0: S, rough: f64) -> Vec<S> {
    let (mut tensions, mut rough, mut u) = (Vec::new(), rough, u0);
    while rough != 1.0 && tensions.len() < MAX_LEADING {
        tensions.push(u.clone());
        // the half-angle step has 1 as its attractive fixed point and reaches it, to rounding, in finitely
        // many steps
        let next = ((1.0 + rough) / 2.0).sqrt();
        if next == rough {
            break;
        }
        (rough, u) = (next, next_tension(u));
    }
    tensions.push(S::one());
    tensions
}

/// The tension of refinement `level`, 0 for the first, that starts with `u0`.
pub fn tension_at<S: Scalar>(u0: f64, level: usize) -> S {
    let mut tensions = tensions(u0);
    tensions.swap_remove(level.min(tensions.len() - 1))
}

/// The weights of smoothing `step`, 0 for the one that knows the tension `u`, at a vertex of any valence from
/// 2: its own, that of each edge neighbour, that of each face neighbour.
pub fn smoothing_weights<S: Scalar>(step: usize, valence: usize, u: S) -> [S; 3] {
    let [_, _, own, edge, face] = smoothing_names(step, valence as i64);
    let values = Values::new(valence, u);
    [own, edge, face].map(|name| values.of(name))
}

/// The weights of smoothing `step`, 0 for the one that knows the tension: side and middle of the line, then
/// the centre's own weight, that of each edge neighbour and that of each face neighbour.
pub(super) fn smoothing_names(step: usize, n: i64) -> [Name; 5] {
    if step == 0 {
        return [Name::Side, Name::Middle, Name::Own, Name::Edge, Name::Face];
    }
    [(1, 4), (1, 2), (n - 3, n), (2, n * n), (1, n * n)].map(|(p, q)| Name::Number(p, q))
}

/// The weights by name: the symmetry of a level over names holds for every tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Name {
    /// A number that does not depend on the tension.
    Number(i64, i64),
    /// `1 / (2 (1+u))`: the sides of the first smoothing, the far point of corner cutting.
    Side,
    /// `u / (1+u)`: the middle of the first smoothing.
    Middle,
    /// `(1+2u) / (2 (1+u))`: the near point of corner cutting.
    Near,
    /// Of the first smoothing at a vertex: its own weight, that of each edge neighbour, of each face
    /// neighbour.
    Own,
    Edge,
    Face,
    /// Of corner cutting in the N-gon: the own corner, its two neighbours, each other one.
    Corner,
    NextCorner,
    FarCorner,
}

impl Same for Name {
    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

/// What the names stand for at a valence and a tension.
pub(super) struct Values<S> {
    n: i64,
    u: S,
}

impl<S: Scalar> Values<S> {
    pub(super) fn new(valence: usize, u: S) -> Self {
        Values { n: valence as i64, u }
    }

    pub(super) fn of(&self, name: Name) -> S {
        let int = |i: i64| S::ratio(i, 1);
        let (n, u, one) = (self.n, || self.u.clone(), S::one);
        let square = || (one() + u()) * (one() + u());
        let scale = || one() / (int(n) * (one() + u()) * (one() + u()));
        match name {
            Name::Number(p, q) => S::ratio(p, q),
            Name::Side => one() / (int(2) * (one() + u())),
            Name::Middle => u() / (one() + u()),
            Name::Near => one() - self.of(Name::Side),
            Name::Own => (int(n - 4) * (one() + int(2) * u()) + int(n) * u() * u()) / (int(n) * square()),
            Name::Edge => int(8) * u() / (int(n * n) * square()),
            Name::Face => int(4) / (int(n * n) * square()),
            Name::Corner => (int(n) * u() * u() + int(2 * n - 4) * u() + one()) * scale(),
            Name::NextCorner => (one() + int(2) * u()) * scale(),
            Name::FarCorner => one() * scale(),
        }
    }
}

fn even(valence: usize, order: usize) -> Result<Level<Name>, Error> {
    let fan = Fan::Closed(valence);
    let (edge, face) = (Site { sector: 0, x: 2, y: 0 }, Site { sector: 0, x: 2, y: 2 });
    let smoothing = |step: usize| {
        let [side, middle, own, edge_weight, face_weight] = smoothing_names(step, valence as i64);
        let stencil = Stencil::new()
            .with(Site::CENTRE, own)
            .with_orbit(fan, edge, edge_weight)
            .with_orbit(fan, face, face_weight);
        let line = Line::new(vec![vec![(-2, side), (0, middle), (2, side)]]);
        Pass::regular(Lattice::Vertex, Lattice::Vertex, line).with(Site::CENTRE, stencil)
    };
    let [half, one] = [(1, 2), (1, 1)].map(|(p, q)| Name::Number(p, q));
    let midpoints = Line::new(vec![vec![(0, one)], vec![(-2, half), (2, half)]]);
    let mut passes = vec![Pass::regular(Lattice::Vertex, Lattice::Vertex, midpoints)];
    passes.extend((0..order / 2 - 1).map(smoothing));
    Level::new(fan, passes)
}

fn odd(valence: usize, order: usize) -> Result<Level<Name>, Error> {
    let (fan, n) = (Fan::Closed(valence), valence as i64);
    let corner = (0..n).fold(Stencil::new(), |stencil, j| {
        let weight = match j {
            0 => Name::Corner,
            j if j == 1 || j == n - 1 => Name::NextCorner,
            _ => Name::FarCorner,
        };
        stencil.with(CORNER.rotated(fan, j), weight)
    });
    let cutting = Line::new(vec![
        vec![(1, Name::Near), (-3, Name::Side)],
        vec![(-1, Name::Near), (3, Name::Side)],
    ]);
    let mut passes = vec![Pass::regular(Lattice::Face, Lattice::Face, cutting).with(CORNER, corner)];
    let centroid = Stencil::new().with_orbit(fan, CORNER, Name::Number(1, n));
    let half = Name::Number(1, 2);
    let average = || Line::new(vec![vec![(-1, half), (1, half)]]);
    for _ in 0..(order - 3) / 2 {
        passes.push(Pass::regular(Lattice::Face, Lattice::Vertex, average()).with(Site::CENTRE, centroid.clone()));
        passes.push(Pass::regular(Lattice::Vertex, Lattice::Face, average()));
    }
    Level::new(fan, passes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_four_at_tension_one_is_catmull_clark() {
        for valence in 3..12 {
            let tension = tension::<f64>(valence, 4, 1.0).unwrap();
            let reference = super::super::catmull_clark::<f64>(valence).unwrap();
            let net = crate::DenseNet {
                numbering: reference.numbering(2),
            };
            let sites = net.numbering.sites();
            let rows = crate::refine(tension.limit(), &net, &sites).unwrap();
            let expected = crate::refine(reference.limit(), &net, &sites).unwrap();
            for (row, expected) in rows.iter().zip(&expected) {
                for (a, b) in row.iter().zip(expected) {
                    assert!((a - b).abs() < 1e-15, "valence {valence}");
                }
            }
        }
    }

    #[test]
    fn odd_orders_equal_doo_sabin_at_valence_four_only() {
        for valence in 3..9 {
            let rows = |scheme: Scheme<f64>| scheme.limit().stencil(0, CORNER).unwrap();
            let ours = rows(tension(valence, 3, 1.0).unwrap());
            let original = rows(super::super::doo_sabin(valence).unwrap());
            let distance = ours
                .terms()
                .iter()
                .zip(original.terms())
                .map(|(a, b)| (a.1 - b.1).abs())
                .fold(0.0, f64::max);
            assert_eq!(distance < 1e-15, valence == 4, "valence {valence}: {distance}");
        }
    }

    #[test]
    fn all_stencils_are_affine_and_closed_rings_are_the_smallest() {
        for valence in [3, 4, 5, 8] {
            for order in 3..=12 {
                for u0 in [0.01, 0.5, 1.0, 2.0, 50.0] {
                    let scheme = tension::<f64>(valence, order, u0).unwrap();
                    let level = scheme.level(0);
                    for pass in 0..level.passes().len() {
                        for &site in level.passes()[pass].special().keys() {
                            let sum = level.stencil(pass, site).unwrap().sum();
                            assert!((sum - 1.0).abs() < 1e-14);
                        }
                    }
                    let rings = if order % 2 == 0 { order / 2 - 1 } else { (order - 3) / 2 };
                    assert_eq!(scheme.closed_rings(), Ok(rings), "order {order}");
                }
            }
        }
    }

    #[test]
    fn tension_tends_to_one_from_both_sides() {
        for u0 in [-0.999, 0.0, 0.7, 1.0, 50.0, 1e300] {
            let scheme = tension::<f64>(5, 4, u0).unwrap();
            assert!(scheme.leading().len() < MAX_LEADING, "{u0}: {}", scheme.leading().len());
            assert_eq!(scheme.leading().is_empty(), u0 == 1.0);
        }
        for u0 in [-1.0, -3.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(tension::<f64>(5, 4, u0), Err(Error::Tension { .. })));
        }
        assert!(matches!(tension::<f64>(5, 2, 1.0), Err(Error::Order { .. })));
    }
}
