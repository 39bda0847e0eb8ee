//! NumPy's format: a magic string, a header in Python's syntax, the numbers.

use super::Numbers;
use crate::error::{Accepted, Error};

/// How such files begin.
pub const MAGIC: &[u8] = b"\x93NUMPY";

/// Reads an array of one or two dimensions of floats or integers.
///
/// # Errors
/// [`Error::Content`] for a file that is cut off, or another type or shape.
pub fn read(bytes: &[u8]) -> Result<Numbers, Error> {
    let short = || Error::refused("the NumPy file is cut off", Accepted::Are("complete ones".to_owned()));
    let version = *bytes.get(6).ok_or_else(short)?;
    let (start, length): (usize, usize) = match version {
        1 => {
            let length = bytes.get(8..10).ok_or_else(short)?;
            (10, u16::from_le_bytes([length[0], length[1]]) as usize)
        }
        _ => {
            let length = bytes.get(8..12).ok_or_else(short)?;
            (
                12,
                u32::from_le_bytes([length[0], length[1], length[2], length[3]]) as usize,
            )
        }
    };
    let header = bytes.get(start..start.saturating_add(length)).ok_or_else(short)?;
    let header = String::from_utf8_lossy(header);
    let descr = value(&header, "descr").map(|text| text.trim_matches(['\'', '"']).to_owned());
    let descr = descr.unwrap_or_default();
    let shape = value(&header, "shape").unwrap_or_default();
    let shape: Vec<usize> = shape
        .trim_matches(['(', ')'])
        .split(',')
        .filter_map(|part| part.trim().parse().ok())
        .collect();
    let columns_first = value(&header, "fortran_order").as_deref() == Some("True");
    let (rows, columns) = match *shape.as_slice() {
        [rows, columns] => (rows, columns),
        [entries] => (entries, 1),
        _ => {
            let accepted = Accepted::Are("one and two dimensions".to_owned());
            return Err(Error::refused(format!("the NumPy array has shape {shape:?}"), accepted));
        }
    };
    let (big, kind) = (descr.starts_with('>'), descr.trim_start_matches(['<', '>', '|', '=']));
    let size = match kind {
        "f8" | "i8" => 8,
        "f4" | "i4" => 4,
        "i2" => 2,
        "i1" | "u1" => 1,
        _ => {
            let accepted = Accepted::Are("f8, f4, i8, i4, i2, i1, u1".to_owned());
            return Err(Error::refused(
                format!("the NumPy array has entries of type '{descr}'"),
                accepted,
            ));
        }
    };
    let data = &bytes[start + length..];
    let count = rows
        .checked_mul(columns)
        .filter(|count| count.checked_mul(size).is_some_and(|all| all <= data.len()));
    let count = count.ok_or_else(short)?;
    let entry = |index: usize| {
        let mut raw = [0u8; 8];
        raw[..size].copy_from_slice(&data[index * size..(index + 1) * size]);
        if big {
            raw[..size].reverse();
        }
        let low = [raw[0], raw[1], raw[2], raw[3]];
        match kind {
            "f8" => f64::from_le_bytes(raw),
            "f4" => f64::from(f32::from_le_bytes(low)),
            "i8" => i64::from_le_bytes(raw) as f64,
            "i4" => f64::from(i32::from_le_bytes(low)),
            "i2" => f64::from(i16::from_le_bytes([raw[0], raw[1]])),
            "i1" => f64::from(raw[0] as i8),
            _ => f64::from(raw[0]),
        }
    };
    if let Some(index) = (0..count).find(|&index| !entry(index).is_finite()) {
        let message = format!("entry {index} of the NumPy array is {}", entry(index));
        return Err(Error::refused(message, Accepted::Are("finite numbers".to_owned())));
    }
    let place = |row: usize, column: usize| {
        if columns_first {
            column * rows + row
        } else {
            row * columns + column
        }
    };
    Ok(Numbers {
        names: None,
        rows: (0..rows)
            .map(|row| (0..columns).map(|column| entry(place(row, column))).collect())
            .collect(),
    })
}

/// The value of a key in the header's dictionary: a text, a word or a tuple.
fn value(header: &str, key: &str) -> Option<String> {
    let (_, rest) = header.split_once(&format!("'{key}':"))?;
    let rest = rest.trim_start();
    let end = match rest.starts_with('(') {
        true => rest.find(')')? + 1,
        false => rest.find([',', '}'])?,
    };
    Some(rest[..end].trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, data: &[u8]) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        bytes
    }

    #[test]
    fn types_orders_and_shapes() {
        let doubles: Vec<u8> = [1.0f64, 2.0, 3.0, 4.0].iter().flat_map(|x| x.to_le_bytes()).collect();
        let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }";
        assert_eq!(read(&file(header, &doubles)).unwrap().rows, [[1.0, 2.0], [3.0, 4.0]]);
        let columns = header.replace("False", "True");
        assert_eq!(read(&file(&columns, &doubles)).unwrap().rows, [[1.0, 3.0], [2.0, 4.0]]);
        let singles: Vec<u8> = [0.5f32, -2.0].iter().flat_map(|x| x.to_be_bytes()).collect();
        let header = "{'descr': '>f4', 'fortran_order': False, 'shape': (1, 2), }";
        assert_eq!(read(&file(header, &singles)).unwrap().rows, [[0.5, -2.0]]);
        let list = "{'descr': '<i4', 'fortran_order': False, 'shape': (2,), }";
        assert_eq!(
            read(&file(list, &[1, 0, 0, 0, 255, 255, 255, 255])).unwrap().rows,
            [[1.0], [-1.0]]
        );
        for (header, data) in [
            (
                "{'descr': '<c16', 'fortran_order': False, 'shape': (1, 1), }",
                vec![0; 16],
            ),
            (
                "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1), }",
                vec![0; 8],
            ),
            (
                "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999, 99999999999), }",
                vec![0; 8],
            ),
            (
                "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1), }",
                f64::NAN.to_le_bytes().to_vec(),
            ),
            ("", vec![]),
        ] {
            assert!(read(&file(header, &data)).unwrap_err().accepted().is_some(), "{header}");
        }
        assert!(read(MAGIC).is_err());
    }
}
