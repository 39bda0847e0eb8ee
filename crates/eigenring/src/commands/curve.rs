//! `eigenring curve`: refinement of control points, with the limit and a picture.

mod example;
mod levels;
mod picture;
mod points;
mod surface;

pub use example::Example;

use super::plot::Size;
use crate::args::{self, Output};
use crate::error::Error;
use crate::files;
use crate::progress::note;
use crate::table::{Format, Record, Table, pretty};
use clap::Args;
use eigenring_figure::{Figure, Width};
use eigenring_spline::curve::{Curve, Ends, Grid, MAX_ORDER};
use example::{Exact, MOST};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Refine the control points of a curve of any order with tension, and draw it.
///
/// POINTS is a CSV file: a point a line, one coordinate or more, with or without a header. The refined points of the last level
/// go to standard output, or with -o into a file; columns are level, parameter, and x, y, z (x1, x2, ... beyond three).
/// An open curve belongs to the middle of its polygon: it does not reach the first and the last control point.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring curve --example circle --count 4 --order 3    four points, an exact circle\n  eigenring curve --example fang-fig1 --levels 4 -o refined.csv --limit limit.csv --plot curve.svg\n  eigenring curve --example ellipse --levels 1 --format json\n  eigenring curve --example hyperbola --revolve --segments 6 --obj hyperboloid.obj --plot hyperboloid.png\nWith points of your own: eigenring curve points.csv --order 4 --u0 10 --closed --plot curve.png"
)]
pub struct Arguments {
    /// The control points
    #[arg(value_name = "POINTS.csv", required_unless_present = "example")]
    points: Option<PathBuf>,
    /// A built-in curve that its control points give exactly; the largest distance of the limit from it is reported
    #[arg(long, value_enum, value_name = "NAME", conflicts_with_all = ["points", "closed", "open"])]
    example: Option<Example>,
    /// Order k, 3 to 32: degree k-1 if u0 = 1; by default 4, or the example's own
    #[arg(long, value_name = "K", value_parser = order, allow_negative_numbers = true)]
    order: Option<usize>,
    /// Initial tension, u0 > -1; by default 1 (B-splines), or the example's own
    #[arg(long, value_name = "U", value_parser = args::number, allow_negative_numbers = true)]
    u0: Option<f64>,
    /// Join the last point to the first
    #[arg(long, conflicts_with = "open")]
    closed: bool,
    /// Leave the ends open (default)
    #[arg(long)]
    open: bool,
    /// Control points of the example, up to 64
    #[arg(long, value_name = "COUNT", conflicts_with = "points", value_parser = args::count, allow_negative_numbers = true)]
    count: Option<usize>,
    /// Levels of refinement
    #[arg(long, value_name = "COUNT", default_value_t = 3, value_parser = args::count, allow_negative_numbers = true)]
    levels: usize,
    /// Write the points of all levels, from the control points on
    #[arg(long)]
    all_levels: bool,
    /// The file for the refined points, as CSV; standard output then has the summary only
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Also write points of the limit, as CSV: parameter, x, y, z
    #[arg(long, value_name = "FILE", conflicts_with = "revolve")]
    limit: Option<PathBuf>,
    /// Points of the limit per interval between knots
    #[arg(long, value_name = "COUNT", default_value_t = 16, value_parser = args::count, allow_negative_numbers = true)]
    samples: usize,
    /// Draw control polygon, levels and limit: a file that ends with .svg or .png
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Dots per inch of a PNG file, at the printed size
    #[arg(long, value_name = "X", default_value = "300", value_parser = args::number, allow_negative_numbers = true)]
    dpi: f64,
    /// Width of the picture: one printed column (85 mm) or two (178 mm)
    #[arg(long, value_enum, default_value = "one")]
    size: Size,
    /// Turn the curve around the z axis; two coordinates are radius and height. Columns are level, u, v, x, y, z
    #[arg(long)]
    revolve: bool,
    /// Control points around the axis, up to 64
    #[arg(long, value_name = "COUNT", default_value_t = 4, value_parser = args::count, allow_negative_numbers = true)]
    segments: usize,
    /// Write the refined grid as quadrilaterals in Wavefront OBJ
    #[arg(long, value_name = "FILE", requires = "revolve")]
    obj: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

/// The most points that a table of one level or of the limit holds: beyond, it would be hundreds of megabytes of text.
const MOST_POINTS: usize = 1 << 20;

/// The fewest pieces of a drawn limit: then they are too short for corners to be seen.
const SMOOTH: usize = 512;

fn order(text: &str) -> Result<usize, String> {
    let order = text.parse().ok().filter(|order| (3..=MAX_ORDER).contains(order));
    order.ok_or_else(|| format!("accepted are 3 to {MAX_ORDER}"))
}

/// What the command puts out.
struct Found {
    summary: Record,
    points: Table,
    files: Vec<(PathBuf, Vec<u8>)>,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        self.check_files()?;
        let (curve, exact) = self.curve()?;
        let found = match self.revolve {
            true => self.surface(&curve, exact.as_ref())?,
            false => self.refined(&curve, exact.as_ref())?,
        };
        // files first: a failure leaves standard output empty
        for (path, contents) in &found.files {
            files::write(path, contents)?;
        }
        let format = self.output.format;
        let printed = match (&self.out, format) {
            (Some(path), _) => {
                files::write(path, found.points.render(Format::Csv).as_bytes())?;
                found.summary.render(format)
            }
            (None, Format::Text) => format!("{}\n{}", found.summary.text(), found.points.render(format)),
            (None, Format::Json) => {
                let mut object = found.summary.json();
                object.insert("points".to_owned(), found.points.json());
                pretty(&Value::Object(object))
            }
            (None, _) => found.points.render(format),
        };
        files::emit(None, printed.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }

