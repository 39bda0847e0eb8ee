//! Galerkin's method: stiffness, mass and load, data on the boundary, and the errors of the result.

use crate::Error;
use crate::solution::Solution;
use crate::space::{Ends, Kind, Space};
use crate::tables::{Jet, Table, bicubic, line_rule};
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::time::Instant;

/// What is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Problem {
    /// `(grad u, grad v) = (f, v)` with the trace prescribed.
    Poisson,
    /// The nearest function in the mean square.
    L2,
}

/// Quadrature and boundary.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The solution beyond the boundary.
    pub ends: Ends,
    /// Gauss points of an element in each direction, 2 to 10.
    pub gauss: usize,
    /// Annuli at extraordinary vertices; `None` until `lambda^2m < 1e-16`.
    pub depth: Option<usize>,
    /// Whether the last annulus stands for those that follow.
    pub scaled: bool,
}

/// Norms of a function over the domain: seminorms of first and second order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Norms {
    /// The mean square's root.
    pub l2: f64,
    /// Of the gradient.
    pub h1: f64,
    /// Of the Hessian, face by face.
    pub h2: f64,
    /// The maximum over the quadrature points.
    pub linf: f64,
}

/// The result of one level.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Faces.
    pub faces: usize,
    /// Unknowns before data on the boundary.
    pub dof: usize,
    /// Quadrature points of the elements.
    pub points: usize,
    /// Of the error, by 6 x 6 points.
    pub error: Norms,
    /// Of the solution, by the same points.
    pub norm: Norms,
    /// Seconds for assembly, the solver and the errors.
    pub seconds: [f64; 3],
}

/// A point of a face in the plane: jets of x and y, `J^-1` by rows, its determinant times the weight.
struct Geometry {
    x: [Jet; 2],
    inverse: [[f64; 2]; 2],
    measure: f64,
}

fn geometry(jets: &[Jet], points: &[[f64; 2]], weight: f64) -> Result<Geometry, f64> {
    let mut x = [[0.0; 6]; 2];
    for (jet, point) in jets.iter().zip(points) {
        for (sum, coordinate) in x.iter_mut().zip(point) {
            sum.iter_mut().zip(jet).for_each(|(s, j)| *s += coordinate * j);
        }
    }
    let det = x[0][1] * x[1][2] - x[0][2] * x[1][1];
    if !(det > 0.0) {
        return Err(det);
    }
    let inverse = [[x[1][2] / det, -x[0][2] / det], [-x[1][1] / det, x[0][1] / det]];
    Ok(Geometry {
        x,
        inverse,
        measure: det * weight,
    })
}

impl Geometry {
    /// The gradient of a function with these derivatives.
    fn gradient(&self, s: f64, t: f64) -> [f64; 2] {
        let [a, b] = self.inverse;
        [s * a[0] + t * b[0], s * a[1] + t * b[1]]
    }

    /// The Hessian `J^-T (D^2 v - v_x D^2 x - v_y D^2 y) J^-1` as xx, xy, yy.
    fn hessian(&self, v: &Jet, gradient: [f64; 2]) -> [f64; 3] {
        let d: [f64; 3] =
            std::array::from_fn(|k| v[3 + k] - gradient[0] * self.x[0][3 + k] - gradient[1] * self.x[1][3 + k]);
        let [a, b] = self.inverse;
        let form = |i: usize, j: usize| a[i] * (d[0] * a[j] + d[1] * b[j]) + b[i] * (d[1] * a[j] + d[2] * b[j]);
        [form(0, 0), form(0, 1), form(1, 1)]
    }
}

/// A symmetric system as entries of the lower triangle, which may repeat.
struct System {
    entries: Vec<Triplet<usize, usize, f64>>,
    load: Vec<f64>,
}

type Local = (Vec<u32>, Vec<f64>, Vec<f64>);

