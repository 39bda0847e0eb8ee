//! Levels that differ: whether C1 carries over from the limit level.
//!
//! Let `S_l` be the local matrices of the levels and S that of the limit level. Rows of all sum to 1, so that
//! all map constants to themselves. Let S have the subdominant pair lambda, or the pair `lambda_1 > lambda_2`
//! of different eigenvalues, and let lambda be the smaller of the two.
//!
//! **Theorem.** If `|S_l - S| <= c q^l` with `M q < lambda`, M a bound of all `|S_l|`, then `y_m = S_(m-1) ..
//! S_0 y_0` is, up to a constant net, `r_1 lambda_1^m (l_1 y_0) + r_2 lambda_2^m (l_2 y_0) + o(lambda^m)`: r
//! are the eigenvectors of the pair, and `l_i = lim w_i S_(m-1) .. S_0 / lambda_i^m` exist, w being the left
//! eigenvectors. Where `l_1` and `l_2` are linearly independent the rings of almost all nets thus tend, after
//! scaling, to affine images of the characteristic map of S, and the surface is C1 with it.
//!
//! *Why.* The parts of y along `r_1, r_2` and along the complement Z of both and of the constants are driven
//! by `(S_l - S) y_l`, of size `q^l lambda_1^l` at most: against `lambda_i^l` that is summable, and on Z,
//! where S has only smaller eigenvalues, what accumulates is `o(lambda^m)`. The ring of level m is the image
//! of `y_m` under the basis functions of the levels from m on, which differ from those of S in C1 by the
//! order of `q^m`, since `sum 2^l |S_l - S|` is finite (asymptotic equivalence: Dyn and Levin 1995, *Analysis
//! of asymptotically equivalent binary subdivision schemes*; around the centre Conti, Donatelli, Romani and
//! Novara 2019, *Convergence and normal continuity analysis of non-stationary subdivision schemes near
//! extraordinary vertices and faces*); times `lambda_1^m` that is again `o(lambda^m)`.
//!
//! For the tension scheme the hypotheses are checked here:
//!
//! * the decay, with q near 1/4 and all levels beyond the leading ones at once: [`Tail`];
//! * rows of all levels sum to 1: [`rows::row_sums`](crate::rows);
//! * the functionals: w is enclosed, what the tail changes in it is bounded in the 1-norm
//!   ([`Tail::drift`]), and the leading levels are multiplied on. In block 1 one functional of complex nets
//!   stands for the pair, and must have an entry that is certainly not zero; of different eigenvalues two
//!   functionals must have a minor of order two that is not zero.
//!
//! A bound of the 1-norm over points bounds the coefficients on the unknowns of a Fourier block, whose unit
//! vectors are nets of modulus 0 and 1; and the 1-norm of coefficients on unknowns bounds that over points
//! ([`FourierNet::functional`](eigenring_scheme::FourierNet::functional)).

mod tail;

pub use tail::Tail;

use crate::linear::{eigenpair, solve};
use crate::{Check, Interval, Statement, Subject};
use eigenring_scheme::Complex;
use eigenring_spectral::{Block, Matrix, fourier_block, local_matrix};

/// What is known of the levels beyond the leading ones.
#[derive(Clone, Debug)]
pub enum Beyond {
    /// Nothing, or there are no leading levels.
    Unknown,
    /// Around the centre they are the limit level. Knot intervals differ from those of the limit level at
    /// distances from the centre that double with each level, and after the leading ones begin eight edges
    /// out.
    Same,
    /// They tend to the limit level as those of the tension scheme do.
    Tail(Box<Tail>),
}

impl Beyond {
    /// The levels that are not the limit level.
    pub fn tail(&self) -> Option<&Tail> {
        match self {
            Beyond::Tail(tail) => Some(tail),
            Beyond::Unknown | Beyond::Same => None,
        }
    }
}

/// A subdominant pair.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// The eigenvalue of Fourier index 1, or both of rules that differ from sector to sector, the larger
    /// first.
    pub values: &'a [Interval],
    /// Two eigenvectors of a double eigenvalue of rules that differ from sector to sector, which are all of
    /// them.
    pub double: Option<&'a [Vec<Interval>; 2]>,
}

/// `levels`, for schemes that have leading levels.
pub fn levels(subject: &Subject, pair: Option<Pair<'_>>) -> Option<Check> {
    const NAME: Statement = Statement::Levels;
    if subject.scheme.leading().is_empty() {
        return None;
    }
    if let Beyond::Unknown = subject.beyond {
        let text = "how the levels tend to the limit level is not known";
        return Some(Check::undecided(NAME, text));
    }
    let least = pair.and_then(|pair| pair.values.last().copied());
    let (Some(pair), Some(least)) = (pair, least) else {
        return Some(Check::undecided(NAME, "no subdominant eigenvalue was proven"));
    };
    let quarter = Interval::point(0.25);
    let tail = subject.beyond.tail();
    if tail.is_some() && !least.certainly_gt(quarter) {
        let text = format!("the levels tend to the limit level like 4^-l, and lambda = {least} is not above 1/4");
        return Some(Check::undecided(NAME, text));
    }
    if !pair_survives(subject, tail, pair).unwrap_or(false) {
        let text = "the levels may map all nets to ones without tangents";
        return Some(Check::undecided(NAME, text));
    }
    Some(match tail {
        Some(_) => Check::proven(NAME)
            .margin((least - quarter).lo())
            .remark("all levels tend to the limit level like 4^-l, and lambda > 1/4"),
        None => Check::proven(NAME).remark(format!(
            "after {} levels all are the limit level around the centre",
            subject.scheme.leading().len()
        )),
    })
}

