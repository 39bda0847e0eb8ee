//! `eigenring verify --all`: the stored certificates and their summaries.
//!
//! Catmull-Clark at valences 3 to 64; the lambda-scheme at its featured lambdas `A`, `M` and `C`; its spline stencils over the recommended
//! range and over all lambdas that are tabulated. An interrupted run resumes: certificates of ranges, which take longest,
//! are kept below the output folder until all are there.

use crate::error::Error;
use crate::files;
use crate::progress::bar;
use crate::table::{Format, Table};
use eigenring_certify::range::{Curve, Limits, RangeCertificate, prove_range};
use eigenring_certify::{Certificate, Input, Requirement, Statement, Status, certify};
use eigenring_scheme::Spec;
use eigenring_scheme::lambda::LambdaTable;
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The folder below the output folder.
const FOLDER: &str = "certificates";

/// The featured lambdas A* and M* of all valences (Ma, Wang and Ma 2023, Table 1); C* is the optimal one of each.
const LAMBDA_A: f64 = 0.39;
const LAMBDA_M: f64 = 0.5;

/// The requirements that are summed up.
const SUMMED_UP: [Requirement; 3] = [Requirement::C1, Requirement::Bounded, Requirement::Strict];

/// Work on all items in parallel, with a bar; results are in the order of the items.
pub fn on_all<T: Sync, R: Send>(
    items: &[T],
    title: &str,
    work: impl Fn(&T) -> Result<R, Error> + Sync,
) -> Result<Vec<R>, Error> {
    let progress = bar(title, items.len());
    let results = items
        .par_iter()
        // items differ much in size: each is handed out by itself
        .with_max_len(1)
        .map(|item| {
            let result = work(item);
            progress.inc(1);
            result
        })
        .collect();
    progress.finish_and_clear();
    results
}

/// A scheme at a valence.
struct Single {
    file: PathBuf,
    label: String,
    valence: usize,
    input: Input,
}

/// The lambda-scheme over a range.
struct Ranged {
    file: PathBuf,
    label: &'static str,
    valence: usize,
    curve: Curve,
    lambda: [f64; 2],
}

/// Makes and writes everything.
pub fn make(valences: &[usize], out: &Path) -> Result<(), Error> {
    let folder = out.join(FOLDER);
    let (singles, ranges) = (singles(valences)?, ranges(valences)?);
    files::check_writable(&folder)?;
    let resume = folder.join(".resume");
    let singly = on_all(&singles, "certificates", |single| {
        Ok(certify(single.input.clone(), single.valence)?)
    })?;
    let ranged = on_all(&ranges, "ranges of lambda", |range| prove(range, &resume))?;
    for (single, certificate) in singles.iter().zip(&singly) {
        files::write(&folder.join(&single.file), compact(certificate)?.as_bytes())?;
    }
    for (range, certificate) in ranges.iter().zip(&ranged) {
        files::write(&folder.join(&range.file), compact(certificate)?.as_bytes())?;
    }
    let summary = summary(&singles, &singly);
    files::write(&folder.join("summary.csv"), summary.render(Format::Csv).as_bytes())?;
    let table = range_table(&ranges, &ranged);
    files::write(&folder.join("ranges.csv"), table.render(Format::Csv).as_bytes())?;
    // only now nothing is left to resume
    std::fs::remove_dir_all(&resume).map_err(|source| Error::Write { path: resume, source })?;
    files::emit(None, table.render(Format::Text).as_bytes())
}

fn singles(valences: &[usize]) -> Result<Vec<Single>, Error> {
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
        for (letter, lambda) in [("A", LAMBDA_A), ("M", LAMBDA_M), ("C", entry.lambda_optimal)] {
            let spec = Spec::Lambda {
                lambda,
                s: None,
                weights: None,
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

fn ranges(valences: &[usize]) -> Result<Vec<Ranged>, Error> {
    let mut ranges = Vec::new();
    for &valence in valences {
        let entry = LambdaTable::embedded()?.entry(valence)?;
        for (label, lambda) in [
            ("recommended", [entry.lambda_r1, entry.lambda_r2]),
            ("tabulated", [entry.knots.a, entry.knots.e]),
        ] {
            ranges.push(Ranged {
                file: format!("ranges/N{valence:03}-{label}.json").into(),
                label,
                valence,
                curve: Curve::embedded(valence)?,
                lambda,
            });
        }
    }
    Ok(ranges)
}

/// The certificate of a range: what an interrupted run has left of it, if that is of the same curve, or a new one.
fn prove(range: &Ranged, resume: &Path) -> Result<RangeCertificate, Error> {
    let path = resume.join(&range.file);
    if let Ok(text) = files::read(&path)
        && let Ok(kept) = RangeCertificate::from_json(&text)
        && kept.curve == range.curve
        && kept.lambda == range.lambda
        && kept.valence == range.valence
        && kept.tool == crate::results::tool()
        && kept.digest == kept.content_digest()
    {
        return Ok(kept);
    }
    let certificate = prove_range(range.valence, range.curve.clone(), range.lambda, Limits::default())?;
    files::write(&path, compact(&certificate)?.as_bytes())?;
    Ok(certificate)
}

/// A certificate as JSON on one line: evidence is for the checks to read, and takes a third of the room of indented JSON.
fn compact(certificate: &impl Serialize) -> Result<String, Error> {
    let text = serde_json::to_string(certificate).map_err(|error| {
        Error::Certify(eigenring_certify::Error::Syntax {
            line: error.line(),
            column: error.column(),
            message: error.to_string(),
        })
    })?;
    Ok(text + "\n")
}

/// The statements about a stationary scheme, in their columns.
const STATEMENTS: [Statement; 11] = [
    Statement::RowSums,
    Statement::Hull,
    Statement::Dominant,
    Statement::Subdominant,
    Statement::Regular,
    Statement::Injective,
    Statement::BoundedCurvature,
    Statement::NonDegenerate,
    Statement::Strict,
    Statement::Corner,
    Statement::Gauss,
];

/// One line a certificate: the verdicts, the status of each statement, eigenvalue and ratio.
fn summary(singles: &[Single], certificates: &[Certificate]) -> Table {
    let mut columns = vec!["scheme", "valence", "lambda", "mu_ratio", "jacobian_margin"];
    // the words of the requirements are names of checks too
    columns.extend(["is_c1", "is_bounded", "is_strict"]);
    columns.extend(STATEMENTS.map(Statement::name));
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
        row.extend(STATEMENTS.map(status));
        table.push(row);
    }
    table
}

/// The intervals on which each requirement is proven, refuted or open.
fn range_table(ranges: &[Ranged], certificates: &[RangeCertificate]) -> Table {
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
