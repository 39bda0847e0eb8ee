//! Arguments that several commands share.

use crate::error::Error;
use crate::progress::Terminal;
use crate::valences;
use clap::{Args, ValueEnum};
use eigenring_atlas::cache::Cache;
use eigenring_atlas::on_mesh::{OnMesh, OnMeshList};
use eigenring_atlas::schemes::{self, SchemeList, SchemeName, Tuner};
use eigenring_scheme::lambda::Bounds;
use eigenring_scheme::{Number, Shape};
use eigenring_spline::curve::MAX_ORDER;
use eigenring_tune::objective::{Normalisation, Settings};
use eigenring_tune::search::Starts;
use eigenring_tune::sweep::Options;

/// The default margin, that of [`Options`], as it is printed in help texts.
pub const MARGIN: &str = "2e-6";

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

/// Reads an order from LEAST to [`MAX_ORDER`].
pub fn order<const LEAST: usize>(text: &str) -> Result<usize, String> {
    let order = text.parse().ok().filter(|order| (LEAST..=MAX_ORDER).contains(order));
    order.ok_or_else(|| format!("accepted are {LEAST} to {MAX_ORDER}"))
}

/// What the scheme sees at its centre: a closed fan of N sectors, unless an option says otherwise.
#[derive(Args, Clone, Debug)]
pub struct CornerArgs {
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
    /// The number of sectors that these options fix, with the option that does.
    fn fixed(&self) -> Option<(&'static str, usize)> {
        match self.fan {
            Some(faces) => Some(("--fan", faces)),
            None if !self.knots.is_empty() => Some(("--knots", self.knots.len())),
            None => None,
        }
    }

    /// The shape at a valence, which a scheme's file may fix, and in how many steps creases act.
    ///
    /// # Errors
    /// A valence that is missing or is not that of the shape; those of reading the file.
    pub fn shape(&self, valence: Option<usize>, scheme: &SchemeName) -> Result<(Shape, Option<usize>), Error> {
        // the parser lets an option pass whose partner conflicts with another one
        if self.corner && self.fan.is_none() {
            return Err(Error::usage(
                "--corner has no meaning without --fan",
                "--corner with --fan FACES",
            ));
        }
        if !self.next.is_empty() && self.knots.is_empty() {
            return Err(Error::usage(
                "--next has no meaning without --knots",
                "--next with --knots D0,D1,..",
            ));
        }
        let sectors = match (self.fixed(), valence) {
            (Some((option, sectors)), Some(valence)) if valence != sectors => {
                let message = format!("-N is {valence}, and {option} gives {sectors}");
                return Err(Error::usage(message, format!("{sectors}, or no -N")));
            }
            (Some((_, sectors)), _) => sectors,
            (None, Some(valence)) => valences::of_scheme(valence)?,
            (None, None) => only_valence(scheme)?,
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

    /// The first of these options that was given, for what has closed fans only.
    fn given(&self) -> Option<&'static str> {
        let options = [
            ("--fan", self.fan.is_some()),
            ("--dart", self.dart),
            ("--cusp", self.cusp),
            ("--cs", self.cs.is_some()),
            ("--knots", !self.knots.is_empty()),
            ("--corner", self.corner),
            ("--next", !self.next.is_empty()),
        ];
        options.iter().find(|(_, given)| *given).map(|(option, _)| *option)
    }

    /// Refuses all corners but closed fans; `with` says of what they have no meaning.
    ///
    /// # Errors
    /// The option that was given.
    pub fn refuse(&self, with: &str) -> Result<(), Error> {
        match self.given() {
            Some(option) => Err(Error::usage(format!("{option} has no meaning {with}"), "-N alone here")),
            None => Ok(()),
        }
    }
}

/// The valence of a scheme whose file is for one alone.
///
/// # Errors
/// No valence, where the scheme has several; those of reading the file.
pub fn only_valence(scheme: &SchemeName) -> Result<usize, Error> {
    scheme.only_valence()?.ok_or_else(valences::missing)
}

/// Values for the parameters of scheme files.
#[derive(Args, Clone, Debug)]
pub struct SchemeSettings {
    /// Set a parameter of a scheme file; may be repeated. The same as file:SCHEME.toml,NAME=VALUE
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting, allow_hyphen_values = true)]
    values: Vec<(String, Number)>,
}

