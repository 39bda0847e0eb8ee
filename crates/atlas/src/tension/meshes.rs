//! Characteristic meshes: the control points whose coordinates are the eigenvectors of the subdominant pair.
//!
//! The mode of the subdominant eigenvalue in block 1, `P_i(a,b) = w^i v(a,b)`, is a complex vector,
//! determined up to a complex factor; its real and imaginary part are eigenvectors of lambda_1 = lambda_2. It
//! is scaled so that the first point is at (1, 0): `P_0(1,0)` for even orders, which leads to a mesh
//! symmetric about the x axis, and the corner `P_0(0,0)` of the face for odd ones, whose diagonal then is the
//! x axis. The centre of even orders is at (0, 0).

use super::sweep::Case;
use crate::error::Error;
use crate::table::Table;
use eigenring_scheme::Site;
use eigenring_scheme::families::tension;
use eigenring_spectral::{LocalSystem, Natural};

/// A control point in the plane.
pub struct ControlPoint {
    case: Case,
    level: usize,
    site: Site,
    x: f64,
    y: f64,
}

/// The points of a mesh, in the order of the numbering.
///
/// # Errors
/// Those of the scheme and its local system; [`Error::Spectral`] if the eigenvalue has not one vector.
pub fn points(case: &Case, level: usize) -> Result<Vec<ControlPoint>, Error> {
    let scheme = tension::<f64>(case.valence, case.order, case.u0)?;
    let system = LocalSystem::new(scheme.level(level), scheme.closed_rings()?)?;
    let Natural { points: [x, y], .. } = system.natural()?;
    let points = system.numbering().sites().into_iter().zip(x.into_iter().zip(y));
    let point = |(site, (x, y))| ControlPoint {
        case: case.clone(),
        level,
        site,
        x,
        y,
    };
    Ok(points.map(point).collect())
}

/// The points as they are stored.
pub fn table(points: impl Iterator<Item = ControlPoint>) -> Table {
    let mut table = Table::new(["order", "valence", "u0", "level", "sector", "a", "b", "x", "y"]);
    for ControlPoint {
        case,
        level,
        site,
        x,
        y,
    } in points
    {
        table.push(vec![
            case.order.into(),
            case.valence.into(),
            case.u0.into(),
            level.into(),
            site.sector.into(),
            (site.x as usize / 2).into(),
            (site.y as usize / 2).into(),
            // the sign of a zero is an accident
            (x + 0.0).into(),
            (y + 0.0).into(),
        ]);
    }
    table
}
