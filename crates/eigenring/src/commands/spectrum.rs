//! `eigenring spectrum`: eigenvalues, Fourier indices and limit stencils of any scheme or matrix.

use super::with_words;
use crate::args::{self, CornerArgs, SchemeSettings};
use crate::error::Error;
use crate::files;
use crate::output::Output;
use crate::progress::{Terminal, note};
use crate::threads::Threads;
use crate::valences::OptionalValence;
use clap::{ArgGroup, Args, ValueEnum};
use eigenring_atlas::Accepted;
use eigenring_atlas::given::{Given, Matrix, Rotation};
use eigenring_atlas::numbers::{self, Called};
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::spectrum::Analysis;
use eigenring_atlas::sweep::{self, Sweep, spectra};
use eigenring_atlas::table::{Format, pretty};
use eigenring_scheme::{Centre, Shape};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const EXAMPLES: &str = "Examples:\n  eigenring spectrum --scheme catmull-clark -N 5\n  eigenring spectrum --scheme tension:order=6,u0=2 -N 7 --level 0 --format json\n  eigenring spectrum --scheme catmull-clark --fan 3           a boundary vertex with three faces\n  eigenring spectrum --scheme stam:order=5 --fan 2 --corner\n  eigenring spectrum --scheme stam:order=6 --dart -N 5 --cs 1\n  eigenring spectrum --scheme catmull-clark --knots 1,2,1,3 --next 1,1,1,1\n  eigenring spectrum --scheme file:my.toml --sweep a=1..2:20 -N 5\n  eigenring spectrum --matrix S.csv                           a matrix of your own";

/// List the eigenvalues of a local subdivision matrix with their Fourier indices and multiplicities.
///
/// Multiplicities are those in the whole matrix: an eigenvalue that blocks k and N-k share is listed once,
/// with fourier = k <= N/2. Without --rings the smallest closed set of rings is taken, and one ring more
/// where the eigenvalues outside of it are not strictly below the subsubdominant one: a note says so, and
/// closed_rings and outer (their largest modulus) are listed.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("source").required(true))]
#[command(
    after_help = EXAMPLES,
    after_long_help = with_words(EXAMPLES, "spectrum")
)]
pub struct Arguments {
    /// The scheme: see 'eigenring --help'
    #[arg(long, value_name = "SPEC", group = "source")]
    scheme: Option<SchemeName>,
    /// A local matrix of your own, - for standard input: text with commas, semicolons, tabs or blanks,
    /// [..;..], Matrix Market, NumPy or JSON. Its rotation is found in all usual orders of points
    #[arg(long, value_name = "FILE", group = "source")]
    matrix: Option<PathBuf>,
    /// With --matrix: the points in its order, a table with the columns sector and others that name the place
    /// within the sector, as 'eigenring matrix --numbering' writes it
    #[arg(long, value_name = "FILE", conflicts_with = "scheme")]
    numbering: Option<PathBuf>,
    #[command(flatten)]
    settings: SchemeSettings,
    /// Spectra along a parameter of a scheme file, from A to B in a number of steps
    #[arg(
        long,
        value_name = "NAME=A..B:STEPS",
        allow_hyphen_values = true,
        conflicts_with = "matrix"
    )]
    sweep: Option<Sweep>,
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
    /// One table alone, as text, CSV or LaTeX; by default text has both, CSV and LaTeX the eigenvalues
    #[arg(long, value_enum)]
    table: Option<Which>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

/// The tables that are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Which {
    /// The eigenvalues.
    Eigenvalues,
    /// The weights of all points in limit position and tangents.
    LimitStencils,
}

