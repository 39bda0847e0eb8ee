//! The Jordan form of a block, with right and left vectors, in extended precision.
//!
//! The right vectors of a chain are `S r_1 = value r_1` and `S r_j = value r_j + r_(j-1)`, its left ones
//! `l_j S = value l_j + l_(j+1)`, the last an eigenvector, and all are dual, `l_i . r_j = delta_ij`: with
//! rows L and columns R, `L S R` is the Jordan form.
//!
//! The null spaces of `(S - value)^p`, with p the size of the largest Jordan block, are bases W of the
//! generalised eigenspace and U of its dual; with `U W = I`, `U S W` is the block restricted to it, whose
//! trace gives the value with twice as many digits, and whose nilpotent part has a Jordan form that is found
//! by ranks, the longest chains first.

use crate::echelon::PIVOT;
use crate::extended::Extended;
use crate::hessenberg::Number;
use crate::repeated::{Precision, repeated};
use crate::spectrum::{MAX_EXTENDED, MAX_LIFTED};
use crate::{Block, Error, LocalSystem, Matrix, local_matrix, matrix::Assembly};
use eigenring_scheme::{Complex, FourierNet, Level, Site};

/// A value is corrected by the trace as often as this, in doubles that do not converge further.
const STEPS: usize = 5;

/// Corrections below this times the largest entry are rounding.
const CORRECTED: f64 = 1e-70;

/// Entries below this times the largest are zeros: a tenth of the digits for what elimination loses.
const ZERO: f64 = 1e-60;

/// A Jordan chain of a local matrix; of length one, an eigenvector.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The eigenvalue.
    pub value: Complex<f64>,
    /// The Fourier index, at most N/2: those of block N-k are the conjugates. `None` without blocks.
    pub fourier: Option<usize>,
    /// Values at the points, the eigenvector first. Its first entry that is not small, rings outwards and the
    /// centre last, is 1.
    pub right: Vec<Vec<Complex<f64>>>,
    /// Weights of the points, dual to the right vectors.
    pub left: Vec<Vec<Complex<f64>>>,
}

/// The right and the left vectors of a chain.
pub(crate) type Dual<T> = (Vec<Vec<T>>, Vec<Vec<T>>);

/// The chains of one eigenvalue, in the unknowns of a block.
pub(crate) struct Vectors<T> {
    pub chains: Vec<Dual<T>>,
}

impl LocalSystem {
    /// All chains, block by block and by falling modulus, from the rules of the same level in [`Extended`]
    /// numbers, or if there are none from the doubles; rounded to doubles at the end.
    ///
    /// # Errors
    /// [`Error::Large`] for blocks of more unknowns than extended numbers are for;
    /// [`Error::Decomposition`] where an entry is not finite, or null spaces are not found.
    pub fn chains(&self, level: Option<&Level<Extended>>) -> Result<Vec<Chain>, Error> {
        let precision = if level.is_some() {
            Precision::Extended
        } else {
            Precision::Rounded(0.0)
        };
        let most = if level.is_some() { MAX_EXTENDED } else { MAX_LIFTED };
        let size = self.blocks().iter().map(Block::size).fold(0, usize::max);
        if size > most {
            return Err(Error::Large { size, most });
        }
        let numbering = self.numbering();
        let sites = numbering.sites();
        let assembly = match level {
            Some(level) if self.symmetric() => Some(Assembly::new(level, numbering.rings)?),
            _ => None,
        };
        let mut all = Vec::new();
        for (index, doubles) in self.blocks().iter().enumerate() {
            let block = match (&assembly, level) {
                (Some(assembly), _) => assembly.block(index)?,
                (None, Some(level)) => Block::Real(local_matrix(level, numbering.rings)?),
                (None, None) => doubles.lifted(),
            };
            let net = match self.symmetric() {
                true => Some(FourierNet::<Extended>::new(numbering, index, self.has_mirror())?),
                false => None,
            };
            // the centre is the first unknown of block 0
            let centre = net
                .as_ref()
                .map_or(0, |net| usize::from(net.rows().first() == Some(&Site::CENTRE)));
            for (value, chains) in block.vectors(precision, centre)? {
                for (right, left) in chains {
                    all.push(spread(net.as_ref(), &sites, value, index, right, left)?);
                }
            }
        }
        Ok(all)
    }
}