/// Reads a value of a parameter.
fn setting(text: &str) -> Result<(String, Number), String> {
    schemes::setting(text).map_err(|reason| format!("{reason}: accepted is NAME=VALUE with a number or a fraction"))
}

impl SchemeSettings {
    /// The scheme with these values.
    ///
    /// # Errors
    /// A scheme that is no file.
    pub fn apply(&self, scheme: SchemeName) -> Result<SchemeName, Error> {
        Ok(scheme.setting(&self.values)?)
    }

    /// Refuses values where there is no scheme; `accepted` is what they go with.
    ///
    /// # Errors
    /// Any values.
    pub fn refuse(&self, accepted: &str) -> Result<(), Error> {
        match self.values.is_empty() {
            true => Ok(()),
            false => Err(Error::usage("--set has no meaning without a scheme file", accepted)),
        }
    }
}

/// One scheme.
#[derive(Args, Clone, Debug)]
pub struct OneScheme {
    /// The scheme: see 'eigenring --help'
    #[arg(long, value_name = "SPEC")]
    scheme: SchemeName,
    #[command(flatten)]
    settings: SchemeSettings,
}

impl OneScheme {
    /// The scheme with its parameters set.
    ///
    /// # Errors
    /// Those of [`SchemeSettings::apply`].
    pub fn name(self) -> Result<SchemeName, Error> {
        self.settings.apply(self.scheme)
    }
}

/// One scheme on a mesh.
#[derive(Args, Clone, Debug)]
pub struct SchemeOnMesh {
    /// The scheme: see 'eigenring --help'. Even orders take cs=C, the number of smoothing steps in which
    /// creases act
    #[arg(long, value_name = "SPEC")]
    scheme: OnMesh,
    #[command(flatten)]
    settings: SchemeSettings,
}

impl SchemeOnMesh {
    /// The scheme with its parameters set.
    ///
    /// # Errors
    /// Those of [`SchemeSettings::apply`].
    pub fn scheme(&self) -> Result<OnMesh, Error> {
        Ok(OnMesh {
            name: self.settings.apply(self.scheme.name.clone())?,
            steps: self.scheme.steps,
        })
    }
}

/// Which control points of which level.
#[derive(Args, Clone, Copy, Debug)]
pub struct NetArgs {
    /// Rings of control points; by default as many as 'eigenring spectrum' takes, mostly the smallest closed
    /// set
    #[arg(long, value_name = "R", value_parser = count, allow_negative_numbers = true)]
    pub rings: Option<usize>,
    /// Level of refinement, 0 for the first; by default the limit level
    #[arg(long, value_name = "LEVEL", value_parser = count, allow_negative_numbers = true)]
    pub level: Option<usize>,
}

/// Schemes as a list, or one by one.
#[derive(Args, Clone, Debug)]
pub struct Schemes {
    /// Schemes, separated by commas, or --schemes for each; see 'eigenring --help'. A path with commas
    /// stands in quotes: file:"a,b.toml"
    #[arg(long = "schemes", value_name = "SPEC,SPEC,..")]
    lists: Vec<SchemeList>,
    #[command(flatten)]
    settings: SchemeSettings,
}

impl Schemes {
    /// All that were given, each once, and at least one. Parameters are set in the files among them.
    ///
    /// # Errors
    /// No schemes; parameters, and no file.
    pub fn required(&self) -> Result<Vec<SchemeName>, Error> {
        if self.given() {
            return self.all();
        }
        Err(Error::usage(
            "no schemes are given",
            "--schemes SPEC,SPEC,.., see 'eigenring --help'",
        ))
    }

