//! Functions that a curve reproduces exactly.
//!
//! With `w = 2 arccos u` (`2 arcosh u` for `u > 1`) the limit curves of order k contain, besides piecewise
//! ones,
//!
//! ```text
//! -1 < u < 1    1, t, .., t^(k-3), cos w t, sin w t
//! u = 1         1, t, .., t^(k-1)
//! u > 1         1, t, .., t^(k-3), cosh w t, sinh w t
//! ```
//!
//! and combining the basis with samples of such a function g at the control points' parameters is convolution
//! with it (the conditions of Strang and Fix, 1973). So a function f of the space has control points
//! `g(p_i)`, where g is of the space too:
//!
//! * `e^(i w t)` is multiplied by the basis's Fourier transform at w, `u (sin(w/2) / (w/2))^(k-3)`, and is
//!   divided by it (`sinh` for `u > 1`). At `u = 0` the factor is zero: there the points of both functions
//!   are alternating signs.
//! * For polynomials the convolution is `f = sum over m of (-1)^m mu_m / m! g^(m)` with the moments mu of the
//!   basis: a triangular system. The series of moments is that of the hat (by quadrature) times
//!   `(sinh(x/2) / (x/2))^(k-2)`; no term is negative for `u >= 0`.

use super::{Angle, Axis, Basis, Curve, Ends, Tension};
use crate::Error;

/// A function `a_0 + a_1 x + .. + c cos w x + s sin w x` of `x = t - origin`, hyperbolic if the space is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Function {
    /// Where x = 0. High powers are accurate near it.
    pub origin: f64,
    /// Coefficients of the powers of x, lowest first.
    pub polynomial: Vec<f64>,
    /// The coefficient of `cos w x` or `cosh w x`.
    pub cosine: f64,
    /// The coefficient of `sin w x` or `sinh w x`.
    pub sine: f64,
}

/// The functions that curves of one order and initial tension reproduce, in their own parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    order: usize,
    tension: Tension,
}

/// How far a closed polygon's functions may be from periodic, relative to their values: the period is `w`, an
/// arc cosine.
const PERIODIC: f64 = 1e-12;

impl Space {
    /// The space of an order and tension.
    ///
    /// # Errors
    /// [`Error::Order`], [`Error::Tension`] as for [`Axis::new`].
    pub fn new(order: usize, u0: f64) -> Result<Self, Error> {
        let axis = Axis::new(order, u0, Ends::Closed, 3)?;
        Ok(Space {
            order,
            tension: axis.tension(),
        })
    }

    /// The frequency w per parameter step: `u0 = cos(w/2)` or `cosh(w/2)`; 0 for `u0 = 1`.
    pub fn frequency(&self) -> f64 {
        match self.tension.angle() {
            Angle::Polynomial => 0.0,
            Angle::Trigonometric(w) | Angle::Hyperbolic(w) => w,
        }
    }

    /// The highest power of t, k-3, or k-1 at `u0 = 1`.
    pub fn degree(&self) -> usize {
        match self.tension.angle() {
            Angle::Polynomial => self.order - 1,
            _ => self.order - 3,
        }
    }

    /// The value of a function at t; not finite if t is not, or where it overflows.
    pub fn value(&self, function: &Function, t: f64) -> f64 {
        let x = t - function.origin;
        let polynomial = function.polynomial.iter().rev().fold(0.0, |sum, a| sum * x + a);
        let (even, odd) = match self.tension.angle() {
            Angle::Polynomial => (1.0, 0.0),
            Angle::Trigonometric(w) => ((w * x).cos(), (w * x).sin()),
            Angle::Hyperbolic(w) => ((w * x).cosh(), (w * x).sinh()),
        };
        let term = |coefficient: f64, value: f64| if coefficient == 0.0 { 0.0 } else { coefficient * value };
        polynomial + term(function.cosine, even) + term(function.sine, odd)
    }

    /// What the basis makes of `e^(i w t)`: its factor.
    pub fn factor(&self) -> f64 {
        let mean = match self.tension.angle() {
            Angle::Polynomial => 1.0,
            Angle::Trigonometric(w) => (w / 2.0).sin() / (w / 2.0),
            Angle::Hyperbolic(w) => (w / 2.0).sinh() / (w / 2.0),
        };
        self.tension.value() * mean.powi(self.order as i32 - 3)
    }

