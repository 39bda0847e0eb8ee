//! `eigenring spectrum`: eigenvalues, Fourier indices and limit stencils of any scheme or matrix.

use crate::args::{self, CornerArgs};
use crate::error::Error;
use crate::files;
use crate::output::Output;
use crate::progress::note;
use crate::threads::Threads;
use crate::valences::{self, OptionalValence};
use clap::{ArgGroup, Args};
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::spectrum::{Analysis, parse_matrix};
use eigenring_atlas::table::{Format, pretty};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// List the eigenvalues of a local subdivision matrix with their Fourier indices and multiplicities.
///
/// Blocks k and N-k share their spectrum: they are listed once, with fourier = k <= N/2 and the multiplicity
/// in the whole matrix. Without --rings the smallest closed set of rings is taken, and one ring more where
/// the eigenvalues outside of it are not strictly below the subsubdominant one: a note says so, and
/// closed_rings and outer (their largest modulus) are listed.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("source").required(true))]
#[command(
    after_help = "Examples:\n  eigenring spectrum --scheme catmull-clark -N 5\n  eigenring spectrum --scheme tension:order=6,u0=2 -N 7 --level 0 --format json\n  eigenring spectrum --scheme catmull-clark --fan 3           a boundary vertex with three faces\n  eigenring spectrum --scheme stam:order=6 --dart -N 5 --cs 1\n  eigenring spectrum --scheme catmull-clark --knots 1,2,1,3 --next 1,1,1,1\n  eigenring spectrum --matrix S.csv -N 5"
)]
pub struct Arguments {
    /// The scheme: see 'eigenring --help'
    #[arg(long, value_name = "SPEC", group = "source")]
    scheme: Option<SchemeName>,
    /// A local matrix of your own (CSV without header), in the numbering that 'eigenring matrix' shows
    #[arg(long, value_name = "FILE", group = "source")]
    matrix: Option<PathBuf>,
    #[command(flatten)]
    valence: OptionalValence,
    #[command(flatten)]
    corner: CornerArgs,
    /// Rings of control points
    #[arg(long, value_name = "R", value_parser = args::count, allow_negative_numbers = true, conflicts_with = "matrix")]
    rings: Option<usize>,
    /// Level of refinement, 0 for the first; by default the limit level, which governs continuity
    #[arg(long, value_name = "LEVEL", value_parser = args::count, allow_negative_numbers = true, conflicts_with = "matrix")]
    level: Option<usize>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        self.threads.start()?;
        let analysis = match (&self.scheme, &self.matrix) {
            (Some(scheme), _) => {
                let (shape, steps) = self.corner.shape(self.valence.valence)?;
                let corner = shape.corner(scheme.centre()?, steps)?;
                let found = scheme.around(&corner, &args::tuner())?;
                Analysis::of_corner(&found, &corner, self.rings, self.level)?
            }
            (None, Some(path)) => {
                self.corner.refuse("for a matrix")?;
                let valence = self.valence.valence.ok_or_else(valences::missing)?;
                analyse_file(path, valence)?
            }
            // the parser demands one of them
            (None, None) => return Ok(ExitCode::from(2)),
        };
        if let Some(warning) = analysis.warning() {
            note(&warning);
        }
        let text = match format {
            Format::Json => pretty(&Value::Object(analysis.json())),
            Format::Text => analysis.text(),
            format => {
                analysis.notes().iter().for_each(|text| note(text));
                analysis.eigenvalues().render(format)
            }
        };
        self.output.emit(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}

fn analyse_file(path: &Path, valence: usize) -> Result<Analysis, Error> {
    let text = files::read(path)?;
    let analysis = parse_matrix(&text)
        .and_then(|matrix| Analysis::of_matrix(format!("matrix:{}", path.display()), &matrix, valence));
    Ok(analysis.map_err(|error| error.in_file(path))?)
}
