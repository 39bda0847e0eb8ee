//! The tension parameter and the angle behind it.

use crate::Error;

/// The tension `u > -1` of one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tension(f64);

/// What the tension says of the limit functions. `w` is the frequency per parameter step of this level's
/// polygon: `u = cos(w/2)`, `u = 1` or `u = cosh(w/2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Angle {
    /// `-1 < u < 1`: cosine and sine of `w t`, `0 < w < 2 pi`.
    Trigonometric(f64),
    /// `u = 1`: polynomials.
    Polynomial,
    /// `u > 1`: hyperbolic cosine and sine of `w t`.
    Hyperbolic(f64),
}

impl Tension {
    /// A tension.
    ///
    /// # Errors
    /// [`Error::Tension`] unless u is finite and above -1.
    pub fn new(u: f64) -> Result<Self, Error> {
        if u.is_finite() && u > -1.0 {
            Ok(Tension(u))
        } else {
            Err(Error::Tension { tension: u })
        }
    }

    /// The number u.
    pub fn value(self) -> f64 {
        self.0
    }

    /// The tension of the next level, `sqrt((1+u)/2)`: the formula of the half angle.
    pub fn next(self) -> Self {
        Tension(((1.0 + self.0) / 2.0).sqrt())
    }

    /// The angle. Its relative error is a few roundings also near `u = 1`, where `u - 1` is exact.
    pub fn angle(self) -> Angle {
        let u = self.0;
        let beyond = u - 1.0;
        if beyond < 0.0 {
            Angle::Trigonometric(2.0 * u.acos())
        } else if beyond == 0.0 {
            Angle::Polynomial
        } else if u < 1e100 {
            Angle::Hyperbolic(2.0 * (beyond + (beyond * (beyond + 2.0)).sqrt()).ln_1p())
        } else {
            // cosh is exp/2 to rounding, and the square would overflow
            Angle::Hyperbolic(2.0 * (u.ln() + std::f64::consts::LN_2))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_halve_the_angle() {
        for a in [1e-6_f64, 0.1, 0.7, 1.5, 2.0, 3.0] {
            let (mut trigonometric, mut hyperbolic) = (Tension(a.cos()), Tension(a.cosh()));
            let mut one = Tension(1.0);
            for level in 0..40 {
                let angle = a / f64::from(1 << level.min(30)) / f64::from(1 << (level - level.min(30)));
                assert!((trigonometric.value() - angle.cos()).abs() < 3e-16);
                assert!((hyperbolic.value() / angle.cosh() - 1.0).abs() < 1e-15);
                assert_eq!(one.value(), 1.0);
                trigonometric = trigonometric.next();
                hyperbolic = hyperbolic.next();
                one = one.next();
            }
        }
    }

    #[test]
    fn angles_are_those_of_the_definition() {
        assert_eq!(Tension(1.0).angle(), Angle::Polynomial);
        for u in [-0.999_999, -0.5, 0.0, 0.5, 1.0 - 1e-9, 1.0 - f64::EPSILON] {
            let Angle::Trigonometric(w) = Tension(u).angle() else {
                panic!("{u}")
            };
            assert!(((w / 2.0).cos() - u).abs() < 5e-16);
            // 1 - u = 2 sin^2(w/4) is sharper than the cosine near 1
            assert!((2.0 * (w / 4.0).sin().powi(2) / (1.0 - u) - 1.0).abs() < 1e-15);
        }
        for u in [1.0 + f64::EPSILON, 1.0 + 1e-9, 2.0, 50.0, 1e20, 1e99, 1e101, f64::MAX] {
            let Angle::Hyperbolic(w) = Tension(u).angle() else {
                panic!("{u}")
            };
            let sinh = if u < 1e99 {
                (w / 4.0).sinh().powi(2) * 2.0 / (u - 1.0) - 1.0
            } else {
                0.0
            };
            assert!(sinh.abs() < 1e-13, "{u}: {sinh}");
            assert!(((w / 2.0 - std::f64::consts::LN_2).exp() / u).ln().abs() < 1.0);
        }
    }

    #[test]
    fn tensions_out_of_range_are_refused() {
        for u in [-1.0, -2.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(Tension::new(u), Err(Error::Tension { .. })));
        }
    }
}
