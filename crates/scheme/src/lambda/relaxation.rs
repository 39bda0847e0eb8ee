//! Which s belongs to a lambda.
//!
//! Bounded curvature is `mu = lambda^2`, i.e. `s = mu / lambda^2 = 1`. Below a valence's `lambda_l` no
//! admissible stencil has it, and Ma, Wang and Ma (2023, Eq. 10) relax it to `s = s_l(lambda) + ds`, with the
//! smallest possible `s_l`. With `c_k = cos(2 pi k / N)`, and the last two terms only for N >= 5,
//!
//! ```text
//! s_l = max( 1,  1/(8 lambda^2),  c2/(c1 lambda),  (1+c2)/((1+2c1-c2) lambda) )
//! ```
//!
//! * `1/(8 lambda^2)`: mu must not fall below 1/8, the largest eigenvalue of the regular rings outside;
//! * `c2/(c1 lambda)`: `d2 >= 0` at `f3 = 0`;
//! * `(1+c2)/((1+2c1-c2) lambda)`: `g3 >= -mu` at `f3 = 0`, the last block's eigenvalue for even N.
//!
//! Each term falls with lambda, so each reaches 1 once; `lambda_l` is the largest of these lambdas (Eqs. 23,
//! 24). The addition `ds` keeps mu off the resonance with the outer rings and the last block off its bound.
//! The paper gives it as 1e-3 up to `lambda_l` and 0 from `lambda_l + 1e-2` on, without saying what lies
//! between; here it falls linearly.
//!
//! s is a continuous function of lambda with kinks where the largest term changes and at both ends of the
//! ramp. Between kinks it is a [`Branch`], a smooth formula that any [`Scalar`] can evaluate. `mu < lambda`,
//! which a [`Plane`] demands, is met for every lambda of [0.15, 0.9] up to N = 256 (tested); where it is not,
//! `Plane::new` says so.

use super::Plane;
use crate::{Error, Scalar};

/// The s rule of one valence; see the module page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    valence: usize,
}

/// The terms whose maximum is `s_l`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// 1: bounded curvature.
    Bounded,
    /// `1/(8 lambda^2)`: mu stays above the outer rings' eigenvalue.
    OuterRings,
    /// `c2/(c1 lambda)`: the edge weight d2 stays non-negative. Never the largest term for a finite N.
    EdgeWeight,
    /// `(1+c2)/((1+2c1-c2) lambda)`: the last block's eigenvalue g3 stays above -mu.
    LastBlock,
}

/// The three pieces of the addition `ds`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addition {
    /// `ds0`, up to `lambda_l`.
    Full,
    /// Falling linearly, between `lambda_l` and `lambda_l + ramp`.
    Falling,
    /// 0, above.
    Off,
}

/// A smooth piece of `s(lambda)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// Which term of `s_l` is the largest.
    pub term: Term,
    /// Which piece of `ds` applies.
    pub addition: Addition,
}

impl Relaxation {
    /// `1 / ds0`, where `ds0 = 1e-3` is the addition to s up to `lambda_l`: the paper's empirical choice
    /// (section 3.3.2).
    pub const ADDITION_INVERSE: i64 = 1000;
    /// The inverse of the ramp's width 1e-2, over which the addition falls to zero (section 3.3.2).
    pub const RAMP_INVERSE: i64 = 100;

    /// The rule of a valence.
    ///
    /// # Errors
    /// [`Error::Valence`] below 3.
    pub fn new(valence: usize) -> Result<Self, Error> {
        if valence < 3 {
            return Err(Error::Valence { valence });
        }
        Ok(Relaxation { valence })
    }

    /// The valence.
    pub fn valence(&self) -> usize {
        self.valence
    }

    /// The smallest lambda with bounded curvature (`s_l = 1`).
    pub fn lambda_l(&self) -> f64 {
        self.lambda_l_of(self.last_term())
    }

    /// The end of the ramp, from where `s = 1` exactly; may exceed 1 (N >= 78).
    pub fn ramp_end(&self) -> f64 {
        self.lambda_l() + 1.0 / Self::RAMP_INVERSE as f64
    }

    /// `s_l`, the smallest s with admissible stencils.
    ///
    /// # Errors
    /// [`Error::Lambda`] unless 1/8 < lambda < 1.
    pub fn s_lower(&self, lambda: f64) -> Result<f64, Error> {
        let branch = self.branch(lambda)?;
        Ok(self.term(branch.term, lambda))
    }

