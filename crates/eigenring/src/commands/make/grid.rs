//! `eigenring make revolve`, `sweep`, `tensor`: grids as meshes.

use crate::args;
use crate::error::Error;
use crate::progress::note;
use clap::Args;
use eigenring_atlas::curve::parse;
use eigenring_atlas::grids::{self, Kind, Named, Shown};
use eigenring_spline::curve::{Curve, Ends, Grid, MIN_ORDER};
use std::path::{Path, PathBuf};

/// What of the grid is written.
#[derive(Args, Debug)]
pub struct Output {
    /// Levels of refinement; 0 writes the control mesh
    #[arg(long, value_name = "COUNT", default_value_t = 0, value_parser = args::count, allow_negative_numbers = true, conflicts_with = "limit")]
    levels: usize,
    /// Write points of the limit, so many in each interval between knots
    #[arg(long, value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    limit: Option<usize>,
    /// The file to write: .obj, .ply, .off, .vtk or .glb
    #[arg(short, long, value_name = "OUT")]
    pub out: PathBuf,
}

impl Output {
    fn shown(&self) -> Shown {
        match self.limit {
            Some(samples) => Shown::Limit(samples),
            None => Shown::Levels(u32::try_from(self.levels).unwrap_or(u32::MAX)),
        }
    }

    /// The mesh, and what is said of it in comments.
    pub fn made(&self, title: &str, grid: &Grid) -> Result<(eigenring_surface::Mesh, Vec<String>), Error> {
        let shown = self.shown();
        Ok((grids::mesh(grid, shown)?, grids::remarks(title, grid, shown)))
    }
}

/// Turn a profile around the z axis.
///
/// PROFILE is a table of points, a line each: radius and height, or x, y, z. Or one of the names sphere,
/// torus-exact, cone, cylinder, hyperboloid, catenoid, ellipsoid-of-revolution, lissajous, cycloid,
/// fang-fig1, whose control points give the surface exactly: radius 1; radii 2 and 1; from the apex to radius
/// 1; radius 1; r^2 - z^2 = 1; r = cosh z; half axes 2, 2, 1; an inclined ellipse around radius 3; an arch
/// around its base; the curve of Fang, Ma and Wang's Fig. 1.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring make revolve sphere --levels 3 -o sphere.obj\n  eigenring make revolve torus-exact --order 4 --around-order 4 -o torus.obj\n  eigenring make revolve vase.csv --order 4 --segments 8 --levels 4 -o vase.ply"
)]
pub struct Revolve {
    /// A name, or a table of points
    #[arg(value_name = "NAME|PROFILE.csv")]
    profile: String,
    /// Order along the profile, 3 to 32; by default 4, or the surface's own
    #[arg(long, value_name = "K", value_parser = args::order::<MIN_ORDER>, allow_negative_numbers = true)]
    order: Option<usize>,
    /// Order around the axis, 3 to 32
    #[arg(long, value_name = "K", value_parser = args::order::<MIN_ORDER>, allow_negative_numbers = true)]
    around_order: Option<usize>,
    /// Control points around the axis; the tension cos(pi/n) makes circles of them
    #[arg(long, value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    segments: Option<usize>,
    /// Intervals along a named profile
    #[arg(long, value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    intervals: Option<usize>,
    /// Initial tension of a profile of your own, u0 > -1; by default 1
    #[arg(long, value_name = "U", value_parser = args::number, allow_negative_numbers = true)]
    u0: Option<f64>,
    /// Join the last point of a profile of your own to the first
    #[arg(long)]
    closed: bool,
    #[command(flatten)]
    pub output: Output,
}

