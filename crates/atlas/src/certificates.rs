//! Which certificates are made of named schemes, and what checking them again shows.
//!
//! The stored ones are of Catmull-Clark at valences 3 to 64, of the lambda-scheme at its featured lambdas
//! `A`, `M` and `C`, and of its spline stencils over the recommended range and over all lambdas that are
//! tabulated.

use crate::error::{Accepted, Error};
use crate::nonuniform::certificate::Certificate as WithIntervals;
use crate::schemes::{SchemeName, Tuner, stem};
use crate::table::Table;
use eigenring_certify::parameter::{ParameterCertificate, recheck_parameter_text};
use eigenring_certify::range::{RangeCertificate, StencilCurve, recheck_range_text};
use eigenring_certify::valences::{Family, ValencesCertificate, recheck_valences_text};
use eigenring_certify::{Certificate, Input, Requirement, Statement, Status, recheck_text};
use eigenring_scheme::lambda::{LambdaTable, Splines};
use eigenring_scheme::user::Reading;
use eigenring_scheme::{Number, Shape, Spec};
use eigenring_tune::study::{LAMBDA_A, LAMBDA_M};
use std::path::{Path, PathBuf};

/// What is certified of a named scheme: its text or its parameters, exactly as given. A file is taken in the
/// given `reading`.
///
/// # Errors
/// As [`SchemeName::scheme`].
pub fn input(scheme: &SchemeName, valence: usize, reading: Reading, tuner: &Tuner<'_>) -> Result<Input, Error> {
    match scheme {
        SchemeName::File(file) => {
            // read as a scheme first, so that mistakes are reported with the file's name
            let scheme = file.read(reading)?;
            scheme
                .exact(valence)
                .map_err(|error| Error::from(error).in_file(&file.path))?;
            let set = scheme
                .parameters()
                .iter()
                .filter_map(|known| Some((&known.name, known.changed()?)));
            Ok(Input::Toml {
                text: crate::files::read(&file.path)?,
                name: stem(&file.path),
                reading,
                parameters: set.map(|(name, value)| (name.clone(), value.to_string())).collect(),
            })
        }
        SchemeName::NonUniform(_) => Err(match scheme.definition(reading) {
            Err(error) => error,
            Ok(_) => Error::content("no certificate"),
        }),
        SchemeName::Spec(spec) => Ok(match tuner.member(spec, valence)? {
            Some(member) => Input::member(&member),
            None => Input::from_spec(spec, valence)?,
        }),
    }
}

/// What is certified of a scheme file for every value of a parameter from one end of a range to the other.
///
/// # Errors
/// As [`input`]; [`Error::Usage`] for a scheme that is no file.
pub fn ranged(
    scheme: &SchemeName,
    valence: usize,
    (parameter, ends): &(String, [Number; 2]),
    reading: Reading,
    tuner: &Tuner<'_>,
) -> Result<Input, Error> {
    match input(scheme, valence, reading, tuner)? {
        Input::Toml {
            text,
            name,
            reading,
            parameters,
        } => Ok(Input::TomlRange {
            text,
            name,
            reading,
            parameters,
            parameter: parameter.clone(),
            ends: ends.each_ref().map(Number::to_string),
        }),
        _ => Err(Error::Usage {
            message: "--range is for the parameters of a scheme file".to_owned(),
            accepted: "--scheme file:SCHEME.toml; --lambda-range for the lambda-scheme".to_owned(),
        }),
    }
}

