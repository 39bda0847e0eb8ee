//! `eigenring verify`: certificates.

mod all;
mod report;

use crate::args::{self, Output, Valences};
use crate::error::Error;
use crate::files;
use crate::progress::note;
use crate::schemes::{SchemeArg, read_scheme};
use clap::{ArgGroup, Args, ValueEnum};
use eigenring_certify::range::{Curve, Limits, RangeCertificate, prove_range, recheck_range_text};
use eigenring_certify::{Certificate, Input, Requirement, Status, certify, recheck_text};
use eigenring_scheme::Spec;
use eigenring_scheme::user::Reading;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Prove that a scheme is C1, or has bounded curvature, at a valence or over a range of lambda.
///
/// What is certified is the exact scheme: decimals and fractions stand for themselves. Each statement is proven, refuted with
/// a witness, undecided, or, for weights that are results of rounding, numerical. The exit code is 0 if everything that
/// is required is proven, and 1 if not. docs/certificates.md says what each statement means and which theorems are used.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("what").required(true).multiple(true))]
#[command(
    after_help = "Examples:\n  eigenring verify --scheme catmull-clark -N 5\n  eigenring verify --scheme lambda:optimal -N 6 --require strict\n  eigenring verify --lambda-range 0.4..0.6 -N 6 --require strict\n  eigenring verify --scheme catmull-clark -N 3 --format json\n  eigenring verify --scheme catmull-clark -N 7 -o N7.json      (and then: eigenring verify --recheck N7.json)\n  eigenring verify --all                                       rebuilds results/certificates"
)]
pub struct Arguments {
    /// The scheme: see 'eigenring --help'; with --lambda-range its weights f2 and f3 are kept, by default those of the splines
    #[arg(long, value_name = "SPEC", group = "what", conflicts_with_all = ["recheck", "all"])]
    scheme: Option<SchemeArg>,
    /// Valence
    #[arg(short = 'N', long, value_name = "N", value_parser = args::valence, allow_negative_numbers = true, conflicts_with_all = ["recheck", "all"])]
    valence: Option<usize>,
    /// The lambda-scheme for every lambda from A to B
    #[arg(long, value_name = "A..B", group = "what", value_parser = range, allow_hyphen_values = true, conflicts_with_all = ["recheck", "all"])]
    lambda_range: Option<[f64; 2]>,
    /// What must be proven
    #[arg(long, value_enum, default_value_t)]
    require: Required,
    /// Take the weights of a file as they are written: by default the special stencils' sums within 1e-12 of 1, and
    /// weights that a reflection exchanges (at the centre also a rotation) and that differ by no more, are taken
    /// for rounded and balanced
    #[arg(long, conflicts_with_all = ["recheck", "all", "lambda_range"])]
    exact: bool,
    /// Also store the certificate
    #[arg(short, long, value_name = "FILE", conflicts_with_all = ["recheck", "all"])]
    output: Option<PathBuf>,
    /// Check a stored certificate again, or all that a folder holds, by its evidence alone
    #[arg(long, value_name = "PATH", group = "what", conflicts_with = "all")]
    recheck: Option<PathBuf>,
    /// Make the certificates of results/certificates: Catmull-Clark, featured members of the lambda-scheme, and ranges of lambda
    #[arg(long, group = "what")]
    all: bool,
    /// With --all: valences of the lambda-scheme
    #[arg(
        long,
        value_name = "LIST",
        default_value = "3..20",
        allow_hyphen_values = true,
        requires = "all"
    )]
    valences: Valences,
    /// With --all: output folder; files go to its subfolder certificates
    #[arg(long, value_name = "FOLDER", default_value = "results", requires = "all")]
    out: PathBuf,
    #[command(flatten)]
    format: Output,
}

/// Degrees from which a certificate takes ten seconds or more: 11 s at order 14, minutes at order 22.
const LARGE: usize = 13;

/// See [`Requirement`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Required {
    /// Rows sum to 1, eigenvalues 1 and lambda dominate, the characteristic map is regular and injective.
    #[default]
    C1,
    /// C1, and no further eigenvalue exceeds lambda^2 in modulus.
    Bounded,
    /// Bounded, and the eigenvalues after mu are smaller than mu.
    Strict,
    /// No weight is negative.
    Hull,
}

