//! The end of the recommended region.
//!
//! Ma, Wang and Ma (2023, section 4.4) recommend lambda up to `lambda_r2`, beyond which quadrilaterals of the
//! second ring of the natural configuration may overlap or be concave; they give it as empirical. Here it is
//! the smallest lambda above lambda_C* at which a corner of a quadrilateral between rings 1 and 2 reaches 180
//! degrees: where the cross product of two consecutive edges vanishes. A quadrilateral with four positive
//! corners is convex, and convex quadrilaterals around the centre, each turning the same way, do not overlap.

use super::Error;
use eigenring_scheme::lambda::{LambdaEntry, Relaxation};
use eigenring_scheme::{Lattice, Scheme, Site};
use eigenring_spectral::NaturalMode;

/// Steps of lambda in which the first concave corner is looked for.
const STEPS: usize = 400;

/// `lambda_r2` of the spline stencils, at most `end`.
pub(super) fn end(entry: &LambdaEntry, end: f64) -> Result<f64, Error> {
    let relaxation = Relaxation::new(entry.valence)?;
    let convexity = |lambda: f64| -> Result<f64, Error> {
        let (f2, f3) = entry.weights(lambda)?;
        let mut plane = relaxation.plane(lambda)?;
        plane.phi = entry.phi;
        let scheme = plane.stencil(f2, f3).weights.scheme("lambda", entry.valence)?;
        Ok(second_ring_convexity(&scheme, lambda)?)
    };
    let start = entry.lambda_optimal;
    let at = |i: usize| {
        if i == STEPS {
            end
        } else {
            start + (end - start) * i as f64 / STEPS as f64
        }
    };
    for i in 1..=STEPS {
        if convexity(at(i))? > 0.0 {
            continue;
        }
        let (mut convex, mut concave) = (at(i - 1), at(i));
        // to the last bit but a few
        for _ in 0..50 {
            let middle = 0.5 * (convex + concave);
            if convexity(middle)? > 0.0 {
                convex = middle;
            } else {
                concave = middle;
            }
        }
        return Ok(convex);
    }
    Ok(end)
}

/// The smallest cross product of consecutive edges over the corners of the quadrilaterals between rings 1 and
/// 2 of the natural configuration, with `E_0 = (1, 0)`: positive if all are convex and turn anticlockwise.
///
/// # Errors
/// Those of the eigenvector of `lambda` in block 1; [`eigenring_spectral::Error::NotSymmetric`] for schemes
/// around a face.
pub fn second_ring_convexity(scheme: &Scheme<f64>, lambda: f64) -> Result<f64, eigenring_spectral::Error> {
    if scheme.lattice() != Lattice::Vertex {
        return Err(eigenring_spectral::Error::NotSymmetric);
    }
    let mode = NaturalMode::new(scheme.limit(), 2, lambda)?;
    // all corners lie in the closed sector 0; (0, b) is on spoke 1
    let at = |a: i32, b: i32| mode.at(Site::new(scheme.fan(), 0, 2 * a, 2 * b).unwrap_or(Site::CENTRE));
    let [ex, ey] = at(1, 0)?;
    let size = ex * ex + ey * ey;
    let mut smallest = f64::INFINITY;
    for corner in [(1, 0), (1, 1), (0, 1)] {
        let (a, b) = corner;
        let quad = [at(a, b)?, at(a + 1, b)?, at(a + 1, b + 1)?, at(a, b + 1)?];
        for i in 0..4 {
            let [p, q, r] = [quad[i], quad[(i + 1) % 4], quad[(i + 2) % 4]];
            let cross = (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]);
            // the mode's arbitrary phase and scale leave this ratio
            smallest = smallest.min(cross / size);
        }
    }
    Ok(smallest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::catmull_clark;

    #[test]
    fn a_regular_net_has_unit_squares() {
        let smallest = second_ring_convexity(&catmull_clark(4).unwrap(), 0.5).unwrap();
        assert!((smallest - 1.0).abs() < 1e-12);
    }

    #[test]
    fn catmull_clark_is_convex_and_large_lambda_is_not() {
        for valence in [3, 5, 8, 16] {
            let lambda = super::super::lambda_catmull_clark(valence);
            let smallest = second_ring_convexity(&catmull_clark(valence).unwrap(), lambda).unwrap();
            assert!(smallest > 0.0, "valence {valence}: {smallest}");
        }
    }
}
