use super::cosines::MAX_ORDER;
use super::*;
use num_traits::Signed;
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

/// Roots of unity and what is made of them have one sum of powers, in the fields that they are of and in no
/// other.
#[test]
fn complex_numbers_are_sums_of_powers() {
    for n in 1..40_i64 {
        for k in 0..n {
            let turn: Complex<Exact> = Complex::turn(k, n);
            let powers = Exact::powers(&turn, n as usize).unwrap();
            let sum = powers.iter().fold(Complex::<f64>::zero(), |sum, (power, coefficient)| {
                sum + Complex::turn(*power as i64, n).scale(f64::rational(coefficient))
            });
            let expected = Complex::<f64>::turn(k, n);
            assert!((sum - expected).modulus() < 1e-13, "{k}/{n}");
            assert_eq!(powers, Exact::powers(&Complex::turn(k + n, n), n as usize).unwrap());
        }
        // a primitive root of order 5 n is of the field of order n for no n; i only where 4 divides the order
        assert!(Exact::powers(&Complex::turn(1, 5 * n), n as usize).is_none());
        assert_eq!(Exact::powers(&Complex::turn(1, 4), n as usize).is_some(), n % 4 == 0);
        // minus a root is of its field, though it is written with cosines of twice the order
        assert!(Exact::powers(&Complex::turn(1, 2), n as usize).is_some());
        assert_eq!(
            Exact::powers(&Complex::turn(1, 2 * n), n as usize).is_some(),
            n % 2 == 1
        );
    }
}
