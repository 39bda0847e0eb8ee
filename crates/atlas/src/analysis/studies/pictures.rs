//! A solution, its error beside an extraordinary vertex with the elements, basis functions of that vertex.

use super::{HNUSS, SCHEMES, with};
use crate::error::Error;
use crate::figures::Drawing;
use crate::schemes::Tuner;
use crate::table::Table;
use eigenring_figure::{
    Chart, Colour, ColourMap, ColourScale, Figure, LINE, Panel, Stroke, Style, Surface, View, Width,
};
use eigenring_iga::{Domain, Ends, Options, Problem, Tile, solution};
use eigenring_surface::{Mesh, Topology, shapes};

/// Cuts of a patch in both directions.
const CUTS: usize = 4;
/// Annuli that are drawn.
const ANNULI: usize = 5;
const VALENCE: usize = 6;
/// The valence of the basis functions.
const LIFTED: usize = 5;

/// The schemes that are compared.
fn schemes() -> [(&'static str, &'static str); 4] {
    [SCHEMES[0], SCHEMES[2], SCHEMES[1], HNUSS]
}

/// The corners of the cells of a lattice, and their means.
fn cells(tile: &Tile, value: impl Fn([f64; 4]) -> f64) -> Vec<(Vec<[f64; 2]>, f64)> {
    let row = CUTS + 1;
    let all = (0..CUTS).flat_map(|j| (0..CUTS).map(move |i| j * row + i));
    all.map(|k| {
        let corners = [k, k + 1, k + 1 + row, k + row].map(|k| tile.points[k]);
        let mean = corners.iter().map(|corner| value(*corner)).sum::<f64>() / 4.0;
        (corners.map(|[x, y, ..]| [x, y]).to_vec(), mean)
    })
    .collect()
}

/// The outline of a patch.
fn outline(tile: &Tile) -> Vec<[f64; 4]> {
    let row = CUTS + 1;
    let last = row * row - 1;
    let sides = [
        (0..row).collect::<Vec<_>>(),
        (0..row).map(|j| j * row + CUTS).collect(),
        (0..row).map(|i| last - i).collect(),
        (0..row).map(|j| (CUTS - j) * row).collect(),
    ];
    sides.concat().into_iter().map(|k| tile.points[k]).collect()
}

/// Halves of what is shown.
const WHOLE: f64 = 1.02;
const NEAR: f64 = 0.3;

pub(super) fn solutions(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let level = levels - 1;
    let mesh = shapes::fan(VALENCE);
    let u = solution::named("exp").expect("a name of the library");
    let centre = mesh.points()[middle(&mesh, VALENCE)];
    let heights = ColourScale::new(ColourMap::Viridis, (0.5, 2.5), "$u_h$");
    let errors = ColourScale::new(ColourMap::Viridis, (-9.0, -4.0), "$log_{10} |u - u_h|$");
    let mut table = Table::new(["scheme", "face", "x", "y", "value", "error"]);
    let mut figure = Figure::new(
        Width::Two,
        112.0,
        "A solution and its error beside an extraordinary vertex",
    );
    let around = |half: f64| {
        let range = |c: f64| (c - half, c + half);
        Chart::map(range(centre.x), range(centre.y))
    };
    for (place, (spec, label)) in schemes().into_iter().enumerate() {
        let tiles = with(&mesh, spec, Domain::Planar, tuner, |study| {
            let outcome = study.level(level, Problem::Poisson, &u, &Options::default())?;
            study.tiles(level, &outcome.coefficients, CUTS, ANNULI, Ends::Open)
        })?;
        let off = |[x, y, _, value]: [f64; 4]| (value - u(x, y).value).abs();
        for tile in &tiles {
            let [x, y, _, value] = tile.points[tile.points.len() / 2];
            let error = off([x, y, 0.0, value]);
            table.push(vec![
                spec.into(),
                tile.face.into(),
                x.into(),
                y.into(),
                value.into(),
                error.into(),
            ]);
        }
        let grid = |mut chart: Chart| {
            for tile in &tiles {
                let points: Vec<[f64; 2]> = outline(tile).into_iter().map(|[x, y, ..]| [x, y]).collect();
                chart = chart.series(points, Style::solid(Colour::INK).wide(0.1));
            }
            chart
        };
        if place == 0 {
            let all = tiles.iter().flat_map(|tile| cells(tile, |point| point[3]));
            let chart = grid(around(WHOLE).cells(all, &heights));
            figure = figure.panel(0, 0, Panel::new(chart).title("solution").colour_bar(&heights));
        }
        let all = tiles
            .iter()
            .flat_map(|tile| cells(tile, |point| off(point).max(1e-16).log10()));
        let near = |(corners, _): &(Vec<[f64; 2]>, f64)| {
            corners
                .iter()
                .any(|[x, y]| (x - centre.x).abs() < NEAR && (y - centre.y).abs() < NEAR)
        };
        let chart = grid(around(NEAR).cells(all.filter(near), &errors));
        let (row, column) = ((place + 1) / 3, (place + 1) % 3);
        figure = figure.panel(row, column, Panel::new(chart).title(label).colour_bar(&errors));
    }
    Ok(vec![Drawing {
        stem: "solution".to_owned(),
        figure,
        data: vec![("", table)],
    }])
}

