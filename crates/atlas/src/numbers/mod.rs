//! Tables of numbers as people and programs write them, for every command that reads one.
//!
//! What a file is shows in its content, not in its name: NumPy's format, Matrix Market, JSON (rows of
//! numbers, or what this program prints), and text. In text columns are separated by commas, semicolons,
//! tabs or blanks; rows of a matrix in brackets `[1 2; 3 4]` by semicolons. `#` and `%` begin comments, a
//! first line without any number is a header, numbers may be fractions (`1/16`) and have the exponents of
//! Fortran (`1.0D-02`).

mod npy;
mod structured;

use crate::error::{Accepted, Error};

/// Rows of finite numbers, all of one length.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// The names of the columns, if there are any.
    pub names: Option<Vec<String>>,
    /// The rows.
    pub rows: Vec<Vec<f64>>,
}

/// What a row is called in messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Called {
    /// Rows of a matrix, counted without comments and headers.
    Row,
    /// Lines of the file.
    Line,
}

/// A row of text with its place.
struct Row {
    /// Counted as [`Called`] says, from 1.
    place: usize,
    entries: Vec<String>,
}

/// Reads a table.
///
/// # Errors
/// [`Error::Content`] with row or line and column, counted from 1.
pub fn read(bytes: &[u8], called: Called) -> Result<Numbers, Error> {
    if bytes.starts_with(npy::MAGIC) {
        return npy::read(bytes);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Error::refused(
            "it is no text",
            Accepted::Are("text, NumPy, Matrix Market and JSON files".to_owned()),
        )
    })?;
    // spreadsheets start their files with a byte order mark
    let text = text.trim_start_matches('\u{feff}');
    if text.starts_with("%%MatrixMarket") {
        return structured::matrix_market(text);
    }
    if text.trim_start().starts_with(['{', '['])
        && let Ok(value) = serde_json::from_str(text)
    {
        return structured::json(&value);
    }
    read_text(text, called)
}

/// A number as it may be written.
fn number(entry: &str) -> Option<f64> {
    let plain = |text: &str| text.trim().replace(['d', 'D'], "e").parse::<f64>().ok();
    let value = match entry.split_once('/') {
        Some((above, below)) => plain(above)? / plain(below)?,
        None => plain(entry)?,
    };
    value.is_finite().then_some(value)
}

/// Text without comments and brackets, in lines with their numbers.
fn lines(text: &str) -> (Vec<(usize, String)>, bool) {
    let mut found = Vec::new();
    let mut bracketed = false;
    for (index, line) in text.split('\n').flat_map(|line| line.split('\r')).enumerate() {
        // an \r\n gives an empty piece, which is no line of its own
        let line = line.split(['#', '%']).next().unwrap_or_default().trim();
        bracketed |= line.contains('[');
        found.push((index + 1, line.to_owned()));
    }
    (found, bracketed)
}

fn read_text(text: &str, called: Called) -> Result<Numbers, Error> {
    let text = text.replace("\r\n", "\n");
    let (lines, bracketed) = lines(&text);
    let mut pieces: Vec<(usize, String)> = Vec::new();
    for (line, content) in lines {
        let parts: Vec<String> = match bracketed {
            // a name before the bracket, as in `S = [`, is left out
            true => content
                .rsplit_once('=')
                .map_or(content.as_str(), |(_, rest)| rest)
                .split(['[', ']', ';'])
                .map(|part| part.trim().to_owned())
                .collect(),
            false => vec![content],
        };
        pieces.extend(
            parts
                .into_iter()
                .filter(|part| !part.is_empty())
                .map(|part| (line, part)),
        );
    }
    let has = |separator: char| pieces.iter().any(|(_, piece)| piece.contains(separator));
    let separator = [';', ',', '\t'].into_iter().find(|&separator| has(separator));
    let split = |piece: &str| -> Vec<String> {
        let parts: Vec<&str> = match separator {
            Some(separator) => piece.split(separator).collect(),
            None => piece.split_whitespace().collect(),
        };
        parts.into_iter().map(|part| unquoted(part.trim()).to_owned()).collect()
    };
    let mut rows: Vec<Row> = pieces
        .iter()
        .map(|(line, piece)| Row {
            place: *line,
            entries: split(piece),
        })
        .collect();
    drop_trailing(&mut rows);
    let names = header(&mut rows, called);
    if called == Called::Row {
        rows.iter_mut()
            .enumerate()
            .for_each(|(index, row)| row.place = index + 1);
    }
    check(&rows, names.as_ref(), called).map(|rows| Numbers { names, rows })
}

/// An entry without the quotes around it.
fn unquoted(entry: &str) -> &str {
    let inner = entry.strip_prefix('"').and_then(|entry| entry.strip_suffix('"'));
    inner.map_or(entry, str::trim)
}

/// Separators at the end of every row separate nothing.
fn drop_trailing(rows: &mut [Row]) {
    let empty = |row: &Row| row.entries.len() > 1 && row.entries.last().is_some_and(String::is_empty);
    if rows.len() > 1 && rows.iter().all(empty) {
        for row in rows {
            row.entries.pop();
        }
    }
}

/// Takes off a first row without any number. Before a second such row it is none: in a matrix the first one
/// is wrong then, in lines of points the second.
fn header(rows: &mut Vec<Row>, called: Called) -> Option<Vec<String>> {
    let words = |row: &Row| row.entries.iter().all(|entry| number(entry).is_none());
    let first = rows.first().filter(|row| words(row))?;
    // NaN and the like are wrong numbers, and no names
    if first.entries.iter().any(|entry| entry.parse::<f64>().is_ok()) {
        return None;
    }
    if called == Called::Row && rows.get(1).is_none_or(words) {
        return None;
    }
    Some(rows.remove(0).entries)
}

