//! `eigenring eigenvectors`: right and left eigenvectors of a local matrix, with the names of its points.

use crate::args::{self, CornerArgs, NetArgs, OneScheme};
use crate::error::Error;
use crate::files;
use crate::output::{Extension, agreed};
use crate::valences::OptionalValence;
use clap::{Args, ValueEnum};
use eigenring_atlas::eigenvectors::Eigenvectors;
use eigenring_atlas::spectrum::Analysis;
use eigenring_atlas::stam;
use eigenring_atlas::table::{Format, pretty};
use std::path::PathBuf;
use std::process::ExitCode;

/// Write all right and left eigenvectors of a local subdivision matrix.
///
/// Columns stand in the order of 'eigenring spectrum'; S R = R D, and left vectors are dual to right ones,
/// L^T R = I. A real eigenvalue has real vectors, of blocks k and N-k the real and the imaginary part; of a
/// complex one each conjugate has its own. A defective one has Jordan chains: 'chains' of JSON lists their
/// columns, the eigenvector first, and each further column is mapped to its multiple plus the one before;
/// the column 'chain' of csv is the place. JSON holds rows for points and columns for vectors; csv a row for
/// each vector; npy one array of shape (2, points, points), right vectors as columns, then left ones.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring eigenvectors --scheme catmull-clark -N 5 -o vectors.json\n  eigenring eigenvectors --scheme stam:order=6 -N 7 --format csv\n  eigenring eigenvectors --scheme catmull-clark -N 5 --stam -o basis.npy"
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
    /// Stam's evaluation basis instead: eigenvalues, inverse eigenvectors and the coefficients of bicubic
    /// patches, K = 2N+8 with 3 patches where edge and face points have the regular rules, else K = 6N+1 with
    /// 12, as JSON or npy
    #[arg(long)]
    stam: bool,
    /// JSON (the default), comma-separated values, or NumPy
    #[arg(long, value_enum)]
    format: Option<VectorFormat>,
    /// The file to write, in the format that its extension names (.json, .csv, .npy); standard output by
    /// default
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum VectorFormat {
    #[default]
    Json,
    Csv,
    Npy,
}

impl Extension for VectorFormat {
    fn extensions(self) -> &'static [&'static str] {
        match self {
            VectorFormat::Json => &["json"],
            VectorFormat::Csv => &["csv"],
            VectorFormat::Npy => &["npy"],
        }
    }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let name = self.scheme.name()?;
        let (shape, steps) = self.corner.shape(self.valence.valence, &name)?;
        let corner = shape.corner(name.centre()?, steps)?;
        let format = agreed(self.format, self.out.as_deref())?.unwrap_or_default();
        let extended = name.extended(&corner)?;
        if self.stam {
            if self.net.rings.is_some() || self.net.level.is_some() {
                return Err(Error::usage(
                    "--rings and --level have no meaning for --stam",
                    "--stam alone",
                ));
            }
            let scheme = name.around(&corner, &args::tuner())?;
            let found = stam::basis(&scheme, extended.as_ref())?;
            let bytes = match format {
                VectorFormat::Json => pretty(&stam::json(&found, scheme.name())).into_bytes(),
                VectorFormat::Npy => stam::npy(&found),
                VectorFormat::Csv => return Err(Error::usage("--stam has no CSV form", "--format json and npy")),
            };
            files::emit(self.out.as_deref(), &bytes)?;
            return Ok(ExitCode::SUCCESS);
        }
        let net = [self.net.rings, self.net.level];
        let analysis = Analysis::of_name(&name, &corner, net, &args::tuner())?;
        let vectors = Eigenvectors::new(&analysis, extended.as_ref())?;
        let bytes = match format {
            VectorFormat::Json => pretty(&vectors.json()).into_bytes(),
            VectorFormat::Csv => vectors.table().render(Format::Csv).into_bytes(),
            VectorFormat::Npy => vectors.npy()?,
        };
        files::emit(self.out.as_deref(), &bytes)?;
        Ok(ExitCode::SUCCESS)
    }
}
