//! What the scheme is: its formulas, where it comes from, and its weights.

use super::command;
use super::frame::Section;
use super::{Topic, file};
use crate::error::Error;
use crate::schemes::SchemeName;
use crate::stencil::weights;
use crate::table::Table;
use eigenring_scheme::user::{
    Parameter, Reading, TypesetForm, TypesetPass, TypesetRule, TypesetSectors, UserScheme, starters,
};
use eigenring_scheme::{Lattice, Number, Scheme, Spec, registry};
use maud::{Markup, PreEscaped, html};

/// More rows of a table are no reading matter.
const MOST: usize = 240;

/// The one-ring rules, whose weights formulas give.
const ONE_RING: [&str; 3] = [
    "<msubsup><mi>F</mi><mi>i</mi><mo>′</mo></msubsup><mo>=</mo><msub><mi>f</mi><mn>1</mn></msub><mi>V</mi><mo>+</mo>\
     <msub><mi>f</mi><mn>2</mn></msub><mrow><mo>(</mo><msub><mi>E</mi><mi>i</mi></msub><mo>+</mo><msub><mi>E</mi><mrow>\
     <mi>i</mi><mo>+</mo><mn>1</mn></mrow></msub><mo>)</mo></mrow><mo>+</mo><msub><mi>f</mi><mn>3</mn></msub><msub>\
     <mi>F</mi><mi>i</mi></msub>",
    "<msubsup><mi>E</mi><mi>i</mi><mo>′</mo></msubsup><mo>=</mo><msub><mi>d</mi><mn>1</mn></msub><mi>V</mi><mo>+</mo>\
     <msub><mi>d</mi><mn>2</mn></msub><msub><mi>E</mi><mi>i</mi></msub><mo>+</mo><msub><mi>e</mi><mn>1</mn></msub><mrow>\
     <mo>(</mo><msub><mi>E</mi><mrow><mi>i</mi><mo>−</mo><mn>1</mn></mrow></msub><mo>+</mo><msub><mi>E</mi><mrow>\
     <mi>i</mi><mo>+</mo><mn>1</mn></mrow></msub><mo>)</mo></mrow><mo>+</mo><msub><mi>e</mi><mn>2</mn></msub><mrow>\
     <mo>(</mo><msub><mi>F</mi><mrow><mi>i</mi><mo>−</mo><mn>1</mn></mrow></msub><mo>+</mo><msub><mi>F</mi><mi>i</mi>\
     </msub><mo>)</mo></mrow>",
    "<msup><mi>V</mi><mo>′</mo></msup><mo>=</mo><mrow><mo>(</mo><mn>1</mn><mo>−</mo><mi>α</mi><mo>−</mo><mi>β</mi>\
     <mo>)</mo></mrow><mi>V</mi><mo>+</mo><mfrac><mi>α</mi><mi>n</mi></mfrac><munder><mo>∑</mo><mi>i</mi></munder><msub>\
     <mi>E</mi><mi>i</mi></msub><mo>+</mo><mfrac><mi>β</mi><mi>n</mi></mfrac><munder><mo>∑</mo><mi>i</mi></munder>\
     <msub><mi>F</mi><mi>i</mi></msub>",
];

/// How the tension goes from level to level.
const TENSION: &str = "<msup><mi>u</mi><mo>′</mo></msup><mo>=</mo><msqrt><mfrac><mrow><mn>1</mn><mo>+</mo><mi>u</mi></mrow>\
                       <mn>2</mn></mfrac></msqrt>";

fn inline(formula: &str) -> Markup {
    html! { math displaystyle="true" { (PreEscaped(formula.to_owned())) } }
}

fn block(formula: &str) -> Markup {
    html! { math display="block" { (PreEscaped(formula.to_owned())) } }
}

/// A line for each weight.
fn equations(weights: &[[String; 2]]) -> Markup {
    html! {
        div.equations {
            @for [name, value] in weights { (block(&format!("{name}<mo>=</mo>{value}"))) }
        }
    }
}

/// The section.
pub(super) fn section(topic: &Topic) -> Result<Section, Error> {
    let read = file(topic)?;
    let (formulas, values) = match (topic.name, &read) {
        (SchemeName::File(_), Some(file)) => (Some(file.clone()), true),
        // those of the lambda-scheme differ from valence to valence, and are tabulated
        (SchemeName::Spec(spec), _) => (like(spec)?, !matches!(spec, Spec::Lambda { .. } | Spec::LambdaOptimal)),
        (SchemeName::File(_) | SchemeName::NonUniform(_), _) => (None, true),
    };
    let body = html! {
        (origin(topic))
        @match &formulas {
            Some(file) => {
                @if values { (parameters(file.parameters(), topic.valences)) }
                (typeset(file, topic.valences))
            },
            None => p.note { "No formulas are written down for this member of the family: its weights are those below." },
        }
        (members(topic)?)
        (numbers(topic))
    };
    let mut commands = Vec::new();
    if let (SchemeName::Spec(_), Some(file)) = (topic.name, &formulas) {
        commands.push(format!(
            "eigenring new-scheme --like {}",
            file.name().split(',').next().unwrap_or_default()
        ));
    }
    commands.extend(
        topic
            .valences
            .first()
            .map(|&valence| command::at("matrix", topic, valence, "--format csv")),
    );
    Ok(Section {
        id: "scheme",
        title: "The scheme",
        body,
        commands,
    })
}