    /// `s = s_l + ds`.
    ///
    /// # Errors
    /// [`Error::Lambda`] unless 1/8 < lambda < 1.
    pub fn s(&self, lambda: f64) -> Result<f64, Error> {
        Ok(self.s_on_branch(self.branch(lambda)?, lambda))
    }

    /// The plane of stencils at lambda and the s that belongs to it.
    ///
    /// # Errors
    /// [`Error::Lambda`] unless 1/8 < lambda < 1, [`Error::RelaxationRule`] where the rule's mu reaches
    /// lambda, as it does at large valences.
    pub fn plane(&self, lambda: f64) -> Result<Plane<f64>, Error> {
        let (valence, s) = (self.valence, self.s(lambda)?);
        if s * lambda < 1.0 {
            return Plane::new(valence, lambda, s);
        }
        let holds = |valence: &usize| {
            Relaxation { valence: *valence }
                .s(lambda)
                .is_ok_and(|s| s * lambda < 1.0)
        };
        let largest = (3..valence).take_while(holds).last();
        Err(Error::RelaxationRule {
            valence,
            lambda,
            s,
            largest,
        })
    }

    /// The smooth piece that is valid at lambda; at a kink the one on the right for terms, on the left for
    /// the addition at `lambda_l` (the two agree there).
    ///
    /// # Errors
    /// [`Error::Lambda`] unless 1/8 < lambda < 1.
    pub fn branch(&self, lambda: f64) -> Result<Branch, Error> {
        if !(lambda > 0.125 && lambda < 1.0) {
            return Err(Error::Lambda { lambda });
        }
        let mut term = Term::Bounded;
        for &candidate in self.terms() {
            if self.term(candidate, lambda) > self.term(term, lambda) {
                term = candidate;
            }
        }
        let addition = if lambda <= self.lambda_l() {
            Addition::Full
        } else if lambda < self.ramp_end() {
            Addition::Falling
        } else {
            Addition::Off
        };
        Ok(Branch { term, addition })
    }

    /// The formula of one piece of s, at any lambda.
    pub fn s_on_branch<S: Scalar + Copy>(&self, branch: Branch, lambda: S) -> S {
        let full = S::ratio(1, Self::ADDITION_INVERSE);
        let addition = match branch.addition {
            Addition::Full => full,
            Addition::Off => return self.term(branch.term, lambda),
            Addition::Falling => {
                let past = lambda - self.lambda_l_of::<S>(self.last_term());
                full * (S::one() - past * S::ratio(Self::RAMP_INVERSE, 1))
            }
        };
        self.term(branch.term, lambda) + addition
    }

    /// The lambdas in (1/8, 1), ascending, at which s has a kink.
    pub fn kinks(&self) -> Vec<f64> {
        let mut kinks = Vec::with_capacity(3);
        let last = self.last_term();
        if last != Term::OuterRings {
            // 1/(8 lambda^2) = lambda_l / lambda
            kinks.push(1.0 / (8.0 * self.lambda_l()));
        }
        kinks.push(self.lambda_l());
        kinks.push(self.ramp_end());
        kinks.retain(|&lambda| lambda < 1.0);
        kinks
    }

