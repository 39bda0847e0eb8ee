//! Characteristic maps with knot intervals, where sectors differ, and their control nets, the natural
//! configurations: a panel for each scheme.
//!
//! Of maps colour is the Jacobian by natural parameters, relative to its mean over the faces of the second
//! ring; a map that is regular has no zero in it. Of NURSS the two eigenvalues mostly differ, so that faces
//! become ever narrower towards the vertex.

use super::blending::called;
use super::grid::{Grid, NARROWEST, narrowest};
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::nonuniform::blending::with_intervals;
use crate::table::{Table, short};
use eigenring_figure::{Chart, Colour, ColourMap, ColourScale, Figure, Marker, Panel, Stroke, Style};
use eigenring_nonuniform::{CharacteristicMap, Scheme, Spokes};

/// Levels of the net that is drawn.
const LEVELS: usize = 4;
/// The radius of control points, in millimetres.
const DOT: f64 = 0.4;
/// The most a panel is wide and high, and room for the colour bar, in millimetres.
const SIDE: f64 = 70.0;
const BAR: f64 = 16.0;
/// The height of the line above all panels, in millimetres.
const HEADING: f64 = 5.0;

/// The maps of all schemes.
fn maps(inputs: &Inputs<'_>, spokes: &Spokes, levels: usize) -> Result<Vec<(Scheme, CharacteristicMap)>, Error> {
    let schemes = inputs.schemes.iter().map(with_intervals);
    let maps = schemes.map(|scheme| {
        let scheme = scheme?;
        Ok((scheme, CharacteristicMap::new(scheme, spokes.intervals(), levels)?))
    });
    maps.collect()
}

fn title(scheme: Scheme, [first, second]: [f64; 2]) -> String {
    match (first - second).abs() < 1e-9 {
        true => format!("{}, $λ$ = {first:.3}", called(scheme)),
        false => format!("{}, $λ$ = {first:.3}, {second:.3}", called(scheme)),
    }
}

/// The line above all panels: a long list is in the table.
fn heading(spokes: &Spokes) -> String {
    let list: Vec<String> = spokes.intervals().iter().map(|&d| short(d)).collect();
    let list = match list.len() {
        ..=12 => list.join(", "),
        _ => format!("{}, …", list[..12].join(", ")),
    };
    format!("knot intervals {list}")
}

fn knots(spokes: &Spokes) -> String {
    let all: Vec<String> = spokes.intervals().iter().map(f64::to_string).collect();
    all.join(" ")
}

/// The figure of one panel for each map, with room for a bar of this width beside them.
fn panels(
    name: &str,
    inputs: &Inputs<'_>,
    spokes: &Spokes,
    maps: &[(Scheme, CharacteristicMap)],
    bar: f64,
    chart: impl Fn(&CharacteristicMap) -> Chart,
) -> Figure {
    let titles = maps.iter().map(|(scheme, map)| title(*scheme, map.factors));
    let grid = Grid::new(1, maps.len(), inputs.width, bar, narrowest(titles, NARROWEST));
    let side = grid.across.min(SIDE);
    let figure = Figure::new(inputs.width, grid.height(side) + HEADING, name).heading(heading(spokes));
    maps.iter().enumerate().fold(figure, |figure, (column, (scheme, map))| {
        let (at_row, at_column) = grid.place(0, column);
        figure.panel(
            at_row,
            at_column,
            Panel::new(chart(map)).title(title(*scheme, map.factors)),
        )
    })
}

