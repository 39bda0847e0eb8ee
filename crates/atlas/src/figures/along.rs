//! Spectra of scheme files along one of their parameters.
//!
//! Moduli of the eigenvalues against the parameter, a colour for each of the Fourier indices 0, 1, 2 and one
//! for the others. The branches of an index are sorted by modulus, so where two of them cross they exchange.
//! Curvature is bounded where the largest of indices 0 and 2 lie on the dotted line, the square of the
//! subdominant eigenvalue, and nothing else is above it (Ma, Wang and Ma 2023, section 3).

use super::grid::Grid;
use super::spectra::{COLUMNS, cells};
use super::subject::chosen;
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::spectrum::Analysis;
use crate::sweep::{Sweep, spectra};
use crate::table::Table;
use eigenring_figure::{Axis, Chart, Colour, Dash, Figure, Panel, Side, Style, range_of};
use eigenring_scheme::Number;
use eigenring_spectral::Eigenvalue;

/// The narrowest panel, in millimetres.
const NARROWEST: f64 = 70.0;
/// Height of a panel, in millimetres.
const HEIGHT: f64 = 52.0;

/// Which Fourier indices share a colour, and what they are called.
const INDICES: [(&str, Dash); 4] = [
    ("index 0", Dash::Solid),
    ("index 1", Dash::Dashed),
    ("index 2", Dash::DashDot),
    ("other indices", Dash::Solid),
];

/// The figure of an entry with a sweep in the place of single spectra.
pub fn build(entry: &FigureEntry, inputs: &Inputs<'_>, sweep: &Sweep) -> Result<Vec<Drawing>, Error> {
    let (rows, columns) = (inputs.schemes.len(), inputs.valences.len());
    let grid = Grid::new(rows, columns, inputs.width, 0.0, NARROWEST);
    let title = format!("Eigenvalues along {}", sweep.parameter);
    let mut figure = Figure::new(inputs.width, grid.height(HEIGHT) + 10.0, title);
    let names = ["scheme", "valence", sweep.parameter.as_str()];
    let mut table = Table::new(names.into_iter().chain(COLUMNS));
    for (column, &valence) in inputs.valences.iter().enumerate() {
        for (row, (subject, scheme)) in chosen(inputs, valence)?.iter().zip(inputs.schemes).enumerate() {
            let found = spectra(scheme, sweep, valence, [None; 2], inputs.tuner.progress)?;
            for (value, analysis) in &found {
                for e in &analysis.spectrum.eigenvalues {
                    let mut row = vec![subject.name.as_str().into(), valence.into(), value.value().into()];
                    row.extend(cells(e));
                    table.push(row);
                }
            }
            let (at_row, at_column) = grid.place(row, column);
            let panel = Panel::new(chart(sweep, valence, &found)).title(subject.full_title());
            figure = figure.panel(at_row, at_column, panel);
        }
    }
    Ok(vec![Drawing::of(entry, figure.legend(Side::Bottom), table)])
}

/// The moduli of a spectrum whose Fourier index has this place among [`INDICES`], in falling order.
fn moduli(analysis: &Analysis, valence: usize, place: usize) -> Vec<f64> {
    let place_of = |e: &&Eigenvalue| {
        let index = e.fourier.map_or(0, |k| k.min(valence - k));
        index.min(INDICES.len() - 1) == place
    };
    let of_place = analysis.spectrum.eigenvalues.iter().filter(place_of);
    let mut moduli: Vec<f64> = of_place
        .flat_map(|e| std::iter::repeat_n(e.modulus(), e.multiplicity / e.blocks))
        .collect();
    moduli.sort_by(|a, b| b.total_cmp(a));
    moduli
}

fn chart(sweep: &Sweep, valence: usize, found: &[(Number, Analysis)]) -> Chart {
    let at = |value: &Number| value.value();
    let ends = range_of(found.iter().map(|(value, _)| at(value)), 0.0).unwrap_or((0.0, 1.0));
    let all = found.iter().flat_map(|(_, analysis)| &analysis.spectrum.eigenvalues);
    let (_, top) = range_of(all.map(Eigenvalue::modulus).chain([0.0, 1.0]), 0.04).unwrap_or((0.0, 1.0));
    let y = Axis::new("|eigenvalue|", (0.0, top)).with_grid();
    let mut chart = Chart::new(Axis::new(sweep.parameter.clone(), ends), y);
    for (place, (name, dash)) in INDICES.into_iter().enumerate() {
        let spectra: Vec<(f64, Vec<f64>)> = found
            .iter()
            .map(|(value, analysis)| (at(value), moduli(analysis, valence, place)))
            .collect();
        let branches = spectra.iter().map(|(_, moduli)| moduli.len()).max().unwrap_or(0);
        let colour = if place + 1 < INDICES.len() {
            Colour::line(place)
        } else {
            Colour::GREY
        };
        for branch in 0..branches {
            let points = spectra
                .iter()
                .filter_map(|(x, moduli)| Some([*x, *moduli.get(branch)?]));
            chart = chart.series(points.collect::<Vec<_>>(), Style::solid(colour).dashed(dash));
            if branch == 0 {
                chart = chart.label(name);
            }
        }
    }
    let squares = found.iter().filter_map(|(value, analysis)| {
        let lambda = analysis.spectrum.subdominant()?.modulus();
        Some([at(value), lambda * lambda])
    });
    let dotted = Style::solid(Colour::INK).dashed(Dash::Dotted);
    chart.series(squares.collect::<Vec<_>>(), dotted).label("$λ^2$")
}
