//! Certificates for people and programs.

use crate::certificates::{Confirmation, every};
use crate::table::{Format, Table, WIDTH, pretty, short};
use eigenring_certify::parameter::{ParameterCertificate, Stretch};
use eigenring_certify::range::{RangeCertificate, Segment};
use eigenring_certify::valences::ValencesCertificate;
use eigenring_certify::{Certificate, Check, Interval, Requirement, Statement, Status};
use eigenring_scheme::Number;
use serde_json::{Value, json};

fn enclosure(value: Option<Interval>) -> Option<Value> {
    value.map(|value| json!([value.lo(), value.hi()]))
}

fn check_json(check: &Check) -> Value {
    let witness = check.witness.as_ref().map(|witness| {
        let data: serde_json::Map<String, Value> = witness
            .data
            .iter()
            .filter_map(|(name, &value)| Some((name.clone(), enclosure(Some(value))?)))
            .collect();
        json!({ "text": witness.text, "data": data })
    });
    json!({
        "name": check.name,
        "status": check.status,
        "holds": check.holds,
        "rigorous": check.rigorous,
        "margin": check.margin,
        "enclosure": enclosure(check.enclosure),
        "witness": witness,
        "reached": check.reached,
    })
}

/// Certificates, each with the verdict on what is required: in JSON an object, or a list of several; CSV and
/// LaTeX begin with a column of valences if there are several.
pub fn certificates(certificates: &[Certificate], requirement: Requirement, format: Format) -> String {
    several(
        certificates,
        format,
        |certificate| certificate_json(certificate, requirement),
        |certificate| certificate_text(certificate, requirement),
        |certificate| (certificate.valence, certificate_table(certificate)),
    )
}

/// What is said of several things of one kind, each at a valence.
fn several<C>(
    all: &[C],
    format: Format,
    json: impl Fn(&C) -> Value,
    text: impl Fn(&C) -> String,
    table: impl Fn(&C) -> (usize, Table),
) -> String {
    match (format, all) {
        (Format::Text, _) => all.iter().map(text).collect::<Vec<_>>().join("\n"),
        (Format::Json, [one]) => pretty(&json(one)),
        (Format::Json, _) => pretty(&Value::Array(all.iter().map(json).collect())),
        (_, [one]) => table(one).1.render(format),
        _ => {
            let mut whole: Option<Table> = None;
            for (valence, table) in all.iter().map(table) {
                let table = table.beside("valence", valence);
                match &mut whole {
                    Some(whole) => whole.append(table),
                    None => whole = Some(table),
                }
            }
            whole.unwrap_or_default().render(format)
        }
    }
}

fn certificate_json(certificate: &Certificate, requirement: Requirement) -> Value {
    let (holds, status) = requirement.verdict(&certificate.checks);
    let checks: Vec<Value> = certificate.checks.iter().map(check_json).collect();
    json!({
        "scheme": certificate.input.name(),
        "valence": certificate.valence,
        "corner": certificate.input.corner(),
        "require": requirement.name(),
        "status": status,
        "holds": holds,
        "degree": certificate.degree,
        "balanced": certificate.balanced,
        "checks": checks,
    })
}

pub(crate) fn certificate_table(certificate: &Certificate) -> Table {
    check_table(&certificate.checks)
}

fn check_table(checks: &[Check]) -> Table {
    let mut table = Table::new(["check", "status", "margin", "value", "remark"]);
    for check in checks {
        let remark = check.witness.as_ref().map(|witness| witness.text.clone());
        table.push(vec![
            check.name.name().into(),
            check.status.to_string().into(),
            check.margin.into(),
            check.enclosure.map(|value| value.mid()).into(),
            remark.or(check.reached.clone()).unwrap_or_default().into(),
        ]);
    }
    table
}

fn certificate_text(certificate: &Certificate, requirement: Requirement) -> String {
    let (_, status) = requirement.verdict(&certificate.checks);
    let (scheme, valence) = (certificate.input.name(), certificate.valence);
    let corner = certificate.input.corner().filter(|corner| corner != "closed");
    let corner = corner.map_or(String::new(), |corner| format!(", {corner}"));
    let degree = certificate.degree;
    let degree = degree.map_or(String::new(), |degree| format!(", regular surface of degree {degree}"));
    format!(
        "{scheme}, N = {valence}{corner}{degree}\n\n{}\n{} is {status}\n",
        certificate_table(certificate).fitted(WIDTH),
        requirement.name()
    )
}

