//! Catmull-Clark subdivision, in its generic C1 bicubic form.
//!
//! E. Catmull and J. Clark, *Recursively generated B-spline surfaces on arbitrary topological meshes*,
//! Computer-Aided Design 10(6), 1978, <https://doi.org/10.1016/0010-4485(78)90110-0>. Edge and face points by
//! the regular rules, the vertex by `(1 - 7/(4N)) V + 3/(2N) mean E + 1/(4N) mean F`. The surface is C1 at
//! every valence (Peters and Reif 1998); its curvature is unbounded for N >= 5 and zero in the limit at N =
//! 3.

use crate::{Error, OneRing, Scalar, Scheme, Site};

/// The one-ring weights at a valence.
pub fn catmull_clark_weights<S: Scalar>(valence: usize) -> OneRing<S> {
    let n = valence as i64;
    OneRing {
        f1: S::ratio(1, 4),
        f2: S::ratio(1, 4),
        f3: S::ratio(1, 4),
        d1: S::ratio(3, 8),
        d2: S::ratio(3, 8),
        e1: S::ratio(1, 16),
        e2: S::ratio(1, 16),
        alpha: S::ratio(3, 2 * n),
        beta: S::ratio(1, 4 * n),
    }
}

/// The scheme around a vertex.
///
/// # Errors
/// [`Error::Valence`] below 3.
pub fn catmull_clark<S: Scalar>(valence: usize) -> Result<Scheme<S>, Error> {
    // edge and face points follow the regular rules, so the surface is regular up to the vertex itself
    let level = catmull_clark_weights::<S>(valence.max(1)).level_with(valence, |site| site == Site::CENTRE)?;
    Ok(Scheme::stationary("catmull-clark", level))
}