    /// Refuses files that would overwrite each other, and pictures of other kinds.
    fn check_files(&self) -> Result<(), Error> {
        let written = [&self.out, &self.limit, &self.plot, &self.obj];
        let written: Vec<&PathBuf> = written.into_iter().flatten().collect();
        for (index, path) in written.iter().enumerate() {
            if written[..index].contains(path) {
                return Err(Error::Usage {
                    message: format!("{} is named twice", path.display()),
                    accepted: "a file of its own for each output".to_owned(),
                });
            }
        }
        match &self.plot {
            Some(path) if !is(path, "svg") && !is(path, "png") => Err(Error::Usage {
                message: format!("picture {}", path.display()),
                accepted: "a name that ends with .svg or .png".to_owned(),
            }),
            _ => Ok(()),
        }
    }

    /// The curve that is asked for, and its functions if it is an example.
    fn curve(&self) -> Result<(Curve, Option<Exact>), Error> {
        let path = match (&self.points, self.example) {
            (_, Some(example)) => {
                let (curve, exact) = example.curve(self.order, self.u0, self.count)?;
                return Ok((curve, Some(exact)));
            }
            (Some(path), None) => path,
            (None, None) => {
                return Err(Error::Usage {
                    message: "no points are given".to_owned(),
                    accepted: "a file of points, or --example".to_owned(),
                });
            }
        };
        let points = points::read(path)?;
        let ends = if self.closed { Ends::Closed } else { Ends::Open };
        if self.closed && points.len() > 1 && points.first() == points.last() {
            note("the last point is the first again, which a closed polygon has twice then");
        }
        let order = self.order.unwrap_or(4);
        let curve = Curve::new(order, self.u0.unwrap_or(1.0), ends, &points).map_err(|error| match error {
            // what is wrong with the file, and not with the options
            eigenring_spline::Error::ControlPoints { .. } => Error::BadFile {
                path: path.clone(),
                message: match ends {
                    Ends::Open => format!("{error} (open, order {order})"),
                    Ends::Closed => error.to_string(),
                },
            },
            other => other.into(),
        })?;
        Ok((curve, None))
    }

    fn summary(&self, curve: &Curve, levels: u32) -> Record {
        let axis = curve.axis();
        let (from, to) = axis.domain();
        Record::default()
            .with("order", axis.order())
            .with("u0", axis.tension().value())
            .with("ends", if axis.ends() == Ends::Closed { "closed" } else { "open" })
            .with("control_points", axis.count())
            .with("coordinates", curve.dimension())
            .with("from", from)
            .with("to", to)
            .with("levels", levels as usize)
    }