/// Move a profile along a spine.
///
/// The points are S_j + a_j P_i: of a spine, of a profile, and with --scale of factors, one for each point of
/// the spine. Two coordinates lie in the xy plane. Or one name: helicoid, two turns of a straight line on a
/// screw, exact.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring make sweep helicoid --levels 3 -o helicoid.obj\n  eigenring make sweep profile.csv spine.csv --orders 4,5 --closed-profile --levels 3 -o pipe.obj"
)]
pub struct Sweep {
    /// A name, or a table of points
    #[arg(value_name = "NAME|PROFILE.csv")]
    profile: String,
    /// The spine, a table of points
    #[arg(value_name = "SPINE.csv")]
    spine: Option<PathBuf>,
    /// A table with one factor for each point of the spine
    #[arg(long, value_name = "FILE", requires = "spine")]
    scale: Option<PathBuf>,
    /// Orders along profile and spine; by default 4,4
    #[arg(long, value_name = "K,K", value_delimiter = ',', value_parser = args::order::<MIN_ORDER>, allow_negative_numbers = true)]
    orders: Vec<usize>,
    /// Initial tensions along profile and spine; by default 1,1
    #[arg(long, value_name = "U,U", value_delimiter = ',', value_parser = args::number, allow_negative_numbers = true, requires = "spine")]
    tensions: Vec<f64>,
    /// Join the ends of the profile
    #[arg(long, requires = "spine")]
    closed_profile: bool,
    /// Join the ends of the spine
    #[arg(long, requires = "spine")]
    closed_spine: bool,
    #[command(flatten)]
    pub output: Output,
}

/// A grid of control points, or of the name ellipsoid (half axes 3, 2 and 1, exact).
///
/// GRID is a table with the columns i, j, x, y, z: control point (i, j), each once.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring make tensor ellipsoid --levels 3 -o ellipsoid.obj\n  eigenring make tensor grid.csv --orders 4,6 --tensions 1,0.5 --levels 2 -o grid.obj"
)]
pub struct Tensor {
    /// A name, or a table
    #[arg(value_name = "NAME|GRID.csv")]
    grid: String,
    /// Orders along i and j; by default 4,4
    #[arg(long, value_name = "K,K", value_delimiter = ',', value_parser = args::order::<MIN_ORDER>, allow_negative_numbers = true)]
    orders: Vec<usize>,
    /// Initial tensions along i and j; by default 1,1
    #[arg(long, value_name = "U,U", value_delimiter = ',', value_parser = args::number, allow_negative_numbers = true)]
    tensions: Vec<f64>,
    /// Join the last points to the first along i
    #[arg(long)]
    closed_i: bool,
    /// Join the last points to the first along j
    #[arg(long)]
    closed_j: bool,
    #[command(flatten)]
    pub output: Output,
}

/// One number for both directions, or one for each.
fn both<T: Copy + std::fmt::Debug>(name: &'static str, given: &[T], usual: T) -> Result<[T; 2], Error> {
    match *given {
        [] => Ok([usual; 2]),
        [one] => Ok([one; 2]),
        [first, second] => Ok([first, second]),
        _ => Err(Error::range(name, format!("{given:?}"), "one number or two")),
    }
}

fn named(word: &str, kind: Kind) -> Option<Named> {
    let mut all = Named::ALL.into_iter().filter(|named| named.kind() == kind);
    all.find(|named| named.name() == word)
}

/// The bytes of a file that is no name.
fn bytes_of(word: &str, kind: Kind) -> Result<Vec<u8>, Error> {
    let path = Path::new(word);
    if !path.exists() && path.extension().is_none() && word != "-" {
        let names: Vec<&str> = Named::ALL
            .into_iter()
            .filter(|named| named.kind() == kind)
            .map(Named::name)
            .collect();
        return Err(Error::range("name", word, format!("{}, or a file", names.join(", "))));
    }
    Ok(eigenring_atlas::files::read_bytes(path)?)
}

fn points(path: &Path) -> Result<Vec<Vec<f64>>, Error> {
    let bytes = eigenring_atlas::files::read_bytes(path)?;
    parse(&bytes).map_err(|error| error.in_file(path).into())
}

fn curve(points: &[Vec<f64>], order: usize, u0: f64, closed: bool, path: &Path) -> Result<Curve, Error> {
    let ends = if closed { Ends::Closed } else { Ends::Open };
    let curve = Curve::new(order, u0, ends, points);
    curve.map_err(|error| eigenring_atlas::Error::from(error).in_file(path).into())
}

