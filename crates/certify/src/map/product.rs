//! Products of polynomials: the inner loops.
//!
//! A product of scaled Bernstein forms is a convolution of coefficients. Over intervals its many small operations, each
//! rounded outwards, would take most of the time of a proof. In midpoint-radius form (Rump 1999, *BIT* 39) it is three
//! convolutions of doubles: with `a` in `m_a +- r_a` and `b` in `m_b +- r_b`, each sum of n products satisfies
//!
//! ```text
//! | sum a b - fl(sum m_a m_b) |  <=  sum |m_a| r_b + r_a (|m_b| + r_b)  +  g sum |m_a| |m_b| + n eta,
//! ```
//!
//! with `g = n u / (1 - n u)`, u the rounding unit and eta the smallest double, for whatever order of summation (Higham
//! 2002, section 3.1). The right side, positive terms throughout, is itself computed in doubles with a relative error below
//! `(n + 8) u / (1 - (n + 8) u)`, and enlarged by more than that.

use super::polynomial::Scaled;
use crate::{Centred, Interval};
use eigenring_scheme::{Dual, Scalar};

/// A scalar that can be the coefficient of a polynomial.
pub trait Coefficient: Scalar + Copy {
    /// The product of two polynomials with coefficients scaled by binomials.
    fn product(a: &Scaled<Self>, b: &Scaled<Self>) -> Scaled<Self> {
        plain(a, b)
    }
}

impl Coefficient for f64 {}
impl<S: Scalar + Copy, const D: usize> Coefficient for Dual<S, D> {}
impl<const D: usize> Coefficient for Centred<D> {}

fn plain<S: Scalar + Copy>(a: &Scaled<S>, b: &Scaled<S>) -> Scaled<S> {
    let ([m, n], [p, q]) = (a.degree, b.degree);
    let width = m + p + 1;
    let mut coefficients = vec![S::zero(); width * (n + q + 1)];
    for (j, row) in a.coefficients.chunks(m + 1).enumerate() {
        for (l, other) in b.coefficients.chunks(p + 1).enumerate() {
            let sums = &mut coefficients[(j + l) * width..][..width];
            for (i, &value) in row.iter().enumerate() {
                for (sum, &factor) in sums[i..].iter_mut().zip(other) {
                    *sum += value * factor;
                }
            }
        }
    }
    Scaled {
        degree: [m + p, n + q],
        coefficients,
    }
}

/// Coefficients beyond this could make a sum of products overflow; the plain product handles them.
const LARGE: f64 = 1e140;

impl Coefficient for Interval {
    fn product(a: &Scaled<Self>, b: &Scaled<Self>) -> Scaled<Self> {
        let moderate = |f: &Scaled<Self>| f.coefficients.iter().all(|c| c.mag() < LARGE);
        // so few terms that n u stays far below one
        let terms = a.coefficients.len().min(b.coefficients.len());
        if !(moderate(a) && moderate(b) && terms < 1 << 20) {
            return plain(a, b);
        }
        let unit = f64::EPSILON / 2.0;
        let terms = terms as f64;
        let map = |f: &Scaled<Self>, g: &dyn Fn(Interval) -> f64| {
            let coefficients = f.coefficients.iter().map(|&c| g(c)).collect();
            Scaled {
                degree: f.degree,
                coefficients,
            }
        };
        let middle = plain(&map(a, &Interval::mid), &map(b, &Interval::mid));
        let rounding = (terms + 2.0) * unit;
        let by_middle = plain(
            &map(a, &|c| c.mid().abs()),
            &map(b, &|c| c.radius() + rounding * c.mid().abs()),
        );
        let by_radius = plain(&map(a, &Interval::radius), &map(b, &|c| c.mid().abs() + c.radius()));
        let (factor, underflow) = (1.0 + (terms + 16.0) * f64::EPSILON, 16.0 * terms * f64::from_bits(1));
        let radii = by_middle
            .coefficients
            .iter()
            .zip(&by_radius.coefficients)
            .map(|(r, s)| (r + s) * factor + underflow);
        let coefficients = middle
            .coefficients
            .iter()
            .zip(radii)
            .map(|(&m, r)| Interval::around(m, r))
            .collect();
        Scaled {
            degree: middle.degree,
            coefficients,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn rational(value: f64) -> BigRational {
        BigRational::from_float(value).expect("finite")
    }

    fn scaled<T>(degree: [usize; 2], f: impl FnMut(usize) -> T) -> Scaled<T> {
        Scaled {
            degree,
            coefficients: (0..(degree[0] + 1) * (degree[1] + 1)).map(f).collect(),
        }
    }

    proptest! {
        #[test]
        fn products_hold_those_of_members(
            values in proptest::collection::vec((-1.0..1.0_f64, -300..100_i32, 0.0..1.0_f64, -1.0..=1.0_f64), 24),
            wide in any::<bool>(),
        ) {
            let member = |at: usize| {
                let (m, e, r, t) = values[at];
                let value = if e < -200 { m * 10f64.powi(e) } else { m };
                let radius = if wide { r * value.abs() } else { 0.0 };
                (Interval::around(value, radius), value + 0.999 * t * radius)
            };
            let (a, b) = (scaled([2, 3], |i| member(i).0), scaled([3, 2], |i| member(12 + i).0));
            let exact = |at: usize| rational(member(at).1);
            let found = Interval::product(&a, &b);
            prop_assert_eq!(found.degree, [5, 5]);
            for (index, found) in found.coefficients.iter().enumerate() {
                let (k, l) = (index % 6, index / 6);
                let mut sum = rational(0.0);
                for i in 0..3 {
                    for j in 0..4 {
                        if (i..i + 4).contains(&k) && (j..j + 3).contains(&l) {
                            sum += exact(j * 3 + i) * exact(12 + (l - j) * 4 + k - i);
                        }
                    }
                }
                prop_assert!(rational(found.lo()) <= sum && sum <= rational(found.hi()));
                prop_assert!(wide || found.width() < 1e-13);
            }
        }
    }

    #[test]
    fn what_is_not_moderate_is_multiplied_plainly() {
        let entire = scaled([1, 0], |_| Interval::ENTIRE);
        let ones = scaled([1, 0], |_| Interval::point(1.0));
        assert!(
            Interval::product(&entire, &ones)
                .coefficients
                .iter()
                .all(|&c| c == Interval::ENTIRE)
        );
    }
}
