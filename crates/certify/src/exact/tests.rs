use super::*;
use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
use eigenring_scheme::{Complex, Exact, Scalar, Scheme};
use num_rational::BigRational;
use proptest::prelude::*;

fn rational(p: i64, q: i64) -> BigRational {
    BigRational::new(p.into(), q.into())
}

proptest! {
    #[test]
    fn fields_are_fields(order in 1_usize..40, a in proptest::collection::vec(-9..9_i64, 4), b in proptest::collection::vec(-9..9_i64, 4)) {
        let field = Field::new(order);
        let number = |v: &[i64]| v.iter().enumerate().fold(Vec::new(), |sum, (k, &c)| {
            field::add(&sum, &field.times(&field.integer(c), &field.root(k as i64)))
        });
        let (x, y) = (number(&a), number(&b));
        let product = field.times(&x, &y);
        // the embedding in the complex numbers is a homomorphism
        let ((xr, xi), (yr, yi), (pr, pi)) = (field.enclose(&x), field.enclose(&y), field.enclose(&product));
        prop_assert!(!pr.disjoint(xr * yr - xi * yi) && !pi.disjoint(xr * yi + xi * yr));
        prop_assert!(pr.width() < 1e-10);
        match field.inverse(&x) {
            None => prop_assert!(x.is_empty()),
            Some(inverse) => prop_assert_eq!(field.times(&inverse, &x), field.integer(1)),
        }
    }

    #[test]
    fn rational_numbers_are_enclosed(p in any::<i64>(), q in 1..i64::MAX) {
        let interval = <Interval as Scalar>::rational(&rational(p, q));
        prop_assert!(BigRational::from_float(interval.lo()).unwrap() <= rational(p, q));
        prop_assert!(BigRational::from_float(interval.hi()).unwrap() >= rational(p, q));
        prop_assert!(interval.hi() <= interval.lo().next_up());
    }
}

#[test]
fn cyclotomic_polynomials_are_the_known_ones() {
    for (order, degree) in [
        (1, 1),
        (2, 1),
        (3, 2),
        (4, 2),
        (5, 4),
        (6, 2),
        (12, 4),
        (30, 8),
        (61, 60),
        (64, 32),
    ] {
        let field = Field::new(order);
        assert_eq!((field.order(), field.degree()), (order, degree));
        // all powers of w are different and sum to zero
        let sum = (0..order as i64).fold(Vec::new(), |sum, k| field::add(&sum, &field.root(k)));
        assert_eq!(sum.is_empty(), order > 1);
        assert_eq!(field.root(order as i64), field.integer(1));
    }
}

/// Catmull-Clark's trace and determinant in block k: `d2 + 2 e1 c + f3 = (5 + c)/8` and `1/16` (Ball and
/// Storry 1988).
#[test]
fn characteristic_polynomials_are_those_of_the_literature() {
    for valence in [3, 5, 6, 7, 12, 64] {
        let field = Field::new(valence);
        let scheme: Scheme<Exact> = catmull_clark(valence).unwrap();
        for k in [1, 2, valence / 2] {
            let polynomial = block_polynomial(&field, scheme.limit(), 1, k).unwrap();
            let cosine = field
                .element(&Complex::real(Exact::cos_turn(k as i64, valence as i64)))
                .unwrap();
            let trace = field::scaled(&field::add(&field.integer(5), &cosine), &rational(1, 8));
            let minus = field::scaled(&trace, &rational(-1, 1));
            let expected = Poly::new(vec![field.rational(rational(1, 16)), minus, field.integer(1)]);
            assert_eq!(polynomial, expected, "{valence} {k}");
        }
        // block 0 has the eigenvalue 1
        let polynomial = block_polynomial(&field, scheme.limit(), 1, 0).unwrap();
        assert!(polynomial.at(&field.integer(1), &field).is_empty());
    }
}

#[test]
fn doo_sabin_has_a_half_and_quarters() {
    for valence in [3, 4, 5, 7, 9, 24] {
        let field = Field::new(valence);
        let scheme: Scheme<Exact> = doo_sabin(valence).unwrap();
        let block = |k| block_polynomial(&field, scheme.limit(), 0, k).unwrap();
        let around = |x: f64| Interval::around(x, 1e-9);
        for k in 2..=valence / 2 {
            let linear = Poly::new(vec![field.rational(rational(-1, 4)), field.integer(1)]);
            assert_eq!(block(k), linear);
            assert_eq!(square_is_root(&field, &block(1), &block(k), around(0.5)), Some(true));
        }
        assert_eq!(
            square_is_root(&field, &block(1), &block(0), around(0.5)),
            Some(false),
            "{valence}"
        );
    }
}

#[test]
fn squares_and_repeated_roots_are_told_apart() {
    // over Q(i): f = (x - 1/2)(x - 1/3), g has 1/4 but not 1/9
    let field = Field::new(4);
    let poly = |roots: &[(i64, i64)]| {
        roots.iter().fold(Poly::new(vec![field.integer(1)]), |poly, &(p, q)| {
            let mut next = vec![Vec::new(); poly.coefficients().len() + 1];
            for (k, c) in poly.coefficients().iter().enumerate() {
                next[k + 1] = field::add(&next[k + 1], c);
                next[k] = field::subtract(&next[k], &field.times(c, &field.rational(rational(p, q))));
            }
            Poly::new(next)
        })
    };
    let near = |x: f64| Interval::around(x, 1e-6);
    let (f, g) = (poly(&[(1, 2), (1, 3)]), poly(&[(1, 4), (1, 5)]));
    assert_eq!(square_is_root(&field, &f, &g, near(0.5)), Some(true));
    assert_eq!(square_is_root(&field, &f, &g, near(1.0 / 3.0)), Some(false));
    // an interval that holds both roots of f decides nothing
    assert_eq!(square_is_root(&field, &f, &g, Interval::new(0.3, 0.6).unwrap()), None);
    // missed by 1e-12
    let near_miss = poly(&[(250_000_000_001, 1_000_000_000_000), (1, 5)]);
    assert_eq!(square_is_root(&field, &f, &near_miss, near(0.5)), Some(false));
    let h = poly(&[(1, 4), (1, 4), (1, 8)]);
    assert_eq!(is_repeated(&field, &h, near(0.25)), Some(true));
    assert_eq!(is_repeated(&field, &h, near(0.125)), Some(false));
    assert_eq!(is_repeated(&field, &f, near(0.5)), Some(false));
}

#[test]
fn large_blocks_are_not_decided() {
    let scheme: Scheme<Exact> = tension(5, 10, 1.0).unwrap();
    assert!(block_polynomial(&Field::new(5), scheme.limit(), 4, 1).is_none());
}
