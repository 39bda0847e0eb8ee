//! The weight that penalises a wrong sign of the Gauss curvature.
//!
//! Ma, Wang and Ma (2023), Eqs. 16, 17 and 20: with K signed so that the ideal map has K = |ac - b^2| > 0,
//!
//! ```text
//! r(K, e) = (K + sqrt(K^2 + 4 e^2)) / 2,    w = r(K, n e) / r(K, e),    e = epsilon |ac - b^2|
//! ```
//!
//! so w tends to 1 for large K and to n^2 for K far below 0. It depends on `k = K / |ac - b^2|` only. With
//! `s = sqrt(k^2 + 4 epsilon^2)` and `S = sqrt(k^2 + 4 n^2 epsilon^2)`,
//!
//! ```text
//! w = (k + S) / (k + s) = n^2 (s - k) / (S - k),    dw/dk = w (s - S) / (s S)
//! ```
//!
//! where the first form is free of cancellation for k >= 0 and the second for k < 0. If ac = b^2 exactly, k =
//! 0 is passed in and w = n, the limit.

/// The weight function with given epsilon and n.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weight {
    /// `4 epsilon^2`.
    lower: f64,
    /// `4 n^2 epsilon^2`.
    upper: f64,
    /// `n^2`.
    largest: f64,
}

impl Weight {
    pub fn new(epsilon: f64, n: f64) -> Weight {
        let lower = 4.0 * epsilon * epsilon;
        let largest = n * n;
        Weight {
            lower,
            upper: largest * lower,
            largest,
        }
    }

    /// `w` and `dw/dk`, by two square roots and one division.
    #[inline(always)]
    pub fn at(&self, k: f64) -> (f64, f64) {
        let square = k * k;
        let small = (square + self.lower).sqrt();
        let large = (square + self.upper).sqrt();
        let (with_small, with_large) = (k.abs() + small, k.abs() + large);
        let positive = k >= 0.0;
        let numerator = if positive {
            with_large
        } else {
            self.largest * with_small
        };
        let denominator = if positive { with_small } else { with_large };
        let roots = small * large;
        let inverse = 1.0 / (denominator * roots);
        let w = numerator * roots * inverse;
        (w, w * (small - large) * (denominator * inverse))
    }

    /// [`Weight::at`] for all of `k`; a loop over plain slices, which the compiler vectorises reliably.
    #[inline(always)]
    pub fn fill(&self, k: &[f64], w: &mut [f64], slope: &mut [f64]) {
        for ((&k, w), slope) in k.iter().zip(w).zip(slope) {
            (*w, *slope) = self.at(k);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn limits_and_the_value_at_zero() {
        let weight = Weight::new(0.2, 5.0);
        assert_relative_eq!(weight.at(0.0).0, 5.0, epsilon = 1e-15);
        assert_relative_eq!(weight.at(1e9).0, 1.0, epsilon = 1e-15);
        assert_relative_eq!(weight.at(-1e9).0, 25.0, epsilon = 1e-13);
        // the definition itself, where it does not cancel
        let r = |k: f64, e: f64| (k + (k * k + 4.0 * e * e).sqrt()) / 2.0;
        for k in [-0.3, -0.01, 0.2, 1.0, 7.0] {
            assert_relative_eq!(weight.at(k).0, r(k, 1.0) / r(k, 0.2), max_relative = 1e-14);
        }
    }

    #[test]
    fn both_branches_are_one_function_and_its_derivative() {
        let weight = Weight::new(0.2, 5.0);
        // w(k) w(-k) = n^2 ties the branches together
        for k in [1e-12, 0.3, 4.0, 1e4, 1e8] {
            assert_relative_eq!(weight.at(k).0 * weight.at(-k).0, 25.0, max_relative = 1e-14);
        }
        for k in [-20.0, -1.0, -1e-3, 0.0, 1e-3, 0.4, 3.0] {
            let step = 1e-5;
            let difference = (weight.at(k + step).0 - weight.at(k - step).0) / (2.0 * step);
            assert_relative_eq!(weight.at(k).1, difference, epsilon = 1e-8);
        }
    }
}
