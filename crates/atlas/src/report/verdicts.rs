//! What is proven and refuted at each valence, with margins and witnesses in words.

use super::command;
use super::frame::{Section, valence_heading};
use super::{Topic, greek, legend};
use crate::certificates::input;
use crate::error::Error;
use crate::progress::each;
use crate::spectrum::Analysis;
use crate::table::{Table, short};
use crate::verify::certificate_table;
use eigenring_certify::{Certificate, Check, Requirement, Statement, Status, certify};
use eigenring_scheme::user::Reading;
use maud::{Markup, html};

/// What `eigenring verify` proves, at each valence.
pub(super) fn certificates(topic: &Topic) -> Result<Vec<Certificate>, Error> {
    let inputs = topic.valences.iter();
    let inputs = inputs.map(|&valence| Ok((valence, input(topic.name, valence, Reading::default(), topic.tuner)?)));
    let inputs: Vec<_> = inputs.collect::<Result<_, Error>>()?;
    Ok(each(
        topic.tuner.progress,
        "certificates",
        &inputs,
        |(valence, input)| certify(input.clone(), *valence),
    )?)
}

/// The requirements in their columns.
const COLUMNS: [(Requirement, &str, &str); 4] = [
    (
        Requirement::C1,
        "C1",
        "the surface is C1 at the centre for almost all control nets",
    ),
    (
        Requirement::Bounded,
        "bounded curvature",
        "it is C1, and its curvature stays bounded",
    ),
    (
        Requirement::Strict,
        "strict",
        "it has bounded curvature, and no further eigenvalue reaches those of the quadratic terms",
    ),
    (
        Requirement::Hull,
        "convex hull",
        "no weight of a refined point is negative",
    ),
];

/// Eigenvalues and verdicts in one table.
pub(super) fn glance(topic: &Topic, analyses: &[Analysis], certificates: &[Certificate]) -> Markup {
    let columns = ["valence", "lambda", "mu/lambda^2"].into_iter();
    let mut table = Table::new(columns.chain(COLUMNS.map(|(_, name, _)| name)));
    for ((&valence, Analysis { spectrum, .. }), certificate) in topic.valences.iter().zip(analyses).zip(certificates) {
        let lambda = spectrum.subdominant().map(|e| e.modulus());
        let mut row = vec![valence.into(), lambda.into(), spectrum.curvature_ratio().into()];
        let status = |requirement: Requirement| requirement.verdict(&certificate.checks).1.to_string();
        row.extend(COLUMNS.map(|(requirement, ..)| status(requirement).into()));
        table.push(row);
    }
    table.html("At a glance: the subdominant eigenvalue, and what is proven at each valence")
}

/// What a statement says when it holds, and what its margin and its value are.
fn words(statement: Statement) -> [&'static str; 3] {
    match statement {
        Statement::RowSums => ["the weights of every refined point sum to 1", "", "largest defect"],
        Statement::Hull => [
            "no weight is negative",
            "the smallest weight that is not zero is",
            "smallest weight",
        ],
        Statement::Levels => [
            "C1 carries over from the limit level to levels that differ",
            "the room left is",
            "",
        ],
        Statement::Dominant => [
            "the eigenvalue 1 is simple, and all others lie inside the unit disc",
            "1 less the next modulus is",
            "next modulus",
        ],
        Statement::Subdominant => [
            "a real positive pair λ of Fourier index 1 leads all other eigenvalues",
            "1 less the next modulus over λ is",
            "λ",
        ],
        Statement::Regular => [
            "the Jacobian of the characteristic map has one sign",
            "its smallest modulus is",
            "smallest Jacobian",
        ],
        Statement::Injective => ["the characteristic map is injective", "", ""],
        Statement::BoundedCurvature => [
            "no further eigenvalue exceeds λ² in modulus, and none that reaches it has a Jordan block",
            "1 less the largest further modulus over λ² is",
            "largest further modulus over λ²",
        ],
        Statement::NonDegenerate => ["λ² is the eigenvalue of the three second-order modes", "", "μ over λ²"],
        Statement::Strict => [
            "all eigenvalues after those of the quadratic terms are smaller",
            "1 less their ratio is",
            "ratio",
        ],
        Statement::Corner => [
            "the corner angle of the natural configuration is within its bound",
            "the room, in radians, is",
            "angle, in radians",
        ],
        Statement::Gauss => [
            "the Gauss curvatures of cup and saddles have their signs",
            "the smallest modulus is",
            "curvature",
        ],
    }
}

