//! Polynomials over a cyclotomic field.

use super::field::{Element, Field, add, scaled, subtract};
use crate::Interval;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

/// A polynomial, lowest coefficient first, without zeros at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Poly(Vec<Element>);

impl Poly {
    /// The polynomial with the given coefficients, lowest first.
    pub fn new(mut coefficients: Vec<Element>) -> Self {
        while coefficients.last().is_some_and(Vec::is_empty) {
            coefficients.pop();
        }
        Poly(coefficients)
    }

    /// The characteristic polynomial `det(x - A)` of a square matrix given by rows, by the recursion of
    /// Faddeev and Le Verrier: `M_1 = I`, `c_{n-k} = -trace(A M_k)/k`, `M_{k+1} = A M_k + c_{n-k} I`.
    pub fn characteristic(matrix: &[Vec<Element>], field: &Field) -> Self {
        let size = matrix.len();
        let zero = Vec::new;
        let mut coefficients = vec![zero(); size + 1];
        coefficients[size] = field.integer(1);
        let mut m: Vec<Vec<Element>> = (0..size)
            .map(|i| {
                (0..size)
                    .map(|j| if i == j { field.integer(1) } else { zero() })
                    .collect()
            })
            .collect();
        for k in 1..=size {
            let image: Vec<Vec<Element>> = (0..size)
                .map(|i| {
                    let entry =
                        |j: usize| (0..size).fold(zero(), |sum, l| add(&sum, &field.times(&matrix[i][l], &m[l][j])));
                    (0..size).map(entry).collect()
                })
                .collect();
            let trace = (0..size).fold(zero(), |sum, i| add(&sum, &image[i][i]));
            let c = scaled(&trace, &-BigRational::new(BigInt::one(), BigInt::from(k)));
            m = image;
            for (i, row) in m.iter_mut().enumerate() {
                row[i] = add(&row[i], &c);
            }
            coefficients[size - k] = c;
        }
        Poly::new(coefficients)
    }

    /// The coefficients, lowest first.
    pub fn coefficients(&self) -> &[Element] {
        &self.0
    }

    /// The degree; 0 for zero.
    pub fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The value at an element.
    pub fn at(&self, x: &Element, field: &Field) -> Element {
        self.0
            .iter()
            .rev()
            .fold(Vec::new(), |sum, c| add(&field.times(&sum, x), c))
    }

    /// `f(x^2)`.
    pub fn substitute_square(&self, _field: &Field) -> Self {
        let mut coefficients = vec![Vec::new(); 2 * self.0.len()];
        for (power, c) in self.0.iter().enumerate() {
            coefficients[2 * power] = c.clone();
        }
        Poly::new(coefficients)
    }

    /// The derivative.
    pub fn derivative(&self, field: &Field) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Poly::new(
            terms
                .map(|(power, c)| field.times(c, &field.integer(power as i64)))
                .collect(),
        )
    }

    /// Quotient and remainder; `None` if the divisor is zero.
    pub fn divide(&self, by: &Poly, field: &Field) -> Option<(Poly, Poly)> {
        let lead = field.inverse(by.0.last()?)?;
        let mut remainder = self.clone();
        let mut quotient = vec![Vec::new(); (self.0.len() + 1).saturating_sub(by.0.len())];
        while remainder.0.len() >= by.0.len() {
            let shift = remainder.0.len() - by.0.len();
            let factor = field.times(remainder.0.last()?, &lead);
            for (i, b) in by.0.iter().enumerate() {
                remainder.0[shift + i] = subtract(&remainder.0[shift + i], &field.times(&factor, b));
            }
            // the leading term vanishes by construction
            remainder.0.pop();
            remainder = Poly::new(remainder.0);
            quotient[shift] = factor;
        }
        Some((Poly::new(quotient), remainder))
    }

    /// The monic greatest common divisor; `None` if both are zero.
    pub fn gcd(&self, other: &Poly, field: &Field) -> Option<Poly> {
        let (mut a, mut b) = (self.clone(), other.clone());
        while !b.is_zero() {
            let (_, remainder) = a.divide(&b, field)?;
            // monic remainders keep the coefficients small
            (a, b) = (b, remainder.monic(field).unwrap_or_else(|| Poly::new(Vec::new())));
        }
        a.monic(field)
    }

    fn monic(&self, field: &Field) -> Option<Poly> {
        let lead = field.inverse(self.0.last()?)?;
        Some(Poly::new(self.0.iter().map(|c| field.times(c, &lead)).collect()))
    }

    /// An enclosure of the values at the members of an interval, for a polynomial with real coefficients:
    /// their imaginary parts are not looked at.
    pub fn enclose(&self, field: &Field, x: Interval) -> Interval {
        let coefficients = self.0.iter().rev().map(|c| field.enclose(c).0);
        coefficients.fold(Interval::point(0.0), |sum, c| sum * x + c)
    }
}
