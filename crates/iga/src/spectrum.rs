//! Eigenvalues of the Laplacian: membranes in the plane, Laplace and Beltrami's operator on closed surfaces.

use crate::Error;
use crate::assembly::assemble;
use crate::eigen::lowest;
use crate::integrals::Form;
use crate::problem::{Options, coefficients, fixed, tables, used};
use crate::space::Space;
use crate::sparse::Numbering;

/// The boundary of a membrane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Membrane {
    /// Free, or a closed surface.
    Free,
    /// Held at zero.
    Held,
}

/// The lowest eigenvalues of `(grad u, grad v) = theta (u, v)`.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Faces.
    pub faces: usize,
    /// Unknowns.
    pub dof: usize,
    /// The area of the domain.
    pub area: f64,
    /// Ascending, repeated by multiplicity.
    pub eigenvalues: Vec<f64>,
    /// Of each the coefficients of an eigenfunction of norm 1: control points of the level, then ghosts.
    pub functions: Vec<Vec<f64>>,
}

pub(crate) fn spectrum(space: &Space, membrane: Membrane, count: usize, options: &Options) -> Result<Spectrum, Error> {
    let tables = tables(space, options, false)?;
    let (matrices, weights) = assemble(space, &tables, &[Form::Stiffness, Form::Mass], Some(&|_| 1.0))?;
    let fixed = match membrane {
        Membrane::Free => vec![false; space.positions.len()],
        Membrane::Held => fixed(space, options.ends, false),
    };
    let free: Vec<bool> = used(space, options.ends)
        .iter()
        .zip(fixed)
        .map(|(used, fixed)| *used && !fixed)
        .collect();
    let unknowns = Numbering::new(&free);
    let dof = unknowns.list.len();
    let [stiffness, mass] = [0, 1].map(|k| matrices[k].part(&unknowns, &unknowns));
    // constants have the unknowns 1, so the loads of 1 add up to the area
    let area: f64 = weights.iter().sum();
    let places = unknowns.gather(&space.positions);
    let pairs = lowest(&stiffness, &mass, &places, 1.0 / area, count.min(dof))?;
    let spread = |vector: &Vec<f64>| {
        let mut values = vec![0.0; free.len()];
        unknowns
            .list
            .iter()
            .zip(vector)
            .for_each(|(&i, value)| values[i] = *value);
        coefficients(space, &values)
    };
    Ok(Spectrum {
        faces: space.cells.len(),
        dof,
        area,
        eigenvalues: pairs.iter().map(|(theta, _)| *theta).collect(),
        functions: pairs.iter().map(|(_, vector)| spread(vector)).collect(),
    })
}
