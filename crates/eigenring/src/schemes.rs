//! Schemes and stencils by name, as the command line gives them.
//!
//! Beyond what [`Spec`] knows, the command reads scheme files (`file:PATH`), and where the lambda-scheme's table does not
//! reach it tunes: stencils found that way are remembered in the user's cache folder.

use crate::cache::Cache;
use crate::error::Error;
use crate::progress::note;
use crate::run::minima_over_lambda;
use crate::table::short;
use eigenring_scheme::lambda::{Bounds, Domain, LambdaTable, Plane, Relaxation};
use eigenring_scheme::user::{Reading, UserScheme};
use eigenring_scheme::{Scheme, Spec};
use eigenring_tune::sweep::{Options, Problem};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Weights given by users may miss a bound by this much: they are often printed to seven digits.
const FEASIBILITY_TOLERANCE: f64 = 1e-6;

/// A stencil of the lambda-scheme.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Valence, lambda, s and phi.
    pub plane: Plane<f64>,
    /// The first free weight.
    pub f2: f64,
    /// The second.
    pub f3: f64,
    /// Where the weights come from.
    pub source: Source,
}

/// Where weights come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The command line.
    Given,
    /// The embedded spline table.
    Table,
    /// Tuning on demand, now or on an earlier run.
    Tuned,
}

impl Source {
    /// The word that is printed.
    pub fn name(self) -> &'static str {
        match self {
            Source::Given => "given",
            Source::Table => "table",
            Source::Tuned => "tuned",
        }
    }
}

/// Refuses lambdas where the rule of a large valence asks for a mu that is not below lambda.
pub fn check_rule(valence: usize, lambda: f64) -> Result<(), Error> {
    let s = Relaxation::new(valence)?.s(lambda)?;
    if s * lambda < 1.0 {
        return Ok(());
    }
    Err(Error::Usage {
        message: format!(
            "at N = {valence}, lambda = {lambda} the rule for s gives {s}, which is not below 1/lambda = {}",
            1.0 / lambda
        ),
        accepted: "a smaller valence".to_owned(),
    })
}

/// The plane at lambda with the given s, or the one of the rule.
pub fn plane(valence: usize, lambda: f64, s: Option<f64>, phi: f64) -> Result<Plane<f64>, Error> {
    let mut plane = match s {
        Some(s) => Plane::new(valence, lambda, s)?,
        None => {
            check_rule(valence, lambda)?;
            Relaxation::new(valence)?.plane(lambda)?
        }
    };
    plane.phi = phi;
    Ok(plane)
}

impl Point {
    /// A stencil whose weights the user gives; they must be feasible.
    pub fn given(valence: usize, lambda: f64, s: Option<f64>, phi: f64, f2: f64, f3: f64) -> Result<Self, Error> {
        let plane = plane(valence, lambda, s, phi)?;
        let domain = Domain::new(plane, Bounds::Sharp, 0.0)?;
        domain.check(f2, f3, FEASIBILITY_TOLERANCE)?;
        // at valence 4 f3 is mu; only the exact value has the demanded eigenvalues
        let f3 = if valence == 4 { plane.mu() } else { f3 };
        Ok(Point {
            plane,
            f2,
            f3,
            source: Source::Given,
        })
    }
}

/// Finds stencils of the lambda-scheme: in the embedded table, in the cache, or by tuning.
#[derive(Debug, Default)]
pub struct Tuner {
    cache: Cache,
}

/// A tuned stencil as it is remembered.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Tuned {
    lambda: f64,
    s: f64,
    f2: f64,
    f3: f64,
    total: f64,
}

impl Tuner {
    /// The stencil at lambda: that of the table where it reaches and s is that of the rule, else a tuned one.
    pub fn point(&self, valence: usize, lambda: f64, s: Option<f64>) -> Result<Point, Error> {
        let plane = plane(valence, lambda, s, 6.0)?;
        let tabulated = LambdaTable::embedded()?.entry(valence).ok();
        if let (None, Some(entry)) = (s, tabulated)
            && (entry.knots.a..=entry.knots.e).contains(&lambda)
        {
            let (f2, f3) = entry.weights(lambda)?;
            return Ok(Point {
                plane,
                f2,
                f3,
                source: Source::Table,
            });
        }
        let key = format!("N{valence}-lambda{lambda}-s{}", plane.s);
        let given = s.map_or(String::new(), |s| format!(", s = {s}"));
        let tuned = self.remembered(&key, &format!("N = {valence}, lambda = {lambda}{given}"), || {
            let options = Options::default();
            let found = Problem::on_plane(plane, &options)?.search(options.starts)?;
            let best = found.lowest();
            Ok(Tuned {
                lambda,
                s: plane.s,
                f2: best.f2,
                f3: best.f3,
                total: best.total,
            })
        })?;
        Ok(Point {
            plane,
            f2: tuned.f2,
            f3: tuned.f3,
            source: Source::Tuned,
        })
    }

    /// The globally optimal stencil of a valence.
    pub fn optimal(&self, valence: usize) -> Result<Point, Error> {
        if let Ok(entry) = LambdaTable::embedded()?.entry(valence) {
            return self.point(valence, entry.lambda_optimal, None);
        }
        let key = format!("N{valence}-optimal");
        let tuned = self.remembered(&key, &format!("the optimal stencil of N = {valence}"), || {
            let (found, _) = minima_over_lambda(valence, &Options::default())?;
            let best = found.optimum();
            Ok(Tuned {
                lambda: best.lambda,
                s: best.s,
                f2: best.minimum.f2,
                f3: best.minimum.f3,
                total: best.minimum.total,
            })
        })?;
        Ok(Point {
            plane: plane(valence, tuned.lambda, Some(tuned.s), 6.0)?,
            f2: tuned.f2,
            f3: tuned.f3,
            source: Source::Tuned,
        })
    }

