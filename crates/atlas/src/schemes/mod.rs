//! Schemes by name, from files, and tuned on demand.
//!
//! A [`SchemeName`] is a [`Spec`] or `file:PATH`. Names of the lambda-scheme are resolved by
//! [`Spec::member`], which every caller shares; what the embedded table does not hold is asked of a
//! [`Tuner`], which remembers what it found.

mod list;
mod tuner;

pub use list::SchemeList;
pub(crate) use list::specs;
pub use tuner::{Tuner, feasible};

use crate::error::Error;
use eigenring_nonuniform::{NAMES, Scheme as NonUniform};
use eigenring_scheme::lambda::Member;
use eigenring_scheme::user::{Reading, UserScheme};
use eigenring_scheme::{Centre, Corner, Definition, Number, Scheme, Spec, registry};
use eigenring_spectral::Extended;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A scheme by name: a [`Spec`], or `file:PATH` for a scheme file.
///
/// ```
/// use eigenring_atlas::schemes::{SchemeName, Tuner};
///
/// let name: SchemeName = "tension:order=6,u0=2".parse()?;
/// assert_eq!(name.scheme(5, &Tuner::default())?.degree(), Some(5));
/// # Ok::<(), eigenring_atlas::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum SchemeName {
    /// A registered scheme.
    Spec(Spec),
    /// A scheme file.
    File(SchemeFile),
    /// A scheme whose rules depend on knot intervals.
    NonUniform(NonUniform),
}

/// A scheme file, with values for its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct SchemeFile {
    /// The file.
    pub path: PathBuf,
    /// Parameters that are set.
    pub values: Vec<(String, Number)>,
}

/// The largest valence that is asked for. Local matrices grow with the square of the valence, and nothing
/// beyond is met in practice.
pub const MAX_VALENCE: usize = 1000;

/// How a scheme file is named.
const FILE: &str = "file:SCHEME.toml[,parameter=value,..]";

impl SchemeFile {
    /// Reads what follows `file:`.
    fn parse(text: &str) -> Result<Self, eigenring_scheme::Error> {
        // a path may hold anything, between quotes even commas
        let (path, rest) = match text.strip_prefix('"').and_then(|inner| inner.split_once('"')) {
            Some((path, rest)) => (path, rest.strip_prefix(',').unwrap_or(rest)),
            None if Path::new(text).is_file() => (text, ""),
            None => text.split_once(',').unwrap_or((text, "")),
        };
        let refuse = |reason: String| eigenring_scheme::Error::Spec {
            spec: format!("file:{text}"),
            reason,
            accepted: FILE.to_owned(),
        };
        if path.is_empty() {
            return Err(refuse("no path is given".to_owned()));
        }
        let pieces = rest.split(',').filter(|piece| !piece.is_empty());
        let values = pieces.map(|piece| setting(piece).map_err(refuse));
        Ok(SchemeFile {
            path: PathBuf::from(path),
            values: values.collect::<Result<_, _>>()?,
        })
    }

    /// The file with its parameters set. It is named after its file unless it names itself.
    ///
    /// # Errors
    /// As [`read_scheme`]; a parameter that the file does not have, or a value out of its range.
    pub fn read(&self, reading: Reading) -> Result<UserScheme, Error> {
        let scheme = read_scheme(&self.path, reading)?;
        scheme
            .with(&self.values)
            .map_err(|error| Error::from(error).in_file(&self.path))
    }
}

/// Reads `name=value`.
///
/// # Errors
/// What is wrong with it, without what is accepted.
pub fn setting(text: &str) -> Result<(String, Number), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| format!("'{text}' sets no parameter"))?;
    let value = value.trim().parse::<Number>();
    let value = value.map_err(|_| format!("'{text}' gives no number"))?;
    Ok((name.trim().to_owned(), value))
}

impl FromStr for SchemeName {
    type Err = eigenring_scheme::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if let Some(file) = text.strip_prefix("file:") {
            return SchemeFile::parse(file).map(SchemeName::File);
        }
        let name = text.split(':').next().unwrap_or_default();
        if NAMES.iter().any(|(known, _)| known.split('[').next() == Some(name)) {
            return text.parse().map(SchemeName::NonUniform);
        }
        let spec = text.parse().map_err(|error| match error {
            // a name of no family is likely that of a file
            eigenring_scheme::Error::Spec { spec, reason, accepted } if !is_family(&spec) => {
                let meant = match spec.ends_with(".toml") {
                    true => format!(" (did you mean 'file:{spec}'?)"),
                    false => String::new(),
                };
                eigenring_scheme::Error::Spec {
                    spec,
                    reason: reason + &meant,
                    accepted: format!("{accepted} | {} | {FILE}", NAMES.map(|(name, _)| name).join(" | ")),
                }
            }
            other => other,
        })?;
        Ok(SchemeName::Spec(spec))
    }
}

