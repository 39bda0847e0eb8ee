//! Limit points of surfaces as tables: at places, at vertices, on grids.

use crate::decimal;
use crate::error::{Accepted, Error};
use crate::table::{Cell, Format, Table};
use eigenring_surface::Vector3;
use eigenring_surface::limit::{Evaluator, Kind, Place, Sample, Surface, VertexFan};
use rayon::prelude::*;
use std::collections::HashMap;
use std::fmt::Write;
use std::path::Path;

/// Samples at places, in their order; faces are evaluated in parallel.
///
/// # Errors
/// Those of [`Surface::at`], for the first face with one.
pub fn samples(surface: &Surface<'_>, places: &[Place]) -> Result<Vec<Sample>, Error> {
    samples_with(surface, &mut HashMap::new(), places)
}

/// Evaluators are kept for as many faces.
const KEPT: usize = 4096;

/// The same with what is known of faces from places before.
fn samples_with<'s, 'r>(
    surface: &'s Surface<'r>,
    known: &mut HashMap<u32, Evaluator<'s, 'r>>,
    places: &[Place],
) -> Result<Vec<Sample>, Error> {
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    order.sort_by_key(|&index| places[index as usize].face);
    let groups: Vec<&[u32]> = order
        .chunk_by(|&a, &b| places[a as usize].face == places[b as usize].face)
        .collect();
    let face = |group: &[u32]| places[group[0] as usize].face;
    let before: Vec<Option<Evaluator<'s, 'r>>> = groups.iter().map(|group| known.remove(&face(group))).collect();
    let found: Result<Vec<(Evaluator<'s, 'r>, Vec<Sample>)>, eigenring_surface::Error> = groups
        .par_iter()
        .zip(before)
        .map(|(group, before)| {
            let mut evaluator = match before {
                Some(evaluator) => evaluator,
                None => surface.evaluator(face(group))?,
            };
            let samples: Result<Vec<Sample>, _> = group
                .iter()
                .map(|&index| evaluator.at(places[index as usize]))
                .collect();
            Ok((evaluator, samples?))
        })
        .collect();
    let mut samples = vec![None; places.len()];
    for (group, (evaluator, found)) in groups.iter().zip(found?) {
        if known.len() < KEPT {
            known.insert(face(group), evaluator);
        }
        for (&index, sample) in group.iter().zip(found) {
            samples[index as usize] = Some(sample);
        }
    }
    Ok(samples.into_iter().flatten().collect())
}

/// Samples as columns, the coordinates of a point next to each other; NaN where something does not exist.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    /// Points, 3 numbers each.
    pub points: Vec<f64>,
    /// First derivatives by s and t, 6 numbers each.
    pub first: Vec<f64>,
    /// Second derivatives by ss, st, tt, 9 numbers each.
    pub second: Vec<f64>,
    /// Unit normals, 3 numbers each.
    pub normals: Vec<f64>,
    /// Gauss curvature.
    pub gauss: Vec<f64>,
    /// Mean curvature.
    pub mean: Vec<f64>,
    /// Principal curvatures, 2 numbers each.
    pub principal: Vec<f64>,
    /// What the surface is like there.
    pub kinds: Vec<Kind>,
}

/// Places that are evaluated before their samples become columns: these then stay in the processor's cache.
const AT_ONCE: usize = 1 << 14;

/// The samples at places as columns, in parallel.
///
/// # Errors
/// As [`samples`].
pub fn columns(surface: &Surface<'_>, places: &[Place]) -> Result<Columns, Error> {
    let count = places.len();
    let zeros = |width: usize| vec![0.0; width * count];
    let mut columns = Columns {
        points: zeros(3),
        first: zeros(6),
        second: zeros(9),
        normals: zeros(3),
        gauss: zeros(1),
        mean: zeros(1),
        principal: zeros(2),
        kinds: Vec::with_capacity(count),
    };
    let mut known = HashMap::new();
    for (index, part) in places.chunks(AT_ONCE).enumerate() {
        let found = samples_with(surface, &mut known, part)?;
        let start = index * AT_ONCE;
        let rows = start..start + part.len();
        let wide = |width: usize| width * rows.start..width * rows.end;
        let targets = (
            columns.points[wide(3)].par_chunks_mut(3),
            columns.first[wide(6)].par_chunks_mut(6),
            columns.second[wide(9)].par_chunks_mut(9),
            columns.normals[wide(3)].par_chunks_mut(3),
            columns.gauss[wide(1)].par_iter_mut(),
            columns.mean[wide(1)].par_iter_mut(),
            columns.principal[wide(2)].par_chunks_mut(2),
            found.par_iter(),
        );
        let targets = targets.into_par_iter().with_min_len(AT_ONCE / 16);
        targets.for_each(|(point, first, second, normal, gauss, mean, principal, sample)| {
            vectors(point, Some([sample.position.coords]));
            vectors(first, sample.first);
            vectors(second, sample.second);
            vectors(normal, sample.normal.map(|normal| [normal]));
            *gauss = sample.gauss.unwrap_or(f64::NAN);
            *mean = sample.mean.unwrap_or(f64::NAN);
            principal.copy_from_slice(&sample.principal.unwrap_or([f64::NAN; 2]));
        });
        columns.kinds.extend(found.iter().map(|sample| sample.kind));
    }
    Ok(columns)
}

