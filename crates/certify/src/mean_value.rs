//! The mean-value form: sharp ranges of formulas over a small range of their parameters.
//!
//! Intervals forget that two occurrences of a parameter are the same number, and the width of the result of a
//! formula grows with the number of occurrences. The centred form keeps the dependence to first order
//! (Neumaier 1990, section 2.3): with the parameters `p_j = m_j + r_j t_j`, `t_j` in `[-1, 1]`,
//!
//! ```text
//! f(p) = f(m) + sum_j s_j t_j,     s_j the slopes of f in direction j,
//! ```
//!
//! whose overestimation is quadratic in the `r_j` where that of plain intervals is linear. [`Centred`]
//! carries `f(m)`, the slopes and the range through a formula and intersects the two forms of the range after
//! every operation, so any code written over [`Scalar`] runs with it.
//!
//! Slopes obey the rules of derivatives with one factor taken at the centre (Krawczyk and Neumaier 1985),
//! hence are never wider than derivatives over the range: for a product `a b - a(m) b(m) = (a - a(m)) b +
//! a(m) (b - b(m))`.

use crate::Interval;
use eigenring_spline::bernstein::Coefficient;
use eigenring_spline::{BigRational, Dual, Same, Scalar};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A scalar of a proof: whatever it carries, it knows an interval that holds its value.
pub trait Enclose: Coefficient {
    /// An interval that holds every value the number can have.
    fn enclosure(&self) -> Interval;

    /// An interval that holds the value at the centre of the parameters; the enclosure itself where there are
    /// none.
    fn central(&self) -> Interval {
        self.enclosure()
    }
}

impl Enclose for Interval {
    fn enclosure(&self) -> Interval {
        *self
    }
}

/// The value of a dual over intervals; its derivatives are enclosures over the same range and are not used.
impl<const D: usize> Enclose for Dual<Interval, D> {
    fn enclosure(&self) -> Interval {
        self.value
    }
}

/// A number that depends on `D` parameters, each a normalised `t_j` in `[-1, 1]`: see the module page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centred<const D: usize = 1> {
    /// The value where all `t_j` are zero.
    central: Interval,
    /// The values over the whole range.
    range: Interval,
    /// The slopes: `value(t) - central = sum_j slopes[j] t_j` for suitable members.
    slopes: [Interval; D],
}

impl<const D: usize> Centred<D> {
    /// A number that does not depend on the parameters.
    pub fn constant(value: Interval) -> Self {
        Centred {
            central: value,
            range: value,
            slopes: [Interval::point(0.0); D],
        }
    }

    /// The parameter of a direction, running over the given range; nothing is known where the range is not
    /// bounded.
    pub fn parameter(range: Interval, direction: usize) -> Self {
        let mut slopes = [Interval::point(0.0); D];
        // a radius that is rounded up leaves t within [-1, 1]
        slopes[direction] = Interval::point(range.radius());
        Centred {
            central: Interval::point(range.mid()),
            range,
            slopes,
        }
    }

    /// A number known by its value at the centre, its derivatives over the range with respect to each `t_j`,
    /// and possibly (else [`Interval::ENTIRE`]) by its range.
    pub fn from_parts(central: Interval, slopes: [Interval; D], range: Interval) -> Self {
        Self::sharpened(central, slopes, range)
    }

    /// The slopes: with `p_j = m_j + r_j t_j`, `r_j` times those with respect to `p_j`.
    pub fn slopes(&self) -> [Interval; D] {
        self.slopes
    }

    /// The centred form of the range intersected with the natural one.
    fn sharpened(central: Interval, slopes: [Interval; D], natural: Interval) -> Self {
        let spread: Interval = slopes.iter().map(|&slope| slope * Interval::unit()).sum();
        // both hold the same values, so they meet; the natural range alone is right in any case
        let range = natural.intersect(central + spread).unwrap_or(natural);
        // the centre is one of the values
        let central = central.intersect(range).unwrap_or(central);
        Centred { central, range, slopes }
    }

    fn slopes_with(&self, other: &Self, slope: impl Fn(Interval, Interval) -> Interval) -> [Interval; D] {
        std::array::from_fn(|j| slope(self.slopes[j], other.slopes[j]))
    }
}

