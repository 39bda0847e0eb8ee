//! Regularity: the Jacobian of the map has one sign on the whole annulus.
//!
//! The Jacobian of a patch of degree d is a polynomial of degrees `(2d - 1, 2d - 1)`. If all its Bernstein
//! coefficients are positive, so is the Jacobian; if not, the coefficients on parts of the patch decide,
//! which converge to its values. By rotation (and reflection) symmetry one sector (or half of it) stands for
//! all.
//!
//! **Refuted** by two points of the annulus where the Jacobian certainly has opposite signs: it is continuous
//! (d >= 2) on a connected set, so it vanishes somewhere, and the map is not injective either, since the
//! degree of an injective map of the plane is constant and 1 or -1. The normals of almost all surfaces then
//! point to both sides (Peters and Reif 2008, section 5.2). A Jacobian that merely touches zero refutes
//! nothing.

use super::{Place, PlaneNet, Subdivision};
use crate::{Enclose, Interval, Status};
use eigenring_spline::bernstein::Polynomial;
use serde::{Deserialize, Serialize};

/// A claim about the Jacobian.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JacobianEvidence {
    /// It has one sign; the parts of each of [`PlaneNet::patches`] on which the coefficients show it.
    Sign {
        /// Whether it is positive (the map keeps the orientation) or negative (it is mirrored).
        positive: bool,
        /// One tree for each patch.
        patches: Vec<Subdivision>,
    },
    /// It is negative at one place and positive at the other.
    Fold {
        /// The two places, in this order.
        places: [Place; 2],
    },
}

/// What is known of the Jacobian.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Regularity {
    /// Whether the map is regular.
    pub status: Status,
    /// Proven: the orientation. Undecided: the one that was tried.
    pub positive: bool,
    /// Bounds of the Jacobian: over the whole map (proven, undecided), or its values at the two places
    /// (refuted).
    pub jacobian: [Interval; 2],
    /// Where it has a wrong sign.
    pub fold: Option<[Place; 2]>,
    /// Parts examined.
    pub cells: usize,
    /// The depth of the finest subdivision.
    pub depth: usize,
}

impl Regularity {
    /// How far the Jacobian stays from zero; not positive unless the map is proven regular.
    pub fn margin(&self) -> f64 {
        let [smallest, largest] = self.jacobian;
        if self.positive { smallest.lo() } else { -largest.hi() }
    }

    fn undecided(positive: bool) -> Self {
        Regularity {
            status: Status::Undecided,
            positive,
            jacobian: [Interval::ENTIRE; 2],
            fold: None,
            cells: 0,
            depth: 0,
        }
    }
}

/// Checks the claim. `jacobian` holds an enclosure of the smallest and one of the largest Jacobian, with
/// outer bounds from coefficients and inner ones from values at the corners of the parts.
pub fn regular<S: Enclose>(net: &PlaneNet<S>, evidence: &JacobianEvidence) -> Regularity {
    match evidence {
        JacobianEvidence::Sign { positive, patches } => one_sign(net, *positive, patches),
        JacobianEvidence::Fold { places } => fold(net, *places),
    }
}

fn one_sign<S: Enclose>(net: &PlaneNet<S>, positive: bool, trees: &[Subdivision]) -> Regularity {
    let jacobians = net.jacobians();
    if jacobians.len() != trees.len() {
        return Regularity::undecided(positive);
    }
    let (mut smallest, mut largest): (Option<Interval>, Option<Interval>) = (None, None);
    let (mut cells, mut depth) = (0, 0);
    for (jacobian, tree) in jacobians.into_iter().zip(trees) {
        let walk = tree.walk(jacobian, &cut, &mut |part| {
            let hull = hull(part.coefficients());
            // a value bounds the smallest from above and the largest from below
            for corner in part.corners().map(|corner| corner.enclosure()) {
                let (low, high) = (between(hull.lo(), corner.hi()), between(corner.lo(), hull.hi()));
                smallest = Some(smallest.map_or(low, |known| known.min(low)));
                largest = Some(largest.map_or(high, |known| known.max(high)));
            }
        });
        let Some(walk) = walk else {
            return Regularity::undecided(positive);
        };
        cells += walk.cells;
        depth = depth.max(walk.depth);
    }
    let (Some(smallest), Some(largest)) = (smallest, largest) else {
        return Regularity::undecided(positive);
    };
    let shown = if positive {
        smallest.certainly_positive()
    } else {
        largest.certainly_negative()
    };
    Regularity {
        status: if shown { Status::Proven } else { Status::Undecided },
        positive,
        jacobian: [smallest, largest],
        fold: None,
        cells,
        depth,
    }
}

fn fold<S: Enclose>(net: &PlaneNet<S>, places: [Place; 2]) -> Regularity {
    let value = |place: Place| {
        let patch = place.patch(net.annulus())?;
        Some(
            net.jacobian(patch)
                .value(S::exact(place.u), S::exact(place.v))
                .enclosure(),
        )
    };
    let [Some(first), Some(second)] = places.map(value) else {
        return Regularity::undecided(true);
    };
    let opposite = first.certainly_negative() && second.certainly_positive();
    Regularity {
        status: if opposite { Status::Refuted } else { Status::Undecided },
        positive: true,
        jacobian: [first, second],
        fold: Some(places),
        cells: 0,
        depth: 0,
    }
}

pub(crate) fn cut<S: Enclose>(part: &Polynomial<S>) -> Vec<Polynomial<S>> {
    part.quarters().into()
}

/// An interval that holds all values of a polynomial with these coefficients.
pub(crate) fn hull<S: Enclose>(coefficients: &[S]) -> Interval {
    let enclosures = coefficients.iter().map(Enclose::enclosure);
    enclosures.reduce(Interval::hull).unwrap_or(Interval::ENTIRE)
}

/// The interval between two bounds.
pub(super) fn between(lo: f64, hi: f64) -> Interval {
    Interval::new(lo, hi).unwrap_or(Interval::ENTIRE)
}
