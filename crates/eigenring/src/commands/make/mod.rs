//! `eigenring make`: control meshes to begin with.

mod grid;

use crate::args;
use crate::error::Error;
use crate::files;
use clap::{Args, Subcommand, ValueEnum};
use eigenring_atlas::meshes;
use eigenring_surface::io::Format;
use eigenring_surface::shapes::StarKind;
use eigenring_surface::{Mesh, shapes};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Write a control mesh to begin with.
///
/// Shapes have a file to themselves; revolve, sweep and tensor make meshes of curves and grids, exact
/// spheres, tori, cones and others among them.
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "Examples:\n  eigenring make torus -o torus.obj\n  eigenring make star -n 7 --kind saddle --noise 0.1 --seed 3 -o star7.obj\n  eigenring make fan -n 6 --split 3 --warp 0.08 -o fan6.obj\n  eigenring make revolve sphere --levels 3 -o sphere.obj"
)]
pub struct Arguments {
    #[command(subcommand)]
    grid: Option<GridCommand>,
    /// The shape
    #[arg(value_enum, value_name = "SHAPE", required = true)]
    shape: Option<Shape>,
    /// Sectors of a star or fan, blades of a propeller, teeth of a gear, quads around a torus
    #[arg(short = 'n', short_alias = 'N', long = "count", value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    count: Option<usize>,
    /// Rings of a star; by default 2
    #[arg(long, value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    rings: Option<usize>,
    /// How a star is curved; by default convex
    #[arg(long, value_enum, value_name = "KIND")]
    kind: Option<KindArg>,
    /// Parts in each direction that a quad of fan or square3355 is split into; by default 2 and 4
    #[arg(long, value_name = "PARTS", value_parser = args::count, allow_negative_numbers = true)]
    split: Option<usize>,
    /// Move each vertex of fan or square3355 by so much times (sin(2y+1), sin(3x-1/2))
    #[arg(long, value_name = "SIZE", value_parser = args::finite, allow_negative_numbers = true)]
    warp: Option<f64>,
    /// Move each coordinate at random, by at most so much
    #[arg(long, value_name = "SIZE", value_parser = args::finite, allow_negative_numbers = true)]
    noise: Option<f64>,
    /// The same seed gives the same noise
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// The file to write: .obj, .ply, .off, .vtk or .glb
    #[arg(short, long, value_name = "OUT", required = true)]
    out: Option<PathBuf>,
}

#[derive(Subcommand, Debug)]
enum GridCommand {
    Revolve(grid::Revolve),
    Sweep(grid::Sweep),
    Tensor(grid::Tensor),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum KindArg {
    /// Like a bowl.
    Convex,
    /// Like a saddle.
    Saddle,
    /// In a plane.
    Flat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Shape {
    /// Six quads.
    Cube,
    /// Four triangles.
    Tetrahedron,
    /// A regular grid, closed in both directions.
    Torus,
    /// A disc around one vertex of valence n.
    Star,
    /// A box of unit cubes, 3 x 2 x 1.
    Brick,
    /// A plate with three holes.
    TripleTorus,
    /// A hub with n blades.
    Propeller,
    /// A wheel with n teeth and a hole.
    Gear,
    /// A torus with a stone, with knot intervals.
    Ring,
    /// A dome with a crest, with knot intervals.
    Helmet,
    /// A planar n-gon of quads.
    Fan,
    /// The unit square with inner vertices of valence 3, 3, 5, 5.
    Square3355,
}

/// More sectors make no better example.
const MOST: usize = 10_000;
/// More are a matter of refinement.
const MOST_QUADS: usize = 1_000_000;

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let (made, out) = match &self.grid {
            Some(GridCommand::Revolve(revolve)) => (revolve.grid()?, &revolve.output),
            Some(GridCommand::Sweep(sweep)) => (sweep.grid()?, &sweep.output),
            Some(GridCommand::Tensor(tensor)) => (tensor.grid()?, &tensor.output),
            None => {
                let (Some(shape), Some(out)) = (self.shape, &self.out) else {
                    return Err(Error::usage("no shape", "a shape and -o OUT"));
                };
                meshes::written_format(out)?;
                let mut mesh = self.mesh(shape)?;
                if let Some(size) = self.warp {
                    mesh = shapes::warped(mesh, size);
                }
                if let Some(size) = self.noise {
                    mesh = shapes::disturbed(mesh, size, self.seed);
                }
                return write(&mesh, &[], out);
            }
        };
        meshes::written_format(&out.out)?;
        let (title, grid) = made;
        let (mesh, remarks) = out.made(&title, &grid)?;
        write(&mesh, &remarks, &out.out)
    }

