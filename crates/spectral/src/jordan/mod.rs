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

mod elimination;

use crate::echelon::PIVOT;
use crate::extended::Extended;
use crate::hessenberg::Number;
use crate::repeated::{Precision, repeated};
use crate::spectrum::{MAX_EXTENDED, MAX_LIFTED};
use crate::{Block, Error, LocalSystem, Matrix, local_matrix, matrix::Assembly};
use eigenring_scheme::{Complex, FourierNet, Level, Site};
use elimination::{dot, dual, echelon, eliminated, kernel, minus, product, times, transposed};

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

#[cfg(test)]
mod tests;
