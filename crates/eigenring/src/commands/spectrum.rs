//! `eigenring spectrum`: eigenvalues, Fourier indices and limit stencils of any scheme or matrix.

use crate::args::{self, Output};
use crate::error::Error;
use crate::files;
use crate::progress::note;
use crate::schemes::SchemeArg;
use crate::table::{Format, Record, Table, pretty, short};
use clap::{ArgGroup, Args};
use eigenring_scheme::Lattice;
use eigenring_spectral::{Eigenvalue, LocalSystem, Matrix, Spectrum, Sufficient, outer};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// List the eigenvalues of a local subdivision matrix with their Fourier indices and multiplicities.
///
/// Blocks k and N-k share their spectrum: they are listed once, with fourier = k <= N/2 and the multiplicity in the whole
/// matrix. Without --rings the smallest closed set of rings is taken, and one ring more where the eigenvalues outside of it
/// are not strictly below the subsubdominant one: a note says so, and closed_rings and outer (their largest modulus) are listed.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("source").required(true))]
#[command(
    after_help = "Examples:\n  eigenring spectrum --scheme catmull-clark -N 5\n  eigenring spectrum --scheme tension:order=6,u0=2 -N 7 --level 0 --format json\n  eigenring spectrum --matrix S.csv -N 5"
)]
pub struct Arguments {
    /// The scheme: see 'eigenring --help'
    #[arg(long, value_name = "SPEC", group = "source")]
    scheme: Option<SchemeArg>,
    /// A local matrix of your own (CSV without header), in the numbering that 'eigenring matrix' shows
    #[arg(long, value_name = "FILE", group = "source")]
    matrix: Option<PathBuf>,
    /// Valence
    #[arg(short = 'N', long, value_name = "N", value_parser = args::valence, allow_negative_numbers = true)]
    valence: usize,
    /// Rings of control points
    #[arg(long, value_name = "R", value_parser = args::count, allow_negative_numbers = true, conflicts_with = "matrix")]
    rings: Option<usize>,
    /// Level of refinement, 0 for the first; by default the limit level, which governs continuity
    #[arg(long, value_name = "LEVEL", value_parser = args::count, allow_negative_numbers = true, conflicts_with = "matrix")]
    level: Option<usize>,
    #[command(flatten)]
    output: Output,
}

/// Entries of corresponding sectors in a matrix file may differ by this much relative to the largest: files are often
/// printed to ten digits.
const CIRCULANT_TOLERANCE: f64 = 1e-9;

/// The most rings that are taken for meant: a block of 64 rings has 4160 rows.
pub const MAX_RINGS: usize = 64;

/// Refuses rings out of range, given the smallest closed number.
pub fn check_rings(rings: usize, closed: usize) -> Result<usize, Error> {
    if (closed..=MAX_RINGS).contains(&rings) {
        return Ok(rings);
    }
    Err(Error::Range {
        what: "number of rings",
        given: rings.to_string(),
        accepted: format!("{closed} (the smallest closed set) to {MAX_RINGS}"),
    })
}

/// What is analysed.
struct Subject {
    name: String,
    system: LocalSystem,
    /// The smallest closed number of rings and the largest modulus of the eigenvalues outside; unknown for a matrix.
    closed: Option<(usize, f64)>,
}

impl Subject {
    fn scheme(spec: &SchemeArg, valence: usize, rings: Option<usize>, level: Option<usize>) -> Result<Self, Error> {
        let scheme = spec.scheme(valence)?;
        let level = level.map_or(scheme.limit(), |level| scheme.level(level));
        let closed = scheme.closed_rings()?;
        let (system, outer) = match rings {
            Some(rings) => (
                LocalSystem::new(level, check_rings(rings, closed)?)?,
                outer(level, closed)?,
            ),
            None => {
                let Sufficient { system, outer } = Sufficient::new(level, closed)?;
                (system, outer)
            }
        };
        Ok(Subject {
            name: scheme.name().to_owned(),
            system,
            closed: Some((closed, outer)),
        })
    }

