//! `eigenring subdivide`: a mesh refined by a scheme.

use crate::args::{self, SchemeOnMesh};
use crate::error::Error;
use crate::files;
use crate::memory;
use crate::output::FormatOption;
use crate::progress::note;
use crate::threads::Threads;
use clap::{Args, ValueEnum};
use eigenring_atlas::meshes::{self, Pool};
use eigenring_atlas::on_mesh::OnMesh;
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::table::{Format, pretty};
use eigenring_nonuniform::{Outside, Place, Scheme as NonUniform};
use eigenring_surface::{Boundary, Mesh, Refiner};
use std::path::PathBuf;
use std::process::ExitCode;

/// Refine a mesh by any scheme.
///
/// Vertices keep their numbers under schemes around vertices. Creases, corners and the boundary follow
/// OpenSubdiv's tag lines in OBJ files.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring subdivide spot.obj --scheme catmull-clark --levels 3 -o fine.obj\n  eigenring subdivide open.obj --scheme doo-sabin --boundary shrink --format json\n  eigenring subdivide net.obj --scheme hnuss --knots net.csv --levels 2 -o fine.obj     knot intervals; level 0 is the hybrid net"
)]
pub struct Arguments {
    /// The control mesh: .obj, .off or .ply
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    scheme: SchemeOnMesh,
    /// Levels of refinement
    #[arg(long, value_name = "COUNT", default_value_t = 1, value_parser = args::count, allow_negative_numbers = true)]
    levels: usize,
    /// The file to write: .obj, .ply, .off, .vtk or .glb
    #[arg(short, long, value_name = "OUT")]
    out: Option<PathBuf>,
    #[command(flatten)]
    surface: SurfaceArgs,
    #[command(flatten)]
    intervals: IntervalArgs,
    /// Run although the result may not fit into memory
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    output: FormatOption,
}

/// Options of schemes with knot intervals.
#[derive(Args, Debug)]
pub struct IntervalArgs {
    /// Knot intervals of edges, a CSV file of two vertices and a value, beside those that the mesh has in its
    /// tags 't knot'; for nurss, eigen-polyhedron and hnuss
    #[arg(long, value_name = "CSV")]
    knots: Option<PathBuf>,
    /// What hnuss does at vertices for whose knot intervals there is no eigen-polyhedron
    #[arg(long, value_enum)]
    outside: Option<OutsideArg>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum OutsideArg {
    /// The mesh is refused.
    Error,
    /// These vertices have the simple rule.
    Simple,
}

impl IntervalArgs {
    /// Adds the intervals of the file to those of the mesh.
    pub fn read(&self, mesh: &mut Mesh) -> Result<(), Error> {
        match &self.knots {
            Some(path) => Ok(meshes::read_intervals(path, mesh)?),
            None => Ok(()),
        }
    }

    /// What is done without an eigen-polyhedron.
    pub fn outside(&self) -> Outside {
        match self.outside {
            Some(OutsideArg::Simple) => Outside::Simple,
            _ => Outside::Error,
        }
    }

    /// Says where the simple rule was taken for want of an eigen-polyhedron.
    pub fn tell(&self, simple: &[Place]) {
        if !simple.is_empty() {
            let list: Vec<String> = simple.iter().map(Place::to_string).collect();
            note(&format!(
                "the simple rule was taken for want of an eigen-polyhedron at {}",
                list.join(", ")
            ));
        }
    }

    /// Refuses these options for a scheme that takes none of them.
    pub fn refuse(&self) -> Result<(), Error> {
        let given = [("--knots", self.knots.is_some()), ("--outside", self.outside.is_some())];
        match given.iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Error::usage(
                format!("{option} has no meaning for this scheme"),
                "--scheme nurss, eigen-polyhedron or hnuss with it",
            )),
            None => Ok(()),
        }
    }
}

/// How a control mesh is read: options of all commands about surfaces.
#[derive(Args, Debug)]
pub struct SurfaceArgs {
    /// The boundary: a crease, a crease with corners at vertices of one face, or no rule at all; by default
    /// what the file says, else edge
    #[arg(long, value_enum)]
    boundary: Option<BoundaryArg>,
    /// Precision in which sharpness is stored; OpenSubdiv has 32
    #[arg(long, value_name = "BITS", default_value = "64", value_parser = ["64", "32"])]
    sharpness_bits: String,
    /// A CSV file of vertices and their lambda, for the lambda-scheme
    #[arg(long, value_name = "CSV")]
    lambda_map: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BoundaryArg {
    Edge,
    Corner,
    Shrink,
}

impl SurfaceArgs {
    /// What happens at the boundary, if it is said.
    pub fn boundary(&self) -> Option<Boundary> {
        self.boundary.map(|boundary| match boundary {
            BoundaryArg::Edge => Boundary::Edge,
            BoundaryArg::Corner => Boundary::Corner,
            BoundaryArg::Shrink => Boundary::Shrink,
        })
    }