/// Certificates of single valences and one of all from a valence on, with one verdict on all of them: in JSON
/// one object; CSV and LaTeX begin with a column of valences, in which `5..` stands for 5 and all larger
/// ones.
pub fn all_valences(
    singles: &[Certificate],
    rest: &ValencesCertificate,
    requirement: Requirement,
    format: Format,
) -> (Status, String) {
    let statuses = singles
        .iter()
        .map(|certificate| &certificate.checks)
        .chain([&rest.checks]);
    let status = statuses.fold(Status::Proven, |status, checks| {
        status.and(requirement.verdict(checks).1)
    });
    let open = format!("{}..", rest.from);
    // listed before the open range, the valences need not follow each other
    let mut next = rest.from;
    let before = singles.iter().rev().filter(|certificate| {
        let follows = certificate.valence + 1 == next;
        next -= usize::from(follows);
        follows
    });
    let connected = before.count() == singles.len();
    let text = match format {
        Format::Json => {
            let checks: Vec<Value> = rest.checks.iter().map(check_json).collect();
            let (holds, of_rest) = requirement.verdict(&rest.checks);
            pretty(&json!({
                "scheme": rest.scheme.name(),
                "require": requirement.name(),
                "status": status,
                "holds": status == Status::Proven,
                "single": singles.iter().map(|one| certificate_json(one, requirement)).collect::<Vec<_>>(),
                "all": {
                    "from": rest.from, "tiles": rest.tiles.len(), "status": of_rest, "holds": holds, "checks": checks,
                },
            }))
        }
        Format::Text => {
            let single: String = singles
                .iter()
                .map(|one| certificate_text(one, requirement) + "\n")
                .collect();
            let valences = match (singles.first(), connected) {
                (Some(first), true) => format!("every N >= {}", first.valence),
                (Some(_), false) => {
                    let listed: Vec<String> = singles.iter().map(|one| one.valence.to_string()).collect();
                    format!("N = {} and every N >= {}", listed.join(", "), rest.from)
                }
                (None, _) => format!("every N >= {}", rest.from),
            };
            format!(
                "{single}{} ({} tiles)\n\n{}\n{} is {status} for {valences}\n",
                every(rest),
                rest.tiles.len(),
                check_table(&rest.checks).fitted(WIDTH),
                requirement.name(),
            )
        }
        _ => {
            let mut whole = Table::default();
            let single = singles
                .iter()
                .map(|one| (one.valence.to_string(), certificate_table(one)));
            for (position, (valence, table)) in single.chain([(open, check_table(&rest.checks))]).enumerate() {
                let table = table.beside("valence", valence);
                match position {
                    0 => whole = table,
                    _ => whole.append(table),
                }
            }
            whole.render(format)
        }
    };
    (status, text)
}

/// The statements of a range certificate.
const STATEMENTS: [Statement; 7] = [
    Statement::RowSums,
    Statement::Dominant,
    Statement::Subdominant,
    Statement::Regular,
    Statement::Injective,
    Statement::BoundedCurvature,
    Statement::Strict,
];

fn segments_json(segments: &[Segment]) -> Vec<Value> {
    let one = |segment: &Segment| {
        json!({
            "lambda": segment.lambda,
            "status": segment.status,
            "witness": segment.witness.as_ref().map(|witness| witness.text.clone()),
        })
    };
    segments.iter().map(one).collect()
}

/// Certificates of ranges, each with the intervals on which the requirement holds; as [`certificates`] if
/// there are several.
pub fn ranges(certificates: &[RangeCertificate], requirement: Requirement, format: Format) -> String {
    several(
        certificates,
        format,
        |certificate| range_json(certificate, requirement),
        |certificate| range_text(certificate, requirement),
        |certificate| (certificate.valence, range_table(certificate, requirement)),
    )
}

fn range_json(certificate: &RangeCertificate, requirement: Requirement) -> Value {
    let required = certificate.required(requirement);
    let checks: Vec<Value> = STATEMENTS
        .iter()
        .map(|&name| {
            let segments = certificate.segments(name);
            let (status, holds) = whole(&segments);
            json!({ "name": name, "status": status, "holds": holds, "rigorous": status != Status::Undecided,
                    "segments": segments_json(&segments) })
        })
        .collect();
    let (status, holds) = whole(&required);
    json!({
        "scheme": "lambda",
        "valence": certificate.valence,
        "lambda": certificate.lambda,
        "require": requirement.name(),
        "status": status,
        "holds": holds,
        "segments": segments_json(&required),
        "checks": checks,
    })
}

