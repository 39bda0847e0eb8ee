//! Galerkin's method: one problem on one level.

use crate::around::Around;
use crate::assembly::assemble;
use crate::geometry::Geometry;
use crate::integrals::{Form, Load, Tables, loads};
use crate::multigrid::{Goals, Multigrid};
use crate::norms::{Norms, errors};
use crate::solution::Solution;
use crate::space::{Depth, Ends, Space};
use crate::sparse::{Numbering, Sparse, norm};
use crate::{Error, MOST_ANNULI, boundary};
use std::time::Instant;

/// What is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Problem {
    /// `(grad u, grad v) = (f, v)` with the trace prescribed.
    Poisson,
    /// `(grad u, grad v) = (f, v) + (du/dn, v)` over the boundary, with the mean of the given solution.
    Neumann,
    /// The nearest function in the mean square.
    L2,
    /// `(laplace u, laplace v) = (f, v)` with trace and normal derivative prescribed: a clamped plate.
    Biharmonic,
    /// `(grad u, grad v) + (u, v) = (f, v)` on a closed surface, with the operator of Laplace and Beltrami.
    LaplaceBeltrami,
}

/// How Dirichlet's data enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dirichlet {
    /// The nearest trace in the mean square, eliminated.
    Projection,
    /// By terms of the variational form.
    Nitsche,
}

/// How the system is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// By a sparse factor.
    Cholesky,
    /// By conjugate gradients with a multigrid cycle over the levels.
    Multigrid,
}

/// Unknowns up to which a factor is the default.
const FACTORED: usize = 200_000;

/// The most that multigrid leaves of the residual of prescribed values alone.
const RESIDUAL: f64 = 1e-10;

/// The solver of so many unknowns.
pub(crate) fn default_solver(dof: usize) -> Solver {
    if dof > FACTORED {
        Solver::Multigrid
    } else {
        Solver::Cholesky
    }
}

/// Quadrature, boundary and solver.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The solution beyond the boundary.
    pub ends: Ends,
    /// Dirichlet's data.
    pub dirichlet: Dirichlet,
    /// Gauss points of an element in each direction, 2 to 10.
    pub gauss: usize,
    /// Annuli at extraordinary vertices; `None` until `lambda^2m < 1e-16` and, where second derivatives are
    /// integrated, `(mu/lambda)^2m < 1e-10`.
    pub depth: Option<usize>,
    /// Whether the last annulus stands for those that follow.
    pub scaled: bool,
    /// `None` for the factor up to 2*10^5 unknowns, multigrid above.
    pub solver: Option<Solver>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            ends: Ends::Open,
            dirichlet: Dirichlet::Projection,
            gauss: 4,
            depth: None,
            scaled: false,
            solver: None,
        }
    }
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
    /// How it was solved.
    pub solver: Solver,
    /// Iterations of conjugate gradients.
    pub iterations: Option<usize>,
    /// Seconds for assembly, the solver and the errors.
    pub seconds: [f64; 3],
    /// The coefficients of the solution: control points of the level, then ghosts.
    pub coefficients: Vec<f64>,
}

/// Which unknowns a space has.
pub(crate) fn used(space: &Space, ends: Ends) -> Vec<bool> {
    (0..space.positions.len())
        .map(|v| ends == Ends::Open || v < space.inner)
        .collect()
}

/// Which unknowns make up the trace; for plates, trace and normal derivative.
pub(crate) fn fixed(space: &Space, ends: Ends, plate: bool) -> Vec<bool> {
    let ghost = |v: usize| v >= space.inner && ends == Ends::Open;
    let rim = |v: usize| v < space.inner && space.boundary[v] && (plate || ends == Ends::Natural);
    (0..space.positions.len()).map(|v| ghost(v) || rim(v)).collect()
}

/// Tables of the elements.
pub(crate) fn tables(space: &Space, options: &Options, plate: bool) -> Result<Tables, Error> {
    let own = |around: &Around| {
        if plate {
            around.plate_depth()
        } else {
            Some(around.depth())
        }
    };
    if let Some((&valence, around)) = space.around.iter().find(|(_, around)| own(around).is_none()) {
        return Err(Error::NotH2 {
            valence,
            ratio: around.ratio,
            most: around.most_ratio(),
            annuli: MOST_ANNULI,
        });
    }
    if plate && space.elements.iter().any(|element| !element.is_regular()) {
        return Err(Error::Combination {
            what: "a clamped plate in a space with knot intervals and extraordinary vertices",
            accepted: "poisson, l2 and patch-test",
        });
    }
    let depth = match options.depth {
        Some(depth) => Depth::Given(depth),
        None if plate => Depth::Energy,
        None => Depth::Area,
    };
    Ok(space.tables(options.gauss, depth, options.scaled))
}

/// Tables by which errors are measured.
fn measure(space: &Space) -> Tables {
    space.tables(6, Depth::Area, false)
}

