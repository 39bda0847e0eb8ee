//! The characteristic map: regular, injective, convex at its corners, and the signs of second-order
//! curvature.
//!
//! A scheme with subdominant eigenvalue `0 < lambda < 1` of Fourier index 1 is C1 at the centre exactly when
//! its characteristic map is regular and injective (Reif 1995; Peters and Reif 2008, *Subdivision Surfaces*,
//! chapter 5). The map is determined by its patches on the regular [`Annulus`], whose control values are the
//! subdominant eigenvector. Given enclosures of these, a [`PlaneNet`], the checks here prove or refute
//!
//! * **regular** ([`regular`]): the Jacobian has one sign,
//! * **injective** ([`winding`]): the outer boundary winds once round the origin,
//! * the **corner angle** of the natural configuration ([`corner`]),
//! * the **Gauss curvature** of second-order maps (`gauss`).
//!
//! Everything is generic over the scalar: [`Interval`] for one scheme, [`Centred`](crate::Centred) for all
//! schemes of a parameter range at once. [`find`] searches evidence (how far to subdivide, where a map
//! folds); the checks take it as a claim and share nothing with the search. A wrong claim makes a check
//! undecided, never wrong.
//!
//! **What is taken for granted:** the values are those of a rotation-symmetric net, `P_(i+1) = R P_i` with
//! `R` the rotation by `2 pi k / N` (an eigenvector of Fourier block k has this form), and, where `mirror` is
//! set, of one symmetric under reflection in the x-axis, on which the first point of ring 1 lies (spoke 0, or
//! the diagonal of sector 0 around a face). Enclosures that contradict these are refused. Only sector 0 is
//! then examined. Nets without rotation symmetry ([`PlaneNet::whole`]) are examined in all sectors. Their two
//! coordinates may belong to two eigenvalues `lambda_1 > lambda_2`: the map is then extended by `X(2 t) =
//! X(t) / diag(lambda_1, lambda_2)`, and what is said below holds for it as well (Zorin 2000, *Smoothness of
//! stationary subdivision on irregular meshes*, Constructive Approximation 16). Scaled by these powers, rings
//! of almost all nets tend to affine images of the map, since every further eigenvalue is below lambda_2; the
//! leading term of their normals is `(lambda_1 lambda_2)^m` times the Jacobian, and the quotient of the
//! punctured plane by the scaling is a torus again.

mod corner;
pub mod find;
mod gauss;
mod product;
mod regular;
mod subdivision;
mod winding;

pub use corner::{Corner, corner};
pub use gauss::{CurvatureEvidence, CurvatureRange, Heights, Sign, curvature};
pub use regular::{JacobianEvidence, Regularity, regular};
pub(crate) use regular::{cut, hull};
pub use subdivision::{MAX_DEPTH, Subdivision};
pub use winding::{Winding, WindingEvidence, winding};

use crate::{Enclose, Interval, Patches};
use eigenring_scheme::{Lattice, Numbering, Scalar, Site};
use eigenring_spectral::{Annulus, PatchIndex};
use eigenring_spline::bernstein::{Coefficient, Polynomial};
use eigenring_spline::uniform::to_bernstein;
use serde::{Deserialize, Serialize};

/// A net that is not what the checks need.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NetError {
    /// The number of values is not that of the annulus's net.
    #[error("the net of the annulus has {expected} points, not {found}")]
    Length {
        /// Points given.
        found: usize,
        /// Points of the numbering.
        expected: usize,
    },
    /// Patches of degree below 2 have no continuous Jacobian.
    #[error("the map checks need patches of degree 2 or more, not {degree}")]
    Degree {
        /// The degree of the annulus.
        degree: usize,
    },
    /// The Fourier index is not one of the fan.
    #[error("a fan of {sectors} sectors has Fourier indices 0 to {}, not {fourier}", .sectors - 1)]
    Fourier {
        /// The index given.
        fourier: usize,
        /// The valence.
        sectors: usize,
    },
    /// The values contradict the symmetry that goes with the Fourier index.
    #[error("point {index} of the net contradicts its {symmetry} symmetry by at least {gap:e}")]
    Symmetry {
        /// Where in the numbering.
        index: usize,
        /// Rotation or mirror.
        symmetry: &'static str,
        /// The distance of the enclosures.
        gap: f64,
    },
    /// A real Fourier index needs one coordinate, a complex one two.
    #[error("heights of Fourier index {fourier} have {expected} part(s), not {found}")]
    Parts {
        /// The index.
        fourier: usize,
        /// Parts given.
        found: usize,
        /// Parts needed.
        expected: usize,
    },
}

