//! `eigenring curvature`: extremes, integrals and irregular centres of a surface.

use super::subdivide::SurfaceArgs;
use crate::args::{self, SchemeOnMesh};
use crate::error::Error;
use crate::output::{Output, Wide};
use clap::Args;
use eigenring_atlas::curvature::{centre_table, curvatures, euler_of_smooth, summary};
use eigenring_atlas::table::{Format, WIDTH, pretty};
use eigenring_surface::Surface;
use std::path::PathBuf;
use std::process::ExitCode;

/// Curvature of a whole surface: extremes, means over the area, the total against Gauss and Bonnet, and what
/// happens at irregular vertices.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring curvature spot.obj --scheme catmull-clark\n  eigenring curvature cube.obj --scheme lambda:optimal --radii 1e-1..1e-6 --format json"
)]
pub struct Arguments {
    /// The control mesh: .obj, .off or .ply
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    scheme: SchemeOnMesh,
    /// Samples in each direction of a face, for the extremes
    #[arg(long, value_name = "n", default_value_t = 8, value_parser = args::count, allow_negative_numbers = true)]
    per_face: usize,
    /// Distances from irregular vertices, in parameters: powers of ten from the first to the last, or a list
    #[arg(long, value_name = "A..B", default_value = "1e-1,1e-3,1e-6,1e-9,1e-12")]
    radii: String,
    #[command(flatten)]
    surface: SurfaceArgs,
    #[command(flatten)]
    wide: Wide,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    fn radii(&self) -> Result<Vec<f64>, Error> {
        let refuse = || Error::range("radii", &self.radii, "0 < r <= 1, as 1e-1..1e-12 or 0.1,0.01");
        let number = |text: &str| {
            let radius = text.trim().parse::<f64>().ok().filter(|r| *r > 1e-290 && *r <= 1.0);
            radius.ok_or_else(refuse)
        };
        let Some((first, last)) = self.radii.split_once("..") else {
            return self.radii.split(',').map(number).collect();
        };
        let (first, last) = (
            number(first)?.log10().round() as i32,
            number(last)?.log10().round() as i32,
        );
        let steps: Vec<i32> = if first >= last {
            (last..=first).rev().collect()
        } else {
            (first..=last).collect()
        };
        Ok(steps.into_iter().map(|power| 10_f64.powi(power)).collect())
    }

    pub fn run(self) -> Result<ExitCode, Error> {
        self.surface.start()?;
        let format = self.output.format()?;
        let wide = self.wide.of(format)?;
        let radii = self.radii()?;
        if !(1..=1000).contains(&self.per_face) {
            return Err(Error::range("per-face", self.per_face, "1 to 1000"));
        }
        let mesh = self.surface.mesh(&self.file)?;
        let rules = self.surface.rules(&self.scheme.scheme()?, &mesh)?;
        let euler = euler_of_smooth(&mesh)?;
        let in_file = |error: eigenring_surface::Error| eigenring_atlas::Error::from(error).in_file(&self.file);
        let surface = Surface::new(&mesh, &rules).map_err(in_file)?;
        let found = curvatures(&surface, self.per_face, euler)?;
        let table = centre_table(&surface, &found, &radii)?;
        let fields = summary(&found);
        let text = match format {
            Format::Json => {
                let mut object = fields.json();
                object["centres"] = table.json();
                pretty(&object)
            }
            Format::Text if wide => format!("{}\n{}", fields.text(), table.render(Format::Text)),
            Format::Text => format!("{}\n{}", fields.text(), table.fitted(WIDTH)),
            format => table.render(format),
        };
        self.output.emit(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}
