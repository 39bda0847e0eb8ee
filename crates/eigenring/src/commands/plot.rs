//! `eigenring plot`: figures with their data.

use super::{RESULTS, UNSTORED};
use crate::args::{self, Schemes};
use crate::error::Error;
use crate::files::{self, Written};
use crate::progress::{Terminal, note};
use crate::threads::Threads;
use crate::valences::OptionalValences;
use clap::{Args, ValueEnum};
use eigenring_atlas::figures::{self, Drawing, FIGURES, FigureEntry, Inputs, Studies};
use eigenring_atlas::progress::{Silent, each};
use eigenring_atlas::results::{EVERYTHING, FOLDER};
use eigenring_atlas::schemes::{SchemeName, Tuner};
use eigenring_atlas::table::Format;
use eigenring_figure::Width;
use eigenring_scheme::Spec;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;

/// Draw figures, each with its data as CSV beside it.
///
/// Numbers come from the stored results where they are found, and are computed on the spot where not. The
/// names of the files that were written are printed.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring plot --list\n  eigenring plot --all\n  eigenring plot samples --valences 5,8 --size one\n  eigenring plot characteristic-map --schemes catmull-clark,lambda:optimal --valences 5,8\n  eigenring plot stencils --valences 3..20 --range 0.3..0.7 --format svg --out /tmp/figures"
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
    /// of figures, or with any option that changes them
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Formats of the pictures
    #[arg(
        long,
        value_name = "LIST",
        value_enum,
        value_delimiter = ',',
        default_value = "svg,png"
    )]
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
}

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
            files::emit(None, figures::list().render(Format::Text).as_bytes())?;
            return Ok(ExitCode::SUCCESS);
        }
        let entries = self.entries()?;
        self.check(&entries)?;
        self.threads.start()?;
        let out = self.out();
        files::check_writable(self.out.as_deref().unwrap_or(Path::new(UNSTORED)), &out)?;
        let studies = self.studies(&entries)?;
        let tuner = args::tuner();
        let drawn = each(&Terminal, "figures", &entries, |entry| {
            self.draw(entry, &studies, &tuner)
        })?;
        let mut written = Written::default();
        for (name, contents) in drawn.into_iter().flatten() {
            written.write(out.join(name), &contents)?;
        }
        if let Some(remark) = &studies.remark {
            note(remark);
        }
        files::emit(None, written.list().as_bytes())?;
        Ok(ExitCode::SUCCESS)
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
        if self.dpi.is_some() && !self.format.contains(&PictureFormat::Png) {
            return Err(Error::usage("--dpi has no meaning without PNG files", "--format png"));
        }
        if self.results.is_some() && !entries.iter().any(|entry| entry.studies) {
            let names: Vec<&str> = FIGURES
                .iter()
                .filter(|entry| entry.studies)
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
            if self.valences.valences.is_some() && entry.valences.is_empty() {
                return refuse("--valences", |entry| !entry.valences.is_empty());
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

    fn valences<'a>(&'a self, entry: &'a FigureEntry) -> Result<&'a [usize], Error> {
        match &self.valences.valences {
            Some(valences) if !entry.valences.is_empty() => valences.closed(),
            _ => Ok(entry.valences),
        }
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
            })
        };
        if self.schemes.given() {
            return self.schemes.all();
        }
        match self.lambda.as_slice() {
            [] => Ok(entry.default_schemes()?),
            lambdas => Ok(lambdas.iter().map(member).collect()),
        }
    }

    fn studies(&self, entries: &[&FigureEntry]) -> Result<Studies, Error> {
        let mut needed: Vec<usize> = Vec::new();
        for entry in entries.iter().filter(|entry| entry.studies) {
            needed.extend(self.valences(entry)?);
        }
        let default = Path::new(RESULTS);
        let folder = match &self.results {
            Some(folder) => Some(folder.as_path()),
            None => Some(default).filter(|folder| folder.join(FOLDER).join(EVERYTHING).exists()),
        };
        Ok(Studies::load(folder, &needed, &Terminal)?)
    }

    /// The files of a figure.
    fn draw(&self, entry: &FigureEntry, studies: &Studies, tuner: &Tuner<'_>) -> Result<Vec<(String, Vec<u8>)>, Error> {
        let schemes = self.schemes(entry)?;
        let inputs = Inputs {
            schemes: &schemes,
            colours: entry.colours.map(|default| self.colours.unwrap_or(default)),
            valences: self.valences(entry)?,
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
            studies,
            tuner,
        };
        let drawings = (entry.build)(&inputs)?;
        // the bar counts figures
        Ok(each(&Silent, entry.name, &drawings, |drawing| self.files(drawing))?.concat())
    }

    fn files(&self, drawing: &Drawing) -> Result<Vec<(String, Vec<u8>)>, Error> {
        let Drawing { stem, figure, data } = drawing;
        let mut files = Vec::new();
        if self.format.contains(&PictureFormat::Svg) {
            files.push((format!("{stem}.svg"), figure.svg()?.into_bytes()));
        }
        if self.format.contains(&PictureFormat::Png) {
            files.push((format!("{stem}.png"), figure.png(self.dpi.unwrap_or(DPI))?));
        }
        for (suffix, table) in data {
            let name = match *suffix {
                "" => format!("{stem}.csv"),
                suffix => format!("{stem}-{suffix}.csv"),
            };
            files.push((name, table.render(Format::Csv).into_bytes()));
        }
        Ok(files)
    }
}

fn takes_lambda(entry: &FigureEntry) -> bool {
    !entry.lambdas.is_empty() || entry.schemes.is_some()
}
