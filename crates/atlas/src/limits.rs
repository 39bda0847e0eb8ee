//! Limit points of surfaces as tables: at places, at vertices, on grids.

use crate::decimal;
use crate::error::{Accepted, Error};
use crate::table::{Cell, Format, Table};
use eigenring_surface::Vector3;
use eigenring_surface::limit::{Kind, Place, Sample, Surface, VertexFan};
use rayon::prelude::*;
use std::fmt::Write;
use std::path::Path;

/// Samples at places, in their order, in parallel.
///
/// # Errors
/// Those of [`Surface::at_each`].
pub fn samples(surface: &Surface<'_>, places: &[Place]) -> Result<Vec<Sample>, Error> {
    let mut samples = vec![Sample::ORIGIN; places.len()];
    let part = part(places.len(), |index| places[index].face);
    let parts = places.par_chunks(part).zip(samples.par_chunks_mut(part));
    let found = parts.map(|(places, samples)| {
        surface.at_each(places, |numbers, found| {
            for (&number, sample) in numbers.iter().zip(found) {
                samples[number as usize] = *sample;
            }
        })
    });
    all(found, || surface.at_each(places, |_, _| {}))?;
    Ok(samples)
}

/// Places that a thread evaluates at a time, at least.
const AT_ONCE: usize = 1 << 14;

/// How many places make a part, of which each is evaluated on one thread. It makes anew what its faces need:
/// where places follow their faces, only a face at an end of a part is in another too; elsewhere a face may
/// be in all, and there are no more of these than threads.
fn part(count: usize, face: impl Fn(usize) -> u32) -> usize {
    match (0..count).is_sorted_by_key(face) {
        true => AT_ONCE,
        false => count.div_ceil(rayon::current_num_threads()).max(AT_ONCE),
    }
}

/// Whether all parts are done; else what is wrong with the whole, which does not depend on how it was cut.
fn all<E>(
    parts: impl ParallelIterator<Item = Result<(), E>>,
    whole: impl FnOnce() -> Result<(), eigenring_surface::Error>,
) -> Result<(), Error> {
    match parts.all(|part| part.is_ok()) {
        true => Ok(()),
        false => Ok(whole()?),
    }
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
    /// What the surface is like there, as places in [`KINDS`].
    pub kinds: Vec<u8>,
}

/// The words for what a surface is like at a point.
pub const KINDS: [&str; 5] = ["regular", "flat", "bounded", "unbounded", "not defined"];

fn kind_number(kind: &Kind) -> u8 {
    match kind {
        Kind::Regular => 0,
        Kind::Flat => 1,
        Kind::Bounded { .. } => 2,
        Kind::Unbounded { .. } => 3,
        Kind::Undefined(_) => 4,
    }
}

/// The samples at `count` places as columns, in parallel.
///
/// # Errors
/// As [`samples`].
pub fn columns(surface: &Surface<'_>, count: usize, place: impl Fn(usize) -> Place + Sync) -> Result<Columns, Error> {
    // not touched here, but by the threads that fill them
    let zeros = |width: usize| vec![0.0; width * count];
    let mut columns = Columns {
        points: zeros(3),
        first: zeros(6),
        second: zeros(9),
        normals: zeros(3),
        gauss: zeros(1),
        mean: zeros(1),
        principal: zeros(2),
        kinds: vec![0; count],
    };
    let part = part(count, |index| place(index).face);
    let parts = (
        columns.points.par_chunks_mut(3 * part),
        columns.first.par_chunks_mut(6 * part),
        columns.second.par_chunks_mut(9 * part),
        columns.normals.par_chunks_mut(3 * part),
        columns.gauss.par_chunks_mut(part),
        columns.mean.par_chunks_mut(part),
        columns.principal.par_chunks_mut(2 * part),
        columns.kinds.par_chunks_mut(part),
    );
    let found = parts.into_par_iter().enumerate().map(
        |(number, (points, first, second, normals, gauss, mean, principal, kinds))| {
            let start = number * part;
            let places: Vec<Place> = (start..start + kinds.len()).map(&place).collect();
            surface.at_each(&places, |numbers, found| {
                for (&number, sample) in numbers.iter().zip(found) {
                    let row = number as usize;
                    let wide = |width: usize| width * row..width * (row + 1);
                    vectors(&mut points[wide(3)], Some([sample.position.coords]));
                    vectors(&mut first[wide(6)], sample.first);
                    vectors(&mut second[wide(9)], sample.second);
                    vectors(&mut normals[wide(3)], sample.normal.map(|normal| [normal]));
                    gauss[row] = sample.gauss.unwrap_or(f64::NAN);
                    mean[row] = sample.mean.unwrap_or(f64::NAN);
                    principal[wide(2)].copy_from_slice(&sample.principal.unwrap_or([f64::NAN; 2]));
                    kinds[row] = kind_number(&sample.kind);
                }
            })
        },
    );
    all(found, || {
        let places: Vec<Place> = (0..count).map(&place).collect();
        surface.at_each(&places, |_, _| {})
    })?;
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
    out.write_all(point_table(&[], &[], derivatives).render(Format::Csv).as_bytes())?;
    for places in places.chunks(32 * AT_ONCE) {
        let samples = samples(surface, places)?;
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
