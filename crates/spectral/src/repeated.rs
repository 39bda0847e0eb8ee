//! Repeated eigenvalues of a block, told from different ones that are close.
//!
//! Two computed values are one repeated eigenvalue **if their mean is an eigenvalue, up to rounding, of each
//! strongly connected part of the block that they come from**: if the smallest singular value of the part
//! less the mean is below some rounding units of its norm. A gap of the values says nothing by itself.
//! Rounding by `eps` scatters a defective eigenvalue of index m over a circle of radius `eps^(1/m)`, and at
//! its centre the part is singular to `eps` all the same; between two simple eigenvalues the part is as
//! regular as their distance, over their condition number.
//!
//! Everything is computed with [`Extended`] numbers. Where the rules themselves are known so well, order 32
//! with eigenvalues that agree to 18 digits comes apart; a matrix of doubles has eigenvalues that are known
//! to `2^-53`, one with printed weights to their last digit, and what rounding could make of one eigenvalue
//! is one.

use crate::components::strong_components;
use crate::eigen::order;
use crate::extended::{Extended, UNIT};
use crate::hessenberg::{Hessenberg, Number};
use crate::{Block, EQUAL, Error, Matrix};
use eigenring_scheme::{Complex, Scalar};
use faer::{Mat, c64};

/// An eigenvalue of a block with its multiplicities there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Repeated {
    /// The value.
    pub value: Complex<f64>,
    /// The same in more precision, where the block is real.
    pub extended: Complex<Extended>,
    /// How often it is a root of the characteristic polynomial.
    pub algebraic: usize,
    /// How many independent eigenvectors it has: at least one, and at most `algebraic`, out of which they are
    /// counted.
    pub geometric: usize,
}

/// How well the entries of a block are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Precision {
    /// To so much relative to the largest of them, and to that of doubles at best.
    Rounded(f64),
    /// To that of [`Extended`].
    Extended,
}

impl Precision {
    /// The rounding unit of the entries, with room for the operations that made them.
    fn unit(self) -> f64 {
        match self {
            Precision::Rounded(unit) => unit.max(8.0 * f64::EPSILON),
            Precision::Extended => UNIT,
        }
    }

    /// Entries below this times the largest are rounding errors of zeros.
    fn negligible(self) -> f64 {
        match self {
            Precision::Rounded(unit) => unit.max(1e-15),
            Precision::Extended => 8.0 * UNIT,
        }
    }

    /// Values farther apart than this times the norm are different: rounding scatters a defective eigenvalue
    /// less far, up to an index of 2 in doubles, and of 6 otherwise.
    fn reach(self) -> f64 {
        match self {
            Precision::Rounded(unit) => unit.sqrt().max(EQUAL),
            Precision::Extended => 1e-12,
        }
    }

    /// A pivot of the block less an eigenvalue below this times the largest is zero. A repeated eigenvalue
    /// with all its vectors leaves rounding; a defective one leaves what couples its vectors, which is no
    /// matter of rounding: half the digits stand between.
    pub(crate) fn null(self) -> f64 {
        match self {
            Precision::Rounded(unit) => (64.0 * unit).max(crate::NULL),
            Precision::Extended => 1e-50,
        }
    }
}

/// A strongly connected part of a block.
enum Part {
    Real(Hessenberg),
    Complex(Mat<c64>),
}

/// Values that are taken as one.
#[derive(Clone, Debug)]
struct Cluster {
    mean: Complex<Extended>,
    count: usize,
    /// The parts that they come from.
    parts: Vec<usize>,
    /// Nothing farther away than this is in question: something closer was found to be different.
    reach: f64,
}

