//! `eigenring plot`: figures with their data.

use super::{RESULTS, UNSTORED};
use crate::args::{self, Schemes};
use crate::error::Error;
use crate::files::{self, Written};
use crate::output::{Extension, agreed};
use crate::progress::{Terminal, note};
use crate::threads::Threads;
use crate::valences::OptionalValences;
use clap::{Args, ValueEnum};
use eigenring_atlas::figures::{self, Drawing, FIGURES, FigureEntry, Inputs, Studies};
use eigenring_atlas::files::is_replaced;
use eigenring_atlas::progress::{Silent, each};
use eigenring_atlas::results::{EVERYTHING, FOLDER};
use eigenring_atlas::schemes::{SchemeName, Tuner};
use eigenring_atlas::sweep::Sweep;
use eigenring_atlas::table::{Format, WIDTH};
use eigenring_figure::{Figure, Width};
use eigenring_nonuniform::{FirstLevel, Scheme, Spokes};
use eigenring_scheme::Spec;
use eigenring_scheme::lambda::Splines;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;

/// Draw figures, each with its data as CSV beside it.
///
/// Numbers come from the stored results where they are found, and are computed on the spot where not. The
/// names of the files that were written are printed.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring plot --list\n  eigenring plot --all\n  eigenring plot samples --valences 5,8 --size one\n  eigenring plot characteristic-map --schemes catmull-clark,lambda:optimal --valences 5,8\n  eigenring plot stencils --valences 3..20 --range 0.3..0.7 --format svg --out /tmp/figures\n  eigenring plot spectrum --schemes file:my.toml --sweep a=1..2:100 -N 5,8\n  eigenring plot blending-functions --knots 3,1,1,3,1 --next 1,1,1,1,1\n  eigenring plot overview -o overview.pdf"
)]
pub struct Arguments {
    /// Names of figures; see --list
    #[arg(value_name = "FIGURE")]
    figures: Vec<String>,
    /// Draw every figure
    #[arg(long, conflicts_with = "figures")]
    all: bool,
    /// List the figures and draw nothing
    #[arg(long, exclusive = true)]
    list: bool,
    /// Output folder; by default results/figures for --all as it is, and eigenring-out/figures for a choice
    /// of figures, or with any option that changes them. For a single picture also its file, which ends with
    /// .svg, .png or .pdf and has its data beside it, or a device or pipe
    #[arg(short, long, value_name = "FOLDER|FILE")]
    out: Option<PathBuf>,
    /// Formats of the pictures: svg, png, pdf; by default svg and png
    #[arg(long, value_name = "LIST", value_enum, value_delimiter = ',')]
    format: Vec<PictureFormat>,
    /// Dots per inch of PNG files, at the printed size; by default 300
    #[arg(long, value_name = "X", value_parser = args::number, allow_negative_numbers = true)]
    dpi: Option<f64>,
    /// Width: one printed column (85 mm) or two (178 mm); by default each figure's own
    #[arg(long, value_enum)]
    size: Option<Size>,
    #[command(flatten)]
    valences: OptionalValences,
    /// Lambdas, separated by commas; by default each figure's own
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = args::number, allow_negative_numbers = true, conflicts_with = "lists")]
    lambda: Vec<f64>,
    /// The range of lambda that is shown, by default 0.15..0.9
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    range: Option<Interval>,
    #[command(flatten)]
    schemes: Schemes,
    /// With figure spectrum: along a parameter of scheme files, from A to B in a number of steps
    #[arg(
        long,
        value_name = "NAME=A..B:STEPS",
        allow_hyphen_values = true,
        conflicts_with = "all"
    )]
    sweep: Option<Sweep>,
    /// Knot intervals of the first edge of each spoke, separated by commas, for figures of schemes with them
    #[arg(long, value_name = "D0,D1,..", value_delimiter = ',', value_parser = args::number, allow_hyphen_values = true, conflicts_with = "all")]
    knots: Vec<f64>,
    /// With --knots: the intervals of all further edges of each spoke; by default the same
    #[arg(long, value_name = "A0,A1,..", value_delimiter = ',', value_parser = args::number, allow_hyphen_values = true, requires = "knots")]
    next: Vec<f64>,
    /// The range of values that colours show; by default each figure's own
    #[arg(long, value_name = "A..B", value_parser = colours, allow_hyphen_values = true)]
    colours: Option<(f64, f64)>,
    /// The folder with stored results; by default results, if it is there
    #[arg(long, value_name = "FOLDER")]
    results: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
}

