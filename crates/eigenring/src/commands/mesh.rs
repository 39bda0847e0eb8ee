//! `eigenring mesh`: what a mesh file holds, and two repairs.

use crate::error::Error;
use crate::files;
use crate::output::FormatOption;
use crate::progress::note;
use clap::Args;
use eigenring_atlas::meshes;
use eigenring_atlas::table::{Format, pretty};
use std::path::PathBuf;
use std::process::ExitCode;

/// Say what a mesh is: counts, genus, valences, features, and everything that keeps it from being a surface.
///
/// Numbers of vertices and faces count from 0. A mesh with defects is described as far as it can be, and the
/// exit code is 2.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring mesh spot.obj\n  eigenring mesh scan.ply --orient --split-non-manifold -o repaired.obj"
)]
pub struct Arguments {
    /// The mesh: .obj, .off or .ply
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Turn faces over until neighbours agree
    #[arg(long)]
    orient: bool,
    /// Double points until every edge has at most two faces and every vertex one fan
    #[arg(long)]
    split_non_manifold: bool,
    /// Write the mesh, repaired if asked for
    #[arg(short, long, value_name = "OUT")]
    out: Option<PathBuf>,
    #[command(flatten)]
    output: FormatOption,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let mut file = meshes::read(&self.file)?;
        for notice in &file.notices {
            note(notice);
        }
        if self.split_non_manifold {
            file.mesh = file.mesh.split_non_manifold();
        }
        if self.orient {
            let oriented = file.mesh.oriented().map_err(eigenring_atlas::Error::from);
            file.mesh = oriented.map_err(|error| error.in_file(&self.file))?;
        }
        let fields = meshes::facts(&file);
        let printed = match self.output.format() {
            Format::Json => pretty(&fields.json()),
            Format::Text => fields.text(),
            Format::Csv | Format::Latex => {
                return Err(Error::usage("a mesh is described in fields", "--format text or json"));
            }
        };
        if let Some(path) = &self.out {
            let format = meshes::written_format(path)?;
            let mut bytes = Vec::new();
            eigenring_surface::io::write(&file.mesh, &mut bytes, format)?;
            files::save(path, &bytes)?;
        }
        files::emit(None, printed.as_bytes())?;
        match file.surface() {
            Ok(_) => Ok(ExitCode::SUCCESS),
            Err(error) => Err(eigenring_atlas::Error::from(error).in_file(&self.file).into()),
        }
    }
}
