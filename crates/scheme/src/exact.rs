//! Stencil weights as exact numbers.

use crate::{Same, Scalar};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A fraction of a full turn, `(n, k)` for k/n: `0 < 2k < n`, in lowest terms. Only angles with an irrational
/// cosine occur.
type Turn = (i64, i64);

/// The largest order of a root of unity that is reckoned with: a vertex of valence 1000 with sines of its
/// eighth turns.
const MAX_ORDER: i64 = 1 << 13;

/// The most products that one multiplication may need, and the most cosines of a number.
const MAX_PRODUCTS: usize = 1 << 12;
const MAX_TERMS: usize = 1 << 10;

/// The most bits of a numerator or denominator beside cosines: beyond it numbers cost more than they tell.
const MAX_BITS: u64 = 1 << 13;

/// The largest dimension over the rational numbers in which one is divided by an irrational number: all
/// orders up to 64 have less.
const MAX_DIMENSION: usize = 32;

/// The largest prime whose square root is taken.
const MAX_RADICAND: i64 = 127;

/// The parts of an [`Exact`] number: `rational + sum of factor cos(2 pi k/n)`.
#[derive(Clone, Debug)]
pub struct Cosines {
    rational: BigRational,
    /// No factor is zero. Cosines of different turns may depend on each other, so that one number has several
    /// such forms.
    terms: BTreeMap<Turn, BigRational>,
}

/// A real number of a cyclotomic field of order up to 2^13, with rational coefficients of any size, or
/// nothing: an operation that leaves these numbers (most square roots), or that costs too much, gives a
/// number without value, and so does every operation with one.
///
/// Numbers are sums of cosines of rational turns, which sums, products, conjugates and square roots of
/// rational numbers are again. Equality is decided: `sum of c_k w^k` with `w = exp(2 pi i/n)` has one form in
/// the basis of powers of w that is left when for every prime p dividing n, with `p^a` the power in n, the
/// exponents whose p-part (as an element of `Z/p^a`) has p - 1 as its first digit are replaced by
/// `w^k = -(w^(k + n/p) + .. + w^(k + (p-1) n/p))`: the p-parts are independent of each other, and phi(n)
/// powers remain.
///
/// Symmetry and the degree of the regular part are derived from these numbers, and equalities of weights are
/// decided in them.
#[derive(Clone, Debug)]
pub struct Exact(Option<Box<Cosines>>);

impl Cosines {
    fn rational(rational: BigRational) -> Self {
        Cosines {
            rational,
            terms: BTreeMap::new(),
        }
    }

    /// The rational part.
    pub fn rational_part(&self) -> &BigRational {
        &self.rational
    }

    /// The cosines: `(factor, k, n)` for `factor cos(2 pi k/n)`.
    pub fn terms(&self) -> impl Iterator<Item = (&BigRational, i64, i64)> {
        self.terms.iter().map(|(&(n, k), factor)| (factor, k, n))
    }

    /// The order of a cyclotomic field that holds the number: the least common multiple of the cosines'.
    pub fn order(&self) -> i64 {
        self.terms.keys().fold(1, |order, (n, _)| order.lcm(n))
    }

    /// Adds `factor cos(2 pi k/n)`, `n > 0`.
    fn add(&mut self, factor: &BigRational, k: i64, n: i64) {
        // the smaller of the two angles with this cosine, in lowest terms
        let k = k.rem_euclid(n);
        let k = k.min(n - k);
        let divisor = k.gcd(&n).max(1);
        let known = match (k / divisor, n / divisor) {
            (0, _) => Some((1, 1)),
            (1, 2) => Some((-1, 1)),
            (1, 4) => Some((0, 1)),
            (1, 6) => Some((1, 2)),
            (1, 3) => Some((-1, 2)),
            _ => None,
        };
        if let Some((p, q)) = known {
            self.rational += factor * fraction(p, q);
            return;
        }
        let turn = (n / divisor, k / divisor);
        let sum = self.terms.entry(turn).or_insert_with(BigRational::zero);
        *sum += factor;
        if sum.is_zero() {
            self.terms.remove(&turn);
        }
    }

    fn scaled(mut self, by: &BigRational) -> Self {
        if by.is_zero() {
            return Cosines::rational(BigRational::zero());
        }
        self.rational *= by;
        for factor in self.terms.values_mut() {
            *factor *= by;
        }
        self
    }

    fn is_affordable(&self) -> bool {
        let small = |value: &BigRational| value.numer().bits().max(value.denom().bits()) <= MAX_BITS;
        self.terms.is_empty()
            || self.terms.len() <= MAX_TERMS
                && self.order() <= MAX_ORDER
                && small(&self.rational)
                && self.terms.values().all(small)
    }

