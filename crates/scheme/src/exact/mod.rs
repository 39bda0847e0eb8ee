//! Stencil weights as exact numbers.

mod cosines;
mod roots;
#[cfg(test)]
mod tests;

pub use cosines::Cosines;

use crate::{Complex, Same, Scalar};
use num_rational::BigRational;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A real number of a cyclotomic field of order up to 2^13, with rational coefficients of any size, or
/// nothing: an operation that leaves these numbers (most square roots), or that costs too much, gives a
/// number without value, and so does every operation with one.
///
/// Numbers are sums of cosines of rational turns, which sums, products, conjugates and square roots of
/// rational numbers are again. Equality is decided: `sum of c_k w^k` with `w = exp(2 pi i/n)` has one form in
/// the basis of powers of w that is left when for every prime p dividing n, with `p^a` the power in n, the
/// exponents whose p-part (as an element of `Z/p^a`) has p - 1 as its first digit are replaced by
/// `w^k = -(w^(k + n/p) + .. + w^(k + (p-1) n/p))`: the p-parts are independent of each other, and phi(n)
/// powers remain.
///
/// Symmetry and the degree of the regular part are derived from these numbers, and equalities of weights are
/// decided in them.
#[derive(Clone, Debug)]
pub struct Exact(Option<Box<Cosines>>);

fn fraction(p: i64, q: i64) -> BigRational {
    BigRational::new(p.into(), q.into())
}

impl Exact {
    /// The value, if it could be represented.
    pub fn cosines(&self) -> Option<&Cosines> {
        self.0.as_deref()
    }

    /// Whether it could be represented.
    pub fn has_value(&self) -> bool {
        self.0.is_some()
    }

    /// The value, if it is a rational number.
    pub fn as_rational(&self) -> Option<BigRational> {
        let cosines = self.cosines()?;
        if cosines.terms.len() < 2 {
            return cosines.terms.is_empty().then(|| cosines.rational.clone());
        }
        let settled = cosines.clone().settled();
        settled.terms.is_empty().then_some(settled.rational)
    }

    /// Whether the number is zero; `None` for a number without value.
    pub fn is_zero(&self) -> Option<bool> {
        let cosines = self.cosines()?;
        Some(match cosines.terms.len() {
            0 => cosines.rational.is_zero(),
            // a single cosine that is listed is irrational
            1 => false,
            _ => cosines.coefficients(cosines.order()).is_empty(),
        })
    }

    /// A complex number as a sum of powers of `exp(2 pi i/order)`: exponents in `0..order` with their
    /// coefficients, equal for equal numbers. `None` for a number without value, and for one that is not of
    /// the field of that order.
    pub fn powers(z: &Complex<Exact>, order: usize) -> Option<Vec<(usize, BigRational)>> {
        cosines::powers(z.re.cosines()?, z.im.cosines()?, i64::try_from(order).ok()?)
    }

    /// How many coefficients the number has, and the machine words of the longest.
    pub(crate) fn size(&self) -> (usize, usize) {
        let words = |value: &BigRational| 1 + ((value.numer().bits() + value.denom().bits()) / 64) as usize;
        self.cosines().map_or((1, 1), |cosines| {
            let longest = cosines.terms.values().map(words).max().unwrap_or(1);
            (1 + cosines.terms.len(), longest.max(words(&cosines.rational)))
        })
    }

    /// The number in another type; `None` for a number without value.
    pub fn to<S: Scalar>(&self) -> Option<S> {
        let cosines = self.cosines()?;
        let mut sum = S::rational(&cosines.rational);
        for (factor, k, n) in cosines.terms() {
            sum += S::rational(factor) * S::cos_turn(k, n);
        }
        Some(sum)
    }

    fn of(cosines: Option<Cosines>) -> Self {
        Exact(cosines.map(Box::new))
    }

    fn combine(self, other: Self, f: impl Fn(Cosines, Cosines) -> Option<Cosines>) -> Self {
        match (self.0, other.0) {
            (Some(a), Some(b)) => Self::of(f(*a, *b)),
            _ => Exact(None),
        }
    }
}

impl PartialEq for Exact {
    /// Equality of values, or of having none.
    fn eq(&self, other: &Self) -> bool {
        match (self.cosines(), other.cosines()) {
            (Some(a), Some(b)) if a.terms == b.terms => a.rational == b.rational,
            (Some(a), Some(b)) if a.terms.is_empty() && b.terms.is_empty() => false,
            (Some(_), Some(_)) => (self.clone() - other.clone()).is_zero() == Some(true),
            (None, None) => true,
            _ => false,
        }
    }
}

impl Same for Exact {
    /// Two numbers without value are not known to be the same.
    fn same(&self, other: &Self) -> bool {
        self.has_value() && self == other
    }
}

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, |mut a, b| {
            a.rational += &b.rational;
            for (factor, k, n) in b.terms() {
                a.add(factor, k, n);
            }
            a.is_affordable().then_some(a)
        })
    }
}

impl Neg for Exact {
    type Output = Self;
    fn neg(self) -> Self {
        Self::of(self.0.map(|a| a.scaled(&-BigRational::one())))
    }
}

impl Sub for Exact {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, |a, b| a.product(&b))
    }
}

impl Div for Exact {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.combine(other, |a, b| a.product(&b.inverse()?))
    }
}

impl AddAssign for Exact {
    fn add_assign(&mut self, other: Self) {
        *self = std::mem::replace(self, Exact(None)) + other;
    }
}

impl SubAssign for Exact {
    fn sub_assign(&mut self, other: Self) {
        *self = std::mem::replace(self, Exact(None)) - other;
    }
}

impl Scalar for Exact {
    fn ratio(p: i64, q: i64) -> Self {
        let value = (q != 0).then(|| fraction(p, q));
        Self::of(value.map(Cosines::rational))
    }

    fn exact(value: f64) -> Self {
        Self::of(BigRational::from_float(value).map(Cosines::rational))
    }

    fn rational(value: &BigRational) -> Self {
        Self::of(Some(Cosines::rational(value.clone())))
    }

    fn sqrt(self) -> Self {
        Self::of(self.0.and_then(|square| square.root()))
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        if n == 0 {
            return Exact(None);
        }
        let mut cosine = Cosines::rational(BigRational::zero());
        match n.checked_abs() {
            Some(n) if n <= i64::MAX / 2 => cosine.add(&BigRational::one(), k, n),
            _ => return Exact(None),
        }
        Self::of(cosine.is_affordable().then_some(cosine))
    }
}
