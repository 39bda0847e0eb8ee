//! Characteristic maps with knot intervals, where sectors differ: a panel for each scheme.
//!
//! Colour is the Jacobian by natural parameters, relative to its mean over the faces of the second ring; a
//! map that is regular has no zero in it. Of NURSS the two eigenvalues mostly differ, so that faces become
//! ever narrower towards the vertex.

use super::blending::called;
use super::grid::{Grid, NARROWEST, narrowest};
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::nonuniform::blending::with_intervals;
use crate::table::{Table, short};
use eigenring_figure::{Chart, Colour, ColourMap, ColourScale, Figure, Panel, Stroke, Style};
use eigenring_nonuniform::{CharacteristicMap, Scheme, Spokes};

/// Levels of the net that is drawn.
const LEVELS: usize = 4;
/// The most a panel is wide and high, and room for the colour bar, in millimetres.
const SIDE: f64 = 70.0;
const BAR: f64 = 16.0;
/// The height of the line above all panels, in millimetres.
const HEADING: f64 = 5.0;

/// The figure of an entry with its intervals.
///
/// # Errors
/// [`Error::Usage`] for schemes without intervals; those of the maps.
pub fn build(entry: &FigureEntry, inputs: &Inputs<'_>, spokes: &Spokes) -> Result<Vec<Drawing>, Error> {
    let schemes: Vec<Scheme> = inputs.schemes.iter().map(with_intervals).collect::<Result<_, _>>()?;
    let maps = schemes
        .iter()
        .map(|&scheme| CharacteristicMap::new(scheme, spokes.intervals(), LEVELS));
    let maps: Vec<CharacteristicMap> = maps.collect::<Result<_, _>>()?;
    let scale = ColourScale::new(
        ColourMap::Viridis,
        inputs.colours.unwrap_or_default(),
        "Jacobian / mean of second ring",
    );
    let title = |scheme: Scheme, [first, second]: [f64; 2]| match (first - second).abs() < 1e-9 {
        true => format!("{}, $λ$ = {first:.3}", called(scheme)),
        false => format!("{}, $λ$ = {first:.3}, {second:.3}", called(scheme)),
    };
    let titles = schemes
        .iter()
        .zip(&maps)
        .map(|(&scheme, map)| title(scheme, map.factors));
    let grid = Grid::new(1, schemes.len(), inputs.width, BAR, narrowest(titles, NARROWEST));
    let side = grid.across.min(SIDE);
    let mut figure = Figure::new(
        inputs.width,
        grid.height(side) + HEADING,
        "Characteristic maps with knot intervals",
    );
    let list: Vec<String> = spokes.intervals().iter().map(|&d| short(d)).collect();
    // a long list is in the table
    let list = match list.len() {
        ..=12 => list.join(", "),
        _ => format!("{}, …", list[..12].join(", ")),
    };
    figure = figure.heading(format!("knot intervals {list}")).colour_bar(&scale);
    let mut table = Table::new(["scheme", "first", "second", "least", "greatest", "knots"]);
    for (column, (&scheme, map)) in schemes.iter().zip(&maps).enumerate() {
        let mean = outer_mean(map);
        let relative = map.jacobians.iter().map(|jacobian| jacobian / mean);
        let [least, greatest] = [f64::min, f64::max].map(|f| relative.clone().reduce(f).unwrap_or(f64::NAN));
        let knots: Vec<String> = spokes.intervals().iter().map(f64::to_string).collect();
        table.push(vec![
            scheme.to_string().into(),
            map.factors[0].into(),
            map.factors[1].into(),
            least.into(),
            greatest.into(),
            knots.join(" ").into(),
        ]);
        let (at_row, at_column) = grid.place(0, column);
        let panel = Panel::new(chart(map, mean, &scale)).title(title(scheme, map.factors));
        figure = figure.panel(at_row, at_column, panel);
    }
    Ok(vec![Drawing {
        stem: format!("{}-knots", entry.name),
        figure,
        data: vec![("", table)],
    }])
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
