//! Conjugate gradients with a multigrid cycle on nested spaces.
//!
//! V(2,2): two forward overrelaxed Gauss-Seidel sweeps before the correction by the coarser space, two
//! backward ones after, so that the cycle is symmetric; coarse matrices are Galerkin's, `P^T A P`, down to
//! the control mesh, whose system is factored.

use crate::Error;
use crate::sparse::{Factor, Numbering, Sparse, dot, norm};

/// Where the iteration ends.
#[derive(Clone, Copy)]
pub(crate) struct Goals {
    /// The largest residual in the Euclidean norm.
    pub residual: f64,
    /// The largest residual over the one at the start, in this norm and in that of the cycle, which is near
    /// the energy of the error.
    pub reduction: f64,
}

/// The factor of a relaxation. Empirical: with 1 a tenth more iterations are needed, and with 1.5.
const FACTOR: f64 = 1.25;
/// Some three times as many as any of our problems took.
const MOST: usize = 200;

struct Level {
    matrix: Sparse,
    diagonal: Vec<f64>,
    up: Sparse,
    down: Sparse,
}

/// The cycle.
pub(crate) struct Multigrid {
    /// Coarsest first.
    levels: Vec<Level>,
    coarse: Factor,
    /// The unknowns of the coarsest level that its factor has.
    used: Numbering,
    coarse_size: usize,
}

/// An overrelaxed sweep of Gauss and Seidel.
fn relax(level: &Level, right: &[f64], x: &mut [f64], rows: impl Iterator<Item = usize>) {
    for row in rows {
        x[row] += FACTOR * (right[row] - level.matrix.row_times(row, x)) / level.diagonal[row];
    }
}

impl Multigrid {
    /// From the finest matrix and the embeddings, coarsest first. A singular matrix, whose kernel is the
    /// constants, has the first unknown of the coarsest level left out of its factor.
    pub fn new(matrix: Sparse, embeddings: Vec<Sparse>, singular: bool) -> Result<Self, Error> {
        let mut matrix = matrix;
        let mut levels = Vec::with_capacity(embeddings.len());
        for up in embeddings.into_iter().rev() {
            let down = up.transposed();
            let coarse = down.product(&matrix.product(&up));
            let diagonal = matrix.diagonal();
            levels.push(Level {
                matrix,
                diagonal,
                up,
                down,
            });
            matrix = coarse;
        }
        levels.reverse();
        let size = matrix.height();
        let used = Numbering::new(&(0..size).map(|i| i > 0 || !singular).collect::<Vec<_>>());
        let coarse = matrix.part(&used, &used).factor(None)?;
        Ok(Multigrid {
            levels,
            coarse,
            used,
            coarse_size: size,
        })
    }

    fn cycle(&self, level: usize, right: &[f64]) -> Vec<f64> {
        let Some(finer) = level.checked_sub(1) else {
            let mut x = vec![0.0; self.coarse_size];
            let solution = self.coarse.solve(&self.used.gather(right));
            self.used.list.iter().zip(solution).for_each(|(&i, value)| x[i] = value);
            return x;
        };
        let level = &self.levels[finer];
        let Level { matrix, up, down, .. } = level;
        let n = matrix.height();
        let mut x = vec![0.0; n];
        (0..2).for_each(|_| relax(level, right, &mut x, 0..n));
        let rest: Vec<f64> = right.iter().zip(matrix.times(&x)).map(|(b, ax)| b - ax).collect();
        let correction = up.times(&self.cycle(finer, &down.times(&rest)));
        x.iter_mut().zip(correction).for_each(|(x, c)| *x += c);
        (0..2).for_each(|_| relax(level, right, &mut x, (0..n).rev()));
        x
    }

    /// What the coarsest space has of a solution.
    fn coarsest(&self, right: &[f64]) -> Vec<f64> {
        let below = self
            .levels
            .iter()
            .rev()
            .fold(right.to_vec(), |rest, level| level.down.times(&rest));
        let solution = self.cycle(0, &below);
        self.levels.iter().fold(solution, |x, level| level.up.times(&x))
    }

    /// The solution and the number of iterations, which start from the solution of the coarsest space.
    pub fn solve(&self, right: &[f64], goals: Goals) -> Result<(Vec<f64>, usize), Error> {
        let Some(Level { matrix, .. }) = self.levels.last() else {
            return Ok((self.cycle(0, right), 0));
        };
        let mut x = self.coarsest(right);
        let mut rest: Vec<f64> = right.iter().zip(matrix.times(&x)).map(|(b, ax)| b - ax).collect();
        let start = norm(&rest);
        let goal = goals.residual.min(goals.reduction * start);
        let (mut direction, mut before, mut first) = (Vec::new(), 1.0, 0.0);
        for iteration in 0..=MOST {
            let z = self.cycle(self.levels.len(), &rest);
            let product = dot(&rest, &z);
            if iteration == 0 {
                first = product;
            }
            // zero data have a zero solution
            if norm(&rest) <= goal && product <= goals.reduction.powi(2) * first {
                return Ok((x, iteration));
            }
            if iteration == 0 {
                direction = z;
            } else {
                let beta = product / before;
                direction.iter_mut().zip(&z).for_each(|(d, z)| *d = z + beta * *d);
            }
            before = product;
            let image = matrix.times(&direction);
            let step = product / dot(&direction, &image);
            if !step.is_finite() {
                break;
            }
            x.iter_mut().zip(&direction).for_each(|(x, d)| *x += step * d);
            rest.iter_mut().zip(&image).for_each(|(r, a)| *r -= step * a);
        }
        Err(Error::NoConvergence {
            unknowns: right.len(),
            iterations: MOST,
            residual: norm(&rest) / start,
        })
    }
}
