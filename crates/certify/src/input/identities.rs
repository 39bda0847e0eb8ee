//! The lambda-scheme, and the equalities that its closed forms give.

use super::{Input, Subject};
use crate::levels::Beyond;
use crate::{Error, Interval};
use eigenring_scheme::lambda::Plane;
use eigenring_scheme::user::Balance;

/// Equalities of the lambda-scheme (Ma, Wang and Ma 2023), which its closed forms give at all parameters,
/// whether admissible or not.
///
/// Let `p_k(x) = x^2 - T_k x + f3 g3` with `T_k = g3 + f3 + h (1 + c_k)`: the characteristic polynomial of
/// block k != 0 on (E, F), for all one-ring stencils in the generalised Catmull-Clark form. In the notation
/// of [`Plane`] with `sg = s lambda` and `mu = sg lambda`, for arbitrary numbers c1, c2:
///
/// ```text
/// p_1(lambda) = (lambda - f3)(lambda - g3) - h (1 + c1) lambda = 0
/// p_2(mu)     = (mu - f3)(mu - g3)         - h (1 + c2) mu     = 0
/// ```
///
/// Multiplied by the denominator `C - D f3` these are polynomial identities of degree at most 6 in lambda, 3
/// in s, 2 in f3 and 1 in each of c1 and c2; the tests evaluate them in rational arithmetic on a grid with
/// more points than that in every direction, which proves them. In block 0 on (E - V, F - V), `det(x - S_0)`
/// without its factor `x - 1` is
///
/// ```text
/// p_0(x) + beta [ 2 f2 + phi h f3/f2 - (g3 + 2h - x + phi (f3 - x)) ]
/// ```
///
/// (expand; the terms in `beta^2` cancel). At `x = mu`, `p_0(mu) = p_2(mu) - h (1 - c2) mu = -h (1 - c2) mu`,
/// so that the value is zero exactly for the beta of [`Plane`]. Row sums are `f1 + 2 f2 + f3 = 1`, hence
/// `d1 + d2 + 2 e1 + 2 e2 = g1 + g3 + 2 g2 (f1 + 2 f2 + f3) = 1`. At valence 4 all this holds for `f3 = mu`,
/// where g3 and h are given by continuation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Identities {
    /// An eigenvalue of block 1.
    pub lambda: Interval,
    /// An eigenvalue of blocks 0 and 2 (at valence 3 of block 1; at valence 4 twice in block 2).
    pub mu: Interval,
    /// Whether `mu = lambda^2`, that is `s = 1`.
    pub square: bool,
}

