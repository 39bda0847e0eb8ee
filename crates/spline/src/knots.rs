//! Open-knot B-spline functions of one variable.
//!
//! Knots `u_0 <= ... <= u_{n+p}` of degree p carry n basis functions (Cox 1972, de Boor 1972), with
//! `0/0 = 0`:
//!
//! ```text
//! N_{i,0}(u) = 1 on [u_i, u_{i+1}), else 0
//! N_{i,p}(u) = (u - u_i)/(u_{i+p} - u_i) N_{i,p-1}(u) + (u_{i+p+1} - u)/(u_{i+p+1} - u_{i+1}) N_{i+1,p-1}(u)
//! N'_{i,p}   = p [ N_{i,p-1}/(u_{i+p} - u_i) - N_{i+1,p-1}/(u_{i+p+1} - u_{i+1}) ]
//! ```
//!
//! (Piegl and Tiller, *The NURBS Book*, 1997, Eqs. 2.5 and 2.7.) The knots are *open*: the end knots have
//! multiplicity p+1, so that the domain is `[u_0, u_{n+p}]` and the spline takes its first and last
//! coefficient at the ends. A knot of multiplicity m leaves p-m continuous derivatives; interior
//! multiplicities go up to p, a kink.
//!
//! On a *span*, an index j with `u_j < u_{j+1}`, the p+1 functions `N_{j-p} .. N_j` are polynomials and all
//! others vanish. The span is found in f64, the polynomials are evaluated in any [`Scalar`] and may be
//! continued beyond their span, which gives one-sided derivatives at a multiple knot and enclosures over
//! intervals of the argument.

use crate::{Error, Scalar};

/// A validated open knot vector with its degree: the spline space without coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Knots {
    degree: usize,
    values: Vec<f64>,
}

/// The p+1 basis functions that live on one span, at one point.
///
/// Entry k of each array belongs to basis function `first + k`.
#[derive(Clone, Debug)]
pub struct Basis<S> {
    /// Index of the first function that does not vanish on the span.
    pub first: usize,
    /// Values; they sum to one.
    pub values: Vec<S>,
    /// First derivatives.
    pub first_derivatives: Vec<S>,
    /// Second derivatives.
    pub second_derivatives: Vec<S>,
}

impl Knots {
    /// Checks and keeps a knot vector.
    ///
    /// # Errors
    /// [`Error::Knots`] unless the degree is at least 1, there are at least 2(p+1) knots, all finite and
    /// non-decreasing, the first and last p+1 coincide and no interior knot occurs more than p times.
    pub fn new(degree: usize, values: Vec<f64>) -> Result<Self, Error> {
        let refuse = |index: usize, reason| {
            let value = values.get(index).copied().unwrap_or(f64::NAN);
            Err(Error::Knots { index, value, reason })
        };
        if degree == 0 {
            return refuse(0, "the degree must be at least 1");
        }
        if values.len() < 2 * (degree + 1) {
            return refuse(values.len(), "an open knot vector has at least 2 (degree + 1) knots");
        }
        if let Some(index) = values.iter().position(|u| !u.is_finite()) {
            return refuse(index, "knots are finite");
        }
        if let Some(index) = values.windows(2).position(|pair| pair[1] < pair[0]) {
            return refuse(index + 1, "knots do not decrease");
        }
        let last = values.len() - 1;
        if values[degree] != values[0] {
            return refuse(degree, "the first degree + 1 knots coincide");
        }
        if values[last - degree] != values[last] {
            return refuse(last - degree, "the last degree + 1 knots coincide");
        }
        // degree + 1 equal knots in the interior would tear the spline apart; at the ends that is one too
        // many
        if let Some(index) = (1..last - degree).find(|&i| values[i + degree] == values[i]) {
            return refuse(
                index,
                "interior knots occur at most degree times, end knots degree + 1 times",
            );
        }
        Ok(Knots { degree, values })
    }

    /// The degree p.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots with their multiplicities.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Dimension of the spline space: the number of coefficients.
    pub fn dimension(&self) -> usize {
        self.values.len() - self.degree - 1
    }