    fn mesh(&self, shape: Shape) -> Result<Mesh, Error> {
        let count = |default: usize, least: usize| -> Result<usize, Error> {
            let count = self.count.unwrap_or(default);
            if (least..=MOST).contains(&count) {
                Ok(count)
            } else {
                Err(Error::range("count", count, format!("{least} to {MOST}")))
            }
        };
        let without = |mesh: Mesh| match self.count {
            None => Ok(mesh),
            Some(_) => Err(Error::usage("this shape has no count", "no -n with it")),
        };
        let rings = self.rings.unwrap_or(2);
        if shape != Shape::Star && (self.rings.is_some() || self.kind.is_some()) {
            return Err(Error::usage(
                "this shape has neither rings nor kinds",
                "--rings and --kind with star",
            ));
        }
        let is_planar = matches!(shape, Shape::Fan | Shape::Square3355);
        if !is_planar && (self.split.is_some() || self.warp.is_some()) {
            return Err(Error::usage(
                "this shape is neither split nor warped",
                "--split and --warp with fan and square3355",
            ));
        }
        let parts = |default: usize, quads: usize| {
            let most = (MOST_QUADS / quads).isqrt();
            match self.split.unwrap_or(default) {
                parts if (1..=most).contains(&parts) => Ok(parts),
                parts => Err(Error::range("split", parts, format!("1 to {most}"))),
            }
        };
        match shape {
            Shape::Cube => without(shapes::cube()),
            Shape::Tetrahedron => without(shapes::tetrahedron()),
            Shape::Torus => Ok(shapes::torus(count(12, 3)?, 8)),
            Shape::Star if !(1..=100).contains(&rings) => Err(Error::range("rings", rings, "1 to 100")),
            Shape::Star => {
                let kind = match self.kind {
                    None | Some(KindArg::Convex) => StarKind::Convex,
                    Some(KindArg::Saddle) => StarKind::Saddle,
                    Some(KindArg::Flat) => StarKind::Flat,
                };
                Ok(shapes::star(count(5, 3)?, rings, kind))
            }
            Shape::Brick => without(shapes::brick([3, 2, 1])),
            Shape::TripleTorus => without(shapes::triple_torus()),
            Shape::Propeller => Ok(shapes::propeller(count(3, 3)?)),
            Shape::Gear => Ok(shapes::gear(count(8, 3)?)),
            Shape::Fan => count(5, 3).and_then(|n| Ok(shapes::split_fan(n, parts(2, n)?))),
            Shape::Ring => without(shapes::ring()),
            Shape::Helmet => without(shapes::helmet()),
            Shape::Square3355 => without(shapes::split_square3355(parts(4, 12)?)),
        }
    }
}

/// Writes a mesh, in OBJ with remarks before it, and says what was written.
fn write(mesh: &Mesh, remarks: &[String], out: &Path) -> Result<ExitCode, Error> {
    let format = meshes::written_format(out)?;
    let mut bytes = Vec::new();
    if format == Format::Obj {
        for remark in remarks {
            bytes.extend_from_slice(format!("# {remark}\n").as_bytes());
        }
    }
    eigenring_surface::io::write(mesh, &mut bytes, format)?;
    files::write(out, &bytes)?;
    let (vertices, faces) = (mesh.points().len(), mesh.face_count());
    let line = format!("wrote {}: {vertices} vertices, {faces} faces\n", out.display());
    files::emit(None, line.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}
