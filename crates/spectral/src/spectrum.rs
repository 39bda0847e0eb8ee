//! The eigenvalues of a local system, with Fourier indices and multiplicities.

use crate::eigen::order;
use crate::matrix::Assembly;
use crate::repeated::{Precision, Repeated, repeated};
use crate::{Block, BlockEigenvalue, Error, Extended, LocalSystem, NULL, SecondOrder, local_matrix};
use eigenring_scheme::{Complex, Level, Numbering};

/// An eigenvalue of the local matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenvalue {
    /// The value.
    pub value: Complex<f64>,
    /// The Fourier index. Blocks k and N-k have conjugate spectra: a value that is in both is listed once,
    /// with `k <= N/2`; one that is not real may be in one of them only, without mirror symmetry. `None` for
    /// rules that differ from sector to sector.
    pub fourier: Option<usize>,
    /// How many blocks the multiplicities count: 2 for a value that blocks k and N-k share, else 1.
    pub blocks: usize,
    /// The algebraic multiplicity in the whole local matrix.
    pub multiplicity: usize,
    /// The number of independent eigenvectors in the whole local matrix, never above the multiplicity, and
    /// below it if defective. `None` where it was not asked for.
    pub geometric: Option<usize>,
}

impl Eigenvalue {
    /// The modulus.
    pub fn modulus(&self) -> f64 {
        self.value.modulus()
    }

    /// Whether there are fewer eigenvectors than the multiplicity; false where these were not counted.
    pub fn is_defective(&self) -> bool {
        self.geometric.is_some_and(|vectors| vectors < self.multiplicity)
    }

    /// Whether two eigenvalues of different blocks are the same, up to rounding.
    pub fn is_close(&self, other: &Eigenvalue) -> bool {
        are_close(self.value, other.value)
    }
}

fn are_close(a: Complex<f64>, b: Complex<f64>) -> bool {
    (a - b).modulus() <= SAME * a.modulus().max(b.modulus())
}

/// Eigenvalues of different blocks closer than this, relatively, are the same: they come from independent
/// computations whose errors are some rounding units times a moderate condition number.
const SAME: f64 = 1e-9;

/// The eigenvalues by falling modulus. Equal values of different Fourier indices are listed one by one, the
/// smaller index first.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// The eigenvalues.
    pub eigenvalues: Vec<Eigenvalue>,
}

/// Of blocks of more unknowns the core is decomposed, and if that has more, in doubles, with gaps in place of
/// tests: 250 take some seconds.
pub(crate) const MAX_EXTENDED: usize = 250;

/// The same for matrices that are known in doubles only, of which less can be told.
pub(crate) const MAX_LIFTED: usize = 40;

impl LocalSystem {
    /// All eigenvalues with their algebraic and geometric multiplicities, as far as a matrix of doubles
    /// tells: what its rounding could make of one eigenvalue is one. [`LocalSystem::spectrum_of`] knows more.
    ///
    /// # Errors
    /// [`Error::Decomposition`] if an entry is not finite or an iteration fails.
    pub fn spectrum(&self) -> Result<Spectrum, Error> {
        Spectrum::of_blocks(self.blocks(), self.fourier(), 0.0)
    }

    /// The valence, if there are Fourier blocks.
    fn fourier(&self) -> Option<usize> {
        self.symmetric().then(|| self.valence())
    }

    /// All eigenvalues with their algebraic and geometric multiplicities, from the rules of the same level in
    /// [`Extended`] numbers.
    ///
    /// # Errors
    /// As [`LocalSystem::spectrum`]; those of [`fourier_blocks`](crate::fourier_blocks).
    pub fn spectrum_of(&self, level: &Level<Extended>) -> Result<Spectrum, Error> {
        let rings = self.telling_rings();
        if !self.symmetric() {
            let matrix = Block::Real(local_matrix(level, rings)?);
            return listed(self.blocks(), None, |_, block| {
                multiplicities(&matrix, block, Precision::Extended)
            });
        }
        let assembly = Assembly::new(level, rings)?;
        listed(self.blocks(), self.fourier(), |index, block| {
            multiplicities(&assembly.block(index)?, block, Precision::Extended)
        })
    }

