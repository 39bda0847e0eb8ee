//! `eigenring render`: pictures of surfaces.

use super::subdivide::{IntervalArgs, SurfaceArgs};
use crate::args::{self, SchemesOnMesh};
use crate::error::Error;
use crate::files;
use clap::{Args, ValueEnum};
use eigenring_atlas::nonuniform::picture;
use eigenring_atlas::on_mesh::OnMesh;
use eigenring_atlas::render::{Settings, Show, Subject, render};
use eigenring_atlas::schemes::SchemeName;
use eigenring_surface::{Rules, Surface};
use std::path::PathBuf;
use std::process::ExitCode;

/// Draw surfaces as PNG, several schemes side by side.
///
/// Normals and curvatures are those of the limit surface at every sample. Colours of curvature mean the same
/// in all pictures of a row; values beyond the colours are black.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring render spot.obj --schemes catmull-clark,lambda:optimal --show highlight --up y -o lines.png\n  eigenring render torus.obj --schemes catmull-clark --show gauss -o gauss.png\n  eigenring render ring.obj --schemes nurss,hnuss --show reflection -o lines.png     knot intervals of the file"
)]
pub struct Arguments {
    /// The control mesh: .obj, .off or .ply
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    schemes: SchemesOnMesh,
    /// What is shown
    #[arg(long, value_enum, default_value = "shaded")]
    show: ShowArg,
    /// Azimuth and elevation of the eye in degrees, and the enlargement
    #[arg(long, value_name = "AZ,EL,ZOOM", default_value = "-60,28,1", value_parser = numbers, allow_hyphen_values = true)]
    view: Numbers,
    /// Azimuth and elevation of the light in degrees, from the eye
    #[arg(long, value_name = "AZ,EL", default_value = "-25,25", value_parser = numbers, allow_hyphen_values = true)]
    light: Numbers,
    /// The number of stripes over the size of the surface
    #[arg(long, value_name = "COUNT", default_value = "6", value_parser = args::number, allow_negative_numbers = true)]
    stripes: f64,
    /// Which coordinate points upwards
    #[arg(long, value_name = "AXIS", default_value = "z", value_parser = ["y", "z"])]
    up: String,
    /// Pixels of a picture's sides
    #[arg(long, value_name = "PIXELS", default_value_t = 480, value_parser = args::count, allow_negative_numbers = true)]
    size: usize,
    #[command(flatten)]
    surface: SurfaceArgs,
    #[command(flatten)]
    intervals: IntervalArgs,
    /// The file to write, which ends with .png
    #[arg(short, long, value_name = "OUT.png")]
    out: PathBuf,
}

#[derive(Clone, Debug)]
struct Numbers(Vec<f64>);

fn numbers(text: &str) -> Result<Numbers, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    match numbers {
        Ok(numbers) if numbers.iter().all(|x| x.is_finite()) => Ok(Numbers(numbers)),
        _ => Err("accepted are finite numbers with commas between them".to_owned()),
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ShowArg {
    Shaded,
    Wireframe,
    Gauss,
    Mean,
    Highlight,
    Reflection,
    Isophotes,
}

impl Arguments {
    fn settings(&self) -> Result<Settings, Error> {
        let show = match self.show {
            ShowArg::Shaded => Show::Shaded,
            ShowArg::Wireframe => Show::Wireframe,
            ShowArg::Gauss => Show::Gauss,
            ShowArg::Mean => Show::Mean,
            ShowArg::Highlight => Show::Highlight,
            ShowArg::Reflection => Show::Reflection,
            ShowArg::Isophotes => Show::Isophotes,
        };
        let view = match *self.view.0.as_slice() {
            [azimuth, elevation] => [azimuth, elevation, 1.0],
            [azimuth, elevation, zoom] if zoom > 0.0 => [azimuth, elevation, zoom],
            _ => {
                return Err(Error::usage(
                    "a view of other numbers",
                    "azimuth,elevation,zoom with a zoom above 0",
                ));
            }
        };
        let &[azimuth, elevation] = self.light.0.as_slice() else {
            return Err(Error::usage("a light of other numbers", "azimuth,elevation"));
        };
        if !(self.stripes > 0.0 && self.stripes <= 1000.0) {
            return Err(Error::range("stripes", self.stripes, "0 < stripes <= 1000"));
        }
        if !(32..=4096).contains(&self.size) {
            return Err(Error::range("size", self.size, "32 to 4096"));
        }
        if self.out.extension().is_none_or(|extension| extension != "png") {
            return Err(Error::usage("a picture is a PNG file", "-o FILE.png"));
        }
        Ok(Settings {
            show,
            view,
            light: [azimuth, elevation],
            stripes: self.stripes,
            y_up: self.up == "y",
            size: self.size,
            columns: 8,
        })
    }

    pub fn run(self) -> Result<ExitCode, Error> {
        self.surface.start()?;
        let settings = self.settings()?;
        let schemes = self.schemes.all()?;
        if schemes.len() > 8 {
            return Err(Error::range("number of schemes", schemes.len(), "1 to 8"));
        }
        let uneven = |scheme: &OnMesh| matches!(scheme.name, SchemeName::NonUniform(_));
        let with_intervals = schemes.iter().any(uneven);
        let mesh = if with_intervals {
            self.surface.refuse_for_intervals()?;
            let mut mesh = self.surface.mesh_with_intervals(&self.file)?;
            self.intervals.read(&mut mesh)?;
            mesh
        } else {
            self.intervals.refuse()?;
            self.surface.mesh(&self.file)?
        };
        // other schemes beside those with intervals know neither these nor weights
        let mut plain = mesh.clone();
        plain.features.knots.clear();
        let rules: Vec<Rules> = schemes
            .iter()
            .filter(|scheme| !uneven(scheme))
            .map(|scheme| self.surface.rules(scheme, &plain))
            .collect::<Result<_, _>>()?;
        let mut rules = rules.iter();
        let in_file = |error: eigenring_atlas::Error| error.in_file(&self.file);
        let mut surfaces = Vec::new();
        for scheme in &schemes {
            if let SchemeName::NonUniform(scheme) = scheme.name {
                let outside = self.intervals.outside();
                let found = picture::subject(&mesh, scheme, outside, settings.size, settings.show);
                let (subject, simple) = found.map_err(in_file)?;
                self.intervals.tell(&simple);
                surfaces.push((scheme.to_string(), subject));
            } else if let Some(rules) = rules.next() {
                let surface = Surface::new(&plain, rules).map_err(|error| in_file(error.into()))?;
                let name = scheme.called(&rules.definition().name());
                surfaces.push((name, Subject::Surface(Box::new(surface))));
            }
        }
        let page = render(&surfaces, &settings)?;
        files::save(&self.out, &page.png()?)?;
        Ok(ExitCode::SUCCESS)
    }
}
