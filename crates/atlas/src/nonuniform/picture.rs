//! Surfaces with knot intervals as they are drawn: a net fine enough, with exact limits and normals at its
//! points.

use crate::error::Error;
use crate::render::{Show, Subject};
use eigenring_nonuniform::{Limits, Outside, Place, Refinement, Scheme};
use eigenring_surface::{Mesh, Point3, Vector3};

/// Quads of the net for each pixel of a picture: cells are about three pixels wide.
const PER_PIXEL: f64 = 0.12;
/// Larger nets take gigabytes, and zero intervals are never split.
const MOST_QUADS: f64 = 5e5;
const MOST_LEVELS: usize = 9;

/// The surface of a mesh for a picture of so many pixels a side, and the places that have the simple rule
/// for want of an eigen-polyhedron.
///
/// # Errors
/// [`Error::Usage`] for what is not computed of these schemes; those of [`Refinement`].
pub fn subject(
    mesh: &Mesh,
    scheme: Scheme,
    outside: Outside,
    size: usize,
    show: Show,
) -> Result<(Subject<'static>, Vec<Place>), Error> {
    if matches!(show, Show::Gauss | Show::Mean | Show::Wireframe) {
        return Err(Error::Usage {
            message: format!("curvature and parameters of {scheme} are not computed"),
            accepted: "--show shaded, highlight, reflection or isophotes".to_owned(),
        });
    }
    let mut refinement = Refinement::new(mesh, scheme, outside)?;
    let wanted = (PER_PIXEL * (size * size) as f64).min(MOST_QUADS);
    for _ in 0..MOST_LEVELS {
        refinement.refine()?;
        if refinement.net().topology().face_count() as f64 >= wanted {
            break;
        }
    }
    let mesh = mesh.without_unused();
    let lifted: Vec<[f64; 4]> = (0..mesh.points().len())
        .map(|i| {
            let (p, w) = (mesh.points()[i], mesh.weights().map_or(1.0, |weights| weights[i]));
            [w * p.x, w * p.y, w * p.z, w]
        })
        .collect();
    let limits = Limits::new(&refinement)?.of(&refinement.apply(&lifted)?)?;
    let mut fine = refinement.net().mesh().clone();
    let mut normals = Vec::with_capacity(limits.len());
    for (point, [at, s, t]) in fine.points_mut().iter_mut().zip(limits) {
        let place = |p: [f64; 4]| Vector3::new(p[0], p[1], p[2]);
        let position = place(at) / at[3];
        *point = Point3::from(position);
        // derivatives of a quotient, up to a factor
        let [s, t] = [s, t].map(|slope| place(slope) - slope[3] * position);
        let normal = s.cross(&t);
        // parallel tangents have none, up to rounding
        normals.push((normal.norm() > 1e-12 * s.norm() * t.norm()).then(|| normal.normalize()));
    }
    Ok((Subject::Limits(fine, normals), refinement.simple))
}
