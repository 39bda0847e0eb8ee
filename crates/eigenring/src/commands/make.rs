//! `eigenring make`: control meshes to begin with.

use crate::args;
use crate::error::Error;
use crate::files;
use clap::{Args, ValueEnum};
use eigenring_atlas::meshes;
use eigenring_surface::{Mesh, shapes};
use std::path::PathBuf;
use std::process::ExitCode;

/// Write a control mesh to begin with.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring make torus -o torus.obj\n  eigenring make star -n 7 --rings 3 -o star7.obj"
)]
pub struct Arguments {
    /// The shape
    #[arg(value_enum, value_name = "SHAPE")]
    shape: Shape,
    /// Sectors of a star or fan, blades of a propeller, teeth of a gear, quads around a torus
    #[arg(short = 'n', long = "count", value_name = "COUNT", value_parser = args::count, allow_negative_numbers = true)]
    count: Option<usize>,
    /// Rings of a star
    #[arg(long, value_name = "COUNT", default_value_t = 2, value_parser = args::count, allow_negative_numbers = true)]
    rings: usize,
    /// The file to write: .obj, .ply, .off, .vtk or .glb
    #[arg(short, long, value_name = "OUT")]
    out: PathBuf,
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
    /// A planar n-gon of quads.
    Fan,
    /// The unit square with inner vertices of valence 3, 3, 5, 5.
    Square3355,
}

/// More sectors make no better example.
const MOST: usize = 10_000;

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = meshes::written_format(&self.out)?;
        let mesh = self.mesh()?;
        let mut bytes = Vec::new();
        eigenring_surface::io::write(&mesh, &mut bytes, format)?;
        files::write(&self.out, &bytes)?;
        let line = format!(
            "wrote {}: {} vertices, {} faces\n",
            self.out.display(),
            mesh.points().len(),
            mesh.face_count()
        );
        files::emit(None, line.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }

    fn mesh(&self) -> Result<Mesh, Error> {
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
        match self.shape {
            Shape::Cube => without(shapes::cube()),
            Shape::Tetrahedron => without(shapes::tetrahedron()),
            Shape::Torus => Ok(shapes::torus(count(12, 3)?, 8)),
            Shape::Star if !(1..=100).contains(&self.rings) => Err(Error::range("rings", self.rings, "1 to 100")),
            Shape::Star => Ok(shapes::star(count(5, 3)?, self.rings)),
            Shape::Brick => without(shapes::brick([3, 2, 1])),
            Shape::TripleTorus => without(shapes::triple_torus()),
            Shape::Propeller => Ok(shapes::propeller(count(3, 3)?)),
            Shape::Gear => Ok(shapes::gear(count(8, 3)?)),
            Shape::Fan => Ok(shapes::fan(count(5, 3)?)),
            Shape::Square3355 => without(shapes::square3355()),
        }
    }
}
