//! Norms of errors.

use crate::Error;
use crate::geometry::Geometry;
use crate::integrals::{Tables, points_of, refused};
use crate::patch::{Maps, Wanted};
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

fn face_sums(
    space: &Space,
    tables: &Tables,
    face: usize,
    c: &[f64],
    u: &Solution,
    maps: &mut Maps,
) -> Result<Sums, Error> {
    let table = &tables[&space.cells[face].kind];
    let (points, mut data) = points_of(space, table, face);
    let mut sums = [[0.0; 4]; 2];
    // derivatives do not see a constant, and lose fewer digits without it
    let base = c[points[0] as usize];
    for (data, &point) in data.iter_mut().zip(&points) {
        data[0] = c[point as usize] - base;
    }
    let wanted = Wanted {
        coefficient: true,
        space: !space.planar,
        second: true,
    };
    table.patches(&data, |patch, control| {
        patch.jets.sums(control, wanted, maps);
        for (map, weight) in maps.iter().zip(&patch.jets.weights) {
            let at = Geometry::new(&map, weight * patch.factor, space.planar)
                .map_err(|irregular| refused(space, face, &irregular))?;
            let [value, s, t, second @ ..] = map.map(|data| data[0]);
            let gradient = at.gradient(s, t);
            let hessian = at.hessian(second, gradient);
            let exact = at.exact(u);
            for (sum, sign) in sums.iter_mut().zip([1.0, 0.0]) {
                let value = exact.value - sign * (value + base);
                let g: [f64; 2] = std::array::from_fn(|k| exact.gradient[k] - sign * gradient[k]);
                let h: [f64; 3] = std::array::from_fn(|k| exact.hessian[k] - sign * hessian[k]);
                sum[0] += at.measure * value * value;
                sum[1] += at.measure * (g[0] * g[0] + g[1] * g[1]);
                sum[2] += at.measure * (h[0] * h[0] + 2.0 * h[1] * h[1] + h[2] * h[2]);
                sum[3] = f64::max(sum[3], value.abs());
            }
        }
        Ok(())
    })?;
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
        .map_init(Maps::default, |maps, face| face_sums(space, tables, face, c, u, maps))
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
