//! Curvature of whole surfaces: extremes, integrals, and what happens at irregular centres.
//!
//! Integrals are by Gauss-Legendre rules on the quarters of all faces. A quarter at an irregular corner is
//! cut into annuli, each half as wide as the one before, down to 2^-40: beside a centre of unbounded
//! curvature the integrand grows, and the annuli shrink faster.

use crate::error::Error;
use crate::meshes::Fields;
use crate::table::{Cell, Table};
use eigenring_spline::quadrature::{Node, gauss_legendre};
use eigenring_surface::limit::{Evaluator, Kind, Place, Sample, Surface, VertexFan};
use eigenring_surface::{Facts, Mesh, Topology};
use rayon::prelude::*;
use serde_json::json;

/// Annuli around an irregular corner.
const ANNULI: i32 = 40;
/// Nodes in each direction on a quarter, and on a piece of an annulus.
const NODES: [usize; 2] = [12, 6];

/// The least and the greatest of a quantity, with their places.
#[derive(Clone, Copy, Debug)]
pub struct Extremes {
    /// The least value.
    pub least: (f64, Place),
    /// The greatest value.
    pub greatest: (f64, Place),
}

/// Integrals over the surface.
#[derive(Clone, Copy, Debug, Default)]
pub struct Totals {
    /// The area.
    pub area: f64,
    /// The integral of the Gauss curvature.
    pub gauss: f64,
    /// The integral of the mean curvature.
    pub mean: f64,
}

/// The curvature of a surface.
#[derive(Clone, Debug)]
pub struct Curvatures {
    /// Integrals.
    pub totals: Totals,
    /// Of the samples: Gauss curvature, mean curvature.
    pub extremes: Option<[Extremes; 2]>,
    /// `2 pi` times the Euler characteristic, of a closed surface.
    pub expected: Option<f64>,
    /// The fans of irregular vertices.
    pub centres: Vec<VertexFan>,
}

/// The corners of the pieces of a face: `sub` and corner.
fn pieces(size: usize) -> Vec<(u32, u32)> {
    if size == 4 {
        (0..4).map(|corner| (0, corner)).collect()
    } else {
        (0..size as u32)
            .flat_map(|sub| (0..4).map(move |corner| (sub, corner)))
            .collect()
    }
}

fn add(totals: &mut Totals, sample: &Sample, weight: f64) {
    let (Some([xs, xt]), Some(gauss), Some(mean)) = (sample.first, sample.gauss, sample.mean) else {
        return;
    };
    let area = xs.cross(&xt).norm() * weight;
    totals.area += area;
    totals.gauss += gauss * area;
    totals.mean += mean * area;
}

fn over_face(evaluator: &mut Evaluator<'_, '_>, face: u32, size: usize) -> Result<Totals, eigenring_surface::Error> {
    let rules = NODES.map(gauss_legendre);
    let mut totals = Totals::default();
    for (sub, corner) in pieces(size) {
        let at = |s: f64, t: f64| Place {
            face,
            sub,
            corner,
            s,
            t,
        };
        let centre = evaluator.at(at(0.0, 0.0))?;
        let mut square = |totals: &mut Totals, nodes: &[Node], [s, t]: [f64; 2], width: f64| {
            for a in nodes {
                for b in nodes {
                    let sample = evaluator.at(at(s + width * a.at, t + width * b.at))?;
                    add(totals, &sample, width * width * a.weight * b.weight);
                }
            }
            Ok::<(), eigenring_surface::Error>(())
        };
        if centre.kind == Kind::Regular {
            square(&mut totals, &rules[0], [0.0, 0.0], 0.5)?;
            continue;
        }
        for level in 1..=ANNULI {
            let h = 0.5_f64.powi(level + 1);
            for corner in [[h, 0.0], [0.0, h], [h, h]] {
                square(&mut totals, &rules[1], corner, h)?;
            }
        }
    }
    Ok(totals)
}

/// The Euler characteristic of a mesh whose surface is closed and smooth, for [`curvatures`].
///
/// # Errors
/// A mesh that is no surface.
pub fn euler_of_smooth(mesh: &Mesh) -> Result<Option<i64>, Error> {
    let topology = Topology::new(mesh).map_err(eigenring_surface::Error::from)?;
    let facts = Facts::of(mesh, &topology);
    let smooth = facts.boundary_loops.is_empty() && facts.features.sharp_edges == 0;
    Ok(smooth.then_some(facts.euler))
}

