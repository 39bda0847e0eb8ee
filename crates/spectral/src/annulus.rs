//! The annulus of patches that generates the surface around the centre.
//!
//! Where all rules are regular the surface of degree d is made of tensor-product polynomial patches: the
//! patch of the square `[p, p+1] x [q, q+1]` of a sector has `(d+1)^2` control points, centred on it. Its
//! images under refinement must be regular too: the control points of the refined patches have to lie beyond
//! the rings with special stencils. If `sigma` is the outermost of these rings, that is so for `max(p, q) >=
//! m` with `2m - floor(d/2) > sigma`. The patches with `m <= max(p, q) < 2m` form the annulus; the rest of
//! the surface consists of its images, scaled by powers of the eigenvalue. For Catmull-Clark m = 1; where
//! face and edge stencils are special as well (the lambda-scheme) m = 2, and the annulus has 12 patches a
//! sector with control points in rings 1 to 5.

use crate::Error;
use eigenring_scheme::{Numbering, Scalar, Scheme, Site};
use eigenring_spline::TensorPatch;

/// The regular annulus of a scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Annulus {
    /// The degree d of the patches in each direction.
    pub degree: usize,
    /// Its inner radius m; the outer one is 2m.
    pub inner: usize,
    /// The control points, out to the last ring that the annulus needs.
    pub numbering: Numbering,
}

/// The square `[p, p+1] x [q, q+1]` of a sector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PatchIndex {
    /// The sector.
    pub sector: usize,
    /// Steps along the sector's own spoke.
    pub p: usize,
    /// Steps along the next spoke.
    pub q: usize,
}

impl Annulus {
    /// The innermost regular annulus of a scheme's limit level.
    ///
    /// # Errors
    /// [`Error::NotSpline`] if the regular rules are not those of a uniform B-spline; [`Error::Scheme`] if
    /// the scheme's rules cannot be run.
    pub fn new<S: Scalar + Copy>(scheme: &Scheme<S>) -> Result<Self, Error> {
        Annulus::at_least(scheme, 1)
    }

    /// The innermost regular annulus whose inner radius is at least `inner`: any annulus further out
    /// generates the surface as well, and schemes are compared on the same one.
    ///
    /// # Errors
    /// As [`Annulus::new`].
    pub fn at_least<S: Scalar + Copy>(scheme: &Scheme<S>, inner: usize) -> Result<Self, Error> {
        let degree = scheme.degree().ok_or(Error::NotSpline)?;
        let special = scheme.special_rings()?.unwrap_or(0);
        let inner = inner.max((special + degree / 2) / 2 + 1);
        // the last patch begins at 2m - 1; its last control point is floor(d/2) before it and d after that
        let rings = 2 * inner - 1 - degree / 2 + degree;
        Ok(Annulus {
            degree,
            inner,
            numbering: scheme.numbering(rings),
        })
    }

    /// The patches of one sector, counted by q and then by p.
    pub fn patches(&self, sector: usize) -> impl Iterator<Item = PatchIndex> {
        let (inner, outer) = (self.inner, 2 * self.inner);
        (0..outer)
            .flat_map(move |q| (0..outer).map(move |p| PatchIndex { sector, p, q }))
            .filter(move |patch| patch.p.max(patch.q) >= inner)
    }

    /// The indices of a patch's control points in the numbering, `d+1` along the own spoke for each of `d+1`
    /// along the next.
    pub fn control(&self, patch: PatchIndex) -> Vec<usize> {
        let parity = self.numbering.lattice.parity();
        let first = |start: usize| start as i32 - (self.degree / 2) as i32;
        let count = self.degree as i32 + 1;
        let (a, b) = (first(patch.p), first(patch.q));
        let mut indices = Vec::with_capacity((count * count) as usize);
        for j in 0..count {
            for i in 0..count {
                let (x, y) = (2 * (a + i) + parity, 2 * (b + j) + parity);
                // a patch next to spoke i+1 may reach across sector i+1 to its far spoke: read in that
                // sector's own coordinates
                let (sector, x, y) = if x < 0 {
                    (patch.sector as i64 + 1, y, -x)
                } else {
                    (patch.sector as i64, x, y)
                };
                let site = Site::new(self.numbering.fan, sector, x, y).and_then(|site| self.numbering.index(site));
                // m > floor(d/2)/2 keeps one coordinate positive, and the numbering reaches the outer rim by
                // construction
                indices.push(site.expect("control points of the annulus lie on its net"));
            }
        }
        indices
    }

