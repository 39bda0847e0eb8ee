//! `eigenring subdivide`: a mesh refined by a scheme.

use crate::args::{self, OneScheme};
use crate::error::Error;
use crate::files;
use crate::memory;
use crate::output::FormatOption;
use crate::progress::note;
use crate::threads::Threads;
use clap::{Args, ValueEnum};
use eigenring_atlas::meshes::{self, Pool};
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::table::{Format, pretty};
use eigenring_surface::{Boundary, Mesh, Refiner};
use std::path::PathBuf;
use std::process::ExitCode;

/// Refine a mesh by any scheme.
///
/// Vertices keep their numbers under schemes around vertices. Creases, corners and the boundary follow
/// OpenSubdiv's tag lines in OBJ files.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring subdivide spot.obj --scheme catmull-clark --levels 3 -o fine.obj\n  eigenring subdivide open.obj --scheme doo-sabin --boundary shrink --format json"
)]
pub struct Arguments {
    /// The control mesh: .obj, .off or .ply
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    scheme: OneScheme,
    /// Levels of refinement
    #[arg(long, value_name = "COUNT", default_value_t = 1, value_parser = args::count, allow_negative_numbers = true)]
    levels: usize,
    /// The file to write: .obj, .ply, .off, .vtk or .glb
    #[arg(short, long, value_name = "OUT")]
    out: Option<PathBuf>,
    #[command(flatten)]
    surface: SurfaceArgs,
    /// Run although the result may not fit into memory
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    output: FormatOption,
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
    pub fn rules(&self, scheme: &SchemeName, mesh: &Mesh) -> Result<eigenring_surface::Rules, Error> {
        let lambdas = match &self.lambda_map {
            Some(path) => meshes::read_lambdas(path)?,
            None => Vec::new(),
        };
        Ok(meshes::rules(scheme, mesh, &lambdas, &args::tuner())?)
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
        let mesh = self.surface.mesh(&self.file)?;
        let rules = self.surface.rules(&self.scheme.name()?, &mesh)?;
        let mut refiner = Refiner::new(&rules);
        refiner.workers = &Pool;
        let (points, faces) = refiner.size(&mesh, self.levels);
        // points of two levels, corners and starts of faces; a file is assembled in memory
        let text = if format.is_some() { 1.5 } else { 0.0 };
        let bytes = (30.0 * points + 20.0 * faces) * (1.0 + text);
        memory::check(bytes, self.force, &format!("{} levels", self.levels))?;
        let refined = refiner
            .refined(&mesh, self.levels)
            .map_err(|error| eigenring_atlas::Error::from(error).in_file(&self.file))?;
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
}