/// The curvature of a surface, with `per_face x per_face` samples on each face for the extremes.
///
/// # Errors
/// Those of [`Surface::at`].
pub fn curvatures(surface: &Surface<'_>, per_face: usize, euler: Option<i64>) -> Result<Curvatures, Error> {
    let control = surface.control();
    let sizes: Vec<usize> = control.faces().map(<[u32]>::len).collect();
    let parts: Result<Vec<Totals>, eigenring_surface::Error> = sizes
        .par_iter()
        .enumerate()
        .map(|(face, &size)| over_face(&mut surface.evaluator(face as u32)?, face as u32, size))
        .collect();
    // summed in the order of faces, whatever the number of threads
    let totals = parts?.into_iter().fold(Totals::default(), |sum, part| Totals {
        area: sum.area + part.area,
        gauss: sum.gauss + part.gauss,
        mean: sum.mean + part.mean,
    });
    let places = surface.grid(per_face);
    let samples = crate::limits::samples(surface, &places)?;
    let extremes = |value: fn(&Sample) -> Option<f64>| {
        let values = places
            .iter()
            .zip(&samples)
            .filter_map(|(place, sample)| Some((value(sample)?, *place)));
        let all: Vec<(f64, Place)> = values.collect();
        let least = all.iter().copied().min_by(|a, b| a.0.total_cmp(&b.0))?;
        let greatest = all.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Extremes { least, greatest })
    };
    let fans = surface.vertices()?;
    let centres = fans
        .into_iter()
        .filter(|fan| fan.sample.kind != Kind::Regular)
        .collect();
    Ok(Curvatures {
        totals,
        extremes: extremes(|sample| sample.gauss)
            .zip(extremes(|sample| sample.mean))
            .map(|(a, b)| [a, b]),
        expected: euler.map(|euler| std::f64::consts::TAU * euler as f64),
        centres,
    })
}

/// Area, integrals and extremes in the fields of `eigenring curvature`.
pub fn summary(found: &Curvatures) -> Fields {
    let totals = found.totals;
    let range = |extremes: &Extremes| {
        let end = |(value, place): (f64, Place)| json!({ "value": value, "face": place.face, "sub": place.sub, "s": place.s, "t": place.t });
        json!({ "min": end(extremes.least), "max": end(extremes.greatest) })
    };
    Fields(vec![
        ("area", json!(totals.area)),
        ("gauss", json!(found.extremes.as_ref().map(|e| range(&e[0])))),
        ("mean", json!(found.extremes.as_ref().map(|e| range(&e[1])))),
        ("gauss_average", json!(totals.gauss / totals.area)),
        ("mean_average", json!(totals.mean / totals.area)),
        ("total_gauss", json!(totals.gauss)),
        ("two_pi_chi", json!(found.expected)),
    ])
}

/// Centres with the range of the Gauss curvature at distances from them, in parameters.
///
/// # Errors
/// Those of [`Surface::at`].
pub fn centre_table(surface: &Surface<'_>, found: &Curvatures, radii: &[f64]) -> Result<Table, Error> {
    let mut columns: Vec<String> = ["vertex", "fan", "faces", "rule", "kind", "exponent"]
        .map(str::to_owned)
        .to_vec();
    for radius in radii {
        columns.extend([format!("gauss_min@{radius:e}"), format!("gauss_max@{radius:e}")]);
    }
    let mut table = Table::new(columns);
    for fan in &found.centres {
        let exponent = match fan.sample.kind {
            Kind::Unbounded { exponent, .. } => Cell::from(exponent),
            _ => Cell::Empty,
        };
        let mut row: Vec<Cell> = vec![
            (fan.vertex as usize).into(),
            (fan.fan as usize).into(),
            fan.faces.len().into(),
            fan.rule.name().into(),
            fan.sample.kind.name().into(),
            exponent,
        ];
        for &radius in radii {
            let range = gauss_around(surface, fan, radius)?;
            row.extend(match range {
                Some(range) => range.map(Cell::from),
                None => [Cell::Empty, Cell::Empty],
            });
        }
        table.push(row);
    }
    Ok(table)
}

/// The surface at a vertex of the control mesh, in its first fan.
///
/// # Errors
/// Those of [`Surface::at`]; a vertex without faces.
pub fn at_vertex(surface: &Surface<'_>, vertex: u32) -> Result<VertexFan, Error> {
    let fans = surface.vertices()?;
    let found = fans.into_iter().find(|fan| fan.vertex == vertex);
    found.ok_or_else(|| Error::content(format!("vertex {vertex} has no faces")))
}

/// The least and the largest Gauss curvature on the outer sides of the squares of a side, in parameters,
/// around a vertex.
///
/// # Errors
/// Those of [`Surface::at`].
pub fn gauss_around(surface: &Surface<'_>, fan: &VertexFan, radius: f64) -> Result<Option<[f64; 2]>, Error> {
    let control = surface.control();
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for &face in &fan.faces {
        let corners = control.face(face as usize);
        let corner = corners.iter().position(|&v| v == fan.vertex).unwrap_or(0) as u32;
        let quad = corners.len() == 4;
        let mut evaluator = surface.evaluator(face)?;
        for k in 0..=8 {
            let x = f64::from(k) / 4.0;
            let (s, t) = (radius * x.min(1.0), radius * (2.0 - x).min(1.0));
            let sample = evaluator.at(Place {
                face,
                sub: if quad { 0 } else { corner },
                corner: if quad { corner } else { 0 },
                s,
                t,
            })?;
            if let Some(gauss) = sample.gauss {
                range = [range[0].min(gauss), range[1].max(gauss)];
            }
        }
    }
    Ok((range[0] <= range[1]).then_some(range))
}

/// The total Gauss curvature by the midpoint rule, with `n x n` samples on each quad or quarter of a face.
///
/// # Errors
/// Those of [`Surface::at`].
pub fn sampled_total(surface: &Surface<'_>, n: usize) -> Result<f64, Error> {
    let mut totals = Totals::default();
    let cell = 1.0 / (n * n) as f64;
    for sample in crate::limits::samples(surface, &surface.grid(n))? {
        add(&mut totals, &sample, cell);
    }
    Ok(totals.gauss)
}
