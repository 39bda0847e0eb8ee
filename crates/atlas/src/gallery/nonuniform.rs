//! Schemes with knot intervals: reflection lines on shapes like those of Figs. 12 to 14 of Li, Wei and Zhang
//! (2019), and what is counted over sets of intervals.

use super::{drawn, settings, table};
use crate::error::Error;
use crate::nonuniform::blending::{ALL, PAPER, columns, row};
use crate::nonuniform::{counts, picture};
use crate::progress::{Progress, each};
use crate::render::Show;
use crate::table::Table;
use eigenring_nonuniform::{Blending, FirstLevel, Outside, Scheme};
use eigenring_surface::{Mesh, shapes};

pub(super) fn files(progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
    Ok(vec![
        lines("fig14-ring", &shapes::ring(), [-12.0, 48.0, 1.0], 4.0)?,
        lines("fig14-helmet", &shapes::helmet(), [-50.0, 40.0, 1.0], 3.0)?,
        blending(progress)?,
        table("maxima", &counts::maxima(progress)?),
        table("thresholds", &counts::thresholds(progress)?),
        table("lemma-1", &counts::gaps(progress)?),
    ])
}

/// Reflection lines under the three schemes.
fn lines(name: &str, mesh: &Mesh, view: [f64; 3], stripes: f64) -> Result<(String, Vec<u8>), Error> {
    let mut settings = settings(Show::Reflection, view, 320, 3);
    settings.stripes = stripes;
    let schemes = [
        ("NURSS", Scheme::Nurss),
        ("eigen-polyhedron", Scheme::EigenPolyhedron),
        ("HNUSS", Scheme::Hnuss(FirstLevel::Improved)),
    ];
    let subject = |(caption, scheme): (&str, Scheme)| {
        let (subject, _) = picture::subject(mesh, scheme, Outside::Error, settings.size, settings.show)?;
        Ok((caption.to_owned(), subject))
    };
    let subjects = schemes.into_iter().map(subject).collect::<Result<Vec<_>, Error>>()?;
    drawn(name, &subjects, &settings)
}

/// Levels of the nets at whose vertices functions are taken.
const LEVELS: usize = 6;

/// Highest values and maxima for the guesses of Figs. 9 to 11.
fn blending(progress: &dyn Progress) -> Result<(String, Vec<u8>), Error> {
    let mut all = Table::new(columns());
    let sets = PAPER
        .iter()
        .map(|red| red.spokes())
        .collect::<Result<Vec<_>, Error>>()?;
    let cases: Vec<_> = sets
        .iter()
        .flat_map(|spokes| ALL.map(|scheme| (spokes, scheme)))
        .collect();
    let found = each(progress, "blending functions", &cases, |(spokes, scheme)| {
        Blending::new(*scheme, spokes, LEVELS).map_err(Error::from)
    })?;
    for ((spokes, scheme), blending) in cases.iter().zip(&found) {
        all.push(row(*scheme, spokes, blending));
    }
    Ok(table("blending", &all))
}
