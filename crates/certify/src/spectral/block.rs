//! Fourier blocks of interval matrices, without the constant vector, and their components.

use super::MAX_BLOCK;
use super::graph::components;
use crate::linear::quotient;
use crate::{Error, Interval};
use eigenring_scheme::{Level, Scalar};
use eigenring_spectral::{Block as Fourier, Matrix, fourier_block, local_matrix, numbering};

/// One Fourier block.
#[derive(Clone, Debug)]
pub struct Block {
    /// The Fourier index k, at most N/2.
    pub index: usize,
    /// How the unknowns of [`Block::matrix`] stand for the points.
    pub place: Place,
    /// The matrix to be analysed: for index 0 without the constant vector.
    pub matrix: Matrix<Interval>,
    /// The row of the unknown that was divided out; empty if none was.
    pub divided: Vec<Interval>,
    /// The components of the matrix, in an order in which each reads only earlier ones.
    pub components: Vec<Vec<usize>>,
    /// For each component the earlier ones that it reads, directly or not.
    pub reads: Vec<Vec<usize>>,
}

/// What the unknowns of a block are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The real unknowns of [`FourierNet`](eigenring_scheme::FourierNet) with mirror symmetry. For index 0 the constant
    /// vector is 1 at the unknowns marked here, and the first is divided out.
    Real(Option<Vec<bool>>),
    /// Real parts of the values, then imaginary parts: for rules without mirror symmetry. Each eigenvalue of the block comes
    /// with its conjugate, the eigenvalue of the conjugate block.
    Parts,
    /// The points themselves, without the first: for rules that differ from sector to sector.
    Points,
}

impl Block {
    fn new(index: usize, place: Place, divided: Vec<Interval>, matrix: Matrix<Interval>) -> Self {
        let (components, reads) = components(matrix.rows(), |i, j| !matrix[(i, j)].is_zero());
        Block {
            index,
            place,
            matrix,
            divided,
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

    /// Whether the unknowns are real ones under mirror symmetry, so that a real eigenvalue is one of the block and not one
    /// of the doubled system.
    pub fn is_real(&self) -> bool {
        matches!(self.place, Place::Real(_))
    }
}

/// The blocks of a level on `rings` rings: of index 0 to N/2, or the one dense matrix.
///
/// # Errors
/// [`Error::Spectral`] if the rings are not closed, [`Error::Size`] beyond [`MAX_BLOCK`] unknowns.
pub fn blocks(level: &Level<Interval>, rings: usize) -> Result<Vec<Block>, Error> {
    let numbering = numbering(level, rings);
    let size = if level.symmetric {
        numbering.sector_points() * if level.mirror { 1 } else { 2 }
    } else {
        numbering.count()
    };
    if size > MAX_BLOCK {
        return Err(Error::Size {
            size,
            maximum: MAX_BLOCK,
        });
    }
    if !level.symmetric {
        let whole = local_matrix(level, rings)?;
        let ones = vec![Interval::one(); whole.rows()];
        let matrix = quotient(&whole, &ones, 0);
        return Ok(vec![Block::new(0, Place::Points, whole.row(0).to_vec(), matrix)]);
    }
    let n = level.fan.sectors();
    (0..=n / 2)
        .map(|index| {
            let real = index == 0 || 2 * index == n;
            let (whole, constant) = match fourier_block(level, rings, index)? {
                Fourier::Real(matrix) => {
                    // a constant net has p = 1 and q = 0
                    let sites = numbering.sector_sites(0).map(|site| site.x >= site.y);
                    let centre = numbering.count() - n * numbering.sector_points();
                    (
                        matrix,
                        std::iter::repeat_n(true, centre).chain(sites).collect::<Vec<bool>>(),
                    )
                }
                // phases of these indices are 1 and -1
                Fourier::Complex(matrix) if real => {
                    let size = matrix.rows();
                    (matrix.map(|(re, _)| re), vec![true; size])
                }
                Fourier::Complex(matrix) => {
                    let size = matrix.rows();
                    let whole = Matrix::from_fn(2 * size, 2 * size, |i, j| {
                        let (re, im) = matrix[(i % size, j % size)];
                        match (i < size, j < size) {
                            (true, false) => -im,
                            (false, true) => im,
                            _ => re,
                        }
                    });
                    return Ok(Block::new(index, Place::Parts, Vec::new(), whole));
                }
            };
            if index > 0 {
                return Ok(Block::new(index, Place::Real(None), Vec::new(), whole));
            }
            let ones: Vec<Interval> = constant.iter().map(|&one| Interval::point(f64::from(one))).collect();
            let matrix = quotient(&whole, &ones, 0);
            let place = Place::Real(Some(constant));
            Ok(Block::new(0, place, whole.row(0).to_vec(), matrix))
        })
        .collect()
}
