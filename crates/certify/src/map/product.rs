//! Products of polynomials: the inner loops.
//!
//! A product of scaled Bernstein forms is a convolution of coefficients. Over intervals its many small
//! operations, each rounded outwards, would take most of the time of a proof. In midpoint-radius form (Rump
//! 1999, *BIT* 39) it is three convolutions of doubles. Let u = 2^-53 be the rounding unit and eta = 2^-1074
//! the smallest double. With `a` in `m_a +- r_a` and `b` in `m_b +- r_b`, each sum of n products satisfies,
//! for whatever order of summation (Higham 2002, section 3.1; a product that underflows is off by eta/2
//! beside its relative error),
//!
//! ```text
//! | sum a b - fl(sum m_a m_b) |  <=  X + Y + n eta,
//!     X = sum |m_a| (r_b + g |m_b|),   Y = sum r_a (|m_b| + r_b),   g = n u / (1 - n u).
//! ```
//!
//! The right side, positive terms throughout, is itself computed in doubles, which must not come out below
//! it. With `h = (n + 2) u` (exact, and above g for `n < 2^26`), `n < 2^20` and fl for each rounded
//! operation, it is
//!
//! ```text
//! t_b = fl(r_b + (h |m_b| + eta))  (r_b where m_b = 0),   q_b = fl(|m_b| + r_b),
//! R = fl(sum |m_a| t_b),   S = fl(sum r_a q_b),   radius = fl((R + S) f + 16 n eta),
//! f = 1 + 2 (n + 16) u  (exact).
//! ```
//!
//! 1. `t_b >= (1 - u)^4 (r_b + g |m_b|)`. Two sums and a product are rounded, and the product may underflow,
//!    which loses eta/2 beyond `(1 - u)`. Where the total is below 2^-1021 sums of doubles are exact, and the
//!    eta that is added makes up for that; elsewhere eta/2 is at most `u/2` of it.
//! 2. Each product of R and of S is rounded once and may underflow, and n of them are added:
//!    `R >= (1 - u)^(n + 4) X - n eta / 2` and `S >= (1 - u)^(n + 1) Y - n eta / 2`. (A sum that underflows
//!    is exact.)
//! 3. Hence `radius >= (1 - u)^(n + 7) f (X + Y) + (1 - u) (16 n eta - f n eta - eta)`. The first factor is
//!    at least `(1 - (n + 7) u) (1 + 2 (n + 16) u) >= 1`, and what stands behind it is more than `n eta`.
//!
//! Nothing overflows below [`LARGE`]; beyond it the plain product over intervals is taken.

use crate::{Centred, Interval};
use eigenring_spline::bernstein::{Coefficient, Scaled, convolution};

impl<const D: usize> Coefficient for Centred<D> {}

/// Coefficients beyond this could make a sum of products overflow; the plain product handles them. Below it a
/// product is at most `6 LARGE^2` (a radius may be twice a magnitude), and `2^20` of them stay below `1e287`.
const LARGE: f64 = 1e140;

