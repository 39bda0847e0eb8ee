//! Local matrices in the formats of other programs, with their numbering.
//!
//! Row i holds the weights of refined point i. Points are numbered rings outwards, within a ring sector by
//! sector, within a sector from spoke i towards spoke i+1; the vertex, if there is one, is point 0.

use crate::error::Error;
use crate::spectrum::check_rings;
use crate::table::Table;
use eigenring_scheme::{Numbering, Scheme, Site};
use eigenring_spectral::{Matrix, Sufficient, local_matrix};
use serde_json::{Value, json};

/// A dense matrix beyond this many entries (800 MB) is a typing error.
const MAX_ENTRIES: usize = 100_000_000;

/// Refuses a dense matrix of so many rows that is too large.
pub(crate) fn check_size(rows: usize) -> Result<(), Error> {
    if rows.saturating_mul(rows) <= MAX_ENTRIES {
        return Ok(());
    }
    Err(Error::Range {
        what: "matrix size",
        given: format!("{rows} x {rows}"),
        accepted: format!("at most {MAX_ENTRIES} entries: fewer rings or a smaller valence"),
    })
}

/// A local matrix.
#[derive(Clone, Debug)]
pub struct LocalMatrix {
    /// The scheme's name.
    pub name: String,
    /// The points, in the order of rows and columns.
    pub numbering: Numbering,
    /// The weights.
    pub matrix: Matrix<f64>,
}

/// An array in NumPy's format, version 1.0: little-endian doubles, the last index fastest.
pub(crate) fn npy(shape: &[usize], entries: impl Iterator<Item = f64>) -> Vec<u8> {
    let lengths: Vec<String> = shape.iter().map(usize::to_string).collect();
    let mut header = format!(
        "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}",
        lengths.join(", ")
    );
    // the data start at a multiple of 64 bytes: 10 bytes of preamble, the header, a final newline
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(entries.flat_map(f64::to_le_bytes));
    bytes
}

impl LocalMatrix {
    /// The matrix of a level of a scheme, by default the limit level, on so many rings; by default as many as
    /// [`Analysis::of_scheme`](crate::spectrum::Analysis::of_scheme) takes.
    ///
    /// # Errors
    /// [`Error::Range`] for a number of rings as there, and for more than 10^8 entries.
    pub fn new(scheme: &Scheme<f64>, rings: Option<usize>, level: Option<usize>) -> Result<Self, Error> {
        let level = level.map_or(scheme.limit(), |level| scheme.level(level));
        let closed = scheme.closed_rings()?;
        let rings = match rings {
            Some(rings) => check_rings(rings, closed)?,
            None => Sufficient::new(level, closed)?.system.numbering().rings,
        };
        let numbering = scheme.numbering(rings);
        let count = numbering.count();
        check_size(count)?;
        Ok(LocalMatrix {
            name: scheme.name().to_owned(),
            numbering,
            matrix: local_matrix(level, rings)?,
        })
    }

    /// The points in order: index, sector, and steps a along the sector's spoke and b along the next.
    pub fn points(&self) -> Table {
        let mut table = Table::new(["index", "sector", "a", "b"]);
        for (index, Site { sector, x, y }) in self.numbering.sites().into_iter().enumerate() {
            // x, y >= 0 for canonical sites
            table.push(vec![
                index.into(),
                sector.into(),
                (x as usize / 2).into(),
                (y as usize / 2).into(),
            ]);
        }
        table
    }

    /// Matrix Market's coordinate format; indices count from 1, and comments list the points.
    pub fn matrix_market(&self) -> String {
        let LocalMatrix {
            name,
            numbering,
            matrix,
        } = self;
        let entries: Vec<String> = (0..matrix.rows())
            .flat_map(|row| (0..matrix.columns()).map(move |column| (row, column)))
            .filter(|&place| matrix[place] != 0.0)
            .map(|(row, column)| format!("{} {} {}\n", row + 1, column + 1, matrix[(row, column)]))
            .collect();
        let mut text = format!(
            "%%MatrixMarket matrix coordinate real general\n% {name}, valence {}, {} rings; row i: weights of refined point i\n% point: sector a b\n",
            numbering.fan.sectors(),
            numbering.rings
        );
        for (index, Site { sector, x, y }) in numbering.sites().into_iter().enumerate() {
            text.push_str(&format!("% {}: {sector} {} {}\n", index + 1, x / 2, y / 2));
        }
        text.push_str(&format!("{} {} {}\n", matrix.rows(), matrix.columns(), entries.len()));
        text.push_str(&entries.concat());
        text
    }

    /// NumPy's format: the matrix by rows.
    pub fn npy(&self) -> Vec<u8> {
        let shape = [self.matrix.rows(), self.matrix.columns()];
        npy(&shape, self.matrix.entries().iter().copied())
    }

    /// Comma-separated values without header.
    pub fn csv(&self) -> String {
        let line = |row: usize| {
            let entries: Vec<String> = self.matrix.row(row).iter().map(f64::to_string).collect();
            entries.join(",") + "\n"
        };
        (0..self.matrix.rows()).map(line).collect()
    }

    /// Scheme, valence, rings, points and rows as a JSON object.
    pub fn json(&self) -> Value {
        let rows: Vec<&[f64]> = (0..self.matrix.rows()).map(|row| self.matrix.row(row)).collect();
        json!({
            "scheme": self.name,
            "valence": self.numbering.fan.sectors(),
            "rings": self.numbering.rings,
            "points": self.points().json(),
            "rows": rows,
        })
    }
}
