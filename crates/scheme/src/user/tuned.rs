//! A scheme file with other values of its parameters at single valences, its text kept otherwise.

use super::{UserScheme, file_error};
use crate::{Error, Number};
use std::collections::BTreeMap;
use toml_edit::{DocumentMut, InlineTable, TableLike, Value};

impl UserScheme {
    /// The text of the file, named `name`, with these values of parameters at single valences: by parameter,
    /// the valence and a number in text. Comments and the order of the file are kept.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an unknown parameter or a value out of its range, [`Error::Number`] for what
    /// is no number.
    pub fn tuned(&self, name: &str, values: &BTreeMap<String, BTreeMap<usize, String>>) -> Result<String, Error> {
        let mut document = self
            .contents
            .text
            .whole()
            .parse::<DocumentMut>()
            .map_err(|error| file_error(error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")))?;
        if let Some(old) = document.get_mut("name").and_then(|item| item.as_value_mut()) {
            let decor = old.decor().clone();
            *old = Value::from(name);
            *old.decor_mut() = decor;
        }
        for (parameter, values) in values {
            let known = &self.contents.parameters[self.index(parameter)?];
            for value in values.values() {
                known
                    .check(value.parse::<Number>()?)
                    .map_err(|message| Error::Parameter {
                        scheme: self.name.clone(),
                        message,
                    })?;
            }
            let tables = document.get_mut("parameters").and_then(|item| item.as_table_like_mut());
            let table = tables.and_then(|tables| tables.get_mut(parameter)?.as_table_like_mut());
            // the reader has found them there
            if let Some(table) = table {
                except(table, values);
            }
        }
        Ok(document.to_string())
    }
}

/// Adds values at single valences to the table of a parameter, by rising valence.
fn except(table: &mut dyn TableLike, values: &BTreeMap<usize, String>) {
    let known = table.get("except").and_then(|item| item.as_table_like());
    let mut all: BTreeMap<usize, Value> = BTreeMap::new();
    for (valence, value) in known.into_iter().flat_map(TableLike::iter) {
        if let (Ok(valence), Some(value)) = (valence.parse(), value.as_value()) {
            all.insert(valence, value.clone());
        }
    }
    all.extend(
        values
            .iter()
            .map(|(valence, value)| (*valence, Value::from(value.as_str()))),
    );
    let mut written = InlineTable::new();
    for (valence, value) in all {
        written.insert(valence.to_string(), value.decorated(" ", ""));
    }
    written.fmt();
    table.insert("except", toml_edit::value(written));
}

#[cfg(test)]
mod tests {
    use crate::user::{Reading, UserScheme};
    use std::collections::BTreeMap;

    const FILE: &str = r#"# a comment that stays
name = "mine"   # another
kind = "one-ring"

[parameters]    # of the vertex rule
a = { default = "3/2", range = ["0", "3"], except = { 7 = 1.25 }, doc = "edges" }

[parameters.b]
default = "1/4"
doc = "faces"

[rule]
n = "3.."
f1 = "1/4"
f2 = "1/4"
f3 = "1/4"
d1 = "3/8"
d2 = "3/8"
e1 = "1/16"
e2 = "1/16"
alpha = "a/n"
beta = "b/n"
"#;

    fn read(text: &str) -> UserScheme {
        UserScheme::parse(text, "x", Reading::Balanced).unwrap()
    }

    fn values(parameter: &str, pairs: &[(usize, &str)]) -> BTreeMap<String, BTreeMap<usize, String>> {
        let pairs = pairs.iter().map(|(n, value)| (*n, (*value).to_owned())).collect();
        BTreeMap::from([(parameter.to_owned(), pairs)])
    }

    /// The weight of the centre at a valence.
    fn centre(scheme: &UserScheme, valence: usize) -> f64 {
        let scheme = scheme.scheme::<f64>(valence).unwrap();
        let site = crate::Site::new(scheme.fan(), 0, 0, 0).unwrap();
        let stencil = scheme.limit().stencil(0, site).unwrap();
        stencil.terms().iter().find(|(at, _)| *at == site).unwrap().1
    }

    #[test]
    fn values_at_single_valences_are_read_and_overridden() {
        let scheme = read(FILE);
        for (valence, expected) in [(5, 1.0 - 1.75 / 5.0), (7, 1.0 - 1.5 / 7.0), (8, 1.0 - 1.75 / 8.0)] {
            assert!((centre(&scheme, valence) - expected).abs() < 1e-15, "{valence}");
        }
        assert_eq!(scheme.name(), "mine");
        // what is set holds everywhere, even if it is the default
        let set = scheme.with(&[("a", "3/2".parse().unwrap())]).unwrap();
        assert_eq!(set.name(), "mine,a=3/2");
        assert!((centre(&set, 7) - (1.0 - 1.75 / 7.0)).abs() < 1e-15);
        let set = scheme.with(&[("b", "1/4".parse().unwrap())]).unwrap();
        assert_eq!(set.name(), "mine");
    }

    #[test]
    fn numbers_are_filled_in_and_the_rest_is_kept() {
        let text = read(FILE)
            .tuned("found", &values("a", &[(5, "1.2"), (6, "0.5")]))
            .unwrap();
        let expected = FILE
            .replace("\"mine\"", "\"found\"")
            .replace("{ 7 = 1.25 }", "{ 5 = \"1.2\", 6 = \"0.5\", 7 = 1.25 }");
        assert_eq!(text, expected);
        assert!((centre(&read(&text), 5) - (1.0 - 1.45 / 5.0)).abs() < 1e-15);
        // a parameter with a table of its own
        let text = read(FILE).tuned("found", &values("b", &[(9, "0.125")])).unwrap();
        assert!((centre(&read(&text), 9) - (1.0 - 1.625 / 9.0)).abs() < 1e-15, "{text}");
        assert!(text.contains("doc = \"faces\"\nexcept = { 9 = \"0.125\" }\n"), "{text}");
        // what the file would refuse is not written
        for (parameter, value, needle) in [("a", "4", "out of range"), ("c", "1", "unknown"), ("a", "x", "number")] {
            let error = read(FILE)
                .tuned("found", &values(parameter, &[(5, value)]))
                .unwrap_err();
            assert!(error.to_string().contains(needle), "{error}");
        }
    }

    #[test]
    fn bad_exceptions_are_refused() {
        for (exceptions, needle) in [
            ("{ 2 = 1 }", "valence \"2\""),
            ("{ five = 1 }", "valence \"five\""),
            ("{ 5 = \"n\" }", "except"),
            ("{ 5 = 4 }", "a = 4 is out of range"),
            ("3", "accepted is a table of valences"),
        ] {
            let text = FILE.replace("{ 7 = 1.25 }", exceptions);
            let error = UserScheme::parse(&text, "x", Reading::Balanced)
                .unwrap_err()
                .to_string();
            assert!(
                error.contains(needle) && error.contains("line 6"),
                "{exceptions}: {error}"
            );
        }
    }
}
