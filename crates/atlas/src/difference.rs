//! Comparing result files number by number.
//!
//! Two numbers agree if `|a - b| <= atol + rtol |a|`; words must be equal. What a computation cost
//! (evaluations) and what is rounding by nature (residuals of optimality conditions, slacks of active bounds)
//! may differ between platforms and is not compared.

use crate::error::Error;
use crate::files;
use serde_json::Value;
use std::path::Path;

/// Columns and fields that are not compared.
const NOT_COMPARED: [&str; 12] = [
    "evaluations",
    "gradient_evaluations",
    "kkt_residual",
    "kkt",
    "f2_kkt",
    "f3_kkt",
    "multipliers",
    "slack",
    "slack_at",
    "active_bounds",
    "f2_active_bounds",
    "f3_active_bounds",
];

/// What was found.
#[derive(Debug, Default)]
pub struct Comparison {
    /// Entries that were compared.
    pub compared: usize,
    /// Those that differ.
    pub differences: Vec<Difference>,
}

/// An entry that differs.
#[derive(Debug)]
pub struct Difference {
    /// Row and column, or the path in JSON.
    pub place: String,
    /// What it should be.
    pub expected: String,
    /// What it is.
    pub found: String,
    /// The distance in units of the tolerance; infinite for words.
    pub excess: f64,
}

struct Comparer {
    atol: f64,
    rtol: f64,
    result: Comparison,
}

impl Comparer {
    /// Compares numbers; a difference is shown as it is written in the files.
    fn number(&mut self, place: impl FnOnce() -> String, expected: (f64, &str), found: (f64, &str)) {
        let ((expected, expected_text), (found, found_text)) = (expected, found);
        self.result.compared += 1;
        let excess = (expected - found).abs() / (self.atol + self.rtol * expected.abs());
        // a NaN agrees with nothing; with zero tolerances equal numbers give 0/0
        if !(excess <= 1.0) && expected != found {
            self.differ(place(), expected_text.to_owned(), found_text.to_owned(), excess);
        }
    }

    fn word(&mut self, place: impl FnOnce() -> String, expected: &str, found: &str) {
        self.result.compared += 1;
        if expected != found {
            self.differ(place(), expected.to_owned(), found.to_owned(), f64::INFINITY);
        }
    }

    fn differ(&mut self, place: String, expected: String, found: String, excess: f64) {
        self.result.differences.push(Difference {
            place,
            expected,
            found,
            excess,
        });
    }

    fn value(&mut self, place: &str, expected: &Value, found: &Value) {
        match (expected, found) {
            (Value::Number(a), Value::Number(b)) => {
                let double = |n: &serde_json::Number| n.as_f64().unwrap_or(f64::NAN);
                self.number(
                    || place.to_owned(),
                    (double(a), &a.to_string()),
                    (double(b), &b.to_string()),
                );
            }
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
                for (index, (a, b)) in a.iter().zip(b).enumerate() {
                    self.value(&format!("{place}[{index}]"), a, b);
                }
            }
            (Value::Object(a), Value::Object(b)) if a.len() == b.len() && a.keys().all(|key| b.contains_key(key)) => {
                for (key, a) in a.iter().filter(|(key, _)| !NOT_COMPARED.contains(&key.as_str())) {
                    // the digest follows from the numbers and from each bit of them
                    if key != "digest" {
                        self.value(&format!("{place}.{key}"), a, &b[key]);
                    }
                }
            }
            _ => self.word(|| place.to_owned(), &expected.to_string(), &found.to_string()),
        }
    }
}

/// Compares CSV texts with headers; places are the first column's entry and the column's name.
pub fn compare_csv(expected: &str, found: &str, atol: f64, rtol: f64) -> Comparison {
    let mut comparer = Comparer {
        atol,
        rtol,
        result: Comparison::default(),
    };
    let records = |text: &str| -> Vec<Vec<String>> {
        csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .from_reader(text.as_bytes())
            .into_records()
            .map(|record| record.map_or(Vec::new(), |record| record.iter().map(str::to_owned).collect()))
            .collect()
    };
    let (expected, found) = (records(expected), records(found));
    comparer.word(
        || "rows".to_owned(),
        &expected.len().to_string(),
        &found.len().to_string(),
    );
    let header = expected.first().cloned().unwrap_or_default();
    for (index, (a, b)) in expected.iter().zip(&found).enumerate() {
        comparer.word(
            || format!("columns of row {}", index + 1),
            &a.len().to_string(),
            &b.len().to_string(),
        );
        for (column, (a, b)) in a.iter().zip(b).enumerate() {
            let name = header.get(column).map_or("", String::as_str);
            if NOT_COMPARED.contains(&name) {
                continue;
            }
            let place = || format!("row {}, {name}", index + 1);
            match (a.parse::<f64>(), b.parse::<f64>()) {
                (Ok(x), Ok(y)) => comparer.number(place, (x, a.as_str()), (y, b.as_str())),
                _ => comparer.word(place, a, b),
            }
        }
    }
    comparer.result
}

