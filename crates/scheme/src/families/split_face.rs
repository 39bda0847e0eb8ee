//! The corners of the n-gon of HNUSS (Li, Wei and Zhang 2019, Eq. 4), which is never split.
//!
//! With the intervals d_i of the spokes, corner i lying between spokes i and i+1, and indices mod n,
//!
//! ```text
//! P_i'    = (P_i + C)/2 + alpha_i (-n P_i + sum_j (1 + 2 cos(2 pi (j-i)/n)) P_j),     C = sum_i beta_i P_i
//! alpha_i = (1/n) d_i/(d_i + d_(i+2)) d_(i+1)/(d_(i+1) + d_(i-1))
//! beta_i  = [(d_(i-1) + d_(i+3)) d_(i+2) + (d_(i-2) + d_(i+2)) d_(i-1)]
//!           / sum_j (d_j + d_(j+2)) (d_(j-1) + d_(j+3))
//! ```

use crate::{Error, Scalar};

/// The weights of the rule.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitFace<S> {
    /// `n alpha_i`, between 0 and 1 for positive intervals.
    pub alpha: Vec<S>,
    /// `beta_i`, of sum 1.
    pub beta: Vec<S>,
}

impl<S: Scalar> SplitFace<S> {
    /// The weights for the intervals of three spokes or more.
    ///
    /// # Errors
    /// [`Error::ZeroIntervals`] where a rule divides by a sum of intervals that are all zero.
    pub fn new(intervals: &[f64]) -> Result<Self, Error> {
        let n = intervals.len();
        let d = |i: usize| intervals[i % n];
        // products and quotients of doubles in the scalar, so that enclosures enclose
        let s = |i: usize| S::exact(d(i));
        if let Some(i) = (0..n).find(|&i| d(i) + d(i + 2) == 0.0) {
            return Err(Error::ZeroIntervals {
                spokes: [i, (i + 2) % n],
            });
        }
        let ratio = |own: usize, other: usize| s(own) / (s(own) + s(other));
        let total = (0..n).fold(S::zero(), |sum, j| sum + (s(j) + s(j + 2)) * (s(j + n - 1) + s(j + 3)));
        let beta = |i: usize| {
            let ahead = (s(i + n - 1) + s(i + 3)) * s(i + 2);
            let behind = (s(i + n - 2) + s(i + 2)) * s(i + n - 1);
            (ahead + behind) / total.clone()
        };
        Ok(SplitFace {
            alpha: (0..n).map(|i| ratio(i, i + 2) * ratio(i + 1, i + n - 1)).collect(),
            beta: (0..n).map(beta).collect(),
        })
    }

    /// The weight of corner j in the new corner i.
    pub fn weight(&self, i: usize, j: usize) -> S {
        let n = self.alpha.len() as i64;
        let cosine = S::cos_turn(j as i64 - i as i64, n);
        let mode = (S::one() + S::ratio(2, 1) * cosine) / S::ratio(n, 1);
        let own = if i == j { S::one() } else { S::zero() };
        let half = S::ratio(1, 2) * (own.clone() + self.beta[j].clone());
        half + self.alpha[i].clone() * (mode - own)
    }
}