/// The inner vertex of a valence.
fn middle(mesh: &Mesh, valence: usize) -> usize {
    let topology = Topology::unchecked(mesh);
    let fans = (0..topology.vertex_count() as u32).map(|v| topology.fan(v));
    let found = fans
        .enumerate()
        .find(|(_, fan)| fan.last.is_none() && fan.spokes.len() == valence);
    found.map_or(0, |(v, _)| v)
}

/// How high a function of value 1 is drawn.
const HEIGHT: f64 = 1.6;

pub(super) fn functions(_levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let mesh = shapes::fan(LIFTED);
    let scale = ColourScale::new(ColourMap::Viridis, (0.0, 0.6), "value");
    let mut table = Table::new(["scheme", "x", "y", "value"]);
    let mut figure = Figure::new(Width::Two, 58.0, "The basis function of an extraordinary vertex").colour_bar(&scale);
    let vertex = middle(&mesh, LIFTED);
    for (place, (spec, label)) in schemes().into_iter().enumerate() {
        let tiles = with(&mesh, spec, Domain::Planar, tuner, |study| {
            study.tiles(0, &study.function(vertex, Ends::Open)?, CUTS, ANNULI, Ends::Open)
        })?;
        let lifted = |[x, y, _, value]: [f64; 4]| [x, y, HEIGHT * value];
        let row = CUTS + 1;
        let mut surface = Surface::new(View {
            azimuth: -62.0,
            elevation: 30.0,
        });
        let mut quads = Vec::new();
        for tile in &tiles {
            for k in (0..CUTS).flat_map(|j| (0..CUTS).map(move |i| j * row + i)) {
                let corners = [k, k + 1, k + 1 + row, k + row].map(|k| tile.points[k]);
                let mean = corners.iter().map(|corner| corner[3]).sum::<f64>() / 4.0;
                quads.push((corners.map(lifted), mean));
            }
            // the corners of the tile
            let stored = (0..row * row).filter(|k| (k % row).is_multiple_of(CUTS) && (k / row).is_multiple_of(CUTS));
            for [x, y, _, value] in stored.map(|k| &tile.points[k]) {
                table.push(vec![spec.into(), (*x).into(), (*y).into(), (*value).into()]);
            }
        }
        surface = surface.quads(quads, &scale);
        for tile in &tiles {
            surface = surface.line(
                outline(tile).into_iter().map(lifted),
                Stroke::solid(Colour::WHITE, 0.3 * LINE),
            );
        }
        figure = figure.panel(0, place, Panel::new(surface).title(label));
    }
    Ok(vec![Drawing {
        stem: "basis-functions".to_owned(),
        figure,
        data: vec![("", table)],
    }])
}
