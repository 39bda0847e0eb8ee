//! The feasible weights (f2, f3) at one lambda, with the objective as colour and its minima.
//!
//! The domain is cut into strips along f3 between which its bounds change, each strip into cells between the
//! bounds (see `Domain::strips`), so that cells end where the domain does. At N = 4, where f3 is mu, the
//! objective is drawn against f2.

use super::grid::Grid;
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::progress::each;
use crate::table::Table;
use eigenring_figure::{Axis, Chart, Colour, ColourMap, ColourScale, Figure, Marker, Panel, Side, Style, range_of};
use eigenring_tune::sweep::Problem;

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 5, 8],
    lambdas: &[eigenring_tune::study::LAMBDA_A, eigenring_tune::study::LAMBDA_M],
    colours: Some((0.0, 3.0)),
    ..FigureEntry::new(
        "feasible-domain",
        "the feasible weights f2, f3 with the objective E and its minima; columns: valences, rows: lambdas",
        "Ma, Wang and Ma 2023, section 3.2",
        build,
    )
};

/// Room for the colour bar, in millimetres.
const BAR: f64 = 16.0;
/// The narrowest panel, in millimetres: axes and labels included.
const NARROWEST: f64 = 45.0;
/// Height of a panel, in millimetres.
const HEIGHT: f64 = 48.0;
/// Rows of cells over the range of f3, and cells of each row.
const ROWS: usize = 48;
/// See [`ROWS`].
const CELLS: usize = 32;
/// Every so many cells are tabulated; with 32 in a row they lie on slanted lines.
const TABULATED: usize = 5;
/// Rows are taken inside their strip by this part of its height: at the very ends bounds meet.
const INSIDE: f64 = 1e-6;

/// A part of the domain with the objective in its middle.
struct Cell {
    corners: Vec<[f64; 2]>,
    middle: [f64; 2],
    total: f64,
}

struct Found {
    problem: Problem,
    cells: Vec<Cell>,
    minima: Vec<([f64; 2], f64)>,
}

impl Found {
    /// At N = 4 there is no other f3 than mu, and E is drawn as a height and not as a colour.
    fn is_flat(&self) -> bool {
        self.problem.domain.plane().valence == 4
    }
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let options = inputs.studies.options();
    let wanted: Vec<(usize, usize)> = (0..inputs.valences.len())
        .flat_map(|column| (0..inputs.lambdas.len()).map(move |row| (row, column)))
        .collect();
    let found: Vec<Found> = each(inputs.tuner.progress, "domains", &wanted, |&(row, column)| {
        let problem = Problem::new(inputs.valences[column], inputs.lambdas[row], &options)?;
        let cells = cells(&problem)?;
        let search = problem.search(options.starts)?;
        let minima = search.optima.iter().map(|o| ([o.f2, o.f3], o.total)).collect();
        Ok::<Found, Error>(Found { problem, cells, minima })
    })?;

    let scale = ColourScale::new(
        ColourMap::Viridis,
        inputs.colours.unwrap_or_default(),
        "log$_{10}$ $E/E_{min}$",
    );
    let grid = Grid::new(
        inputs.lambdas.len(),
        inputs.valences.len(),
        inputs.width,
        BAR,
        NARROWEST,
    );
    let height = grid.height(HEIGHT) + 6.0;
    let mut figure = Figure::new(inputs.width, height, "Feasible weights and objective");
    figure = figure.legend(Side::Bottom);
    if found.iter().any(|found| !found.is_flat()) {
        figure = figure.colour_bar(&scale);
    }
    let mut table = Table::new(["valence", "lambda", "point", "f2", "f3", "E"]);
    for (&(row, column), found) in wanted.iter().zip(&found) {
        let (valence, lambda) = (inputs.valences[column], inputs.lambdas[row]);
        let points = found
            .cells
            .iter()
            .step_by(TABULATED)
            .map(|cell| ("cell", cell.middle, cell.total));
        let minima = found.minima.iter().map(|&(at, total)| ("minimum", at, total));
        for (what, [f2, f3], total) in points.chain(minima) {
            table.push(vec![
                valence.into(),
                lambda.into(),
                what.into(),
                f2.into(),
                f3.into(),
                total.is_finite().then_some(total).into(),
            ]);
        }
        let (at_row, at_column) = grid.place(row, column);
        let panel = Panel::new(chart(found, &scale)).title(format!("$N$ = {valence}, $λ$ = {lambda}"));
        figure = figure.panel(at_row, at_column, panel);
    }
    Ok(vec![Drawing::of(&ENTRY, figure, table)])
}

