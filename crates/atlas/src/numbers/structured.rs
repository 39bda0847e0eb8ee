//! Matrix Market and JSON.

use super::{Numbers, number};
use crate::error::{Accepted, Error};
use serde_json::Value;

/// A dense matrix beyond this many entries (800 MB) is a typing error.
const MAX_ENTRIES: usize = 100_000_000;

fn refuse<T>(message: String, accepted: &str) -> Result<T, Error> {
    Err(Error::refused(message, Accepted::Are(accepted.to_owned())))
}

/// The next number, if it is a count.
fn whole(values: &mut impl Iterator<Item = f64>) -> Option<usize> {
    let value = values.next()?;
    (value >= 0.0 && value.fract() == 0.0).then_some(value as usize)
}

/// Matrix Market's coordinate and array formats of real numbers and integers, general and symmetric.
///
/// # Errors
/// [`Error::Content`] with the entry that is wrong.
pub fn matrix_market(text: &str) -> Result<Numbers, Error> {
    let mut lines = text.lines();
    let banner = lines.next().unwrap_or_default().to_lowercase();
    let words: Vec<&str> = banner.split_whitespace().collect();
    let &[
        _,
        "matrix",
        form @ ("coordinate" | "array"),
        "real" | "integer" | "double",
        shape @ ("general" | "symmetric" | "skew-symmetric"),
    ] = words.as_slice()
    else {
        return refuse(
            format!("Matrix Market: '{banner}'"),
            "coordinate and array, real and integer, general and symmetric",
        );
    };
    let numbers = lines
        .filter(|line| !line.trim_start().starts_with('%'))
        .flat_map(str::split_whitespace);
    let mut values = Vec::new();
    for (index, word) in numbers.enumerate() {
        match number(word) {
            Some(value) => values.push(value),
            None => {
                return refuse(
                    format!("Matrix Market: number {} is '{word}'", index + 1),
                    "finite numbers",
                );
            }
        }
    }
    let mut values = values.into_iter();
    let (rows, columns) = (whole(&mut values).unwrap_or(0), whole(&mut values).unwrap_or(0));
    if rows.saturating_mul(columns) > MAX_ENTRIES {
        return refuse(format!("Matrix Market: {rows} x {columns}"), "at most 10^8 entries");
    }
    let mut matrix = vec![vec![0.0; columns]; rows];
    let mut set = |row: usize, column: usize, value: f64| -> Result<(), Error> {
        if !(1..=rows).contains(&row) || !(1..=columns).contains(&column) {
            return refuse(
                format!("Matrix Market: entry ({row}, {column}) of {rows} x {columns}"),
                "indices from 1 to the size",
            );
        }
        matrix[row - 1][column - 1] = value;
        if shape != "general" && row != column && row <= columns && column <= rows {
            matrix[column - 1][row - 1] = if shape == "symmetric" { value } else { -value };
        }
        Ok(())
    };
    let short = "as many entries as the size says";
    if form == "coordinate" {
        let count = whole(&mut values).unwrap_or(0);
        for index in 0..count {
            let (Some(row), Some(column)) = (whole(&mut values), whole(&mut values)) else {
                return refuse(format!("Matrix Market: {index} of {count} entries"), short);
            };
            let Some(value) = values.next() else {
                return refuse(format!("Matrix Market: {index} of {count} entries"), short);
            };
            set(row, column, value)?;
        }
    } else {
        for column in 1..=columns {
            let first = if shape == "general" { 1 } else { column };
            for row in first..=rows {
                let Some(value) = values.next() else {
                    return refuse(format!("Matrix Market: entry ({row}, {column}) is missing"), short);
                };
                set(row, column, value)?;
            }
        }
    }
    Ok(Numbers {
        names: None,
        rows: matrix,
    })
}

/// Rows of numbers, a list of objects with numbers, or an object that has one of them as `rows` or `points`.
///
/// # Errors
/// [`Error::Content`] with the place.
pub fn json(value: &Value) -> Result<Numbers, Error> {
    const ACCEPTED: &str =
        "lists of numbers of equal length, objects with numbers, and objects with 'rows' or 'points'";
    let list = match value {
        Value::Object(object) => object.get("rows").or_else(|| object.get("points")),
        list => Some(list),
    };
    let Some(Value::Array(list)) = list else {
        return refuse("the JSON value has no rows".to_owned(), ACCEPTED);
    };
    let mut names: Option<Vec<String>> = None;
    let mut rows = Vec::new();
    for (index, row) in list.iter().enumerate() {
        let entries: Vec<&Value> = match row {
            Value::Array(entries) => entries.iter().collect(),
            Value::Object(object) => {
                let keys: Vec<String> = object.keys().cloned().collect();
                if *names.get_or_insert_with(|| keys.clone()) != keys {
                    return refuse(format!("JSON: row {} has other keys than row 1", index + 1), ACCEPTED);
                }
                object.values().collect()
            }
            entry => vec![entry],
        };
        let finite = |entry: &Value| entry.as_f64().filter(|number| number.is_finite());
        let numbers: Option<Vec<f64>> = entries.into_iter().map(finite).collect();
        match numbers {
            Some(numbers) if rows.first().is_none_or(|first: &Vec<f64>| first.len() == numbers.len()) => {
                rows.push(numbers)
            }
            _ => return refuse(format!("JSON: row {}", index + 1), ACCEPTED),
        }
    }
    Ok(Numbers { names, rows })
}