impl<const D: usize> Enclose for Centred<D> {
    fn enclosure(&self) -> Interval {
        self.range
    }

    fn central(&self) -> Interval {
        self.central
    }
}

impl<const D: usize> Add for Centred<D> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let slopes = self.slopes_with(&other, |s, t| s + t);
        Self::sharpened(self.central + other.central, slopes, self.range + other.range)
    }
}

impl<const D: usize> Sub for Centred<D> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        let slopes = self.slopes_with(&other, |s, t| s - t);
        Self::sharpened(self.central - other.central, slopes, self.range - other.range)
    }
}

impl<const D: usize> Mul for Centred<D> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slopes = self.slopes_with(&other, |s, t| s * other.range + self.central * t);
        Self::sharpened(self.central * other.central, slopes, self.range * other.range)
    }
}

impl<const D: usize> Div for Centred<D> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let central = self.central / other.central;
        let slopes = self.slopes_with(&other, |s, t| (s - central * t) / other.range);
        Self::sharpened(central, slopes, self.range / other.range)
    }
}

impl<const D: usize> Neg for Centred<D> {
    type Output = Self;
    fn neg(self) -> Self {
        Centred {
            central: -self.central,
            range: -self.range,
            slopes: self.slopes.map(|s| -s),
        }
    }
}

impl<const D: usize> AddAssign for Centred<D> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const D: usize> SubAssign for Centred<D> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const D: usize> Same for Centred<D> {
    /// Two points that depend on no parameter and are equal.
    fn same(&self, other: &Self) -> bool {
        let constant = self.slopes.iter().chain(&other.slopes).all(|slope| slope.is_zero());
        constant && self.range.same(&other.range)
    }
}

impl<const D: usize> Scalar for Centred<D> {
    fn rational(value: &BigRational) -> Self {
        Self::constant(Interval::rational(value))
    }

    fn ratio(p: i64, q: i64) -> Self {
        Self::constant(Interval::ratio(p, q))
    }

    fn exact(value: f64) -> Self {
        Self::constant(Interval::exact(value))
    }

    /// The slope of a root is `1 / (sqrt(a) + sqrt(a(m)))`.
    fn sqrt(self) -> Self {
        let (central, range) = (self.central.sqrt(), self.range.sqrt());
        Self::sharpened(central, self.slopes.map(|s| s / (range + central)), range)
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        Self::constant(Interval::cos_turn(k, n))
    }