/// The domain in cells; at N = 4 cells without height.
fn cells(problem: &Problem) -> Result<Vec<Cell>, Error> {
    let domain = &problem.domain;
    let [low, high] = domain.f3_range().map(|end| end.f3);
    let mut cells = Vec::new();
    for strip in domain.strips() {
        let [from, to] = strip.f3;
        let part = if high > low { (to - from) / (high - low) } else { 1.0 };
        let count = if high > low {
            ((ROWS as f64 * part).ceil() as usize).max(1)
        } else {
            1
        };
        let at = |k: usize| from + (to - from) * (INSIDE + (1.0 - 2.0 * INSIDE) * k as f64 / count as f64);
        for k in 0..count {
            let rows = [at(k), at(k + 1)];
            let between = 0.5 * (rows[0] + rows[1]);
            // lower end, middle and upper end of the row
            let ends = [rows[0], between, rows[1]].map(|f3| domain.f2_intervals(f3));
            for index in 0..strip.curves.len() {
                let [Some(below), Some(inside), Some(above)] = ends.each_ref().map(|ends| ends.get(index)) else {
                    continue;
                };
                for i in 0..CELLS {
                    let [u, v] = [i, i + 1].map(|i| i as f64 / CELLS as f64);
                    let corners = vec![
                        [below.at(u), rows[0]],
                        [below.at(v), rows[0]],
                        [above.at(v), rows[1]],
                        [above.at(u), rows[1]],
                    ];
                    let middle = [inside.at(0.5 * (u + v)), between];
                    let total = problem.objective.value(middle[0], middle[1])?;
                    cells.push(Cell { corners, middle, total });
                }
            }
        }
    }
    Ok(cells)
}

fn chart(found: &Found, scale: &ColourScale) -> Chart {
    let least = found.minima[0].1;
    let value = |total: f64| (total / least).log10();
    let corners = || found.cells.iter().flat_map(|cell| &cell.corners);
    let range = |axis: usize| range_of(corners().map(|corner| corner[axis]), 0.04).unwrap_or((0.0, 1.0));
    let f2 = Axis::new("$f_2$", range(0));
    let marks = [
        (0, Marker::Disc, Colour::line(1), "optimum"),
        (1, Marker::Circle, Colour::line(1), "other minima"),
    ];
    let flat = found.is_flat();
    // where a point of the domain with its value is drawn
    let place = |at: [f64; 2], value: f64| [at[0], if flat { value } else { at[1] }];
    let mut chart = if flat {
        let points: Vec<[f64; 2]> = found
            .cells
            .iter()
            .map(|cell| [cell.middle[0], value(cell.total)])
            .collect();
        let y = range_of(points.iter().map(|p| p[1]).chain([0.0]), 0.05).unwrap_or((0.0, 1.0));
        Chart::new(f2, Axis::new("log$_{10}$ $E/E_{min}$", y)).series(points, Style::line(0))
    } else {
        let cells = found.cells.iter().map(|cell| (cell.corners.clone(), value(cell.total)));
        Chart::new(f2, Axis::new("$f_3$", range(1))).cells(cells, scale)
    };
    for (kind, marker, colour, label) in marks {
        let points: Vec<[f64; 2]> = found
            .minima
            .iter()
            .enumerate()
            .filter(|(index, _)| (*index).min(1) == kind)
            .map(|(_, &(at, total))| place(at, value(total)))
            .collect();
        if !points.is_empty() {
            chart = chart.series(points, Style::points(marker, colour)).label(label);
        }
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_tune::sweep::Options;

    fn area(corners: &[[f64; 2]]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners
            .iter()
            .zip(next)
            .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
            .sum::<f64>()
            / 2.0
    }

    #[test]
    fn cells_cover_the_domain_and_nothing_else() {
        for (valence, lambda) in [(3, 0.39), (3, 0.7), (5, 0.5), (8, 0.39), (20, 0.7)] {
            let problem = Problem::new(valence, lambda, &Options::default()).unwrap();
            let cells = cells(&problem).unwrap();
            assert!(
                cells
                    .iter()
                    .all(|cell| problem.domain.contains(cell.middle[0], cell.middle[1]))
            );
            // the area by counting points that satisfy the inequalities, in a box around all cells
            let corners = || cells.iter().flat_map(|cell| &cell.corners);
            let range = |axis: usize| range_of(corners().map(|corner| corner[axis]), 0.05).unwrap();
            let (x, y) = (range(0), range(1));
            let at = |(low, high): (f64, f64), k: usize| low + (high - low) * (k as f64 + 0.5) / 200.0;
            let inside = (0..200).flat_map(|i| (0..200).map(move |j| (i, j)));
            let count = inside
                .filter(|&(i, j)| problem.domain.contains(at(x, i), at(y, j)))
                .count();
            let counted = count as f64 / 40_000.0 * (x.1 - x.0) * (y.1 - y.0);
            let total: f64 = cells.iter().map(|cell| area(&cell.corners)).sum();
            assert!(
                (total / counted - 1.0).abs() < 0.02,
                "{valence} {lambda}: {total} {counted}"
            );
            // no cell is below the minimum
            let least = problem.search(Options::default().starts).unwrap().lowest().total;
            assert!(cells.iter().all(|cell| cell.total >= least * (1.0 - 1e-9)));
        }
    }
}