/// A chain over all sites, from the unknowns of a block.
fn spread(
    net: Option<&FourierNet<Extended>>,
    sites: &[Site],
    value: Complex<f64>,
    index: usize,
    right: Vec<Vec<Complex<Extended>>>,
    left: Vec<Vec<Complex<Extended>>>,
) -> Result<Chain, Error> {
    let (mut right, mut left) = match net {
        Some(net) => {
            let values = |unknowns: &Vec<Complex<Extended>>| -> Result<Vec<Complex<Extended>>, Error> {
                let value = |&site: &Site| Ok(net.mode(unknowns, site)?);
                sites.iter().map(value).collect()
            };
            let weights = |coefficients: &Vec<Complex<Extended>>| -> Result<Vec<Complex<Extended>>, Error> {
                let weight = |&site: &Site| Ok(net.functional(coefficients, site)?);
                sites.iter().map(weight).collect()
            };
            (
                right.iter().map(values).collect::<Result<Vec<_>, _>>()?,
                left.iter().map(weights).collect::<Result<Vec<_>, _>>()?,
            )
        }
        None => (right, left),
    };
    // unknowns off the spokes carry a phase: the value at the pivot is 1 once it is turned
    let centre = usize::from(net.is_some() && sites.first() == Some(&Site::CENTRE));
    if let Some(pivot) = pivot(&right[0], centre) {
        let at = right[0][pivot];
        let forth = Complex::<Extended>::one() / at;
        let turn = |vectors: &mut Vec<Vec<Complex<Extended>>>, by: Complex<Extended>| {
            for x in vectors.iter_mut().flatten() {
                *x = *x * by;
            }
        };
        turn(&mut right, forth);
        turn(&mut left, at);
    }
    let round = |vectors: Vec<Vec<Complex<Extended>>>| {
        let vector = |v: Vec<Complex<Extended>>| {
            let null = ZERO * v.iter().map(|x| x.size()).fold(0.0, f64::max);
            let part = |x: Extended| if x.size() <= null { 0.0 } else { x.to_f64() };
            v.into_iter().map(|x| x.map(part)).collect()
        };
        vectors.into_iter().map(vector).collect()
    };
    Ok(Chain {
        value,
        fourier: net.map(|_| index),
        right: round(right),
        left: round(left),
    })
}

/// The first entry of a vector, the first `centre` ones last, that is not small.
fn pivot<T: Number>(vector: &[T], centre: usize) -> Option<usize> {
    let length = vector.iter().map(|x| x.size() * x.size()).sum::<f64>().sqrt();
    let order = (0..vector.len()).map(|i| (i + centre) % vector.len());
    order.into_iter().find(|&i| vector[i].size() > PIVOT * length)
}

type Chains = Vec<Dual<Complex<Extended>>>;

impl Block<Extended> {
    /// The chains of all eigenvalues, by falling modulus.
    pub(crate) fn vectors(&self, precision: Precision, centre: usize) -> Result<Vec<(Complex<f64>, Chains)>, Error> {
        let mut all = Vec::new();
        for found in repeated(self, precision)? {
            let Complex { re, im } = found.extended;
            let chains = match self {
                Block::Real(matrix) if im.to_f64() == 0.0 => {
                    let vectors = vectors(matrix, re, found.algebraic, found.geometric, precision, centre)?;
                    let convert = |v: Vec<Vec<Extended>>| -> Vec<Vec<Complex<Extended>>> {
                        let pair = |v: Vec<Extended>| v.into_iter().map(Complex::real).collect();
                        v.into_iter().map(pair).collect()
                    };
                    vectors
                        .chains
                        .into_iter()
                        .map(|(r, l)| (convert(r), convert(l)))
                        .collect()
                }
                _ => {
                    let matrix = self.to_complex();
                    let value = Complex::new(re, im);
                    vectors(&matrix, value, found.algebraic, found.geometric, precision, centre)?.chains
                }
            };
            all.push((found.value, chains));
        }
        Ok(all)
    }
}