    /// All that were given, each once. Parameters are set in the files among them.
    ///
    /// # Errors
    /// Parameters, and no file.
    pub fn all(&self) -> Result<Vec<SchemeName>, Error> {
        let mut all: Vec<SchemeName> = Vec::new();
        let has_file = self
            .lists
            .iter()
            .flat_map(|list| &list.0)
            .any(|scheme| matches!(scheme, SchemeName::File(_)));
        for scheme in self.lists.iter().flat_map(|list| &list.0) {
            let scheme = match scheme {
                SchemeName::Spec(_) | SchemeName::NonUniform(_) if has_file => scheme.clone(),
                _ => self.settings.apply(scheme.clone())?,
            };
            if !all.contains(&scheme) {
                all.push(scheme);
            }
        }
        Ok(all)
    }

    /// The valence that the files among them are for, if there are such files and they agree.
    ///
    /// # Errors
    /// Those of reading the files.
    pub fn only_valence(&self) -> Result<Option<usize>, Error> {
        let mut found = None;
        for scheme in self.lists.iter().flat_map(|list| &list.0) {
            match (found, scheme.only_valence()?) {
                (Some(one), Some(other)) if one != other => return Ok(None),
                (_, only) => found = only.or(found),
            }
        }
        Ok(found)
    }

    /// Whether any was given.
    pub fn given(&self) -> bool {
        !self.lists.is_empty()
    }
}

/// Schemes on a mesh as a list, or one by one.
#[derive(Args, Clone, Debug)]
pub struct SchemesOnMesh {
    /// Schemes, separated by commas, or --schemes for each; see 'eigenring --help'. Even orders take cs=C,
    /// the number of smoothing steps in which creases act
    #[arg(long = "schemes", value_name = "SPEC,SPEC,..", required = true)]
    lists: Vec<OnMeshList>,
    #[command(flatten)]
    settings: SchemeSettings,
}

impl SchemesOnMesh {
    /// All that were given. Parameters are set in the files among them.
    ///
    /// # Errors
    /// Parameters, and no file.
    pub fn all(&self) -> Result<Vec<OnMesh>, Error> {
        let given = || self.lists.iter().flat_map(|list| &list.0);
        let has_file = given().any(|scheme| matches!(scheme.name, SchemeName::File(_)));
        let set = |scheme: &OnMesh| -> Result<OnMesh, Error> {
            if has_file && !matches!(scheme.name, SchemeName::File(_)) {
                return Ok(scheme.clone());
            }
            let name = self.settings.apply(scheme.name.clone())?;
            Ok(OnMesh {
                name,
                steps: scheme.steps,
            })
        };
        given().map(set).collect()
    }
}

/// Finds schemes for users: with their cache, and with notes and bars on the terminal.
pub fn tuner() -> Tuner<'static> {
    Tuner {
        cache: Cache::of_user(),
        progress: &Terminal,
    }
}

/// The constants of the objective.
#[derive(Args, Clone, Copy, Debug)]
pub struct ObjectiveArgs {
    /// Do not penalise sign changes of the Gauss curvature
    #[arg(long)]
    pub unweighted: bool,
    /// Width of the weight's transition, relative to the ideal Gauss curvature
    #[arg(long, default_value_t = 0.2, value_name = "X", value_parser = number, allow_negative_numbers = true, conflicts_with = "unweighted")]
    pub epsilon: f64,
    /// Square root of the largest weight
    #[arg(long, default_value_t = 5.0, value_name = "X", value_parser = number, allow_negative_numbers = true, conflicts_with = "unweighted")]
    pub weight: f64,
    /// Gauss points per patch and direction
    #[arg(long, default_value_t = 5, value_name = "COUNT", value_parser = count, allow_negative_numbers = true)]
    pub quadrature: usize,
    /// Ratio alpha/beta of the vertex stencil's total weights
    #[arg(long, default_value_t = 6.0, value_name = "X", value_parser = number, allow_negative_numbers = true)]
    pub phi: f64,
    /// Scale of the eigenvectors: unit norm over five rings, unit first edge neighbour, or none
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
    /// Each part divided by the mean square of its map's second derivatives.
    Relative,
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
                NormalisationArg::Relative => Normalisation::Relative,
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
}
