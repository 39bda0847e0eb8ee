//! The quadratic programme by clarabel's interior-point method.
//!
//! `min 1/2 x^T P x + q^T x` subject to `A x + s = b`, s = 0 for equalities and s >= 0 for bounds, with `P =
//! M^T M` and `q = -M^T y`; the unknowns are the original ones, nothing is eliminated.

use super::active_set::Inequality;
use super::reduce::Row;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, ZeroConeT};

/// The solver's answer; not to be trusted beyond about 1e-8, and only if `solved`.
pub(super) struct Interior {
    pub(super) x: Vec<f64>,
    /// Bounds whose multiplier exceeds their slack: the guess of the active ones.
    pub(super) active: Vec<usize>,
    pub(super) iterations: u32,
}

/// `None` if the solver refuses or gives up on the problem, also if it finds it infeasible.
pub(super) fn solve(
    n: usize,
    rows: &[Row],
    y: &[f64],
    equalities: &[Row],
    e: &[f64],
    bounds: &[Inequality],
) -> Option<Interior> {
    let mut gram = vec![vec![0.0; n]; n];
    let mut q = vec![0.0; n];
    for (row, y) in rows.iter().zip(y) {
        row.add_to(&mut q, -y);
        for (k, &value) in row.values.iter().enumerate() {
            row.add_to(&mut gram[row.first + k], value);
        }
    }
    let p = triplets(n, n, |push| {
        for (i, column) in gram.iter().enumerate() {
            for (j, &value) in column
                .iter()
                .enumerate()
                .take(i + 1)
                .filter(|&(_, &value)| value != 0.0)
            {
                push(j, i, value);
            }
        }
    });
    let m = equalities.len() + bounds.len();
    let a = triplets(m, n, |push| {
        let signed = (equalities.iter().map(|row| (row, 1.0))).chain(bounds.iter().map(|b| (&b.row, -1.0)));
        for (i, (row, sign)) in signed.enumerate() {
            for (k, &value) in row.values.iter().enumerate() {
                push(i, row.first + k, sign * value);
            }
        }
    });
    let b: Vec<f64> = (e.iter().copied()).chain(bounds.iter().map(|b| -b.bound)).collect();
    let cones = [ZeroConeT(equalities.len()), NonnegativeConeT(bounds.len())];
    let settings = DefaultSettings {
        verbose: false,
        max_threads: 1,
        // the default 1e-8 in units of f would leave bounds of f3 near 1e-4 undecided
        tol_gap_abs: 1e-12,
        tol_gap_rel: 1e-10,
        tol_feas: 1e-10,
        ..DefaultSettings::default()
    };
    let mut solver = DefaultSolver::new(&p, &q, &a, &b, &cones, settings).ok()?;
    solver.solve();
    let solution = solver.solution;
    use clarabel::solver::SolverStatus::{AlmostSolved, InsufficientProgress, Solved};
    if !matches!(solution.status, Solved | AlmostSolved | InsufficientProgress)
        || solution.x.iter().any(|x| !x.is_finite())
    {
        return None;
    }
    let skip = equalities.len();
    let active = (0..bounds.len())
        .filter(|i| solution.z[skip + i] > solution.s[skip + i])
        .collect();
    Some(Interior {
        x: solution.x,
        active,
        iterations: solution.iterations,
    })
}

fn triplets(m: usize, n: usize, fill: impl FnOnce(&mut dyn FnMut(usize, usize, f64))) -> CscMatrix<f64> {
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    fill(&mut |i, j, value| {
        rows.push(i);
        columns.push(j);
        values.push(value);
    });
    CscMatrix::new_from_triplets(m, n, rows, columns, values)
}