/// The chains of an eigenvalue of a matrix with known multiplicities; its first `centre` unknowns come last
/// in the echelon form.
///
/// # Errors
/// [`Error::Decomposition`] if left and right null spaces are not dual.
pub(crate) fn vectors<T: Number>(
    matrix: &Matrix<T>,
    value: T,
    algebraic: usize,
    geometric: usize,
    precision: Precision,
    centre: usize,
) -> Result<Vectors<T>, Error> {
    let n = matrix.rows();
    let largest = matrix.entries().iter().fold(0.0_f64, |max, x| max.max(x.size()));
    let failure = || Error::Decomposition { size: n, largest };
    let mut value = value;
    let mut step = 0;
    loop {
        let shifted = minus(matrix, value);
        let index = if geometric == algebraic {
            1
        } else {
            index(&shifted, algebraic, precision)
        };
        let mut power = shifted.clone();
        for _ in 1..index {
            power = product(&power, &shifted);
        }
        let right = kernel(&power, algebraic);
        let left = kernel(&transposed(&power), algebraic);
        let left = dual(&left, &right).ok_or_else(failure)?;
        // the restriction of S - value
        let images: Vec<Vec<T>> = right.iter().map(|r| times(&shifted, r)).collect();
        let small = Matrix::from_fn(algebraic, algebraic, |i, j| dot(&left[i], &images[j]));
        let trace = (0..algebraic).fold(T::real(0.0), |sum, i| sum + small[(i, i)]);
        let correction = trace / T::real(algebraic as f64);
        // zero is exact
        if value.size() > 0.0 && correction.size() > CORRECTED * largest && step < STEPS {
            value = value + correction;
            step += 1;
            continue;
        }
        let scale = small.entries().iter().fold(0.0_f64, |max, x| max.max(x.size()));
        let inner = if geometric == algebraic || scale == 0.0 {
            let unit = |j: usize| (0..algebraic).map(|i| T::real(f64::from(u8::from(i == j)))).collect();
            (0..algebraic).map(|j| vec![unit(j)]).collect()
        } else {
            nilpotent(&small, precision.null().sqrt(), scale)
        };
        return finish(inner, [&right, &left], centre).ok_or_else(failure);
    }
}

/// The chains from those of the restriction, scaled.
fn finish<T: Number>(inner: Vec<Vec<Vec<T>>>, [right, left]: [&[Vec<T>]; 2], centre: usize) -> Option<Vectors<T>> {
    let n = right[0].len();
    let combine = |weights: &[T]| -> Vec<T> {
        let entry = |i: usize| {
            weights
                .iter()
                .zip(right)
                .fold(T::real(0.0), |sum, (&w, r)| sum + w * r[i])
        };
        (0..n).map(entry).collect()
    };
    let mut chains: Vec<Vec<Vec<T>>> = inner
        .iter()
        .map(|chain| chain.iter().map(|w| combine(w)).collect())
        .collect();
    if chains.iter().all(|chain| chain.len() == 1) {
        let vectors = echelon(chains.into_iter().flatten().collect(), centre);
        chains = vectors.into_iter().map(|v| vec![v]).collect();
    } else {
        for chain in &mut chains {
            let at = pivot(&chain[0], centre)?;
            let by = T::real(1.0) / chain[0][at];
            chain.iter_mut().flatten().for_each(|x| *x = *x * by);
            // the others are determined up to those before them: zero where the eigenvector is 1
            for back in 1..chain.len() {
                let factor = chain[back][at];
                for i in (back..chain.len()).rev() {
                    let before = chain[i - back].clone();
                    chain[i].iter_mut().zip(before).for_each(|(x, b)| *x = *x - factor * b);
                }
            }
        }
    }
    let flat: Vec<Vec<T>> = chains.iter().flatten().cloned().collect();
    let mut left = dual(left, &flat)?.into_iter();
    let chains = chains.into_iter().map(|chain| {
        let count = chain.len();
        (chain, left.by_ref().take(count).collect())
    });
    Some(Vectors {
        chains: chains.collect(),
    })
}