/// The eigenvalues of a block by falling modulus.
///
/// # Errors
/// [`Error::Decomposition`] if an entry is not finite or the iteration fails.
pub(crate) fn repeated(block: &Block<Extended>, precision: Precision) -> Result<Vec<Repeated>, Error> {
    let size = block.size();
    let entry = |i: usize, j: usize| match block {
        Block::Real(matrix) => Complex::real(matrix[(i, j)]),
        Block::Complex(matrix) => matrix[(i, j)],
    };
    let places = || (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
    let largest = places().map(|(i, j)| entry(i, j).size()).fold(
        0.0,
        |max: f64, x| {
            if x.is_nan() { f64::NAN } else { max.max(x) }
        },
    );
    let failure = || Error::Decomposition { size, largest };
    if !largest.is_finite() {
        return Err(failure());
    }
    let components = strong_components(size, |i, j| entry(i, j).size() > precision.negligible() * largest);
    // complex blocks are decomposed in doubles
    let precision = match block {
        Block::Real(_) => precision,
        Block::Complex(_) => match precision {
            Precision::Extended => Precision::Rounded(0.0),
            rounded => rounded,
        },
    };
    let (mut parts, mut clusters, mut norm) = (Vec::new(), Vec::new(), 0.0_f64);
    for component in components {
        let n = component.len();
        let (part, values) = match block {
            Block::Real(matrix) => {
                let part = Hessenberg::new(&Matrix::from_fn(n, n, |i, j| matrix[(component[i], component[j])]));
                let values = part.eigenvalues().ok_or_else(failure)?;
                norm = norm.max(part.norm());
                (Part::Real(part), values)
            }
            Block::Complex(_) => {
                let part = Mat::from_fn(n, n, |i, j| {
                    let entry = entry(component[i], component[j]).map(Extended::to_f64);
                    c64::new(entry.re, entry.im)
                });
                let values = part.eigenvalues().map_err(|_| failure())?;
                let values = values.iter().map(|v| Complex::new(v.re, v.im).map(Extended::exact));
                norm = norm.max(
                    (0..n)
                        .map(|i| (0..n).map(|j| part[(i, j)].norm()).sum())
                        .fold(0.0, f64::max),
                );
                let values = values.collect();
                (Part::Complex(part), values)
            }
        };
        clusters.extend(values.into_iter().map(|mean| Cluster {
            mean,
            count: 1,
            parts: vec![parts.len()],
            reach: precision.reach() * norm,
        }));
        parts.push(part);
    }
    let tolerance = 8.0 * precision.unit() * norm;
    let mut failed = false;
    join(&mut clusters, |part, value| {
        let distance = parts[part].distance(value);
        failed |= distance.is_none();
        distance.is_some_and(|distance| distance <= tolerance)
    });
    if failed {
        return Err(failure());
    }
    for cluster in &mut clusters {
        // zeros are exact
        if cluster.mean.size() <= tolerance {
            cluster.mean = Complex::default();
        }
        // the mean of a conjugate pair, or of what rounding made one; a complex block may be similar to a
        // real one, and what its rounding could make of a real eigenvalue is real
        let imaginary = cluster.mean.im.size();
        let real = || Complex::new(cluster.mean.re, Extended::default());
        if imaginary <= tolerance && matches!(block, Block::Real(_))
            || imaginary <= cluster.reach
                && matches!(block, Block::Complex(_))
                && cluster.parts.iter().all(|&part| {
                    parts[part]
                        .distance(real())
                        .is_some_and(|distance| distance <= tolerance)
                })
        {
            cluster.mean.im = Extended::default();
        }
    }
    clusters.sort_by(|a, b| {
        let [x, y] = [a, b].map(|c| c.mean.map(Extended::to_f64));
        order(x, y).then((b.mean.re.abs() - a.mean.re.abs()).to_f64().total_cmp(&0.0))
    });
    clusters
        .into_iter()
        .map(|cluster| {
            let value = cluster.mean.map(Extended::to_f64);
            let geometric = match (cluster.count, block) {
                (1, _) => 1,
                (count, Block::Real(matrix)) => {
                    let null = precision.null() * value.modulus().max(largest);
                    let pivots = if cluster.mean.im.size() == 0.0 {
                        pivots(matrix.clone(), cluster.mean.re)
                    } else {
                        pivots(matrix.map(Complex::real), cluster.mean)
                    };
                    pivots[size - count..].iter().filter(|&&pivot| pivot <= null).count()
                }
                (count, Block::Complex(matrix)) => {
                    let doubles = matrix.map(|entry| entry.map(Extended::to_f64));
                    Block::Complex(doubles).nullity(value, precision.null())?.min(count)
                }
            };
            Ok(Repeated {
                value,
                extended: cluster.mean,
                algebraic: cluster.count,
                geometric: geometric.max(1),
            })
        })
        .collect()
}

impl Part {
    /// The smallest singular value of the part less a number; `None` if it is not found.
    fn distance(&self, value: Complex<Extended>) -> Option<f64> {
        match self {
            Part::Real(part) => Some(part.distance(value)),
            Part::Complex(part) => {
                let n = part.nrows();
                let value = value.map(Extended::to_f64);
                let value = c64::new(value.re, value.im);
                let shifted = Mat::from_fn(n, n, |i, j| if i == j { part[(i, j)] - value } else { part[(i, j)] });
                shifted.singular_values().ok()?.last().copied()
            }
        }
    }
}

fn gap(a: &Cluster, b: &Cluster) -> f64 {
    (a.mean - b.mean).size()
}

/// Joins clusters, the closest first, as long as their mean is an eigenvalue of all parts that they come
/// from.
fn join(clusters: &mut Vec<Cluster>, mut is_eigenvalue: impl FnMut(usize, Complex<Extended>) -> bool) {
    let close = |a: &Cluster, b: &Cluster| {
        let gap = gap(a, b);
        (gap <= a.reach.min(b.reach)).then_some(gap)
    };
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    let mut current: Vec<Option<Cluster>> = clusters.drain(..).map(Some).collect();
    for j in 0..current.len() {
        pairs.extend(pairs_with(&current, j, close));
    }
    let by_gap =
        |a: &(f64, usize, usize), b: &(f64, usize, usize)| b.0.total_cmp(&a.0).then((b.1, b.2).cmp(&(a.1, a.2)));
    pairs.sort_by(by_gap);
    while let Some((_, i, j)) = pairs.pop() {
        let (Some(a), Some(b)) = (&current[i], &current[j]) else {
            continue;
        };
        let Some(gap) = close(a, b) else { continue };
        let count = a.count + b.count;
        let mean = |x: Extended, y: Extended| {
            let weight = |count: usize| Extended::ratio(count as i64, 1);
            (x * weight(a.count) + y * weight(b.count)) / weight(count)
        };
        let mean = Complex::new(mean(a.mean.re, b.mean.re), mean(a.mean.im, b.mean.im));
        let mut parts = [a.parts.clone(), b.parts.clone()].concat();
        parts.sort_unstable();
        parts.dedup();
        if parts.iter().all(|&part| is_eigenvalue(part, mean)) {
            let reach = a.reach.min(b.reach);
            (current[i], current[j]) = (None, None);
            current.push(Some(Cluster {
                mean,
                count,
                parts,
                reach,
            }));
            pairs.extend(pairs_with(&current, current.len() - 1, close));
            pairs.sort_by(by_gap);
        } else {
            for index in [i, j] {
                if let Some(cluster) = &mut current[index] {
                    // something as close may still be the same: rounding scatters in all directions
                    cluster.reach = cluster.reach.min(16.0 * gap);
                }
            }
        }
    }
    clusters.extend(current.into_iter().flatten());
}

/// The close pairs of cluster `j` with those before it.
fn pairs_with(
    clusters: &[Option<Cluster>],
    j: usize,
    close: impl Fn(&Cluster, &Cluster) -> Option<f64>,
) -> Vec<(f64, usize, usize)> {
    let Some(b) = &clusters[j] else { return Vec::new() };
    let before = clusters[..j].iter().enumerate();
    before
        .filter_map(|(i, a)| Some((close(a.as_ref()?, b)?, i, j)))
        .collect()
}

/// The pivots of elimination with full pivoting of a matrix less a number, falling: as many are of the size
/// of rounding as its null space has dimensions.
fn pivots<T: Number>(mut m: Matrix<T>, value: T) -> Vec<f64> {
    let n = m.rows();
    (0..n).for_each(|i| m[(i, i)] = m[(i, i)] - value);
    let mut open_columns: Vec<usize> = (0..n).collect();
    // the largest entry of each row in the open columns
    let leading = |row: &[T], columns: &[usize]| {
        let sizes = columns.iter().map(|&j| (row[j].size(), j));
        sizes.fold(
            (0.0, usize::MAX),
            |best: (f64, usize), next| if next.0 > best.0 { next } else { best },
        )
    };
    let mut rows: Vec<(f64, usize, usize)> = (0..n)
        .map(|i| {
            let (size, column) = leading(m.row(i), &open_columns);
            (size, column, i)
        })
        .collect();
    let mut pivots = vec![0.0; n];
    for pivot in &mut pivots {
        let best = (0..rows.len()).fold(0, |best, i| if rows[i].0 > rows[best].0 { i } else { best });
        let (size, column, row) = rows.swap_remove(best);
        *pivot = size;
        if size == 0.0 {
            break;
        }
        let above: Vec<T> = m.row(row).to_vec();
        open_columns.retain(|&j| j != column);
        for entry in &mut rows {
            let below = m.row_mut(entry.2);
            if below[column].size() != 0.0 {
                let factor = below[column] / above[column];
                for &j in &open_columns {
                    if above[j].size() != 0.0 {
                        below[j] = below[j] - factor * above[j];
                    }
                }
                (entry.0, entry.1) = leading(below, &open_columns);
            }
        }
    }
    pivots
}
