//! Eigenvalues of the Laplacian on the levels of a mesh.

use super::{Basis, ends_name, prepared, refused};
use crate::error::Error;
use crate::progress::Progress;
use crate::table::Table;
use eigenring_iga::{Domain, Membrane, Options, Spectrum};
use eigenring_surface::Mesh;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The lowest eigenvalues of the Laplacian on the levels of a mesh.
#[derive(Clone, Debug)]
pub struct Membranes {
    /// What the mesh is the control mesh of.
    pub domain: Domain,
    /// Its boundary.
    pub membrane: Membrane,
    /// How many eigenvalues.
    pub count: usize,
    /// How many levels, from 1.
    pub levels: usize,
    /// Quadrature and the space beyond the boundary.
    pub options: Options,
}

/// What was found, level by level.
#[derive(Clone, Debug)]
pub struct Spectra {
    request: Membranes,
    path: PathBuf,
    scheme: String,
    spectra: Vec<Spectrum>,
}

/// Finds eigenvalues on the levels of a mesh; the arguments are those of [`study`](super::study).
///
/// # Errors
/// As [`study`](super::study).
pub fn spectra<E: From<Error>>(
    request: &Membranes,
    path: &Path,
    mesh: &Mesh,
    basis: &Basis,
    fits: impl Fn(f64) -> Result<(), E>,
    progress: &dyn Progress,
) -> Result<Spectra, E> {
    let study = prepared(path, mesh, basis, request.domain, request.levels, progress)?;
    fits(study.bytes(request.levels - 1, &request.options, Some(request.count)))?;
    let level = |level: usize| study.spectrum(level, request.membrane, request.count, &request.options);
    let spectra = (0..request.levels).map(level).collect::<Result<_, _>>();
    Ok(Spectra {
        request: request.clone(),
        path: path.to_owned(),
        scheme: basis.name(),
        spectra: spectra.map_err(|error| refused(error, path))?,
    })
}

impl Spectra {
    /// The eigenvalues, a column for each level.
    pub fn table(&self) -> Table {
        let levels = (0..self.spectra.len()).map(|level| format!("level {level}"));
        let mut table = Table::new(std::iter::once("eigenvalue".to_owned()).chain(levels));
        for index in 0..self.spectra.last().map_or(0, |last| last.eigenvalues.len()) {
            let of = |spectrum: &Spectrum| spectrum.eigenvalues.get(index).copied();
            let mut row = vec![index.into()];
            row.extend(self.spectra.iter().map(|spectrum| of(spectrum).into()));
            table.push(row);
        }
        table
    }

    /// Everything.
    pub fn json(&self) -> Value {
        let level = |(number, spectrum): (usize, &Spectrum)| {
            json!({
                "level": number,
                "h": 0.5_f64.powi(number as i32),
                "faces": spectrum.faces,
                "dof": spectrum.dof,
                "area": spectrum.area,
                "eigenvalues": spectrum.eigenvalues,
            })
        };
        json!({
            "mesh": self.path.display().to_string(),
            "scheme": self.scheme,
            "bc": match (self.request.domain, self.request.membrane) {
                (Domain::Planar, Membrane::Free) => "neumann",
                (Domain::Planar, Membrane::Held) => "dirichlet",
                _ => "closed",
            },
            "sphere": self.request.domain == Domain::Sphere,
            "boundary": ends_name(self.request.options.ends),
            "gauss": self.request.options.gauss,
            "levels": self.spectra.iter().enumerate().map(level).collect::<Vec<_>>(),
        })
    }
}
