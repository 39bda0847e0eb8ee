//! Eigenvalues, Fourier indices and limit stencils of a scheme's local matrix, or of a matrix that somebody
//! has.

use crate::error::Error;
use crate::schemes::{SchemeName, Tuner};
use crate::table::{Format, Record, Table, short};
use eigenring_scheme::{Corner, Lattice, Level, Scheme, Site, Symmetry};
use eigenring_spectral::{Eigenvalue, Extended, LocalSystem, Matrix, Spectrum, Sufficient, numbering, outer};
use serde_json::{Map, Value, json};

/// The most rings that are taken for meant: a block of 64 rings has 4160 rows.
pub const MAX_RINGS: usize = 64;

/// Entries of corresponding sectors in a matrix may differ by this much relative to the largest: files are
/// often printed to ten digits.
const CIRCULANT_TOLERANCE: f64 = 1e-9;

/// Row sums further than this from 1 are worth a warning: beyond the rounding of printed weights.
const AFFINE: f64 = 1e-12;

/// Fourier blocks, or a matrix without them, beyond this many entries (1.6 GB) are a typing error.
const MAX_ENTRIES: usize = 200_000_000;

/// Refuses blocks that are too large together.
fn check_size(level: &Level<f64>, rings: usize) -> Result<(), Error> {
    let (count, sectors) = (numbering(level, rings).count(), level.fan().sectors());
    let (size, blocks) = match level.symmetry() {
        Symmetry::None => (count, 1),
        _ => (count.div_ceil(sectors), sectors / 2 + 1),
    };
    if size.saturating_mul(size).saturating_mul(blocks) <= MAX_ENTRIES {
        return Ok(());
    }
    Err(Error::Range {
        what: "size of the blocks",
        given: format!("{blocks} of {size} x {size}"),
        accepted: format!("at most {MAX_ENTRIES} entries: fewer rings or a smaller valence"),
    })
}

/// Refuses rings out of range, given the smallest closed number.
///
/// # Errors
/// [`Error::Range`].
pub(crate) fn check_rings(rings: usize, closed: usize) -> Result<usize, Error> {
    if (closed..=MAX_RINGS).contains(&rings) {
        return Ok(rings);
    }
    Err(Error::Range {
        what: "number of rings",
        given: rings.to_string(),
        accepted: format!("{closed} (the smallest closed set) to {MAX_RINGS}"),
    })
}

/// A local matrix with its spectrum.
///
/// Eigenvalues stand by falling modulus, with their multiplicities in the whole matrix; one that blocks k and
/// N-k share is listed once, with `fourier = k <= N/2`.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// What it is the matrix of.
    pub name: String,
    /// What the scheme sees, in the words of [`Corner`]; `closed` for a matrix.
    pub corner: String,
    /// The matrix, in blocks where it has them.
    pub system: LocalSystem,
    /// The level of refinement, counted from 0, and how many come before the limit level; unknown for a
    /// matrix.
    pub level: Option<(usize, usize)>,
    /// The smallest closed number of rings, and the largest modulus of the eigenvalues outside of it; unknown
    /// for a matrix.
    pub closed: Option<(usize, f64)>,
    /// Its eigenvalues.
    pub spectrum: Spectrum,
}

impl Analysis {
    /// Analyses a level of a scheme, by default the limit level, on so many rings of control points: by
    /// default the smallest closed set, and one ring more where the eigenvalues outside of it are not
    /// strictly below the subsubdominant one.
    ///
    /// # Errors
    /// [`Error::Range`] for a number of rings that is not closed under refinement or beyond [`MAX_RINGS`];
    /// those of the decomposition.
    pub fn of_scheme(scheme: &Scheme<f64>, rings: Option<usize>, level: Option<usize>) -> Result<Self, Error> {
        Self::of_rules(scheme, None, rings, level)
    }

