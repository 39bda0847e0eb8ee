//! Sums of cosines of rational turns.

use super::fraction;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// A fraction of a full turn, `(n, k)` for k/n: `0 < 2k < n`, in lowest terms. Only angles with an irrational
/// cosine occur.
type Turn = (i64, i64);

/// The largest order of a root of unity that is reckoned with: a vertex of valence 1000 with sines of its
/// eighth turns.
pub(super) const MAX_ORDER: i64 = 1 << 13;

/// The most products that one multiplication may need, and the most cosines of a number.
const MAX_PRODUCTS: usize = 1 << 12;
const MAX_TERMS: usize = 1 << 10;

/// The most bits of a numerator or denominator beside cosines: beyond it numbers cost more than they tell.
const MAX_BITS: u64 = 1 << 13;

/// The largest dimension over the rational numbers in which one is divided by an irrational number: all
/// orders up to 64 have less.
const MAX_DIMENSION: usize = 32;

/// The parts of an [`Exact`](crate::Exact) number: `rational + sum of factor cos(2 pi k/n)`.
#[derive(Clone, Debug)]
pub struct Cosines {
    pub(super) rational: BigRational,
    /// No factor is zero. Cosines of different turns may depend on each other, so that one number has several
    /// such forms.
    pub(super) terms: BTreeMap<Turn, BigRational>,
}

impl Cosines {
    pub(super) fn rational(rational: BigRational) -> Self {
        Cosines {
            rational,
            terms: BTreeMap::new(),
        }
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
    pub(super) fn add(&mut self, factor: &BigRational, k: i64, n: i64) {
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

    pub(super) fn scaled(mut self, by: &BigRational) -> Self {
        if by.is_zero() {
            return Cosines::rational(BigRational::zero());
        }
        self.rational *= by;
        for factor in self.terms.values_mut() {
            *factor *= by;
        }
        self
    }

    pub(super) fn is_affordable(&self) -> bool {
        let small = |value: &BigRational| value.numer().bits().max(value.denom().bits()) <= MAX_BITS;
        self.terms.is_empty()
            || self.terms.len() <= MAX_TERMS
                && self.order() <= MAX_ORDER
                && small(&self.rational)
                && self.terms.values().all(small)
    }

    /// The coefficients of the powers of `exp(2 pi i/order)`, in the basis described at [`Exact`].
    pub(super) fn coefficients(&self, order: i64) -> BTreeMap<i64, BigRational> {
        in_basis(self.turned(order, 0), order)
    }

    /// The number times `exp(2 pi i by/order)`, as coefficients of powers of `exp(2 pi i/order)`.
    fn turned(&self, order: i64, by: i64) -> Vec<(i64, BigRational)> {
        let cosines = self.terms().flat_map(|(factor, k, n)| {
            let (turn, half) = (k * (order / n), factor * fraction(1, 2));
            [(by + turn, half.clone()), (by - turn, half)]
        });
        cosines.chain([(by, self.rational.clone())]).collect()
    }

    /// The same number in the basis, where that is shorter; a rational number always becomes one.
    pub(super) fn settled(self) -> Self {
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

    pub(super) fn product(&self, other: &Self) -> Option<Self> {
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
    pub(super) fn inverse(&self) -> Option<Self> {
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
}

/// A sum of powers of `exp(2 pi i/order)`, exponents with their coefficients, in the basis described at
/// [`Exact`]: exponents in `0..order`, and no coefficient is zero.
fn in_basis(sum: Vec<(i64, BigRational)>, order: i64) -> BTreeMap<i64, BigRational> {
    let mut powers: BTreeMap<i64, BigRational> = BTreeMap::new();
    let add = |powers: &mut BTreeMap<i64, BigRational>, power: i64, by: &BigRational| {
        *powers.entry(power.rem_euclid(order)).or_insert_with(BigRational::zero) += by;
    };
    for (power, coefficient) in &sum {
        add(&mut powers, *power, coefficient);
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

/// `re + i im` as a sum of powers of `exp(2 pi i/order)`; `None` if it is none.
///
/// The basis of a field is a part of that of every larger one, whose exponents are multiples of the quotient
/// of the orders: digits of a p-part stay where they are, and a p-part of 0 has the first digit 0.
pub(super) fn powers(re: &Cosines, im: &Cosines, order: i64) -> Option<Vec<(usize, BigRational)>> {
    let is_real = im.terms.is_empty() && im.rational.is_zero();
    if is_real && re.terms.is_empty() {
        return Some(vec![(0, re.rational.clone())]);
    }
    let quarter = if is_real { 1 } else { 4 };
    let common = [re.order(), im.order(), quarter]
        .iter()
        .fold(order, |all, of| all.lcm(of));
    if common > 4 * MAX_ORDER {
        return None;
    }
    let mut sum = re.turned(common, 0);
    if !is_real {
        sum.extend(im.turned(common, common / 4));
    }
    let step = common / order;
    let reduced = in_basis(sum, common).into_iter();
    reduced
        .map(|(power, coefficient)| (power % step == 0).then_some(((power / step) as usize, coefficient)))
        .collect()
}

/// The primes of a number, with their powers in it.
pub(super) fn prime_powers(mut n: i64) -> Vec<(i64, i64)> {
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