/// The smallest power of `S - value` whose null space has all dimensions.
fn index<T: Number>(shifted: &Matrix<T>, algebraic: usize, precision: Precision) -> usize {
    let mut power = shifted.clone();
    for index in 1..algebraic {
        let largest = power.entries().iter().fold(0.0_f64, |max, x| max.max(x.size()));
        let (pivots, _) = eliminated(&power, power.rows());
        let rank = pivots.iter().filter(|x| x.size() > precision.null() * largest).count();
        if power.rows() - rank >= algebraic {
            return index;
        }
        power = product(&power, shifted);
    }
    algebraic
}

/// Jordan chains of a nilpotent matrix, each with the eigenvector first. With the longest first, each vector
/// of the null space of a power whose last image is new begins a chain; the images are those of chains at
/// least as long. Pivots of power p below `null scale^p` are zero.
fn nilpotent<T: Number>(matrix: &Matrix<T>, null: f64, scale: f64) -> Vec<Vec<Vec<T>>> {
    let n = matrix.rows();
    let mut powers = vec![Matrix::from_fn(n, n, |i, j| T::real(f64::from(u8::from(i == j))))];
    let mut kernels: Vec<Vec<Vec<T>>> = vec![Vec::new()];
    while kernels[kernels.len() - 1].len() < n && powers.len() <= n {
        let power = product(matrix, &powers[powers.len() - 1]);
        let (pivots, _) = eliminated(&power, n);
        let least = null * scale.powi(powers.len() as i32);
        let rank = pivots.iter().filter(|x| x.size() > least).count();
        kernels.push(kernel(&power, n - rank));
        powers.push(power);
    }
    let mut chains: Vec<Vec<Vec<T>>> = Vec::new();
    let mut ends: Vec<(usize, Vec<T>)> = Vec::new();
    for length in (1..kernels.len()).rev() {
        // what is left of the ends of candidates beside the known ones
        let end = |v: &Vec<T>, ends: &[(usize, Vec<T>)]| {
            let mut end = times(&powers[length - 1], v);
            for (pivot, known) in ends {
                let factor = end[*pivot] / known[*pivot];
                end.iter_mut().zip(known).for_each(|(x, &k)| *x = *x - factor * k);
            }
            end
        };
        // each power adds one dimension for every chain that is at least as long
        let count = kernels[length].len() - kernels[length - 1].len();
        while chains.len() < count {
            let left = kernels[length].iter().map(|v| (v, end(v, &ends)));
            let size = |v: &[T]| v.iter().fold(0.0_f64, |max, x| max.max(x.size()));
            let Some((top, rest)) = left.max_by(|a, b| size(&a.1).total_cmp(&size(&b.1))) else {
                break;
            };
            let at = (0..n).fold(0, |best, i| if rest[i].size() > rest[best].size() { i } else { best });
            if rest[at].size() == 0.0 {
                break;
            }
            let mut chain: Vec<Vec<T>> = (0..length).map(|k| times(&powers[k], top)).collect();
            chain.reverse();
            chains.push(chain);
            ends.push((at, rest));
        }
    }
    chains
}

/// The reduced echelon form of vectors, by their entries in order, the first `centre` last.
fn echelon<T: Number>(mut vectors: Vec<Vec<T>>, centre: usize) -> Vec<Vec<T>> {
    let (mut done, size) = (0, vectors[0].len());
    let length = |v: &[T]| v.iter().map(|x| x.size() * x.size()).sum::<f64>().sqrt();
    for position in (0..size).map(|i| (i + centre) % size) {
        if done == vectors.len() {
            break;
        }
        let relative = |v: &Vec<T>| v[position].size() / length(v);
        let best = (done..vectors.len()).max_by(|&a, &b| relative(&vectors[a]).total_cmp(&relative(&vectors[b])));
        let Some(best) = best.filter(|&best| relative(&vectors[best]) > PIVOT) else {
            continue;
        };
        vectors.swap(done, best);
        let by = T::real(1.0) / vectors[done][position];
        vectors[done].iter_mut().for_each(|x| *x = *x * by);
        let pivot = vectors[done].clone();
        for (_, vector) in vectors.iter_mut().enumerate().filter(|(other, _)| *other != done) {
            let factor = vector[position];
            vector.iter_mut().zip(&pivot).for_each(|(x, &p)| *x = *x - factor * p);
        }
        done += 1;
    }
    vectors
}