/// Whether a spec begins with the name of a family.
fn is_family(spec: &str) -> bool {
    let name = spec.split(':').next();
    registry().iter().any(|family| Some(family.name) == name)
}

impl SchemeName {
    /// The scheme around a centre of the given valence. A file is read with the default [`Reading`].
    ///
    /// # Errors
    /// Those of the rules; [`Error::Read`] and [`Error::InFile`] for a file; those of the tuning where the
    /// lambda-scheme is not tabulated.
    pub fn scheme(&self, valence: usize, tuner: &Tuner<'_>) -> Result<Scheme<f64>, Error> {
        match self {
            SchemeName::File(file) => self.blamed(file.read(Reading::default())?.scheme(valence)),
            SchemeName::Spec(spec) => match tuner.member(spec, valence)? {
                Some(member) => Ok(member.scheme(spec.to_string())?),
                None => Ok(spec.scheme(valence)?),
            },
            SchemeName::NonUniform(scheme) => Ok(scheme.around(&Corner::closed(self.centre()?, valence)?)?),
        }
    }

    /// The same scheme with parameters of its file set.
    ///
    /// # Errors
    /// [`Error::Usage`] for a scheme that is no file.
    pub fn setting(mut self, values: &[(String, Number)]) -> Result<Self, Error> {
        match &mut self {
            _ if values.is_empty() => {}
            SchemeName::File(file) => file.values.extend(values.iter().cloned()),
            SchemeName::Spec(spec) => {
                return Err(Error::Usage {
                    message: format!("--set has no meaning for {spec}"),
                    accepted: "--set with file:SCHEME.toml; families have their parameters in the name".to_owned(),
                });
            }
            SchemeName::NonUniform(scheme) => {
                return Err(Error::Usage {
                    message: format!("--set has no meaning for {scheme}"),
                    accepted: "--set with file:SCHEME.toml; knot intervals are given by --knots or the mesh".to_owned(),
                });
            }
        }
        Ok(self)
    }

    /// The scheme at all corners, as far as it is known without tuning. A file is read now, and no more.
    ///
    /// # Errors
    /// As [`read_scheme`].
    pub fn definition(&self, reading: Reading) -> Result<Definition, Error> {
        match self {
            SchemeName::Spec(spec) => Ok(Definition::Family(spec.clone())),
            SchemeName::File(file) => Ok(Definition::File(Box::new(file.read(reading)?))),
            SchemeName::NonUniform(scheme) => Err(Error::Usage {
                message: format!("{scheme} has no rules without knot intervals, and this command takes none"),
                accepted: "subdivide, limit, spectrum, matrix, eigenvectors, verify and blending with it".to_owned(),
            }),
        }
    }

    /// The scheme around a corner. Around a centre without creases and knot intervals it is that of
    /// [`SchemeName::scheme`]; around others nothing is tuned.
    ///
    /// # Errors
    /// As [`SchemeName::scheme`]; [`eigenring_scheme::Error::Unsupported`] for a kind of corner that the
    /// scheme has no rules for.
    pub fn around(&self, corner: &Corner, tuner: &Tuner<'_>) -> Result<Scheme<f64>, Error> {
        if let SchemeName::NonUniform(scheme) = self {
            return Ok(scheme.around(corner)?);
        }
        let definition = self.definition(Reading::default())?;
        if let SchemeName::Spec(spec) = self
            && corner.is_plain()
            && corner.centre() == definition.centre()
            && let Some(member) = tuner.member(spec, corner.sectors().sectors())?
        {
            return Ok(member.scheme(spec.to_string())?);
        }
        self.blamed(definition.around(corner))
    }

    /// What went wrong with the rules, with the file that they are of.
    ///
    /// # Errors
    /// Those of the result.
    pub fn blamed<T, E: Into<Error>>(&self, result: Result<T, E>) -> Result<T, Error> {
        result.map_err(|error| match self {
            SchemeName::File(file) => error.into().in_file(&file.path),
            SchemeName::Spec(_) | SchemeName::NonUniform(_) => error.into(),
        })
    }

    /// The rules around a corner in numbers from which multiplicities can be told; `None` for a member of the
    /// lambda-scheme, whose weights are results of rounding.
    ///
    /// # Errors
    /// As [`SchemeName::around`].
    pub fn extended(&self, corner: &Corner) -> Result<Option<Scheme<Extended>>, Error> {
        let lambda = matches!(self, SchemeName::Spec(Spec::LambdaOptimal | Spec::Lambda { .. }));
        if (lambda && corner.is_plain()) || matches!(self, SchemeName::NonUniform(_)) {
            return Ok(None);
        }
        let definition = self.definition(Reading::default())?;
        self.blamed(definition.around(corner)).map(Some)
    }

