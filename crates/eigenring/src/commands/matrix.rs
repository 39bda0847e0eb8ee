//! `eigenring matrix`: the local matrix in the formats of other programs, with its numbering.

use super::spectrum::check_rings;
use crate::args;
use crate::error::Error;
use crate::files;
use crate::schemes::SchemeArg;
use crate::table::{Format, Table, pretty};
use clap::{Args, ValueEnum};
use eigenring_scheme::{Numbering, Site};
use eigenring_spectral::{Matrix, Sufficient, local_matrix};
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Write the local subdivision matrix: row i holds the weights of refined point i.
///
/// Points are numbered rings outwards, within a ring sector by sector, within a sector from spoke i towards spoke i+1; the
/// vertex, if there is one, is point 0. P_i(a,b) is a steps along spoke i and b along spoke i+1. The numbering is part of
/// the mtx (as comments) and json output; for csv and npy write it with --numbering.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring matrix --scheme catmull-clark -N 5 --rings 2 --format csv -o S.csv --numbering points.csv\n  eigenring matrix --scheme tension:order=6 -N 3 --format json"
)]
pub struct Arguments {
    /// The scheme: see 'eigenring --help'
    #[arg(long, value_name = "SPEC")]
    scheme: SchemeArg,
    /// Valence
    #[arg(short = 'N', long, value_name = "N", value_parser = args::valence, allow_negative_numbers = true)]
    valence: usize,
    /// Rings of control points; by default as many as 'eigenring spectrum' takes, mostly the smallest closed set
    #[arg(long, value_name = "R", value_parser = args::count, allow_negative_numbers = true)]
    rings: Option<usize>,
    /// Level of refinement, 0 for the first; by default the limit level
    #[arg(long, value_name = "LEVEL", value_parser = args::count, allow_negative_numbers = true)]
    level: Option<usize>,
    /// Matrix Market, NumPy, comma-separated values, or JSON
    #[arg(long, value_enum, default_value_t)]
    format: MatrixFormat,
    /// The file to write; standard output by default
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Also write the points in order, as CSV: index, sector, a, b
    #[arg(long, value_name = "FILE")]
    numbering: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum MatrixFormat {
    #[default]
    Mtx,
    Npy,
    Csv,
    Json,
}

/// A dense matrix beyond this many entries (800 MB) is a typing error.
const MAX_ENTRIES: usize = 100_000_000;

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let valence = self.valence;
        let scheme = self.scheme.scheme(valence)?;
        let level = self.level.map_or(scheme.limit(), |level| scheme.level(level));
        let closed = scheme.closed_rings()?;
        let rings = match self.rings {
            Some(rings) => check_rings(rings, closed)?,
            None => Sufficient::new(level, closed)?.system.numbering().rings,
        };
        let numbering = scheme.numbering(rings);
        let count = numbering.count();
        if count.saturating_mul(count) > MAX_ENTRIES {
            return Err(Error::Range {
                what: "matrix size",
                given: format!("{count} x {count}"),
                accepted: format!("at most {MAX_ENTRIES} entries: fewer rings or a smaller valence"),
            });
        }
        let matrix = local_matrix(level, rings)?;
        let bytes = match self.format {
            MatrixFormat::Mtx => matrix_market(&matrix, numbering, &scheme.name()).into_bytes(),
            MatrixFormat::Npy => npy(&matrix),
            MatrixFormat::Csv => csv(&matrix).into_bytes(),
            MatrixFormat::Json => {
                let rows: Vec<&[f64]> = (0..count).map(|row| matrix.row(row)).collect();
                pretty(&json!({
                    "scheme": scheme.name(),
                    "valence": valence,
                    "rings": rings,
                    "points": points(numbering).json(),
                    "rows": rows,
                }))
                .into_bytes()
            }
        };
        if let Some(path) = &self.numbering {
            files::write(path, points(numbering).render(Format::Csv).as_bytes())?;
        }
        files::emit(self.out.as_deref(), &bytes)?;
        Ok(ExitCode::SUCCESS)
    }
}

fn points(numbering: Numbering) -> Table {
    let mut table = Table::new(["index", "sector", "a", "b"]);
    for (index, Site { sector, x, y }) in numbering.sites().into_iter().enumerate() {
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

/// Coordinate format; indices count from 1.
fn matrix_market(matrix: &Matrix<f64>, numbering: Numbering, name: &str) -> String {
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

/// NumPy's format, version 1.0: little-endian doubles by rows.
fn npy(matrix: &Matrix<f64>) -> Vec<u8> {
    let mut header = format!(
        "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}",
        matrix.rows(),
        matrix.columns()
    );
    // the data start at a multiple of 64 bytes: 10 bytes of preamble, the header, a final newline
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(matrix.entries().iter().flat_map(|entry| entry.to_le_bytes()));
    bytes
}

fn csv(matrix: &Matrix<f64>) -> String {
    let line = |row: usize| {
        let entries: Vec<String> = matrix.row(row).iter().map(f64::to_string).collect();
        entries.join(",") + "\n"
    };
    (0..matrix.rows()).map(line).collect()
}