/// The combinations of left vectors that are dual to the right ones; `None` if there are none.
fn dual<T: Number>(left: &[Vec<T>], right: &[Vec<T>]) -> Option<Vec<Vec<T>>> {
    let count = right.len();
    let mut left = left.to_vec();
    let mut gram: Vec<Vec<T>> = left.iter().map(|l| right.iter().map(|r| dot(l, r)).collect()).collect();
    for column in 0..count {
        let best = (column..count).max_by(|&a, &b| gram[a][column].size().total_cmp(&gram[b][column].size()))?;
        if !(gram[best][column].size() > 0.0) {
            return None;
        }
        gram.swap(column, best);
        left.swap(column, best);
        let by = T::real(1.0) / gram[column][column];
        gram[column].iter_mut().for_each(|x| *x = *x * by);
        left[column].iter_mut().for_each(|x| *x = *x * by);
        let (pivot, vector) = (gram[column].clone(), left[column].clone());
        for other in (0..count).filter(|&other| other != column) {
            let factor = gram[other][column];
            gram[other]
                .iter_mut()
                .zip(&pivot)
                .for_each(|(x, &p)| *x = *x - factor * p);
            left[other]
                .iter_mut()
                .zip(&vector)
                .for_each(|(x, &v)| *x = *x - factor * v);
        }
    }
    Some(left)
}

/// A basis of the null space, which has the given dimension.
fn kernel<T: Number>(matrix: &Matrix<T>, dimension: usize) -> Vec<Vec<T>> {
    let n = matrix.rows();
    let (_, steps) = eliminated(matrix, n - dimension);
    let mut free = vec![true; n];
    steps.iter().for_each(|step| free[step.0] = false);
    let vector = |open: usize| {
        let mut v = vec![T::real(0.0); n];
        v[open] = T::real(1.0);
        for (column, row) in steps.iter().rev() {
            let others = (0..n).filter(|j| j != column);
            let sum = others.fold(
                T::real(0.0),
                |sum, j| if v[j].size() == 0.0 { sum } else { sum + row[j] * v[j] },
            );
            v[*column] = T::real(0.0) - sum / row[*column];
        }
        v
    };
    (0..n).filter(|&j| free[j]).map(vector).collect()
}

/// So many steps of elimination with full pivoting: the pivots, and the column and row of each, whose entries
/// in the columns of earlier steps are zero.
fn eliminated<T: Number>(matrix: &Matrix<T>, steps: usize) -> (Vec<T>, Vec<(usize, Vec<T>)>) {
    let n = matrix.rows();
    let mut rows: Vec<Vec<T>> = (0..n).map(|i| matrix.row(i).to_vec()).collect();
    let (mut pivots, mut done) = (Vec::new(), Vec::new());
    for _ in 0..steps {
        let mut best = (0.0, 0, 0);
        for (i, row) in rows.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                let size = x.size();
                if size > best.0 {
                    best = (size, i, j);
                }
            }
        }
        let (size, row, column) = best;
        if size == 0.0 {
            break;
        }
        let above = rows.swap_remove(row);
        for below in &mut rows {
            if below[column].size() != 0.0 {
                let factor = below[column] / above[column];
                for (x, &a) in below.iter_mut().zip(&above) {
                    if a.size() != 0.0 {
                        *x = *x - factor * a;
                    }
                }
                below[column] = T::real(0.0);
            }
        }
        pivots.push(above[column]);
        done.push((column, above));
    }
    (pivots, done)
}

fn minus<T: Number>(matrix: &Matrix<T>, value: T) -> Matrix<T> {
    let n = matrix.rows();
    Matrix::from_fn(
        n,
        n,
        |i, j| if i == j { matrix[(i, j)] - value } else { matrix[(i, j)] },
    )
}

fn transposed<T: Number>(matrix: &Matrix<T>) -> Matrix<T> {
    Matrix::from_fn(matrix.columns(), matrix.rows(), |i, j| matrix[(j, i)])
}

fn dot<T: Number>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::real(0.0), |sum, (&x, &y)| sum + x * y)
}

