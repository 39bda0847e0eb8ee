//! Featured lambdas against the valence: Ma, Wang and Ma (2023), Fig. 3.
//!
//! Surfaces are C1 for lambda above 1/8, the outer rings' eigenvalue, and have bounded curvature from
//! lambda_l on.

use super::{Drawing, Entry, Inputs};
use crate::error::Error;
use crate::table::Table;
use eigenring_figure::{Axis, Chart, Colour, Dash, Figure, MARKER, Marker, Panel, Side, Stroke, Style, Width};
use eigenring_scheme::lambda::Relaxation;
use eigenring_tune::study::{LAMBDA_A, LAMBDA_M, LAMBDA_R1, lambda_catmull_clark, paper_row};

pub const ENTRY: Entry = Entry {
    name: "feasible-region",
    title: "featured lambdas and the feasible region against the valence",
    reference: "Ma, Wang and Ma 2023, Fig. 3",
    valences: &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20],
    lambdas: &[],
    schemes: None,
    colours: None,
    range: false,
    studies: false,
    width: Width::One,
    build,
};

/// The eigenvalue of the third ring and those beyond, below lambda wherever surfaces are C1.
const LAMBDA_C1: f64 = 0.125;

/// Valences from which on markers are drawn smaller.
const CROWDED: usize = 30;

/// The featured values of one valence; those that are tuned exist for tabulated valences only.
struct Row {
    valence: usize,
    lambda_l: f64,
    lambda_cc: f64,
    lambda_c: Option<f64>,
    lambda_r2: Option<f64>,
}

fn rows(inputs: &Inputs<'_>) -> Result<Vec<Row>, Error> {
    let row = |&valence: &usize| {
        let entry = inputs.studies.entry(valence)?;
        Ok(Row {
            valence,
            lambda_l: Relaxation::new(valence)?.lambda_l(),
            lambda_cc: lambda_catmull_clark(valence),
            lambda_c: entry.as_ref().map(|entry| entry.lambda_optimal),
            lambda_r2: entry.as_ref().map(|entry| entry.lambda_r2),
        })
    };
    inputs.valences.iter().map(row).collect()
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let (chart, table) = chart(inputs)?;
    let height = if inputs.is_wide() { 95.0 } else { 88.0 };
    let figure = Figure::new(inputs.width, height, "Featured lambdas against the valence").panel(
        0,
        0,
        Panel::new(chart).legend(Side::Bottom),
    );
    Ok(vec![Drawing {
        stem: ENTRY.name.to_owned(),
        figure,
        data: vec![("", table)],
    }])
}

/// The chart and its data, for this figure and the overview.
pub fn chart(inputs: &Inputs<'_>) -> Result<(Chart, Table), Error> {
    let rows = rows(inputs)?;
    let n = |valence: usize| valence as f64;
    let (first, last) = (
        rows.iter().map(|row| row.valence).min().unwrap_or(3),
        rows.iter().map(|row| row.valence).max().unwrap_or(3),
    );
    // about eight ticks, on multiples of the step
    let step = (last - first).div_ceil(8).max(1);
    let ticks = (first..=last).filter(|valence| valence % step == 0);
    let x = Axis::new("valence $N$", (n(first) - 0.7, n(last) + 0.7)).with_integers(ticks);
    let mut chart = Chart::new(x, Axis::new("subdominant eigenvalue $λ$", (0.0, 1.0)));

    // the bands reach the sides of the chart
    let band = |low: &dyn Fn(&Row) -> f64, high: &dyn Fn(&Row) -> f64| -> Vec<[f64; 3]> {
        let inner = rows.iter().map(|row| [n(row.valence), low(row), high(row)]);
        let mut points: Vec<[f64; 3]> = inner.collect();
        if let (Some(&[_, a, b]), Some(&[_, c, d])) = (points.first(), points.last()) {
            points.insert(0, [n(first) - 0.7, a, b]);
            points.push([n(last) + 0.7, c, d]);
        }
        points
    };
    chart = chart
        .band(band(&|_| LAMBDA_C1, &|row| row.lambda_l), Colour::line(5), 0.14)
        .label("$C^1$, curvature unbounded")
        .band(band(&|row| row.lambda_l, &|_| 1.0), Colour::line(3), 0.3)
        .label("$C^1$, bounded curvature");

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
        ("1/8".to_owned(), LAMBDA_C1, Dash::Dotted),
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
    Ok((chart, table(&rows)))
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new([
        "valence",
        "lambda_C1",
        "lambda_r1",
        "lambda_A",
        "lambda_l",
        "lambda_M",
        "lambda_CC",
        "lambda_C",
        "lambda_r2",
        "paper_lambda_l",
        "paper_lambda_CC",
        "paper_lambda_C",
        "paper_lambda_r2",
    ]);
    for row in rows {
        let paper = paper_row(row.valence);
        table.push(vec![
            row.valence.into(),
            LAMBDA_C1.into(),
            LAMBDA_R1.into(),
            LAMBDA_A.into(),
            row.lambda_l.into(),
            LAMBDA_M.into(),
            row.lambda_cc.into(),
            row.lambda_c.into(),
            row.lambda_r2.into(),
            paper.map(|paper| paper.lambda_l).into(),
            paper.map(|paper| paper.lambda_cc).into(),
            paper.map(|paper| paper.lambda_c_star).into(),
            paper.map(|paper| paper.lambda_r2).into(),
        ]);
    }
    table
}
