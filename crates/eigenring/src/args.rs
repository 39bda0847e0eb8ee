//! Arguments that several commands share.

use crate::error::Error;
use crate::progress::Terminal;
use clap::{Args, ValueEnum};
use eigenring_atlas::cache::Cache;
use eigenring_atlas::schemes::Tuner;
use eigenring_atlas::table::Format;
use eigenring_scheme::Shape;
use eigenring_scheme::lambda::Bounds;
use eigenring_tune::objective::{Normalisation, Settings};
use eigenring_tune::search::Starts;
use eigenring_tune::sweep::Options;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// The largest valence the command takes. Local matrices grow with the square of the valence, and nothing
/// beyond is met in practice.
pub const MAX_VALENCE: usize = 1000;

/// The default margin, that of [`Options`], as it is printed in help texts.
pub const MARGIN: &str = "2e-6";

/// Reads a valence.
pub fn valence(text: &str) -> Result<usize, String> {
    let valence = text.parse().ok().filter(|valence| (3..=MAX_VALENCE).contains(valence));
    valence.ok_or_else(|| format!("accepted is 3 to {MAX_VALENCE}"))
}

/// Reads a number. Its range, which may depend on other arguments, is for the command to check, and so is
/// NaN.
pub fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "accepted is a number such as 0.55".to_owned())
}

/// Reads a number that has no other range.
pub fn finite(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "accepted is a finite number such as 0.25".to_owned())
}

/// Reads a count, whose range is for the command to check.
pub fn count(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "accepted is a whole number".to_owned())
}

/// What the scheme sees at its centre: a closed fan of N sectors, unless an option says otherwise.
#[derive(Args, Clone, Debug)]
pub struct CornerArgs {
    /// Valence; may be left out with --fan and --knots, which fix it
    #[arg(short = 'N', long, value_name = "N", value_parser = valence, allow_negative_numbers = true)]
    valence: Option<usize>,
    /// A boundary vertex, or one side of a crease vertex, with so many faces
    #[arg(long, value_name = "FACES", value_parser = count, allow_negative_numbers = true, conflicts_with_all = ["dart", "cusp", "knots"])]
    fan: Option<usize>,
    /// With --fan: the vertex is a corner, which stays where it is
    #[arg(long, requires = "fan")]
    corner: bool,
    /// A vertex at which one crease ends
    #[arg(long, conflicts_with_all = ["cusp", "knots"])]
    dart: bool,
    /// A vertex that stays where it is, without creases
    #[arg(long, conflicts_with = "knots")]
    cusp: bool,
    /// Creases and fixed vertices act in the first C smoothing steps of each level only (even orders)
    #[arg(long, value_name = "C", value_parser = count, allow_negative_numbers = true)]
    cs: Option<usize>,
    /// Knot intervals of the first edge of each spoke, separated by commas
    #[arg(long, value_name = "D0,D1,..", value_delimiter = ',', value_parser = number, allow_hyphen_values = true)]
    knots: Vec<f64>,
    /// With --knots: the intervals of all further edges of each spoke; by default the same
    #[arg(long, value_name = "A0,A1,..", value_delimiter = ',', value_parser = number, allow_hyphen_values = true, requires = "knots")]
    next: Vec<f64>,
}

impl CornerArgs {
    /// The shape, and in how many steps creases act.
    ///
    /// # Errors
    /// A valence that is missing or is not that of the shape.
    pub fn shape(&self) -> Result<(Shape, Option<usize>), Error> {
        let fixed = match self.fan {
            Some(faces) => Some(("--fan", faces)),
            None if !self.knots.is_empty() => Some(("--knots", self.knots.len())),
            None => None,
        };
        let sectors = match (fixed, self.valence) {
            (Some((option, sectors)), Some(valence)) if valence != sectors => {
                let message = format!("-N is {valence}, and {option} gives {sectors}");
                return Err(Error::usage(message, format!("{sectors}, or no -N")));
            }
            (Some((_, sectors)), _) => sectors,
            (None, Some(valence)) => valence,
            (None, None) => {
                return Err(Error::usage(
                    "no valence is given",
                    format!("-N with 3 to {MAX_VALENCE}"),
                ));
            }
        };
        let shape = if self.fan.is_some() {
            Shape::Fan {
                faces: sectors,
                corner: self.corner,
            }
        } else if self.dart {
            Shape::Dart { valence: sectors }
        } else if self.cusp {
            Shape::Cusp { valence: sectors }
        } else if self.knots.is_empty() {
            Shape::Closed { sectors }
        } else {
            let next = if self.next.is_empty() { &self.knots } else { &self.next };
            Shape::Knots {
                intervals: self.knots.clone(),
                next: next.clone(),
            }
        };
        Ok((shape, self.cs))
    }

    /// The valence alone, for what has no other corners.
    ///
    /// # Errors
    /// A valence that is missing, or another corner.
    pub fn plain(&self) -> Result<usize, Error> {
        match self.shape()? {
            (Shape::Closed { sectors }, None) => Ok(sectors),
            _ => {
                let message = "--fan, --corner, --dart, --cusp, --cs and --knots say what a scheme sees";
                Err(Error::usage(message, "-N alone here"))
            }
        }
    }
}

/// The output format.
#[derive(Args, Clone, Copy, Debug)]
pub struct Output {
    /// How results are printed
    #[arg(long, value_enum, default_value_t)]
    format: FormatArg,
}

/// See [`Format`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum FormatArg {
    /// Columns for people; numbers to ten digits.
    #[default]
    Text,
    /// One JSON value, full precision.
    Json,
    /// Comma-separated values with a header, full precision.
    Csv,
    /// A LaTeX tabular; numbers to ten digits.
    Latex,
}

