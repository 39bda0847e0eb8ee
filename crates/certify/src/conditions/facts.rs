//! Equalities of eigenvalues, decided by exact polynomials.

use crate::exact::{self, Field, Poly, block_polynomial};
use crate::spectral::{EnclosedEigenvalue, EnclosedSpectrum};
use crate::{Interval, Subject};
use eigenring_spectral::SecondOrder;
use std::collections::BTreeMap;

/// Equalities, decided exactly: whether `lambda^2` is an eigenvalue of a block.
pub struct Facts<'a> {
    subject: &'a Subject,
    field: Option<Field>,
    polynomials: BTreeMap<(usize, usize), Option<Poly>>,
}

impl<'a> Facts<'a> {
    /// The facts of a subject. Polynomials are worked out when they are asked for.
    pub fn new(subject: &'a Subject) -> Self {
        Facts {
            subject,
            field: None,
            polynomials: BTreeMap::new(),
        }
    }

    fn polynomial(&mut self, index: usize, rings: usize) -> Option<(&Field, Poly)> {
        let exact = self.subject.exact.as_ref()?;
        let field = self.field.get_or_insert_with(|| Field::new(exact.valence()));
        let known = self
            .polynomials
            .entry((index, rings))
            .or_insert_with(|| block_polynomial(field, exact.limit(), rings, index));
        Some((&*field, known.clone()?))
    }

    /// Whether the square of lambda, an eigenvalue of block 1 that no other of the block comes near, is an
    /// eigenvalue of a block.
    pub fn square_in(&mut self, index: usize, lambda: Interval) -> Option<bool> {
        let valence = self.subject.scheme.valence();
        if let Some(identities) = self.subject.identities {
            let second_order = SecondOrder::copies_in(valence, index) > 0;
            return (second_order && identities.square).then_some(true);
        }
        let rings = self.subject.scheme.closed_rings().ok()?;
        let (_, first) = self.polynomial(1, rings)?;
        let (field, second) = self.polynomial(index, rings)?;
        exact::square_is_root(field, &first, &second, lambda)
    }

    /// Whether `lambda^2`, an eigenvalue of a block, is a repeated one there.
    pub fn square_is_double(&mut self, index: usize, lambda: Interval) -> bool {
        if self.subject.identities.is_some() {
            // block 2 at valence 4 is diagonal with the entries g3 = mu and f3 = mu
            return true;
        }
        let Ok(rings) = self.subject.scheme.closed_rings() else {
            return false;
        };
        let polynomial = self.polynomial(index, rings);
        polynomial.and_then(|(field, f)| exact::is_repeated(field, &f, lambda.square())) == Some(true)
    }

    /// Whether an eigenvalue of a block is repeated already on one ring more than the smallest net.
    pub fn repeated(&mut self, spectrum: &EnclosedSpectrum, entry: &EnclosedEigenvalue) -> Option<bool> {
        let rings = self.subject.scheme.closed_rings().ok()? + 1;
        if !within(spectrum, entry, rings) {
            return None;
        }
        // no root in the hull of all that come near is simple: then this one is not
        let near = spectrum
            .entries
            .iter()
            .filter(|e| e.index == entry.index && !e.value.re.disjoint(entry.value.re));
        let hull = near.fold(entry.value.re, |hull, near| hull.hull(near.value.re));
        let (field, polynomial) = self.polynomial(entry.index, rings)?;
        exact::is_repeated(field, &polynomial, hull)
    }
}

/// Whether an eigenvalue is one of the smaller block on `rings` rings: that of a component inside them.
pub fn within(spectrum: &EnclosedSpectrum, entry: &EnclosedEigenvalue, rings: usize) -> bool {
    let block = spectrum.block(entry.index).filter(|block| block.is_real());
    block.is_some_and(|block| block.ring(entry.component) <= rings)
}