/// The member of the lambda-scheme at the numbers that these doubles are.
///
/// # Errors
/// Parameters out of range or not finite.
pub(super) fn lambda_subject(valence: usize, lambda: f64, s: f64, f2: f64, f3: Option<f64>) -> Result<Subject, Error> {
    // the accepted ranges of lambda and s are those of the plane
    let rough = Plane::new(valence, lambda, s)?;
    for (what, value) in [("f2", f2), ("f3", f3.unwrap_or(0.0))] {
        if !value.is_finite() {
            return Err(Error::NotFinite { what, value });
        }
    }
    let plane = Plane {
        valence,
        lambda: Interval::point(lambda),
        s: Interval::point(s),
        phi: Interval::point(rough.phi),
    };
    let mu = plane.mu();
    // at valence 4 block 2 is diagonal with f3 as one entry, and the closed forms hold for f3 = mu only
    let holds = match f3 {
        None => true,
        Some(f3) => valence != 4 || mu.is_point() && mu.contains(f3),
    };
    let stencil = plane.stencil(Interval::point(f2), f3.map_or(mu, Interval::point));
    let name = Input::Lambda { lambda, s, f2, f3 }.name();
    Ok(Subject {
        scheme: stencil.weights.scheme(name, valence)?,
        exact: None,
        identities: holds.then_some(Identities {
            lambda: plane.lambda,
            mu,
            square: s == 1.0,
        }),
        floating: false,
        corner: None,
        beyond: Beyond::Unknown,
        affine_levels: false,
        balance: Balance::default(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;

    type Q = BigRational;

    fn q(p: i64, r: i64) -> Q {
        Q::new(p.into(), r.into())
    }

    /// A g3, h and the denominator of both, of the closed forms with c1 and c2 as free numbers.
    fn closed(c: &[Q; 2], s: &Q, lambda: &Q, f3: &Q) -> [Q; 3] {
        let one = q(1, 1);
        let (sg, mu) = (s * lambda, s * lambda * lambda);
        let a = (&one + &c[0]) * &mu - (&one + &c[1]) * lambda;
        let b = &c[0] - &c[1];
        let denominator = &b * &mu - (&one + &c[0] - (&one + &c[1]) * &sg) * f3;
        [
            &mu * (a - b * f3),
            (&one - &sg) * (&mu - f3) * (lambda - f3),
            denominator,
        ]
    }

    /// Degrees of `p_1(lambda)` and `p_2(mu)` times the denominator are at most 6 in lambda, 3 in s, 2 in f3
    /// and 1 in each of c1, c2. A polynomial that vanishes on a grid with more points than its degree in
    /// every direction is zero.
    #[test]
    fn the_demanded_eigenvalues_hold_by_identity() {
        let points = |count: i64, shift: i64| (0..count).map(move |i| q(i + shift, 3));
        let zero = q(0, 1);
        let mut evaluated = 0;
        for lambda in points(9, 1) {
            for s in points(6, 2) {
                for f3 in points(5, -1) {
                    for c1 in points(5, -2) {
                        for c2 in points(5, -3) {
                            let c = [c1.clone(), c2];
                            let [g3, h, d] = closed(&c, &s, &lambda, &f3);
                            let mu = &s * &lambda * &lambda;
                            for (value, cosine) in [(&lambda, &c[0]), (&mu, &c[1])] {
                                let p = (value - &f3) * (value * &d - &g3) - &h * (q(1, 1) + cosine) * value;
                                assert_eq!(p, zero);
                            }
                            evaluated += 1;
                        }
                    }
                }
            }
        }
        assert_eq!(evaluated, 9 * 6 * 125);
    }

    /// The closed forms above are those of [`Plane`], and the stencils have the demanded eigenvalues in block
    /// 0 too.
    #[test]
    fn planes_evaluate_these_closed_forms() {
        for (valence, cosines) in [(3, [q(-1, 2), q(-1, 2)]), (6, [q(1, 2), q(-1, 2)])] {
            for (lambda, s, f2, f3) in [
                (0.5, 1.0, 0.25, 0.3125),
                (0.625, 1.25, 0.28125, 0.5),
                (0.40625, 1.0, 0.3, 0.21875),
            ] {
                let exact = |x: f64| Q::from_float(x).unwrap();
                let [g3, h, d] = closed(&cosines, &exact(s), &exact(lambda), &exact(f3));
                let plane = Plane {
                    valence,
                    lambda: Interval::point(lambda),
                    s: Interval::point(s),
                    phi: Interval::point(6.0),
                };
                let found = plane.g3_and_h(Interval::point(f3));
                for (found, expected) in [(found.0, g3 / &d), (found.1, h / &d)] {
                    assert!(exact(found.lo()) <= expected && expected <= exact(found.hi()) && found.width() < 1e-12);
                }
                // block 0 on (E - V, F - V): x^2 - t x + det at mu
                let w = plane.stencil(Interval::point(f2), Interval::point(f3)).weights;
                let two = Interval::point(2.0);
                let (a, b) = (w.d2 + two * w.e1 - w.alpha, two * w.e2 - w.beta);
                let (c, e) = (two * w.f2 - w.alpha, w.f3 - w.beta);
                let mu = plane.mu();
                let value = (a - mu) * (e - mu) - b * c;
                assert!(value.contains_zero() && value.width() < 1e-11, "{value:?}");
            }
        }
    }
}
