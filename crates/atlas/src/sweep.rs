//! Spectra of a scheme file along one of its parameters.

use crate::error::Error;
use crate::progress::{Progress, each};
use crate::schemes::SchemeName;
use crate::spectrum::Analysis;
use crate::table::{Cell, Table};
use eigenring_scheme::Number;
use eigenring_scheme::user::Reading;
use serde_json::{Map, Value};
use std::str::FromStr;

/// The most steps.
const MAX_STEPS: u32 = 10_000;

/// Values of a parameter from one end to the other, both included: `a=0..1:50`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The parameter.
    pub parameter: String,
    /// The first value and the last.
    pub ends: [Number; 2],
    /// How many steps lie between them.
    pub steps: u32,
}

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let refuse = || {
            format!(
                "'{text}' is no sweep: accepted is NAME=FIRST..LAST:STEPS with 1 to {MAX_STEPS} steps, such as a=0..1:50"
            )
        };
        let parts = || {
            let (parameter, rest) = text.split_once('=')?;
            let (range, steps) = rest.rsplit_once(':')?;
            let (first, last) = range.split_once("..")?;
            Some(Sweep {
                parameter: parameter.trim().to_owned(),
                ends: [first.trim().parse().ok()?, last.trim().parse().ok()?],
                steps: steps
                    .trim()
                    .parse()
                    .ok()
                    .filter(|steps| (1..=MAX_STEPS).contains(steps))?,
            })
        };
        parts().ok_or_else(refuse)
    }
}

impl Sweep {
    /// The values, exactly.
    pub fn values(&self) -> Vec<Number> {
        self.ends[0].steps_to(&self.ends[1], self.steps)
    }
}

/// The spectra along a sweep, each with its value. Progress is told of each.
///
/// # Errors
/// [`Error::Usage`] for a scheme that is no file; those of the file, of a value out of its range, of the
/// spectra.
pub fn spectra(
    scheme: &SchemeName,
    sweep: &Sweep,
    valence: usize,
    [rings, level]: [Option<usize>; 2],
    progress: &dyn Progress,
) -> Result<Vec<(Number, Analysis)>, Error> {
    let SchemeName::File(file) = scheme else {
        return Err(Error::Usage {
            message: "--sweep is for the parameters of a scheme file".to_owned(),
            accepted: "--scheme file:SCHEME.toml".to_owned(),
        });
    };
    let base = file.read(Reading::default())?;
    each(progress, "values", &sweep.values(), |value| {
        let set = base.with(&[(&sweep.parameter, value.clone())]);
        let spectrum = || {
            let set = set?;
            Analysis::of_rules(&set.scheme(valence)?, Some(&set.scheme(valence)?), rings, level)
        };
        let analysis = spectrum().map_err(|error| error.in_file(&file.path))?;
        Ok((value.clone(), analysis))
    })
}

/// A row for each value: subdominant and subsubdominant eigenvalue, and s.
pub fn table(sweep: &Sweep, spectra: &[(Number, Analysis)]) -> Table {
    const COLUMNS: [&str; 3] = ["subdominant", "subsubdominant", "s"];
    let mut table = Table::new([sweep.parameter.as_str()].into_iter().chain(COLUMNS));
    for (value, analysis) in spectra {
        let head = analysis.head().json();
        let number = |name: &str| -> Cell { head.get(name).and_then(Value::as_f64).into() };
        table.push(
            std::iter::once(value.value().into())
                .chain(COLUMNS.map(number))
                .collect(),
        );
    }
    table
}

/// Everything that is known at each value.
pub fn json(sweep: &Sweep, spectra: &[(Number, Analysis)]) -> Value {
    let row = |(value, analysis): &(Number, Analysis)| {
        let mut row = Map::new();
        row.insert("value".to_owned(), value.value().into());
        row.extend(analysis.json());
        Value::Object(row)
    };
    serde_json::json!({ "parameter": sweep.parameter, "rows": spectra.iter().map(row).collect::<Vec<_>>() })
}
