//! Surfaces as results: pictures of the papers' kinds, and tables of what they show.
//!
//! The papers' meshes are not all published; shapes of `eigenring make` with the same features take their
//! place. Within a picture camera, scale and colours are the same.

mod lambda;
mod nonuniform;
mod tension;

use crate::error::Error;
use crate::on_mesh::OnMesh;
use crate::render::{Settings, Show, Subject, render};
use crate::schemes::Tuner;
use crate::table::{Format, Table};
use eigenring_surface::{Mesh, Rules, Surface};

/// Which results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gallery {
    /// Of the lambda-scheme (Ma, Wang and Ma 2023, Figs. 8, 9, 11, 14, 15).
    Lambda,
    /// Of the tension scheme (Fang, Ma and Wang, Figs. 1, 2, 4, 6, 8, 9).
    Tension,
    /// Of schemes with knot intervals (Li, Wei and Zhang 2019, Figs. 12 to 14).
    NonUniform,
}

impl Gallery {
    /// The folder of its files.
    pub fn folder(self) -> &'static str {
        match self {
            Gallery::Lambda => "surfaces",
            Gallery::Tension => "tension-surfaces",
            Gallery::NonUniform => "nonuniform",
        }
    }

    /// Its files: name and content.
    ///
    /// # Errors
    /// Those of the surfaces and of tuning.
    pub fn files(self, tuner: &Tuner<'_>) -> Result<Vec<(String, Vec<u8>)>, Error> {
        match self {
            Gallery::Lambda => lambda::files(tuner),
            Gallery::Tension => tension::files(tuner),
            Gallery::NonUniform => nonuniform::files(tuner.progress),
        }
    }
}

/// A surface to be drawn: its caption, scheme and control mesh.
struct Item {
    caption: String,
    scheme: OnMesh,
    mesh: Mesh,
    /// Vertices with a lambda of their own.
    lambdas: Vec<(u32, f64)>,
}

impl Item {
    fn new(caption: impl Into<String>, scheme: &str, mesh: &Mesh) -> Result<Self, Error> {
        Ok(Item {
            caption: caption.into(),
            scheme: scheme.parse()?,
            mesh: mesh.clone(),
            lambdas: Vec::new(),
        })
    }

    fn rules(&self, tuner: &Tuner<'_>) -> Result<Rules, Error> {
        crate::meshes::rules(&self.scheme, &self.mesh, &self.lambdas, tuner)
    }
}

/// How a picture is taken: what is shown, the view, how wide it is and how many stand in a row.
fn settings(show: Show, view: [f64; 3], size: usize, columns: usize) -> Settings {
    Settings {
        show,
        view,
        light: [-25.0, 25.0],
        stripes: 6.0,
        y_up: false,
        size,
        columns,
    }
}

/// A picture of limit surfaces.
fn picture(name: &str, items: &[Item], settings: &Settings, tuner: &Tuner<'_>) -> Result<(String, Vec<u8>), Error> {
    let rules: Vec<Rules> = items.iter().map(|item| item.rules(tuner)).collect::<Result<_, _>>()?;
    let surfaces = items.iter().zip(&rules).map(|(item, rules)| {
        let surface = Surface::new(&item.mesh, rules)?;
        Ok((item.caption.clone(), Subject::Surface(Box::new(surface))))
    });
    drawn(name, &surfaces.collect::<Result<Vec<_>, Error>>()?, settings)
}

fn drawn(name: &str, subjects: &[(String, Subject<'_>)], settings: &Settings) -> Result<(String, Vec<u8>), Error> {
    Ok((format!("{name}.png"), render(subjects, settings)?.png()?))
}

fn table(name: &str, table: &Table) -> (String, Vec<u8>) {
    (format!("{name}.csv"), table.render(Format::Csv).into_bytes())
}