impl From<Required> for Requirement {
    fn from(required: Required) -> Self {
        match required {
            Required::C1 => Requirement::C1,
            Required::Bounded => Requirement::Bounded,
            Required::Strict => Requirement::Strict,
            Required::Hull => Requirement::Hull,
        }
    }
}

/// Reads `A..B`; which values are accepted depends on the scheme.
fn range(text: &str) -> Result<[f64; 2], String> {
    let refuse = || "accepted is A..B with A < B, such as 0.4..0.6".to_owned();
    let (start, end) = text.split_once("..").ok_or_else(refuse)?;
    let number = |text: &str| args::finite(text.trim()).map_err(|_| refuse());
    let (start, end) = (number(start)?, number(end)?);
    if start < end { Ok([start, end]) } else { Err(refuse()) }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        if let Some(path) = &self.recheck {
            return self.check_again(path);
        }
        if self.all {
            all::make(&self.valences.0, &self.out)?;
            return Ok(ExitCode::SUCCESS);
        }
        let valence = self.valence.ok_or_else(|| Error::Usage {
            message: "no valence is given".to_owned(),
            accepted: format!("-N with 3 to {}", args::MAX_VALENCE),
        })?;
        match self.lambda_range {
            Some(lambda) => self.over_range(valence, lambda),
            None => self.at_valence(valence),
        }
    }

    fn at_valence(&self, valence: usize) -> Result<ExitCode, Error> {
        let scheme = self.scheme.as_ref().ok_or_else(|| Error::Usage {
            message: "no scheme is given".to_owned(),
            accepted: "--scheme SPEC".to_owned(),
        })?;
        let reading = if self.exact { Reading::Exact } else { Reading::Balanced };
        let input = input(scheme, valence, reading)?;
        if scheme.scheme(valence)?.degree().is_some_and(|degree| degree >= LARGE) {
            note("patches of high degree have large blocks: this may take minutes");
        }
        let certificate = certify(input, valence)?;
        if let Some(path) = &self.output {
            files::write(path, certificate.to_json()?.as_bytes())?;
        }
        let requirement = self.require.into();
        files::emit(
            None,
            report::certificate(&certificate, requirement, self.format.format).as_bytes(),
        )?;
        if let Some(balanced) = certificate.balanced {
            note(&format!(
                "rounded weights were balanced: {} stencils, the largest change is {:e}; --exact takes them as written",
                balanced.rows, balanced.largest
            ));
        }
        let (_, status) = requirement.verdict(&certificate.checks);
        if status == Status::Numerical {
            note("holds for weights that are results of rounding; of the exact scheme nothing is proven");
        }
        Ok(exit(status == Status::Proven))
    }

    fn over_range(&self, valence: usize, lambda: [f64; 2]) -> Result<ExitCode, Error> {
        let curve = match &self.scheme {
            None
            | Some(SchemeArg::Spec(
                Spec::LambdaOptimal
                | Spec::Lambda {
                    weights: None, s: None, ..
                },
            )) => Curve::embedded(valence)?,
            Some(SchemeArg::Spec(Spec::Lambda {
                weights: Some((f2, f3)),
                s: None,
                ..
            })) => Curve::Constant { f2: *f2, f3: *f3 },
            Some(_) => {
                return Err(Error::Usage {
                    message: "a range of lambda is for the lambda-scheme with s by its rule".to_owned(),
                    accepted: "lambda:optimal (its splines) or lambda:lambda=L,f2=X,f3=Y (constant f2, f3)".to_owned(),
                });
            }
        };
        let requirement: Requirement = self.require.into();
        if requirement == Requirement::Hull {
            return Err(Error::Usage {
                message: "hull is not checked over a range".to_owned(),
                accepted: "c1, bounded, strict".to_owned(),
            });
        }
        let certificate = prove_range(valence, curve, lambda, Limits::default())?;
        if let Some(path) = &self.output {
            files::write(path, certificate.to_json()?.as_bytes())?;
        }
        files::emit(
            None,
            report::range(&certificate, requirement, self.format.format).as_bytes(),
        )?;
        let proven = certificate
            .required(requirement)
            .iter()
            .all(|s| s.status == Status::Proven);
        Ok(exit(proven))
    }

    fn check_again(&self, path: &Path) -> Result<ExitCode, Error> {
        let paths = if path.is_dir() {
            let json = |name: &PathBuf| name.extension().is_some_and(|extension| extension == "json");
            files::below(path)?
                .into_iter()
                .filter(json)
                .map(|name| path.join(name))
                .collect()
        } else {
            vec![path.to_owned()]
        };
        if paths.is_empty() {
            return Err(Error::BadFile {
                path: path.to_owned(),
                message: "the folder holds no certificate".to_owned(),
            });
        }
        let rows = all::on_all(&paths, "certificates", |path| confirm(path))?;
        files::emit(None, report::rechecks(&rows, self.format.format).as_bytes())?;
        Ok(exit(rows.iter().all(|row| row.confirmed)))
    }
}

