//! The natural configuration: control points whose coordinates are the eigenvectors of the subdominant pair.
//!
//! The mode of the subdominant eigenvalue lambda in Fourier block 1, `P_i(a,b) = w^i v(a,b)`, is a complex
//! vector. Read as points of the plane it is mapped to itself times lambda by refinement (Reif 1995). It is
//! determined up to a complex factor, that is up to rotation and size:
//!
//! * [`LocalSystem::natural`] has the first point of ring 1 at (1, 0): `E_0` around a vertex, with the centre
//!   at the origin; the corner of sector 0 of the face around a face.
//! * [`NaturalMode`] is one sector's part from block 1 alone, in whatever scale its eigenvector comes. It is
//!   for ratios, which do not depend on the factor, and where many schemes are looked at.

use crate::{Error, LocalSystem, fourier_block, numbering};
use eigenring_scheme::{Complex, FourierNet, Level, Site};

/// The natural configuration of a local system.
#[derive(Clone, Debug, PartialEq)]
pub struct Natural {
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// x and y of each point, in the order of the numbering.
    pub points: [Vec<f64>; 2],
}

impl LocalSystem {
    /// The natural configuration: that of the largest real eigenvalue of block 1, with the first point of
    /// ring 1 at (1, 0).
    ///
    /// # Errors
    /// [`Error::NotSymmetric`] for rules that differ from sector to sector; [`Error::Scaling`] if block 1 has
    /// no real eigenvalue, [`Error::Multiplicity`] or [`Error::Defective`] if that has not one eigenvector.
    pub fn natural(&self) -> Result<Natural, Error> {
        if !self.symmetric() {
            return Err(Error::NotSymmetric);
        }
        let eigenvalues = self.blocks()[1].eigenvalues()?;
        let real = eigenvalues.iter().find(|eigenvalue| eigenvalue.value.im == 0.0);
        let lambda = real
            .map(|eigenvalue| eigenvalue.value.re)
            .ok_or(Error::Scaling { value: 0.0, fourier: 1 })?;
        let mode = self.single(1, lambda)?;
        let (x, y) = mode.values.into_iter().map(|z| (z.re, z.im)).unzip();
        Ok(Natural { lambda, points: [x, y] })
    }
}

/// A natural configuration up to rotation and size, point by point.
#[derive(Clone, Debug)]
pub struct NaturalMode {
    net: FourierNet<f64>,
    unknowns: Vec<Complex<f64>>,
}

impl NaturalMode {
    /// The mode of an eigenvalue `lambda` of block 1 on `rings` rings.
    ///
    /// # Errors
    /// Those of [`fourier_block`]; [`Error::Multiplicity`] unless the eigenvalue has one eigenvector.
    pub fn new(level: &Level<f64>, rings: usize, lambda: f64) -> Result<Self, Error> {
        let space = fourier_block(level, rings, 1)?.eigenspace(Complex::real(lambda), 1)?;
        let [unknowns] = space.right.as_slice() else {
            return Err(Error::Multiplicity {
                value: lambda,
                fourier: 1,
                found: space.right.len(),
                expected: 1,
            });
        };
        Ok(NaturalMode {
            net: FourierNet::new(numbering(level, rings), 1, level.has_mirror())?,
            unknowns: unknowns.clone(),
        })
    }

    /// The point at a site.
    ///
    /// # Errors
    /// A site beyond the rings.
    pub fn at(&self, site: Site) -> Result<[f64; 2], Error> {
        let point = self.net.mode(&self.unknowns, site)?;
        Ok([point.re, point.im])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin};
    use eigenring_scheme::{PointNet, refine};

    /// The oracle is refinement, which knows nothing of eigenvalues.
    #[test]
    fn refinement_shrinks_it_by_lambda() {
        for scheme in [catmull_clark::<f64>(5).unwrap(), doo_sabin(7).unwrap()] {
            let system = LocalSystem::new(scheme.limit(), 2).unwrap();
            let Natural { lambda, points: [x, y] } = system.natural().unwrap();
            let numbering = system.numbering();
            let points: Vec<[f64; 2]> = x.iter().zip(&y).map(|(x, y)| [*x, *y]).collect();
            let net = PointNet {
                numbering,
                points: points.clone(),
            };
            let refined = refine(scheme.limit(), &net, &numbering.sites()).unwrap();
            for (fine, coarse) in refined.iter().zip(&points) {
                for axis in 0..2 {
                    assert!((fine[axis] - lambda * coarse[axis]).abs() < 1e-12);
                }
            }
            assert!(points.contains(&[1.0, 0.0]));
        }
    }

    #[test]
    fn both_forms_are_the_same_up_to_a_complex_factor() {
        let scheme = catmull_clark::<f64>(6).unwrap();
        let system = LocalSystem::new(scheme.limit(), 2).unwrap();
        let Natural { lambda, points: [x, y] } = system.natural().unwrap();
        let mode = NaturalMode::new(scheme.limit(), 2, lambda).unwrap();
        let [ex, ey] = mode.at(Site::new(scheme.fan(), 0, 2, 0).unwrap()).unwrap();
        for (index, site) in system.numbering().sites().into_iter().enumerate() {
            let [px, py] = mode.at(site).unwrap();
            // E_0 is (1, 0) in the other form, so that the factor is its point in this one
            let expected = [x[index] * ex - y[index] * ey, x[index] * ey + y[index] * ex];
            assert!((px - expected[0]).hypot(py - expected[1]) < 1e-12, "{site:?}");
        }
    }
}