    /// The patch of a net whose points have the given values.
    pub fn patch<S: Scalar + Copy>(&self, values: &[S], patch: PatchIndex) -> TensorPatch<S> {
        TensorPatch {
            degree: self.degree,
            control: self.control(patch).into_iter().map(|index| values[index]).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
    use eigenring_scheme::{PointNet, refine};

    #[test]
    fn annuli_of_the_known_schemes() {
        let annulus = |scheme: Scheme<f64>| {
            let annulus = Annulus::new(&scheme).unwrap();
            (annulus.inner, annulus.numbering.rings)
        };
        assert_eq!(annulus(catmull_clark(5).unwrap()), (1, 3));
        assert_eq!(annulus(doo_sabin(5).unwrap()), (1, 2));
        let weights = eigenring_scheme::families::catmull_clark_weights::<f64>(5);
        let scheme = weights.scheme("one-ring", 5).unwrap();
        assert_eq!(Annulus::new(&scheme).unwrap().patches(0).count(), 12);
        assert_eq!(annulus(scheme), (2, 5));
    }

    /// Refining the net and evaluating the refined patch gives the same surface: the patches are limits.
    #[test]
    fn patches_are_limits_of_refinement() {
        for scheme in [
            catmull_clark::<f64>(5).unwrap(),
            doo_sabin(3).unwrap(),
            tension(7, 6, 1.0).unwrap(),
            tension(5, 5, 1.0).unwrap(),
            tension(3, 8, 1.0).unwrap(),
        ] {
            let annulus = Annulus::new(&scheme).unwrap();
            let numbering = scheme.numbering(annulus.numbering.rings + 2);
            let points: Vec<[f64; 1]> = (0..numbering.count()).map(|i| [(i as f64 * 1.3).cos()]).collect();
            let coarse: Vec<f64> = points.iter().map(|p| p[0]).collect();
            let net = PointNet { numbering, points };
            let inner = annulus.inner;
            // fine patches (2p + i, 2q + j) of coarse patch (p, q) reach ring 4m + 1
            let fine_annulus = Annulus {
                numbering: scheme.numbering(4 * inner + annulus.degree),
                ..annulus
            };
            let sites: Vec<Site> = fine_annulus.numbering.sites();
            for patch in annulus.patches(1).filter(|patch| patch.p.max(patch.q) == inner) {
                let surface = annulus.patch(&coarse[..annulus.numbering.count()], patch);
                for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let fine = PatchIndex {
                        sector: 1,
                        p: 2 * patch.p + i,
                        q: 2 * patch.q + j,
                    };
                    let control = fine_annulus.control(fine);
                    let wanted: Vec<Site> = control.iter().map(|&index| sites[index]).collect();
                    let refined = refine(scheme.limit(), &net, &wanted).unwrap();
                    let refined = TensorPatch {
                        degree: annulus.degree,
                        control: refined.into_iter().map(|p| p[0]).collect(),
                    };
                    let (u, v) = (0.3, 0.8);
                    let expected = surface.jet((i as f64 + u) / 2.0, (j as f64 + v) / 2.0);
                    let found = refined.jet(u, v);
                    assert!(
                        (found.value - expected.value).abs() < 1e-14,
                        "{} {patch:?}",
                        scheme.name()
                    );
                    assert!((2.0 * found.first[0] - expected.first[0]).abs() < 1e-12);
                    assert!((4.0 * found.second[1] - expected.second[1]).abs() < 1e-11);
                }
            }
        }
    }
}
