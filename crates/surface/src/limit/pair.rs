//! What splits limit and tangents off at a centre: the left eigenvector of 1 of its local matrix, and the two
//! eigenvalues after 1 with their vectors, if they dominate all others and their map does not fold over.

use super::centre::times;
use super::local::Local;
use super::rotation::Rotation;
use crate::Error;
use crate::refine::Row;
use eigenring_scheme::Complex;
use eigenring_spectral::{Block, Matrix};

/// Local matrices beyond this size are not decomposed unless they turn with the sectors of a closed fan: the
/// positions of their centres are known, their tangents are not. A boundary vertex of about 450 faces.
const MOST: usize = 900;

/// Moduli of eigenvalues that differ by less than this, relatively, are taken as equal: far above the
/// rounding of simple eigenvalues, 1e-14, and below the distance of any two that schemes have. Empirical.
pub(super) const EQUAL: f64 = 1e-9;

/// Why a normal is not defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undefined {
    /// The two eigenvalues after 1 are not real, or not larger than all others.
    NotDominant,
    /// They have one eigenvector only.
    Defective,
    /// Their map folds over or collapses along a rim.
    NotInjective,
    /// The local matrix is too large to be decomposed.
    TooLarge,
    /// The control points have no tangent plane there.
    Degenerate,
}

impl Undefined {
    /// The reason in words.
    pub fn words(self) -> &'static str {
        match self {
            Undefined::NotDominant => "no dominant pair of eigenvalues",
            Undefined::Defective => "the pair of eigenvalues has one eigenvector",
            Undefined::NotInjective => "the characteristic map is not injective",
            Undefined::TooLarge => "the local matrix is too large",
            Undefined::Degenerate => "the control points are degenerate",
        }
    }
}

/// The dominant pair of a standard centre.
#[derive(Debug)]
pub(crate) struct Pair {
    pub lambda: [f64; 2],
    /// Right eigenvectors, a row for each point.
    pub right: Vec<[f64; 2]>,
    /// Left ones, dual to them.
    pub left: [Vec<f64>; 2],
}

pub(super) fn block(matrix: &[Row]) -> Block<f64> {
    let weight = |row: usize, column: usize| {
        let terms = &matrix[row];
        terms
            .iter()
            .find(|(at, _)| *at as usize == column)
            .map_or(0.0, |term| term.1)
    };
    Block::Real(Matrix::from_fn(matrix.len(), matrix.len(), weight))
}

/// The left eigenvector of 1, whose entries add up to 1.
pub(super) fn limit(matrix: &[Row]) -> Vec<f64> {
    fixed(matrix.len(), |weights| times(weights, matrix))
}

/// Of a matrix that turns: the same at all points of an orbit, and nothing at points outside of the rings.
pub(super) fn limit_turning(rotation: &Rotation) -> Vec<f64> {
    let block = rotation.means();
    let parts = fixed(block.len(), |weights| {
        let column = |j: usize| weights.iter().zip(&block).map(|(w, row)| w * row[j]).sum();
        (0..block.len()).map(column).collect()
    });
    rotation.shared(&parts)
}