    /// First and last knot.
    pub fn domain(&self) -> (f64, f64) {
        (self.values[0], self.values[self.values.len() - 1])
    }

    /// The span that contains `x`: the one that begins at `x` if `x` is a knot, the last one at the end of
    /// the domain. `None` outside of the domain and for NaN.
    pub fn span(&self, x: f64) -> Option<usize> {
        let (start, end) = self.domain();
        if !(start <= x && x <= end) {
            return None;
        }
        let after = self.values.partition_point(|&u| u <= x);
        Some(after.min(self.dimension()) - 1)
    }

    /// The span that ends at or contains `x`: like [`Knots::span`], but at a knot the one on its left.
    pub fn span_before(&self, x: f64) -> Option<usize> {
        self.span(x)?;
        let before = self.values.partition_point(|&u| u < x);
        Some(before.max(self.degree + 1) - 1)
    }

    /// The spans: each index j with `u_j < u_{j+1}`.
    pub fn spans(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.values.len() - 1).filter(|&j| self.values[j] < self.values[j + 1])
    }

    /// Values and two derivatives at `x` of the polynomials which the basis functions are on `span`.
    ///
    /// `span` must come from [`Knots::span`], [`Knots::span_before`] or [`Knots::spans`]; then no divisor is
    /// zero.
    pub fn basis<S: Scalar + Copy>(&self, span: usize, x: S) -> Basis<S> {
        debug_assert!(self.values[span] < self.values[span + 1], "span {span} is empty");
        let p = self.degree;
        // lower[q] = the q+1 functions of degree q on the span, the first with index span - q
        let mut lower: Vec<Vec<S>> = vec![vec![S::one()]];
        for q in 1..=p {
            let below = &lower[q - 1];
            let mut functions = vec![S::zero(); q + 1];
            for (k, &value) in below.iter().enumerate() {
                let (left, right) = self.support(span + 1 - q + k, q);
                let share = value / (right - left);
                functions[k] += (right - x) * share;
                functions[k + 1] += (x - left) * share;
            }
            lower.push(functions);
        }
        let second = match p {
            1 => vec![S::zero(); 2],
            _ => self.raise(span, p, &self.raise(span, p - 1, &lower[p - 2])),
        };
        let first_derivatives = self.raise(span, p, &lower[p - 1]);
        let values = lower.swap_remove(p);
        Basis {
            first: span - p,
            values,
            first_derivatives,
            second_derivatives: second,
        }
    }

    /// Ends of the support of function `i` of degree `q - 1`.
    fn support<S: Scalar + Copy>(&self, i: usize, q: usize) -> (S, S) {
        (S::exact(self.values[i]), S::exact(self.values[i + q]))
    }

    /// From (derivatives of) the degree q-1 functions on the span to the next derivative of the degree q
    /// functions.
    fn raise<S: Scalar + Copy>(&self, span: usize, q: usize, below: &[S]) -> Vec<S> {
        let mut derivatives = vec![S::zero(); q + 1];
        for (k, &value) in below.iter().enumerate() {
            let (left, right): (S, S) = self.support(span + 1 - q + k, q);
            let slope = S::ratio(q as i64, 1) * value / (right - left);
            derivatives[k] += -slope;
            derivatives[k + 1] += slope;
        }
        derivatives
    }
}

impl<S: Scalar + Copy> Basis<S> {
    /// `sum_k weights[k] coefficients[first + k]`, with `weights` one of the arrays of this basis.
    pub fn combine(&self, weights: &[S], coefficients: &[f64]) -> S {
        let mut sum = S::zero();
        for (&weight, &coefficient) in weights.iter().zip(&coefficients[self.first..]) {
            sum += weight * S::exact(coefficient);
        }
        sum
    }
}

/// A B-spline function: knots and one coefficient for each basis function.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    knots: Knots,
    coefficients: Vec<f64>,
}