fn range_table(certificate: &RangeCertificate, requirement: Requirement) -> Table {
    let required = certificate.required(requirement);
    let mut table = Table::new(["statement", "from", "to", "status", "remark"]);
    let lists = STATEMENTS
        .iter()
        .map(|&name| (name.to_string(), certificate.segments(name)));
    for (name, segments) in lists.chain([(format!("= {}", requirement.name()), required)]) {
        for segment in segments {
            table.push(vec![
                name.clone().into(),
                segment.lambda[0].into(),
                segment.lambda[1].into(),
                segment.status.to_string().into(),
                segment.witness.map(|witness| witness.text).unwrap_or_default().into(),
            ]);
        }
    }
    table
}

fn range_text(certificate: &RangeCertificate, requirement: Requirement) -> String {
    let [start, end] = certificate.lambda;
    let tiles: usize = certificate.tiles.values().map(Vec::len).sum();
    format!(
        "lambda-scheme, N = {}, every lambda from {} to {} ({tiles} tiles)\n\n{}\n{} is {}\n",
        certificate.valence,
        short(start),
        short(end),
        range_table(certificate, requirement).fitted(WIDTH),
        requirement.name(),
        whole(&certificate.required(requirement)).0,
    )
}

/// The status of a statement on a whole range: refuted if it is so somewhere, proven if it is so everywhere.
fn whole(segments: &[Segment]) -> (Status, bool) {
    let all = segments.iter().map(|segment| segment.status).reduce(Status::and);
    let status = all.unwrap_or(Status::Undecided);
    (status, status == Status::Proven)
}

/// What checking files again has shown.
pub fn rechecks(rows: &[Confirmation], format: Format) -> String {
    let mut table = Table::new(["file", "scheme", "valence", "result", "remark"]);
    for row in rows {
        table.push(vec![
            row.path.display().to_string().into(),
            row.what.clone().into(),
            row.valence.into(),
            if row.confirmed { "confirmed" } else { "NOT CONFIRMED" }.into(),
            row.remark.clone().into(),
        ]);
    }
    table.render(format)
}

/// The status of all stretches together.
fn over_parameter(stretches: &[Stretch]) -> Status {
    let all = stretches.iter().map(|stretch| stretch.status);
    all.reduce(Status::and).unwrap_or(Status::Undecided)
}

/// Certificates of a scheme file over a range of a parameter.
pub fn parameters(certificates: &[ParameterCertificate], requirement: Requirement, format: Format) -> String {
    let number = |text: &String| text.parse::<Number>().map_or(f64::NAN, |number| number.value());
    let named = |certificate: &ParameterCertificate| {
        let (parameter, ends) = certificate.parameter()?;
        Some((parameter.to_owned(), ends.each_ref().map(number)))
    };
    let table = |certificate: &ParameterCertificate| {
        let mut table = Table::new(["statement", "from", "to", "status", "remark"]);
        for stretch in certificate.required(requirement) {
            let [from, to] = stretch.ends.each_ref().map(number);
            table.push(vec![
                requirement.name().into(),
                from.into(),
                to.into(),
                stretch.status.to_string().into(),
                stretch.witness.map(|witness| witness.text).unwrap_or_default().into(),
            ]);
        }
        table
    };
    let json = |certificate: &ParameterCertificate| {
        let required = certificate.required(requirement);
        let segments: Vec<Value> = required
            .iter()
            .map(|stretch| {
                let witness = stretch.witness.as_ref().map(|witness| &witness.text);
                json!({ "range": stretch.ends.each_ref().map(number), "status": stretch.status, "witness": witness })
            })
            .collect();
        let (parameter, range) = named(certificate).unzip();
        let status = over_parameter(&required);
        json!({
            "scheme": certificate.input.name(),
            "valence": certificate.valence,
            "parameter": parameter,
            "range": range,
            "require": requirement.name(),
            "status": status,
            "holds": status == Status::Proven,
            "segments": segments,
        })
    };
    let text = |certificate: &ParameterCertificate| {
        format!(
            "{}, N = {}, every value of the parameter ({} tiles)\n\n{}\n{} is {}\n",
            certificate.input.name(),
            certificate.valence,
            certificate.tiles.len(),
            table(certificate).render(Format::Text),
            requirement.name(),
            over_parameter(&certificate.required(requirement)),
        )
    };
    several(certificates, format, json, text, |certificate| {
        (certificate.valence, table(certificate))
    })
}