/// What is certified of a named scheme around any corner; see [`input`] for closed fans of like sectors.
///
/// # Errors
/// As [`SchemeName::around`].
pub fn beside(
    scheme: &SchemeName,
    shape: &Shape,
    steps: Option<usize>,
    reading: Reading,
    tuner: &Tuner<'_>,
) -> Result<Input, Error> {
    match (scheme, shape, steps) {
        (_, &Shape::Closed { sectors }, None) => input(scheme, sectors, reading, tuner),
        (SchemeName::Spec(spec), ..) => Ok(Input::Corner {
            spec: spec.to_string(),
            shape: shape.clone(),
            steps,
        }),
        (SchemeName::File(_) | SchemeName::NonUniform(_), ..) => {
            // the reason is the definition's
            scheme.around(&shape.corner(scheme.centre()?, steps)?, tuner)?;
            Err(Error::Usage {
                message: "files describe closed fans of like sectors".to_owned(),
                accepted: "-N alone".to_owned(),
            })
        }
    }
}

/// The curve of members over lambda that a name stands for: the embedded splines of f2 and f3 if it gives no
/// weights, else constants.
///
/// # Errors
/// [`Error::Usage`] for a scheme of another family, or with an s of its own; a valence that is not tabulated.
pub fn curve(scheme: Option<&SchemeName>, valence: usize) -> Result<StencilCurve, Error> {
    match scheme {
        None | Some(SchemeName::Spec(Spec::LambdaOptimal)) => Ok(StencilCurve::embedded(valence)?),
        Some(SchemeName::Spec(Spec::Lambda {
            weights: None,
            s: None,
            splines,
            ..
        })) => Ok(StencilCurve::of(splines.table()?.entry(valence)?)),
        Some(SchemeName::Spec(Spec::Lambda {
            weights: Some((f2, f3)),
            s: None,
            ..
        })) => Ok(StencilCurve::Constant { f2: *f2, f3: *f3 }),
        Some(_) => Err(Error::Usage {
            message: "a range of lambda is for the lambda-scheme with s by its rule".to_owned(),
            accepted: "lambda:optimal (its splines), lambda:fine,lambda=L (the finer ones) or lambda:lambda=L,f2=X,f3=Y (constant f2, f3)".to_owned(),
        }),
    }
}

/// The scheme of which all valences can be certified at once.
///
/// # Errors
/// [`Error::Usage`] for another scheme.
pub fn family(scheme: &SchemeName) -> Result<Family, Error> {
    match scheme {
        SchemeName::Spec(Spec::CatmullClark) => Ok(Family::CatmullClark),
        SchemeName::Spec(Spec::DooSabin) => Ok(Family::DooSabin),
        _ => Err(Error::Usage {
            message: "there is no proof for all valences of this scheme".to_owned(),
            accepted: format!(
                "{}; or valences with an end, such as 3..20",
                Family::ALL.map(Family::name).join(" and ")
            ),
        }),
    }
}

/// A scheme at a valence, of which a certificate is stored.
#[derive(Clone, Debug)]
pub struct Single {
    /// The file, below the folder of certificates.
    pub file: PathBuf,
    /// What the scheme is called in the summary.
    pub label: String,
    /// The valence.
    pub valence: usize,
    /// The scheme.
    pub input: Input,
}

/// The lambda-scheme over a range, of which a certificate is stored.
#[derive(Clone, Debug)]
pub struct Ranged {
    /// The file, below the folder of certificates.
    pub file: PathBuf,
    /// What the range is called.
    pub label: &'static str,
    /// The valence.
    pub valence: usize,
    /// The members.
    pub curve: StencilCurve,
    /// The range of lambda.
    pub lambda: [f64; 2],
}

/// The name of the ranges that reach over all tabulated lambdas.
pub const TABULATED: &str = "tabulated";