impl Spline {
    /// The spline with the given coefficients.
    ///
    /// # Errors
    /// [`Error::Coefficients`] unless there are as many as the space has dimensions, all finite.
    pub fn new(knots: Knots, coefficients: Vec<f64>) -> Result<Self, Error> {
        let expected = knots.dimension();
        let finite = coefficients.iter().filter(|c| c.is_finite()).count();
        if coefficients.len() != expected || finite != expected {
            return Err(Error::Coefficients { finite, expected });
        }
        Ok(Spline { knots, coefficients })
    }

    /// The spline space.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// The coefficients.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The value; `None` outside of the domain and for NaN.
    pub fn value(&self, x: f64) -> Option<f64> {
        Some(self.value_in(self.knots.span(x)?, x))
    }

    /// The derivative, from the right at a kink (from the left at the end of the domain).
    pub fn derivative(&self, x: f64) -> Option<f64> {
        let basis = self.knots.basis(self.knots.span(x)?, x);
        Some(basis.combine(&basis.first_derivatives, &self.coefficients))
    }

    /// The second derivative, from the right where it jumps (from the left at the end of the domain).
    pub fn second_derivative(&self, x: f64) -> Option<f64> {
        let basis = self.knots.basis(self.knots.span(x)?, x);
        Some(basis.combine(&basis.second_derivatives, &self.coefficients))
    }

    /// The polynomial of one span, at any scalar `x`; see [`Knots::basis`] for the span.
    pub fn value_in<S: Scalar + Copy>(&self, span: usize, x: S) -> S {
        let basis = self.knots.basis(span, x);
        basis.combine(&basis.values, &self.coefficients)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dual;

    fn kinked() -> Spline {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.25, 3.0, 3.0, 3.0, 3.0];
        let knots = Knots::new(3, knots).unwrap();
        let coefficients = (0..knots.dimension())
            .map(|i| ((i * i * 7 % 11) as f64 - 4.0) / 3.0)
            .collect();
        Spline::new(knots, coefficients).unwrap()
    }

    /// The recursion of the module page, written down as it is, including 0/0 = 0.
    fn cox_de_boor(knots: &[f64], i: usize, p: usize, x: f64) -> f64 {
        if p == 0 {
            return f64::from(knots[i] <= x && x < knots[i + 1]);
        }
        let quotient = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
        quotient(x - knots[i], knots[i + p] - knots[i]) * cox_de_boor(knots, i, p - 1, x)
            + quotient(knots[i + p + 1] - x, knots[i + p + 1] - knots[i + 1]) * cox_de_boor(knots, i + 1, p - 1, x)
    }