    fn sin_turn(k: i64, n: i64) -> Self {
        Self::constant(Interval::sin_turn(k, n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::oracle::Operands;
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn formula<S: Scalar + Copy>(x: S, y: S) -> S {
        let mut sum = (x * x - x * y) / (y + S::ratio(1, 3)) + (x * y + S::one()).sqrt();
        sum -= x * S::cos_turn(1, 7) - x * x * x;
        sum
    }

    proptest! {
        #[test]
        fn members_stay_inside(m in 0.5..2.0_f64, n in 0.5..2.0_f64, r in 0.0..0.3_f64, t in -1.0..1.0_f64, s in -1.0..1.0_f64) {
            let (x, y) = (Interval::around(m, r), Interval::around(n, r));
            let over = formula(Centred::<2>::parameter(x, 0), Centred::parameter(y, 1));
            // the formula on a member, itself an interval of a few ulps
            let member = |range: Interval, t: f64| Interval::point((range.mid() + 0.999 * range.radius() * t).clamp(range.lo(), range.hi()));
            let exact = formula(member(x, t), member(y, s));
            prop_assert!(over.enclosure().encloses(exact) || over.enclosure().intersect(exact).is_some());
            prop_assert!(exact.width() < 1e-13);
            let central = formula(Interval::point(x.mid()), Interval::point(y.mid()));
            prop_assert!(over.central().intersect(central).is_some());
            prop_assert!(formula(x, y).encloses(over.enclosure()));
        }
    }

    fn rational(value: f64) -> BigRational {
        BigRational::from_float(value).expect("finite")
    }

    fn holds(interval: Interval, exact: &BigRational) -> bool {
        let low = interval.lo() == f64::NEG_INFINITY || rational(interval.lo()) <= *exact;
        low && (interval.hi() == f64::INFINITY || *exact <= rational(interval.hi()))
    }

    /// Range, centre and slopes hold the exact values, for ranges of any width that reach across zeros of
    /// denominators or consist of subnormal numbers.
    #[test]
    fn exact_values_stay_inside_at_all_scales() {
        let mut operands = Operands::new(41);
        let mut bounded = 0;
        for round in 0..900 {
            let mut number = || match round % 3 {
                0 => operands.double().clamp(-1e100, 1e100),
                _ => operands.fraction() * operands.sign(),
            };
            let (m, n) = (number(), number());
            let radius = [0.0, 1e-300, 1e-12, 0.1, 3.0][operands.below(5)];
            let (x, y) = (Interval::around(m, radius), Interval::around(n, radius));
            let (cx, cy) = (Centred::<2>::parameter(x, 0), Centred::parameter(y, 1));
            let sum = cx + cy;
            let product = sum * (cx - cy) - cx * cx;
            let quotient = product / (cy + Centred::ratio(1, 3));
            let root = (cx * cx + cy * cy).sqrt();
            for _ in 0..3 {
                // members p = m + r t with t in [-1, 1]
                let mut member = |range: Interval| {
                    let (mid, radius) = (rational(range.mid()), rational(range.radius()));
                    let end = [range.lo(), range.hi(), range.mid()][operands.below(3)];
                    let p = match operands.below(2) {
                        0 => rational(end),
                        _ => {
                            rational((range.mid() + range.radius() * operands.fraction()).clamp(range.lo(), range.hi()))
                        }
                    };
                    let t = if radius == rational(0.0) {
                        radius
                    } else {
                        (&p - mid) / radius
                    };
                    (p, t)
                };
                let ((p, s), (q, t)) = (member(x), member(y));
                let exact_product = (&p + &q) * (&p - &q) - &p * &p;
                let third = BigRational::new(1.into(), 3.into());
                let mut exact = vec![(sum, &p + &q), (product, exact_product.clone())];
                let denominator = &q + third;
                if denominator != rational(0.0) {
                    exact.push((quotient, exact_product / denominator));
                }
                for (found, exact) in exact {
                    assert!(holds(found.enclosure(), &exact), "{x:?} {y:?} {found:?} {exact}");
                    // the slopes lead from the centre to the value: exact ends of their products with s and t
                    let [a, b] = found.slopes;
                    if [a, b, found.central].iter().all(|part| part.is_bounded()) {
                        let reach = |low: bool| {
                            let end = |slope: Interval, t: &BigRational| {
                                let ends = [slope.lo(), slope.hi()].map(|bound| rational(bound) * t);
                                let [first, second] = ends;
                                if (first < second) == low { first } else { second }
                            };
                            let central = if low { found.central.lo() } else { found.central.hi() };
                            rational(central) + end(a, &s) + end(b, &t)
                        };
                        assert!(reach(true) <= exact && exact <= reach(false), "{x:?} {y:?} {found:?}");
                        bounded += 1;
                    }
                }
                let square = &p * &p + &q * &q;
                let root = root.enclosure();
                assert!(root.lo() <= 0.0 || rational(root.lo()) * rational(root.lo()) <= square);
                assert!(root.hi() == f64::INFINITY || square <= rational(root.hi()) * rational(root.hi()));
            }
        }
        assert!(bounded > 4000, "{bounded}");
    }

    #[test]
    fn overestimation_is_quadratic() {
        let f = |x: Centred<1>| x * (Centred::one() - x) * (x + x * x);
        let excess = |radius: f64| {
            let over = f(Centred::parameter(Interval::around(0.3, radius), 0)).enclosure();
            // f is increasing around 0.3
            let value = |x: f64| x * (1.0 - x) * (x + x * x);
            over.width() - (value(0.3 + radius) - value(0.3 - radius))
        };
        let (coarse, fine) = (excess(1e-3), excess(1e-4));
        assert!(fine > 0.0 && fine < coarse / 50.0, "{coarse:e} {fine:e}");
    }

    #[test]
    fn what_cancels_cancels() {
        let x = Centred::<1>::parameter(Interval::new(1.0, 2.0).expect("in order"), 0);
        assert!((x - x).enclosure().is_zero());
        assert_eq!((x / Centred::zero()).enclosure(), Interval::ENTIRE);
    }
}
