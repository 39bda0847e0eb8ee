//! Blending functions of an extraordinary vertex under several schemes, with counts of their maxima.

use crate::error::Error;
use crate::progress::{Progress, each};
use crate::schemes::SchemeName;
use crate::table::{Cell, Table};
use eigenring_nonuniform::{Blending, FirstLevel, Scheme, Spokes};

/// Levels beyond this take gigabytes.
pub const MAX_LEVELS: usize = 7;

/// A maximum counts if the function falls by more than this share of its highest value on the way to a higher
/// one.
pub const SHARE: f64 = 0.002;

/// All schemes with knot intervals, and all first levels of HNUSS.
pub const ALL: [Scheme; 5] = [
    Scheme::Nurss,
    Scheme::EigenPolyhedron,
    Scheme::Hnuss(FirstLevel::Simple),
    Scheme::Hnuss(FirstLevel::Printed),
    Scheme::Hnuss(FirstLevel::Improved),
];

/// Spokes with a large interval; all other intervals are 1.
#[derive(Clone, Copy, Debug)]
pub struct Red {
    /// The valence.
    pub valence: usize,
    /// The spokes.
    pub spokes: &'static [usize],
    /// Their interval.
    pub interval: f64,
}

/// Guesses of the red edges in Figs. 9 to 11 of Li, Wei and Zhang (2019), where colours are lost.
pub const PAPER: [Red; 3] = [
    Red {
        valence: 5,
        spokes: &[0, 1, 3],
        interval: 10.0,
    },
    Red {
        valence: 6,
        spokes: &[0, 3],
        interval: 10.0,
    },
    Red {
        valence: 7,
        spokes: &[0, 1, 4],
        interval: 7.0,
    },
];

impl Red {
    /// The intervals.
    ///
    /// # Errors
    /// Those of [`Spokes::new`].
    pub fn spokes(&self) -> Result<Spokes, Error> {
        let interval = |i: usize| if self.spokes.contains(&i) { self.interval } else { 1.0 };
        Ok(Spokes::new(
            (0..self.valence).map(interval).collect(),
            vec![1.0; self.valence],
        )?)
    }
}

/// The scheme with knot intervals of a name.
///
/// # Errors
/// [`Error::Usage`] for another scheme.
pub fn with_intervals(name: &SchemeName) -> Result<Scheme, Error> {
    match name {
        SchemeName::NonUniform(scheme) => Ok(*scheme),
        _ => Err(Error::Usage {
            message: "a scheme without knot intervals has no such function".to_owned(),
            accepted: "nurss, eigen-polyhedron and hnuss[:simple|printed]".to_owned(),
        }),
    }
}

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
        table.push(measured(*scheme, spokes, blending));
    }
    Ok(table)
}

fn measured(scheme: Scheme, spokes: &Spokes, blending: &Blending) -> Vec<Cell> {
    let depth = blending.others(SHARE).next().map(|peak| peak.depth);
    vec![
        scheme.to_string().into(),
        spokes.valence().into(),
        blending.peaks[0].value.into(),
        blending.others(SHARE).count().into(),
        depth.map_or(Cell::Empty, Cell::from),
        blending.centre.into(),
    ]
}

/// The columns of a table over several sets of intervals.
pub fn columns() -> [&'static str; 8] {
    [
        "scheme", "valence", "highest", "others", "depth", "centre", "knots", "next",
    ]
}

/// Its row for a function.
pub fn row(scheme: Scheme, spokes: &Spokes, blending: &Blending) -> Vec<Cell> {
    let list = |list: &[f64]| list.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let mut row = measured(scheme, spokes, blending);
    row.extend([list(spokes.intervals()).into(), list(spokes.next()).into()]);
    row
}
