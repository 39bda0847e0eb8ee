//! The stencils at one valence and lambda, as functions of the two free weights f2 and f3.

use crate::{Error, OneRing, Scalar};

/// All stencils with given valence, subdominant eigenvalue `lambda` and `mu = s lambda^2`: a plane with
/// coordinates (f2, f3).
///
/// In the notation of Ma, Wang and Ma (2023), `c_k = cos(2 pi k / N)`, `sg = s lambda` and
///
/// ```text
/// A = (1+c1) mu - (1+c2) lambda     B = c1 - c2     C = B mu     D = 1+c1 - (1+c2) sg
/// g3 = mu (A - B f3) / (C - D f3)                               (their Eq. 30)
/// h  = 2 g2 f2 = (1-sg) (mu-f3) (lambda-f3) / (C - D f3)        (their Eq. 31, without its cancellation)
/// beta = h mu (1-c2) / (2 f2 + phi h f3/f2 - A0),  A0 = g3 + 2h - mu + phi (f3-mu)      (their Eq. 27)
/// ```
///
/// At N = 3 these formulas hold as they stand (they reduce to g3 = lambda mu / f3: block 2 is the conjugate
/// of block 1 and mu is its other eigenvalue). At N = 4 block 2 is diagonal with entries g3 and f3, so both
/// must be mu, and g3 = mu, h = (1-sg)(lambda-mu) are the continuation of the formulas to f3 = mu; only f2 is
/// free.
#[derive(Clone, Copy, Debug)]
pub struct Plane<S> {
    /// The valence N, at least 3.
    pub valence: usize,
    /// The subdominant eigenvalue.
    pub lambda: S,
    /// The relaxation `s = mu / lambda^2`.
    pub s: S,
    /// The ratio `alpha / beta` of the vertex stencil's total weights; 6 in the paper (Eq. 28).
    pub phi: S,
}

/// A one-ring stencil of the lambda-scheme with its generalised Catmull-Clark coefficients.
#[derive(Clone, Copy, Debug)]
pub struct LambdaStencil<S> {
    /// The weights.
    pub weights: OneRing<S>,
    /// Weight of the extraordinary vertex in the edge rule `E' = g1 V + g2 (F'_{i-1} + F'_i) + g3 E`.
    pub g1: S,
    /// Weight of each refined face point in the edge rule.
    pub g2: S,
    /// Weight of the edge's other end in the edge rule.
    pub g3: S,
}

impl Plane<f64> {
    /// The plane with the paper's `phi = 6`.
    ///
    /// # Errors
    /// [`Error::Valence`] below 3, [`Error::Lambda`] unless 1/8 < lambda < 1, [`Error::Relaxation`] unless
    /// 1 <= s and s lambda < 1 (mu must stay below lambda).
    pub fn new(valence: usize, lambda: f64, s: f64) -> Result<Self, Error> {
        if valence < 3 {
            return Err(Error::Valence { valence });
        }
        if !(lambda > 0.125 && lambda < 1.0) {
            return Err(Error::Lambda { lambda });
        }
        if !(s >= 1.0 && s * lambda < 1.0) {
            return Err(Error::Relaxation { s, lambda });
        }
        Ok(Plane {
            valence,
            lambda,
            s,
            phi: 6.0,
        })
    }
}

impl Plane<f64> {
    /// Refuses weights that are no numbers, with what they are divided by.
    ///
    /// # Errors
    /// [`Error::Divisor`].
    pub fn check(&self, f2: f64, f3: f64) -> Result<(), Error> {
        let LambdaStencil { weights: w, g1, g2, g3 } = self.stencil(f2, f3);
        let weights = [w.f1, w.d1, w.d2, w.e1, w.e2, w.alpha, w.beta, g1, g2, g3];
        if weights.iter().all(|weight| weight.is_finite()) {
            return Ok(());
        }
        let divisor = match self.g3_and_h(f3) {
            (g3, h) if !(g3.is_finite() && h.is_finite()) => "C - D f3, the divisor of g3",
            _ if !g2.is_finite() => "f2",
            _ => "the divisor of beta",
        };
        Err(Error::Divisor {
            valence: self.valence,
            lambda: self.lambda,
            weights: [f2, f3],
            divisor,
        })
    }
}

impl<S: Scalar + Copy> Plane<S> {
    /// `cos(2 pi k / N)`.
    pub fn cosine(&self, k: i64) -> S {
        S::cos_turn(k, self.valence as i64)
    }

    /// `cos(pi / N)`.
    pub fn cos_half_sector(&self) -> S {
        S::cos_turn(1, 2 * self.valence as i64)
    }

    /// The subsubdominant eigenvalue `mu = s lambda^2`.
    pub fn mu(&self) -> S {
        self.s * self.lambda * self.lambda
    }

    /// `g3` and `h = 2 g2 f2`; neither depends on f2. At N = 4, where f3 must be mu, `f3` is not used.
    pub fn g3_and_h(&self, f3: S) -> (S, S) {
        let (one, lambda, mu, sg) = (S::one(), self.lambda, self.mu(), self.s * self.lambda);
        if self.valence == 4 {
            return (mu, (one - sg) * (lambda - mu));
        }
        let (c1, c2) = (self.cosine(1), self.cosine(2));
        let a = (one + c1) * mu - (one + c2) * lambda;
        let b = c1 - c2;
        let denominator = b * mu - (one + c1 - (one + c2) * sg) * f3;
        (
            mu * (a - b * f3) / denominator,
            (one - sg) * (mu - f3) * (lambda - f3) / denominator,
        )
    }