/// Where it comes from.
fn origin(topic: &Topic) -> Markup {
    match topic.name {
        SchemeName::File(file) => html! { p { "The scheme of the file " code { (file.path.display()) } "." } },
        SchemeName::NonUniform(scheme) => {
            html! { p { code { (scheme) } ", built in, with the knot intervals of the mesh." } }
        }
        SchemeName::Spec(spec) => {
            let name = spec.to_string();
            let family = name.split(':').next().unwrap_or_default();
            let summary = registry()
                .iter()
                .find(|known| known.name == family)
                .map(|known| known.summary);
            html! { p { code { (name) } ", built in. The family: " (summary.unwrap_or_default()) "." } }
        }
    }
}

/// The file with formulas that a built-in scheme is equal to, if there is one.
fn like(spec: &Spec) -> Result<Option<UserScheme>, Error> {
    let (name, tension) = match (spec, spec.order_and_tension()) {
        (Spec::CatmullClark, _) => ("catmull-clark", None),
        (Spec::DooSabin, _) => ("doo-sabin", None),
        (Spec::DooSabinUniform, _) => ("doo-sabin:uniform", None),
        (Spec::Lambda { .. } | Spec::LambdaOptimal, _) => ("lambda", None),
        (_, Some((3, u0))) => ("tension:order=3", Some(u0)),
        (_, Some((4, u0))) => ("morin", Some(u0)),
        (_, Some((6, 1.0))) => ("stam:order=6", None),
        _ => return Ok(None),
    };
    let Some(starter) = starters().iter().find(|starter| starter.like == name) else {
        return Ok(None);
    };
    let file = UserScheme::parse(starter.text, name, Reading::Exact)?;
    Ok(Some(match tension {
        Some(u0) => file.with(&[("u0", Number::from_decimal(u0)?)])?,
        None => file,
    }))
}

fn parameters(parameters: &[Parameter], valences: &[usize]) -> Markup {
    if parameters.is_empty() {
        return html! {};
    }
    let mut table = Table::new(["parameter", "value", "default", "range", "meaning"]);
    for known in parameters {
        let range = known.range.as_ref().map(|[least, most]| format!("{least} to {most}"));
        table.push(vec![
            known.name.as_str().into(),
            value(known, valences).into(),
            known.default.to_string().into(),
            range.into(),
            known.doc.as_str().into(),
        ]);
    }
    table.html("Parameters and the values that they have on this page")
}

/// The value of a parameter at these valences: one, or each where they differ.
fn value(known: &Parameter, valences: &[usize]) -> String {
    let runs = valences.chunk_by(|a, b| known.at(*a) == known.at(*b));
    let runs: Vec<&[usize]> = runs.collect();
    match runs.as_slice() {
        [] => known.default.to_string(),
        [one] => known.at(one[0]).to_string(),
        several => {
            let texts = several
                .iter()
                .map(|run| format!("{} at N = {}", known.at(run[0]), command::ranges(run)));
            texts.collect::<Vec<_>>().join("; ")
        }
    }
}

/// Formulas of the rules that hold at these valences.
fn typeset(file: &UserScheme, valences: &[usize]) -> Markup {
    let set = file.typeset();
    let listed = |n: usize| set.rules.iter().any(|rule| rule.first == n && rule.last == Some(n));
    let holds = |rule: &&TypesetRule| {
        let within = |n: &usize| (rule.first..=rule.last.unwrap_or(usize::MAX)).contains(n);
        let single = rule.last == Some(rule.first);
        valences.iter().filter(|n| single || !listed(**n)).any(within)
    };
    let rules: Vec<&TypesetRule> = set.rules.iter().filter(holds).collect();
    let spoken: Vec<usize> = valences
        .iter()
        .copied()
        .filter(|n| {
            rules
                .iter()
                .all(|rule| !(rule.first..=rule.last.unwrap_or(usize::MAX)).contains(n))
        })
        .collect();
    html! {
        @if let Some(tension) = &set.tension {
            p { "The tension of the first refinement is " (inline(tension)) ", and from level to level" }
            (block(TENSION))
        }
        @if rules.iter().any(|rule| matches!(rule.form, TypesetForm::OneRing(_))) {
            p { "Around a vertex " i { "V" } " with edge neighbours " i { "E" sub { "i" } } " and face neighbours "
                i { "F" sub { "i" } } ", refined points are" }
            div.equations { @for rule in ONE_RING { (block(rule)) } }
        }
        @for rule in &rules {
            h3 { (range(rule)) }
            @match &rule.form {
                TypesetForm::OneRing(weights) => (equations(weights)),
                TypesetForm::Passes(passes) => { @for (index, one) in passes.iter().enumerate() { (pass(index, one)) } },
            }
        }
        @if !set.names.is_empty() {
            h3 { "Where" }
            (equations(&set.names))
        }
        @if !spoken.is_empty() {
            p.note { "At N = " (command::ranges(&spoken)) " all points have the regular rule." }
        }
    }
}

