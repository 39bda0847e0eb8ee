//! The spline stencils of several valences, with what is feasible and recommended: Ma, Wang and Ma (2023),
//! Fig. 7.

use super::{Drawing, FigureEntry, Inputs, sweep};
use crate::error::Error;
use eigenring_figure::{Axis, Chart, Figure, Panel, Side};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 5, 6, 8, 12, 20],
    range: true,
    ..FigureEntry::new(
        "stencils",
        "spline stencils f2(lambda), f3(lambda) of several valences in their feasible domains",
        "Ma, Wang and Ma 2023, Fig. 7",
        build,
    )
};

/// Heights of a row of panels over two columns and over one, and of what stands around them, in millimetres.
const WIDE_ROW: f64 = 58.0;
const NARROW_ROW: f64 = 39.0;
const AROUND: f64 = 10.0;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let across = inputs.valences.len().min(if inputs.is_wide() { 3 } else { 1 });
    let rows = inputs.valences.len().div_ceil(across);
    let row = if inputs.is_wide() { WIDE_ROW } else { NARROW_ROW };
    let mut table = sweep::curve_table();
    let mut curves = Vec::new();
    for &valence in inputs.valences {
        let (entry, points) = sweep::curve(valence, inputs)?;
        sweep::push_curve(&mut table, valence, &points);
        curves.push((entry, points));
    }
    // one scale for all panels
    let top = curves
        .iter()
        .map(|(_, points)| sweep::largest(points))
        .fold(0.0, f64::max);
    let mut figure = Figure::new(
        inputs.width,
        row * rows as f64 + AROUND,
        "Spline stencils of the lambda-scheme",
    );
    for (index, (entry, points)) in curves.iter().enumerate() {
        let (row, column) = (index / across, index % across);
        let below = index + across >= curves.len();
        let weight = Axis::new(if column == 0 { "weight" } else { "" }, (0.0, 1.04 * top)).with_grid();
        let chart = Chart::new(sweep::lambda_axis(inputs, below), weight);
        let chart = sweep::draw_weights(sweep::mark(chart, entry, true), points);
        figure = figure.panel(row, column, Panel::new(chart).title(format!("$N$ = {}", entry.valence)));
    }
    Ok(vec![Drawing::of(&ENTRY, figure.legend(Side::Bottom), table)])
}