/// The schemes of which certificates are stored: Catmull-Clark whatever the valences, then the featured
/// members of the lambda-scheme.
///
/// # Errors
/// A valence that is not tabulated.
pub fn singles(valences: &[usize]) -> Result<Vec<Single>, Error> {
    let mut singles = Vec::new();
    for valence in 3..=64 {
        singles.push(Single {
            file: format!("catmull-clark/N{valence:03}.json").into(),
            label: "catmull-clark".to_owned(),
            valence,
            input: Input::from_spec(&Spec::CatmullClark, valence)?,
        });
    }
    for &valence in valences {
        let entry = LambdaTable::embedded()?.entry(valence)?;
        // A* and M* are those of all valences (Ma, Wang and Ma 2023, Table 1), C* is the optimal one of each
        for (letter, lambda) in [("A", LAMBDA_A), ("M", LAMBDA_M), ("C", entry.lambda_optimal)] {
            let spec = Spec::Lambda {
                lambda,
                s: None,
                weights: None,
                splines: Splines::Paper,
            };
            singles.push(Single {
                file: format!("lambda/N{valence:03}-{letter}.json").into(),
                label: format!("lambda_{letter}"),
                valence,
                input: Input::from_spec(&spec, valence)?,
            });
        }
    }
    Ok(singles)
}

/// The ranges of which certificates are stored.
///
/// # Errors
/// A valence that is not tabulated.
pub fn ranges(valences: &[usize]) -> Result<Vec<Ranged>, Error> {
    let mut ranges = Vec::new();
    for &valence in valences {
        let entry = LambdaTable::embedded()?.entry(valence)?;
        for (label, lambda) in [
            ("recommended", [entry.lambda_r1, entry.lambda_r2]),
            (TABULATED, [entry.knots.a, entry.knots.e]),
        ] {
            ranges.push(Ranged {
                file: format!("ranges/N{valence:03}-{label}.json").into(),
                label,
                valence,
                curve: StencilCurve::embedded(valence)?,
                lambda,
            });
        }
    }
    Ok(ranges)
}

impl Ranged {
    /// Whether a certificate is one of this range, made by this version and unchanged since.
    pub fn is_proven_by(&self, kept: &RangeCertificate) -> bool {
        kept.curve == self.curve
            && kept.lambda == self.lambda
            && kept.valence == self.valence
            && kept.tool == crate::results::tool()
            && kept.digest == kept.content_digest()
    }
}

/// The requirements that are summed up.
const SUMMED_UP: [Requirement; 3] = [Requirement::C1, Requirement::Bounded, Requirement::Strict];

/// The statements about a stationary scheme, in their columns.
fn statements() -> impl Iterator<Item = Statement> {
    Statement::ALL
        .into_iter()
        .filter(|&statement| statement != Statement::Levels)
}

/// One line a certificate: the verdicts, the status of each statement, eigenvalue and ratio. Certificates are
/// in the order of what they are of.
pub fn summary(singles: &[Single], certificates: &[Certificate]) -> Table {
    let mut columns = vec!["scheme", "valence", "lambda", "mu_ratio", "jacobian_margin"];
    // the words of the requirements are names of checks too
    columns.extend(["is_c1", "is_bounded", "is_strict"]);
    columns.extend(statements().map(Statement::name));
    let mut table = Table::new(columns);
    for (single, certificate) in singles.iter().zip(certificates) {
        let enclosed = |statement: Statement| certificate.check(statement).and_then(|check| check.enclosure);
        let mut row = vec![
            single.label.clone().into(),
            single.valence.into(),
            enclosed(Statement::Subdominant).map(|value| value.mid()).into(),
            enclosed(Statement::BoundedCurvature).map(|value| value.mid()).into(),
            certificate
                .check(Statement::Regular)
                .and_then(|check| check.margin)
                .into(),
        ];
        let verdicts = SUMMED_UP.map(|requirement| requirement.verdict(&certificate.checks).1);
        row.extend(verdicts.map(|status| status.to_string().into()));
        let status = |statement: Statement| {
            certificate
                .check(statement)
                .map(|check| check.status.to_string())
                .into()
        };
        row.extend(statements().map(status));
        table.push(row);
    }
    table
}

