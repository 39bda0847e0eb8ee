//! Norms of errors.

use crate::Error;
use crate::assembly::{Tables, points_of, refused};
use crate::geometry::Geometry;
use crate::solution::Solution;
use crate::space::Space;
use rayon::prelude::*;

/// Norms of a function over the domain: seminorms of first and second order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Norms {
    /// The mean square's root.
    pub l2: f64,
    /// Of the gradient.
    pub h1: f64,
    /// Of the Hessian, face by face.
    pub h2: f64,
    /// The maximum over the quadrature points and the limits of extraordinary vertices.
    pub linf: f64,
}

/// Squares of L2, H1, H2 and the maximum, of the error and of u.
type Sums = [[f64; 4]; 2];

fn face_sums(space: &Space, tables: &Tables, face: usize, c: &[f64], u: &Solution) -> Result<Sums, Error> {
    let cell = &space.cells[face];
    let table = &tables[&cell.kind];
    let (points, positions) = points_of(space, table, face);
    let mut sums = [[0.0; 4]; 2];
    // derivatives do not see a constant, and lose fewer digits without it
    let base = c[points[0] as usize];
    for (q, &weight) in table.weights.iter().enumerate() {
        let jets = table.at(q);
        let at = Geometry::new(jets, &positions, weight, space.planar, true)
            .map_err(|irregular| refused(space, face, &irregular))?;
        let mut v = [0.0; 6];
        for (jet, &point) in jets.iter().zip(&points) {
            let value = c[point as usize] - base;
            v.iter_mut().zip(jet).for_each(|(sum, j)| *sum += value * j);
        }
        v[0] += base;
        let gradient = at.gradient(v[1], v[2]);
        let hessian = at.hessian(&v, gradient);
        let exact = at.exact(u);
        for (sum, sign) in sums.iter_mut().zip([1.0, 0.0]) {
            let value = exact.value - sign * v[0];
            let g: [f64; 2] = std::array::from_fn(|k| exact.gradient[k] - sign * gradient[k]);
            let h: [f64; 3] = std::array::from_fn(|k| exact.hessian[k] - sign * hessian[k]);
            sum[0] += at.measure * value * value;
            sum[1] += at.measure * (g[0] * g[0] + g[1] * g[1]);
            sum[2] += at.measure * (h[0] * h[0] + 2.0 * h[1] * h[1] + h[2] * h[2]);
            sum[3] = f64::max(sum[3], value.abs());
        }
    }
    if let Some(limit) = &table.limit {
        let at =
            |of: &dyn Fn(usize) -> f64| -> f64 { limit.iter().zip(&points).map(|(l, &p)| l * of(p as usize)).sum() };
        let [x, y] = [0, 1].map(|axis| at(&|p| space.positions[p][axis]));
        let exact = u(x, y).value;
        sums[0][3] = sums[0][3].max((exact - at(&|p| c[p])).abs());
        sums[1][3] = sums[1][3].max(exact.abs());
    }
    Ok(sums)
}

/// Norms of the error of the function with these coefficients, and of u itself.
pub(crate) fn errors(space: &Space, tables: &Tables, c: &[f64], u: &Solution) -> Result<[Norms; 2], Error> {
    let parts: Vec<Sums> = (0..space.cells.len())
        .into_par_iter()
        .map(|face| face_sums(space, tables, face, c, u))
        .collect::<Result<_, _>>()?;
    Ok([0, 1].map(|k| {
        let sum = |i: usize| parts.iter().map(|part| part[k][i]).sum::<f64>().sqrt();
        let linf = parts.iter().fold(0.0, |most, part| f64::max(most, part[k][3]));
        Norms {
            l2: sum(0),
            h1: sum(1),
            h2: sum(2),
            linf,
        }
    }))
}