    /// The same with the rules in more precision too, from which multiplicities are told.
    ///
    /// # Errors
    /// As [`Analysis::of_scheme`].
    pub fn of_rules(
        scheme: &Scheme<f64>,
        extended: Option<&Scheme<Extended>>,
        rings: Option<usize>,
        level: Option<usize>,
    ) -> Result<Self, Error> {
        let leading = scheme.leading().len();
        // all levels from the limit level on are the same
        let number = level.map_or(leading, |level| level.min(leading));
        let level = scheme.level(number);
        let closed = scheme.closed_rings()?;
        check_size(level, rings.unwrap_or(closed))?;
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
        let spectrum = match extended {
            Some(extended) => system.spectrum_of(extended.level(number))?,
            None => system.spectrum()?,
        };
        Ok(Analysis {
            name: scheme.name().to_owned(),
            corner: "closed".to_owned(),
            spectrum,
            system,
            level: Some((number, leading)),
            closed: Some((closed, outer)),
        })
    }

    /// The same of a scheme by name around a corner, which is named in what is printed: what every command
    /// says of its eigenvalues.
    ///
    /// # Errors
    /// As [`Analysis::of_scheme`], and those of the name.
    pub fn of_name(
        name: &SchemeName,
        corner: &Corner,
        [rings, level]: [Option<usize>; 2],
        tuner: &Tuner<'_>,
    ) -> Result<Self, Error> {
        let (scheme, extended) = (name.around(corner, tuner)?, name.extended(corner)?);
        Ok(Analysis {
            corner: corner.to_string(),
            ..Self::of_rules(&scheme, extended.as_ref(), rings, level)?
        })
    }

    /// Analyses a matrix of a valence, whose points are in the order of the
    /// [`Numbering`](eigenring_scheme::Numbering), and whose entries are known to `rounding` relative to the
    /// largest.
    ///
    /// # Errors
    /// Those of [`LocalSystem::from_matrix`] and of the decomposition.
    pub fn of_matrix(
        name: impl Into<String>,
        matrix: &Matrix<f64>,
        valence: usize,
        rounding: f64,
    ) -> Result<Self, Error> {
        let system = LocalSystem::from_matrix(matrix, valence, CIRCULANT_TOLERANCE)?;
        let fourier = system.symmetric().then_some(valence);
        Ok(Analysis {
            name: name.into(),
            corner: "closed".to_owned(),
            spectrum: Spectrum::of_blocks(system.blocks(), fourier, rounding)?,
            system,
            level: None,
            closed: None,
        })
    }

    /// The largest modulus of the eigenvalues that are not listed: those of the rings outside.
    ///
    /// # Errors
    /// Those of [`outer`].
    pub fn beyond(&self, scheme: &Scheme<f64>) -> Result<f64, Error> {
        let rings = self.system.numbering().rings;
        Ok(match self.closed {
            Some((closed, outer)) if closed == rings => outer,
            _ => outer(scheme.limit(), rings)?,
        })
    }

    /// A warning if rows do not sum to 1.
    pub fn warning(&self) -> Option<String> {
        let defect = self.system.row_sum_defect();
        (defect > AFFINE)
            .then(|| format!("the rows of the local matrix do not sum to 1: the largest defect is {defect:e}"))
    }