/// A point of a map: a patch and parameters in the unit square, exact doubles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// The sector.
    pub sector: usize,
    /// The patch's steps along the sector's own spoke.
    pub p: usize,
    /// The patch's steps along the next spoke.
    pub q: usize,
    /// The parameter along the own spoke.
    pub u: f64,
    /// The parameter along the next spoke.
    pub v: f64,
}

impl Place {
    /// The patch, if it is one of the annulus and the parameters lie in the unit square.
    fn patch(&self, annulus: &Annulus) -> Option<PatchIndex> {
        let patch = PatchIndex {
            sector: self.sector,
            p: self.p,
            q: self.q,
        };
        let in_square = [self.u, self.v].iter().all(|t| (0.0..=1.0).contains(t));
        let far = self.p.max(self.q);
        let in_annulus =
            (annulus.inner..2 * annulus.inner).contains(&far) && self.sector < annulus.numbering.fan.sectors();
        (in_square && in_annulus).then_some(patch)
    }
}

/// A map of the annulus into the plane by its control values: see the module page for the symmetries it has.
#[derive(Clone, Debug)]
pub struct PlaneNet<S> {
    patches: Patches,
    /// The Fourier index; `None` for a net without rotation symmetry, of which all sectors are looked at.
    fourier: Option<usize>,
    mirror: bool,
    x: Vec<S>,
    y: Vec<S>,
}

impl<S: Enclose> PlaneNet<S> {
    /// The net of the real and imaginary parts of a mode of Fourier index `fourier`, over the numbering of
    /// the annulus.
    ///
    /// # Errors
    /// [`NetError`] where lengths, degree or index do not fit, or the values contradict the symmetry.
    pub fn new(annulus: Annulus, fourier: usize, mirror: bool, [x, y]: [Vec<S>; 2]) -> Result<Self, NetError> {
        let parts = [x, y];
        check_size(&annulus, &parts)?;
        let [x, y] = parts;
        let sectors = annulus.numbering.fan.sectors();
        if fourier >= sectors {
            return Err(NetError::Fourier { fourier, sectors });
        }
        let net = PlaneNet {
            patches: annulus.into(),
            fourier: Some(fourier),
            mirror,
            x,
            y,
        };
        let at = |index: usize| [net.x[index].enclosure(), net.y[index].enclosure()];
        check_symmetry(net.annulus().numbering, fourier, mirror.then_some([1, -1]), at)?;
        Ok(net)
    }

    /// A net without symmetry, over the numbering of the annulus: two coordinates of each point, of
    /// eigenvectors of two eigenvalues that may differ.
    ///
    /// # Errors
    /// [`NetError`] where lengths or degree do not fit.
    pub fn whole(patches: Patches, parts: [Vec<S>; 2]) -> Result<Self, NetError> {
        check_size(&patches.annulus, &parts)?;
        let [x, y] = parts;
        Ok(PlaneNet {
            patches,
            fourier: None,
            mirror: false,
            x,
            y,
        })
    }

    /// The net of the middles, in floating point: what a search looks at.
    pub fn middle(&self) -> PlaneNet<f64> {
        let middle = |values: &[S]| values.iter().map(|value| value.central().mid()).collect();
        PlaneNet {
            patches: self.patches.clone(),
            fourier: self.fourier,
            mirror: self.mirror,
            x: middle(&self.x),
            y: middle(&self.y),
        }
    }
}

impl<S: Coefficient> PlaneNet<S> {
    /// Where the patches are.
    pub fn annulus(&self) -> &Annulus {
        &self.patches.annulus
    }

    /// The Fourier index; `None` for a net without rotation symmetry.
    pub fn fourier(&self) -> Option<usize> {
        self.fourier
    }

    /// The sectors that stand for all: the first under rotation, else every one.
    pub(crate) fn representatives(&self) -> std::ops::Range<usize> {
        0..if self.fourier.is_some() { 1 } else { self.sectors() }
    }

    /// The valence.
    pub fn sectors(&self) -> usize {
        self.annulus().numbering.fan.sectors()
    }

