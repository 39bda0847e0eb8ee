//! Fourier blocks of interval matrices, without the constant vector and what no patch depends on, and their
//! components.

use super::graph::components;
use super::{MAX_BLOCK, MAX_POINTS};
use crate::linear::quotient;
use crate::{Error, Interval, Patches};
use eigenring_scheme::{Complex, Level, Numbering, Site};
use eigenring_spectral::{Block as Fourier, Matrix, fourier_block, local_matrix};

/// One Fourier block.
#[derive(Clone, Debug)]
pub struct Block {
    /// The Fourier index k, at most N/2.
    pub index: usize,
    /// How the unknowns of [`Block::matrix`] stand for the points.
    pub place: Place,
    /// The matrix to be analysed: of the unknowns that patches depend on, for index 0 without the constant
    /// vector.
    pub matrix: Matrix<Interval>,
    /// The constant vector, where it was divided out.
    pub divided: Option<Divided>,
    /// The unknown of the undivided block that each unknown of the matrix is.
    pub kept: Vec<usize>,
    /// The number of unknowns of the undivided block.
    pub size: usize,
    /// Whether each unknown of the undivided block belongs to a control point of the annulus.
    pub visible: Vec<bool>,
    /// The site that each unknown of the undivided block belongs to.
    pub sites: Vec<Site>,
    /// The components of the matrix, in an order in which each reads only earlier ones.
    pub components: Vec<Vec<usize>>,
    /// For each component the earlier ones that it reads, directly or not.
    pub reads: Vec<Vec<usize>>,
}

/// The constant vector and its eigenvalue 1.
#[derive(Clone, Debug)]
pub struct Divided {
    /// The unknown that was divided out, of the undivided block: the first that is 1 in the constant vector.
    pub pivot: usize,
    /// Its row, on the unknowns of the matrix.
    pub row: Vec<Interval>,
    /// Whether each unknown of the undivided block is 1 in the constant vector; the others are 0 there.
    pub constant: Vec<bool>,
}

/// What the unknowns of a block are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The real unknowns of [`FourierNet`](eigenring_scheme::FourierNet) with mirror symmetry.
    Real,
    /// Real parts of the values, then imaginary parts: for rules without mirror symmetry. Each eigenvalue of
    /// the block comes with its conjugate, the eigenvalue of the conjugate block.
    Parts,
    /// The points themselves: for rules that differ from sector to sector.
    Points,
    /// The same without further vectors than the constant one: eigenvalues are those of the points, vectors
    /// are classes modulo these.
    Quotient,
}

/// A block as it comes from the rules.
struct Whole {
    index: usize,
    place: Place,
    matrix: Matrix<Interval>,
    /// The constant vector, if it belongs to the block.
    constant: Option<Vec<bool>>,
    /// Eigenvectors that are known beside it, and independent.
    known: Vec<Vec<Interval>>,
    /// The site of each unknown.
    sites: Vec<Site>,
}

impl Block {
    fn new(whole: Whole, visible: Vec<bool>) -> Self {
        let Whole {
            index,
            place,
            matrix: all,
            constant,
            known,
            sites,
        } = whole;
        // an unknown that no patch depends on, at no level, has no influence on the surface
        let read = depended_on(&all, &visible);
        let mut kept: Vec<usize> = (0..all.rows()).filter(|&unknown| read[unknown]).collect();
        let of_kept = |kept: &[usize]| Matrix::from_fn(kept.len(), kept.len(), |i, j| all[(kept[i], kept[j])]);
        let position = constant
            .as_ref()
            .and_then(|constant| kept.iter().position(|&unknown| constant[unknown]));
        let (mut matrix, divided) = match (position, constant) {
            (Some(position), Some(constant)) => {
                let ones: Vec<Interval> = kept.iter().map(|&i| Interval::point(f64::from(constant[i]))).collect();
                let matrix = quotient(&of_kept(&kept), &ones, position);
                let pivot = kept.remove(position);
                let row = kept.iter().map(|&unknown| all[(pivot, unknown)]).collect();
                (matrix, Some(Divided { pivot, row, constant }))
            }
            _ => (of_kept(&kept), None),
        };
        if let Some(Divided { pivot, .. }) = &divided {
            let modulo = |vector: Vec<Interval>| kept.iter().map(|&unknown| vector[unknown] - vector[*pivot]).collect();
            let known = known.into_iter().map(modulo).collect();
            (matrix, kept) = without(matrix, kept, known);
        }
        let (components, reads) = components(matrix.rows(), |i, j| !matrix[(i, j)].is_zero());
        Block {
            index,
            place,
            matrix,
            divided,
            kept,
            size: all.rows(),
            visible,
            sites,
            components,
            reads,
        }
    }

    /// The diagonal part of a component.
    pub fn part(&self, component: usize) -> Matrix<Interval> {
        let members = &self.components[component];
        Matrix::from_fn(members.len(), members.len(), |i, j| {
            self.matrix[(members[i], members[j])]
        })
    }

    /// Whether the unknowns are real ones under mirror symmetry, so that a real eigenvalue is one of the
    /// block and not one of the doubled system.
    pub fn is_real(&self) -> bool {
        self.place == Place::Real
    }

    /// The outermost ring of a component.
    pub fn ring(&self, component: usize) -> usize {
        let rings = self.components[component]
            .iter()
            .map(|&unknown| self.sites[self.kept[unknown]].ring());
        rings.max().unwrap_or(0)
    }
}