/// The row that a map leaves as it is, by its powers: all others vanish, the slowest like the subdominant
/// eigenvalue.
fn fixed(size: usize, map: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut weights = vec![0.0; size];
    weights[0] = 1.0;
    for _ in 0..4000 {
        let next = map(&weights);
        let change = next
            .iter()
            .zip(&weights)
            .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        weights = next;
        if change < 1e-18 {
            break;
        }
    }
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

/// The two eigenvalues after 1, if they dominate all others, with their vectors.
pub(super) struct Leading {
    pub values: [f64; 2],
    pub right: [Vec<f64>; 2],
    pub left: [Vec<f64>; 2],
}

/// Of a dense matrix.
pub(super) fn leading(matrix: &[Row]) -> Result<Result<Leading, Undefined>, Error> {
    if matrix.len() > MOST {
        return Ok(Err(Undefined::TooLarge));
    }
    let block = block(matrix);
    let found = block.eigenvalues()?;
    let all: Vec<Complex<f64>> = found
        .iter()
        .flat_map(|e| std::iter::repeat_n(e.value, e.multiplicity))
        .collect();
    let refuse = |why| Ok(Err(why));
    let [one, first, second, rest @ ..] = all.as_slice() else {
        return refuse(Undefined::NotDominant);
    };
    let third = rest.first().map_or(0.0, |value| value.modulus());
    let real = first.im == 0.0 && second.im == 0.0 && first.re > 0.0 && second.re > 0.0;
    if !real || (one.re - 1.0).abs() > EQUAL || first.re > 1.0 - EQUAL || third > second.re * (1.0 - EQUAL) {
        return refuse(Undefined::NotDominant);
    }
    let real_part = |vectors: &[Vec<Complex<f64>>]| -> Vec<Vec<f64>> {
        vectors.iter().map(|v| v.iter().map(|x| x.re).collect()).collect()
    };
    let (mut right, mut left) = (Vec::new(), Vec::new());
    let values = if first == second {
        vec![*first]
    } else {
        vec![*first, *second]
    };
    for value in values {
        let space = block.eigenspace(value, 0)?;
        right.extend(real_part(&space.right));
        left.extend(real_part(&space.left));
    }
    let (Ok(right), Ok(left)) = (right.try_into(), left.try_into()) else {
        return refuse(Undefined::Defective);
    };
    let values = [first.re, second.re];
    Ok(Ok(Leading { values, right, left }))
}

/// Of a matrix that turns: the pair of blocks 1 and N-1.
pub(super) fn turning(rotation: &Rotation) -> Result<Result<Leading, Undefined>, Error> {
    let refuse = |why| Ok(Err(why));
    let (mut lambda, mut third) = (None, 0.0_f64);
    for k in 0..=rotation.sectors() / 2 {
        let found = rotation.block(k).eigenvalues()?;
        let all: Vec<Complex<f64>> = found
            .iter()
            .flat_map(|e| std::iter::repeat_n(e.value, e.multiplicity))
            .collect();
        let own = usize::from(k < 2);
        match (k, all.first()) {
            (0, Some(one)) if (one.re - 1.0).abs() <= EQUAL => {}
            (1, Some(first)) if first.im.abs() <= 1e-12 && first.re > 0.0 && first.re < 1.0 - EQUAL => {
                lambda = Some(*first);
            }
            (0 | 1, _) => return refuse(Undefined::NotDominant),
            _ => {}
        }
        third = third.max(all.get(own).map_or(0.0, |value| value.modulus()));
    }
    let Some(lambda) = lambda.filter(|lambda| third <= lambda.re * (1.0 - EQUAL)) else {
        return refuse(Undefined::NotDominant);
    };
    let space = rotation.block(1).eigenspace(lambda, 1)?;
    let ([right], [left]) = (space.right.as_slice(), space.left.as_slice()) else {
        return refuse(Undefined::Defective);
    };
    let mut right = rotation.spread(1, right, false);
    for vector in &mut right {
        rotation.continued(lambda.re, vector);
    }
    let left = rotation.spread(1, left, true);
    let values = [lambda.re; 2];
    Ok(Ok(Leading { values, right, left }))
}

/// The pair, if its map does not fold over.
pub(super) fn pair(found: Leading, local: &Local) -> Result<Pair, Undefined> {
    let Leading { values, right, left } = found;
    let ([r0, r1], [l0, l1]) = (&right, &left);
    // L <- (L R)^-1 L
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let gram = [[dot(l0, r0), dot(l0, r1)], [dot(l1, r0), dot(l1, r1)]];
    let determinant = gram[0][0] * gram[1][1] - gram[0][1] * gram[1][0];
    if determinant.abs() < 1e-12 {
        return Err(Undefined::Defective);
    }
    let mixed =
        |a: f64, b: f64| -> Vec<f64> { l0.iter().zip(l1).map(|(x, y)| (a * x + b * y) / determinant).collect() };
    let mut left = [mixed(gram[1][1], -gram[0][1]), mixed(-gram[1][0], gram[0][0])];
    let mut right: Vec<[f64; 2]> = r0.iter().zip(r1).map(|(&x, &y)| [x, y]).collect();
    // the ends of the spokes, or the faces between them, must run round the centre once
    let topology = &local.topology;
    let fan = topology.fan(topology.origin(0));
    let (mut ends, centre): (Vec<u32>, [f64; 2]) = match &local.net {
        Some((net, _)) => {
            let (ends, weights) = net.around(&fan, topology, topology.origin(0));
            let mean = |k: usize| weights.iter().map(|&(at, w)| w * right[at as usize][k]).sum::<f64>();
            let centre = [mean(0), mean(1)];
            (ends, centre)
        }
        None => {
            let heads = fan.spokes.iter().map(|&spoke| topology.head(spoke));
            let ends = heads.chain(fan.last.map(|last| topology.origin(last))).collect();
            (ends, right[topology.origin(0) as usize])
        }
    };
    if fan.is_closed() {
        ends.push(ends[0]);
    }
    let at = |end: u32| [0, 1].map(|k| right[end as usize][k] - centre[k]);
    let turns: Vec<(f64, f64)> = ends
        .windows(2)
        .map(|pair| {
            let (a, b) = (at(pair[0]), at(pair[1]));
            let (cross, along) = (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
            (cross / (a[0].hypot(a[1]) * b[0].hypot(b[1])), cross.atan2(along))
        })
        .collect();
    let sign = turns.iter().map(|turn| turn.0).sum::<f64>().signum();
    let total: f64 = turns.iter().map(|turn| sign * turn.1).sum();
    // at most a turn of a closed fan, up to rounding
    let once = total < std::f64::consts::TAU + 1e-6;
    let size = right.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let apart = ends.iter().all(|&end| at(end).iter().any(|x| x.abs() > 1e-8 * size));
    if !apart || !once || turns.iter().any(|turn| !(sign * turn.0 > 1e-9)) {
        return Err(Undefined::NotInjective);
    }
    if sign < 0.0 {
        right.iter_mut().for_each(|r| r[1] = -r[1]);
        left[1].iter_mut().for_each(|l| *l = -*l);
    }
    Ok(Pair {
        lambda: values,
        right,
        left,
    })
}