    /// The coefficients of the powers of `exp(2 pi i/order)`, in the basis described at [`Exact`].
    fn coefficients(&self, order: i64) -> BTreeMap<i64, BigRational> {
        let mut powers: BTreeMap<i64, BigRational> = BTreeMap::new();
        let add = |powers: &mut BTreeMap<i64, BigRational>, power: i64, by: &BigRational| {
            *powers.entry(power.rem_euclid(order)).or_insert_with(BigRational::zero) += by;
        };
        add(&mut powers, 0, &self.rational);
        for (factor, k, n) in self.terms() {
            let half = factor * fraction(1, 2);
            add(&mut powers, k * (order / n), &half);
            add(&mut powers, -k * (order / n), &half);
        }
        for (p, power) in prime_powers(order) {
            // the p-part of an exponent k is k/(order/power) modulo power
            let inverse = (order / power).extended_gcd(&power).x.rem_euclid(power);
            let first_digit = |k: i64| (k % power * inverse % power) / (power / p);
            let surplus: Vec<i64> = powers.keys().copied().filter(|&k| first_digit(k) == p - 1).collect();
            for k in surplus {
                let coefficient = -powers.remove(&k).unwrap_or_default();
                for j in 1..p {
                    add(&mut powers, k + j * (order / p), &coefficient);
                }
            }
        }
        powers.retain(|_, coefficient| !coefficient.is_zero());
        powers
    }

    /// The same number in the basis, where that is shorter; a rational number always becomes one.
    fn settled(self) -> Self {
        if self.terms.len() < 2 {
            return self;
        }
        let order = self.order();
        let mut other = Cosines::rational(BigRational::zero());
        for (power, coefficient) in self.coefficients(order) {
            // the number is real
            other.add(&coefficient, power, order);
        }
        if other.terms.len() < self.terms.len() {
            other
        } else {
            self
        }
    }

    fn product(&self, other: &Self) -> Option<Self> {
        if other.terms.is_empty() {
            return Some(self.clone().scaled(&other.rational));
        }
        if self.terms.is_empty() {
            return Some(other.clone().scaled(&self.rational));
        }
        let order = self.order().lcm(&other.order());
        if self.terms.len() * other.terms.len() > MAX_PRODUCTS || order > MAX_ORDER {
            return None;
        }
        let mut product = Cosines::rational(&self.rational * &other.rational);
        for (factor, k, n) in self.terms() {
            product.add(&(factor * &other.rational), k, n);
        }
        for (factor, k, n) in other.terms() {
            product.add(&(factor * &self.rational), k, n);
        }
        for (a, k, n) in self.terms() {
            for (b, j, m) in other.terms() {
                // cos x cos y = (cos(x + y) + cos(x - y))/2
                let half = a * b * fraction(1, 2);
                let (x, y) = (k * (order / n), j * (order / m));
                product.add(&half, x + y, order);
                product.add(&half, x - y, order);
            }
        }
        Some(product.settled()).filter(Self::is_affordable)
    }

    /// The conjugate under `w -> w^by`.
    fn conjugate(&self, by: i64) -> Self {
        let mut image = Cosines::rational(self.rational.clone());
        for (factor, k, n) in self.terms() {
            image.add(factor, k * by % n, n);
        }
        image
    }

    /// The product of all other conjugates, divided by that of all.
    fn inverse(&self) -> Option<Self> {
        let value = self.clone().settled();
        if value.terms.is_empty() {
            return (!value.rational.is_zero()).then(|| Cosines::rational(value.rational.recip()));
        }
        let order = value.order();
        if value.coefficients(order).is_empty() {
            return None;
        }
        let units: Vec<i64> = (2..=order / 2).filter(|k| k.gcd(&order) == 1).collect();
        if units.len() >= MAX_DIMENSION {
            return None;
        }
        let others = units
            .iter()
            .try_fold(Cosines::rational(BigRational::one()), |product, &by| {
                product.product(&value.conjugate(by))
            })?;
        // conjugates that coincide, where the number lies in a smaller field, do no harm
        let norm = others.product(&value)?.settled();
        (norm.terms.is_empty() && !norm.rational.is_zero()).then(|| others.scaled(&norm.rational.recip()))
    }

