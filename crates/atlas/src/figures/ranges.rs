//! What certificates say of the lambda-scheme's splines over lambda: intervals with the status of a
//! requirement, as `certificates/ranges.csv` of the results lists them.

use crate::certificates::TABULATED;
use crate::error::Error;
use eigenring_certify::Requirement;
use serde::Deserialize;

/// A line of `ranges.csv`, of which the witness is not shown.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Interval {
    pub valence: usize,
    pub range: String,
    pub require: String,
    pub from: f64,
    pub to: f64,
    pub status: String,
}

/// The intervals over all lambdas in a text of the form of `ranges.csv`; none without one.
pub fn stored(text: Option<&str>) -> Result<Vec<Interval>, Error> {
    let rows = csv::Reader::from_reader(text.unwrap_or_default().as_bytes()).into_deserialize();
    let rows: Result<Vec<Interval>, csv::Error> = rows.collect();
    let rows = rows.map_err(|error| Error::content(error.to_string()).in_file("certificates/ranges.csv".as_ref()))?;
    Ok(rows.into_iter().filter(|row| row.range == TABULATED).collect())
}

/// What is known of C1 and bounded curvature together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// Both are proven.
    Bounded,
    /// C1 is proven, bounded curvature refuted.
    Unbounded,
    /// Something is undecided, or C1 is refuted.
    Else,
}

/// The parts of the lambdas of one valence, by what is known there; none where nothing was examined.
pub fn known(intervals: &[Interval], valence: usize) -> Vec<([f64; 2], Known)> {
    let of = |requirement: Requirement| {
        let here = move |row: &&Interval| row.valence == valence && row.require == requirement.name();
        intervals.iter().filter(here).collect::<Vec<_>>()
    };
    let [c1, bounded] = [Requirement::C1, Requirement::Bounded].map(of);
    let mut ends: Vec<f64> = c1.iter().chain(&bounded).flat_map(|row| [row.from, row.to]).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let parts = ends.windows(2).filter_map(|ends| {
        let status = |rows: &[&Interval]| {
            let around = rows.iter().find(|row| row.from <= ends[0] && ends[1] <= row.to);
            around.map(|row| row.status.clone())
        };
        let known = match (status(&c1)?.as_str(), status(&bounded)?.as_str()) {
            ("proven", "proven") => Known::Bounded,
            ("proven", "refuted") => Known::Unbounded,
            _ => Known::Else,
        };
        Some(([ends[0], ends[1]], known))
    });
    parts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "valence,range,require,from,to,status,witness\n\
        3,recommended,c1,0.2,0.5,proven,\n\
        3,tabulated,c1,0.15,0.9,proven,\n\
        3,tabulated,bounded,0.15,0.35,refuted,\"s > 1, here\"\n\
        3,tabulated,bounded,0.35,0.36,undecided,\n\
        3,tabulated,bounded,0.36,0.8,proven,\n";

    #[test]
    fn only_the_ranges_over_all_lambdas_are_read() {
        let rows = stored(Some(TEXT)).unwrap();
        assert_eq!(rows.len(), 4);
        assert_eq!((rows[1].to, rows[1].status.as_str()), (0.35, "refuted"));
        let broken = stored(Some("valence,range\nx,tabulated\n"));
        assert!(matches!(broken, Err(Error::InFile { .. })));
        assert_eq!(stored(None).unwrap(), []);
    }

    #[test]
    fn both_requirements_decide_and_nothing_is_said_where_one_was_not_examined() {
        let parts = known(&stored(Some(TEXT)).unwrap(), 3);
        let expected = [
            ([0.15, 0.35], Known::Unbounded),
            ([0.35, 0.36], Known::Else),
            ([0.36, 0.8], Known::Bounded),
        ];
        assert_eq!(parts, expected);
        assert_eq!(known(&stored(Some(TEXT)).unwrap(), 4), []);
    }
}