    /// All eigenvalues with their algebraic multiplicities alone, in doubles, those within
    /// [`EQUAL`](crate::EQUAL) of each other as one: for the leading eigenvalues, a hundred times as fast as
    /// [`LocalSystem::spectrum`].
    ///
    /// # Errors
    /// [`Error::Decomposition`] if an entry is not finite or an iteration fails.
    pub fn eigenvalues(&self) -> Result<Spectrum, Error> {
        listed(self.blocks(), self.fourier(), |_, block| {
            let known = |e: BlockEigenvalue| (e.value, e.multiplicity, (e.multiplicity == 1).then_some(1));
            Ok(block.eigenvalues()?.into_iter().map(known).collect())
        })
    }

    /// The rings that are looked at in more precision: all, or where a block is too large for that those of
    /// the cores.
    fn telling_rings(&self) -> usize {
        let numbering = self.numbering();
        let sizes = self.blocks().iter().map(Block::size);
        if sizes.fold(0, usize::max) <= MAX_EXTENDED {
            return numbering.rings;
        }
        let core = self.blocks().iter().map(Block::core).fold(0, usize::max);
        let holds = |&rings: &usize| {
            let inner = Numbering { rings, ..numbering };
            core <= if self.symmetric() {
                inner.sector_points()
            } else {
                inner.count()
            }
        };
        (0..numbering.rings).find(holds).unwrap_or(numbering.rings)
    }
}

/// The eigenvalues of the blocks 0 to N/2 of a valence, or of one matrix without a valence; `of` gives those
/// of one with algebraic and geometric multiplicity.
fn listed(
    blocks: &[Block<f64>],
    valence: Option<usize>,
    of: impl Fn(usize, &Block<f64>) -> Result<Vec<Multiplicities>, Error>,
) -> Result<Spectrum, Error> {
    let mut eigenvalues = Vec::new();
    for (k, block) in blocks.iter().enumerate() {
        let twice = valence.filter(|n| k != 0 && 2 * k != *n);
        let copies = 1 + usize::from(twice.is_some());
        let list = of(k, block)?;
        for &(value, multiplicity, geometric) in &list {
            let conjugate = value.conj();
            let mut add = |value, index: usize, copies: usize| {
                eigenvalues.push(Eigenvalue {
                    value,
                    fourier: valence.map(|_| index),
                    blocks: copies,
                    multiplicity: copies * multiplicity,
                    geometric: geometric.map(|vectors| copies * vectors),
                });
            };
            // block N-k is conjugate: without a mirror symmetry it may have a value that block k has not
            match twice {
                Some(n) if value.im != 0.0 && !list.iter().any(|other| are_close(other.0, conjugate)) => {
                    add(value, k, 1);
                    add(conjugate, n - k, 1);
                }
                _ => add(value, k, copies),
            }
        }
    }
    eigenvalues.sort_by(|a, b| order(a.value, b.value).then(a.fourier.cmp(&b.fourier)));
    // equal or conjugate up to rounding: by Fourier index
    let upper = |e: &Eigenvalue| Complex::new(e.value.re, e.value.im.abs());
    let mut start = 0;
    for end in 1..=eigenvalues.len() {
        if end == eigenvalues.len() || !are_close(upper(&eigenvalues[end]), upper(&eigenvalues[start])) {
            eigenvalues[start..end].sort_by_key(|e| e.fourier);
            start = end;
        }
    }
    Ok(Spectrum { eigenvalues })
}

/// An eigenvalue of a block with its algebraic and, where it is known, its geometric multiplicity.
type Multiplicities = (Complex<f64>, usize, Option<usize>);

/// Those of a block, which is given in both precisions.
fn multiplicities(
    block: &Block<Extended>,
    doubles: &Block<f64>,
    precision: Precision,
) -> Result<Vec<Multiplicities>, Error> {
    let most = match precision {
        Precision::Rounded(_) => MAX_LIFTED,
        Precision::Extended => MAX_EXTENDED,
    };
    if block.size() <= most && block.size() == doubles.size() {
        let known = |e: Repeated| (e.value, e.algebraic, Some(e.geometric));
        return Ok(repeated(block, precision)?.into_iter().map(known).collect());
    }
    // what is not zero is told from the core
    let core = doubles.core();
    let mut known: Vec<Multiplicities> = Vec::new();
    if core <= most {
        let found = repeated(&block.leading(core), precision)?.into_iter();
        known.extend(found.map(|e| (e.value, e.algebraic, Some(e.geometric))));
    } else {
        let inner = doubles.leading(core);
        for BlockEigenvalue { value, multiplicity } in inner.eigenvalues()? {
            let geometric = match multiplicity {
                1 => 1,
                _ => inner.nullity(value, NULL)?.clamp(1, multiplicity),
            };
            known.push((value, multiplicity, Some(geometric)));
        }
    }
    known.retain(|e| e.0 != Complex::zero());
    let zeros = doubles.size() - known.iter().map(|e| e.1).sum::<usize>();
    if zeros > 0 {
        known.push((Complex::zero(), zeros, Some(doubles.sparse_nullity().clamp(1, zeros))));
    }
    Ok(known)
}

