//! Enclosures of the whole spectrum of a scheme, and of the vectors that belong to it.
//!
//! The matrix whose eigenvalues decide is the local matrix on all rings that determine the patches of the
//! regular [`Annulus`](eigenring_spectral::Annulus), not the smallest closed one: outer rings have
//! eigenvalues of their own, and one that equals lambda makes it defective. It is taken apart before anything
//! is enclosed:
//!
//! 1. into Fourier [`Block`]s, real where the rules have mirror symmetry; block N-k is the conjugate of block
//!    k; unknowns that no patch depends on, at any level, are dropped;
//! 2. block 0 is divided by the constant vector, whose eigenvalue 1 is exact where rows sum to 1 exactly;
//! 3. each block into the strongly connected components of its graph, with entries that are **exactly** zero
//!    as missing edges: its eigenvalues are those of the diagonal parts (`graph`);
//! 4. each component by dividing out simple real eigenpairs one after the other, with closed forms for the
//!    last two and a bound of the moduli where pairs cannot be told apart (`component`).
//!
//! Every eigenvalue is accounted for: by an enclosure, or as one of so many below a radius.

mod block;
mod component;
mod graph;
mod map;

pub use block::{Block, Place, blocks};
pub use component::{Located, Peel, Rest, enclose};
pub use map::{Net, eigenvector, eigenvector_within, is_visible, net};

use crate::linear::Eigenvalue;
use crate::patches::{Unknown, coordinates};
use crate::{Error, Input, Interval, Patches, Subject};
use eigenring_scheme::Scalar;
use serde::{Deserialize, Serialize};

/// Approximations found by a search: for each block and component, how it comes apart.
pub type Evidence = Vec<Vec<Peel>>;

/// The enclosed spectrum.
#[derive(Clone, Debug)]
pub struct EnclosedSpectrum {
    /// Where the patches are, and their control points.
    pub patches: Patches,
    /// The coordinates of the points, if rules that differ from sector to sector halve them: two eigenvectors
    /// of 1/2, without which the one block is.
    pub coordinates: Option<[Vec<Interval>; 2]>,
    /// The blocks of index 0 to N/2, or the undivided matrix as the only one.
    pub blocks: Vec<Block>,
    /// The eigenvalues of all blocks.
    pub entries: Vec<EnclosedEigenvalue>,
    /// What is only known in modulus.
    pub bounds: Vec<Bound>,
}

/// An eigenvalue: one of the block of its index, and one of the conjugate block.
#[derive(Clone, Debug)]
pub struct EnclosedEigenvalue {
    /// The Fourier index, at most N/2.
    pub index: usize,
    /// The component of the block.
    pub component: usize,
    /// The enclosed eigenvalue.
    pub value: Eigenvalue,
    /// The eigenvector on the unknowns of the component, for a simple real value.
    pub vector: Option<Vec<Interval>>,
}

/// Eigenvalues that are known by a bound of their moduli.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bound {
    /// The Fourier index.
    pub index: usize,
    /// The component of the block.
    pub component: usize,
    /// How many.
    pub count: usize,
    /// Their moduli are below this.
    pub radius: f64,
}

impl EnclosedSpectrum {
    /// The spectrum of a subject's blocks, with the help of evidence. Evidence that is missing or wrong
    /// leaves wide bounds.
    pub fn new(problem: Problem, evidence: &Evidence) -> Self {
        let Problem {
            patches,
            blocks,
            coordinates,
        } = problem;
        let (mut entries, mut bounds) = (Vec::new(), Vec::new());
        let none = Peel::default();
        for (position, block) in blocks.iter().enumerate() {
            for component in 0..block.components.len() {
                let peel = evidence
                    .get(position)
                    .and_then(|peels| peels.get(component))
                    .unwrap_or(&none);
                let (located, rest) = enclose(&block.part(component), peel);
                entries.extend(located.into_iter().map(|Located { value, vector }| EnclosedEigenvalue {
                    index: block.index,
                    component,
                    value,
                    vector,
                }));
                bounds.extend(rest.map(|(count, radius)| Bound {
                    index: block.index,
                    component,
                    count,
                    radius,
                }));
            }
        }
        EnclosedSpectrum {
            patches,
            coordinates,
            blocks,
            entries,
            bounds,
        }
    }

