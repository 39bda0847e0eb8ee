//! Eigenvalues and limit stencils at each valence.

use super::command;
use super::frame::{Section, valence_heading};
use super::maps::picture;
use super::{Topic, legend};
use crate::error::Error;
use crate::progress::each;
use crate::spectrum::Analysis;
use eigenring_scheme::Corner;
use maud::{Markup, html};

/// Longer texts are not put into the page, which says how they are printed.
const LONGEST: usize = 120_000;

/// What `eigenring spectrum` prints, at each valence.
pub(super) fn analyses(topic: &Topic) -> Result<Vec<Analysis>, Error> {
    let centre = topic.name.centre()?;
    each(topic.tuner.progress, "spectra", topic.valences, |&valence| {
        let corner = Corner::closed(centre, valence)?;
        Analysis::of_name(topic.name, &corner, [None; 2], topic.tuner)
    })
}

/// What the list does not say by itself.
fn notes(analysis: &Analysis) -> Markup {
    html! {
        @for note in analysis.warning().into_iter().chain(analysis.notes()) {
            p.note { "Note: " (note) "." }
        }
    }
}

/// The section on eigenvalues.
pub(super) fn eigenvalues(topic: &Topic, found: &[Analysis]) -> Section {
    let words = "multiplicity  in the whole local matrix; one that blocks k and N-k share is listed once\n\
                 geometric  how many independent eigenvectors it has; fewer than the multiplicity: it is defective\n";
    let body = html! {
        p { "Eigenvalues of the limit level's local matrix, by falling modulus." }
        (legend(words))
        (picture("spectrum", topic, topic.valences))
        @for (index, analysis) in found.iter().enumerate() {
            @let heading = valence_heading(topic.valences[index]);
            @let table = analysis.eigenvalues();
            details.valence open[index == 0] {
                summary { (heading) ": " (analysis.system.numbering().count()) " points, " (table.len()) " different eigenvalues" }
                (notes(analysis))
                (table.html(&format!("{heading}: eigenvalues")))
                (table.sources("The eigenvalues"))
            }
        }
    };
    Section {
        id: "spectra",
        title: "Spectra",
        body,
        commands: commands(topic, ""),
    }
}

/// The section on limit stencils.
pub(super) fn limit_stencils(topic: &Topic, found: &[Analysis]) -> Section {
    let body = html! {
        p {
            "The limit point at the centre is the sum of the control points with the weights of " i { "position" } "; the \
             tangent plane there is spanned by the sums with those of the two " i { "tangents" } ". Tables list sector 0 \
             where it stands for all; what can be copied lists all points."
        }
        @for (index, analysis) in found.iter().enumerate() {
            @let heading = valence_heading(topic.valences[index]);
            @let all = analysis.limit_stencils();
            @let (table, missing) = analysis.limit_stencils_for_people();
            details.valence open[index == 0] {
                summary { (heading) ": " (all.len()) " points" }
                @for reason in missing { p.note { "Not defined: " (reason) "." } }
                (table.html(&format!("{heading}: limit and tangent stencils")))
                @if all.len() * 60 < LONGEST {
                    (all.sources("All weights"))
                } @else {
                    p.note { "All weights are too many for a page: " code {
                        (command::at("spectrum", topic, topic.valences[index], "--table limit-stencils --format csv"))
                    } }
                }
            }
        }
    };
    Section {
        id: "limit-stencils",
        title: "Limit and tangent stencils",
        body,
        commands: commands(topic, "--table limit-stencils --format csv"),
    }
}

fn commands(topic: &Topic, rest: &str) -> Vec<String> {
    let valences = topic.valences.iter();
    valences
        .map(|&valence| command::at("spectrum", topic, valence, rest))
        .collect()
}
