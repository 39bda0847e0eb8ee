//! Square roots that are sums of cosines.

use super::cosines::{Cosines, prime_powers};
use super::fraction;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// The largest prime whose square root is taken.
const MAX_RADICAND: i64 = 127;

impl Cosines {
    /// The square root of a rational number, or of one that a half angle is the root of.
    pub(super) fn root(&self) -> Option<Self> {
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