/// The characteristic maps for these intervals.
///
/// # Errors
/// [`Error::Usage`] for schemes without intervals; those of the maps.
pub fn build(entry: &FigureEntry, inputs: &Inputs<'_>, spokes: &Spokes) -> Result<Vec<Drawing>, Error> {
    let maps = maps(inputs, spokes, LEVELS)?;
    let scale = ColourScale::new(
        ColourMap::Viridis,
        inputs.colours.unwrap_or_default(),
        "Jacobian / mean of second ring",
    );
    let name = "Characteristic maps with knot intervals";
    let figure = panels(name, inputs, spokes, &maps, BAR, |map| {
        chart(map, outer_mean(map), &scale)
    });
    let mut table = Table::new(["scheme", "first", "second", "least", "greatest", "knots"]);
    for (scheme, map) in &maps {
        let mean = outer_mean(map);
        let relative = map.jacobians.iter().map(|jacobian| jacobian / mean);
        let [least, greatest] = [f64::min, f64::max].map(|f| relative.clone().reduce(f).unwrap_or(f64::NAN));
        table.push(vec![
            scheme.to_string().into(),
            map.factors[0].into(),
            map.factors[1].into(),
            least.into(),
            greatest.into(),
            knots(spokes).into(),
        ]);
    }
    Ok(vec![Drawing {
        stem: format!("{}-knots", entry.name),
        figure: figure.colour_bar(&scale),
        data: vec![("", table)],
    }])
}

/// The control nets of these maps, with their points as a table.
///
/// # Errors
/// As [`build`].
pub fn control_nets(entry: &FigureEntry, inputs: &Inputs<'_>, spokes: &Spokes) -> Result<Vec<Drawing>, Error> {
    let maps = maps(inputs, spokes, 0)?;
    let name = "Natural configurations with knot intervals";
    let figure = panels(name, inputs, spokes, &maps, 0.0, net);
    let mut table = Table::new(["scheme", "first", "second", "x", "y", "knots"]);
    for (scheme, map) in &maps {
        for [x, y] in &map.control.0 {
            table.push(vec![
                scheme.to_string().into(),
                map.factors[0].into(),
                map.factors[1].into(),
                (*x).into(),
                (*y).into(),
                knots(spokes).into(),
            ]);
        }
    }
    Ok(vec![Drawing {
        stem: format!("{}-knots", entry.name),
        figure,
        data: vec![("", table)],
    }])
}

fn net(map: &CharacteristicMap) -> Chart {
    let (points, edges) = &map.control;
    let radius = 1.05 * points.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let lines = edges
        .iter()
        .flat_map(|ends| ends.map(|end| points[end as usize]).into_iter().chain([[f64::NAN; 2]]));
    let style = |line, marker| Style {
        line,
        marker,
        colour: Colour::INK,
    };
    Chart::map((-radius, radius), (-radius, radius))
        .series(lines, style(Some(Stroke::solid(Colour::INK, 0.2)), None))
        .series(points.iter().copied(), style(None, Some((Marker::Disc, DOT))))
}

/// The mean over the second ring: all but the first face of each sector.
fn outer_mean(map: &CharacteristicMap) -> f64 {
    let part = 4_usize.pow(LEVELS as u32);
    let outer = (map.jacobians.chunks(part).enumerate()).filter(|(face, _)| face % 4 != 0);
    let values: Vec<f64> = outer.flat_map(|(_, list)| list.iter().copied()).collect();
    values.iter().sum::<f64>() / values.len() as f64
}

fn chart(map: &CharacteristicMap, mean: f64, scale: &ColourScale) -> Chart {
    let all = map.cells.iter().flatten().flatten();
    let radius = 1.02 * all.fold(0.0, |most: f64, x| most.max(x.abs()));
    let cells = map.cells.iter().zip(&map.jacobians);
    let cells = cells.map(|(cell, jacobian)| (cell.to_vec(), jacobian / mean));
    let lines = map
        .lines
        .iter()
        .flat_map(|line| line.iter().copied().chain([[f64::NAN; 2]]));
    let style = Style {
        line: Some(Stroke::solid(Colour::WHITE, 0.12)),
        marker: None,
        colour: Colour::WHITE,
    };
    Chart::map((-radius, radius), (-radius, radius))
        .cells(cells, scale)
        .series(lines, style)
}