impl Output {
    /// The format that was chosen.
    pub fn format(&self) -> Format {
        match self.format {
            FormatArg::Text => Format::Text,
            FormatArg::Json => Format::Json,
            FormatArg::Csv => Format::Csv,
            FormatArg::Latex => Format::Latex,
        }
    }
}

/// Finds schemes for users: with their cache, and with notes and bars on the terminal.
pub fn tuner() -> Tuner<'static> {
    Tuner {
        cache: Cache::of_user(),
        progress: &Terminal,
    }
}

/// A list of valences: "5", "3..20" (both ends included), "3,5,8..10".
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Valences(pub Vec<usize>);

impl FromStr for Valences {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let refuse = || format!("accepted are numbers from 3 to {MAX_VALENCE} and ranges, such as 3..20 or 3,5,8..10");
        let mut valences = Vec::new();
        for part in text.split(',') {
            let number = |text: &str| text.trim().parse::<usize>().map_err(|_| refuse());
            let range: RangeInclusive<usize> = match part.split_once("..") {
                Some((first, last)) => number(first)?..=number(last.trim_start_matches('='))?,
                None => number(part)?..=number(part)?,
            };
            if range.is_empty() || *range.start() < 3 || *range.end() > MAX_VALENCE {
                return Err(refuse());
            }
            valences.extend(range);
        }
        valences.sort_unstable();
        valences.dedup();
        Ok(Valences(valences))
    }
}

/// The constants of the objective.
#[derive(Args, Clone, Copy, Debug)]
pub struct ObjectiveArgs {
    /// Do not penalise sign changes of the Gauss curvature
    #[arg(long)]
    pub unweighted: bool,
    /// Width of the weight's transition, relative to the ideal Gauss curvature
    #[arg(long, default_value_t = 0.2, value_name = "X", value_parser = number, allow_negative_numbers = true)]
    pub epsilon: f64,
    /// Square root of the largest weight
    #[arg(long, default_value_t = 5.0, value_name = "X", value_parser = number, allow_negative_numbers = true)]
    pub weight: f64,
    /// Gauss points per patch and direction
    #[arg(long, default_value_t = 5, value_name = "COUNT", value_parser = count, allow_negative_numbers = true)]
    pub quadrature: usize,
    /// Ratio alpha/beta of the vertex stencil's total weights
    #[arg(long, default_value_t = 6.0, value_name = "X", value_parser = number, allow_negative_numbers = true)]
    pub phi: f64,
    /// Scale of the eigenvectors: unit norm over five rings, or unit first edge neighbour
    #[arg(long, value_enum, default_value_t)]
    pub normalisation: NormalisationArg,
}

/// See [`Normalisation`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum NormalisationArg {
    /// Unit norm over the five rings.
    #[default]
    Paper,
    /// First edge neighbour at distance 1.
    UnitRing,
}

impl ObjectiveArgs {
    /// The settings of the objective.
    pub fn settings(&self) -> Settings {
        Settings {
            epsilon: self.epsilon,
            n: self.weight,
            quadrature_order: self.quadrature,
            weighted: !self.unweighted,
            normalisation: match self.normalisation {
                NormalisationArg::Paper => Normalisation::Paper,
                NormalisationArg::UnitRing => Normalisation::UnitRing,
            },
        }
    }
}

/// How stencils are tuned.
#[derive(Args, Clone, Copy, Debug)]
pub struct TuningArgs {
    /// Descend from the local minima of the 10 x 10 starting points, or from all of them
    #[arg(long, value_enum, default_value_t)]
    pub starts: StartsArg,
    /// The bound on the last Fourier block: the paper's, or the exact one for odd valences
    #[arg(long, value_enum, default_value_t)]
    pub bounds: BoundsArg,
    /// Relative distance of the samples from eigenvalue bounds
    #[arg(long, value_name = "X", default_value = MARGIN, value_parser = number, allow_negative_numbers = true)]
    pub margin: f64,
    #[command(flatten)]
    pub objective: ObjectiveArgs,
}

impl TuningArgs {
    /// The options of the tuning.
    pub fn options(&self) -> Options {
        Options {
            bounds: self.bounds.into(),
            margin: self.margin,
            phi: self.objective.phi,
            settings: self.objective.settings(),
            starts: self.starts.into(),
        }
    }
}

/// See [`Starts`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum StartsArg {
    /// From the local minima of the grid.
    #[default]
    #[value(name = "10x10")]
    Grid,
    /// From every grid point.
    Full,
}

impl From<StartsArg> for Starts {
    fn from(starts: StartsArg) -> Starts {
        match starts {
            StartsArg::Grid => Starts::Grid,
            StartsArg::Full => Starts::Full,
        }
    }
}

/// See [`Bounds`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum BoundsArg {
    /// As published.
    #[default]
    Paper,
    /// Exact.
    Sharp,
}

impl From<BoundsArg> for Bounds {
    fn from(bounds: BoundsArg) -> Bounds {
        match bounds {
            BoundsArg::Paper => Bounds::Paper,
            BoundsArg::Sharp => Bounds::Sharp,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_margin_is_that_of_the_library() {
        assert_eq!(number(MARGIN), Ok(Options::default().margin));
    }

    #[test]
    fn lists_of_valences() {
        let list = |text: &str| text.parse::<Valences>().map(|v| v.0);
        assert_eq!(list("5"), Ok(vec![5]));
        assert_eq!(list("3..6"), Ok(vec![3, 4, 5, 6]));
        assert_eq!(list("8..=9,3, 4,3"), Ok(vec![3, 4, 8, 9]));
        for bad in ["", "2", "2..5", "6..3", "x", "3..", "1001", "3..99999999999999999999"] {
            assert!(list(bad).is_err(), "{bad}");
        }
    }
}