    /// The terms beside 1 that apply to the valence.
    fn terms(&self) -> &'static [Term] {
        if self.valence < 5 {
            &[Term::OuterRings]
        } else {
            &[Term::OuterRings, Term::EdgeWeight, Term::LastBlock]
        }
    }

    /// The term that reaches 1 last.
    fn last_term(&self) -> Term {
        let mut last = Term::OuterRings;
        for &term in self.terms() {
            if self.lambda_l_of::<f64>(term) > self.lambda_l_of(last) {
                last = term;
            }
        }
        last
    }

    /// Where a term is 1 (Eq. 24).
    fn lambda_l_of<S: Scalar + Copy>(&self, term: Term) -> S {
        let (one, n) = (S::one(), self.valence as i64);
        let (c1, c2) = (S::cos_turn(1, n), S::cos_turn(2, n));
        match term {
            Term::Bounded => one,
            Term::OuterRings => S::ratio(1, 8).sqrt(),
            Term::EdgeWeight => c2 / c1,
            Term::LastBlock => (one + c2) / (one + c1 + c1 - c2),
        }
    }

    fn term<S: Scalar + Copy>(&self, term: Term, lambda: S) -> S {
        match term {
            Term::Bounded => S::one(),
            Term::OuterRings => S::ratio(1, 8) / (lambda * lambda),
            Term::EdgeWeight | Term::LastBlock => self.lambda_l_of::<S>(term) / lambda,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dual;
    use approx::assert_relative_eq;

    #[test]
    fn lambda_l_is_that_of_the_paper() {
        // Ma, Wang and Ma (2023), Table 1, four decimals
        for (valence, printed) in [
            (3, 0.3536),
            (4, 0.3536),
            (5, 0.3536),
            (6, 0.3536),
            (8, 0.4142),
            (9, 0.4976),
            (10, 0.5669),
            (12, 0.6720),
            (14, 0.7453),
            (15, 0.7735),
            (16, 0.7975),
            (17, 0.8180),
            (19, 0.8510),
            (20, 0.8643),
        ] {
            let lambda_l = Relaxation::new(valence).unwrap().lambda_l();
            assert!(
                (lambda_l - printed).abs() <= 0.5e-4 + 1e-12,
                "N = {valence}: {lambda_l} against {printed}"
            );
        }
    }

    #[test]
    fn the_printed_kink_knots_are_those_of_s() {
        // Table 1, column lambda_b
        for (valence, printed) in [(8, 0.301), (9, 0.2564), (10, 0.2265)] {
            let kink = Relaxation::new(valence).unwrap().kinks()[0];
            // the paper's knots are samples of a grid with steps of (lambda_l - 0.15) / 49 < 0.009
            assert!((kink - printed).abs() < 0.009, "N = {valence}: {kink}");
        }
    }

    #[test]
    fn s_is_smooth_between_kinks_and_continuous_at_them() {
        for valence in 3..=64 {
            let rule = Relaxation::new(valence).unwrap();
            let kinks = rule.kinks();
            assert!(kinks.is_sorted() && kinks.iter().all(|&k| k > 0.125 && k < 1.0));
            let ends: Vec<f64> = [0.125].into_iter().chain(kinks.clone()).chain([1.0]).collect();
            for pair in ends.windows(2) {
                let inside: Vec<_> = (1..50)
                    .map(|i| pair[0] + (pair[1] - pair[0]) * f64::from(i) / 50.0)
                    .map(|lambda| rule.branch(lambda).unwrap())
                    .collect();
                assert!(inside.windows(2).all(|b| b[0] == b[1]), "N = {valence} in {pair:?}");
            }
            for kink in kinks {
                let (left, right) = (kink - 1e-9, kink + 1e-9);
                let (bl, br) = (rule.branch(left).unwrap(), rule.branch(right).unwrap());
                assert_ne!(bl, br);
                assert_relative_eq!(rule.s_on_branch(bl, kink), rule.s_on_branch(br, kink), epsilon = 1e-13);
                // a kink indeed: the slopes differ
                let slope = |branch| rule.s_on_branch(branch, Dual::<f64>::variable(kink, 0)).parts[0];
                assert!((slope(bl) - slope(br)).abs() > 1e-3, "N = {valence} at {kink}");
            }
        }
    }

    #[test]
    fn s_is_the_maximum_of_its_terms_and_gives_a_plane() {
        for valence in 3..=256 {
            let rule = Relaxation::new(valence).unwrap();
            let (c1, c2) = (f64::cos_turn(1, valence as i64), f64::cos_turn(2, valence as i64));
            for i in 0..=750 {
                let lambda = 0.15 + f64::from(i) * 1e-3;
                let mut expected = 1.0_f64.max(0.125 / (lambda * lambda));
                if valence > 4 {
                    expected = expected.max(c2 / (c1 * lambda));
                    expected = expected.max((1.0 + c2) / ((1.0 + 2.0 * c1 - c2) * lambda));
                }
                assert_relative_eq!(rule.s_lower(lambda).unwrap(), expected, epsilon = 1e-13);
                assert_ne!(rule.branch(lambda).unwrap().term, Term::EdgeWeight);
                let plane = rule.plane(lambda).unwrap();
                assert!(plane.s >= expected - 1e-13 && plane.s <= expected + 1e-3 + 1e-13);
                assert!(plane.mu() > 0.125 && plane.mu() < lambda);
            }
        }
    }

    #[test]
    fn arguments_out_of_range_are_refused() {
        assert_eq!(Relaxation::new(2), Err(Error::Valence { valence: 2 }));
        let rule = Relaxation::new(7).unwrap();
        for lambda in [0.125, 1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(rule.s(lambda), Err(Error::Lambda { .. })));
            assert!(matches!(rule.s_lower(lambda), Err(Error::Lambda { .. })));
        }
        assert_eq!(rule.s(0.5).unwrap(), 1.0);
    }
}