fn exit(proven: bool) -> ExitCode {
    ExitCode::from(u8::from(!proven))
}

/// What checking one file again has shown.
struct Confirmation {
    path: PathBuf,
    what: String,
    valence: usize,
    confirmed: bool,
    remark: String,
}

fn confirm(path: &Path) -> Result<Confirmation, Error> {
    let text = files::read(path)?;
    let bad = |error: eigenring_certify::Error| Error::BadFile {
        path: path.to_owned(),
        message: error.to_string(),
    };
    // a certificate of a range has tiles, one of a scheme an input
    let is_range = serde_json::from_str::<serde_json::Value>(&text).is_ok_and(|value| value.get("tiles").is_some());
    let mut remarks = Vec::new();
    // a valence in a file is no more to be trusted than one on the command line: work grows with it
    let accepted = |valence: usize| match valence {
        ..=args::MAX_VALENCE => Ok(()),
        _ => Err(Error::BadFile {
            path: path.to_owned(),
            message: format!(
                "valence {valence} is out of range: accepted is 3 to {}",
                args::MAX_VALENCE
            ),
        }),
    };
    let (what, valence, intact) = if is_range {
        accepted(RangeCertificate::from_json(&text).map_err(bad)?.valence)?;
        let (certificate, found) = recheck_range_text(&text).map_err(bad)?;
        if !found.covered {
            remarks.push("the tiles do not cover the range".to_owned());
        }
        let different = found.differences.iter().map(|(group, [start, end])| {
            let names: Vec<&str> = group.statements().iter().map(|statement| statement.name()).collect();
            let names = names.join(", ");
            format!("{names} on {start}..{end}: not as claimed")
        });
        remarks.extend(different);
        let [start, end] = certificate.lambda;
        (format!("lambda {start}..{end}"), certificate.valence, found.intact)
    } else {
        accepted(Certificate::from_json(&text).map_err(bad)?.valence)?;
        let (certificate, found) = recheck_text(&text).map_err(bad)?;
        let word = |status: Option<Status>| status.map_or("absent".to_owned(), |status| status.to_string());
        let different = found.differences.iter().map(|d| match (d.claimed, d.found) {
            (None, None) => format!("{}: {}", d.name, d.what),
            (claimed, found) => format!(
                "{} ({}): claimed {}, found {}",
                d.name,
                d.what,
                word(claimed),
                word(found)
            ),
        });
        remarks.extend(different);
        (certificate.input.origin(), certificate.valence, found.intact)
    };
    if !intact {
        remarks.insert(0, "changed after it was written: the digest differs".to_owned());
    }
    Ok(Confirmation {
        path: path.to_owned(),
        what,
        valence,
        confirmed: remarks.is_empty(),
        remark: remarks.join("; "),
    })
}

/// What is certified of a scheme on the command line: its text or its parameters, exactly as given.
fn input(scheme: &SchemeArg, valence: usize, reading: Reading) -> Result<Input, Error> {
    match scheme {
        SchemeArg::File(path) => {
            // read as a scheme first, so that mistakes are reported with the file's name
            read_scheme(path, reading)?.exact(valence)?;
            let name = path
                .file_stem()
                .map_or("scheme".into(), |stem| stem.to_string_lossy().into_owned());
            Ok(Input::Toml {
                text: files::read(path)?,
                name,
                reading,
            })
        }
        SchemeArg::Spec(spec) => match scheme.lambda_point(valence)? {
            Some(point) => {
                let given = matches!(spec, Spec::Lambda { weights: Some(_), .. });
                Ok(Input::Lambda {
                    lambda: point.plane.lambda,
                    s: point.plane.s,
                    f2: point.f2,
                    // at valence 4 f3 is mu; a tabulated or tuned double can only come near
                    f3: (valence != 4 || given).then_some(point.f3),
                })
            }
            None => Ok(Input::from_spec(spec, valence)?),
        },
    }
}
