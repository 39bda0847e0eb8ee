//! One control polygon with several tensions and orders (Fang, Ma and Wang, Eqs. 1 and 2).
//!
//! A panel for each order k: the closed polygon and its limit curves. Every level cuts corners with tension
//! and averages k-3 times, so that curves of higher order lie further inside; a larger u0 pulls them to the
//! polygon (order 3) or to its averages, and `u0 < 1` loosens them. `u0 = 1` is the uniform B-spline of
//! degree k-1.

use super::grid::Grid;
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::table::Table;
use eigenring_figure::{Chart, Colour, Dash, Figure, Marker, Panel, Side, Stroke, Style, range_of};
use eigenring_spline::curve::{Curve, Ends};

pub const ENTRY: FigureEntry = FigureEntry::new(
    "tension-curves",
    "one polygon, curves of several tensions and orders",
    "Fang, Ma and Wang, Eqs. 1 and 2",
    build,
);

/// Convex and reflex corners, long and short edges.
const POLYGON: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [3.0, -0.5],
    [3.6, 1.4],
    [2.2, 1.1],
    [1.9, 3.0],
    [0.9, 3.2],
    [1.0, 1.4],
    [-0.6, 1.6],
];
/// Orders, panel by panel; the last one is the largest of the paper's tables.
const ORDERS: [usize; 4] = [3, 4, 6, 22];
const TENSIONS: [f64; 4] = [-0.3, 0.1, 1.0, 10.0];
/// Points of a curve between knots: a quarter of a millimetre on the widest page.
const SAMPLES: usize = 32;
/// The legend below and the title of a panel, in millimetres.
const LEGEND: f64 = 9.0;
const TITLE: f64 = 7.8;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let grid = Grid::new(1, ORDERS.len(), inputs.width, 0.0, 38.0);
    let range = |axis: usize| range_of(POLYGON.map(|p| p[axis]), 0.04).unwrap_or((0.0, 1.0));
    let (x, y) = (range(0), range(1));
    let height = grid.across * (y.1 - y.0) / (x.1 - x.0);
    let rows = grid.place(0, ORDERS.len() - 1).0 + 1;
    let mut figure = Figure::new(
        inputs.width,
        rows as f64 * (height + TITLE) + LEGEND,
        "Curves of one polygon for several tensions and orders",
    );
    let mut points = Table::new(["index", "x", "y"]);
    for (index, [x, y]) in POLYGON.into_iter().enumerate() {
        points.push(vec![index.into(), x.into(), y.into()]);
    }
    let mut table = Table::new(["order", "u0", "parameter", "x", "y"]);
    let polygon = Style {
        line: Some(Stroke {
            colour: Colour::GREY,
            width: 0.2,
            dash: Dash::Dashed,
        }),
        marker: Some((Marker::Square, 0.6)),
        colour: Colour::GREY,
    };
    for (panel, order) in ORDERS.into_iter().enumerate() {
        let around = POLYGON.into_iter().chain([POLYGON[0]]);
        let mut chart = Chart::map(x, y).series(around, polygon).label("control polygon");
        for (line, u0) in TENSIONS.into_iter().enumerate() {
            let curve = Curve::new(order, u0, Ends::Closed, &POLYGON)?.sample(SAMPLES)?;
            for (t, point) in &curve {
                table.push(vec![
                    order.into(),
                    u0.into(),
                    (*t).into(),
                    point[0].into(),
                    point[1].into(),
                ]);
            }
            let limit = curve.iter().map(|(_, point)| [point[0], point[1]]);
            chart = chart
                .series(limit, Style::line(line))
                .label(format!("$u_0$ = {u0}").replace('-', "−"));
        }
        let (row, column) = grid.place(0, panel);
        figure = figure.panel(row, column, Panel::new(chart).title(format!("order {order}")));
    }
    Ok(vec![Drawing {
        stem: ENTRY.name.to_owned(),
        figure: figure.legend(Side::Bottom),
        data: vec![("", table), ("polygon", points)],
    }])
}
