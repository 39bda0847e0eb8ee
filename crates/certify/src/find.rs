//! The search for evidence, in doubles.
//!
//! Nothing here is believed: what it finds is handed to the checks, which prove or refute with it, or fail
//! to. It sees the same blocks and components as they do, rounded.

use crate::Interval;
use crate::linear::{eigenpair, quotient, radius_below};
use crate::spectral::{Block, Evidence, Peel, Rest};
use eigenring_scheme::Complex;
use eigenring_spectral::{Block as Fourier, Matrix};

/// Evidence for the eigenvalues of all blocks.
pub fn evidence(blocks: &[Block]) -> Evidence {
    let of_block = |block: &Block| (0..block.components.len()).map(|c| peel(block, c)).collect();
    blocks.iter().map(of_block).collect()
}

/// Eigenvalues nearer than this, relative to the largest, are not divided out one by one: their vectors are
/// known to too few digits. Empirical.
const APART: f64 = 1e-6;

/// Pairs divided out of a component with more than [`SMALL`] unknowns. Empirical: checks ask for the first
/// three.
const PAIRS: usize = 4;

/// Components of up to this many unknowns are taken apart completely where possible.
const SMALL: usize = 8;

/// Pairs whose enclosure is wider than this, relative to the eigenvalue, are not divided out: what they leave
/// would be wider still. Empirical.
const SHARP: f64 = 1e-10;

fn peel(block: &Block, component: usize) -> Peel {
    let mut current = block.part(component);
    let mut peel = Peel::default();
    let enough = if current.rows() <= SMALL { SMALL } else { PAIRS };
    while current.rows() > 2 && peel.pairs.len() < enough {
        let Some((value, vector)) = leading(&current.map(Interval::mid)) else {
            break;
        };
        // a rehearsal of what the checks will do
        let found = eigenpair(&current, value, &vector);
        let Some(found) = found.filter(|found| found.value.width() <= SHARP * value.abs()) else {
            break;
        };
        current = quotient(&current, &found.vector, found.pivot);
        peel.pairs.push((value, vector));
    }
    if current.rows() > 2 {
        peel.rest = rest(&current);
    }
    peel
}

/// The eigenvalue of the largest modulus with its vector, if it is real and apart from the others.
fn leading(matrix: &Matrix<f64>) -> Option<(f64, Vec<f64>)> {
    let block = Fourier::Real(matrix.clone());
    let values = block.eigenvalues().ok()?;
    let first = values.first()?;
    let apart = |other: Complex<f64>| (other - first.value).modulus() > APART * first.value.modulus();
    if first.multiplicity > 1 || first.value.im != 0.0 || !values[1..].iter().all(|v| apart(v.value)) {
        return None;
    }
    let space = block.eigenspace(first.value, 0).ok()?;
    let [vector] = &space.right[..] else { return None };
    Some((first.value.re, vector.iter().map(|x| x.re).collect()))
}

/// The smallest radius for which a factor was found.
fn rest(exact: &Matrix<Interval>) -> Option<Rest> {
    let matrix = &exact.map(Interval::mid);
    let values = Fourier::Real(matrix.clone()).eigenvalues().ok()?;
    let reach = values.first().map_or(0.0, |v| v.value.modulus());
    // nearer to the spectral radius the factor is the larger; the last ones are for nilpotent matrices
    let excess = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3];
    let floors = [1e-3, 1e-2, 0.05, 0.1];
    let radii = excess
        .iter()
        .map(|x| reach * (1.0 + x))
        .chain(floors.iter().map(|x| reach + x));
    let mut radii: Vec<f64> = radii.filter(|&r| r > 1e-12).collect();
    radii.sort_by(f64::total_cmp);
    for radius in radii {
        let Some(factor) = stein_factor(matrix, radius) else {
            continue;
        };
        if radius_below(exact, &factor, radius) {
            let size = matrix.rows();
            let upper = (0..size).flat_map(|i| (i..size).map(move |j| (i, j)));
            return Some(Rest {
                radius,
                factor: upper.map(|place| factor[place]).collect(),
            });
        }
    }
    None
}

/// The Cholesky factor L (upper, `P = L^T L`) of the solution of `P - M^T P M = I`, `M = A / radius`: the sum
/// of `(M^T)^k M^k`, by doubling.
fn stein_factor(matrix: &Matrix<f64>, radius: f64) -> Option<Matrix<f64>> {
    let size = matrix.rows();
    let times = |a: &Matrix<f64>, b: &Matrix<f64>| {
        Matrix::from_fn(size, size, |i, j| (0..size).map(|k| a[(i, k)] * b[(k, j)]).sum::<f64>())
    };
    let mut power = matrix.map(|entry| entry / radius);
    let mut sum = Matrix::from_fn(size, size, |i, j| f64::from(i == j));
    // 2^40 terms are more than any excess above needs
    for _ in 0..40 {
        let image = times(&sum, &power);
        let more = Matrix::from_fn(size, size, |i, j| {
            (0..size).map(|k| power[(k, i)] * image[(k, j)]).sum::<f64>()
        });
        let size_of = |m: &Matrix<f64>| m.entries().iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        let (grown, total) = (size_of(&more), size_of(&sum));
        // beyond this condition doubles cannot confirm it
        if !(total < 1e13) {
            return None;
        }
        sum = Matrix::from_fn(size, size, |i, j| sum[(i, j)] + 0.5 * (more[(i, j)] + more[(j, i)]));
        if grown < 1e-18 * total {
            break;
        }
        power = times(&power, &power);
    }
    // P = L^T L with L upper triangular
    let mut factor = vec![vec![0.0; size]; size];
    for i in 0..size {
        for j in i..size {
            let below: f64 = (0..i).map(|k| factor[k][i] * factor[k][j]).sum();
            let value = sum[(i, j)] - below;
            factor[i][j] = if i == j { value.sqrt() } else { value / factor[i][i] };
            if !factor[i][j].is_finite() {
                return None;
            }
        }
    }
    Some(Matrix::from_rows(factor, size))
}