    /// The largest modulus that anything but the entries with the given positions can have, and where.
    pub fn largest_other(&self, except: &[usize]) -> Option<(Interval, usize)> {
        let entries = self
            .entries
            .iter()
            .enumerate()
            .filter(|(position, _)| !except.contains(position));
        let moduli = entries.map(|(_, entry)| (entry.value.modulus(), entry.index));
        let bounds = self.bounds.iter().map(|bound| {
            let modulus = Interval::new(0.0, bound.radius).unwrap_or(Interval::ENTIRE);
            (modulus, bound.index)
        });
        moduli.chain(bounds).max_by(|a, b| a.0.hi().total_cmp(&b.0.hi()))
    }

    /// The eigenvector of an entry of the undivided matrix: a value for each point of the numbering.
    pub fn points(&self, entry: &EnclosedEigenvalue) -> Option<Vec<Interval>> {
        let block = self.block(entry.index).filter(|block| block.place == Place::Points)?;
        eigenvector(block, entry, entry.value.re)
    }

    /// Whether an entry is certainly larger in modulus than everything else.
    pub fn leads(&self, entry: &EnclosedEigenvalue) -> bool {
        let position = self.entries.iter().position(|other| std::ptr::eq(other, entry));
        let other = position.and_then(|position| self.largest_other(&[position]));
        position.is_some() && other.is_none_or(|(other, _)| other.certainly_lt(entry.value.modulus()))
    }

    /// Whether the surface is proven to see the eigenvector of an entry.
    pub fn sees(&self, entry: &EnclosedEigenvalue) -> bool {
        self.block(entry.index).is_some_and(|block| is_visible(block, entry))
    }

    /// The block of an index.
    pub fn block(&self, index: usize) -> Option<&Block> {
        self.blocks.iter().find(|block| block.index == index)
    }
}

/// What is to be enclosed.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The patches around the centre.
    pub patches: Patches,
    /// The blocks of the matrix that determines them.
    pub blocks: Vec<Block>,
    /// See [`EnclosedSpectrum::coordinates`].
    pub coordinates: Option<[Vec<Interval>; 2]>,
}

impl Problem {
    /// The patches of a subject and the blocks of the matrix that determines them; or why patches are not
    /// known.
    ///
    /// # Errors
    /// [`Error::Spectral`] if the rules cannot be run, [`Error::Size`] beyond [`MAX_BLOCK`] unknowns.
    pub(crate) fn new(subject: &Subject) -> Result<Result<Self, Unknown>, Error> {
        let patches = match Patches::new(subject)? {
            Ok(patches) => patches,
            Err(unknown) => return Ok(Err(unknown)),
        };
        let (level, numbering) = (subject.scheme.limit(), patches.numbering());
        let halved = match (&subject.corner, &subject.exact) {
            (Some(corner), Some(exact)) if !level.is_rotation_symmetric() => {
                coordinates(exact.limit(), corner, numbering)
            }
            _ => None,
        };
        let coordinates = halved.map(|parts| parts.map(|part| part.iter().map(Interval::rational).collect()));
        Ok(Ok(Problem {
            blocks: blocks(level, &patches, coordinates.as_ref())?,
            patches,
            coordinates,
        }))
    }
}

/// The largest number of unknowns of a block: dense matrices, of which there are N/2 + 1. Tension of order 22
/// needs 930.
pub const MAX_BLOCK: usize = 1000;

/// The largest number of points of an undivided matrix, of which there is one. Order 6 around 32 sectors
/// needs 1400.
pub const MAX_POINTS: usize = 2000;

/// The problem of an input at a valence; `None` where patches are not known.
///
/// # Errors
/// As for any certificate: those of the input and of running the rules, [`Error::Size`].
pub fn problem_of(input: &Input, valence: usize) -> Result<Option<Problem>, Error> {
    Ok(Problem::new(&input.subject(valence)?)?.ok())
}

#[cfg(test)]
mod tests;
