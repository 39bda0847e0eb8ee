//! Cyclotomic fields.

use crate::Interval;
use eigenring_scheme::{Complex, Exact, Scalar};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// `Q(w)` with `w = exp(2 pi i/N)`.
#[derive(Clone, Debug)]
pub struct Field {
    order: usize,
    /// The cyclotomic polynomial, monic, lowest coefficient first.
    modulus: Vec<BigRational>,
}

/// A number of a [`Field`]: a polynomial in w of a degree below that of the field, lowest coefficient first,
/// without zeros at the end. Equal numbers have equal coefficients.
pub type Element = Vec<BigRational>;

impl Field {
    /// The field of an order N >= 1 (0 is taken as 1).
    pub fn new(order: usize) -> Self {
        let order = order.max(1);
        // x^m - 1 is the product of the cyclotomic polynomials of the divisors of m
        let mut known: Vec<(usize, Vec<BigRational>)> = Vec::new();
        for m in (1..=order).filter(|m| order.is_multiple_of(*m)) {
            let mut polynomial = vec![BigRational::zero(); m + 1];
            polynomial[0] = -BigRational::one();
            polynomial[m] = BigRational::one();
            for (_, factor) in known.iter().filter(|(d, _)| m.is_multiple_of(*d)) {
                polynomial = divide(&polynomial, factor).0;
            }
            known.push((m, polynomial));
        }
        let modulus = known.pop().map(|(_, polynomial)| polynomial).unwrap_or_default();
        Field { order, modulus }
    }

    /// The order N of w.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The dimension over the rational numbers.
    pub fn degree(&self) -> usize {
        self.modulus.len() - 1
    }

    /// A rational number.
    pub fn rational(&self, value: BigRational) -> Element {
        trimmed(vec![value])
    }

    /// An integer.
    pub fn integer(&self, value: i64) -> Element {
        self.rational(BigRational::from(BigInt::from(value)))
    }

    /// `w^power`.
    pub fn root(&self, power: i64) -> Element {
        let power = power.rem_euclid(self.order as i64) as usize;
        let mut element = vec![BigRational::zero(); power + 1];
        element[power] = BigRational::one();
        self.reduced(element)
    }

    /// A complex number; `None` if it has no value or is not of this field.
    pub fn element(&self, z: &Complex<Exact>) -> Option<Element> {
        let powers = Exact::powers(z, self.order)?;
        let mut element = vec![BigRational::zero(); self.order];
        for (power, coefficient) in powers {
            element[power] = coefficient;
        }
        Some(self.reduced(trimmed(element)))
    }

    /// The product.
    pub fn times(&self, a: &Element, b: &Element) -> Element {
        self.reduced(product(a, b))
    }

    /// The inverse, by the extended Euclidean algorithm; `None` for zero.
    pub fn inverse(&self, a: &Element) -> Option<Element> {
        if a.is_empty() {
            return None;
        }
        // invariants: r = s a modulo the cyclotomic polynomial
        let (mut r0, mut r1) = (self.modulus.clone(), a.clone());
        let (mut s0, mut s1) = (Vec::new(), vec![BigRational::one()]);
        while r1.len() > 1 {
            let (quotient, remainder) = divide(&r0, &r1);
            let next = subtract(&s0, &product(&quotient, &s1));
            (r0, r1) = (r1, remainder);
            (s0, s1) = (s1, next);
        }
        // the modulus is irreducible, so the last remainder is a number that is not zero
        let scale = r1.first()?.recip();
        Some(self.reduced(scaled(&s1, &scale)))
    }

    /// Real and imaginary part of a number.
    pub fn enclose(&self, a: &Element) -> (Interval, Interval) {
        let mut sum = (Interval::point(0.0), Interval::point(0.0));
        for (power, coefficient) in a.iter().enumerate() {
            let coefficient = <Interval as Scalar>::rational(coefficient);
            let (k, n) = (power as i64, self.order as i64);
            sum.0 += coefficient * <Interval as Scalar>::cos_turn(k, n);
            sum.1 += coefficient * <Interval as Scalar>::sin_turn(k, n);
        }
        sum
    }

    fn reduced(&self, a: Element) -> Element {
        if a.len() < self.modulus.len() {
            trimmed(a)
        } else {
            divide(&a, &self.modulus).1
        }
    }
}

/// The sum.
pub(super) fn add(a: &Element, b: &Element) -> Element {
    let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
    let mut sum = long.clone();
    for (sum, b) in sum.iter_mut().zip(short) {
        *sum += b;
    }
    trimmed(sum)
}

/// The difference.
pub(super) fn subtract(a: &Element, b: &Element) -> Element {
    add(a, &b.iter().map(|b| -b).collect())
}

/// A rational multiple.
pub(super) fn scaled(a: &Element, by: &BigRational) -> Element {
    trimmed(a.iter().map(|a| a * by).collect())
}

fn trimmed(mut a: Element) -> Element {
    while a.last().is_some_and(|last| last.is_zero()) {
        a.pop();
    }
    a
}

fn product(a: &Element, b: &Element) -> Element {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut sum = vec![BigRational::zero(); a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
        for (j, b) in b.iter().enumerate().filter(|(_, b)| !b.is_zero()) {
            sum[i + j] += a * b;
        }
    }
    sum
}

/// Quotient and remainder of polynomials with rational coefficients; `by` must not be zero.
fn divide(a: &Element, by: &Element) -> (Element, Element) {
    let mut remainder = trimmed(a.clone());
    let degree = by.len() - 1;
    let mut quotient = vec![BigRational::zero(); (remainder.len() + 1).saturating_sub(by.len())];
    while remainder.len() > degree {
        let shift = remainder.len() - 1 - degree;
        let factor = &remainder[remainder.len() - 1] / &by[degree];
        for (i, b) in by.iter().enumerate() {
            if !b.is_zero() {
                remainder[shift + i] -= &factor * b;
            }
        }
        remainder.pop();
        quotient[shift] = factor;
        remainder = trimmed(remainder);
    }
    (trimmed(quotient), remainder)
}