/// The intervals on which each requirement is proven, refuted or open.
pub fn range_table(ranges: &[Ranged], certificates: &[RangeCertificate]) -> Table {
    let mut table = Table::new(["valence", "range", "require", "from", "to", "status", "witness"]);
    for (range, certificate) in ranges.iter().zip(certificates) {
        for requirement in SUMMED_UP {
            for segment in certificate.required(requirement) {
                let witness = segment.witness.filter(|_| segment.status == Status::Refuted);
                table.push(vec![
                    range.valence.into(),
                    range.label.into(),
                    requirement.name().into(),
                    segment.lambda[0].into(),
                    segment.lambda[1].into(),
                    segment.status.to_string().into(),
                    witness.map(|witness| witness.text).into(),
                ]);
            }
        }
    }
    table
}

/// What a certificate of all valences is of, in words.
pub(crate) fn every(certificate: &ValencesCertificate) -> String {
    format!("{}, every N >= {}", certificate.scheme.name(), certificate.from)
}

/// What checking one file again has shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Confirmation {
    /// The file.
    pub path: PathBuf,
    /// What it certifies: a scheme or a range.
    pub what: String,
    /// The valence; none for all.
    pub valence: Option<usize>,
    /// Whether the file is unchanged and every claim was confirmed.
    pub confirmed: bool,
    /// What was not confirmed.
    pub remark: String,
}

/// Checks a stored certificate of any kind again, by its evidence alone. The valence is at most `most`:
/// one in a file is no more to be trusted than one that a user types, and work grows with it.
///
/// # Errors
/// [`Error::Read`], and [`Error::InFile`] for what is no certificate or of a larger valence.
pub fn confirm(path: &Path, most: usize) -> Result<Confirmation, Error> {
    let text = crate::files::read(path)?;
    confirm_text(path, &text, most).map_err(|error| error.in_file(path))
}

/// The same of the text of a certificate; `path` is what it is called.
///
/// # Errors
/// As [`confirm`].
pub fn confirm_text(path: &Path, text: &str, most: usize) -> Result<Confirmation, Error> {
    // a certificate of a range has tiles, one of a scheme an input, one of a range of a parameter both, and
    // one of all valences tiles and a first valence; one of a scheme with knot intervals has Bernstein
    // coefficients
    let value = serde_json::from_str::<serde_json::Value>(text).unwrap_or_default();
    let is_range = value.get("tiles").is_some();
    let is_open = is_range && value.get("from").is_some();
    let is_parameter = is_range && value.get("input").is_some();
    let mut remarks = Vec::new();
    let check_valence = |valence: usize| match valence {
        _ if valence <= most => Ok(()),
        _ => Err(Error::refused(
            format!("valence {valence} is out of range"),
            Accepted::Is(format!("3 to {most}")),
        )),
    };
    let (what, valence, intact) = if is_open {
        let (certificate, found) = recheck_valences_text(text)?;
        let different = found.differences.iter();
        remarks.extend(different.map(|statement| format!("{statement}: not as claimed")));
        (every(&certificate), Some(certificate.from), found.intact)
    } else if is_parameter {
        check_valence(ParameterCertificate::from_json(text)?.valence)?;
        let (certificate, found) = recheck_parameter_text(text)?;
        if !found.covered {
            remarks.push("the tiles do not cover the range".to_owned());
        }
        let different = found.different.iter();
        remarks.extend(different.map(|[first, last]| format!("{first}..{last}: not as claimed")));
        (certificate.input.origin(), Some(certificate.valence), found.intact)
    } else if WithIntervals::is_of_this_kind(&value) {
        let certificate = WithIntervals::from_json(text)?;
        certificate.valence().map_or(Ok(()), check_valence)?;
        let (intact, found) = certificate.recheck(text)?;
        remarks.extend(found);
        (certificate.what(), certificate.valence(), intact)
    } else if is_range {
        check_valence(RangeCertificate::from_json(text)?.valence)?;
        let (certificate, found) = recheck_range_text(text)?;
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
        (
            format!("lambda {start}..{end}"),
            Some(certificate.valence),
            found.intact,
        )
    } else {
        check_valence(Certificate::from_json(text)?.valence)?;
        let (certificate, found) = recheck_text(text)?;
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
        (certificate.input.origin(), Some(certificate.valence), found.intact)
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