fn range(rule: &TypesetRule) -> String {
    match rule.last {
        Some(last) if last == rule.first => format!("Rules at n = {last}"),
        Some(last) => format!("Rules for {} ≤ n ≤ {last}", rule.first),
        None => format!("Rules for n ≥ {}", rule.first),
    }
}

fn net(lattice: Lattice) -> &'static str {
    match lattice {
        Lattice::Vertex => "vertex net",
        Lattice::Face => "face net",
    }
}

fn place([x, y]: [i32; 2]) -> String {
    format!("({x}, {y})").replace('-', "\u{2212}")
}

/// A pass: its line in one dimension, and its points with stencils of their own.
fn pass(index: usize, pass: &TypesetPass) -> Markup {
    let caption = format!(
        "Pass {}, from {} to {}: regular points, as tensor product",
        index + 1,
        net(pass.from),
        net(pass.to)
    );
    let count: usize = pass.special.iter().map(|point| point.terms.len()).sum();
    html! {
        div.wide tabindex="0" role="region" aria-label=(caption) { table {
            caption { (caption) ". Offsets are half steps: the target " i { "X" } " reads (" i { "X" } " + offset)/" (pass.line.len()) "." }
            thead { tr { th scope="col" { "class" } th scope="col" { "offset" } th scope="col" { "weight" } } }
            tbody { @for (class, taps) in pass.line.iter().enumerate() { @for (offset, weight) in taps { tr {
                th scope="row" { (class) } td { (offset.to_string().replace('-', "\u{2212}")) } td { (inline(weight)) }
            } } } }
        } }
        @if count > MOST {
            p.note { (count) " terms of points with stencils of their own are too many for a page." }
        } @else if count > 0 {
            div.wide tabindex="0" role="region" aria-label="Points with stencils of their own" { table {
                caption { "Pass " (index + 1) ": points with stencils of their own, in half steps along the two spokes of a sector" }
                thead { tr {
                    th scope="col" { "refined point" } th scope="col" { "reads" } th scope="col" { "in sector" }
                    th scope="col" { "weight" }
                } }
                tbody { @for point in &pass.special { @for term in &point.terms { tr {
                    th scope="row" { (place(point.at)) @if point.sector != 0 { " of sector " (point.sector) } }
                    td { (place(term.at)) }
                    td { @match term.sectors {
                        TypesetSectors::One(sector) => (sector.to_string().replace('-', "\u{2212}")),
                        TypesetSectors::All => "all",
                        TypesetSectors::Each => { i { "k" } " = 0, …, " i { "n" } " − 1, others where listed" },
                    } }
                    td { (inline(&term.weight)) }
                } } } }
            } }
        }
    }
}

/// The members of the lambda-scheme that the name stands for.
fn members(topic: &Topic) -> Result<Markup, Error> {
    let mut all: Option<Table> = None;
    for &valence in topic.valences {
        let Some(member) = topic.name.member(valence, topic.tuner)? else {
            return Ok(html! {});
        };
        let row = weights(&member).table();
        match &mut all {
            Some(table) => table.append(row),
            None => all = Some(row),
        }
    }
    let all = all.unwrap_or_default();
    Ok(html! {
        p { "In the formulas " i { "p" } " and " i { "q" } " are the free weights f2 and f3, λ and s those of the table, and φ is 6." }
        (all.html("The member at each valence, and its weights"))
        (all.sources("The weights"))
    })
}

/// The weights of the limit level as numbers, at the first valence.
fn numbers(topic: &Topic) -> Markup {
    let Some((valence, scheme)) = topic.each().next() else {
        return html! {};
    };
    let table = special(scheme);
    let level = match scheme.leading().len() {
        0 => "",
        _ => " of the limit level",
    };
    let caption = format!("Weights{level} of points with stencils of their own at N = {valence}, in half steps");
    html! {
        @if table.is_empty() {
            p.note { "At N = " (valence) " no point has a stencil of its own." }
        } @else {
            details.valence {
                summary { "As numbers, at N = " (valence) }
                @if table.len() > MOST {
                    p.note { (table.len()) " weights are too many for a page; they can be copied." }
                } @else {
                    (table.html(&caption))
                }
                (table.sources("The weights"))
            }
        }
    }
}

fn special(scheme: &Scheme<f64>) -> Table {
    let mut table = Table::new(["pass", "refined point", "reads", "sector", "weight"]);
    for (index, pass) in scheme.limit().passes().iter().enumerate() {
        for (site, stencil) in pass.special() {
            for (source, weight) in stencil.terms() {
                table.push(vec![
                    (index + 1).into(),
                    place([site.x, site.y]).into(),
                    place([source.x, source.y]).into(),
                    source.sector.into(),
                    (*weight).into(),
                ]);
            }
        }
    }
    table
}
