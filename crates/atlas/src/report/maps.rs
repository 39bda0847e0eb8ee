//! Pictures: those of `eigenring plot`, within the page.

use super::Topic;
use super::command;
use super::frame::Section;
use crate::error::Error;
use crate::figures::{Drawing, FigureEntry, Inputs, Studies, find};
use crate::progress::{Silent, each};
use maud::{Markup, PreEscaped, html};

/// Dots per inch of dense maps, at the printed size: three for two of a usual screen's.
const DPI: f64 = 150.0;

/// Valences beside each other in a picture of maps: with more, each gets too few cells.
const ABREAST: usize = 4;

/// The drawings of some valences, or why there are none.
fn draw(entry: &FigureEntry, topic: &Topic, valences: &[usize]) -> Result<Vec<Drawing>, Error> {
    let inputs = Inputs {
        valences,
        lambdas: &[],
        schemes: std::slice::from_ref(topic.name),
        colours: entry.colours,
        range: (0.0, 1.0),
        width: entry.width,
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
        @for (valences, reason) in by_reason(&missing) {
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

/// The sections on natural configurations, characteristic and second-order maps.
pub(super) fn sections(topic: &Topic) -> Result<Vec<Section>, Error> {
    let kinds = [
        (
            "natural",
            "Natural configurations",
            "natural-configurations",
            "Control nets of the characteristic maps: refined, each is itself times λ.",
            topic.valences.len(),
        ),
        (
            "characteristic",
            "Characteristic maps",
            "characteristic-map",
            "Patches of the characteristic maps, coloured by the Jacobian: a scheme is C1 at the centre if the map is regular \
             and injective (Reif 1995).",
            ABREAST,
        ),
        (
            "second-order",
            "Second-order maps",
            "second-order-maps",
            "Cup and saddles over the characteristic map, coloured by the Gauss curvature K*, which is constant where they are \
             quadratics, as continuous curvature needs; where its sign is wrong the region is outlined.",
            1,
        ),
    ];
    let mut pieces: Vec<(usize, &str, &[usize])> = Vec::new();
    for (which, (_, _, figure, _, abreast)) in kinds.iter().enumerate() {
        pieces.extend(
            topic
                .valences
                .chunks((*abreast).max(1))
                .map(|chunk| (which, *figure, chunk)),
        );
    }
    let drawn = each(topic.tuner.progress, "pictures", &pieces, |(which, figure, chunk)| {
        Ok::<_, Error>((*which, picture(figure, topic, chunk)))
    })?;
    let section =
        |(which, (id, title, figure, text, _)): (usize, &(&'static str, &'static str, &str, &str, usize))| Section {
            id,
            title,
            body: html! {
                p { (text) }
                @for (_, markup) in drawn.iter().filter(|(of, _)| *of == which) { (markup) }
            },
            commands: vec![command::plot(figure, topic, topic.valences)],
        };
    Ok(kinds.iter().enumerate().map(section).collect())
}