impl Coefficient for Interval {
    fn product(a: &Scaled<Self>, b: &Scaled<Self>) -> Scaled<Self> {
        let moderate = |f: &Scaled<Self>| f.coefficients().iter().all(|c| c.mag() < LARGE);
        // each coefficient of the product is a sum of at most so many terms: so few that n u stays far below
        // one
        let terms = a.coefficients().len().min(b.coefficients().len());
        if !(moderate(a) && moderate(b) && terms < 1 << 20) {
            return convolution(a, b);
        }
        let unit = f64::EPSILON / 2.0;
        let terms = terms as f64;
        let middle = convolution(&a.map(|c| c.mid()), &b.map(|c| c.mid()));
        let rounding = (terms + 2.0) * unit;
        let tiny = f64::from_bits(1);
        let with_rounding = |c: Interval| {
            let size = c.mid().abs();
            // an exact zero is multiplied without error
            let own = if size == 0.0 { 0.0 } else { rounding * size + tiny };
            c.radius() + own
        };
        let by_middle = convolution(&a.map(|c| c.mid().abs()), &b.map(with_rounding));
        let by_radius = convolution(&a.map(|c| c.radius()), &b.map(|c| c.mid().abs() + c.radius()));
        let (factor, underflow) = (1.0 + (terms + 16.0) * f64::EPSILON, 16.0 * terms * tiny);
        let radii = by_middle.zip(&by_radius, |r, s| (r + s) * factor + underflow);
        middle.zip(&radii, Interval::around)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::oracle::{self, Operands, UNIT, units};
    use num_bigint::BigInt;
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn rational(value: f64) -> BigRational {
        BigRational::from_float(value).expect("finite")
    }

    fn scaled<T: Copy>(degree: [usize; 2], mut f: impl FnMut(usize) -> T) -> Scaled<T> {
        Scaled::from_fn(degree, |i, j| f(j * (degree[0] + 1) + i))
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
            prop_assert_eq!(found.degree(), [5, 5]);
            for (index, found) in found.coefficients().iter().enumerate() {
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

    /// Whether the product of two polynomials given by points holds the exact one.
    fn holds_exactly(a: &[f64; 4], b: &[f64; 4]) -> Result<(), String> {
        let [f, g] = [a, b].map(|c| scaled([3, 0], |i| Interval::point(c[i])));
        for (k, found) in Interval::product(&f, &g).coefficients().iter().enumerate() {
            let terms = (0..4).filter(|i| (i..&(i + 4)).contains(&&k));
            let exact: BigInt = terms.map(|i| units(a[i]) * units(b[k - i])).sum();
            if !oracle::between(*found, &exact, UNIT) {
                return Err(format!("{a:?} {b:?} {k}: {found:?}"));
            }
        }
        Ok(())
    }

    /// Where a large coefficient meets a subnormal one and the sum cancels, the rounding of the products is
    /// all that is left, and a bound of it by multiples of the subnormal numbers underflows.
    #[test]
    fn products_of_large_and_subnormal_numbers_hold_what_cancels() {
        let mut operands = Operands::new(1);
        let mut failures = Vec::new();
        for _ in 0..20_000 {
            let mut large = || {
                let exponent = 300 + operands.below(160) as i32;
                (1.0 + operands.fraction()) * 2f64.powi(exponent)
            };
            let a = [large(), large(), large(), large()];
            let mut small = || f64::from_bits(operands.bits() >> (12 + operands.below(40)));
            let mut b = [small(), small(), small(), 0.0];
            // the coefficient of degree 3 cancels as far as doubles allow
            b[3] = -((a[3] * b[0] + a[2] * b[1] + a[1] * b[2]) / a[0]);
            failures.extend(holds_exactly(&a, &b).err());
            failures.extend(holds_exactly(&b, &a).err());
        }
        assert!(failures.is_empty(), "{} fail, as {}", failures.len(), failures[0]);
    }

    #[test]
    fn products_of_extreme_numbers_hold_the_exact_ones() {
        let mut operands = Operands::new(2);
        for _ in 0..20_000 {
            let mut four = || [0; 4].map(|_| operands.double());
            let (a, b) = (four(), four());
            holds_exactly(&a, &b).unwrap();
        }
        // on both sides of what is taken to be large
        for _ in 0..2000 {
            let mut four = || [0; 4].map(|_| LARGE * (0.5 + operands.fraction()) * operands.sign());
            let (a, b) = (four(), four());
            holds_exactly(&a, &b).unwrap();
        }
    }

    #[test]
    fn what_is_not_moderate_is_multiplied_plainly() {
        let entire = scaled([1, 0], |_| Interval::ENTIRE);
        let ones = scaled([1, 0], |_| Interval::point(1.0));
        assert!(
            Interval::product(&entire, &ones)
                .coefficients()
                .iter()
                .all(|&c| c == Interval::ENTIRE)
        );
    }
}