fn vectors<const N: usize>(target: &mut [f64], source: Option<[Vector3<f64>; N]>) {
    match source {
        Some(source) => {
            for (target, vector) in target.chunks_exact_mut(3).zip(source) {
                target.copy_from_slice(vector.as_slice());
            }
        }
        None => target.fill(f64::NAN),
    }
}

pub(crate) fn number(x: Option<f64>) -> Cell {
    x.filter(|x| x.is_finite()).map_or(Cell::Empty, Cell::from)
}

/// The columns of points: place, point, derivatives up to the given order, normal, curvatures, kind.
pub fn point_table(places: &[Place], samples: &[Sample], derivatives: usize) -> Table {
    let mut columns = vec!["face", "sub", "s", "t", "x", "y", "z"];
    let first = ["xs", "ys", "zs", "xt", "yt", "zt"];
    let second = ["xss", "yss", "zss", "xst", "yst", "zst", "xtt", "ytt", "ztt"];
    if derivatives > 0 {
        columns.extend(first);
    }
    if derivatives > 1 {
        columns.extend(second);
    }
    columns.extend(["nx", "ny", "nz", "gauss", "mean", "k1", "k2", "kind"]);
    let mut table = Table::new(columns);
    for (place, sample) in places.iter().zip(samples) {
        let mut row: Vec<Cell> = vec![
            (place.face as usize).into(),
            (place.sub as usize).into(),
            place.s.into(),
            place.t.into(),
        ];
        row.extend(sample.position.iter().map(|&x| Cell::from(x)));
        if derivatives > 0 {
            let values = sample.first.iter().flatten().flat_map(|v| v.iter().copied().map(Some));
            row.extend(values.chain(std::iter::repeat(None)).take(6).map(number));
        }
        if derivatives > 1 {
            let values = sample.second.iter().flatten().flat_map(|v| v.iter().copied().map(Some));
            row.extend(values.chain(std::iter::repeat(None)).take(9).map(number));
        }
        row.extend((0..3).map(|k| number(sample.normal.map(|n| n[k]))));
        row.extend(
            [
                sample.gauss,
                sample.mean,
                sample.principal.map(|k| k[0]),
                sample.principal.map(|k| k[1]),
            ]
            .map(number),
        );
        row.push(sample.kind.name().into());
        table.push(row);
    }
    table
}

/// A row of the table of points as CSV: what does not exist is empty.
fn csv_row(text: &mut String, place: &Place, sample: &Sample, derivatives: usize) -> std::fmt::Result {
    let number = |text: &mut String, x: Option<f64>| {
        text.push(',');
        if let Some(x) = x.filter(|x| x.is_finite()) {
            decimal::push(text, x);
        }
    };
    let vector = |text: &mut String, v: Option<&Vector3<f64>>| (0..3).for_each(|k| number(text, v.map(|v| v[k])));
    write!(text, "{},{}", place.face, place.sub)?;
    [place.s, place.t].into_iter().for_each(|x| number(text, Some(x)));
    vector(text, Some(&sample.position.coords));
    if derivatives > 0 {
        (0..2).for_each(|k| vector(text, sample.first.as_ref().map(|first| &first[k])));
    }
    if derivatives > 1 {
        (0..3).for_each(|k| vector(text, sample.second.as_ref().map(|second| &second[k])));
    }
    vector(text, sample.normal.as_ref());
    let [k1, k2] = [0, 1].map(|k| sample.principal.map(|principal| principal[k]));
    [sample.gauss, sample.mean, k1, k2]
        .into_iter()
        .for_each(|x| number(text, x));
    writeln!(text, ",{}", sample.kind.name())
}