/// A check in a sentence.
fn sentence(check: &Check) -> String {
    let [says, margin, mut value] = words(check.name);
    if check.name == Statement::NonDegenerate && check.holds {
        // what is enclosed is then the eigenvalue, and not its ratio
        value = "λ²";
    }
    let mut text = match check.status {
        Status::Proven => format!("Proven: {says}"),
        Status::Refuted => format!("Refuted: it is false that {says}"),
        Status::Undecided => format!("Undecided whether {says}"),
        Status::Numerical => format!("Computed for rounded weights: {says}"),
    };
    if let Some(found) = check.margin.filter(|_| !margin.is_empty() && check.holds) {
        text.push_str(&format!("; {margin} at least {}", short(found)));
    }
    if let Some(enclosure) = check.enclosure.filter(|_| !value.is_empty()) {
        let [low, high] = [enclosure.lo(), enclosure.hi()].map(short);
        // ten digits tell most enclosures from numbers no more
        match low == high {
            true => text.push_str(&format!("; {value}: {low}")),
            false => text.push_str(&format!("; {value}: {low} to {high}")),
        }
    }
    if let Some(witness) = &check.witness {
        text.push_str(&format!(". Witness: {}", greek(&witness.text)));
    }
    if let Some(reached) = &check.reached {
        text.push_str(&format!(". {}", capital(&greek(reached))));
    }
    text + "."
}

/// With its first letter as a capital one.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// A certificate in words, beside its table.
fn certificate(topic: &Topic, certificate: &Certificate, open: bool) -> Markup {
    let (_, c1) = Requirement::C1.verdict(&certificate.checks);
    let mut table = Table::new(["statement", "status", "in words"]);
    for check in &certificate.checks {
        let name = check.name.name().replace('_', " ");
        table.push(vec![
            name.into(),
            check.status.to_string().into(),
            sentence(check).into(),
        ]);
    }
    let heading = valence_heading(certificate.valence);
    html! {
        details.valence open[open] {
            summary { (heading) ": C1 is " (c1) }
            @if let Some(balanced) = &certificate.balanced {
                p.note {
                    "Rounded weights were balanced in " (balanced.rows) " stencils; the largest change is "
                    (short(balanced.largest)) "."
                }
            }
            (table.html(&format!("{heading}: statements with margins and witnesses")))
            (certificate_table(certificate).sources("The certificate's numbers"))
            p.note { "Stored, to be checked again: " code {
                (command::at("verify", topic, certificate.valence, &format!("-o N{:03}.json", certificate.valence)))
            } }
        }
    }
}

/// The section.
pub(super) fn section(topic: &Topic, certificates: &[Certificate]) -> Section {
    let meanings = COLUMNS
        .map(|(_, name, meaning)| format!("{name}  {meaning}\n"))
        .concat();
    // what is not proven is what a reader looks for
    let unproven = |found: &Certificate| Requirement::C1.verdict(&found.checks).1 != Status::Proven;
    let body = html! {
        (legend(&meanings))
        @for (index, found) in certificates.iter().enumerate() {
            (certificate(topic, found, index == 0 || unproven(found)))
        }
    };
    Section {
        id: "verdicts",
        title: "What is proven",
        body,
        commands: vec![
            command::of("verify", topic, ""),
            command::of("verify", topic, "--require bounded"),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_certify::{Interval, Witness};

    #[test]
    fn checks_in_sentences() {
        let proven = Check::proven(Statement::Hull).margin(0.01);
        assert_eq!(
            sentence(&proven),
            "Proven: no weight is negative; the smallest weight that is not zero is at least 0.01."
        );
        let witness = Witness::new("the outer boundary winds 2 times round the centre");
        assert_eq!(
            sentence(&Check::refuted(Statement::Injective, witness)),
            "Refuted: it is false that the characteristic map is injective. Witness: the outer boundary winds 2 times round the centre."
        );
        // the margin of what does not hold is none
        let open = Check::undecided(Statement::Strict, "a tie with mu").enclosing(Interval::new(0.9, 1.1).unwrap());
        assert_eq!(
            sentence(&open),
            "Undecided whether all eigenvalues after those of the quadratic terms are smaller; ratio: 0.9 to 1.1. A tie with mu."
        );
    }
}