/// Dots per inch by default.
pub const DPI: f64 = 300.0;

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PictureFormat {
    /// Vector graphics.
    Svg,
    /// The same, rasterised.
    Png,
    /// The same, as a page.
    Pdf,
}

impl Extension for PictureFormat {
    fn extensions(self) -> &'static [&'static str] {
        match self {
            PictureFormat::Svg => &["svg"],
            PictureFormat::Png => &["png"],
            PictureFormat::Pdf => &["pdf"],
        }
    }
}

impl PictureFormat {
    /// What a file's extension names.
    pub fn of(path: &Path) -> Option<Self> {
        agreed(None, Some(path)).ok().flatten()
    }

    /// A figure in this format.
    ///
    /// # Errors
    /// Those of drawing.
    pub fn draw(self, figure: &Figure, dpi: f64) -> Result<Vec<u8>, Error> {
        Ok(match self {
            PictureFormat::Svg => figure.svg()?.into_bytes(),
            PictureFormat::Png => figure.png(dpi)?,
            PictureFormat::Pdf => figure.pdf()?,
        })
    }
}

/// A picture's file and the tables beside it, with the ends of their names.
type Files = (PathBuf, Vec<(String, Vec<u8>)>);

/// Widths of a journal page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Size {
    /// 85 mm.
    One,
    /// 178 mm.
    Two,
}

/// Reads `A..B` with A < B.
fn colours(text: &str) -> Result<(f64, f64), String> {
    let refuse = || "accepted is A..B with finite A < B, such as -2..2".to_owned();
    let (low, high) = text.split_once("..").ok_or_else(refuse)?;
    let number = |text: &str| args::finite(text.trim()).map_err(|_| refuse());
    let (low, high) = (number(low)?, number(high)?);
    if low < high { Ok((low, high)) } else { Err(refuse()) }
}

/// `A..B` with A < B.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval(f64, f64);

/// The lambdas for which stencils are defined.
const LAMBDAS: (f64, f64) = (0.125, 1.0);

impl FromStr for Interval {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let refuse = || "accepted is A..B with 0.125 <= A < B <= 1, such as 0.15..0.9".to_owned();
        let (low, high) = text.split_once("..").ok_or_else(refuse)?;
        let number = |text: &str| text.trim().parse::<f64>().map_err(|_| refuse());
        let (low, high) = (number(low)?, number(high)?);
        if LAMBDAS.0 <= low && low < high && high <= LAMBDAS.1 {
            return Ok(Interval(low, high));
        }
        Err(refuse())
    }
}

