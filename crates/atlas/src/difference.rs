//! Comparing result files number by number.
//!
//! Two numbers agree if `|a - b| <= atol + rtol |a|`; words must be equal. What a computation cost
//! (evaluations) and what is rounding by nature (residuals of optimality conditions, slacks of active bounds)
//! may differ between platforms and is not compared.
//!
//! On one platform the same program gives the same bytes, so that files which agree to the tolerances but not
//! to the byte are stale, or from elsewhere. That is no failure; the report has a line that says how many
//! entries differ and by how much at most.

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
    /// How many others are not the same to the last digit, entries that are not compared among them.
    pub drifted: usize,
    /// The one of these that differs most, with its distance; those that are compared come first.
    pub farthest: Option<(f64, Difference)>,
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
        } else if expected_text != found_text {
            // equal doubles in other digits give 0/0 with zero tolerances
            let excess = if expected == found { 0.0 } else { excess };
            self.drift(place, (expected, expected_text), (found, found_text), excess);
        }
    }

    /// Notes an entry that is as good as the same. The farthest one is that of the largest distance in units
    /// of the tolerance.
    fn drift(&mut self, place: impl FnOnce() -> String, expected: (f64, &str), found: (f64, &str), excess: f64) {
        self.result.drifted += 1;
        let farthest = self
            .result
            .farthest
            .as_ref()
            .map_or(f64::NEG_INFINITY, |(_, other)| other.excess);
        if excess > farthest {
            let difference = Difference {
                place: place(),
                expected: expected.1.to_owned(),
                found: found.1.to_owned(),
                excess,
            };
            self.result.farthest = Some(((expected.0 - found.0).abs(), difference));
        }
    }

    /// Notes an entry that is not compared, if it differs: below all that are.
    fn uncompared(&mut self, place: impl FnOnce() -> String, expected: &str, found: &str) {
        if expected != found {
            let number = |text: &str| text.parse().unwrap_or(f64::NAN);
            self.drift(place, (number(expected), expected), (number(found), found), -1.0);
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
                for (key, a) in a {
                    let place = format!("{place}.{key}");
                    // the digest follows from the numbers and from each bit of them
                    match key == "digest" || NOT_COMPARED.contains(&key.as_str()) {
                        true => self.uncompared(|| place, &a.to_string(), &b[key].to_string()),
                        false => self.value(&place, a, &b[key]),
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
            let place = || format!("row {}, {name}", index + 1);
            if NOT_COMPARED.contains(&name) {
                comparer.uncompared(place, a, b);
                continue;
            }
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
/// files there must be one in both folders, and not an empty one. Whatever else differs, to the byte, is told
/// in a line of its own and does not count.
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
            let read = |folder: &Path| {
                let path = folder.join(path);
                files::size(&path)?;
                std::fs::read(&path).map_err(|source| Error::Read { path, source })
            };
            let mut text = format!("present    {name}\n");
            if read(anew)? != read(stored)? {
                text.push_str(&notice("the bytes differ"));
            }
            return Ok(Report { same: true, text });
        }
    };
    let (expected, found) = (files::read(&anew.join(path))?, files::read(&stored.join(path))?);
    let Comparison {
        compared,
        mut differences,
        drifted,
        farthest,
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
    match farthest {
        Some((
            distance,
            Difference {
                place, expected, found, ..
            },
        )) => {
            let by = if distance.is_finite() {
                format!(", by {distance:e}")
            } else {
                String::new()
            };
            let most = format!("most {place}: stored {found}, now {expected}{by}");
            text.push_str(&notice(&format!("differing within the tolerances: {drifted}, {most}")));
        }
        None if differences.is_empty() && expected != found => {
            text.push_str(&notice("the bytes differ, and no entry does"));
        }
        None => {}
    }
    Ok(Report {
        same: differences.is_empty(),
        text,
    })
}

/// A line below that of a file, about what does not count.
fn notice(text: &str) -> String {
    format!("notice     {text}\n")
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
    fn stale_numbers_within_the_tolerances_are_told() {
        let (anew, stored) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let report = |file: &str, now: &str, before: &str| {
            files::write(&anew.path().join(file), now.as_bytes()).unwrap();
            files::write(&stored.path().join(file), before.as_bytes()).unwrap();
            compare_files(anew.path(), stored.path(), file.as_ref(), (1e-9, 1e-6)).unwrap()
        };
        let now = "name,f3,kkt\na,0,1e-12\nb,2.0,1e-12\n";
        assert_eq!(report("x.csv", now, now).text.lines().count(), 1);
        for (before, expected) in [
            // a rounding error where the code gives zero, and less than the next line's
            (
                "name,f3,kkt\na,-1e-22,1e-12\nb,2.0,1e-12\n",
                "notice     differing within the tolerances: 1, most row 2, f3: stored -1e-22, now 0, by 1e-22",
            ),
            (
                "name,f3,kkt\na,-1e-22,3e-9\nb,2.0000001,1e-12\n",
                "notice     differing within the tolerances: 3, most row 3, f3: stored 2.0000001, now 2.0, by 9.99",
            ),
            (
                "name,f3,kkt\na,0,1e-11\nb,2.0,1e-12\n",
                "notice     differing within the tolerances: 1, most row 2, kkt: stored 1e-11, now 1e-12, by 9",
            ),
            (
                "name,f3,kkt\na,-0,1e-12\nb,2.0,1e-12\n",
                "most row 2, f3: stored -0, now 0, by 0e0",
            ),
            (
                "name,f3,kkt\r\na,0,1e-12\r\nb,2.0,1e-12\r\n",
                "notice     the bytes differ, and no entry does",
            ),
        ] {
            let Report { same, text } = report("x.csv", now, before);
            assert!(same && text.lines().count() == 2 && text.contains(expected), "{text}");
        }
        let json = |f3: &str| format!(r#"{{"f3":[{f3}],"digest":"{f3}"}}"#);
        let Report { same, text } = report("x.json", &json("0.0"), &json("-1e-22"));
        assert!(
            same && text.contains("tolerances: 2, ") && text.contains(".f3[0]: stored -1e-22, now 0.0"),
            "{text}"
        );
        // what differs by more is told as before, and the rest beside it
        let Report { same, text } = report("x.csv", now, "name,f3,kkt\na,-1e-22,1e-12\nb,2.1,1e-12\n");
        assert!(
            !same && text.contains("row 3, f3: stored 2.1") && text.contains("tolerances: 1, "),
            "{text}"
        );
        let pictures = report("x.png", "abc", "abd");
        assert!(
            pictures.same && pictures.text.contains("the bytes differ"),
            "{}",
            pictures.text
        );
        assert_eq!(report("x.png", "abc", "abc").text.lines().count(), 1);
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