    /// What the list of eigenvalues does not say by itself: rings beyond the smallest closed set, a defective
    /// subdominant eigenvalue.
    pub fn notes(&self) -> Vec<String> {
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
        if let Some((level, leading)) = self.level
            && leading > 0
        {
            notes.push(match leading - level {
                0 => format!(
                    "the limit level, which governs continuity; {leading} levels, 0 to {}, lead to it",
                    leading - 1
                ),
                _ => format!("a leading level; the limit level, which governs continuity, is {leading}"),
            });
        }
        if let Some(lambda) = self.spectrum.subdominant() {
            if let Some(index) = self.spectrum.stray() {
                notes.push(format!(
                    "the subdominant eigenvalue {} is of Fourier index {index}, not 1: there is no characteristic map, and \
                     neither s nor tangents have a meaning",
                    short(lambda.modulus()),
                ));
            }
            if lambda.value.im != 0.0 {
                notes.push(format!(
                    "the subdominant eigenvalue is complex, of modulus {}",
                    short(lambda.modulus())
                ));
            }
            // equal to the subdominant one, in any block
            let same = self.spectrum.eigenvalues.iter().filter(|e| e.is_close(lambda));
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

    /// Scheme, valence, rings and points, subdominant and subsubdominant eigenvalue (the modulus of a complex
    /// one), and their ratio s.
    pub fn head(&self) -> Record {
        let (numbering, spectrum) = (self.system.numbering(), &self.spectrum);
        let lattice = match numbering.lattice {
            Lattice::Vertex => "vertex",
            Lattice::Face => "face",
        };
        let signed = |e: &Eigenvalue| if e.value.im == 0.0 { e.value.re } else { e.modulus() };
        Record::default()
            .with("scheme", self.name.as_str())
            .with("corner", self.corner.as_str())
            .with("valence", self.system.valence())
            .with("lattice", lattice)
            .with("rings", numbering.rings)
            .with("level", self.level.map(|(level, _)| level))
            .with("closed_rings", self.closed.map(|(closed, _)| closed))
            .with("outer", self.closed.map(|(_, outer)| outer))
            .with("points", numbering.count())
            .with("subdominant", spectrum.subdominant().map(signed))
            .with("subsubdominant", spectrum.subsubdominant().map(signed))
            .with("s", spectrum.curvature_ratio())
    }

    /// The eigenvalues, by falling modulus.
    pub fn eigenvalues(&self) -> Table {
        let mut table = Table::new(["re", "im", "fourier", "multiplicity", "geometric", "jordan"]);
        for e in &self.spectrum.eigenvalues {
            table.push(vec![
                e.value.re.into(),
                e.value.im.into(),
                e.fourier.into(),
                e.multiplicity.into(),
                e.geometric.into(),
                self.jordan(e).into(),
            ]);
        }
        table
    }

    /// The sizes of an eigenvalue's Jordan blocks, falling, such as "2+1": those of one of two conjugate
    /// Fourier blocks. `None` where it has as many eigenvectors as its multiplicity.
    pub(crate) fn jordan(&self, eigenvalue: &Eigenvalue) -> Option<String> {
        let (index, n) = (eigenvalue.fourier.unwrap_or(0), self.system.valence());
        // block N-k is the conjugate of block k
        let (index, value) = if 2 * index > n {
            (n - index, eigenvalue.value.conj())
        } else {
            (index, eigenvalue.value)
        };
        let block = self.system.blocks().get(index)?;
        let sizes = eigenvalue.is_defective().then(|| block.jordan_sizes(value).ok())??;
        let texts: Vec<String> = sizes.iter().map(usize::to_string).collect();
        Some(texts.join("+"))
    }

    /// The limit stencils, as weights of all points; empty where one is not defined.
    pub fn limit_stencils(&self) -> Table {
        let Limits { position, tangents, .. } = Limits::new(self);
        let mut table = Table::new(["point", "sector", "a", "b", "position", "tangent_x", "tangent_y"]);
        for (index, site) in self.system.numbering().sites().iter().enumerate() {
            table.push(vec![
                index.into(),
                site.sector.into(),
                (site.x as usize / 2).into(),
                (site.y as usize / 2).into(),
                position.as_ref().ok().map(|p| p[index]).into(),
                tangents.as_ref().ok().map(|t| t[0][index]).into(),
                tangents.as_ref().ok().map(|t| t[1][index]).into(),
            ]);
        }
        table
    }

    /// The limit stencils as people read them: of sector 0 where it stands for all, with the names of the
    /// points; and why some are not defined.
    pub fn limit_stencils_for_people(&self) -> (Table, Vec<String>) {
        let limits = Limits::new(self);
        (limits.table(), limits.missing())
    }

    /// Everything as a JSON object.
    pub fn json(&self) -> Map<String, Value> {
        let mut object = self.head().json();
        object.insert("eigenvalues".to_owned(), self.eigenvalues().json());
        object.insert("limit_stencils".to_owned(), Limits::new(self).json());
        object.insert("notes".to_owned(), json!(self.notes()));
        object
    }

    /// Everything for people; of the limit stencils the weights in sector 0.
    pub fn text(&self) -> String {
        let notes = self.notes();
        format!(
            "{}{}\n{}\n{}",
            self.head().text(),
            notes.iter().map(|text| format!("note: {text}\n")).collect::<String>(),
            self.eigenvalues().render(Format::Text),
            Limits::new(self).text()
        )
    }
}

/// The limit stencils, or why there are none.
struct Limits {
    position: Result<Vec<f64>, eigenring_spectral::Error>,
    tangents: Result<[Vec<f64>; 2], eigenring_spectral::Error>,
    /// Whether sector 0 stands for all.
    symmetric: bool,
    /// Name and index of each point that is shown to people: of sector 0 where it stands for all, and the
    /// centre.
    points: Vec<(String, usize)>,
    all: Value,
}

impl Limits {
    fn new(analysis: &Analysis) -> Self {
        let system = &analysis.system;
        let sites = system.numbering().sites();
        let name = |site: &Site, symmetric: bool| match (site.x, site.y) {
            (0, 0) => "V".to_owned(),
            (x, y) if symmetric => format!("P_i({},{})", x / 2, y / 2),
            (x, y) => format!("P_{}({},{})", site.sector, x / 2, y / 2),
        };
        let symmetric = system.symmetric();
        // a complex one of block 1 alone has its conjugate in block N-1, and a tangent plane too
        let mut leading = analysis.spectrum.eigenvalues.iter().filter(|e| e.fourier == Some(1));
        let lambda = leading.find(|e| e.value.im == 0.0 || e.blocks == 1);
        let stray = analysis.spectrum.stray().zip(analysis.spectrum.subdominant());
        let tangents = match lambda {
            _ if stray.is_some() => Err(eigenring_spectral::Error::Stray {
                value: stray.map_or(f64::NAN, |(_, e)| e.modulus()),
                fourier: stray.map_or(0, |(index, _)| index),
            }),
            Some(lambda) => system.complex_tangents(lambda.value),
            // without blocks: of the pair after 1, equal or not
            None => system.pair_functionals(&analysis.spectrum),
        };
        Limits {
            position: system.limit_position(),
            tangents,
            symmetric,
            points: sites
                .iter()
                .enumerate()
                .filter(|(_, site)| !symmetric || site.sector == 0)
                .map(|(index, site)| (name(site, symmetric), index))
                .collect(),
            all: sites
                .iter()
                .map(|site| json!([site.sector, site.x / 2, site.y / 2]))
                .collect(),
        }
    }

    fn json(&self) -> Value {
        let missing = self.missing();
        json!({
            "points": self.all,
            "position": self.position.as_ref().ok(),
            "tangent_x": self.tangents.as_ref().ok().map(|t| &t[0]),
            "tangent_y": self.tangents.as_ref().ok().map(|t| &t[1]),
            "missing": missing,
        })
    }

    /// Why stencils are not defined.
    fn missing(&self) -> Vec<String> {
        let errors = [self.position.as_ref().err(), self.tangents.as_ref().err()];
        errors.into_iter().flatten().map(ToString::to_string).collect()
    }

    fn table(&self) -> Table {
        let mut table = Table::new(["point", "position", "tangent_x", "tangent_y"]);
        for (name, index) in &self.points {
            table.push(vec![
                name.as_str().into(),
                self.position.as_ref().ok().map(|p| p[*index]).into(),
                self.tangents.as_ref().ok().map(|t| t[0][*index]).into(),
                self.tangents.as_ref().ok().map(|t| t[1][*index]).into(),
            ]);
        }
        table
    }

    fn text(&self) -> String {
        let mut text = if self.symmetric {
            "limit stencils (weights in sector 0; tangents dual to the natural configuration with E_0 = (1,0))\n"
        } else {
            "limit stencils (weights in all sectors; tangents dual to the eigenvectors of the pair)\n"
        }
        .to_owned();
        text.push_str(&self.table().render(Format::Text));
        for error in self.missing() {
            text.push_str(&format!("not defined: {error}\n"));
        }
        text
    }
}
