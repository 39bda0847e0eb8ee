//! Blending functions of an extraordinary vertex under several schemes, with counts of their maxima.

use crate::error::Error;
use crate::progress::{Progress, each};
use crate::table::{Cell, Table};
use eigenring_nonuniform::{Blending, Scheme, Spokes};

/// Levels beyond this take gigabytes.
pub const MAX_LEVELS: usize = 7;

/// A maximum counts if the function falls by more than this share of its highest value on the way to a higher
/// one.
pub const SHARE: f64 = 0.002;

/// One row for each scheme: its highest value, how many other maxima there are and how deep the deepest of
/// them is, and the value at the vertex, all in the limit at the vertices of the net after so many levels.
///
/// # Errors
/// [`Error::Range`] for levels beyond [`MAX_LEVELS`]; intervals for which a scheme does not exist.
pub fn table(schemes: &[Scheme], spokes: &Spokes, levels: usize, progress: &dyn Progress) -> Result<Table, Error> {
    if levels > MAX_LEVELS {
        return Err(Error::Range {
            what: "number of levels",
            given: levels.to_string(),
            accepted: format!("0 to {MAX_LEVELS}"),
        });
    }
    let found = each(progress, "blending functions", schemes, |scheme| {
        Blending::new(*scheme, spokes, levels).map_err(Error::from)
    })?;
    let mut table = Table::new(["scheme", "valence", "highest", "others", "depth", "centre"]);
    for (scheme, blending) in schemes.iter().zip(&found) {
        let depth = blending.others(SHARE).next().map(|peak| peak.depth);
        table.push(vec![
            scheme.to_string().into(),
            spokes.valence().into(),
            blending.peaks[0].value.into(),
            blending.others(SHARE).count().into(),
            depth.map_or(Cell::Empty, Cell::from),
            blending.centre.into(),
        ]);
    }
    Ok(table)
}
