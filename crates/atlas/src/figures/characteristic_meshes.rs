//! Characteristic meshes of the generalised tension scheme (Fang, Ma and Wang, Fig. 10).
//!
//! The eigenvectors of the subdominant pair as points in the plane, on the smallest closed ring set of each
//! order, at the refinement with `u_1` of a small initial tension, where the scheme is farthest from its
//! limit. Valences stand in columns, orders in rows.

use super::grid::Grid;
use super::nets::NaturalNet;
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use eigenring_figure::{Figure, Panel};
use eigenring_scheme::families::tension;

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 6, 13, 20],
    ..FigureEntry::new(
        "characteristic-meshes",
        "eigenvectors of the tension scheme's subdominant pair, u0 = 0.01; columns: valences, rows: orders",
        "Fang, Ma and Wang, Fig. 10",
        build,
    )
};

/// The orders and the tension of the paper's figure.
const ORDERS: [usize; 5] = [4, 8, 12, 16, 22];
const TENSION: f64 = 0.01;
/// The refinement with `u_1`: that of `u_0` is level 0.
const LEVEL: usize = 1;
/// The narrowest panel and the most a panel is wide and high, in millimetres.
const NARROWEST: f64 = 33.0;
const SIDE: f64 = 38.0;
/// The height of the line above all panels, in millimetres.
const HEADING: f64 = 5.0;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let grid = Grid::new(ORDERS.len(), inputs.valences.len(), inputs.width, 0.0, NARROWEST);
    let height = grid.height(grid.across.min(SIDE)) + HEADING;
    let mut figure = Figure::new(
        inputs.width,
        height,
        "Characteristic meshes of the generalised tension scheme",
    );
    // the level of u_1: u_(l+1) = (1 + u_l)/2
    let next = (1.0 + TENSION) / 2.0;
    figure = figure.heading(format!(
        "$u_0$ = {TENSION}, refinement {} with $u_1$ = {next}",
        LEVEL + 1
    ));
    let mut table = NaturalNet::table(&["order", "valence", "u0", "level", "lambda"]);
    for (row, order) in ORDERS.into_iter().enumerate() {
        for (column, &valence) in inputs.valences.iter().enumerate() {
            let scheme = tension::<f64>(valence, order, TENSION)?;
            let net = NaturalNet::at(&scheme, scheme.level(LEVEL), scheme.closed_rings()?)?;
            let of = [
                order.into(),
                valence.into(),
                TENSION.into(),
                LEVEL.into(),
                net.lambda.into(),
            ];
            net.push(&mut table, &of);
            let title = format!("$k$ = {order}, $N$ = {valence}");
            let (at_row, at_column) = grid.place(row, column);
            figure = figure.panel(at_row, at_column, Panel::new(net.chart()).title(title));
        }
    }
    Ok(vec![Drawing::of(&ENTRY, figure, table)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::{PointNet, refine};

    #[test]
    fn a_mesh_refined_with_its_level_is_itself_times_lambda() {
        for order in [4, 5, 8, 12] {
            for valence in [3, 6, 20] {
                let scheme = tension::<f64>(valence, order, TENSION).unwrap();
                let level = scheme.level(LEVEL);
                let rings = scheme.closed_rings().unwrap().max(1);
                let net = NaturalNet::at(&scheme, level, rings + 1).unwrap();
                let numbering = scheme.numbering(net.points.iter().map(|(ring, _)| *ring).max().unwrap());
                let points = net.points.iter().map(|(_, point)| *point).collect();
                let refined = refine(level, &PointNet { numbering, points }, &numbering.sites()).unwrap();
                for (fine, (_, coarse)) in refined.iter().zip(&net.points) {
                    for axis in 0..2 {
                        let distance = (fine[axis] - net.lambda * coarse[axis]).abs();
                        assert!(
                            distance < 1e-10 * net.radius(),
                            "order {order}, N = {valence}: {distance}"
                        );
                    }
                }
            }
        }
    }
}