fn check(rows: &[Row], names: Option<&Vec<String>>, called: Called) -> Result<Vec<Vec<f64>>, Error> {
    let (word, many) = match called {
        Called::Row => ("row", "entries"),
        Called::Line => ("line", "columns"),
    };
    // the first row, or the names above it, say how long rows are
    let first = match (names, rows.first()) {
        (Some(names), _) if called == Called::Line => (1, names.len()),
        (_, Some(row)) => (row.place, row.entries.len()),
        (_, None) => return Ok(Vec::new()),
    };
    let mut found = Vec::new();
    for row in rows {
        if row.entries.len() != first.1 {
            return Err(Error::refused(
                format!(
                    "{word} {} has {} {many}, {word} {} has {}",
                    row.place,
                    row.entries.len(),
                    first.0,
                    first.1
                ),
                Accepted::Are(format!("{word}s of equal length")),
            ));
        }
        let read = |(column, entry): (usize, &String)| {
            number(entry).ok_or_else(|| {
                let column = column + 1;
                let (message, accepted) = match called {
                    Called::Row => (
                        format!("row {}, column {column}: '{entry}' is no number", row.place),
                        "finite ones",
                    ),
                    Called::Line => (
                        format!("line {}, column {column}: '{entry}'", row.place),
                        "finite numbers",
                    ),
                };
                Error::refused(message, Accepted::Are(accepted.to_owned()))
            })
        };
        found.push(row.entries.iter().enumerate().map(read).collect::<Result<_, Error>>()?);
    }
    Ok(found)
}

impl Numbers {
    /// The columns of these names alone, if all are there.
    pub fn columns(&self, wanted: &[&str]) -> Option<Vec<Vec<f64>>> {
        let names = self.names.as_ref()?;
        let index = |name: &&str| names.iter().position(|known| known.eq_ignore_ascii_case(name));
        let indices: Vec<usize> = wanted.iter().map(index).collect::<Option<_>>()?;
        let pick = |row: &Vec<f64>| indices.iter().map(|&index| row[index]).collect();
        Some(self.rows.iter().map(pick).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<Vec<f64>> {
        read(text.as_bytes(), Called::Row)
            .unwrap_or_else(|error| panic!("{text:?}: {error}"))
            .rows
    }

    #[test]
    fn every_way_to_write_the_same_table() {
        let expected = vec![vec![0.01, -2.5], vec![0.0625, 300.0]];
        for text in [
            "0.01,-2.5\n0.0625,3e2\n",
            "0.01;-2.5\n0.0625;300",
            "0.01 -2.5\n  0.0625   300  \n",
            "0.01\t-2.5\n0.0625\t300\n",
            "0.01,-2.5,\n0.0625,300,\n",
            "# a remark, of three, parts\n0.01 -2.5 % and another\n\n1/16 300\n",
            "% MATLAB\nS = [0.01 -2.5; 1/16 300];\n",
            "[0.01, -2.5;\n 0.0625, 300]\n",
            "[[0.01, -2.5],\n [0.0625, 300]]\n",
            "1.0D-02,-2.5d0\n6.25D-02,+3.0D+02\n",
            "\u{feff}\"a\", b\r\n\"0.01\" , -2.5\r\n0.0625,300\r\n",
            "a b\n0.01 -2.5\n0.0625 300\n",
            "0.01,-2.5\r0.0625,300\r",
            "%%MatrixMarket matrix coordinate real general\n% remark\n2 2 4\n1 1 0.01\n1 2 -2.5\n2 1 0.0625\n2 2 300\n",
            "%%MatrixMarket matrix array real general\n2 2\n0.01\n0.0625\n-2.5\n300\n",
            "{\"scheme\": \"mine\", \"rows\": [[0.01, -2.5], [0.0625, 300]]}",
            "[{\"a\": 0.01, \"b\": -2.5}, {\"a\": 0.0625, \"b\": 300}]",
        ] {
            assert_eq!(rows(text), expected, "{text:?}");
        }
        assert!(rows("").is_empty());
    }

    #[test]
    fn mistakes_are_named_with_their_place() {
        for (text, called, part) in [
            ("1,2\n3\n", Called::Row, "row 2 has 1 entries, row 1 has 2"),
            ("# a\n1,2\n\n3,x\n", Called::Row, "row 2, column 2: 'x' is no number"),
            ("# a\n1,2\n\n3,x\n", Called::Line, "line 4, column 2: 'x'"),
            ("1,2\n3,nan\n", Called::Row, "row 2, column 2"),
            ("1,\n3,4\n", Called::Row, "row 1, column 2: ''"),
            ("1/0,2\n3,4\n", Called::Row, "row 1, column 1: '1/0'"),
            ("\"1,2\n3,4\n", Called::Row, "row 1, column 1"),
            ("a,b\nc,d\n", Called::Row, "row 1, column 1: 'a'"),
            ("[1 2; 3]", Called::Row, "row 2 has 1 entries"),
            (
                "%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 1\n",
                Called::Row,
                "entry (3, 1)",
            ),
            ("{\"a\": 1}", Called::Row, "rows"),
        ] {
            let error = read(text.as_bytes(), called).unwrap_err();
            assert!(
                error.to_string().contains(part) && error.accepted().is_some(),
                "{text:?}: {error}"
            );
        }
        assert!(read(&[0xff, 0xfe, 0], Called::Row).is_err());
    }
}