fn times<T: Number>(matrix: &Matrix<T>, vector: &[T]) -> Vec<T> {
    (0..matrix.rows()).map(|i| dot(matrix.row(i), vector)).collect()
}

fn product<T: Number>(a: &Matrix<T>, b: &Matrix<T>) -> Matrix<T> {
    let b = transposed(b);
    Matrix::from_fn(a.rows(), b.rows(), |i, j| dot(a.row(i), b.row(j)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
    use eigenring_scheme::{Corner, Definition, Scalar, Scheme, Spec};
    use eigenring_spline::BigRational;

    fn largest(v: &[Complex<f64>]) -> f64 {
        v.iter().map(|x| x.re.hypot(x.im)).fold(0.0, f64::max)
    }

    /// The chain equations and duality on the dense matrix, relative to the norms: the largest entry of a
    /// residual over the largest absolute row (column) sum times the largest entry of the vector.
    fn check(level: &Level<f64>, chains: &[Chain], rings: usize) -> f64 {
        let matrix = local_matrix(level, rings).unwrap();
        let n = matrix.rows();
        let norm = |entry: &dyn Fn(usize, usize) -> f64| {
            (0..n)
                .map(|i| (0..n).map(|j| entry(i, j).abs()).sum::<f64>())
                .fold(0.0, f64::max)
        };
        let norms = [norm(&|i, j| matrix[(i, j)]), norm(&|i, j| matrix[(j, i)])];
        let mut worst = 0.0_f64;
        let mut residual = |norm: f64,
                            transposed: bool,
                            v: &[Complex<f64>],
                            value: Complex<f64>,
                            before: Option<&Vec<Complex<f64>>>| {
            let scale = norm * largest(v).max(before.map_or(0.0, |b| largest(b)));
            for i in 0..n {
                let entry = |j: usize| if transposed { matrix[(j, i)] } else { matrix[(i, j)] };
                let image = (0..n).fold((0.0, 0.0), |s, j| (s.0 + entry(j) * v[j].re, s.1 + entry(j) * v[j].im));
                let b = before.map_or(Complex::default(), |b| b[i]);
                let re = image.0 - value.re * v[i].re + value.im * v[i].im - b.re;
                let im = image.1 - value.re * v[i].im - value.im * v[i].re - b.im;
                worst = worst.max(re.hypot(im) / scale);
            }
        };
        for chain in chains {
            for k in 0..chain.right.len() {
                residual(
                    norms[0],
                    false,
                    &chain.right[k],
                    chain.value,
                    k.checked_sub(1).map(|b| &chain.right[b]),
                );
                residual(norms[1], true, &chain.left[k], chain.value, chain.left.get(k + 1));
            }
        }
        let flat = |side: fn(&Chain) -> &Vec<Vec<Complex<f64>>>| -> Vec<(Option<usize>, &Vec<Complex<f64>>)> {
            chains
                .iter()
                .flat_map(|c| side(c).iter().map(|v| (c.fourier, v)))
                .collect()
        };
        let length = |v: &[Complex<f64>]| v.iter().map(|x| x.re * x.re + x.im * x.im).sum::<f64>().sqrt();
        for (i, (_, l)) in flat(|c| &c.left).iter().enumerate() {
            for (j, (_, r)) in flat(|c| &c.right).iter().enumerate() {
                let dot = l.iter().zip(r.iter()).fold((0.0, 0.0), |s, (l, r)| {
                    (s.0 + l.re * r.re - l.im * r.im, s.1 + l.re * r.im + l.im * r.re)
                });
                let defect = (dot.0 - f64::from(u8::from(i == j))).hypot(dot.1);
                worst = worst.max(defect / (length(l) * length(r)).max(1.0));
            }
        }
        worst
    }

    fn chains(scheme: &Scheme<f64>, extended: &Scheme<Extended>, rings: usize) -> Vec<Chain> {
        let system = LocalSystem::new(scheme.limit(), rings).unwrap();
        let found = system.chains(Some(extended.limit())).unwrap();
        // each block's vectors are as many as its unknowns
        for (index, block) in system.blocks().iter().enumerate() {
            let of_block = found.iter().filter(|c| c.fourier.unwrap_or(0) == index);
            assert_eq!(of_block.map(|c| c.right.len()).sum::<usize>(), block.size());
        }
        found
    }

    #[test]
    fn vectors_are_those_of_the_dense_matrix() {
        for valence in (3..=20).chain([31, 64]) {
            let worst = |scheme: Scheme<f64>, extended: Scheme<Extended>, rings: usize| {
                let found = chains(&scheme, &extended, rings);
                let error = check(scheme.limit(), &found, rings);
                assert!(error < 1e-14, "{} {valence}: {error}", scheme.name());
            };
            worst(catmull_clark(valence).unwrap(), catmull_clark(valence).unwrap(), 1);
            if valence <= 12 {
                worst(catmull_clark(valence).unwrap(), catmull_clark(valence).unwrap(), 2);
                worst(doo_sabin(valence).unwrap(), doo_sabin(valence).unwrap(), 1);
                let tense = |u: f64| tension::<Extended>(valence, 6, u).unwrap();
                worst(tension(valence, 6, 1.0).unwrap(), tense(1.0), 3);
            }
        }
    }

    /// The oracle is a closed form: the outermost ring of order 3 at valence 3 has 1/4 in every block, and
    /// block 1 has it twice with one vector.
    #[test]
    fn defective_eigenvalues_have_chains() {
        let scheme = tension::<f64>(3, 3, 1.0).unwrap();
        let extended = tension::<Extended>(3, 3, 1.0).unwrap();
        let found = chains(&scheme, &extended, 1);
        let long: Vec<&Chain> = found
            .iter()
            .filter(|c| c.right.len() > 1 && c.fourier == Some(1))
            .collect();
        assert_eq!(long.len(), 1, "{found:?}");
        assert!(long[0].right.len() == 2 && (long[0].value.re - 0.25).abs() < 1e-15);
    }

    /// The oracle is a planted Jordan form with integer similarity: blocks of sizes 3 and 2 at 1/2, 2 and 1
    /// at zero, and a simple 1.
    #[test]
    fn planted_jordan_forms_are_found() {
        let sizes = [(1.0, 1), (0.5, 3), (0.5, 2), (0.0, 2), (0.0, 1)];
        let n = 9;
        let mut jordan = Matrix::from_fn(n, n, |_, _| Extended::default());
        let mut at = 0;
        for (value, size) in sizes {
            for k in 0..size {
                jordan[(at + k, at + k)] = Extended::exact(value);
                if k + 1 < size {
                    jordan[(at + k, at + k + 1)] = Extended::exact(1.0);
                }
            }
            at += size;
        }
        // unit lower times unit upper triangular matrices of integers have inverses of integers
        let entry = |i: usize, j: usize| ((3 * i + 5 * j) % 4) as f64 - 1.0;
        let triangle = |lower: bool, i: usize, j: usize| {
            Extended::exact(if i == j {
                1.0
            } else if (i > j) == lower {
                entry(i, j)
            } else {
                0.0
            })
        };
        let t = product(
            &Matrix::from_fn(n, n, |i, j| triangle(true, i, j)),
            &Matrix::from_fn(n, n, |i, j| triangle(false, i, j)),
        );
        let unit = |j: usize| {
            (0..n)
                .map(|i| Extended::exact(f64::from(u8::from(i == j))))
                .collect::<Vec<_>>()
        };
        let columns: Vec<Vec<Extended>> = (0..n).map(|j| (0..n).map(|i| t[(i, j)]).collect()).collect();
        let inverse = Matrix::from_rows(dual(&(0..n).map(unit).collect::<Vec<_>>(), &columns).unwrap(), n);
        let matrix = product(&product(&t, &jordan), &inverse);
        assert!(repeated(&Block::Real(matrix.clone()), Precision::Extended).is_ok());
        let found = Block::Real(matrix.clone()).vectors(Precision::Extended, 0).unwrap();
        let mut lengths: Vec<(f64, usize)> = Vec::new();
        for (value, chains) in &found {
            for (right, left) in chains {
                lengths.push((value.re, right.len()));
                for k in 0..right.len() {
                    let vector: Vec<Extended> = right[k].iter().map(|x| x.re).collect();
                    for (i, image) in times(&matrix, &vector).into_iter().enumerate() {
                        let before = if k == 0 {
                            Extended::default()
                        } else {
                            right[k - 1][i].re
                        };
                        let error = (image - Extended::exact(value.re) * vector[i] - before).to_f64();
                        assert!(error.abs() < 1e-40, "{error}");
                    }
                    let functional: Vec<Extended> = left[k].iter().map(|x| x.re).collect();
                    for (i, image) in times(&transposed(&matrix), &functional).into_iter().enumerate() {
                        let next = left.get(k + 1).map_or(Extended::default(), |next| next[i].re);
                        let error = (image - Extended::exact(value.re) * functional[i] - next).to_f64();
                        assert!(error.abs() < 1e-40, "{error}");
                    }
                }
            }
        }
        assert_eq!(lengths, [(1.0, 1), (0.5, 3), (0.5, 2), (0.0, 2), (0.0, 1)]);
    }
    /// The fraction of least denominator within rounding of a number.
    fn fraction(x: f64) -> BigRational {
        let found = (1..1_000_000_i64).find_map(|q| {
            let p = (x * q as f64).round();
            ((p / q as f64 - x).abs() <= 4.0 * f64::EPSILON * x.abs())
                .then(|| BigRational::new((p as i64).into(), q.into()))
        });
        // the vectors of a rational matrix at a rational value are rational
        found.unwrap_or_else(|| panic!("{x:e} is no fraction"))
    }

    /// The oracle is rational arithmetic: the matrix of a crease with one face is dyadic, so are its
    /// eigenvalues 1, 1/2, 1/4, 1/4 and those of the outer ring, and the chain equations and duality hold
    /// exactly for the fractions that the entries round to.
    #[test]
    fn chains_of_a_crease_are_exact() {
        let corner = Corner::fan(1).unwrap();
        let definition = Definition::Family("catmull-clark".parse::<Spec>().unwrap());
        let scheme: Scheme<f64> = definition.around(&corner).unwrap();
        let extended: Scheme<Extended> = definition.around(&corner).unwrap();
        let rings = scheme.closed_rings().unwrap();
        let found = chains(&scheme, &extended, rings);
        assert!(
            found
                .iter()
                .any(|c| c.right.len() == 2 && (c.value.re - 0.25).abs() < 1e-15),
            "{found:?}"
        );
        let matrix = local_matrix(scheme.limit(), rings).unwrap();
        let n = matrix.rows();
        let exact = |v: &[Complex<f64>]| v.iter().map(|x| fraction(x.re)).collect::<Vec<_>>();
        let zero = || BigRational::from_float(0.0).unwrap();
        let entry = |i: usize, j: usize| BigRational::from_float(matrix[(i, j)]).unwrap();
        let (mut all_right, mut all_left) = (Vec::new(), Vec::new());
        for chain in &found {
            let (right, left): (Vec<_>, Vec<_>) = (
                chain.right.iter().map(|v| exact(v)).collect(),
                chain.left.iter().map(|v| exact(v)).collect(),
            );
            let value = fraction(chain.value.re);
            for k in 0..right.len() {
                for i in 0..n {
                    let image = (0..n).fold(zero(), |sum, j| sum + entry(i, j) * &right[k][j]);
                    let before = if k == 0 { zero() } else { right[k - 1][i].clone() };
                    assert_eq!(image, &value * &right[k][i] + before);
                    let image = (0..n).fold(zero(), |sum, j| sum + entry(j, i) * &left[k][j]);
                    let next = left.get(k + 1).map_or(zero(), |next| next[i].clone());
                    assert_eq!(image, &value * &left[k][i] + next);
                }
            }
            all_right.extend(right);
            all_left.extend(left);
        }
        assert_eq!(all_right.len(), n);
        for (i, l) in all_left.iter().enumerate() {
            for (j, r) in all_right.iter().enumerate() {
                let product = l.iter().zip(r).fold(zero(), |sum, (l, r)| sum + l * r);
                assert_eq!(product, BigRational::from_float(f64::from(u8::from(i == j))).unwrap());
            }
        }
    }
}