    fn root(&self) -> Option<Self> {
        if self.terms.is_empty() {
            return root_of_rational(&self.rational);
        }
        // 1 + cos x = 2 cos^2(x/2), 1 - cos x = 2 sin^2(x/2), where x/2 is in the first quadrant
        let (&(n, k), factor) = self.terms.iter().next().filter(|_| self.terms.len() == 1)?;
        let mut half = Cosines::rational(BigRational::zero());
        if *factor == self.rational {
            half.add(&BigRational::one(), k, 2 * n);
        } else if -factor == self.rational {
            half.add(&BigRational::one(), n - 2 * k, 4 * n);
        } else {
            return None;
        }
        root_of_rational(&(&self.rational * fraction(2, 1)))?.product(&half)
    }
}

fn fraction(p: i64, q: i64) -> BigRational {
    BigRational::new(p.into(), q.into())
}

/// The primes of a number, with their powers in it.
fn prime_powers(mut n: i64) -> Vec<(i64, i64)> {
    let mut found = Vec::new();
    let mut p = 2;
    while p * p <= n {
        let mut power = 1;
        while n % p == 0 {
            n /= p;
            power *= p;
        }
        if power > 1 {
            found.push((p, power));
        }
        p += 1;
    }
    if n > 1 {
        found.push((n, n));
    }
    found
}

/// `sqrt(p/q) = sqrt(p q)/q`, by the roots of the primes that divide `p q` an odd number of times.
fn root_of_rational(square: &BigRational) -> Option<Cosines> {
    if square.is_negative() {
        return None;
    }
    let mut rest: BigInt = square.numer() * square.denom();
    let mut root = Cosines::rational(BigRational::new(BigInt::one(), square.denom().clone()));
    let whole = rest.sqrt();
    if &whole * &whole == rest {
        return Some(root.scaled(&BigRational::from_integer(whole)));
    }
    for p in (2..=MAX_RADICAND).filter(|&p| prime_powers(p) == [(p, p)]) {
        let prime = BigInt::from(p);
        let mut odd = false;
        loop {
            let (quotient, remainder) = rest.div_rem(&prime);
            if !remainder.is_zero() {
                break;
            }
            rest = quotient;
            if odd {
                root = root.scaled(&BigRational::from_integer(prime.clone()));
            }
            odd = !odd;
        }
        if odd {
            root = root.product(&root_of_prime(p))?;
        }
    }
    let whole = rest.sqrt();
    (&whole * &whole == rest).then(|| root.scaled(&BigRational::from_integer(whole)))
}

/// Gauss: the sum of `w^(j^2)` over j modulo p is `sqrt(p)` for p = 1 modulo 4, and `i sqrt(p)` for p = 3
/// modulo 4.
fn root_of_prime(p: i64) -> Cosines {
    let mut root = Cosines::rational(BigRational::zero());
    let one = BigRational::one();
    match p % 4 {
        2 => root.add(&fraction(2, 1), 1, 8),
        1 => (0..p).for_each(|j| root.add(&one, j * j % p, p)),
        // the sine of a turn is the cosine of one a quarter turn earlier
        _ => (0..p).for_each(|j| root.add(&one, 4 * (j * j % p) - p, 4 * p)),
    }
    root
}

impl Exact {
    /// The value, if it could be represented.
    pub fn cosines(&self) -> Option<&Cosines> {
        self.0.as_deref()
    }

    /// Whether it could be represented.
    pub fn has_value(&self) -> bool {
        self.0.is_some()
    }

    /// The value, if it is a rational number.
    pub fn as_rational(&self) -> Option<BigRational> {
        let cosines = self.cosines()?;
        if cosines.terms.len() < 2 {
            return cosines.terms.is_empty().then(|| cosines.rational.clone());
        }
        let settled = cosines.clone().settled();
        settled.terms.is_empty().then_some(settled.rational)
    }

    /// Whether the number is zero; `None` for a number without value.
    pub fn is_zero(&self) -> Option<bool> {
        let cosines = self.cosines()?;
        Some(match cosines.terms.len() {
            0 => cosines.rational.is_zero(),
            // a single cosine that is listed is irrational
            1 => false,
            _ => cosines.coefficients(cosines.order()).is_empty(),
        })
    }

    /// How many coefficients the number has, and the machine words of the longest.
    pub(crate) fn size(&self) -> (usize, usize) {
        let words = |value: &BigRational| 1 + ((value.numer().bits() + value.denom().bits()) / 64) as usize;
        self.cosines().map_or((1, 1), |cosines| {
            let longest = cosines.terms.values().map(words).max().unwrap_or(1);
            (1 + cosines.terms.len(), longest.max(words(&cosines.rational)))
        })
    }