/// Why a table is not written.
#[derive(Debug, thiserror::Error)]
pub enum CsvError {
    /// A place has no point.
    #[error(transparent)]
    Place(#[from] Error),
    /// The file takes nothing more.
    #[error(transparent)]
    Write(#[from] std::io::Error),
}

/// Evaluates places and writes the table of points as CSV, in full precision, for any number of them: some
/// ten thousand at a time, in parallel.
///
/// # Errors
/// Those of [`samples`], for a place that is not there before anything is written; those of writing.
pub fn write_csv(
    surface: &Surface<'_>,
    places: &[Place],
    derivatives: usize,
    out: &mut dyn std::io::Write,
) -> Result<(), CsvError> {
    const AT_ONCE: usize = 2048;
    for &place in places {
        surface.check(place).map_err(Error::from)?;
    }
    let mut known = HashMap::new();
    out.write_all(point_table(&[], &[], derivatives).render(Format::Csv).as_bytes())?;
    for places in places.chunks(32 * AT_ONCE) {
        let samples = samples_with(surface, &mut known, places)?;
        let parts: Result<Vec<String>, std::fmt::Error> = places
            .par_chunks(AT_ONCE)
            .zip(samples.par_chunks(AT_ONCE))
            .map(|(places, samples)| {
                let mut text = String::with_capacity(600 * places.len());
                for (place, sample) in places.iter().zip(samples) {
                    csv_row(&mut text, place, sample, derivatives)?;
                }
                Ok(text)
            })
            .collect();
        for part in parts.map_err(std::io::Error::other)? {
            out.write_all(part.as_bytes())?;
        }
    }
    Ok(())
}

/// The columns of vertices.
pub(crate) const VERTEX_COLUMNS: [&str; 14] = [
    "vertex",
    "fan",
    "faces",
    "rule",
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "kind",
    "gauss_min",
    "gauss_max",
    "exponent",
];

/// The columns of vertices: a row for each fan of faces between sharp edges.
pub fn vertex_table(surface: &Surface<'_>, fans: &[VertexFan]) -> Table {
    let mut table = Table::new(VERTEX_COLUMNS);
    let mut next = fans.iter().peekable();
    for vertex in 0..surface.control().points().len() as u32 {
        let mut found = false;
        while let Some(fan) = next.next_if(|fan| fan.vertex == vertex) {
            found = true;
            let sample = &fan.sample;
            let faces: Vec<String> = fan.faces.iter().map(u32::to_string).collect();
            let mut row: Vec<Cell> = vec![
                (vertex as usize).into(),
                (fan.fan as usize).into(),
                faces.join(" ").into(),
                fan.rule.name().into(),
            ];
            row.extend(sample.position.iter().map(|&x| Cell::from(x)));
            row.extend((0..3).map(|k| number(sample.normal.map(|n| n[k]))));
            row.push(sample.kind.name().into());
            let (low, high, exponent) = match sample.kind {
                Kind::Bounded { gauss, .. } => (Some(gauss[0]), Some(gauss[1]), None),
                Kind::Unbounded { exponent, signs } => {
                    // only the signs are known of what grows without bound
                    let end = |sign: f64| if sign == 0.0 { Some(0.0) } else { None };
                    (end(signs[0]), end(signs[1]), Some(exponent))
                }
                _ => (sample.gauss, sample.gauss, None),
            };
            row.extend([low, high, exponent].map(number));
            table.push(row);
        }
        if !found {
            // unused vertices keep their number
            let mut row: Vec<Cell> = vec![(vertex as usize).into()];
            row.resize(VERTEX_COLUMNS.len(), Cell::Empty);
            table.push(row);
        }
    }
    table
}

/// Reads places: `face,sub,s,t[,corner]`, with or without a header.
///
/// # Errors
/// [`Error::Read`], [`Error::InFile`] with the line.
pub fn read_places(path: &Path) -> Result<Vec<Place>, Error> {
    let text = crate::files::read(path)?;
    let mut places = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if line.trim().is_empty() || (index == 0 && cells[0].parse::<f64>().is_err()) {
            continue;
        }
        let place = || -> Option<Place> {
            let (&[face, sub, s, t], corner) = match cells.as_slice() {
                [rest @ .., corner] if rest.len() == 4 => (rest.first_chunk::<4>()?, *corner),
                rest => (rest.first_chunk::<4>().filter(|_| rest.len() == 4)?, "0"),
            };
            Some(Place {
                face: face.parse().ok()?,
                sub: sub.parse().ok()?,
                corner: corner.parse().ok()?,
                s: s.parse().ok()?,
                t: t.parse().ok()?,
            })
        };
        places.push(place().ok_or_else(|| {
            let accepted = Accepted::Are("columns face,sub,s,t and, if wanted, corner".to_owned());
            Error::refused(format!("line {}: '{line}'", index + 1), accepted).in_file(path)
        })?);
    }
    Ok(places)
}