fn local(
    space: &Space,
    tables: &BTreeMap<Kind, Table>,
    face: usize,
    problem: Problem,
    u: &Solution,
) -> Result<Local, Error> {
    let cell = &space.cells[face];
    let table = &tables[&cell.kind];
    let points: Vec<u32> = table.columns.iter().map(|&c| cell.points[c]).collect();
    let positions: Vec<[f64; 2]> = points.iter().map(|&v| space.positions[v as usize]).collect();
    let n = points.len();
    let (mut matrix, mut load) = (vec![0.0; n * n], vec![0.0; n]);
    let mut gradients = vec![[0.0; 2]; n];
    for (q, &weight) in table.weights.iter().enumerate() {
        let jets = table.at(q);
        let at = geometry(jets, &positions, weight).map_err(|value| Error::Jacobian { face, value })?;
        let exact = u(at.x[0][0], at.x[1][0]);
        let f = match problem {
            Problem::Poisson => -(exact.hessian[0] + exact.hessian[2]),
            Problem::L2 => exact.value,
        };
        for (i, jet) in jets.iter().enumerate() {
            load[i] += f * jet[0] * at.measure;
            gradients[i] = match problem {
                Problem::Poisson => at.gradient(jet[1], jet[2]),
                Problem::L2 => [jet[0], 0.0],
            };
        }
        for i in 0..n {
            let [a, b] = gradients[i].map(|g| g * at.measure);
            for (entry, other) in matrix[i * n..=i * n + i].iter_mut().zip(&gradients) {
                *entry += a * other[0] + b * other[1];
            }
        }
    }
    Ok((points, matrix, load))
}

fn assemble(space: &Space, tables: &BTreeMap<Kind, Table>, problem: Problem, u: &Solution) -> Result<System, Error> {
    let mut system = System {
        entries: Vec::new(),
        load: vec![0.0; space.positions.len()],
    };
    let faces: Vec<usize> = (0..space.cells.len()).collect();
    // blocks bound the memory, and their order makes sums the same for any number of threads
    for block in faces.chunks(4096) {
        let parts: Vec<Local> = block
            .par_iter()
            .map(|&face| local(space, tables, face, problem, u))
            .collect::<Result<_, _>>()?;
        for (points, matrix, load) in parts {
            let n = points.len();
            for i in 0..n {
                for &(row, a) in &space.transform[points[i] as usize] {
                    system.load[row as usize] += a * load[i];
                    for j in 0..n {
                        let entry = if j <= i { matrix[i * n + j] } else { matrix[j * n + i] };
                        for &(column, b) in &space.transform[points[j] as usize] {
                            if column <= row {
                                system
                                    .entries
                                    .push(Triplet::new(row as usize, column as usize, a * b * entry));
                            }
                        }
                    }
                }
            }
        }
    }
    Ok(system)
}

/// Solves for the unknowns that are not given.
fn solve(system: &System, given: &BTreeMap<usize, f64>, used: &[bool]) -> Result<Vec<f64>, Error> {
    let free: Vec<usize> = (0..used.len()).filter(|i| used[*i] && !given.contains_key(i)).collect();
    let mut number = vec![usize::MAX; used.len()];
    free.iter().enumerate().for_each(|(k, &i)| number[i] = k);
    let mut load: Vec<f64> = free.iter().map(|&i| system.load[i]).collect();
    let mut entries = Vec::with_capacity(system.entries.len());
    for entry in &system.entries {
        match (number[entry.row], number[entry.col]) {
            (usize::MAX, usize::MAX) => {}
            (usize::MAX, column) => load[column] -= entry.val * given.get(&entry.row).copied().unwrap_or(0.0),
            (row, usize::MAX) => load[row] -= entry.val * given.get(&entry.col).copied().unwrap_or(0.0),
            (row, column) => entries.push(Triplet::new(row.max(column), row.min(column), entry.val)),
        }
    }
    let unknowns = free.len();
    let mut values = vec![0.0; used.len()];
    given.iter().for_each(|(&i, &value)| values[i] = value);
    if unknowns == 0 {
        return Ok(values);
    }
    let matrix = SparseColMat::try_new_from_triplets(unknowns, unknowns, &entries)
        .map_err(|_| Error::NotDefinite { unknowns })?;
    let factor = matrix
        .sp_cholesky(faer::Side::Lower)
        .map_err(|_| Error::NotDefinite { unknowns })?;
    let right = faer::Mat::from_fn(unknowns, 1, |i, _| load[i]);
    let result = factor.solve(&right);
    free.iter().enumerate().for_each(|(k, &i)| values[i] = result[(k, 0)]);
    Ok(values)
}