    #[test]
    fn values_are_those_of_the_recursion() {
        for degree in 1..=4 {
            let mut values = vec![0.0; degree + 1];
            values.extend([0.3, 0.7, 0.7, 0.9]);
            values.retain(|&u| degree > 1 || u != 0.7);
            values.extend(vec![2.0; degree + 1]);
            let knots = Knots::new(degree, values).unwrap();
            for step in 0..200 {
                let x = step as f64 / 100.0;
                let basis = knots.basis(knots.span(x).unwrap(), x);
                for i in 0..knots.dimension() {
                    let value = match i.checked_sub(basis.first) {
                        Some(k) if k <= degree => basis.values[k],
                        _ => 0.0,
                    };
                    let expected = cox_de_boor(knots.values(), i, degree, x);
                    assert!((value - expected).abs() < 1e-14, "degree {degree}, N_{i}({x})");
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_duals() {
        let spline = kinked();
        for step in 0..=300 {
            let x = step as f64 / 100.0;
            let span = spline.knots().span(x).unwrap();
            let inner = Dual::<f64>::variable(x, 0);
            let mut outer = Dual::<Dual<f64>>::constant(inner);
            outer.parts[0] = Dual::constant(1.0);
            let jet = spline.value_in(span, outer);
            let tolerance = 1e-12 * (1.0 + jet.parts[0].parts[0].abs());
            assert!((jet.value.value - spline.value(x).unwrap()).abs() < 1e-15);
            assert!((jet.parts[0].value - spline.derivative(x).unwrap()).abs() < tolerance);
            assert!((jet.parts[0].parts[0] - spline.second_derivative(x).unwrap()).abs() < tolerance);
        }
    }

    #[test]
    fn cubics_are_reproduced_by_their_polar_forms() {
        // f(u) = u^3 - 2u^2 + 3 has the blossom u v w - 2 (uv + vw + wu)/3 + 3; coefficient i is its value at
        // the knots inside
        let knots = kinked().knots().clone();
        let blossom = |u: f64, v: f64, w: f64| u * v * w - 2.0 * (u * v + v * w + w * u) / 3.0 + 3.0;
        let coefficients = (0..knots.dimension())
            .map(|i| blossom(knots.values()[i + 1], knots.values()[i + 2], knots.values()[i + 3]))
            .collect();
        let spline = Spline::new(knots, coefficients).unwrap();
        for step in 0..=300 {
            let x = step as f64 / 100.0;
            assert!((spline.value(x).unwrap() - (x * x * x - 2.0 * x * x + 3.0)).abs() < 1e-13);
            assert!((spline.derivative(x).unwrap() - (3.0 * x * x - 4.0 * x)).abs() < 1e-12);
            assert!((spline.second_derivative(x).unwrap() - (6.0 * x - 4.0)).abs() < 1e-11);
        }
    }

    #[test]
    fn ends_kinks_and_outside() {
        let spline = kinked();
        let coefficients = spline.coefficients().to_vec();
        assert_eq!(spline.value(0.0), Some(coefficients[0]));
        assert_eq!(spline.value(3.0), coefficients.last().copied());
        assert_eq!(spline.value(1.0), Some(coefficients[4]));
        for x in [-1e-9, 3.0 + 1e-9, f64::NAN, f64::INFINITY] {
            assert_eq!(spline.value(x), None);
            assert_eq!(spline.derivative(x), None);
            assert_eq!(spline.knots().span_before(x), None);
        }
        let knots = spline.knots();
        assert_eq!((knots.span(1.0), knots.span_before(1.0)), (Some(7), Some(4)));
        assert_eq!((knots.span(0.0), knots.span_before(0.0)), (Some(3), Some(3)));
        assert_eq!((knots.span(3.0), knots.span_before(3.0)), (Some(8), Some(8)));
        assert_eq!(knots.spans().collect::<Vec<_>>(), [3, 4, 7, 8]);
        // a triple knot of a cubic joins values only
        assert!((spline.value_in(4, 1.0) - spline.value_in(7, 1.0)).abs() < 1e-15);
        let slope = |span| {
            let basis = knots.basis(span, 1.0);
            basis.combine(&basis.first_derivatives, &coefficients)
        };
        assert!((slope(4) - slope(7)).abs() > 0.1);
    }

    #[test]
    fn bad_knots_and_coefficients_are_refused() {
        for (degree, values, index) in [
            (0, vec![0.0, 1.0], 0),
            (1, vec![0.0, 0.0, 1.0], 3),
            (1, vec![0.0, 0.0, f64::NAN, 1.0, 1.0], 2),
            (1, vec![0.0, 0.0, 0.7, 0.6, 1.0, 1.0], 3),
            (2, vec![0.0, 0.0, 0.1, 1.0, 1.0, 1.0], 2),
            (2, vec![0.0, 0.0, 0.0, 0.9, 1.0, 1.0], 3),
            (1, vec![0.0, 0.0, 0.5, 0.5, 1.0, 1.0], 2),
            (1, vec![0.0, 0.0, 0.0, 1.0, 1.0], 1),
            (1, vec![0.0, 0.0, 0.0, 0.0], 1),
        ] {
            match Knots::new(degree, values.clone()) {
                Err(Error::Knots { index: found, .. }) => assert_eq!(found, index, "{values:?}"),
                other => panic!("{values:?}: {other:?}"),
            }
        }
        let knots = Knots::new(1, vec![0.0, 0.0, 1.0, 1.0]).unwrap();
        for coefficients in [vec![1.0], vec![1.0, f64::NAN], vec![1.0; 3]] {
            assert!(matches!(
                Spline::new(knots.clone(), coefficients),
                Err(Error::Coefficients { expected: 2, .. })
            ));
        }
    }
}
