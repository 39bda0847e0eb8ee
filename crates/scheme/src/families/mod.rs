//! The built-in families, one file each: a constructor that returns a [`Scheme`].

mod catmull_clark;
mod doo_sabin;
mod features;
mod half_cell;
mod intervals;
mod split_face;
mod tension;

pub use catmull_clark::{catmull_clark, catmull_clark_weights};
pub use doo_sabin::doo_sabin;
pub use half_cell::half_cell;
pub use intervals::{sector_lines, with_intervals};
pub use split_face::SplitFace;
pub(crate) use tension::tensions_from;
pub use tension::{MAX_ORDER, check_parameters, smoothing_weights, tension, tension_at};

use crate::{Centre, Corner, Error, Level, Scalar, Scheme};

/// Catmull-Clark around any vertex: closed, boundary, crease, dart, corner or cusp, of uniform knot
/// intervals, or with knot intervals where four sectors meet.
///
/// # Errors
/// [`Error::Unsupported`] for other corners.
pub fn catmull_clark_around<S: Scalar>(corner: &Corner) -> Result<Scheme<S>, Error> {
    const NAME: &str = "catmull-clark";
    if !corner.is_uniform() {
        return with_intervals(NAME, corner);
    }
    if corner.centre() != Centre::Vertex || corner.steps().is_some() {
        return Err(Error::Unsupported {
            scheme: NAME.to_owned(),
            corner: corner.to_string(),
            accepted: "corners of vertices, creases that act in every step".to_owned(),
        });
    }
    let sectors = corner.sectors().sectors();
    if corner.is_plain() {
        return catmull_clark(sectors);
    }
    let vertex = if corner.sectors().is_closed() {
        let scheme = catmull_clark::<S>(sectors)?;
        scheme.limit().stencil(0, crate::Site::CENTRE)?
    } else {
        // both ends of an open fan are sharp, so that the smooth mask is not asked for
        crate::Stencil::new().with(crate::Site::CENTRE, S::one())
    };
    Ok(Scheme::stationary(NAME, features::bicubic(corner, vertex)?))
}

/// The tension scheme around any corner of its own kind of centre.
///
/// # Errors
/// Those of [`tension`] and [`tension_level`].
pub fn tension_around<S: Scalar>(corner: &Corner, order: usize, u0: f64) -> Result<Scheme<S>, Error> {
    let names = tension_names(corner, order)?;
    tension::check_tension(u0)?;
    let mut tensions = tension::tensions::<S>(u0);
    let limit = tensions.pop().unwrap_or_else(S::one);
    let leading = tensions.into_iter().map(|u| tension::valued(&names, u)).collect();
    let name = format!("tension:order={order},u0={u0}");
    Ok(Scheme::new(name, leading, tension::valued(&names, limit)))
}

/// One level of the tension scheme around a corner at the tension `u`; the limit level is that of `u = 1`.
///
/// # Errors
/// [`Error::Order`]; [`Error::Unsupported`] for odd orders beside boundaries and creases, for knot intervals,
/// and for creases that act in more steps than there are.
pub fn tension_level<S: Scalar>(corner: &Corner, order: usize, u: S) -> Result<Level<S>, Error> {
    Ok(tension::valued(&tension_names(corner, order)?, u))
}

/// The tension of the first level after the leading ones that [`tension`] lists, at which it is 1 to rounding
/// in doubles. `None` for `u0 = 1`, where all levels are the limit level.
pub fn tension_after_leading<S: Scalar>(u0: f64) -> Option<S> {
    let mut tensions = tension::tensions::<S>(u0);
    tensions.pop();
    tensions.pop().map(tension::next_tension)
}

fn tension_names(corner: &Corner, order: usize) -> Result<Level<tension::Name>, Error> {
    let sectors = corner.sectors().sectors();
    // a valence of 4 stands for fans of any size in the check of the order
    let plain = tension::names(if corner.is_plain() { sectors } else { 4 }, order)?;
    let most = (order / 2).saturating_sub(1);
    let centre = if order.is_multiple_of(2) {
        Centre::Vertex
    } else {
        Centre::Face
    };
    let refuse = |accepted: String| Error::Unsupported {
        scheme: format!("tension:order={order}"),
        corner: corner.to_string(),
        accepted,
    };
    if corner.centre() != centre || !corner.is_uniform() {
        return Err(refuse(
            "corners of its own kind of centre with uniform knot intervals".to_owned(),
        ));
    }
    if corner.is_plain() {
        return Ok(plain);
    }
    if centre == Centre::Face {
        return Err(refuse("closed fans without creases at odd orders".to_owned()));
    }
    if corner.steps().is_some_and(|steps| steps > most) {
        return Err(refuse(format!("creases that act in 0 to {most} smoothing steps")));
    }
    features::level(corner, order)
}
