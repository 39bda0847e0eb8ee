//! `eigenring curve`: refinement of control points, with the limit and a picture.

use super::plot::{PictureFormat, Size};
use crate::args;
use crate::error::Error;
use crate::files;
use crate::output::{FormatArg, FormatOption, agreed};
use crate::progress::note;
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use eigenring_atlas::Accepted;
use eigenring_atlas::curve::{Exact, Example, parse, refine, revolve};
use eigenring_atlas::table::{Format, Record, Table, pretty};
use eigenring_figure::{Figure, Width};
use eigenring_spline::curve::{Curve, Ends};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Refine the control points of a curve of any order with tension, and draw it.
///
/// POINTS is a table of numbers: a point a line, one coordinate or more, with or without a header, in any of
/// the formats that 'eigenring spectrum --matrix' reads; - is standard input. The refined points
/// of the last level go to standard output, or with -o into a file; columns are level, parameter, and x, y, z
/// (x1, x2, ... beyond three). An open curve belongs to the middle of its polygon: it does not reach the
/// first and the last control point. A clamped one starts and ends in them, as a NURBS curve with k-fold end
/// knots does.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring curve --example circle --count 4 --order 3    four points, an exact circle\n  eigenring curve --example fang-fig1 --levels 4 -o refined.csv --limit limit.csv --plot curve.svg\n  eigenring curve --example ellipse --levels 1 --format json\n  eigenring curve --example hyperbola --revolve --segments 6 --obj h.obj --plot h.png\nWith points of your own:\n  eigenring curve points.csv --order 4 --u0 10 --closed --plot curve.png\n  eigenring curve points.csv --order 4 --ends clamped --limit limit.csv --plot curve.svg"
)]
pub struct Arguments {
    /// The control points
    #[arg(value_name = "POINTS.csv", required_unless_present = "example")]
    points: Option<PathBuf>,
    /// A built-in curve that its control points give exactly; the largest distance of the limit from it is
    /// reported
    #[arg(long, value_enum, value_name = "NAME", conflicts_with_all = ["points", "closed", "open", "ends"])]
    example: Option<ExampleArg>,
    /// Order k, 2 to 32: degree k-1 if u0 = 1; by default 4, or the example's own. Order 2 is the polygon
    /// itself, with u0 = 1
    #[arg(long, value_name = "K", value_parser = args::order::<2>, allow_negative_numbers = true)]
    order: Option<usize>,
    /// Initial tension, u0 > -1; by default 1 (B-splines), or the example's own
    #[arg(long, value_name = "U", value_parser = args::number, allow_negative_numbers = true)]
    u0: Option<f64>,
    /// How the polygon ends; by default open. Clamped ends have u0 = 1
    #[arg(long, value_enum, value_name = "ENDS", conflicts_with_all = ["closed", "open"])]
    ends: Option<EndsArg>,
    /// Short for --ends closed: join the last point to the first
    #[arg(long, conflicts_with = "open")]
    closed: bool,
    /// Short for --ends open
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
    /// The file for the refined points, in the format that its extension names (.csv, .json, .tex, .txt),
    /// else CSV; standard output then has the summary only, in the format of --format
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Also write points of the limit, as CSV: parameter, x, y, z
    #[arg(long, value_name = "FILE", conflicts_with = "revolve")]
    limit: Option<PathBuf>,
    /// Points of the limit per interval between knots, for --limit, --plot and the distance of an --example;
    /// by default 16
    #[arg(long, value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    samples: Option<usize>,
    /// Draw control polygon, levels and limit: a file that ends with .svg, .png or .pdf
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Dots per inch of a PNG file, at the printed size; by default 300
    #[arg(long, value_name = "X", requires = "plot", value_parser = args::number, allow_negative_numbers = true)]
    dpi: Option<f64>,
    /// Width of the picture: one printed column (85 mm) or two (178 mm)
    #[arg(long, value_enum, default_value = "one", requires = "plot")]
    size: Size,
    /// Turn the curve around the z axis; two coordinates are radius and height. Columns are level, u, v, x,
    /// y, z
    #[arg(long)]
    revolve: bool,
    /// With --revolve: control points around the axis, up to 64; by default 4
    #[arg(long, value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    segments: Option<usize>,
    /// Write the refined grid as quadrilaterals in Wavefront OBJ
    #[arg(long, value_name = "FILE", requires = "revolve")]
    obj: Option<PathBuf>,
    #[command(flatten)]
    format: FormatOption,
}

/// See [`Ends`].
#[derive(Clone, Copy, Debug, ValueEnum)]
enum EndsArg {
    /// The curve belongs to the middle of the polygon
    Open,
    /// It starts in the first control point and ends in the last
    Clamped,
    /// The last control point is followed by the first
    Closed,
}

/// See [`Example`].
#[derive(Clone, Copy, Debug)]
struct ExampleArg(Example);

impl ValueEnum for ExampleArg {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [ExampleArg; Example::ALL.len()] = {
            let mut all = [ExampleArg(Example::Circle); Example::ALL.len()];
            let mut index = 0;
            while index < all.len() {
                all[index] = ExampleArg(Example::ALL[index]);
                index += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()).help(self.0.summary()))
    }
}

/// Points of the limit per interval by default.
const SAMPLES: usize = 16;

/// Control points around the axis by default.
const SEGMENTS: usize = 4;

/// What the command puts out.
struct Found {
    summary: Record,
    points: Table,
    files: Vec<(PathBuf, Vec<u8>)>,
}