fn right_hand_side(problem: Problem, u: &Solution, at: &Geometry) -> f64 {
    let exact = at.exact(u);
    let laplacian = exact.hessian[0] + exact.hessian[2];
    match problem {
        Problem::Poisson | Problem::Neumann => -laplacian,
        Problem::L2 => exact.value,
        Problem::Biharmonic => u(at.x[0], at.x[1]).bilaplacian,
        Problem::LaplaceBeltrami => exact.value - laplacian,
    }
}

/// Coefficients of unknowns.
pub(crate) fn coefficients(space: &Space, values: &[f64]) -> Vec<f64> {
    space.transform.times(values)
}

/// Equations over all unknowns of a space.
struct System {
    matrix: Sparse,
    right: Vec<f64>,
    prescribed: Vec<f64>,
}

impl Problem {
    fn essential(self, options: &Options) -> bool {
        match self {
            Problem::Biharmonic => true,
            Problem::Poisson => options.dirichlet == Dirichlet::Projection,
            Problem::Neumann | Problem::L2 | Problem::LaplaceBeltrami => false,
        }
    }

    /// How far multigrid reduces the residual of the coarsest space's solution, so that the algebra's error
    /// does not show beside that of 10^6 unknowns in any norm. Empirical; further in the mean square, which
    /// hardly sees the small faces near an extraordinary vertex.
    fn reduction(self) -> f64 {
        match self {
            Problem::L2 => 1e-12,
            Problem::Poisson | Problem::Neumann | Problem::Biharmonic | Problem::LaplaceBeltrami => 1e-9,
        }
    }

    /// Whether constants are free.
    fn singular(self) -> bool {
        self == Problem::Neumann
    }

    /// Which unknowns data on the boundary prescribe.
    fn held(self, space: &Space, options: &Options) -> Vec<bool> {
        match self.essential(options) {
            true => fixed(space, options.ends, self == Problem::Biharmonic),
            false => vec![false; space.positions.len()],
        }
    }

    /// Those that the equations leave.
    fn free(self, space: &Space, options: &Options) -> Numbering {
        let held = self.held(space, options);
        let free = used(space, options.ends).into_iter().zip(held);
        Numbering::new(&free.map(|(used, held)| used && !held).collect::<Vec<_>>())
    }

    /// The boundary's data, for all unknowns; zero for those that the equations leave.
    fn prescribed(self, space: &Space, u: &Solution, options: &Options) -> Result<Vec<f64>, Error> {
        let held = self.held(space, options);
        match self.essential(options) {
            true => boundary::projected(space, &held, self == Problem::Biharmonic, u),
            false => Ok(vec![0.0; held.len()]),
        }
    }

    fn system(self, space: &Space, u: &Solution, options: &Options, tables: &Tables) -> Result<System, Error> {
        let forms: &[Form] = match self {
            Problem::Poisson | Problem::Neumann => &[Form::Stiffness],
            Problem::L2 => &[Form::Mass],
            Problem::Biharmonic => &[Form::Plate],
            Problem::LaplaceBeltrami => &[Form::Stiffness, Form::Mass],
        };
        let load: &Load<'_> = &|at| right_hand_side(self, u, at);
        let (mut matrices, mut right) = assemble(space, tables, forms, Some(load))?;
        let mut matrix = matrices.swap_remove(0);
        for other in matrices {
            matrix.values.iter_mut().zip(&other.values).for_each(|(a, b)| *a += b);
        }
        if self == Problem::Poisson && !self.essential(options) {
            boundary::nitsche(space, &mut matrix, &mut right, u);
        }
        if self == Problem::Neumann {
            boundary::flux(space, &mut right, u);
            balance(space, tables, &mut right)?;
        }
        Ok(System {
            matrix,
            right,
            prescribed: self.prescribed(space, u, options)?,
        })
    }

    /// The solution by a factor: values of all unknowns.
    fn factored(self, system: System, space: &Space, options: &Options) -> Result<Vec<f64>, Error> {
        let System {
            matrix,
            mut right,
            prescribed: mut values,
        } = system;
        subtract(&mut right, &matrix.times(&values));
        let mut unknowns = self.free(space, options);
        if self.singular() {
            // the mean is set afterwards
            unknowns = unknowns.without_first();
        }
        let part = matrix.part(&unknowns, &unknowns);
        drop(matrix);
        let factor = part.factor(Some(&unknowns.gather(&space.positions)))?;
        unknowns.add(&factor.solve(&unknowns.gather(&right)), &mut values);
        Ok(values)
    }