/// What is left of a matrix and its unknowns when eigenvectors are divided out, one after the other. One that
/// is not known to have an entry other than zero stays in.
fn without(
    mut matrix: Matrix<Interval>,
    mut unknowns: Vec<usize>,
    mut vectors: Vec<Vec<Interval>>,
) -> (Matrix<Interval>, Vec<usize>) {
    while let Some(vector) = vectors.pop() {
        // the innermost one reads the fewest, and the quotient couples everybody with what it reads
        let Some(pivot) = vector.iter().position(|x| x.certainly_nonzero()) else {
            continue;
        };
        let mut scaled: Vec<Interval> = vector.iter().map(|&x| x / vector[pivot]).collect();
        scaled[pivot] = Interval::point(1.0);
        matrix = quotient(&matrix, &scaled, pivot);
        unknowns.remove(pivot);
        for other in &mut vectors {
            let by = other[pivot];
            other.iter_mut().zip(&scaled).for_each(|(x, &s)| *x -= by * s);
            other.remove(pivot);
        }
    }
    (matrix, unknowns)
}

/// The unknowns that the marked ones depend on, themselves included.
fn depended_on(matrix: &Matrix<Interval>, marked: &[bool]) -> Vec<bool> {
    let mut reached = marked.to_vec();
    let mut open: Vec<usize> = (0..marked.len()).filter(|&unknown| marked[unknown]).collect();
    while let Some(reader) = open.pop() {
        for (source, entry) in matrix.row(reader).iter().enumerate() {
            if !reached[source] && !entry.is_zero() {
                reached[source] = true;
                open.push(source);
            }
        }
    }
    reached
}

/// The sites of the annulus's control points, in whatever sector.
fn controls(patches: &Patches) -> Vec<Site> {
    let all = patches.numbering().sites();
    let sectors = 0..patches.numbering().fan.sectors();
    let places = sectors.flat_map(|sector| patches.annulus.patches(sector));
    let mut indices: Vec<usize> = places.flat_map(|patch| patches.control(patch)).collect();
    indices.sort_unstable();
    indices.dedup();
    indices.into_iter().map(|index| all[index]).collect()
}

/// The blocks of a level on the rings of an annulus: of index 0 to N/2, or the one dense matrix, without the
/// given coordinates of the points if these are eigenvectors.
///
/// # Errors
/// [`Error::Spectral`] if the rings are not closed, [`Error::Size`] beyond [`MAX_BLOCK`] unknowns, or
/// [`MAX_POINTS`] of the undivided matrix.
pub fn blocks(
    level: &Level<Interval>,
    patches: &Patches,
    coordinates: Option<&[Vec<Interval>; 2]>,
) -> Result<Vec<Block>, Error> {
    let numbering = patches.numbering();
    let symmetric = level.is_rotation_symmetric();
    let (size, maximum) = if symmetric {
        let parts = if level.has_mirror() { 1 } else { 2 };
        (numbering.sector_points() * parts, MAX_BLOCK)
    } else {
        (numbering.count(), MAX_POINTS)
    };
    if size > maximum {
        return Err(Error::Size { size, maximum });
    }
    // orbits of the points that are read: a pair of mirror images shares its two unknowns
    let mut read: Vec<Site> = controls(patches).into_iter().map(|site| level.orbit(site)).collect();
    read.sort_unstable();
    read.dedup();
    let visible = |sites: &[Site]| {
        sites
            .iter()
            .map(|&site| read.binary_search(&level.orbit(site)).is_ok())
            .collect()
    };
    if !symmetric {
        let whole = Whole {
            index: 0,
            place: match coordinates {
                None => Place::Points,
                Some(_) => Place::Quotient,
            },
            matrix: local_matrix(level, numbering.rings)?,
            constant: Some(vec![true; numbering.count()]),
            known: coordinates.map_or(Vec::new(), |parts| parts.to_vec()),
            sites: numbering.sites(),
        };
        let visible = visible(&whole.sites);
        return Ok(vec![Block::new(whole, visible)]);
    }
    let n = numbering.fan.sectors();
    (0..=n / 2)
        .map(|index| {
            let whole = whole_block(level, numbering, index)?;
            let visible = visible(&whole.sites);
            Ok(Block::new(whole, visible))
        })
        .collect()
}

fn whole_block(level: &Level<Interval>, numbering: Numbering, index: usize) -> Result<Whole, Error> {
    let n = numbering.fan.sectors();
    let centre = numbering.count() - n * numbering.sector_points();
    let centre = std::iter::repeat_n(Site::CENTRE, if index == 0 { centre } else { 0 });
    let sites: Vec<Site> = centre.chain(numbering.sector_sites(0)).collect();
    let (matrix, place) = match fourier_block(level, numbering.rings, index)? {
        Fourier::Real(matrix) => (matrix, Place::Real),
        // phases of these indices are 1 and -1
        Fourier::Complex(matrix) if index == 0 || 2 * index == n => (matrix.map(|entry| entry.re), Place::Parts),
        Fourier::Complex(matrix) => {
            let size = matrix.rows();
            let doubled = Matrix::from_fn(2 * size, 2 * size, |i, j| {
                let Complex { re, im } = matrix[(i % size, j % size)];
                match (i < size, j < size) {
                    (true, false) => -im,
                    (false, true) => im,
                    _ => re,
                }
            });
            let sites = sites.iter().chain(&sites).copied().collect();
            return Ok(Whole {
                index,
                place: Place::Parts,
                matrix: doubled,
                constant: None,
                known: Vec::new(),
                sites,
            });
        }
    };
    // in the real unknowns a constant net has p = 1 and q = 0
    let one = |site: &Site| place == Place::Parts || site.x >= site.y;
    let constant = (index == 0).then(|| sites.iter().map(one).collect());
    Ok(Whole {
        index,
        place,
        matrix,
        constant,
        known: Vec::new(),
        sites,
    })
}
