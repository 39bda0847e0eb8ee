//! Tables of a page: a caption, headings that name what they head, numbers on the right.

use super::{Cell, DIGITS, Format, Table, rounded};
use maud::{Markup, PreEscaped, html};

/// Quantities as they are set; other names are words.
const SYMBOLS: &[(&str, &str)] = &[
    ("valence", "<i>N</i>"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("mu/lambda^2", "μ/λ<sup>2</sup>"),
    ("K_m", "<i>K</i><sub>m</sub>"),
    ("E", "<i>E</i>"),
    ("theta", "θ (degrees)"),
    ("s", "<i>s</i>"),
    ("re", "Re"),
    ("im", "Im"),
    ("fourier", "Fourier index"),
    ("jordan", "Jordan blocks"),
    ("tangent_x", "tangent <i>x</i>"),
    ("tangent_y", "tangent <i>y</i>"),
    ("f1", "<i>f</i><sub>1</sub>"),
    ("f2", "<i>f</i><sub>2</sub>"),
    ("f3", "<i>f</i><sub>3</sub>"),
    ("d1", "<i>d</i><sub>1</sub>"),
    ("d2", "<i>d</i><sub>2</sub>"),
    ("e1", "<i>e</i><sub>1</sub>"),
    ("e2", "<i>e</i><sub>2</sub>"),
    ("alpha", "α"),
    ("beta", "β"),
];

fn heading(name: &str) -> Markup {
    match SYMBOLS.iter().find(|(known, _)| *known == name) {
        Some((_, symbol)) => PreEscaped((*symbol).to_owned()),
        None => html! { (name.replace('_', " ")) },
    }
}

/// A number with a true minus sign, and powers of ten as such.
fn number(text: &str) -> Markup {
    let text = text.replace('-', "\u{2212}");
    match text.split_once('e') {
        Some((mantissa, exponent)) => html! { (mantissa) "·10" sup { (exponent) } },
        None => html! { (text) },
    }
}

fn cell(cell: &Cell, digits: usize) -> Markup {
    match cell {
        Cell::Empty => html! { td.number { span aria-label="not defined" { "–" } } },
        Cell::Number(value) if value.is_finite() => html! { td.number { (number(&rounded(*value, digits))) } },
        Cell::Number(_) | Cell::Count(_) => html! { td.number { (cell.for_people()) } },
        Cell::Word(word) => match status(word) {
            Some(class) => html! { td { span class=(class) { (word) } } },
            None => html! { td { (word) } },
        },
    }
}

/// Words that are told apart by colour and sign too.
fn status(word: &str) -> Option<&'static str> {
    let known = ["proven", "refuted", "undecided", "numerical"];
    known.into_iter().find(|known| *known == word)
}

impl Table {
    /// The table as HTML, numbers to ten digits. The first column names the rows.
    pub fn html(&self, caption: &str) -> Markup {
        self.html_with(caption, DIGITS)
    }

    /// The same with so many digits.
    pub fn html_with(&self, caption: &str, digits: usize) -> Markup {
        html! {
            div.wide tabindex="0" role="region" aria-label=(caption) {
                table {
                    caption { (caption) }
                    thead { tr {
                        @for (index, name) in self.columns.iter().enumerate() {
                            th scope="col" class=[(!self.is_words(index)).then_some("number")] { (heading(name)) }
                        }
                    } }
                    tbody {
                        @for row in &self.rows { tr {
                            @for (index, entry) in row.iter().enumerate() {
                                @if index == 0 {
                                    th scope="row" { (entry.for_people()) }
                                } @else {
                                    (cell(entry, digits))
                                }
                            }
                        } }
                    }
                }
            }
        }
    }

    /// The table as text to be copied, in the formats that others read.
    pub fn sources(&self, what: &str) -> Markup {
        html! {
            @for (name, format) in [("CSV", Format::Csv), ("LaTeX", Format::Latex)] {
                details.source {
                    summary { (what) " as " (name) }
                    pre { code { (self.render(format)) } }
                }
            }
        }
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}
