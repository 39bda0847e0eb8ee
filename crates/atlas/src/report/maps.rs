//! Pictures: those of `eigenring plot`, within the page.

use super::Topic;
use super::command;
use super::frame::Section;
use crate::error::Error;
use crate::figures::{Drawing, FigureEntry, Inputs, Studies, find};
use crate::progress::{Silent, each};
use crate::spectrum::Analysis;
use maud::{Markup, PreEscaped, html};

/// Dots per inch of dense maps, at the printed size: three for two of a usual screen's.
const DPI: f64 = 150.0;

/// The drawings of some valences, or why there are none.
fn draw(entry: &FigureEntry, topic: &Topic, valences: &[usize]) -> Result<Vec<Drawing>, Error> {
    let inputs = Inputs {
        valences,
        lambdas: &[],
        schemes: std::slice::from_ref(topic.name),
        colours: entry.colours,
        range: (0.0, 1.0),
        width: entry.width,
        sweep: None,
        knots: None,
        studies: &Studies::load(None, &[], &Silent)?,
        tuner: topic.tuner,
    };
    (entry.build)(&inputs)
}

/// A figure of some valences, each of which it has a meaning for or is told why not.
pub(super) fn picture(name: &str, topic: &Topic, valences: &[usize]) -> Markup {
    match find(name) {
        Ok(entry) => shown(entry, topic, valences),
        Err(error) => html! { p.note { (error) } },
    }
}

fn shown(entry: &FigureEntry, topic: &Topic, valences: &[usize]) -> Markup {
    let (drawings, drawn, missing) = match draw(entry, topic, valences) {
        Ok(drawings) => (drawings, valences.to_vec(), Vec::new()),
        Err(_) => {
            // some valences may have the picture and others not
            let alone = |&valence: &usize| {
                draw(entry, topic, &[valence])
                    .err()
                    .map(|error| (valence, error.to_string()))
            };
            let missing: Vec<(usize, String)> = valences.iter().filter_map(alone).collect();
            let has_one = |valence: &usize| missing.iter().all(|(other, _)| other != valence);
            let rest: Vec<usize> = valences.iter().copied().filter(has_one).collect();
            let drawings = if rest.is_empty() {
                Ok(Vec::new())
            } else {
                draw(entry, topic, &rest)
            };
            (drawings.unwrap_or_default(), rest, missing)
        }
    };
    html! {
        @for drawing in &drawings { (figure(entry, drawing, &drawn)) }
        (not_drawn(&missing))
    }
}

/// Why there are no pictures.
fn not_drawn(missing: &[(usize, String)]) -> Markup {
    html! {
        @for (valences, reason) in by_reason(missing) {
            p.note { "No picture at N = " (command::ranges(&valences)) ": " (reason) "." }
        }
    }
}

/// Valences with the same reason, in the order of the first of each.
fn by_reason(missing: &[(usize, String)]) -> Vec<(Vec<usize>, &str)> {
    let mut found: Vec<(Vec<usize>, &str)> = Vec::new();
    for (valence, reason) in missing {
        match found.iter_mut().find(|(_, known)| known == reason) {
            Some((valences, _)) => valences.push(*valence),
            None => found.push((vec![*valence], reason)),
        }
    }
    found
}

fn figure(entry: &FigureEntry, drawing: &Drawing, valences: &[usize]) -> Markup {
    let first = valences.first().copied().unwrap_or_default();
    let prefix = format!("{}-{first}-", drawing.stem);
    match drawing.figure.inline_svg(&prefix, DPI) {
        Ok(svg) => html! {
            figure {
                (PreEscaped(svg))
                figcaption { "N = " (command::ranges(valences)) ", as in " (entry.reference) "." }
            }
        },
        Err(error) => html! { p.note { "Not drawn: " (error) "." } },
    }
}

/// A section of pictures.
struct MapKind {
    id: &'static str,
    title: &'static str,
    figure: &'static str,
    text: &'static str,
    /// Valences in a picture; all of them if not given.
    abreast: Option<usize>,
}

const KINDS: [MapKind; 3] = [
    MapKind {
        id: "natural",
        title: "Natural configurations",
        figure: "natural-configurations",
        text: "Control nets of the characteristic maps: refined, each is itself times λ.",
        abreast: None,
    },
    MapKind {
        id: "characteristic",
        title: "Characteristic maps",
        figure: "characteristic-map",
        text: "Patches of the characteristic maps, coloured by the Jacobian: a scheme is C1 at the centre if the map is \
               regular and injective (Reif 1995).",
        // with more, each gets too few cells
        abreast: Some(4),
    },
    MapKind {
        id: "second-order",
        title: "Second-order maps",
        figure: "second-order-maps",
        text: "Cup and saddles over the characteristic map, coloured by the Gauss curvature K*, which is constant where they \
               are quadratics, as continuous curvature needs; where its sign is wrong the region is outlined.",
        abreast: Some(1),
    },
];

/// The sections on natural configurations, characteristic and second-order maps.
pub(super) fn sections(topic: &Topic, analyses: &[Analysis]) -> Result<Vec<Section>, Error> {
    // where another block than 1 leads, there is no characteristic map, and what a figure could draw is none
    let each_of = topic.valences.iter().copied().zip(analyses);
    let strays = each_of.filter_map(|(valence, Analysis { spectrum, .. })| {
        let (fourier, lambda) = spectrum.stray().zip(spectrum.subdominant())?;
        let value = lambda.modulus();
        let reason = eigenring_spectral::Error::Stray { value, fourier };
        Some((valence, reason.to_string()))
    });
    let strays: Vec<(usize, String)> = strays.collect();
    let is_drawn = |valence: &usize| strays.iter().all(|(stray, _)| stray != valence);
    let drawn_at: Vec<usize> = topic.valences.iter().copied().filter(is_drawn).collect();
    let pieces = KINDS.iter().flat_map(|kind| {
        let abreast = kind.abreast.unwrap_or(drawn_at.len()).max(1);
        drawn_at.chunks(abreast).map(move |chunk| (kind.figure, chunk))
    });
    let pieces: Vec<(&str, &[usize])> = pieces.collect();
    let drawn = each(topic.tuner.progress, "pictures", &pieces, |(figure, chunk)| {
        Ok::<_, Error>((*figure, picture(figure, topic, chunk)))
    })?;
    let section = |kind: &MapKind| Section {
        id: kind.id,
        title: kind.title,
        body: html! {
            p { (kind.text) }
            (not_drawn(&strays))
            @for (_, markup) in drawn.iter().filter(|(figure, _)| *figure == kind.figure) { (markup) }
        },
        commands: vec![command::plot(kind.figure, topic, topic.valences)],
    };
    Ok(KINDS.iter().map(section).collect())
}
