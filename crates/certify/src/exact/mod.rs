//! Exact arithmetic: equalities that no interval can prove.
//!
//! An enclosure of a difference that is zero contains both signs, however sharp it is. Equalities (stencils
//! sum to 1, `mu = lambda^2`) are therefore decided in exact numbers, of the scheme as it was written down:
//!
//! * [`Exact`]: a stencil weight `a + b cos(2 pi k/n)` with rational a, b: what all
//!   rational schemes and the original Doo-Sabin weights consist of.
//! * [`Field`]: the cyclotomic field `Q(w)`, `w = exp(2 pi i/N)`, as polynomials in w modulo the cyclotomic
//!   polynomial. Fourier blocks of such schemes have their entries there.
//! * [`Poly`]: polynomials over the field, among them the characteristic polynomials of blocks.
//!
//! **`mu = lambda^2`.** Let `f` be the characteristic polynomial of the block of lambda and `g` that of the
//! block of mu, both exact. Then `lambda^2` is an eigenvalue of the second block exactly if lambda is a root
//! of `d = gcd(f(x), g(x^2))`. For a simple root of f in a known interval this is decided by intervals once
//! more: of `d` and `f/d` exactly one vanishes there, and the other is bounded away from zero.
//!
//! Whatever does not fit (weights without exact value, blocks of more than [`MAX_SIZE`] unknowns) is "not
//! decidable here", never an error and never a guess.

mod field;
mod polynomial;

pub use field::{Element, Field};
pub use polynomial::Poly;

use crate::Interval;
use eigenring_scheme::{Exact, Lattice, Level, Symmetry};
use eigenring_spectral::{fourier_block, numbering};

/// The largest block whose characteristic polynomial is worked out: the two-ring schemes of order 6 have 7
/// unknowns.
pub const MAX_SIZE: usize = 8;

/// The exact characteristic polynomial of the block of Fourier index `index` on `rings` rings of a level that
/// is the same in all sectors. `None` if it has more than [`MAX_SIZE`] unknowns, a weight has no exact value,
/// the rings are not closed, or an entry is not of the field, which should be that of the sectors.
pub fn block_polynomial(field: &Field, level: &Level<Exact>, rings: usize, index: usize) -> Option<Poly> {
    let numbering = numbering(level, rings);
    let centre = usize::from(index == 0 && numbering.lattice == Lattice::Vertex);
    if numbering.sector_points() + centre > MAX_SIZE {
        return None;
    }
    // half turns, which the real unknowns of mirror symmetry need, may be of no field of this order
    let level = level.clone().with_at_most(Symmetry::Rotation);
    let block = fourier_block(&level, rings, index).ok()?.to_complex();
    let row = |i: usize| block.row(i).iter().map(|entry| field.element(entry)).collect();
    let matrix = (0..block.rows()).map(row).collect::<Option<Vec<_>>>()?;
    Some(Poly::characteristic(&matrix, field))
}

/// Whether the square of a root of `first` is a root of `second`, given an interval that holds exactly one
/// root of `first`, a simple one. `None` if this cannot be told.
pub fn square_is_root(field: &Field, first: &Poly, second: &Poly, root: Interval) -> Option<bool> {
    if first.enclose(field, root).certainly_nonzero() {
        // not a root of this polynomial at all
        return None;
    }
    let common = first.gcd(&second.substitute_square(field), field)?;
    if common.degree() == 0 {
        return Some(false);
    }
    let (cofactor, _) = first.divide(&common, field)?;
    if cofactor.enclose(field, root).certainly_nonzero() {
        Some(true)
    } else if common.enclose(field, root).certainly_nonzero() {
        Some(false)
    } else {
        None
    }
}

/// Whether a root of `first` is a repeated root, given an interval around it that holds no other root.
pub fn is_repeated(field: &Field, first: &Poly, root: Interval) -> Option<bool> {
    let common = first.gcd(&first.derivative(field), field)?;
    if common.degree() == 0 || common.enclose(field, root).certainly_nonzero() {
        return Some(false);
    }
    // every root of f is a root of f / gcd(f, f'), and a simple one: if the common factor has all of those,
    // the root is repeated
    let (simple, _) = first.divide(&common, field)?;
    let (rest, remainder) = simple.divide(&simple.gcd(&common, field)?, field)?;
    (remainder.is_zero() && rest.enclose(field, root).certainly_nonzero()).then_some(true)
}

#[cfg(test)]
mod tests;