    /// Adds how far the limit is from the exact curve, in the formats of tables on standard error.
    fn deviation(&self, summary: Record, distances: impl Iterator<Item = f64>) -> Record {
        let deviation = distances.fold(0.0, f64::max);
        if self.out.is_none() && matches!(self.output.format, Format::Csv | Format::Latex) {
            note(&format!("the limit is within {deviation:.2e} of the exact one"));
        }
        summary.with("deviation", deviation)
    }

    fn refined(&self, curve: &Curve, exact: Option<&Exact>) -> Result<Found, Error> {
        let count = levels::check(self.levels, |level| levels::count_after(curve.axis(), level))?;
        levels::check_samples(self.samples, curve.axis().intervals())?;
        let mut levels = vec![curve.clone()];
        for level in 0..count as usize {
            levels.push(levels[level].refine()?);
        }
        let mut summary = self.summary(curve, count);
        let mut files = Vec::new();
        let limit = match self.limit.is_some() || exact.is_some() {
            true => curve.sample(self.samples)?,
            false => Vec::new(),
        };
        if let Some(exact) = exact {
            let distances = limit.iter().map(|(t, point)| distance(point, &exact.at(*t)));
            summary = self.deviation(summary, distances);
        }
        if let Some(path) = &self.limit {
            files.push((path.clone(), levels::limit(&limit).render(Format::Csv).into_bytes()));
        }
        if let Some(path) = &self.plot {
            let smooth = curve.sample(self.samples.max(SMOOTH.div_ceil(curve.axis().intervals())))?;
            let figure = picture::figure(&levels, &smooth, self.width(), &title(curve))?;
            files.push((path.clone(), self.picture(path, &figure)?));
        }
        let shown = if self.all_levels { 0 } else { count as usize };
        Ok(Found {
            summary,
            points: levels::points(&levels[shown..]),
            files,
        })
    }

    fn surface(&self, curve: &Curve, exact: Option<&Exact>) -> Result<Found, Error> {
        let segments = self.segments;
        if !(3..=MOST).contains(&segments) {
            return Err(Error::Range {
                what: "number of segments",
                given: segments.to_string(),
                accepted: format!("3 to {MOST}"),
            });
        }
        let grid = surface::revolved(curve, segments)?;
        let (u, v) = (grid.u(), grid.v());
        let count = levels::check(self.levels, |level| {
            levels::count_after(u, level) * levels::count_after(v, level)
        })?;
        levels::check_samples(self.samples, u.intervals().saturating_mul(v.intervals()))?;
        let mut levels: Vec<Grid> = vec![grid.clone()];
        for level in 0..count as usize {
            levels.push(levels[level].refine()?);
        }
        let mut summary = self.summary(curve, count).with("segments", segments);
        if let Some(exact) = exact {
            let (s, t) = (u.samples(self.samples)?, v.samples(self.samples)?);
            let rows = grid.sample(self.samples)?;
            let distances = rows.iter().zip(&s).flat_map(|(row, (s, _))| {
                let point = exact.at(*s);
                row.iter()
                    .zip(&t)
                    .map(move |(found, (t, _))| distance(found, &surface::turned(&point, segments, *t)))
            });
            summary = self.deviation(summary, distances);
        }
        let mut files = Vec::new();
        if let (Some(path), Some(last)) = (&self.obj, levels.last()) {
            files.push((path.clone(), surface::obj(last).into_bytes()));
        }
        if let Some(path) = &self.plot {
            let title = format!("{}, {segments} segments", title(curve));
            let figure = surface::figure(&grid, self.samples, self.width(), &title)?;
            files.push((path.clone(), self.picture(path, &figure)?));
        }
        let shown = if self.all_levels { 0 } else { count as usize };
        Ok(Found {
            summary,
            points: surface::points(&levels[shown..]),
            files,
        })
    }

    fn width(&self) -> Width {
        match self.size {
            Size::One => Width::One,
            Size::Two => Width::Two,
        }
    }

    fn picture(&self, path: &Path, figure: &Figure) -> Result<Vec<u8>, Error> {
        Ok(match is(path, "png") {
            true => figure.png(self.dpi)?,
            false => figure.svg()?.into_bytes(),
        })
    }
}

fn is(path: &Path, extension: &str) -> bool {
    path.extension()
        .is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

fn title(curve: &Curve) -> String {
    let u0 = (curve.axis().tension().value() * 1e4).round() / 1e4;
    format!("order {}, $u_0$ = {u0}", curve.axis().order()).replace('-', "−")
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