impl Spectrum {
    /// The spectrum of a matrix from its Fourier blocks 0 to N/2, or, without a valence, from the one block
    /// that is the matrix. Entries are known to `rounding` relative to the largest, 0 for doubles as they
    /// are: what such an error could make of one eigenvalue is one.
    ///
    /// # Errors
    /// [`Error::Decomposition`] if an entry is not finite or an iteration fails.
    pub fn of_blocks(blocks: &[Block<f64>], valence: Option<usize>, rounding: f64) -> Result<Self, Error> {
        listed(blocks, valence, |_, block| {
            multiplicities(&block.lifted(), block, Precision::Rounded(rounding))
        })
    }

    /// The eigenvalue of largest modulus once the dominant one is taken away.
    pub fn subdominant(&self) -> Option<&Eigenvalue> {
        self.eigenvalues.get(1)
    }

    /// The Fourier index of the subdominant eigenvalue where block 1, whose vectors make up the
    /// characteristic map, has none as large: then lambda, its ratios and the map have not their usual
    /// meaning.
    pub fn stray(&self) -> Option<usize> {
        let subdominant = self.subdominant()?;
        let same = self.eigenvalues[1..].iter().take_while(|e| {
            let gap = subdominant.modulus() - e.modulus();
            gap <= SAME * subdominant.modulus()
        });
        let index = subdominant.fourier.filter(|&index| index != 1)?;
        (!same.into_iter().any(|e| e.fourier == Some(1))).then_some(index)
    }

    /// The eigenvalue of largest modulus below the subdominant one.
    pub fn subsubdominant(&self) -> Option<&Eigenvalue> {
        let subdominant = self.subdominant()?;
        self.eigenvalues[2..]
            .iter()
            .find(|e| e.modulus() < subdominant.modulus() * (1.0 - SAME))
    }

    /// `mu / lambda^2`: 1 for bounded curvature without a flat spot. Moduli are taken; `None` where lambda is
    /// 0 or a [`stray`](Spectrum::stray) one.
    pub fn curvature_ratio(&self) -> Option<f64> {
        if self.stray().is_some() {
            return None;
        }
        let lambda = self.subdominant()?.modulus();
        (lambda > 0.0).then(|| self.subsubdominant().map_or(0.0, |mu| mu.modulus() / (lambda * lambda)))
    }

    /// How far all further eigenvalues are below the three of the quadratic terms: `1 - |next| / mu`. These
    /// are the largest of the blocks 0, 2 and N-2 below 1 and lambda, `mu` is the smallest of their moduli,
    /// and `beyond` the largest modulus of eigenvalues that are not listed.
    ///
    /// `None` where it would mean nothing: as [`Spectrum::sixth`], or the next is not below mu.
    pub fn strictness(&self, valence: usize, beyond: f64) -> Option<f64> {
        let sixth = self.sixth(valence, beyond)?;
        (sixth < 1.0 - SAME).then_some(1.0 - sixth)
    }

