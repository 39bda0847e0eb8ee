//! Featured lambdas against the valence: Ma, Wang and Ma (2023), Fig. 3.
//!
//! The paper gives bounds: C1 above `lambda_C1 = 1/8`, the outer rings' eigenvalue, and bounded curvature
//! from lambda_l on. Shaded is what the stored certificates prove of the splines, valence by valence:
//! bounded curvature begins a little above lambda_l, where the relaxation ends, and nothing was examined
//! outside the tabulated lambdas. Without stored certificates nothing is shaded.

use super::ranges::{Known, known, stored};
use super::valences::{Featured, LAMBDA_C1, axis};
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::table::Table;
use eigenring_figure::{Axis, Chart, Colour, Dash, Figure, MARKER, Marker, Panel, Side, Stroke, Style, Width};
use eigenring_tune::study::{LAMBDA_A, LAMBDA_M, LAMBDA_R1, paper_row};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20],
    width: Width::One,
    shaded: true,
    ..FigureEntry::new(
        "feasible-region",
        "featured lambdas and the feasible region against the valence",
        "Ma, Wang and Ma 2023, Fig. 3",
        build,
    )
};

/// Valences from which on markers are drawn smaller.
const CROWDED: usize = 30;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let (chart, table) = chart(inputs)?;
    let height = if inputs.is_wide() { 95.0 } else { 88.0 };
    let figure = Figure::new(inputs.width, height, "Featured lambdas against the valence").panel(
        0,
        0,
        Panel::new(chart).legend(Side::Bottom),
    );
    Ok(vec![Drawing::of(&ENTRY, figure, table)])
}

/// The chart and its data, for this figure and the overview.
pub fn chart(inputs: &Inputs<'_>) -> Result<(Chart, Table), Error> {
    let rows = Featured::of(inputs.valences, inputs)?;
    let n = |valence: usize| valence as f64;
    let mut chart = Chart::new(
        axis(inputs.valences),
        Axis::new("subdominant eigenvalue $λ$", (0.0, 1.0)),
    );
    let intervals = stored(inputs.studies.ranges.as_deref())?;
    for (wanted, line, tint, label) in [
        (Known::Unbounded, 5, 0.86, "proven $C^1$, curvature unbounded"),
        (Known::Bounded, 3, 0.7, "proven $C^1$, bounded curvature"),
    ] {
        let colour = Colour::line(line).mix(Colour::WHITE, tint);
        let of = |row: &Featured| {
            let (left, right) = (n(row.valence) - 0.5, n(row.valence) + 0.5);
            let parts = known(&intervals, row.valence)
                .into_iter()
                .filter(|part| part.1 == wanted);
            let cell = |([from, to], _): ([f64; 2], Known)| {
                (vec![[left, from], [right, from], [right, to], [left, to]], colour)
            };
            parts.map(cell).collect::<Vec<_>>()
        };
        chart = chart.areas(rows.iter().flat_map(of)).label(label);
    }

    let series = [
        (
            "$λ_{r2}$",
            2,
            Marker::Diamond,
            rows.iter().map(|row| row.lambda_r2).collect::<Vec<_>>(),
        ),
        (
            "$λ_C^*$",
            1,
            Marker::Triangle,
            rows.iter().map(|row| row.lambda_c).collect(),
        ),
        (
            "$λ_{CC}$",
            3,
            Marker::Square,
            rows.iter().map(|row| Some(row.lambda_cc)).collect(),
        ),
        (
            "$λ_l$",
            0,
            Marker::Circle,
            rows.iter().map(|row| Some(row.lambda_l)).collect(),
        ),
    ];
    // so many markers that they would hide the lines are smaller
    let radius = if rows.len() > CROWDED { MARKER / 2.0 } else { MARKER };
    for (name, colour, marker, values) in &series {
        let points = rows
            .iter()
            .zip(values)
            .map(|(row, value)| [n(row.valence), value.unwrap_or(f64::NAN)]);
        let mut style = Style::line(*colour).marked(*marker);
        style.marker = Some((*marker, radius));
        chart = chart.series(points, style).label(*name);
    }
    let constants = [
        (format!("$λ_M^*$ = {LAMBDA_M}"), LAMBDA_M, Dash::Solid),
        (format!("$λ_A^*$ = {LAMBDA_A}"), LAMBDA_A, Dash::Dashed),
        (format!("$λ_{{r1}}$ = {LAMBDA_R1}"), LAMBDA_R1, Dash::DashDot),
        ("$λ_{C1}$ = 1/8".to_owned(), LAMBDA_C1, Dash::Dotted),
    ];
    for (name, value, dash) in constants {
        let stroke = Stroke {
            dash,
            ..Stroke::solid(Colour::GREY, 0.3)
        };
        chart = chart.horizontal(value, stroke).label(name);
    }
    let printed = rows.iter().filter_map(|row| paper_row(row.valence)).flat_map(|paper| {
        [paper.lambda_l, paper.lambda_cc, paper.lambda_c_star, paper.lambda_r2].map(|lambda| [n(paper.valence), lambda])
    });
    let mut crosses = Style::points(Marker::Cross, Colour::INK);
    crosses.marker = Some((Marker::Cross, radius));
    chart = chart.series(printed, crosses).label("printed (2023)");
    let printed = ["paper_lambda_l", "paper_lambda_CC", "paper_lambda_C", "paper_lambda_r2"];
    let table = Featured::table(&rows, &printed, |row| {
        let paper = paper_row(row.valence);
        let values = paper.map(|paper| [paper.lambda_l, paper.lambda_cc, paper.lambda_c_star, paper.lambda_r2]);
        (0..4).map(|i| values.map(|values| values[i]).into()).collect()
    });
    Ok((chart, table))
}
