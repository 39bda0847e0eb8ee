//! Control points from a table of numbers: a point a line, its coordinates in columns, with or without names
//! above them. Where columns are called x, y (and z), those are the coordinates.

use crate::error::Error;
use crate::numbers::{Called, read};

/// The points in a file: at least one coordinate each, all as many, all finite. How many points are needed is
/// for the curve to say.
///
/// # Errors
/// [`Error::Content`] with line and column, counted from 1.
pub fn parse(bytes: &[u8]) -> Result<Vec<Vec<f64>>, Error> {
    let numbers = read(bytes, Called::Line)?;
    let named = numbers
        .columns(&["x", "y", "z"])
        .or_else(|| numbers.columns(&["x", "y"]));
    Ok(named.unwrap_or(numbers.rows))
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
            assert_eq!(parse(text.as_bytes()).unwrap(), expected, "{text:?}");
        }
        assert_eq!(parse(b"height\n1\n2\n").unwrap().len(), 2);
        assert!(parse(b"").unwrap().is_empty());
        // what 'eigenring curve' prints has the coordinates among other columns
        let printed = b"level,parameter,x,y\n3,0.5,1,-2.5\n3,0.75,300,0\n";
        assert_eq!(parse(printed).unwrap(), expected);
        let printed = b"{\"points\": [{\"level\": 3, \"x\": 1, \"y\": -2.5}, {\"level\": 3, \"x\": 300, \"y\": 0}]}";
        assert_eq!(parse(printed).unwrap(), expected);
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
            let message = parse(text.as_bytes()).unwrap_err().to_string();
            assert!(
                message.contains(part) && message.contains("accepted"),
                "{text:?}: {message}"
            );
        }
    }
}