    /// The same by multigrid, with the number of iterations. Inside are first the boundary's data of the
    /// coarsest space: from zero there, those of the finest would be most of the residual, and what it has to
    /// be reduced to would be large beside the error of fine spaces.
    fn iterated(
        self,
        system: System,
        space: &Space,
        u: &Solution,
        options: &Options,
        coarser: &[(Sparse, Space)],
    ) -> Result<(Vec<f64>, usize), Error> {
        let System {
            matrix,
            right,
            prescribed: mut values,
        } = system;
        let unknowns = self.free(space, options);
        let residual = |values: &[f64]| {
            let mut rest = right.clone();
            subtract(&mut rest, &matrix.times(values));
            unknowns.gather(&rest)
        };
        let scale = norm(&residual(&values));
        let goals = Goals {
            residual: RESIDUAL * scale,
            reduction: self.reduction(),
        };
        if let Some((_, coarsest)) = coarser.first() {
            let data = self.prescribed(coarsest, u, options)?;
            let data = coarser.iter().fold(data, |data, (up, _)| up.times(&data));
            unknowns.list.iter().for_each(|&id| values[id] = data[id]);
        }
        let rest = residual(&values);
        let part = matrix.part(&unknowns, &unknowns);
        drop(matrix);
        let numberings: Vec<Numbering> = coarser.iter().map(|(_, space)| self.free(space, options)).collect();
        let finer = numberings.iter().skip(1).chain([&unknowns]);
        let embeddings = coarser.iter().zip(&numberings).zip(finer);
        let embeddings = embeddings.map(|(((up, _), from), to)| up.part(to, from)).collect();
        let (correction, iterations) = Multigrid::new(part, embeddings, self.singular())?.solve(&rest, goals)?;
        unknowns.add(&correction, &mut values);
        Ok((values, iterations))
    }
}

fn subtract(from: &mut [f64], what: &[f64]) {
    from.iter_mut().zip(what).for_each(|(a, b)| *a -= b);
}

/// Solves a problem in a space and measures the error. `embeddings` are those of the coarser spaces, coarsest
/// first, over all unknowns.
pub(crate) fn run(
    space: &Space,
    problem: Problem,
    u: &Solution,
    options: &Options,
    embeddings: impl FnOnce() -> Result<Vec<(Sparse, Space)>, Error>,
) -> Result<Outcome, Error> {
    let plate = problem == Problem::Biharmonic;
    if plate && options.ends == Ends::Natural {
        return Err(Error::Combination {
            what: "a clamped plate with natural boundary",
            accepted: "the open one, whose functions have any second derivatives there",
        });
    }
    let start = Instant::now();
    let tables = tables(space, options, plate)?;
    let system = problem.system(space, u, options, &tables)?;
    let assembled = start.elapsed().as_secs_f64();
    let dof = used(space, options.ends).iter().filter(|used| **used).count();
    let solver = options.solver.unwrap_or(default_solver(dof));
    let (values, iterations) = match solver {
        Solver::Cholesky => (problem.factored(system, space, options)?, None),
        Solver::Multigrid => {
            let (values, iterations) = problem.iterated(system, space, u, options, &embeddings()?)?;
            (values, Some(iterations))
        }
    };
    let solved = start.elapsed().as_secs_f64();
    let measures = measure(space);
    let mut coefficients = coefficients(space, &values);
    if problem.singular() {
        let constant = mean_error(space, &measures, &coefficients, u)?;
        coefficients.iter_mut().for_each(|c| *c += constant);
    }
    let [error, norm] = errors(space, &measures, &coefficients, u)?;
    if [error, norm]
        .iter()
        .any(|of| !(of.l2 + of.h1 + of.h2 + of.linf).is_finite())
    {
        let at = space.positions.first().copied().unwrap_or_default();
        return Err(Error::Solution { at });
    }
    Ok(Outcome {
        faces: space.cells.len(),
        dof,
        points: space.cells.iter().map(|cell| tables[&cell.kind].points()).sum(),
        error,
        norm,
        solver,
        iterations,
        seconds: [assembled, solved - assembled, start.elapsed().as_secs_f64() - solved],
        coefficients,
    })
}

/// Takes a constant from the right-hand side so that it vanishes on constants, whose unknowns are all 1: what
/// quadrature leaves there would be a source at one point otherwise.
fn balance(space: &Space, tables: &Tables, right: &mut [f64]) -> Result<(), Error> {
    let mut weights = vec![0.0; right.len()];
    for (row, load) in loads(space, tables, &|_| 1.0)?.into_iter().enumerate() {
        let terms = space.transform.row(row);
        terms.for_each(|(id, w)| weights[id] += w * load);
    }
    let excess = right.iter().sum::<f64>() / weights.iter().sum::<f64>();
    right.iter_mut().zip(weights).for_each(|(b, w)| *b -= excess * w);
    Ok(())
}

/// The mean of u less that of the function with these coefficients.
fn mean_error(space: &Space, tables: &Tables, coefficients: &[f64], u: &Solution) -> Result<f64, Error> {
    let one: &Load<'_> = &|_| 1.0;
    let value: &Load<'_> = &|at| u(at.x[0], at.x[1]).value;
    let weights = loads(space, tables, one)?;
    let of_u: f64 = loads(space, tables, value)?.iter().sum();
    let area: f64 = weights.iter().sum();
    let own: f64 = weights.iter().zip(coefficients).map(|(w, c)| w * c).sum();
    Ok((of_u - own) / area)
}