    fn matrix(path: &Path, valence: usize) -> Result<Self, Error> {
        let matrix = read_matrix(path)?;
        let system =
            LocalSystem::from_matrix(&matrix, valence, CIRCULANT_TOLERANCE).map_err(|error| Error::BadFile {
                path: path.to_owned(),
                message: error.to_string(),
            })?;
        Ok(Subject {
            name: format!("matrix:{}", path.display()),
            system,
            closed: None,
        })
    }

    /// What the list of eigenvalues does not say by itself.
    fn notes(&self, spectrum: &Spectrum) -> Vec<String> {
        let mut notes = Vec::new();
        let rings = self.system.numbering().rings;
        if let Some((closed, outer)) = self.closed
            && rings > closed
        {
            let reason = format!(
                "eigenvalues up to {} appear with the rings beyond {closed}",
                short(outer)
            );
            let count = if rings == 1 {
                "1 ring".to_owned()
            } else {
                format!("{rings} rings")
            };
            notes.push(format!("{count}, the smallest closed set has {closed}: {reason}"));
        }
        if let Some(lambda) = spectrum.subdominant() {
            // equal to the subdominant one, in any block
            let same = spectrum.eigenvalues.iter().filter(|e| e.is_close(lambda));
            for e in same.filter(|e| e.is_defective()) {
                notes.push(format!(
                    "the subdominant eigenvalue {} is defective (index {}): the usual criterion for C1 does not apply",
                    short(e.modulus()),
                    e.fourier.map_or("-".to_owned(), |index| index.to_string()),
                ));
            }
        }
        notes
    }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let valence = self.valence;
        let subject = match (&self.scheme, &self.matrix) {
            (Some(spec), _) => Subject::scheme(spec, valence, self.rings, self.level)?,
            (None, Some(path)) => Subject::matrix(path, valence)?,
            // the parser demands one of them
            (None, None) => return Ok(ExitCode::from(2)),
        };
        let system = &subject.system;
        let spectrum = system.spectrum()?;
        let numbering = system.numbering();
        let notes = subject.notes(&spectrum);
        if system.row_sum_defect() > 1e-12 {
            note(&format!(
                "the rows of the local matrix do not sum to 1: the largest defect is {:e}",
                system.row_sum_defect()
            ));
        }
        let signed = |e: &Eigenvalue| if e.value.1 == 0.0 { e.value.0 } else { e.modulus() };
        let head = Record::default()
            .with("scheme", subject.name.as_str())
            .with("valence", valence)
            .with(
                "lattice",
                if numbering.lattice == Lattice::Vertex {
                    "vertex"
                } else {
                    "face"
                },
            )
            .with("rings", numbering.rings)
            .with("closed_rings", subject.closed.map(|(closed, _)| closed))
            .with("outer", subject.closed.map(|(_, outer)| outer))
            .with("points", numbering.count())
            .with("subdominant", spectrum.subdominant().map(signed))
            .with("subsubdominant", spectrum.subsubdominant().map(signed))
            .with("s", spectrum.curvature_ratio());
        let mut eigenvalues = Table::new(["re", "im", "fourier", "multiplicity", "geometric"]);
        for e in &spectrum.eigenvalues {
            eigenvalues.push(vec![
                e.value.0.into(),
                e.value.1.into(),
                e.fourier.into(),
                e.multiplicity.into(),
                e.geometric.into(),
            ]);
        }
        let limits = Limits::new(system, &spectrum);
        let text = match self.output.format {
            Format::Json => {
                let mut object = head.json();
                object.insert("eigenvalues".to_owned(), eigenvalues.json());
                object.insert("limit_stencils".to_owned(), limits.json());
                object.insert("notes".to_owned(), json!(notes));
                pretty(&Value::Object(object))
            }
            Format::Text => format!(
                "{}{}\n{}\n{}",
                head.text(),
                notes.iter().map(|text| format!("note: {text}\n")).collect::<String>(),
                eigenvalues.render(Format::Text),
                limits.text()
            ),
            format => {
                notes.iter().for_each(|text| note(text));
                eigenvalues.render(format)
            }
        };
        files::emit(None, text.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The limit stencils, or why there are none.
struct Limits {
    position: Result<Vec<f64>, eigenring_spectral::Error>,
    tangents: Result<[Vec<f64>; 2], eigenring_spectral::Error>,
    /// Name and index of each point of sector 0 (and the centre), for people.
    points: Vec<(String, usize)>,
    all: Value,
}

impl Limits {
    fn new(system: &LocalSystem, spectrum: &Spectrum) -> Self {
        let numbering = system.numbering();
        let sites = numbering.sites();
        let name = |site: &eigenring_scheme::Site| match (site.x, site.y) {
            (0, 0) => "V".to_owned(),
            (x, y) => format!("P_i({},{})", x / 2, y / 2),
        };
        let lambda = spectrum
            .eigenvalues
            .iter()
            .find(|e| e.fourier == Some(1) && e.value.1 == 0.0);
        let tangents = match lambda {
            Some(lambda) => system.limit_tangents(lambda.value.0),
            None => Err(eigenring_spectral::Error::NotSymmetric),
        };
        Limits {
            position: system.limit_position(),
            tangents,
            points: sites
                .iter()
                .enumerate()
                .filter(|(_, site)| site.sector == 0)
                .map(|(index, site)| (name(site), index))
                .collect(),
            all: sites
                .iter()
                .map(|site| json!([site.sector, site.x / 2, site.y / 2]))
                .collect(),
        }
    }

    fn json(&self) -> Value {
        let errors = [self.position.as_ref().err(), self.tangents.as_ref().err()];
        let missing: Vec<String> = errors.into_iter().flatten().map(ToString::to_string).collect();
        json!({
            "points": self.all,
            "position": self.position.as_ref().ok(),
            "tangent_x": self.tangents.as_ref().ok().map(|t| &t[0]),
            "tangent_y": self.tangents.as_ref().ok().map(|t| &t[1]),
            "missing": missing,
        })
    }

    fn text(&self) -> String {
        let mut text = String::from(
            "limit stencils (weights in sector 0; tangents dual to the natural configuration with E_0 = (1,0))\n",
        );
        let mut table = Table::new(["point", "position", "tangent_x", "tangent_y"]);
        for (name, index) in &self.points {
            table.push(vec![
                name.as_str().into(),
                self.position.as_ref().ok().map(|p| p[*index]).into(),
                self.tangents.as_ref().ok().map(|t| t[0][*index]).into(),
                self.tangents.as_ref().ok().map(|t| t[1][*index]).into(),
            ]);
        }
        text.push_str(&table.render(Format::Text));
        for error in [self.position.as_ref().err(), self.tangents.as_ref().err()]
            .into_iter()
            .flatten()
        {
            text.push_str(&format!("not defined: {error}\n"));
        }
        text
    }
}

/// Reads a square matrix from CSV without header.
fn read_matrix(path: &Path) -> Result<Matrix<f64>, Error> {
    let text = files::read(path)?;
    let bad = |message: String| Error::BadFile {
        path: path.to_owned(),
        message,
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let record = record.map_err(|error| bad(error.to_string()))?;
        let row = record
            .iter()
            .enumerate()
            .map(|(column, entry)| match entry.parse::<f64>() {
                Ok(number) if number.is_finite() => Ok(number),
                _ => Err(bad(format!(
                    "row {}, column {}: '{entry}' is no number: accepted are finite ones",
                    index + 1,
                    column + 1
                ))),
            })
            .collect::<Result<Vec<f64>, Error>>()?;
        if let Some(first) = rows.first()
            && row.len() != first.len()
        {
            return Err(bad(format!(
                "row {} has {} entries, row 1 has {}: accepted are rows of equal length",
                index + 1,
                row.len(),
                first.len()
            )));
        }
        rows.push(row);
    }
    let columns = rows.first().map_or(0, Vec::len);
    Ok(Matrix::from_rows(rows, columns))
}
