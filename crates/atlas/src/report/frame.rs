//! The document around the sections: head, contents, style, and a script without which the page works too.

use super::command;
use eigenring_figure::Colour;
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// A part of the page.
pub(super) struct Section {
    /// What links to it name.
    pub id: &'static str,
    /// Its heading.
    pub title: &'static str,
    /// What it says.
    pub body: Markup,
    /// The commands that print it.
    pub commands: Vec<String>,
}

/// Nothing but what is in the page.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The colours of figures on a dark page: those of text, frames and page by their meaning, those of lines
/// lighter. What maps colour stays.
fn dark_figures() -> String {
    let lines: [&str; 6] = ["#5aaeea", "#ff8f4a", "#dc8cc2", "#35cf9f", "#7cc8f2", "#e0b43c"];
    let named = [
        (Colour::INK, "var(--ink)"),
        (Colour::GREY, "var(--soft)"),
        (Colour::PALE, "var(--rule)"),
        (Colour::WHITE, "var(--page)"),
        (Colour::SHADE, "#1d3527"),
    ];
    let all = named.into_iter().chain(Colour::LINES.into_iter().zip(lines));
    let rules = all.map(|(colour, dark)| {
        let hex = colour.hex();
        format!("  figure [fill=\"{hex}\"] {{ fill: {dark} }}\n  figure [stroke=\"{hex}\"] {{ stroke: {dark} }}\n")
    });
    format!(
        "@media screen and (prefers-color-scheme: dark) {{\n{}}}\n",
        rules.collect::<String>()
    )
}

/// Commands that can be copied.
pub(super) fn commands(commands: &[String]) -> Markup {
    html! {
        @if !commands.is_empty() {
            div.source {
                p.how { "Printed again by" }
                pre { code { (commands.join("\n")) } }
            }
        }
    }
}

/// The whole page.
pub(super) fn document(title: &str, lead: &Markup, sections: &[Section], command: &str) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="generator" content=(concat!("eigenring ", env!("CARGO_PKG_VERSION")));
                title { (title) " – subdivision scheme" }
                style { (PreEscaped(STYLE)) (PreEscaped(dark_figures())) }
            }
            body {
                a.skip href="#content" { "To the content" }
                header {
                    h1 { (title) }
                    (lead)
                }
                nav aria-label="Contents" {
                    ol {
                        @for section in sections {
                            li { a href={ "#" (section.id) } { (section.title) } }
                        }
                    }
                }
                main id="content" {
                    @for section in sections {
                        section id=(section.id) aria-labelledby={ (section.id) "-title" } {
                            h2 id={ (section.id) "-title" } { (section.title) }
                            (section.body)
                            (commands(&section.commands))
                        }
                    }
                }
                footer {
                    p { "Written by eigenring " (env!("CARGO_PKG_VERSION")) ". The words are those of its glossary: " (GLOSSARY) }
                    (commands(&[command.to_owned()]))
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// What a reader needs to know of the tables.
const GLOSSARY: &str = "λ is the subdominant eigenvalue of the limit level's local matrix, μ the next smaller one; curvature is \
bounded at the centre without a flat spot where μ = λ². Proven and refuted mean: by intervals with outward rounding and exact \
arithmetic alone, for almost all control nets. Undecided means neither.";

/// Valences with the words that head them.
pub(super) fn valence_heading(valence: usize) -> String {
    format!("N = {}", command::ranges(&[valence]))
}
