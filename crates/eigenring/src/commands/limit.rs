//! `eigenring limit`: exact points of a surface.

use super::subdivide::{IntervalArgs, SurfaceArgs};
use crate::args::{self, SchemeOnMesh};
use crate::error::Error;
use crate::memory;
use crate::output::Output;
use clap::{ArgGroup, Args};
use eigenring_atlas::limits;
use eigenring_atlas::nonuniform::limits as nonuniform;
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::table::Format;
use eigenring_nonuniform::{Scheme as NonUniform, Surface as HnussSurface};
use eigenring_surface::Surface;
use std::cell::RefCell;
use std::path::PathBuf;
use std::process::ExitCode;

/// Exact limit points with derivatives, normals and curvature, anywhere on a surface.
///
/// Parameters: on a quad s runs along the first edge and t towards the last vertex; other faces consist of
/// quads around their corners, of which sub is the number. On creases values are those of the face.
#[derive(Args, Debug)]
#[command(
    group = ArgGroup::new("places").required(true).args(["points", "vertices", "per_face"]),
    after_help = "Examples:\n  eigenring limit spot.obj --scheme catmull-clark --vertices\n  eigenring limit spot.obj --scheme catmull-clark --per-face 4 --derivatives 2 -o samples.csv"
)]
pub struct Arguments {
    /// The control mesh: .obj, .off or .ply
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    scheme: SchemeOnMesh,
    /// A CSV file with columns `face,sub,s,t[,corner]`
    #[arg(long, value_name = "P.csv")]
    points: Option<PathBuf>,
    /// At all control vertices: one row for each fan of faces between sharp edges
    #[arg(long)]
    vertices: bool,
    /// At the middles of n x n cells of each face
    #[arg(long, value_name = "n", value_parser = args::count, allow_negative_numbers = true)]
    per_face: Option<usize>,
    /// Derivatives up to this order: 0, 1 or 2
    #[arg(long, value_name = "ORDER", default_value = "0", value_parser = ["0", "1", "2"])]
    derivatives: String,
    #[command(flatten)]
    surface: SurfaceArgs,
    #[command(flatten)]
    intervals: IntervalArgs,
    /// Run although the result may not fit into memory
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        self.surface.start()?;
        let format = self.output.format()?;
        let scheme = self.scheme.scheme()?;
        if let SchemeName::NonUniform(scheme) = scheme.name {
            return self.with_intervals(scheme, format);
        }
        self.intervals.refuse()?;
        let mesh = self.surface.mesh(&self.file)?;
        let rules = self.surface.rules(&scheme, &mesh)?;
        let in_file = |error: eigenring_surface::Error| eigenring_atlas::Error::from(error).in_file(&self.file);
        let surface = Surface::new(&mesh, &rules).map_err(in_file)?;
        if self.vertices {
            let fans = surface.vertices().map_err(in_file)?;
            self.output
                .emit(&limits::vertex_table(&surface, &fans).render(format))?;
            return Ok(ExitCode::SUCCESS);
        }
        let places = match (&self.points, self.per_face) {
            (Some(path), _) => limits::read_places(path)?,
            (None, Some(n)) if n > 0 => {
                let count = mesh.face_count() as f64 * (n * n) as f64;
                // a place; in other formats than CSV its sample twice, and its row as text
                let each = if format == Format::Csv { 40.0 } else { 1700.0 };
                memory::check(count * each, self.force, &format!("{count} points"))?;
                surface.grid(n)
            }
            (None, n) => return Err(Error::range("per-face", n.unwrap_or(0), "1 and above")),
        };
        let derivatives = self.derivatives.parse().unwrap_or(0);
        if format == Format::Csv {
            let refused = RefCell::new(None);
            let rows = |out: &mut dyn std::io::Write| {
                limits::write_csv(&surface, &places, derivatives, out).map_err(|error| match error {
                    limits::CsvError::Write(error) => error,
                    limits::CsvError::Place(error) => {
                        let told = std::io::Error::other("a place is refused");
                        refused.replace(Some(error));
                        told
                    }
                })
            };
            let written = self.output.emit_by(&rows);
            refused.take().map_or(Ok(()), Err)?;
            written?;
        } else {
            let samples = limits::samples(&surface, &places)?;
            let table = limits::point_table(&places, &samples, derivatives);
            self.output.emit(&table.render(format))?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Points of an HNUSS surface.
    fn with_intervals(&self, scheme: NonUniform, format: Format) -> Result<ExitCode, Error> {
        let NonUniform::Hnuss(rule) = scheme else {
            return Err(Error::usage(
                format!(
                    "{scheme} is evaluated nowhere: its surface is no union of patches near extraordinary vertices"
                ),
                "--scheme hnuss[:simple|printed]; subdivide and spectrum with this one",
            ));
        };
        if self.derivatives == "2" {
            return Err(Error::usage(
                "second derivatives of HNUSS are not computed",
                "--derivatives 0 or 1",
            ));
        }
        self.surface.refuse_for_intervals()?;
        let mut mesh = self.surface.mesh_with_intervals(&self.file)?;
        self.intervals.read(&mut mesh)?;
        // the hybrid net is halved twice
        memory::check(mesh.corners().len() as f64 * 16.0 * 400.0, self.force, "the surface")?;
        let in_file = |error: eigenring_nonuniform::Error| eigenring_atlas::Error::from(error).in_file(&self.file);
        let surface = HnussSurface::new(&mesh, rule, self.intervals.outside()).map_err(in_file)?;
        self.intervals.tell(&surface.simple);
        if self.vertices {
            self.output
                .emit(&nonuniform::vertex_table(&surface, &mesh)?.render(format))?;
            return Ok(ExitCode::SUCCESS);
        }
        let places = match (&self.points, self.per_face) {
            (Some(path), _) => limits::read_places(path)?,
            (None, Some(n)) if n > 0 => {
                let count = mesh.face_count() as f64 * (n * n) as f64;
                memory::check(count * 1500.0, self.force, &format!("{count} points"))?;
                eigenring_surface::limit::grid(&mesh, n)
            }
            (None, n) => return Err(Error::range("per-face", n.unwrap_or(0), "1 and above")),
        };
        let found = nonuniform::samples(&surface, &mesh, &places)?;
        let derivatives = self.derivatives.parse().unwrap_or(0);
        self.output
            .emit(&nonuniform::point_table(&found, derivatives).render(format))?;
        Ok(ExitCode::SUCCESS)
    }
}