impl Revolve {
    pub fn grid(&self) -> Result<(String, Grid), Error> {
        if let Some(named) = named(&self.profile, Kind::Revolution) {
            if self.u0.is_some() || self.closed {
                return Err(Error::usage(
                    "a named surface has its own tension and ends",
                    "--u0 and --closed with a profile of your own",
                ));
            }
            let product = named.grid([self.order, self.around_order], self.segments, self.intervals)?;
            return Ok((format!("eigenring make revolve {}", named.name()), product.grid));
        }
        if self.intervals.is_some() {
            return Err(Error::usage(
                "a profile of your own has its points",
                "--intervals with a name",
            ));
        }
        let bytes = bytes_of(&self.profile, Kind::Revolution)?;
        let path = Path::new(&self.profile);
        let points = parse(&bytes).map_err(|error| error.in_file(path))?;
        let profile = curve(
            &points,
            self.order.unwrap_or(4),
            self.u0.unwrap_or(1.0),
            self.closed,
            path,
        )?;
        if grids::meets_axis(&profile) {
            note("the profile meets the axis: there the surface closes in a point, or folds");
        }
        let grid = grids::revolved(&profile, self.around_order.unwrap_or(3), self.segments.unwrap_or(6));
        let grid = grid.map_err(|error| error.in_file(path))?;
        Ok((format!("eigenring make revolve {}", self.profile), grid))
    }
}

impl Sweep {
    pub fn grid(&self) -> Result<(String, Grid), Error> {
        if let (Some(named), None) = (named(&self.profile, Kind::Sweep), &self.spine) {
            let orders = match *self.orders {
                [] => [None; 2],
                _ => both("orders", &self.orders, 4)?.map(Some),
            };
            let product = named.grid(orders, None, None)?;
            return Ok((format!("eigenring make sweep {}", named.name()), product.grid));
        }
        let Some(spine_path) = &self.spine else {
            bytes_of(&self.profile, Kind::Sweep)?;
            return Err(Error::usage(
                "a profile without a spine",
                "two files, or the name helicoid",
            ));
        };
        let orders = both("orders", &self.orders, 4)?;
        let tensions = both("tensions", &self.tensions, 1.0)?;
        let path = Path::new(&self.profile);
        let profile = curve(&points(path)?, orders[0], tensions[0], self.closed_profile, path)?;
        let spine = curve(
            &points(spine_path)?,
            orders[1],
            tensions[1],
            self.closed_spine,
            spine_path,
        )?;
        let scale = match &self.scale {
            None => None,
            Some(file) => Some(points(file)?.into_iter().flatten().collect::<Vec<f64>>()),
        };
        let grid = grids::swept(&profile, &spine, scale.as_deref())?;
        Ok((format!("eigenring make sweep {}", self.profile), grid))
    }
}

impl Tensor {
    pub fn grid(&self) -> Result<(String, Grid), Error> {
        if let Some(named) = named(&self.grid, Kind::Tensor) {
            if !self.tensions.is_empty() || self.closed_i || self.closed_j {
                return Err(Error::usage(
                    "a named surface has its own tensions and ends",
                    "--tensions, --closed-i and --closed-j with a grid of your own",
                ));
            }
            let orders = match *self.orders {
                [] => [None; 2],
                _ => both("orders", &self.orders, 4)?.map(Some),
            };
            let product = named.grid(orders, None, None)?;
            return Ok((format!("eigenring make tensor {}", named.name()), product.grid));
        }
        let bytes = bytes_of(&self.grid, Kind::Tensor)?;
        let orders = both("orders", &self.orders, 4)?;
        let tensions = both("tensions", &self.tensions, 1.0)?;
        let grid = grids::tensor(&bytes, orders, tensions, [self.closed_i, self.closed_j]);
        let grid = grid.map_err(|error| error.in_file(Path::new(&self.grid)))?;
        Ok((format!("eigenring make tensor {}", self.grid), grid))
    }
}