    /// The function g of the same space whose values at the control points' parameters give f.
    ///
    /// # Errors
    /// [`Error::NotReproduced`] if f is not a function of the space, or not finite.
    pub fn control(&self, f: &Function) -> Result<Function, Error> {
        let refuse = |reason| Err(Error::NotReproduced { reason });
        let others = [f.cosine, f.sine, f.origin];
        if !f.polynomial.iter().chain(&others).all(|a| a.is_finite()) {
            return refuse("its coefficients are finite".into());
        }
        let used = f.polynomial.iter().rposition(|&a| a != 0.0).map_or(0, |last| last + 1);
        if used > self.degree() + 1 {
            return refuse(format!("its degree is at most {}", self.degree()));
        }
        let factor = self.factor();
        let oscillates = (f.cosine, f.sine) != (0.0, 0.0);
        if oscillates && self.tension.angle() == Angle::Polynomial {
            return refuse("it is a polynomial where u0 = 1".into());
        }
        if oscillates && (factor == 0.0 || !factor.is_finite()) {
            return refuse(format!(
                "it has no cosine or sine part at u0 = {}",
                self.tension.value()
            ));
        }
        let part = |coefficient: f64| if coefficient == 0.0 { 0.0 } else { coefficient / factor };
        // a convolution commutes with shifts
        Ok(Function {
            origin: f.origin,
            polynomial: self.undo(&f.polynomial[..used]),
            cosine: part(f.cosine),
            sine: part(f.sine),
        })
    }

    /// Solves `f = sum over m of mu_m / m! g^(m)` (odd moments vanish) from the highest power down.
    fn undo(&self, f: &[f64]) -> Vec<f64> {
        let series = self.moment_series(f.len());
        let mut g = f.to_vec();
        for power in (0..g.len()).rev() {
            // t^p becomes t^p + sum over m of mu_m / m! * p! / (p-m)! t^(p-m): take the lower terms off
            let (top, mut falling) = (g[power], 1.0);
            for m in 1..=power {
                falling *= (power - m + 1) as f64;
                g[power - m] -= top * falling * series[m];
            }
        }
        g
    }

    /// `mu_m / m!` of the basis, for m = 0 .. count-1.
    fn moment_series(&self, count: usize) -> Vec<f64> {
        let mut series = Basis::new(self.order, self.tension).hat_moments(count);
        let (mut factorial, mut sinhc) = (1.0, Vec::with_capacity(count));
        for (m, moment) in series.iter_mut().enumerate() {
            factorial *= m.max(1) as f64;
            *moment = if m % 2 == 1 { 0.0 } else { *moment / factorial };
            // x^m / ((m+1)! 2^m)
            sinhc.push(if m % 2 == 1 {
                0.0
            } else {
                (0.5_f64).powi(m as i32) / (factorial * (m + 1) as f64)
            });
        }
        for _ in 2..self.order {
            let term = |m: usize| (0..=m).map(|i| series[i] * sinhc[m - i]).sum();
            series = (0..count).map(term).collect();
        }
        series
    }
}

impl Curve {
    /// The curve of `count` control points whose coordinates are given functions of the parameter, exactly.
    ///
    /// ```
    /// use eigenring_spline::curve::{Curve, Ends, Function};
    /// // the unit circle from a hexagon
    /// let cosine = Function { cosine: 1.0, ..Function::default() };
    /// let sine = Function { sine: 1.0, ..Function::default() };
    /// let u0 = (std::f64::consts::PI / 6.0).cos();
    /// let circle = Curve::reproduce(4, u0, Ends::Closed, 6, &[cosine, sine])?;
    /// let point = circle.limit(0.123)?;
    /// assert!((point[0].hypot(point[1]) - 1.0).abs() < 1e-14);
    /// # Ok::<(), eigenring_spline::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Axis::new`]; [`Error::NotReproduced`] if a function is not of the [`Space`], or not
    /// periodic though the curve is closed; [`Error::Dimension`] without functions; [`Error::NotFinite`] if
    /// control points overflow.
    pub fn reproduce(order: usize, u0: f64, ends: Ends, count: usize, functions: &[Function]) -> Result<Curve, Error> {
        if ends == Ends::Clamped {
            let reason = "it has open or closed ends".to_owned();
            return Err(Error::NotReproduced { reason });
        }
        let axis = Axis::new(order, u0, ends, count)?;
        let space = Space::new(order, u0)?;
        let controls: Vec<Function> = functions.iter().map(|f| space.control(f)).collect::<Result<_, _>>()?;
        if controls.is_empty() {
            return Err(Error::Dimension {
                index: 0,
                found: 0,
                expected: 1,
            });
        }
        let point = |i: usize| -> Vec<f64> {
            let t = axis.parameter(i);
            controls.iter().map(|g| space.value(g, t)).collect()
        };
        let values: Vec<f64> = (0..count).flat_map(point).collect();
        if ends == Ends::Closed {
            let size = values.iter().fold(0.0_f64, |size, v| size.max(v.abs()));
            let next_round: Vec<f64> = (count..2 * count).flat_map(point).collect();
            let differ = |(a, b): (&f64, &f64)| !((a - b).abs() <= PERIODIC * size);
            if values.iter().zip(&next_round).any(differ) {
                let reason = format!("its coordinates have the period {count} of the closed polygon");
                return Err(Error::NotReproduced { reason });
            }
        }
        Curve::from_parts(axis, controls.len(), values)
    }
}