/// Whether the levels leave some net with tangents.
fn pair_survives(subject: &Subject, tail: Option<&Tail>, pair: Pair<'_>) -> Option<bool> {
    let scheme = &subject.scheme;
    // leading levels may reach farther than the limit level
    let mut rings = scheme.closed_rings().ok()?;
    for level in scheme.leading() {
        rings = rings.max(level.closed_rings().ok()?);
    }
    let matrix = |level: usize| {
        let level = scheme.level(level);
        if !level.is_rotation_symmetric() {
            return local_matrix(level, rings).ok();
        }
        match fourier_block(level, rings, 1).ok()? {
            Block::Real(matrix) => Some(matrix),
            Block::Complex(_) => None,
        }
    };
    let count = scheme.leading().len();
    let limit = matrix(count)?;
    let left = match pair.double {
        None => pair
            .values
            .iter()
            .map(|&lambda| left_eigenvector(&limit, lambda))
            .collect::<Option<_>>()?,
        Some(vectors) => left_eigenvectors(&limit, *pair.values.first()?, vectors)?,
    };
    let mut functionals = Vec::with_capacity(left.len());
    for (left, &lambda) in left.into_iter().zip(pair.values) {
        let size = left.iter().map(|x| Interval::point(x.mag())).sum();
        let drift = match tail {
            Some(tail) => tail.drift(lambda, size).ok()??,
            None => 0.0,
        };
        functionals.push(
            left.into_iter()
                .map(|x| x + Interval::around(0.0, drift))
                .collect::<Vec<_>>(),
        );
    }
    for level in (0..count).rev() {
        let matrix = matrix(level)?;
        for (functional, lambda) in functionals.iter_mut().zip(pair.values) {
            // the scale is of no account, and this one keeps it moderate
            let scale = Interval::point(lambda.mid());
            *functional = times(functional, &matrix).into_iter().map(|x| x / scale).collect();
        }
    }
    Some(match functionals.as_slice() {
        [one] => one.iter().any(|entry| entry.certainly_nonzero()),
        [first, second] => {
            let minor = |i: usize, j: usize| first[i] * second[j] - first[j] * second[i];
            (0..first.len()).any(|i| (0..i).any(|j| minor(i, j).certainly_nonzero()))
        }
        _ => false,
    })
}

/// Two independent left eigenvectors of an eigenvalue with the two given right ones x, y, and no others.
///
/// With `A = S - lambda` and `X = [x, y]` they are the w of `A^T w + X s = 0`, `X^T w = e_i`: as `X^T A^T =
/// 0`, a solution has `X^T X s = 0`, hence `s = 0`.
fn left_eigenvectors(
    matrix: &Matrix<Interval>,
    lambda: Interval,
    right: &[Vec<Interval>; 2],
) -> Option<Vec<Vec<Interval>>> {
    let size = matrix.rows();
    if right.iter().any(|vector| vector.len() < size) {
        return None;
    }
    let zero = Interval::point(0.0);
    let bordered = Matrix::from_fn(size + 2, size + 2, |i, j| match (i < size, j < size) {
        (true, true) => matrix[(j, i)] - if i == j { lambda } else { zero },
        (true, false) => right[j - size][i],
        (false, true) => right[i - size][j],
        (false, false) => zero,
    });
    let unit = |at: usize| {
        (0..size + 2)
            .map(|i| Interval::point(f64::from(i == size + at)))
            .collect::<Vec<_>>()
    };
    (0..2)
        .map(|at| {
            let mut solution = solve(&bordered, &unit(at))?;
            solution.truncate(size);
            Some(solution)
        })
        .collect()
}

/// A left eigenvector of a simple eigenvalue.
fn left_eigenvector(matrix: &Matrix<Interval>, lambda: Interval) -> Option<Vec<Interval>> {
    let transposed = Matrix::from_fn(matrix.rows(), matrix.rows(), |i, j| matrix[(j, i)]);
    let rough = Block::Real(transposed.map(Interval::mid))
        .eigenspace(Complex::real(lambda.mid()), 1)
        .ok()?;
    let [vector] = rough.right.as_slice() else { return None };
    let vector: Vec<f64> = vector.iter().map(|entry| entry.re).collect();
    let left = eigenpair(&transposed, lambda.mid(), &vector)?;
    (!left.value.disjoint(lambda)).then_some(left.vector)
}

/// A row times a matrix.
fn times(row: &[Interval], matrix: &Matrix<Interval>) -> Vec<Interval> {
    let entry = |j: usize| row.iter().enumerate().map(|(i, &x)| x * matrix[(i, j)]).sum();
    (0..matrix.columns()).map(entry).collect()
}
