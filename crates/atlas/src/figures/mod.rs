//! The figures, one module each.
//!
//! To add one: a module with an `ENTRY`, listed in [`FIGURES`]; the tests here and `eigenring plot --all`
//! then cover it.
//!
//! A figure is a registered [`FigureEntry`]: a name, what it shows, what it takes, and a function from
//! [`Inputs`] to [`Drawing`]s. Drawings are pure functions of their inputs; the command writes them. Each
//! drawing comes with the tables of the numbers it shows, which are what tests compare.

mod along;
mod blending;
mod certificates;
mod characteristic;
mod characteristic_meshes;
mod curvature_sign;
mod feasible_domain;
mod feasible_region;
mod grid;
mod natural;
mod nets;
mod overview;
mod points;
mod ranges;
mod samples;
mod second_order;
mod sheet;
mod spectra;
mod stencils;
mod studies;
mod subject;
mod sweep;
mod tension_curves;
mod uneven;
mod valences;
mod weighting;

pub use studies::Studies;

use crate::error::Error;
use crate::schemes::{SchemeName, Tuner};
use crate::sweep::Sweep;
use crate::table::Table;
use eigenring_figure::{Figure, Width};
use eigenring_nonuniform::Spokes;
use eigenring_scheme::did_you_mean;

/// A picture with its data.
#[derive(Debug)]
pub struct Drawing {
    /// File name without extension.
    pub stem: String,
    /// The picture.
    pub figure: Figure,
    /// Its data: a suffix of the file name, or an empty one, and the table.
    pub data: Vec<(&'static str, Table)>,
}

impl Drawing {
    /// A picture with one table, both under the figure's own name.
    fn of(entry: &FigureEntry, figure: Figure, table: Table) -> Self {
        Drawing {
            stem: entry.name.to_owned(),
            figure,
            data: vec![("", table)],
        }
    }
}

/// What a figure is drawn from.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The valences, at least one if the figure takes them.
    pub valences: &'a [usize],
    /// The lambdas, at least one if the figure takes them.
    pub lambdas: &'a [f64],
    /// The schemes, if the figure takes them; none stands for the figure's own choice.
    pub schemes: &'a [SchemeName],
    /// The range of values that colours show, if the figure has one.
    pub colours: Option<(f64, f64)>,
    /// The lambdas shown, if the figure takes a range; lower end first.
    pub range: (f64, f64),
    /// The width of the picture.
    pub width: Width,
    /// The parameter of scheme files along which the figure is drawn, if it is one.
    pub sweep: Option<&'a Sweep>,
    /// The knot intervals around a vertex, if the figure takes them and they are given.
    pub knots: Option<&'a Spokes>,
    /// Samples and splines of the lambda-scheme.
    pub studies: &'a Studies,
    /// Where members of the lambda-scheme that are not tabulated come from.
    pub tuner: &'a Tuner<'a>,
}

impl Inputs<'_> {
    /// Whether the picture is for two columns.
    pub fn is_wide(&self) -> bool {
        self.width == Width::Two
    }
}

/// A registered figure.
#[derive(Debug)]
pub struct FigureEntry {
    /// What it is called on the command line.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// The published figure that it corresponds to.
    pub reference: &'static str,
    /// The default valences; empty if it takes none.
    pub valences: &'static [usize],
    /// The default lambdas; empty if it takes none.
    pub lambdas: &'static [f64],
    /// The default schemes; `None` if it takes none, empty for its own choice. Lambdas then stand for members
    /// of the lambda-scheme.
    pub schemes: Option<&'static [&'static str]>,
    /// The default range of the colour scale, if there is one.
    pub colours: Option<(f64, f64)>,
    /// Whether a range of lambda can be chosen.
    pub range: bool,
    /// Whether it can be drawn along a parameter of scheme files.
    pub sweep: bool,
    /// Whether it takes knot intervals.
    pub knots: bool,
    /// Whether its schemes are those with knot intervals, whether these are given or not.
    pub uneven: bool,
    /// Whether it needs the studies of its valences.
    pub studies: bool,
    /// Whether regions are shaded by the stored certificates, if there are any.
    pub shaded: bool,
    /// The default width.
    pub width: Width,
    /// Draws it.
    pub build: fn(&Inputs<'_>) -> Result<Vec<Drawing>, Error>,
}

/// All figures, in the order in which they are listed.
pub const FIGURES: &[FigureEntry] = &[
    overview::ENTRY,
    feasible_region::ENTRY,
    weighting::ENTRY,
    samples::ENTRY,
    stencils::ENTRY,
    curvature_sign::ENTRY,
    feasible_domain::ENTRY,
    natural::ENTRY,
    characteristic::ENTRY,
    characteristic_meshes::ENTRY,
    second_order::ENTRY,
    spectra::ENTRY,
    tension_curves::ENTRY,
    certificates::ENTRY,
    blending::ENTRY,
];

impl FigureEntry {
    /// A figure over two columns that takes no options.
    const fn new(
        name: &'static str,
        title: &'static str,
        reference: &'static str,
        build: fn(&Inputs<'_>) -> Result<Vec<Drawing>, Error>,
    ) -> Self {
        FigureEntry {
            name,
            title,
            reference,
            valences: &[],
            lambdas: &[],
            schemes: None,
            colours: None,
            range: false,
            sweep: false,
            knots: false,
            uneven: false,
            studies: false,
            shaded: false,
            width: Width::Two,
            build,
        }
    }

    /// The default schemes.
    pub fn default_schemes(&self) -> Result<Vec<SchemeName>, Error> {
        let schemes = self.schemes.unwrap_or_default().iter();
        Ok(schemes
            .map(|spec| spec.parse())
            .collect::<Result<_, eigenring_scheme::Error>>()?)
    }
}

/// The figure with a name.
pub fn find(name: &str) -> Result<&'static FigureEntry, Error> {
    FIGURES.iter().find(|entry| entry.name == name).ok_or_else(|| {
        let names: Vec<&str> = FIGURES.iter().map(|entry| entry.name).collect();
        Error::Usage {
            message: format!(
                "there is no figure {name:?}{}",
                did_you_mean(name, names.iter().copied())
            ),
            accepted: names.join(", "),
        }
    })
}

/// All figures: name, what they show, what they correspond to, default valences.
pub fn list() -> Table {
    let mut table = Table::new(["name", "valences", "corresponds to", "shows"]);
    for entry in FIGURES {
        let valences: Vec<String> = entry.valences.iter().map(usize::to_string).collect();
        let valences = match entry.valences {
            [] => "-".to_owned(),
            [first, .., last] if last - first + 1 == entry.valences.len() => format!("{first}..{last}"),
            _ => valences.join(","),
        };
        table.push(vec![
            entry.name.into(),
            valences.into(),
            entry.reference.into(),
            entry.title.into(),
        ]);
    }
    table
}

#[cfg(test)]
mod tests;
