//! One page about a scheme, as a self-contained HTML file.
//!
//! What the scheme is, what is proven of it, its spectra, limit stencils, natural configurations,
//! characteristic and second-order maps, a comparison with Catmull-Clark, and the commands that print each
//! part. Nothing is computed here: every part asks the function behind its command. Markup is made by
//! `maud`, whose elements are closed and whose texts are escaped by construction; the page names no other
//! file, and forbids its browser to load any.
//!
//! What has no meaning for a scheme (a characteristic map where the subdominant eigenvalue is of another
//! Fourier block than 1) is said in a line, in the words of the function that was asked.

mod command;
mod frame;
mod maps;
mod rules;
mod spectra;
mod verdicts;

use crate::compare::{self, compare};
use crate::error::Error;
use crate::schemes::{SchemeName, Tuner};
use eigenring_scheme::user::Reading;
use eigenring_scheme::{Lattice, Scheme, Spec, Symmetry};
use frame::{Section, document};
use maud::{Markup, html};

/// What the page is about.
struct Topic<'a> {
    name: &'a SchemeName,
    valences: &'a [usize],
    tuner: &'a Tuner<'a>,
    /// The scheme at each valence.
    schemes: Vec<Scheme<f64>>,
}

impl Topic<'_> {
    /// What the scheme is called.
    fn title(&self) -> &str {
        self.schemes.first().map_or("", Scheme::name)
    }

    /// Each valence with the scheme there.
    fn each(&self) -> impl Iterator<Item = (usize, &Scheme<f64>)> {
        self.valences.iter().copied().zip(&self.schemes)
    }
}

/// The page about a scheme at some valences, in ascending order and at least one.
///
/// # Errors
/// A valence for which the scheme has no rules; those of its file. What cannot be said of the scheme is part
/// of the page.
pub fn page(name: &SchemeName, valences: &[usize], tuner: &Tuner<'_>) -> Result<String, Error> {
    let schemes = valences.iter().map(|&valence| name.scheme(valence, tuner));
    let topic = Topic {
        name,
        valences,
        tuner,
        schemes: schemes.collect::<Result<_, Error>>()?,
    };
    let certificates = verdicts::certificates(&topic)?;
    let analyses = spectra::analyses(&topic)?;
    let mut sections = vec![
        rules::section(&topic)?,
        verdicts::section(&topic, &certificates),
        spectra::eigenvalues(&topic, &analyses),
        spectra::limit_stencils(&topic, &analyses),
    ];
    sections.extend(maps::sections(&topic, &analyses)?);
    sections.push(comparison(&topic)?);
    let lead = html! {
        p { (kind(&topic)) }
        (verdicts::glance(&topic, &analyses, &certificates))
    };
    let command = command::of("report", &topic, "-o page.html");
    Ok(document(topic.title(), &lead, &sections, &command))
}

/// In a sentence: around what, of which degree, with which levels and symmetry.
fn kind(topic: &Topic) -> String {
    let Some(scheme) = topic.schemes.first() else {
        return String::new();
    };
    let centre = match scheme.lattice() {
        Lattice::Vertex => "a vertex of valence N",
        Lattice::Face => "a face of N corners",
    };
    let regular = match scheme.degree() {
        Some(degree) => format!("Its regular part is the tensor-product B-spline surface of degree {degree}."),
        None => "Its regular part is no uniform B-spline surface, so that nothing is proven of maps.".to_owned(),
    };
    let levels = match scheme.leading().len() {
        0 => "All levels of refinement are alike.".to_owned(),
        leading => format!("Its levels differ: {leading} are stored before the limit level, which governs continuity."),
    };
    let symmetry = match topic.schemes.iter().map(|scheme| scheme.limit().symmetry()).min() {
        Some(Symmetry::Dihedral) => "The rules are the same in all sectors and in the mirror.",
        Some(Symmetry::Rotation) => "The rules are the same in all sectors, but not in the mirror.",
        _ => "The rules differ from sector to sector.",
    };
    format!("A subdivision scheme around {centre}. {regular} {levels} {symmetry}")
}

/// Digits of numbers that are to be compared: full precision is beside them.
const DIGITS: usize = 7;

/// The scheme beside Catmull-Clark.
fn comparison(topic: &Topic) -> Result<Section, Error> {
    let reference = SchemeName::Spec(Spec::CatmullClark);
    let itself = *topic.name == reference;
    let mut schemes = vec![topic.name.clone()];
    if !itself {
        schemes.push(reference);
    }
    let rows = compare(&schemes, topic.valences, topic.tuner)?;
    let mut table = compare::table(rows.clone());
    if rows.iter().all(|row| row.remark.is_empty()) {
        table = table.without("remark");
    }
    let shown = if itself {
        table.clone().without("scheme")
    } else {
        table.clone()
    };
    let body: Markup = html! {
        @if itself {
            p { "The scheme is Catmull and Clark's itself: these are its numbers." }
        }
        (shown.html_with("Figures of merit by valence", DIGITS))
        (legend(compare::LEGEND))
        (table.sources("The table"))
    };
    Ok(Section {
        id: "comparison",
        title: "Comparison with Catmull-Clark",
        body,
        commands: vec![command::compare(topic, itself)],
    })
}

/// Lines of words and what they mean.
fn legend(lines: &str) -> Markup {
    html! {
        dl.legend {
            @for (word, meaning) in lines.lines().filter_map(|line| line.split_once("  ")) {
                dt { (greek(word)) }
                dd { (greek(meaning.trim())) }
            }
        }
    }
}

/// Words of a terminal as they are set in a page.
fn greek(text: &str) -> String {
    let words = [
        ("mu/lambda^2", "μ/λ²"),
        ("|mu|/lambda", "|μ|/λ"),
        ("lambda^2", "λ²"),
        ("lambda", "λ"),
        ("theta", "θ"),
    ];
    words
        .iter()
        .fold(text.to_owned(), |text, (word, set)| text.replace(word, set))
}

/// What is read of a file, if the scheme is one.
fn file(topic: &Topic) -> Result<Option<eigenring_scheme::user::UserScheme>, Error> {
    match topic.name {
        SchemeName::File(file) => file.read(Reading::default()).map(Some),
        SchemeName::Spec(_) | SchemeName::NonUniform(_) => Ok(None),
    }
}

#[cfg(test)]
mod tests;
