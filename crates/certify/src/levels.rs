//! Levels that differ: whether C1 carries over from the limit level.
//!
//! Let `S_l` be the local matrices of the levels and S that of the limit level. Rows of all sum to 1, so that
//! differences from the centre are mapped to such. If S has the subdominant pair lambda and `sum_l lambda^-l
//! |S_l - S|` is finite, then `lambda^-m S_(m-1) .. S_0` tends, on these differences, to `R L^(0)`: R is the
//! pair's eigenvectors, `L^(0)` a pair of functionals of the control net. Where `L^(0)` does not vanish, the
//! rings of almost all nets tend, after scaling, to affine images of the characteristic map of S, and the
//! surface is C1 with it (asymptotic equivalence: Dyn and Levin 1995, *Analysis of asymptotically equivalent
//! binary subdivision schemes*, for the regular part; Conti, Donatelli, Romani and Novara 2019, *Convergence
//! and normal continuity analysis of non-stationary subdivision schemes near extraordinary vertices and
//! faces*, for the centre). For the tension scheme the hypotheses are checked here:
//!
//! * `u_(l+1) - 1 = (u_l - 1) / (2 (1 + u_(l+1)))`, which for `u_0 > -1` tends to 0, eventually faster than
//!   `q^l` for every q above 1/4; weights are rational functions of u with poles at -1 only, so that `|S_l -
//!   S|` does as well. The sum is finite **if lambda > 1/4**, and with it the one that the regular part
//!   needs, `sum 2^l |S_l - S|`;
//! * rows of all levels sum to 1: [`rows::row_sums`](crate::rows);
//! * `L^(0)`, the left eigenvector of S in block 1 times the blocks of the leading levels, is enclosed and
//!   has an entry that is certainly not zero. From the last listed level on u is 1 to rounding.

use crate::linear::eigenpair;
use crate::{Check, Interval, Statement, Subject};
use eigenring_spectral::{Block, Matrix, fourier_block};

/// `levels`, for schemes that have leading levels.
pub fn levels(subject: &Subject, lambda: Option<Interval>) -> Option<Check> {
    const NAME: Statement = Statement::Levels;
    if subject.scheme.leading().is_empty() {
        return None;
    }
    if !subject.tends_like_tension {
        return Some(Check::undecided(
            NAME,
            "how the levels tend to the limit level is not known",
        ));
    }
    let Some(lambda) = lambda else {
        return Some(Check::undecided(NAME, "no subdominant eigenvalue was proven"));
    };
    if !lambda.certainly_gt(Interval::point(0.25)) {
        let text = format!("the levels tend to the limit level like 4^-l, and lambda = {lambda} is not above 1/4");
        return Some(Check::undecided(NAME, text));
    }
    if !pair_survives(subject, lambda).unwrap_or(false) {
        let text = "the leading levels may map all nets to ones without tangents";
        return Some(Check::undecided(NAME, text));
    }
    let margin = (lambda - Interval::point(0.25)).lo();
    Some(
        Check::proven(NAME)
            .margin(margin)
            .remark("levels tend to the limit level like 4^-l, and lambda > 1/4"),
    )
}

/// Whether the leading levels leave some net with tangents.
fn pair_survives(subject: &Subject, lambda: Interval) -> Option<bool> {
    let scheme = &subject.scheme;
    let rings = scheme.closed_rings().ok()?;
    let block = |level: usize| match fourier_block(scheme.level(level), rings, 1).ok()? {
        Block::Real(matrix) => Some(matrix),
        Block::Complex(_) => None,
    };
    let count = scheme.leading().len();
    let limit = block(count)?;
    let transposed = Matrix::from_fn(limit.rows(), limit.rows(), |i, j| limit[(j, i)]);
    let rough = Block::Real(transposed.map(Interval::mid))
        .eigenspace((lambda.mid(), 0.0), 1)
        .ok()?;
    let [vector] = rough.right.as_slice() else { return None };
    let vector: Vec<f64> = vector.iter().map(|entry| entry.0).collect();
    let left = eigenpair(&transposed, lambda.mid(), &vector)?;
    if left.value.disjoint(lambda) {
        return None;
    }
    let mut functional = left.vector;
    let scale = Interval::point(lambda.mid());
    for level in (0..count).rev() {
        let matrix = block(level)?;
        functional = (0..matrix.rows())
            .map(|j| {
                let terms = functional
                    .iter()
                    .enumerate()
                    .map(|(i, &weight)| weight * matrix[(i, j)]);
                terms.sum::<Interval>() / scale
            })
            .collect();
    }
    Some(functional.iter().any(|entry| entry.certainly_nonzero()))
}