/// What is printed.
enum Answer {
    Scheme(Analysis),
    Matrix(Given),
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        self.threads.start()?;
        let scheme = self.scheme.clone();
        let scheme = scheme.map(|scheme| self.settings.apply(scheme)).transpose()?;
        if let (Some(sweep), Some(scheme)) = (&self.sweep, &scheme) {
            self.corner.refuse("with --sweep")?;
            let valence = match self.valence.valence {
                Some(valence) => valence,
                None => args::only_valence(scheme)?,
            };
            let found = spectra(scheme, sweep, valence, [self.rings, self.level], &Terminal)?;
            let text = match format {
                Format::Json => pretty(&sweep::json(sweep, &found)),
                format => sweep::table(sweep, &found).render(format),
            };
            self.output.emit(&text)?;
            return Ok(ExitCode::SUCCESS);
        }
        let answer = match (&scheme, &self.matrix) {
            (Some(scheme), _) => {
                let (shape, steps) = self.corner.shape(self.valence.valence, scheme)?;
                let (centre, net) = (scheme.centre()?, [self.rings, self.level]);
                match shape {
                    // around the half cell of a dual scheme there is no lattice of sectors
                    Shape::Fan { faces, corner } if centre == Centre::Face && steps.is_none() => {
                        Answer::Matrix(Given::of_half_cell(scheme, faces, corner, net)?)
                    }
                    shape => {
                        let corner = shape.corner(centre, steps)?;
                        Answer::Scheme(Analysis::of_name(scheme, &corner, net, &args::tuner())?)
                    }
                }
            }
            (None, Some(path)) => {
                self.corner.refuse("for a matrix")?;
                self.of_matrix(path)?
            }
            // the parser demands one of them
            (None, None) => return Ok(ExitCode::from(2)),
        };
        let (warning, notes) = match &answer {
            Answer::Scheme(analysis) => (analysis.warning(), analysis.notes()),
            Answer::Matrix(given) => (given.warning(), given.notes()),
        };
        if let Some(warning) = warning {
            note(&warning);
        }
        let text = match (format, self.table, &answer) {
            (Format::Json, Some(_), _) => {
                let message = "--table has no meaning for JSON, which has all tables";
                return Err(Error::usage(message, "--format text, csv or latex"));
            }
            (Format::Json, None, Answer::Scheme(analysis)) => pretty(&Value::Object(analysis.json())),
            (Format::Json, None, Answer::Matrix(given)) => pretty(&Value::Object(given.json())),
            (Format::Text, None, Answer::Scheme(analysis)) => analysis.text(),
            (Format::Text, None, Answer::Matrix(given)) => given.text(),
            (format, which, answer) => {
                notes.iter().for_each(|text| note(text));
                let table = match (which.unwrap_or(Which::Eigenvalues), answer) {
                    (Which::Eigenvalues, Answer::Scheme(analysis)) => analysis.eigenvalues(),
                    (Which::Eigenvalues, Answer::Matrix(given)) => given.eigenvalues(),
                    (Which::LimitStencils, Answer::Scheme(analysis)) => analysis.limit_stencils(),
                    (Which::LimitStencils, Answer::Matrix(given)) => given.limit_stencils(),
                };
                table.render(format)
            }
        };
        self.output.emit(&text)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Analyses a matrix of a file. In the order of 'eigenring matrix' it is one of rings around a vertex or
    /// a face.
    fn of_matrix(&self, path: &Path) -> Result<Answer, Error> {
        let numbered = match &self.numbering {
            Some(path) => Some(numbering(path)?),
            None => None,
        };
        let bytes = files::read_bytes(path)?;
        let name = format!("matrix:{}", path.display());
        let analyse = || -> Result<Answer, eigenring_atlas::Error> {
            let rows = numbers::read(&bytes, Called::Row)?.rows;
            let columns = rows.first().map_or(0, Vec::len);
            let given = Given::new(
                name.clone(),
                &Matrix::from_rows(rows, columns),
                self.valence.valence,
                numbered,
            )?;
            // what is known of schemes holds for matrices in their order, but for complex eigenvalues
            let by_ring = given.rotation().filter(|rotation| rotation.is_by_ring());
            match by_ring.filter(|_| !given.has_complex_lambda()) {
                Some(rotation) => {
                    given.notes().iter().for_each(|text| note(text));
                    Ok(Answer::Scheme(Analysis::of_matrix(
                        name.clone(),
                        given.matrix(),
                        rotation.valence,
                        given.rounding(),
                    )?))
                }
                None => Ok(Answer::Matrix(given)),
            }
        };
        Ok(analyse().map_err(|error| error.in_file(path))?)
    }
}

/// The rotation that a table of points describes.
fn numbering(path: &Path) -> Result<Rotation, Error> {
    let read = || -> Result<Rotation, eigenring_atlas::Error> {
        let numbers = numbers::read(&files::read_bytes(path)?, Called::Line)?;
        let accepted = || {
            Accepted::Are(
                "a column 'sector' and columns that name the place, N points or one for each place".to_owned(),
            )
        };
        let refuse = |message: &str| eigenring_atlas::Error::refused(message, accepted());
        let names = numbers
            .names
            .clone()
            .ok_or_else(|| refuse("the columns have no names"))?;
        let place: Vec<&str> = names
            .iter()
            .map(String::as_str)
            .filter(|name| !["index", "sector", "point"].contains(name))
            .collect();
        let columns: Vec<&str> = ["sector"].into_iter().chain(place).collect();
        let rows = numbers
            .columns(&columns)
            .ok_or_else(|| refuse("there is no column 'sector'"))?;
        let points: Vec<(usize, Vec<i64>)> = rows
            .iter()
            .map(|row| (row[0] as usize, row[1..].iter().map(|entry| *entry as i64).collect()))
            .collect();
        Rotation::numbered(&points).ok_or_else(|| refuse("the points are not N for each place"))
    };
    Ok(read().map_err(|error| error.in_file(path))?)
}