    /// The valence that a scheme file is for, if it is for one alone.
    ///
    /// # Errors
    /// Those of reading the file.
    pub fn only_valence(&self) -> Result<Option<usize>, Error> {
        let SchemeName::File(file) = self else { return Ok(None) };
        let scheme = file.read(Reading::default())?;
        let mut listed = scheme.valences();
        Ok(match (listed.next(), listed.next(), scheme.rule()) {
            (only, None, None) => only,
            _ => None,
        })
    }

    /// What the scheme has in the middle of its closed fans.
    ///
    /// # Errors
    /// Those of reading a file.
    pub fn centre(&self) -> Result<Centre, Error> {
        Ok(match self {
            SchemeName::NonUniform(scheme) => scheme.centre(),
            _ => self.definition(Reading::default())?.centre(),
        })
    }

    /// The member of the lambda-scheme that is named, if it is one.
    ///
    /// # Errors
    /// As [`Tuner::member`].
    pub fn member(&self, valence: usize, tuner: &Tuner<'_>) -> Result<Option<Member>, Error> {
        match self {
            SchemeName::Spec(spec) => tuner.member(spec, valence),
            SchemeName::File(_) | SchemeName::NonUniform(_) => Ok(None),
        }
    }
}

/// What schemes are called side by side, given their names: the path follows the name of a file if another
/// scheme has the same.
pub fn distinct(schemes: &[SchemeName], names: &[&str]) -> Vec<String> {
    let shared = |name: &str| names.iter().filter(|other| **other == name).count() > 1;
    let pairs = schemes.iter().zip(names);
    pairs
        .map(|(scheme, &name)| match scheme {
            SchemeName::File(file) if shared(name) => format!("{name} ({})", file.path.display()),
            _ => name.to_owned(),
        })
        .collect()
}

/// Reads a scheme file, which is named after its file unless it names itself.
///
/// # Errors
/// [`Error::Read`], and [`Error::InFile`] with what is wrong in it.
pub fn read_scheme(path: &Path, reading: Reading) -> Result<UserScheme, Error> {
    let text = crate::files::read(path)?;
    UserScheme::parse(&text, &stem(path), reading).map_err(|error| Error::from(error).in_file(path))
}

/// The name of a scheme file without folder and extension.
pub(crate) fn stem(path: &Path) -> String {
    path.file_stem()
        .map_or("scheme".into(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::lambda::Source;

    #[test]
    fn names_of_no_family_list_files_too() {
        for (text, meant) in [
            ("catmul-clark", "did you mean 'catmull-clark'?"),
            ("mine.toml", "did you mean 'file:mine.toml'?"),
            ("nonsense", "no such family"),
        ] {
            let message = text.parse::<SchemeName>().unwrap_err().to_string();
            assert!(
                message.contains(meant) && message.ends_with("| file:SCHEME.toml[,parameter=value,..]"),
                "{message}"
            );
        }
        let message = "tension:odrer=4".parse::<SchemeName>().unwrap_err().to_string();
        assert!(
            message.contains("'odrer' (did you mean 'order'?)") && !message.contains("file:"),
            "{message}"
        );
    }

    /// A name means the same to the libraries below and to a tuner, wherever both give it a meaning.
    #[test]
    fn names_mean_the_same_with_and_without_a_tuner() {
        let tuner = Tuner::default();
        for spec in [
            "lambda:optimal",
            "lambda:lambda=0.5",
            "lambda:lambda=0.55,f2=0.25,f3=0.2,s=1.1",
        ] {
            let name: SchemeName = spec.parse().unwrap();
            let spec: Spec = spec.parse().unwrap();
            for valence in [3, 4, 6, 20] {
                let (a, b) = (
                    name.scheme(valence, &tuner).unwrap(),
                    spec.scheme::<f64>(valence).unwrap(),
                );
                assert_eq!(a.name(), b.name());
                for (a, b) in a.limit().passes().iter().zip(b.limit().passes()) {
                    assert!(a.special() == b.special(), "{spec} at N = {valence}");
                }
            }
        }
        // around a plain corner it is the same scheme, and around others the family's
        let name: SchemeName = "lambda:optimal".parse().unwrap();
        let corner = Corner::closed(Centre::Vertex, 6).unwrap();
        let (a, b) = (name.around(&corner, &tuner).unwrap(), name.scheme(6, &tuner).unwrap());
        assert!(a.limit().passes()[0].special() == b.limit().passes()[0].special());
        assert!(name.around(&Corner::fan(2).unwrap(), &tuner).is_ok());
        // where only the tuner can help, the libraries refuse
        for (spec, valence) in [
            ("lambda:optimal", 22),
            ("lambda:lambda=0.92", 5),
            ("lambda:lambda=0.5,s=1.3", 5),
        ] {
            assert!(spec.parse::<Spec>().unwrap().scheme::<f64>(valence).is_err());
        }
        let tuned = tuner.at(5, 0.5, Some(1.3)).unwrap();
        assert_eq!((tuned.source, tuned.plane.s), (Source::Tuned, 1.3));
    }
}
