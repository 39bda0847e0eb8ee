//! The lowest eigenvalues of `K x = theta M x`.
//!
//! Block Lanczos on `(K + sigma M)^-1 M`, which is symmetric in the inner product of M and whose eigenvalues
//! are `nu = 1/(theta + sigma)` (Golub and Underwood 1977; Grimes, Lewis and Simon 1994), with full
//! orthogonalisation. A block finds as many copies of an eigenvalue as it has columns; so a second run,
//! orthogonal to what was found, looks for what was missed, until there is nothing.

use crate::Error;
use crate::sparse::{Factor, Sparse, dot};
use faer::{Mat, Side};

/// Columns of a block.
const BLOCK: usize = 4;
/// The residual of an eigenpair over nu at which it is accepted; the error of the eigenvalue is its square.
const GOAL: f64 = 1e-9;
/// What is left of a block over nu when it is rounding.
const ROUNDING: f64 = 1e-13;
/// Blocks of one run.
const MOST: usize = 150;

type Vector = Vec<f64>;

/// Vectors that are orthonormal in M, with their images under M.
#[derive(Default)]
struct Basis {
    vectors: Vec<Vector>,
    images: Vec<Vector>,
}

impl Basis {
    /// Takes the part along the basis out of a vector; its coefficients.
    fn project(&self, w: &mut Vector) -> Vec<f64> {
        let mut sums = vec![0.0; self.vectors.len()];
        // twice is enough
        for _ in 0..2 {
            for ((v, image), sum) in self.vectors.iter().zip(&self.images).zip(&mut sums) {
                let along = dot(image, w);
                w.iter_mut().zip(v).for_each(|(w, v)| *w -= along * v);
                *sum += along;
            }
        }
        sums
    }

    /// Appends the direction of a vector; its length.
    fn push(&mut self, mut w: Vector, mass: &Sparse) -> f64 {
        let image = mass.times(&w);
        let length = dot(&image, &w).max(0.0).sqrt();
        w.iter_mut().for_each(|w| *w /= length);
        self.images.push(mass.times(&w));
        self.vectors.push(w);
        length
    }
}

struct Operator<'a> {
    factor: Factor,
    mass: &'a Sparse,
}

/// A fixed sequence without structure in (-1, 1): a linear congruential generator (Knuth's multiplier).
fn noise(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

impl Operator<'_> {
    /// The largest nu with their vectors, in the complement of what is known.
    fn largest(&self, known: &Basis, count: usize) -> Result<Vec<(f64, Vector)>, Error> {
        let n = self.mass.height();
        let room = n - known.vectors.len();
        let count = count.min(room);
        let mut basis = Basis::default();
        let mut state = known.vectors.len() as u64;
        let mut block: Vec<Vector> = Vec::new();
        for _ in 0..BLOCK.min(room) {
            let mut w: Vector = (0..n).map(|_| noise(&mut state)).collect();
            known.project(&mut w);
            basis.project(&mut w);
            known.project(&mut w);
            basis.push(w, self.mass);
        }
        // columns of the projected operator: coefficients of A^-1 M v
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for round in 0..MOST {
            let from = columns.len();
            let to = basis.vectors.len();
            block.clear();
            for at in from..to {
                let mut w = self.factor.solve(&basis.images[at]);
                known.project(&mut w);
                columns.push(basis.project(&mut w));
                known.project(&mut w);
                block.push(w);
            }
            let size = columns.len();
            let full = Mat::from_fn(size, size, |i, j| {
                let (low, high) = (i.min(j), i.max(j));
                columns[high].get(low).copied().unwrap_or(0.0)
            });
            let eigen = full
                .self_adjoint_eigen(Side::Lower)
                .map_err(|_| Error::NotDefinite { unknowns: n })?;
            let values: Vec<f64> = (0..size).map(|k| eigen.S()[size - 1 - k]).collect();
            let coefficient = |row: usize, k: usize| eigen.U()[(row, size - 1 - k)];
            // what an eigenvector leaves is in the span of the next block
            let left = |k: usize| -> f64 {
                let mut rest = vec![0.0; n];
                for (j, w) in block.iter().enumerate() {
                    let c = coefficient(from + j, k);
                    rest.iter_mut().zip(w).for_each(|(r, w)| *r += c * w);
                }
                dot(&rest, &self.mass.times(&rest)).max(0.0).sqrt()
            };
            let full = size >= room;
            let converged = size >= count && (0..count).all(|k| left(k) <= GOAL * values[k].abs());
            if converged || full || round + 1 == MOST {
                if !(converged || full) {
                    return Err(Error::NoConvergence {
                        unknowns: n,
                        iterations: MOST,
                        residual: (0..count.min(size)).map(left).fold(0.0, f64::max),
                    });
                }
                let vector = |k: usize| {
                    let mut x = vec![0.0; n];
                    for (row, v) in basis.vectors.iter().enumerate() {
                        let c = coefficient(row, k);
                        x.iter_mut().zip(v).for_each(|(x, v)| *x += c * v);
                    }
                    x
                };
                return Ok((0..count).map(|k| (values[k], vector(k))).collect());
            }
            for mut w in block.drain(..) {
                if basis.vectors.len() == room {
                    break;
                }
                basis.project(&mut w);
                // an invariant space is left for a new direction
                if dot(&w, &self.mass.times(&w)).max(0.0).sqrt() <= ROUNDING * values[0] {
                    w = (0..n).map(|_| noise(&mut state)).collect();
                    known.project(&mut w);
                    basis.project(&mut w);
                    known.project(&mut w);
                }
                basis.push(w, self.mass);
            }
        }
        unreachable!("the last round returns")
    }
}

/// The lowest eigenvalues with their vectors, ascending. K and M are symmetric, M positive definite, K at
/// least semidefinite, and `sigma > 0` is of the order of the lowest positive eigenvalue.
pub(crate) fn lowest(
    stiffness: &Sparse,
    mass: &Sparse,
    places: &[[f64; 3]],
    sigma: f64,
    count: usize,
) -> Result<Vec<(f64, Vector)>, Error> {
    let mut shifted = stiffness.clone();
    shifted
        .values
        .iter_mut()
        .zip(&mass.values)
        .for_each(|(k, m)| *k += sigma * m);
    let operator = Operator {
        factor: shifted.factor(Some(places))?,
        mass,
    };
    let mut found: Vec<(f64, Vector)> = operator.largest(&Basis::default(), count)?;
    loop {
        let mut known = Basis::default();
        for (_, vector) in &found {
            let mut vector = vector.clone();
            known.project(&mut vector);
            known.push(vector, mass);
        }
        if known.vectors.len() == mass.height() {
            break;
        }
        let (last, more) = (
            found.last().map_or(0.0, |(nu, _)| *nu),
            operator.largest(&known, BLOCK)?,
        );
        let missed = more
            .into_iter()
            .filter(|(nu, _)| *nu > last * (1.0 + GOAL))
            .collect::<Vec<_>>();
        if missed.is_empty() {
            break;
        }
        found.extend(missed);
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        found.truncate(count);
    }
    // Rayleigh's quotient has the square of the vector's error, and does not lose digits to the shift
    let quotient = |x: &Vector| dot(x, &stiffness.times(x)) / dot(x, &mass.times(x));
    let mut pairs: Vec<(f64, Vector)> = found.into_iter().map(|(_, x)| (quotient(&x), x)).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(pairs)
}