    /// The control mesh of a file with its knot intervals, for schemes that say themselves what is wrong with
    /// these, and weights.
    pub fn mesh_with_intervals(&self, path: &std::path::Path) -> Result<Mesh, Error> {
        let (mesh, notices) = meshes::read_with_intervals(path)?;
        notices.iter().for_each(|notice| note(notice));
        Ok(mesh)
    }

    /// The control mesh of a file; remarks go to standard error.
    pub fn mesh(&self, path: &std::path::Path) -> Result<Mesh, Error> {
        let (mut mesh, notices) = meshes::read_surface(path)?;
        for notice in &notices {
            note(notice);
        }
        if self.sharpness_bits == "32" {
            mesh.features = mesh.features.in_single_precision();
        }
        if let Some(boundary) = self.boundary() {
            mesh.features.boundary = Some(boundary);
        }
        Ok(mesh)
    }

    /// The rules of a scheme on the mesh.
    pub fn rules(&self, scheme: &OnMesh, mesh: &Mesh) -> Result<eigenring_surface::Rules, Error> {
        let lambdas = match &self.lambda_map {
            Some(path) => meshes::read_lambdas(path)?,
            None => Vec::new(),
        };
        Ok(meshes::rules(scheme, mesh, &lambdas, &args::tuner())?)
    }

    /// Refuses what schemes with knot intervals do not take: their boundary is that of B-splines.
    pub fn refuse_for_intervals(&self) -> Result<(), Error> {
        let given = [
            ("--boundary", self.boundary.is_some()),
            ("--sharpness-bits 32", self.sharpness_bits == "32"),
            ("--lambda-map", self.lambda_map.is_some()),
        ];
        match given.iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Error::usage(
                format!("{option} has no meaning with knot intervals"),
                "the mesh with its tags 't knot' alone; its boundary curves are cubic B-splines",
            )),
            None => Ok(()),
        }
    }

    /// Starts the threads that were asked for.
    pub fn start(&self) -> Result<(), Error> {
        self.threads.start()
    }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        self.surface.start()?;
        let format = self.out.as_deref().map(meshes::written_format).transpose()?;
        let output = self.output.format();
        if matches!(output, Format::Csv | Format::Latex) {
            return Err(Error::usage(
                "a refined mesh is described in fields",
                "--format text or json",
            ));
        }
        let scheme = self.scheme.scheme()?;
        let refined = match scheme.name {
            SchemeName::NonUniform(scheme) => self.with_intervals(scheme, format.is_some())?,
            _ => self.uniform(&scheme, format.is_some())?,
        };
        if let (Some(path), Some(format)) = (&self.out, format) {
            let mut bytes = Vec::new();
            eigenring_surface::io::write(&refined, &mut bytes, format)?;
            files::write(path, &bytes)?;
        }
        let fields = meshes::summary(&refined, self.levels);
        let mut printed = match output {
            Format::Json => pretty(&fields.json()),
            _ => fields.text(),
        };
        if let (Some(path), Format::Text) = (&self.out, output) {
            printed.push_str(&format!("wrote {}\n", path.display()));
        }
        files::emit(None, printed.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }

    /// Refuses a result of so many points and faces that does not fit into memory.
    fn check(&self, points: f64, faces: f64, per_point: f64, is_written: bool) -> Result<(), Error> {
        // a file is assembled in memory
        let text = if is_written { 1.5 } else { 0.0 };
        let bytes = (per_point * points + 20.0 * faces) * (1.0 + text);
        memory::check(bytes, self.force, &format!("{} levels", self.levels))
    }

    fn with_intervals(&self, scheme: NonUniform, is_written: bool) -> Result<Mesh, Error> {
        self.surface.refuse_for_intervals()?;
        let mut mesh = self.surface.mesh_with_intervals(&self.file)?;
        self.intervals.read(&mut mesh)?;
        if !matches!(scheme, NonUniform::Hnuss(_)) && self.intervals.outside.is_some() {
            return Err(Error::usage(
                format!("--outside has no meaning for {scheme}"),
                "--scheme hnuss or hnuss:printed with it",
            ));
        }
        // rows of the last level, its half-edges and intervals
        let faces = mesh.corners().len() as f64 * 4_f64.powi(self.levels as i32);
        self.check(faces, faces, 600.0, is_written)?;
        let found = eigenring_nonuniform::refined(&mesh, scheme, self.levels, self.intervals.outside());
        let found = found.map_err(|error| eigenring_atlas::Error::from(error).in_file(&self.file))?;
        self.intervals.tell(&found.simple);
        Ok(found.mesh)
    }

    fn uniform(&self, scheme: &OnMesh, is_written: bool) -> Result<Mesh, Error> {
        self.intervals.refuse()?;
        let mesh = self.surface.mesh(&self.file)?;
        let rules = self.surface.rules(scheme, &mesh)?;
        let mut refiner = Refiner::new(&rules);
        refiner.workers = &Pool;
        let (points, faces) = refiner.size(&mesh, self.levels);
        // points of two levels, corners and starts of faces
        self.check(points, faces, 30.0, is_written)?;
        let refined = refiner.refined(&mesh, self.levels);
        Ok(refined.map_err(|error| eigenring_atlas::Error::from(error).in_file(&self.file))?)
    }
}