    /// The stencil at (f2, f3). At N = 4 only `f3 = mu` has the demanded eigenvalues.
    pub fn stencil(&self, f2: S, f3: S) -> LambdaStencil<S> {
        let (one, two) = (S::one(), S::ratio(2, 1));
        let mu = self.mu();
        let (g3, h) = self.g3_and_h(f3);
        let g2 = h / (two * f2);
        let g1 = one - two * g2 - g3;
        let f1 = one - two * f2 - f3;
        let a0 = g3 + two * h - mu + self.phi * (f3 - mu);
        let beta = h * mu * (one - self.cosine(2)) / (two * f2 + self.phi * h * f3 / f2 - a0);
        LambdaStencil {
            weights: OneRing {
                f1,
                f2,
                f3,
                d1: g1 + two * g2 * f1,
                d2: g3 + h,
                e1: h / two,
                e2: g2 * f3,
                alpha: self.phi * beta,
                beta,
            },
            g1,
            g2,
            g3,
        }
    }

    /// The ratio `2 f2 cos(pi/N) / (lambda - f3)` of the distances of F and E from the centre in the natural
    /// configuration.
    pub fn corner_radius(&self, f2: S, f3: S) -> S {
        S::ratio(2, 1) * f2 * self.cos_half_sector() / (self.lambda - f3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn bicubic_b_splines_at_valence_four() {
        let stencil = Plane::new(4, 0.5, 1.0).unwrap().stencil(0.25, 0.25);
        let w = stencil.weights;
        for (weight, expected) in [
            (w.f1, 0.25),
            (w.d1, 0.375),
            (w.d2, 0.375),
            (w.e1, 0.0625),
            (w.e2, 0.0625),
            (w.alpha, 0.375),
            (w.beta, 0.0625),
            (stencil.g2, 0.25),
        ] {
            assert_relative_eq!(weight, expected, epsilon = 1e-15);
        }
    }

    #[test]
    fn eigenvalues_are_the_demanded_ones() {
        for (valence, lambda, s, f2, f3) in [
            (3, 0.5, 1.0, 0.26, 0.33),
            (5, 0.56, 1.0, 0.25, 0.2),
            (11, 0.5, 1.4, 0.3, 0.01),
        ] {
            let plane = Plane::new(valence, lambda, s).unwrap();
            let LambdaStencil { weights: w, g3, .. } = plane.stencil(f2, f3);
            let mu = plane.mu();
            // trace and determinant of blocks 1 and 2 (N = 3: block 2 is block 1's conjugate)
            let block = |k| {
                let c = plane.cosine(k);
                let trace = w.d2 + 2.0 * w.e1 * c + f3;
                let det = (w.d2 + 2.0 * w.e1 * c) * f3 - 2.0 * w.e2 * f2 * (1.0 + c);
                (trace, det)
            };
            for (k, eigenvalue) in [(1, lambda), (2, mu)] {
                let (trace, det) = block(k);
                assert_relative_eq!(det, f3 * g3, epsilon = 1e-14);
                assert_relative_eq!(eigenvalue * eigenvalue - trace * eigenvalue + det, 0.0, epsilon = 1e-14);
            }
            // block 0 on (V, E, F), reduced by its eigenvalue 1: x = E - V, y = F - V
            let (a, b) = (w.d2 + 2.0 * w.e1 - w.alpha, 2.0 * w.e2 - w.beta);
            let (c, d) = (2.0 * w.f2 - w.alpha, w.f3 - w.beta);
            let characteristic = (a - mu) * (d - mu) - b * c;
            assert_relative_eq!(characteristic, 0.0, epsilon = 1e-14);
        }
    }

    #[test]
    fn divisors_that_vanish_are_named() {
        let plane = Plane::new(6, 0.5, 1.0).unwrap();
        // C = D f3 at f3 = 1/5, with c1 = 1/2, c2 = -1/2, mu = 1/4: C = 1/4, D = 5/4
        for (f2, f3, named) in [
            (0.0, 0.1, "f2"),
            (1e-310, 0.1, "f2"),
            (0.25, 0.1, ""),
            (0.25, 0.2, "C - D f3"),
            (0.3, f64::NAN, "C - D f3"),
        ] {
            match plane.check(f2, f3) {
                Ok(()) => assert_eq!(named, ""),
                Err(error) => assert!(
                    error.to_string().contains(named) && error.to_string().contains("N = 6"),
                    "{error}"
                ),
            }
        }
    }

    #[test]
    fn parameters_out_of_range_are_refused() {
        assert!(matches!(Plane::new(2, 0.5, 1.0), Err(Error::Valence { valence: 2 })));
        for lambda in [0.125, 1.0, f64::NAN, -0.3] {
            assert!(matches!(Plane::new(5, lambda, 1.0), Err(Error::Lambda { .. })));
        }
        for s in [0.99, 2.0, f64::NAN] {
            assert!(matches!(Plane::new(5, 0.5, s), Err(Error::Relaxation { .. })));
        }
    }
}