/// The lambdas of the tables.
const TABULATED: (f64, f64) = (0.15, 0.9);

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        if self.list {
            files::emit(None, figures::list().fitted(WIDTH).as_bytes())?;
            return Ok(ExitCode::SUCCESS);
        }
        let entries = self.entries()?;
        self.check(&entries)?;
        self.threads.start()?;
        let formats = self.formats()?;
        let file = self.file();
        let out = match file {
            Some(path) => path.parent().unwrap_or(Path::new("")).to_owned(),
            None => self.out(),
        };
        if file.is_none_or(|path| is_replaced(path) && !out.as_os_str().is_empty()) {
            let given = self.out.as_deref().filter(|_| file.is_none());
            files::check_writable(given.unwrap_or(Path::new(UNSTORED)), &out)?;
        }
        let studies = self.studies(&entries)?;
        let spokes = self.spokes()?;
        let tuner = args::tuner();
        let drawn = each(&Terminal, "figures", &entries, |entry| {
            self.draw(entry, &formats, &studies, spokes.as_ref(), &tuner)
        })?;
        if let Some(remark) = &studies.remark {
            note(remark);
        }
        if studies.ranges.is_none() && entries.iter().any(|entry| entry.shaded) {
            note("no stored certificates are found, so no region is shaded as proven: --results names their folder");
        }
        let mut written = Written::default();
        let drawn: Vec<Files> = drawn.into_iter().flatten().collect();
        match (file, drawn.as_slice()) {
            (None, _) => {
                for (stem, files) in drawn {
                    for (end, contents) in files {
                        written.write(out.join(with_end(&stem, &end)), &contents)?;
                    }
                }
            }
            (Some(path), [(_, files)]) => {
                // a device or a pipe takes the picture alone
                let stem = path.with_extension("");
                for (index, (end, contents)) in files.iter().enumerate() {
                    match (index, is_replaced(path)) {
                        (0, true) => written.write(path.to_owned(), contents)?,
                        (0, false) => return files::emit(Some(path), contents).map(|()| ExitCode::SUCCESS),
                        _ => written.write(with_end(&stem, end), contents)?,
                    }
                }
            }
            (Some(path), _) => {
                return Err(Error::usage(
                    format!("{} is one file, and {} pictures are drawn", path.display(), drawn.len()),
                    "a folder, or one figure at one valence",
                ));
            }
        }
        files::emit(None, written.list().as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }

    /// The file that is named in place of a folder: by the extension of a picture, or because something is
    /// there that is none.
    fn file(&self) -> Option<&Path> {
        let path = self.out.as_deref()?;
        let picture = PictureFormat::of(path).is_some() || path.exists();
        (picture && !path.is_dir()).then_some(path)
    }

    /// The formats of the pictures.
    fn formats(&self) -> Result<Vec<PictureFormat>, Error> {
        let Some(path) = self.file() else {
            return Ok(match self.format.as_slice() {
                [] => vec![PictureFormat::Svg, PictureFormat::Png],
                given => given.to_vec(),
            });
        };
        if is_replaced(path) && PictureFormat::of(path).is_none() {
            return Err(Error::usage(
                format!("{} is a file, and no picture", path.display()),
                "a folder, or a file that ends with .svg, .png or .pdf",
            ));
        }
        match self.format.as_slice() {
            [] | [_] => Ok(vec![
                agreed(self.format.first().copied(), Some(path))?.unwrap_or(PictureFormat::Svg),
            ]),
            _ => Err(Error::usage(
                format!("{} is one file, and several formats are asked for", path.display()),
                "one --format, or a folder",
            )),
        }
    }

    /// Where the files go: what is stored in `results` is all figures as they are by default, and nothing
    /// else takes its place unless that folder is named.
    fn out(&self) -> PathBuf {
        let stored = self.all
            && self.valences.valences.is_none()
            && self.lambda.is_empty()
            && self.range.is_none()
            && !self.schemes.given()
            && self.colours.is_none()
            && self.size.is_none();
        let default = if stored { RESULTS } else { UNSTORED };
        self.out.clone().unwrap_or_else(|| Path::new(default).join("figures"))
    }

    /// The figures asked for, each once.
    fn entries(&self) -> Result<Vec<&'static FigureEntry>, Error> {
        if self.all {
            return Ok(FIGURES.iter().collect());
        }
        if self.figures.is_empty() {
            let names: Vec<&str> = FIGURES.iter().map(|entry| entry.name).collect();
            let accepted = format!("--all, --list, or {}", names.join(", "));
            return Err(Error::usage("no figure is named", accepted));
        }
        let mut entries: Vec<&'static FigureEntry> = Vec::new();
        for name in &self.figures {
            let entry = figures::find(name)?;
            if !entries.iter().any(|known| known.name == entry.name) {
                entries.push(entry);
            }
        }
        Ok(entries)
    }

    /// Refuses what the figures do not take; with --all, options go to those that take them.
    fn check(&self, entries: &[&FigureEntry]) -> Result<(), Error> {
        if let Some(valences) = &self.valences.valences {
            valences.closed()?;
        }
        if self.dpi.is_some() && !self.formats()?.contains(&PictureFormat::Png) {
            return Err(Error::usage("--dpi has no meaning without PNG files", "--format png"));
        }
        if self.results.is_some() && !entries.iter().any(|entry| entry.studies || entry.shaded) {
            let names: Vec<&str> = FIGURES
                .iter()
                .filter(|entry| entry.studies || entry.shaded)
                .map(|entry| entry.name)
                .collect();
            return Err(Error::usage(
                "none of these figures reads stored results",
                format!("--results for {}", names.join(", ")),
            ));
        }
        for &lambda in &self.lambda {
            if !(LAMBDAS.0 < lambda && lambda < LAMBDAS.1) {
                return Err(Error::range("lambda", lambda, "0.125 < lambda < 1"));
            }
        }
        if self.all {
            return Ok(());
        }
        for entry in entries {
            let refuse = |option: &str, takes: fn(&FigureEntry) -> bool| {
                let names: Vec<&str> = FIGURES.iter().filter(|e| takes(e)).map(|e| e.name).collect();
                Err(Error::usage(
                    format!("figure {} does not take {option}", entry.name),
                    format!("{option} for {}", names.join(", ")),
                ))
            };
            if self.valences.valences.is_some() && entry.valences.is_empty() && self.knots.is_empty() {
                return refuse("--valences", |entry| !entry.valences.is_empty());
            }
            if self.sweep.is_some() && !entry.sweep {
                return refuse("--sweep", |entry| entry.sweep);
            }
            if !self.knots.is_empty() && !entry.knots {
                return refuse("--knots", |entry| entry.knots);
            }
            if self.range.is_some() && !entry.range {
                return refuse("--range", |entry| entry.range);
            }
            if !self.lambda.is_empty() && !takes_lambda(entry) {
                return refuse("--lambda", takes_lambda);
            }
            if self.schemes.given() && entry.schemes.is_none() {
                return refuse("--schemes", |entry| entry.schemes.is_some());
            }
            if self.colours.is_some() && entry.colours.is_none() {
                return refuse("--colours", |entry| entry.colours.is_some());
            }
        }
        Ok(())
    }

    /// The valences of a figure: given, else the one that a scheme file is for, else the figure's own.
    fn valences<'a>(&'a self, entry: &'a FigureEntry) -> Result<Cow<'a, [usize]>, Error> {
        if entry.valences.is_empty() {
            return Ok(Cow::Borrowed(&[]));
        }
        Ok(match (&self.valences.valences, self.schemes.only_valence()?) {
            (Some(valences), _) => Cow::Borrowed(valences.closed()?),
            (None, Some(only)) => Cow::Owned(vec![only]),
            (None, None) => Cow::Borrowed(entry.valences),
        })
    }

    /// The schemes of a figure that takes them: given by name, as members of the lambda-scheme, or its own.
    fn schemes(&self, entry: &FigureEntry) -> Result<Vec<SchemeName>, Error> {
        if entry.schemes.is_none() {
            return Ok(Vec::new());
        }
        let member = |&lambda: &f64| {
            SchemeName::Spec(Spec::Lambda {
                lambda,
                s: None,
                weights: None,
                splines: Splines::Paper,
            })
        };
        if self.schemes.given() {
            let schemes = self.schemes.all()?;
            let uneven = |scheme: &SchemeName| matches!(scheme, SchemeName::NonUniform(_));
            // with --all each figure takes what it can draw
            if !(self.all && entry.uneven && !schemes.iter().all(uneven)) {
                return Ok(schemes);
            }
        }
        if !self.knots.is_empty() && !entry.uneven {
            return Ok(WITH_INTERVALS.map(SchemeName::NonUniform).to_vec());
        }
        match self.lambda.as_slice() {
            [] => Ok(entry.default_schemes()?),
            _ if entry.uneven => Ok(entry.default_schemes()?),
            lambdas => Ok(lambdas.iter().map(member).collect()),
        }
    }

    /// The knot intervals around a vertex.
    fn spokes(&self) -> Result<Option<Spokes>, Error> {
        if self.knots.is_empty() {
            return Ok(None);
        }
        let next = if self.next.is_empty() { &self.knots } else { &self.next };
        let spokes = Spokes::new(self.knots.clone(), next.clone()).map_err(eigenring_atlas::Error::from)?;
        if let Some(valences) = &self.valences.valences {
            let count = self.knots.len();
            if valences.closed()? != [count] {
                let message = format!("--knots gives {count} spokes, and -N another number");
                return Err(Error::usage(message, format!("{count}, or no -N")));
            }
        }
        Ok(Some(spokes))
    }

    fn studies(&self, entries: &[&FigureEntry]) -> Result<Studies, Error> {
        let mut needed: Vec<usize> = Vec::new();
        for entry in entries.iter().filter(|entry| entry.studies) {
            needed.extend(self.valences(entry)?.iter());
        }
        let default = Path::new(RESULTS);
        let folder = match &self.results {
            Some(folder) => Some(folder.as_path()),
            None => Some(default).filter(|folder| folder.join(FOLDER).join(EVERYTHING).exists()),
        };
        Ok(Studies::load(folder, &needed, &Terminal)?)
    }

    /// The files of a figure.
    fn draw(
        &self,
        entry: &FigureEntry,
        formats: &[PictureFormat],
        studies: &Studies,
        spokes: Option<&Spokes>,
        tuner: &Tuner<'_>,
    ) -> Result<Vec<Files>, Error> {
        let (schemes, valences) = (self.schemes(entry)?, self.valences(entry)?);
        let inputs = Inputs {
            schemes: &schemes,
            colours: entry.colours.map(|default| self.colours.unwrap_or(default)),
            valences: &valences,
            lambdas: match entry.lambdas {
                [] => &[],
                defaults if self.lambda.is_empty() => defaults,
                _ => &self.lambda,
            },
            range: self.range.map_or(TABULATED, |range| (range.0, range.1)),
            width: match self.size {
                Some(Size::One) => Width::One,
                Some(Size::Two) => Width::Two,
                None => entry.width,
            },
            sweep: self.sweep.as_ref(),
            knots: spokes.filter(|_| entry.knots),
            studies,
            tuner,
        };
        let drawings = (entry.build)(&inputs)?;
        // the bar counts figures
        each(&Silent, entry.name, &drawings, |drawing| self.files(drawing, formats))
    }

    fn files(&self, drawing: &Drawing, formats: &[PictureFormat]) -> Result<Files, Error> {
        let Drawing { stem, figure, data } = drawing;
        let mut files = Vec::new();
        for format in PictureFormat::value_variants() {
            if formats.contains(format) {
                let end = format!(".{}", format.extensions()[0]);
                files.push((end, format.draw(figure, self.dpi.unwrap_or(DPI))?));
            }
        }
        for (suffix, table) in data {
            let end = match *suffix {
                "" => ".csv".to_owned(),
                suffix => format!("-{suffix}.csv"),
            };
            files.push((end, table.render(Format::Csv).into_bytes()));
        }
        Ok((PathBuf::from(stem), files))
    }
}

fn with_end(stem: &Path, end: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(end);
    PathBuf::from(name)
}

/// The schemes of figures that are drawn with knot intervals by choice.
const WITH_INTERVALS: [Scheme; 3] = [
    Scheme::Nurss,
    Scheme::EigenPolyhedron,
    Scheme::Hnuss(FirstLevel::Improved),
];

fn takes_lambda(entry: &FigureEntry) -> bool {
    !entry.lambdas.is_empty() || (entry.schemes.is_some() && !entry.uneven)
}