    fn remembered(&self, key: &str, what: &str, tune: impl FnOnce() -> Result<Tuned, Error>) -> Result<Tuned, Error> {
        if let Some(tuned) = self.cache.get::<Tuned>(key) {
            note(&format!(
                "{what} is not tabulated; remembered from an earlier run, E = {}",
                short(tuned.total)
            ));
            return Ok(tuned);
        }
        let tuned = tune()?;
        let kept = self.cache.put(key, &tuned);
        let place = kept.map_or("not kept: no cache folder can be written".to_owned(), |path| {
            format!("kept in {}", path.display())
        });
        note(&format!(
            "{what} is not tabulated; tuned now, E = {} ({place})",
            short(tuned.total)
        ));
        Ok(tuned)
    }
}

/// A scheme on the command line: a [`Spec`] or `file:PATH`.
#[derive(Clone, Debug)]
pub enum SchemeArg {
    /// A registered scheme.
    Spec(Spec),
    /// A scheme file.
    File(PathBuf),
}

impl FromStr for SchemeArg {
    type Err = eigenring_scheme::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.strip_prefix("file:") {
            Some(path) => Ok(SchemeArg::File(PathBuf::from(path))),
            None => Ok(SchemeArg::Spec(text.parse()?)),
        }
    }
}

impl SchemeArg {
    /// The scheme around a centre of the given valence.
    pub fn scheme(&self, valence: usize) -> Result<Scheme<f64>, Error> {
        match self {
            SchemeArg::File(path) => {
                // every command reads a file's weights alike
                let scheme = read_scheme(path, Reading::default())?;
                Ok(scheme.scheme(valence)?)
            }
            SchemeArg::Spec(spec) => match self.lambda_point(valence)? {
                Some(point) => {
                    let weights = point.plane.stencil(point.f2, point.f3).weights;
                    Ok(weights.scheme(spec.to_string(), valence)?)
                }
                None => Ok(spec.scheme(valence)?),
            },
        }
    }

    /// The stencil, if it is one of the lambda-scheme.
    pub fn lambda_point(&self, valence: usize) -> Result<Option<Point>, Error> {
        match self {
            SchemeArg::Spec(Spec::LambdaOptimal) => Tuner::default().optimal(valence).map(Some),
            &SchemeArg::Spec(Spec::Lambda {
                lambda,
                s,
                weights: None,
            }) => Tuner::default().point(valence, lambda, s).map(Some),
            &SchemeArg::Spec(Spec::Lambda {
                lambda,
                s,
                weights: Some((f2, f3)),
            }) => Ok(Some(Point {
                // weights in a spec are taken as they are: what they violate is for the analysis to show
                plane: plane(valence, lambda, s, 6.0)?,
                f2,
                f3,
                source: Source::Given,
            })),
            _ => Ok(None),
        }
    }
}

/// Reads a scheme file.
pub fn read_scheme(path: &Path, reading: Reading) -> Result<UserScheme, Error> {
    let text = crate::files::read(path)?;
    let name = path.file_stem().map_or("scheme".into(), |stem| stem.to_string_lossy());
    UserScheme::parse(&text, &name, reading).map_err(|error| Error::BadFile {
        path: path.to_owned(),
        message: error.to_string(),
    })
}

/// Splits a list of specs at commas; a comma followed by `name=value` continues a spec's parameters.
pub fn split(list: &str) -> Vec<String> {
    let mut specs: Vec<String> = Vec::new();
    for part in list.split(',') {
        let continues = part.contains('=') && !part.contains(':');
        match specs.last_mut() {
            Some(spec) if continues => {
                spec.push(',');
                spec.push_str(part);
            }
            _ => specs.push(part.to_owned()),
        }
    }
    specs
}

/// Schemes as a list, with their specs.
#[derive(Clone, Debug)]
pub struct SchemeList(pub Vec<(String, SchemeArg)>);

impl FromStr for SchemeList {
    type Err = eigenring_scheme::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = |spec: String| {
            let scheme = spec.parse()?;
            Ok((spec, scheme))
        };
        split(text)
            .into_iter()
            .map(parse)
            .collect::<Result<_, _>>()
            .map(SchemeList)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_specs_keep_parameters_together() {
        assert_eq!(
            split("catmull-clark,tension:order=6,u0=2,lambda:lambda=0.5,f2=0.2,f3=0.1,file:a.toml,lambda:optimal"),
            [
                "catmull-clark",
                "tension:order=6,u0=2",
                "lambda:lambda=0.5,f2=0.2,f3=0.1",
                "file:a.toml",
                "lambda:optimal"
            ]
        );
    }

    #[test]
    fn weights_of_users_must_be_feasible() {
        assert!(Point::given(6, 0.55, None, 6.0, 0.25, 0.2).is_ok());
        let error = Point::given(6, 0.55, None, 6.0, 0.9, 0.1).unwrap_err();
        assert!(
            error.line().contains("f1") && error.accepted().is_some(),
            "{}",
            error.line()
        );
        assert!(Point::given(6, f64::NAN, None, 6.0, 0.25, 0.2).is_err());
        assert!(Point::given(6, 0.55, None, 6.0, f64::NAN, 0.2).is_err());
        // valence 4: f3 must be mu, and is set to it exactly
        let point = Point::given(4, 0.5, None, 6.0, 0.25, 0.25 + 1e-8).unwrap();
        assert_eq!(point.f3, 0.25);
        assert!(Point::given(4, 0.5, None, 6.0, 0.25, 0.26).is_err());
    }
}