    /// `|next| / mu`, for mu and next as in [`Spectrum::strictness`]: the modulus of the sixth eigenvalue
    /// beside that of the three before it, below 1 if these lead.
    ///
    /// `None` where it would mean nothing: 1 is not dominant, or the subdominant eigenvalue is not a simple
    /// one of block 1.
    pub fn sixth(&self, valence: usize, beyond: f64) -> Option<f64> {
        let leading = self.eigenvalues.first().filter(|e| (e.modulus() - 1.0).abs() <= SAME)?;
        let pair = self.subdominant().filter(|e| e.fourier == Some(1))?;
        let (mut left, mut mu) = (vec![], f64::INFINITY);
        for index in 0..=valence / 2 {
            let block = self.eigenvalues.iter().filter(|e| e.fourier == Some(index));
            let mut moduli = block.flat_map(|e| std::iter::repeat_n(e.modulus(), e.multiplicity / e.blocks));
            let passed = match index {
                0 => moduli.next().map(|first| (first, leading)),
                1 => moduli.next().map(|first| (first, pair)),
                _ => None,
            };
            if passed.is_some_and(|(first, expected)| first != expected.modulus()) {
                return None;
            }
            for _ in 0..SecondOrder::copies_in(valence, index) {
                mu = mu.min(moduli.next()?);
            }
            left.extend(moduli.next());
        }
        let next = left.into_iter().fold(beyond, f64::max);
        (mu > 0.0).then_some(next / mu)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};

    #[test]
    fn catmull_clark_in_closed_form() {
        // lambda = (5 + c + sqrt((c+9)(c+1)))/16, and rings further out add 1/8, 1/16, 1/32, 1/64 and zeros
        for valence in 3..=64 {
            let scheme = catmull_clark::<f64>(valence).unwrap();
            let c = (std::f64::consts::TAU / valence as f64).cos();
            let lambda = (5.0 + c + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0;
            for rings in 1..=3 {
                let system = LocalSystem::new(scheme.limit(), rings).unwrap();
                let spectrum = system.spectrum().unwrap();
                let count: usize = spectrum.eigenvalues.iter().map(|e| e.multiplicity).sum();
                assert_eq!(count, system.numbering().count());
                let subdominant = spectrum.subdominant().unwrap();
                assert!((subdominant.value.re - lambda).abs() < 1e-14);
                assert_eq!((subdominant.fourier, subdominant.multiplicity), (Some(1), 2));
                if rings == 3 {
                    let zero = spectrum.eigenvalues.iter().filter(|e| e.modulus() < 1e-15);
                    let zeros: usize = zero.map(|e| e.multiplicity).sum();
                    assert!(zeros >= 6 * valence, "the points of ring 3 depend on inner rings only");
                }
            }
        }
    }

    #[test]
    fn doo_sabin_has_one_half_and_one_quarter() {
        for valence in 3..12 {
            let scheme = doo_sabin::<f64>(valence).unwrap();
            let spectrum = LocalSystem::new(scheme.limit(), 0).unwrap().spectrum().unwrap();
            for e in &spectrum.eigenvalues {
                let expected = match e.fourier {
                    Some(0) => 1.0,
                    Some(1) => 0.5,
                    _ => 0.25,
                };
                assert!((e.value.re - expected).abs() < 1e-15 && e.value.im == 0.0);
            }
            let expected = if valence == 3 { 0.0 } else { 1.0 };
            assert!((spectrum.curvature_ratio().unwrap() - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn order_three_in_closed_form() {
        // ev_m = u (N u + 2N - 4 + 4 c_m) / (N (1+u)^2), m >= 1
        for (valence, u) in [(3, 0.4), (5, 1.0), (6, 2.0), (8, 0.1)] {
            let scheme = tension::<f64>(valence, 3, u).unwrap();
            let spectrum = LocalSystem::new(scheme.level(0), 0).unwrap().spectrum().unwrap();
            let n = valence as f64;
            for e in spectrum.eigenvalues.iter().filter(|e| e.fourier != Some(0)) {
                let c = (std::f64::consts::TAU * e.fourier.unwrap() as f64 / n).cos();
                let expected = u * (n * u + 2.0 * n - 4.0 + 4.0 * c) / (n * (1.0 + u) * (1.0 + u));
                assert!((e.value.re - expected).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_defective_eigenvalue_shows_in_its_multiplicities() {
        let scheme = tension::<f64>(3, 3, 1.0).unwrap();
        let spectrum = LocalSystem::new(scheme.limit(), 1).unwrap().spectrum().unwrap();
        // the outer ring has 1/4 in block 0 as well
        assert_eq!(spectrum.subdominant().unwrap().fourier, Some(0));
        let lambda = spectrum.eigenvalues.iter().find(|e| e.fourier == Some(1)).unwrap();
        assert!((lambda.value.re - 0.25).abs() < 1e-14);
        assert_eq!((lambda.multiplicity, lambda.geometric), (4, Some(2)));
    }
}