/// The unknowns of the trace that is nearest to u on the boundary in the mean square.
fn trace(space: &Space, ends: Ends, u: &Solution) -> Result<BTreeMap<usize, f64>, Error> {
    let count = space.positions.len();
    let mut system = System {
        entries: Vec::new(),
        load: vec![0.0; count],
    };
    let fixed = |v: usize| match ends {
        Ends::Open => v >= space.inner,
        Ends::Natural => space.boundary[v],
    };
    for grid in &space.edges {
        for &(s, weight) in &line_rule(6) {
            let jets = bicubic(s, 0.0);
            let mut x = [[0.0; 2]; 2];
            let mut row: BTreeMap<usize, f64> = BTreeMap::new();
            for (jet, &v) in jets.iter().zip(grid) {
                for (k, coordinate) in space.positions[v as usize].iter().enumerate() {
                    x[k][0] += coordinate * jet[0];
                    x[k][1] += coordinate * jet[1];
                }
                for &(b, w) in &space.transform[v as usize] {
                    *row.entry(b as usize).or_default() += w * jet[0];
                }
            }
            row.retain(|&v, _| fixed(v));
            let measure = weight * x[0][1].hypot(x[1][1]);
            let value = u(x[0][0], x[1][0]).value;
            for (&i, &a) in &row {
                system.load[i] += measure * a * value;
                for (&j, &b) in row.range(..=i) {
                    system.entries.push(Triplet::new(i, j, measure * a * b));
                }
            }
        }
    }
    let used: Vec<bool> = (0..count).map(fixed).collect();
    let values = solve(&system, &BTreeMap::new(), &used)?;
    Ok((0..count).filter(|&v| used[v]).map(|v| (v, values[v])).collect())
}

/// Norms of the error of the function with these coefficients, and of u itself.
fn errors(space: &Space, tables: &BTreeMap<Kind, Table>, c: &[f64], u: &Solution) -> Result<[Norms; 2], Error> {
    let one = |face: usize| -> Result<[[f64; 4]; 2], Error> {
        let cell = &space.cells[face];
        let table = &tables[&cell.kind];
        let points: Vec<u32> = table.columns.iter().map(|&k| cell.points[k]).collect();
        let positions: Vec<[f64; 2]> = points.iter().map(|&v| space.positions[v as usize]).collect();
        let mut sums = [[0.0; 4]; 2];
        // derivatives do not see a constant, and lose fewer digits without it
        let base = c[points[0] as usize];
        for (q, &weight) in table.weights.iter().enumerate() {
            let jets = table.at(q);
            let at = geometry(jets, &positions, weight).map_err(|value| Error::Jacobian { face, value })?;
            let mut v = [0.0; 6];
            for (jet, &point) in jets.iter().zip(&points) {
                let value = c[point as usize] - base;
                v.iter_mut().zip(jet).for_each(|(sum, j)| *sum += value * j);
            }
            v[0] += base;
            let gradient = at.gradient(v[1], v[2]);
            let hessian = at.hessian(&v, gradient);
            let exact = u(at.x[0][0], at.x[1][0]);
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
        Ok(sums)
    };
    let parts: Vec<[[f64; 4]; 2]> = (0..space.cells.len())
        .into_par_iter()
        .map(one)
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

/// Solves a problem in a space and measures the error.
pub(crate) fn run(space: &Space, problem: Problem, u: &Solution, options: &Options) -> Result<Outcome, Error> {
    let start = Instant::now();
    let tables = space.tables(options.gauss, options.depth, options.scaled);
    let system = assemble(space, &tables, problem, u)?;
    let assembled = start.elapsed().as_secs_f64();
    let count = space.positions.len();
    let used: Vec<bool> = (0..count)
        .map(|v| options.ends == Ends::Open || v < space.inner)
        .collect();
    let given = match problem {
        Problem::Poisson => trace(space, options.ends, u)?,
        Problem::L2 => BTreeMap::new(),
    };
    let values = solve(&system, &given, &used)?;
    drop(system);
    let solved = start.elapsed().as_secs_f64();
    let coefficients: Vec<f64> = space
        .transform
        .iter()
        .map(|row| row.iter().map(|&(b, w)| w * values[b as usize]).sum())
        .collect();
    let [error, norm] = errors(space, &space.tables(6, None, false), &coefficients, u)?;
    Ok(Outcome {
        faces: space.cells.len(),
        dof: used.iter().filter(|used| **used).count(),
        points: space.cells.iter().map(|cell| tables[&cell.kind].weights.len()).sum(),
        error,
        norm,
        seconds: [assembled, solved - assembled, start.elapsed().as_secs_f64() - solved],
    })
}
