//! `eigenring matrix`: the local matrix in the formats of other programs, with its numbering.

use crate::args::{self, CornerArgs, NetArgs, OneScheme};
use crate::error::Error;
use crate::files;
use crate::output::{Extension, agreed};
use crate::threads::Threads;
use crate::valences::OptionalValence;
use clap::{Args, ValueEnum};
use eigenring_atlas::matrix::LocalMatrix;
use eigenring_atlas::table::{Format, pretty};
use std::path::PathBuf;
use std::process::ExitCode;

/// Write the local subdivision matrix: row i holds the weights of refined point i.
///
/// Points are numbered rings outwards, within a ring sector by sector, within a sector from spoke i towards
/// spoke i+1; the vertex, if there is one, is point 0. P_i(a,b) is a steps along spoke i and b along spoke
/// i+1. The numbering is part of the mtx (as comments) and json output; for csv and npy write it with
/// --numbering.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring matrix --scheme catmull-clark -N 5 --rings 2 -o S.csv --numbering points.csv\n  eigenring matrix --scheme tension:order=6 -N 3 --format json"
)]
pub struct Arguments {
    #[command(flatten)]
    scheme: OneScheme,
    #[command(flatten)]
    valence: OptionalValence,
    #[command(flatten)]
    corner: CornerArgs,
    #[command(flatten)]
    net: NetArgs,
    /// Matrix Market (the default), NumPy, comma-separated values, or JSON
    #[arg(long, value_enum)]
    format: Option<MatrixFormat>,
    /// The file to write, in the format that its extension names (.mtx, .npy, .csv, .json); standard output
    /// by default
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Also write the points in order, as CSV: index, sector, a, b
    #[arg(long, value_name = "FILE")]
    numbering: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum MatrixFormat {
    #[default]
    Mtx,
    Npy,
    Csv,
    Json,
}

impl Extension for MatrixFormat {
    fn extensions(self) -> &'static [&'static str] {
        match self {
            MatrixFormat::Mtx => &["mtx"],
            MatrixFormat::Npy => &["npy"],
            MatrixFormat::Csv => &["csv"],
            MatrixFormat::Json => &["json"],
        }
    }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        self.threads.start()?;
        let scheme = self.scheme.name()?;
        let (shape, steps) = self.corner.shape(self.valence.valence, &scheme)?;
        let corner = shape.corner(scheme.centre()?, steps)?;
        let scheme = scheme.around(&corner, &args::tuner())?;
        let format = agreed(self.format, self.out.as_deref())?.unwrap_or_default();
        let matrix = LocalMatrix::new(&scheme, self.net.rings, self.net.level)?;
        let bytes = match format {
            MatrixFormat::Mtx => matrix.matrix_market().into_bytes(),
            MatrixFormat::Npy => matrix.npy(),
            MatrixFormat::Csv => matrix.csv().into_bytes(),
            MatrixFormat::Json => pretty(&matrix.json()).into_bytes(),
        };
        if let Some(path) = &self.numbering {
            files::save(path, matrix.points().render(Format::Csv).as_bytes())?;
        }
        files::emit(self.out.as_deref(), &bytes)?;
        Ok(ExitCode::SUCCESS)
    }
}