    /// The number in another type; `None` for a number without value.
    pub fn to<S: Scalar>(&self) -> Option<S> {
        let cosines = self.cosines()?;
        let mut sum = S::rational(&cosines.rational);
        for (factor, k, n) in cosines.terms() {
            sum += S::rational(factor) * S::cos_turn(k, n);
        }
        Some(sum)
    }

    fn of(cosines: Option<Cosines>) -> Self {
        Exact(cosines.map(Box::new))
    }

    fn combine(self, other: Self, f: impl Fn(Cosines, Cosines) -> Option<Cosines>) -> Self {
        match (self.0, other.0) {
            (Some(a), Some(b)) => Self::of(f(*a, *b)),
            _ => Exact(None),
        }
    }
}

impl PartialEq for Exact {
    /// Equality of values, or of having none.
    fn eq(&self, other: &Self) -> bool {
        match (self.cosines(), other.cosines()) {
            (Some(a), Some(b)) if a.terms == b.terms => a.rational == b.rational,
            (Some(a), Some(b)) if a.terms.is_empty() && b.terms.is_empty() => false,
            (Some(_), Some(_)) => (self.clone() - other.clone()).is_zero() == Some(true),
            (None, None) => true,
            _ => false,
        }
    }
}

impl Same for Exact {
    /// Two numbers without value are not known to be the same.
    fn same(&self, other: &Self) -> bool {
        self.has_value() && self == other
    }
}

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, |mut a, b| {
            a.rational += &b.rational;
            for (factor, k, n) in b.terms() {
                a.add(factor, k, n);
            }
            a.is_affordable().then_some(a)
        })
    }
}

impl Neg for Exact {
    type Output = Self;
    fn neg(self) -> Self {
        Self::of(self.0.map(|a| a.scaled(&-BigRational::one())))
    }
}

impl Sub for Exact {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, |a, b| a.product(&b))
    }
}

impl Div for Exact {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.combine(other, |a, b| a.product(&b.inverse()?))
    }
}

impl AddAssign for Exact {
    fn add_assign(&mut self, other: Self) {
        *self = std::mem::replace(self, Exact(None)) + other;
    }
}

impl SubAssign for Exact {
    fn sub_assign(&mut self, other: Self) {
        *self = std::mem::replace(self, Exact(None)) - other;
    }
}

impl Scalar for Exact {
    fn ratio(p: i64, q: i64) -> Self {
        let value = (q != 0).then(|| fraction(p, q));
        Self::of(value.map(Cosines::rational))
    }

    fn exact(value: f64) -> Self {
        Self::of(BigRational::from_float(value).map(Cosines::rational))
    }

    fn rational(value: &BigRational) -> Self {
        Self::of(Some(Cosines::rational(value.clone())))
    }

    fn sqrt(self) -> Self {
        Self::of(self.0.and_then(|square| square.root()))
    }