    /// The patches that stand for all others under rotation, and under reflection where the net has it: those
    /// of sector 0, of mirror images the one nearer to the own spoke. Without rotation symmetry those of all
    /// sectors.
    pub fn patches(&self) -> Vec<PatchIndex> {
        self.representatives()
            .flat_map(|sector| self.annulus().patches(sector))
            .filter(|patch| !self.mirror || patch.p >= patch.q)
            .collect()
    }

    /// The coordinates of a patch in Bernstein form.
    pub(crate) fn coordinates(&self, patch: PatchIndex, conversion: &[Vec<S>]) -> [Polynomial<S>; 2] {
        [&self.x, &self.y].map(|values| self.patches.polynomial(values, patch, conversion))
    }

    /// The Jacobian `x_u y_v - x_v y_u` on a patch, of degrees `2d - 1`.
    pub fn jacobian(&self, patch: PatchIndex) -> Polynomial<S> {
        self.jacobian_with(patch, &to_bernstein(self.annulus().degree))
    }

    /// The Jacobians on [`PlaneNet::patches`].
    pub fn jacobians(&self) -> Vec<Polynomial<S>> {
        let conversion = to_bernstein(self.annulus().degree);
        self.patches()
            .into_iter()
            .map(|patch| self.jacobian_with(patch, &conversion))
            .collect()
    }

    fn jacobian_with(&self, patch: PatchIndex, conversion: &[Vec<S>]) -> Polynomial<S> {
        let [x, y] = self.coordinates(patch, conversion);
        let [xu, xv, yu, yv] = [x.by_u(), x.by_v(), y.by_u(), y.by_v()].map(|f| f.scaled());
        xu.product(&yv).minus(&xv.product(&yu)).unscaled()
    }
}

fn check_size<S>(annulus: &Annulus, parts: &[Vec<S>; 2]) -> Result<(), NetError> {
    let expected = annulus.numbering.count();
    if let Some(part) = parts.iter().find(|part| part.len() != expected) {
        return Err(NetError::Length {
            found: part.len(),
            expected,
        });
    }
    if annulus.degree < 2 {
        return Err(NetError::Degree { degree: annulus.degree });
    }
    Ok(())
}

/// Values that are each other's images must have enclosures that meet. `mirror` holds the signs of the two
/// parts under reflection in the axis.
fn check_symmetry(
    numbering: Numbering,
    fourier: usize,
    mirror: Option<[i64; 2]>,
    at: impl Fn(usize) -> [Interval; 2],
) -> Result<(), NetError> {
    let (cos, sin) = turn(fourier, numbering.fan.sectors());
    let meet = |index: usize, symmetry, found: [Interval; 2], expected: [Interval; 2]| {
        let gaps = found
            .iter()
            .zip(&expected)
            .map(|(a, b)| (b.lo() - a.hi()).max(a.lo() - b.hi()));
        let gap = gaps.fold(0.0, f64::max);
        if gap > 0.0 {
            Err(NetError::Symmetry { index, symmetry, gap })
        } else {
            Ok(())
        }
    };
    for (index, site) in numbering.sites().into_iter().enumerate() {
        let [x, y] = at(index);
        let image = |site: Site| numbering.index(site).map(&at);
        if let Some(rotated) = image(site.rotated(numbering.fan, 1)) {
            meet(index, "rotation", rotated, [cos * x - sin * y, sin * x + cos * y])?;
        }
        // around a face the axis is the diagonal of sector 0, one sector's reflection further on
        let onwards = match numbering.lattice {
            Lattice::Vertex => 0,
            Lattice::Face => 1,
        };
        let mirrored = site.mirrored(numbering.fan).rotated(numbering.fan, onwards);
        if let (Some([a, b]), Some(mirrored)) = (mirror, image(mirrored)) {
            meet(
                index,
                "mirror",
                mirrored,
                [Interval::integer(a) * x, Interval::integer(b) * y],
            )?;
        }
    }
    Ok(())
}

/// Cosine and sine of `2 pi k / n`.
fn turn(k: usize, n: usize) -> (Interval, Interval) {
    (
        Interval::cos_turn(k as i64, n as i64),
        Interval::sin_turn(k as i64, n as i64),
    )
}

#[cfg(test)]
mod attacks;
#[cfg(test)]
mod bernstein;
#[cfg(test)]
mod tests;