impl Found {
    /// Summary and points in a format; CSV and LaTeX have the points alone.
    fn render(&self, format: Format) -> String {
        match format {
            Format::Text => format!("{}\n{}", self.summary.text(), self.points.render(format)),
            Format::Json => {
                let mut object = self.summary.json();
                object.insert("points".to_owned(), self.points.json());
                pretty(&Value::Object(object))
            }
            _ => self.points.render(format),
        }
    }
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
            files::save(path, contents)?;
        }
        let format = self.format.format();
        let printed = match &self.out {
            Some(path) => {
                let named = agreed(None, Some(path))?.unwrap_or(FormatArg::Csv);
                files::save(path, found.render(named.into()).as_bytes())?;
                found.summary.render(format)
            }
            None => found.render(format),
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
                return Err(Error::usage(
                    format!("{} is named twice", path.display()),
                    "a file of its own for each output",
                ));
            }
        }
        // the parser lets an option pass whose partner conflicts with another one
        if self.segments.is_some() && !self.revolve {
            return Err(Error::usage(
                "--segments has no meaning for a curve",
                "--segments with --revolve",
            ));
        }
        if self.samples.is_some() && self.limit.is_none() && self.plot.is_none() && self.example.is_none() {
            let message = "--samples has no meaning where no points of the limit are shown";
            return Err(Error::usage(message, "--samples with --limit, --plot or --example"));
        }
        match &self.plot {
            Some(path) => match PictureFormat::of(path) {
                None => Err(Error::usage(
                    format!("picture {}", path.display()),
                    "a name that ends with .svg, .png or .pdf",
                )),
                Some(PictureFormat::Svg | PictureFormat::Pdf) if self.dpi.is_some() => Err(Error::usage(
                    "--dpi has a meaning for PNG files only",
                    "--dpi with a picture that ends with .png",
                )),
                Some(_) => Ok(()),
            },
            None => Ok(()),
        }
    }

    /// The curve that is asked for, and its functions if it is an example.
    fn curve(&self) -> Result<(Curve, Option<Exact>), Error> {
        let path = match (&self.points, self.example) {
            (_, Some(ExampleArg(example))) => {
                let (curve, exact) = example.curve(self.order, self.u0, self.count)?;
                return Ok((curve, Some(exact)));
            }
            (Some(path), None) => path,
            (None, None) => {
                return Err(Error::usage("no points are given", "a file of points, or --example"));
            }
        };
        let points = parse(&files::read_bytes(path)?).map_err(|error| error.in_file(path))?;
        let ends = match self.ends {
            Some(EndsArg::Clamped) => Ends::Clamped,
            Some(EndsArg::Closed) => Ends::Closed,
            None if self.closed => Ends::Closed,
            Some(EndsArg::Open) | None => Ends::Open,
        };
        if ends == Ends::Closed && points.len() > 1 && points.first() == points.last() {
            note("the last point is the first again, which a closed polygon has twice then");
        }
        let order = self.order.unwrap_or(4);
        let curve = Curve::new(order, self.u0.unwrap_or(1.0), ends, &points).map_err(|error| match error {
            // what is wrong with the file, and not with the options
            eigenring_spline::Error::ControlPoints {
                count,
                minimum,
                maximum,
            } if ends != Ends::Closed => {
                let ends = if ends == Ends::Open { "open" } else { "clamped" };
                let accepted = Accepted::Are(format!("{minimum} to {maximum} here ({ends}, order {order})"));
                let reason = eigenring_atlas::Error::refused(format!("{count} control points"), accepted);
                Error::from(reason.in_file(path))
            }
            eigenring_spline::Error::ControlPoints { .. } => eigenring_atlas::Error::from(error).in_file(path).into(),
            other => other.into(),
        })?;
        Ok((curve, None))
    }

    /// Says how far the limit is from the exact curve where the tables on standard output have no place for
    /// it.
    fn note_deviation(&self, deviation: Option<f64>) {
        if let Some(deviation) = deviation
            && self.out.is_none()
            && matches!(self.format.format(), Format::Csv | Format::Latex)
        {
            note(&format!("the limit is within {deviation:.2e} of the exact one"));
        }
    }

    fn refined(&self, curve: &Curve, exact: Option<&Exact>) -> Result<Found, Error> {
        let refined = refine(curve, exact, self.levels, self.samples.unwrap_or(SAMPLES))?;
        self.note_deviation(refined.deviation);
        let mut files = Vec::new();
        if let Some(path) = &self.limit {
            files.push((path.clone(), refined.limit()?.render(Format::Csv).into_bytes()));
        }
        if let Some(path) = &self.plot {
            files.push((path.clone(), self.picture(path, &refined.figure(self.width())?)?));
        }
        Ok(Found {
            summary: refined.summary(),
            points: refined.points(self.all_levels),
            files,
        })
    }

    fn surface(&self, curve: &Curve, exact: Option<&Exact>) -> Result<Found, Error> {
        let revolved = revolve(
            curve,
            exact,
            self.segments.unwrap_or(SEGMENTS),
            self.levels,
            self.samples.unwrap_or(SAMPLES),
        )?;
        self.note_deviation(revolved.deviation);
        let mut files = Vec::new();
        if let Some(path) = &self.obj {
            files.push((path.clone(), revolved.obj().into_bytes()));
        }
        if let Some(path) = &self.plot {
            files.push((path.clone(), self.picture(path, &revolved.figure(self.width())?)?));
        }
        Ok(Found {
            summary: revolved.summary(),
            points: revolved.points(self.all_levels),
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
        let format = PictureFormat::of(path).unwrap_or(PictureFormat::Svg);
        format.draw(figure, self.dpi.unwrap_or(super::plot::DPI))
    }
}