    fn cos_turn(k: i64, n: i64) -> Self {
        if n == 0 {
            return Exact(None);
        }
        let mut cosine = Cosines::rational(BigRational::zero());
        match n.checked_abs() {
            Some(n) if n <= i64::MAX / 2 => cosine.add(&BigRational::one(), k, n),
            _ => return Exact(None),
        }
        Self::of(cosine.is_affordable().then_some(cosine))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn rational(p: i64, q: i64) -> BigRational {
        BigRational::new(p.into(), q.into())
    }

    fn value(number: Exact) -> Option<BigRational> {
        number.as_rational()
    }

    proptest! {
        #[test]
        fn rational_operations_are_those_of_fractions(
            a in any::<i64>(), b in 1..i64::MAX, c in any::<i64>(), d in 1..i64::MAX,
            x in proptest::num::f64::NORMAL,
        ) {
            let (p, q) = (Exact::ratio(a, b), Exact::ratio(c, d));
            let (r, s) = (rational(a, b), rational(c, d));
            prop_assert_eq!(value(p.clone() + q.clone()), Some(&r + &s));
            prop_assert_eq!(value(p.clone() - q.clone()), Some(&r - &s));
            prop_assert_eq!(value(p.clone() * q.clone()), Some(&r * &s));
            if c != 0 {
                prop_assert_eq!(value(p.clone() / q), Some(&r / &s));
            }
            prop_assert_eq!(value((p.clone() * p).sqrt()), Some(r.abs()));
            prop_assert_eq!(value(Exact::exact(x)), BigRational::from_float(x));
        }
    }

    #[test]
    fn cosines_have_one_form() {
        for n in 1..40_i64 {
            for k in -n..=n {
                let cosine = Exact::cos_turn(k, n);
                assert!(cosine.same(&Exact::cos_turn(-k, n)) && cosine.same(&Exact::cos_turn(3 * (k + n), 3 * n)));
                assert!((cosine.to::<f64>().unwrap() - f64::cos_turn(k, n)).abs() < 1e-15);
            }
        }
        assert!(Exact::ratio(1, 0).cosines().is_none() && Exact::exact(f64::NAN).cosines().is_none());
        assert!(Exact::cos_turn(1, MAX_ORDER + 1).cosines().is_none());
        let lost = Exact::ratio(-1, 1).sqrt();
        assert!(!lost.has_value() && !lost.same(&lost) && !(lost * Exact::zero()).has_value());
    }

    /// Sums over all sectors have closed forms, for every order.
    #[test]
    fn dependent_cosines_are_recognised() {
        for n in (1..40_i64).chain([360, 997, 1000]) {
            let sum = (0..n).fold(Exact::zero(), |sum, k| sum + Exact::cos_turn(k, n));
            assert_eq!(sum.as_rational(), Some(rational(i64::from(n == 1), 1)), "{n}");
        }
        // cos 36 degrees cos 72 degrees = 1/4
        let product = Exact::cos_turn(1, 10) * Exact::cos_turn(1, 5);
        assert_eq!(product.as_rational(), Some(rational(1, 4)));
        let (a, b) = (Exact::cos_turn(1, 5), Exact::cos_turn(2, 5));
        assert!((a.clone() + b.clone()).same(&Exact::ratio(-1, 2)));
        assert!(!a.same(&b) && (a.clone() - a).is_zero() == Some(true));
    }

    /// Random expressions: the exact value is that of doubles, and equal ones are told from unequal ones.
    #[test]
    fn the_field_agrees_with_doubles() {
        let mut state = 1_u64;
        let mut next = |bound: i64| {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 33) as i64 % bound
        };
        for n in [5, 7, 8, 9, 12, 15, 16, 20, 24, 31] {
            let mut number = || {
                let terms = (0..2).map(|_| (next(7) - 3, next(n)));
                let terms: Vec<(i64, i64)> = terms.collect();
                let exact = terms.iter().fold(Exact::ratio(1, 3), |sum, &(f, k)| {
                    sum + Exact::ratio(f, 2) * Exact::cos_turn(k, n)
                });
                let double = terms
                    .iter()
                    .fold(1.0 / 3.0, |sum, &(f, k)| sum + f as f64 / 2.0 * f64::cos_turn(k, n));
                (exact, double)
            };
            for _ in 0..10 {
                let ((a, x), (b, y)) = (number(), number());
                let product = a.clone() * b.clone();
                assert!((product.to::<f64>().unwrap() - x * y).abs() < 1e-12, "{n}");
                let difference = a.clone() * a.clone() - b.clone() * b.clone();
                let factored = (a.clone() + b.clone()) * (a.clone() - b.clone());
                assert!(difference.same(&factored), "{n}");
                assert!(!difference.same(&(factored + Exact::ratio(1, 1_000_000_000))));
                if y.abs() > 1e-3 {
                    let quotient = a.clone() / b.clone();
                    assert!((quotient.to::<f64>().unwrap() - x / y).abs() < 1e-9, "{n}");
                    assert!((quotient * b).same(&a), "{n}");
                }
            }
        }
    }

    #[test]
    fn square_roots_of_rational_numbers_and_half_angles() {
        for (p, q) in [(2, 1), (3, 4), (5, 1), (12, 7), (15, 2), (49, 9), (127, 1), (0, 1)] {
            let root = Exact::ratio(p, q).sqrt();
            assert!(
                (root.to::<f64>().unwrap() - (p as f64 / q as f64).sqrt()).abs() < 1e-12,
                "{p}/{q}"
            );
            assert!((root.clone() * root).same(&Exact::ratio(p, q)));
        }
        for n in 3..20 {
            for k in 1..n {
                for sign in [1, -1] {
                    let square = Exact::ratio(3, 2) * (Exact::one() + Exact::ratio(sign, 1) * Exact::cos_turn(k, n));
                    let root = square.clone().sqrt();
                    let expected = square.to::<f64>().unwrap().max(0.0).sqrt();
                    assert!((root.to::<f64>().unwrap() - expected).abs() < 1e-7, "{k}/{n}");
                    assert!((root.clone() * root).same(&square), "{k}/{n}");
                }
            }
        }
        assert!(!Exact::ratio(131, 1).sqrt().has_value());
        assert!(!(Exact::ratio(3, 1) + Exact::cos_turn(1, 5)).sqrt().has_value());
    }
}
