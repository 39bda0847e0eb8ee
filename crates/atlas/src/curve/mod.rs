//! Curves and surfaces of revolution: refinement of control points, limit, pictures.
//!
//! [`refine`] and [`revolve`] are everything that is known of a polygon at some levels; tables, pictures and
//! OBJ are made of that.

mod example;
mod levels;
mod picture;
mod points;
mod surface;

pub use example::{Exact, Example, MOST};
pub use points::parse;
pub(crate) use surface::faces;

use crate::error::Error;
use crate::table::{Record, Table};
use eigenring_figure::{Figure, Width};
use eigenring_spline::curve::{Curve, Ends, Grid};

/// The most points that a table of one level or of the limit holds: beyond, it would be hundreds of megabytes
/// of text.
const MOST_POINTS: usize = 1 << 20;

/// The fewest pieces of a drawn limit: then they are too short for corners to be seen.
const SMOOTH: usize = 512;

/// A curve at all levels up to some number.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The control points, then the levels in order.
    pub levels: Vec<Curve>,
    /// The largest distance of the limit from the exact curve, if there is one.
    pub deviation: Option<f64>,
    samples: usize,
}

/// Refines a curve `levels` times; its limit is looked at in `samples` points an interval between knots.
///
/// # Errors
/// [`Error::Range`] for more points than a table holds; those of the curve.
pub fn refine(curve: &Curve, exact: Option<&Exact>, levels: usize, samples: usize) -> Result<Refined, Error> {
    let count = levels::check(levels, |level| levels::count_after(curve.axis(), level))?;
    levels::check_samples(samples, curve.axis().intervals())?;
    let mut levels = vec![curve.clone()];
    for level in 0..count as usize {
        levels.push(levels[level].refine()?);
    }
    let deviation = match exact {
        Some(exact) => {
            let limit = curve.sample(samples)?;
            Some(largest(limit.iter().map(|(t, point)| distance(point, &exact.at(*t)))))
        }
        None => None,
    };
    Ok(Refined {
        levels,
        deviation,
        samples,
    })
}

impl Refined {
    fn curve(&self) -> &Curve {
        &self.levels[0]
    }

    /// Order, tension, ends, numbers of points, coordinates and levels, domain; with the deviation if it is
    /// known.
    pub fn summary(&self) -> Record {
        with_deviation(summary(self.curve(), self.levels.len() - 1), self.deviation)
    }

    /// Level, parameter and coordinates of the points of the last level, or of all.
    pub fn points(&self, all: bool) -> Table {
        levels::points(shown(&self.levels, all))
    }

    /// Parameter and coordinates of the points of the limit.
    ///
    /// # Errors
    /// Those of the curve.
    pub fn limit(&self) -> Result<Table, Error> {
        Ok(levels::limit(&self.curve().sample(self.samples)?))
    }

    /// Control polygon, levels and limit as a picture.
    ///
    /// # Errors
    /// [`Error::Usage`] for points with more than three coordinates.
    pub fn figure(&self, width: Width) -> Result<Figure, Error> {
        let curve = self.curve();
        let smooth = curve.sample(self.samples.max(SMOOTH.div_ceil(curve.axis().intervals())))?;
        picture::figure(&self.levels, &smooth, width, &title(curve))
    }
}

/// A surface of revolution at all levels up to some number.
#[derive(Clone, Debug)]
pub struct Revolved {
    /// The control points, then the levels in order.
    pub levels: Vec<Grid>,
    /// The largest distance of the limit from the exact surface, if there is one.
    pub deviation: Option<f64>,
    generatrix: Curve,
    segments: usize,
    samples: usize,
}

/// Turns a curve around the third axis in so many `segments`, and refines the grid `levels` times. Of two
/// coordinates the first is the radius and the second the height.
///
/// # Errors
/// [`Error::Range`] for numbers of segments and for more points than a table holds; [`Error::Usage`] for a
/// curve of other than two or three coordinates; those of the grid.
pub fn revolve(
    curve: &Curve,
    exact: Option<&Exact>,
    segments: usize,
    levels: usize,
    samples: usize,
) -> Result<Revolved, Error> {
    if !(3..=MOST).contains(&segments) {
        return Err(Error::Range {
            what: "number of segments",
            given: segments.to_string(),
            accepted: format!("3 to {MOST}"),
        });
    }
    let grid = surface::revolved(curve, segments)?;
    let (u, v) = (grid.u(), grid.v());
    let count = levels::check(levels, |level| {
        levels::count_after(u, level) * levels::count_after(v, level)
    })?;
    levels::check_samples(samples, u.intervals().saturating_mul(v.intervals()))?;
    let mut levels: Vec<Grid> = vec![grid.clone()];
    for level in 0..count as usize {
        levels.push(levels[level].refine()?);
    }
    let deviation = match exact {
        Some(exact) => {
            let (s, t) = (u.samples(samples)?, v.samples(samples)?);
            let rows = grid.sample(samples)?;
            Some(largest(rows.iter().zip(&s).flat_map(|(row, (s, _))| {
                let point = exact.at(*s);
                row.iter()
                    .zip(&t)
                    .map(move |(found, (t, _))| distance(found, &surface::turned(&point, segments, *t)))
            })))
        }
        None => None,
    };
    Ok(Revolved {
        levels,
        deviation,
        generatrix: curve.clone(),
        segments,
        samples,
    })
}

impl Revolved {
    /// As [`Refined::summary`], of the curve that is turned, with the number of segments.
    pub fn summary(&self) -> Record {
        let record = summary(&self.generatrix, self.levels.len() - 1).with("segments", self.segments);
        with_deviation(record, self.deviation)
    }

    /// Level, parameters along and around, and coordinates of the points of the last level, or of all.
    pub fn points(&self, all: bool) -> Table {
        surface::points(shown(&self.levels, all))
    }

    /// The last level as Wavefront OBJ: its points, and quadrilaterals that count them from 1.
    pub fn obj(&self) -> String {
        self.levels.last().map_or(String::new(), surface::obj)
    }

    /// The limit in its control mesh as a picture.
    ///
    /// # Errors
    /// Those of the grid.
    pub fn figure(&self, width: Width) -> Result<Figure, Error> {
        let title = format!("{}, {} segments", title(&self.generatrix), self.segments);
        surface::figure(&self.levels[0], self.samples, width, &title)
    }
}

fn shown<T>(levels: &[T], all: bool) -> &[T] {
    if all { levels } else { &levels[levels.len() - 1..] }
}

fn summary(curve: &Curve, levels: usize) -> Record {
    let axis = curve.axis();
    let (from, to) = axis.domain();
    Record::default()
        .with("order", axis.order())
        .with("u0", axis.tension().value())
        .with(
            "ends",
            match axis.ends() {
                Ends::Open => "open",
                Ends::Clamped => "clamped",
                Ends::Closed => "closed",
            },
        )
        .with("control_points", axis.count())
        .with("coordinates", curve.dimension())
        .with("from", from)
        .with("to", to)
        .with("levels", levels)
}

fn with_deviation(record: Record, deviation: Option<f64>) -> Record {
    match deviation {
        Some(deviation) => record.with("deviation", deviation),
        None => record,
    }
}

fn title(curve: &Curve) -> String {
    let u0 = (curve.axis().tension().value() * 1e4).round() / 1e4;
    format!("order {}, $u_0$ = {u0}", curve.axis().order()).replace('-', "−")
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn largest(distances: impl Iterator<Item = f64>) -> f64 {
    distances.fold(0.0, f64::max)
}
