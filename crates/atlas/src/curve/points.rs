//! Control points from CSV: a point a line, its coordinates in columns, with or without names above them.
//!
//! Lines that are blank or start with `#` are skipped. A first line without any number is a header.

use crate::error::{Accepted, Error};

/// The points in a text: at least one coordinate each, all as many, all finite. How many points are needed is
/// for the curve to say.
///
/// # Errors
/// [`Error::Content`] with line and column, counted from 1.
pub fn parse(text: &str) -> Result<Vec<Vec<f64>>, Error> {
    // spreadsheets start their files with a byte order mark
    let text = text.trim_start_matches('\u{feff}');
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    let rows = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let mut columns = None;
    let mut points = Vec::new();
    for (line, row) in rows {
        // numbers and names need no quotes, but may have them
        let entries: Vec<&str> = row
            .split(',')
            .map(|entry| entry.trim().trim_matches('"').trim())
            .collect();
        let is_first = columns.is_none();
        let (first, expected) = *columns.get_or_insert((line, entries.len()));
        if entries.len() != expected {
            return Err(Error::refused(
                format!("line {line} has {} columns, line {first} has {expected}", entries.len()),
                Accepted::Are("lines of equal length".to_owned()),
            ));
        }
        if is_first && entries.iter().all(|entry| entry.parse::<f64>().is_err()) {
            continue;
        }
        let number = |(column, entry): (usize, &&str)| match entry.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(Error::refused(
                format!("line {line}, column {}: '{entry}'", column + 1),
                Accepted::Are("finite numbers".to_owned()),
            )),
        };
        points.push(
            entries
                .iter()
                .enumerate()
                .map(number)
                .collect::<Result<Vec<f64>, Error>>()?,
        );
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_comments_and_blank_lines() {
        let expected = vec![vec![1.0, -2.5], vec![3e2, 0.0]];
        for text in [
            "1,-2.5\n3e2,0\n",
            "\"x\",\"y\"\n\"1\",-2.5\n3e2,0",
            "\u{feff}x, y\r\n\r\n 1 , -2.5\r\n# a remark, of three, parts\r\n3e2,0\r\n",
        ] {
            assert_eq!(parse(text).unwrap(), expected, "{text:?}");
        }
        assert_eq!(parse("height\n1\n2\n").unwrap().len(), 2);
        assert!(parse("").unwrap().is_empty());
    }

    #[test]
    fn bad_lines_are_named() {
        for (text, part) in [
            ("x,y\n1,2\n3,four\n", "line 3, column 2: 'four'"),
            ("1,2\n\n3,nan\n", "line 3, column 2: 'nan'"),
            ("1,2\n-inf,1\n", "line 2, column 1"),
            ("1,1e999\n", "line 1, column 2"),
            ("1,\n", "line 1, column 2: ''"),
            ("1,b\n", "line 1, column 2: 'b'"),
            ("1,2\n3\n", "line 2 has 1 columns, line 1 has 2"),
            ("x,y\n1,2,3\n", "line 2 has 3 columns, line 1 has 2"),
            ("x,y\nu,v\n", "line 2, column 1: 'u'"),
        ] {
            let message = parse(text).unwrap_err().to_string();
            assert!(
                message.contains(part) && message.contains("accepted"),
                "{text:?}: {message}"
            );
        }
    }
}