/// Compares JSON texts.
pub fn compare_json(expected: &str, found: &str, atol: f64, rtol: f64) -> Comparison {
    let mut comparer = Comparer {
        atol,
        rtol,
        result: Comparison::default(),
    };
    let parse = |text: &str| serde_json::from_str(text).unwrap_or(Value::Null);
    comparer.value("", &parse(expected), &parse(found));
    comparer.result
}

/// What comparing one file or more has shown, for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Whether all numbers agree.
    pub same: bool,
    /// A line a file, with the worst differences below it.
    pub text: String,
}

/// How many of the worst entries are listed for each file.
const SHOWN: usize = 10;

/// Compares one file that was made anew with the one that is stored: CSV and JSON number by number. Of other
/// files there must be one in both folders, and not an empty one.
///
/// # Errors
/// [`Error::Read`] and [`Error::InFile`] for files that are missing or empty.
pub fn compare_files(anew: &Path, stored: &Path, path: &Path, (atol, rtol): (f64, f64)) -> Result<Report, Error> {
    let name = path.to_string_lossy();
    let numbers = match path.extension().and_then(|extension| extension.to_str()) {
        Some("csv") => compare_csv,
        Some("json") => compare_json,
        // a picture or a page: there must be one
        _ => {
            files::size(&anew.join(path))?;
            files::size(&stored.join(path))?;
            return Ok(Report {
                same: true,
                text: format!("present    {name}\n"),
            });
        }
    };
    let (expected, found) = (files::read(&anew.join(path))?, files::read(&stored.join(path))?);
    let Comparison {
        compared,
        mut differences,
    } = numbers(&expected, &found, atol, rtol);
    let verdict = if differences.is_empty() { "same" } else { "DIFFERENT" };
    let mut text = format!(
        "{verdict:9}  {name}: {compared} entries compared, {} differ\n",
        differences.len()
    );
    differences.sort_by(|a, b| b.excess.total_cmp(&a.excess));
    for difference in differences.iter().take(SHOWN) {
        text.push_str(&format!(
            "           {}: stored {}, now {}\n",
            difference.place, difference.found, difference.expected
        ));
    }
    Ok(Report {
        same: differences.is_empty(),
        text,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_differences_pass_and_large_ones_are_placed() {
        let expected = "name,x,kkt\na,1.0,1e-12\nb,2.0,1e-12\n";
        assert!(compare_csv(expected, expected, 0.0, 0.0).differences.is_empty());
        let close = "name,x,kkt\na,1.0000000001,5e-9\nb,2.0,1e-12\n";
        assert!(compare_csv(expected, close, 1e-9, 0.0).differences.is_empty());
        let far = "name,x,kkt\na,1.0,1e-12\nc,2.1,1e-12\n";
        let differences = compare_csv(expected, far, 1e-9, 1e-6).differences;
        assert_eq!(differences.len(), 2);
        assert_eq!(differences[1].place, "row 3, x");
        assert_eq!(compare_csv(expected, "name,x,kkt\n", 1.0, 0.0).differences.len(), 1);
    }

    #[test]
    fn json_is_compared_by_structure() {
        let expected = r#"{"a":[1.0,{"b":"w"}],"kkt":1}"#;
        assert!(
            compare_json(expected, r#"{"a":[1.0,{"b":"w"}],"kkt":2}"#, 0.0, 0.0)
                .differences
                .is_empty()
        );
        for bad in [
            r#"{"a":[1.0],"kkt":1}"#,
            r#"{"a":[1.1,{"b":"w"}],"kkt":1}"#,
            "not json",
            r#"{"a":[null,{"b":"w"}],"kkt":1}"#,
        ] {
            assert!(!compare_json(expected, bad, 1e-9, 1e-9).differences.is_empty(), "{bad}");
        }
    }
}
