//! Intervals against exact rational arithmetic.

use super::Interval;
use eigenring_spline::{Dual, Scalar};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;

fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).expect("finite in these tests")
}

/// Whether the exact number lies between the bounds.
fn holds(interval: Interval, exact: &BigRational) -> bool {
    let below = interval.lo == f64::NEG_INFINITY || rational(interval.lo) <= *exact;
    below && (interval.hi == f64::INFINITY || *exact <= rational(interval.hi))
}

/// Whether no narrower interval of doubles holds the exact number: a point or two adjacent doubles, as it
/// should be.
fn is_tight(interval: Interval, exact: &BigRational) -> bool {
    let representable = interval.is_point() && rational(interval.lo) == *exact;
    let adjacent =
        interval.lo.next_up() == interval.hi && rational(interval.lo) < *exact && *exact < rational(interval.hi);
    representable || adjacent
}

/// Doubles of every kind a formula meets: zeros, small integers, simple fractions, moderate and extreme
/// sizes.
fn double() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        (-8..8_i32).prop_map(f64::from),
        (-64..64_i32).prop_map(|k| f64::from(k) / 16.0),
        -10.0..10.0_f64,
        (-1.0..1.0_f64, -320..307_i32).prop_map(|(m, e)| m * 10f64.powi(e)),
    ]
}

/// An interval and a member.
fn member() -> impl Strategy<Value = (Interval, f64)> {
    (double(), double(), 0.0..=1.0_f64).prop_map(|(a, b, t)| {
        let (lo, hi) = if a <= b { (a, b) } else { (b, a) };
        let inside = (lo * (1.0 - t) + hi * t).clamp(lo, hi);
        (Interval::new(lo, hi).expect("in order"), inside)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn operations_on_members_stay_inside((a, x) in member(), (b, y) in member()) {
        let (rx, ry) = (rational(x), rational(y));
        prop_assert!(holds(a + b, &(&rx + &ry)));
        prop_assert!(holds(a - b, &(&rx - &ry)));
        prop_assert!(holds(a * b, &(&rx * &ry)));
        prop_assert!(holds(-a, &-rx.clone()));
        prop_assert!(holds(a.abs(), &rx.abs()));
        prop_assert!(holds(a.square(), &(&rx * &rx)));
        prop_assert!(a.square().lo() >= 0.0);
        prop_assert!(holds(a.hull(b), &rx) && holds(a.hull(b), &ry));
        prop_assert!(holds(a.min(b), (&rx).min(&ry)) && holds(a.max(b), (&rx).max(&ry)));
        let quotient = a / b;
        if b.contains_zero() {
            prop_assert_eq!(quotient, Interval::ENTIRE);
        } else {
            prop_assert!(holds(quotient, &(&rx / &ry)));
        }
        let mut cube = BigRational::one();
        for exponent in 0..5 {
            prop_assert!(holds(a.powi(exponent), &cube));
            cube *= &rx;
        }
    }

    #[test]
    fn operations_on_points_are_exact_or_adjacent(x in -1e3..1e3_f64, y in -1e3..1e3_f64, p in -60..60_i32, q in 1..60_i32) {
        for (x, y) in [(x, y), (f64::from(p) / 8.0, f64::from(q)), (x, f64::from(p) / 4.0)] {
            let (a, b) = (Interval::point(x), Interval::point(y));
            let (rx, ry) = (rational(x), rational(y));
            prop_assert!(is_tight(a + b, &(&rx + &ry)));
            prop_assert!(is_tight(a - b, &(&rx - &ry)));
            if (x * y).abs() > 1e-200 {
                prop_assert!(is_tight(a * b, &(&rx * &ry)));
                prop_assert!(is_tight(a / b, &(&rx / &ry)));
            }
        }
    }

    #[test]
    fn roots_are_tight(x in double()) {
        let root = Interval::point(x).sqrt();
        if x < 0.0 {
            prop_assert_eq!(root, Interval::ENTIRE);
        } else {
            let (low, high) = (rational(root.lo()), rational(root.hi()));
            prop_assert!(&low * &low <= rational(x) && rational(x) <= &high * &high);
            prop_assert!(root.is_point() || root.lo().next_up().next_up() >= root.hi());
        }
        prop_assert!(Interval::point(x).square().sqrt().contains(x.abs()) || x.abs() > 1e150);
    }

    #[test]
    fn halves_cover((a, x) in member()) {
        let [left, right] = a.split();
        prop_assert!(left.contains(x) || right.contains(x));
        prop_assert!(a.encloses(left) && a.encloses(right) && a.contains(a.mid()));
        prop_assert!(rational(a.radius()) >= (rational(x) - rational(a.mid())).abs() || a.radius().is_infinite());
    }

    #[test]
    fn ratios_are_tight(p in any::<i32>(), q in any::<i32>(), large in any::<i64>()) {
        prop_assume!(q != 0);
        let exact = BigRational::new(p.into(), q.into());
        prop_assert!(is_tight(Interval::ratio(p.into(), q.into()), &exact));
        prop_assert!(is_tight(Interval::integer(large), &BigRational::from(BigInt::from(large))));
        prop_assert!(holds(Interval::ratio(large, 7), &BigRational::new(large.into(), 7.into())));
    }

    #[test]
    fn decimals_are_tight(digits in any::<i64>(), exponent in -30..30_i32, x in double()) {
        let ten = BigRational::from(BigInt::from(10));
        let exact = BigRational::from(BigInt::from(digits)) * num_traits::pow::Pow::pow(&ten, exponent);
        let parsed = Interval::parse(&format!("{digits}e{exponent}")).expect("a decimal");
        prop_assert!(is_tight(parsed, &exact), "{parsed:?}");
        // a double written with all the digits it needs is not always its own decimal, but with every digit
        // it is
        prop_assert_eq!(Interval::parse(&format!("{x:.800e}")), Some(Interval::point(x)));
    }

    #[test]
    fn what_is_stored_reads_back((a, _) in member()) {
        let text = serde_json::to_string(&a).expect("numbers");
        prop_assert_eq!(serde_json::from_str::<Interval>(&text).expect("as written"), a);
    }
}

/// `cos(2 pi k / n)` between two rationals: pi by Machin's formula, the cosine by its series, both with their
/// remainders.
fn cosine(k: i64, n: i64) -> (BigRational, BigRational) {
    // everything to 60 decimals; each rounding is accounted for by the margin of 1e-50
    let unit = BigInt::from(10).pow(60);
    let arctan = |q: i64| {
        let (mut power, mut sum, mut j) = (&unit / q, BigInt::zero(), 0);
        while !power.is_zero() {
            let term: BigInt = &power / (2 * j + 1);
            sum += if j % 2 == 0 { term } else { -term };
            power /= q * q;
            j += 1;
        }
        sum
    };
    let pi: BigInt = 4 * (4 * arctan(5) - arctan(239));
    let x: BigInt = pi * 2 * k.rem_euclid(n) / n;
    let (mut term, mut sum, mut j) = (unit.clone(), BigInt::zero(), 0);
    while !term.is_zero() {
        sum += &term;
        term = -(&term * &x / &unit * &x / &unit) / ((2 * j + 1) * (2 * j + 2));
        j += 1;
    }
    let margin = BigInt::from(10).pow(10);
    let rational = |numerator: BigInt| BigRational::new(numerator, unit.clone());
    (rational(&sum - &margin), rational(&sum + &margin))
}

#[test]
fn cosines_of_turns_are_enclosed_within_two_ulps() {
    for n in (1..=70).chain([1000, 65_537]) {
        for k in [-n - 1, -1].into_iter().chain(0..=n.min(70)) {
            let enclosure = Interval::cos_turn(k, n);
            let (below, above) = cosine(k, n);
            assert!(
                holds(enclosure, &below) || holds(enclosure, &above) || enclosure.is_point(),
                "{k}/{n}"
            );
            assert!(
                rational(enclosure.lo()) <= above && below <= rational(enclosure.hi()),
                "{k}/{n}"
            );
            assert!(
                enclosure.lo().next_up().next_up() >= enclosure.hi(),
                "{k}/{n}: {enclosure:?}"
            );
            assert!((enclosure.mid() - f64::cos_turn(k, n)).abs() < 4e-16);
            assert!((Interval::sin_turn(k, n).mid() - f64::sin_turn(k, n)).abs() < 4e-16);
            assert_eq!(Interval::cos_turn(-k, n), enclosure);
        }
    }
}

#[test]
fn rational_cosines_are_points() {
    for m in [1, 2, 5, 1 << 50] {
        let point = Interval::point;
        assert_eq!(Interval::cos_turn(0, m), point(1.0));
        assert_eq!(Interval::cos_turn(m, 2 * m), point(-1.0));
        assert_eq!(Interval::cos_turn(m, 4 * m), point(0.0));
        assert_eq!(Interval::cos_turn(m, 6 * m), point(0.5));
        assert_eq!(Interval::cos_turn(m, 3 * m), point(-0.5));
        assert_eq!(Interval::sin_turn(m, 4 * m), point(1.0));
        assert_eq!(
            Interval::sin_turn(m, 12 * m.min(1 << 40)),
            Interval::sin_turn(m, 12 * m.min(1 << 40))
        );
        assert_eq!(Interval::sin_turn(-m, 2 * m), point(0.0));
    }
    assert_eq!(Interval::cos_turn(1, 0), Interval::ENTIRE);
}

#[test]
fn exact_structure_survives() {
    let (zero, third) = (Interval::point(0.0), Interval::ratio(1, 3));
    assert!((zero * third).is_zero() && (zero * Interval::ENTIRE).is_zero());
    assert_eq!(Interval::point(1.0) * third, third);
    assert_eq!(third + zero, third);
    assert!((Interval::ratio(3, 8) - Interval::ratio(6, 16)).is_zero());
    assert_eq!(Interval::ratio(9, 16).sqrt(), Interval::ratio(3, 4));
    assert!((zero / third).is_zero());
    assert_eq!(third.width(), third.hi() - third.lo());
}

#[test]
fn what_is_unknown_is_the_whole_line() {
    let entire = Interval::ENTIRE;
    let one = Interval::point(1.0);
    for unknown in [
        one / Interval::point(0.0),
        one / Interval::unit(),
        Interval::point(f64::NAN),
        Interval::point(f64::INFINITY),
        entire + entire,
        entire - entire,
        entire * entire,
        entire / Interval::new(1.0, 2.0).expect("in order"),
        Interval::ratio(1, 0),
        Interval::unit().sqrt(),
    ] {
        assert_eq!(unknown, entire);
    }
    assert_eq!(Interval::new(f64::NAN, 1.0), None);
    assert_eq!(Interval::new(2.0, 1.0), None);
    assert_eq!(Interval::new(f64::INFINITY, f64::INFINITY), None);
    let huge = Interval::point(f64::MAX);
    assert_eq!((huge + huge).lo(), f64::MAX);
    assert_eq!((huge * huge).hi(), f64::INFINITY);
    assert_eq!((huge * huge - huge * huge).mid(), 0.0);
    assert_eq!(entire.sign(), None);
    assert!(entire.mid() == 0.0 && !entire.is_bounded() && entire.radius() == f64::INFINITY);
    for text in ["", "nan", "inf", "1e", ".", "1.2.3", "0x1", "--1", "1e99999999999"] {
        assert_eq!(Interval::parse(text), None, "{text}");
    }
    assert_eq!(Interval::parse("0.5"), Some(Interval::ratio(1, 2)));
    assert_eq!(Interval::parse(" -0.1 "), Some(-Interval::ratio(1, 10)));
    assert_eq!(Interval::parse("1e-400").map(Interval::lo), Some(0.0));
    assert_eq!(Interval::parse("-1e400").map(Interval::hi), Some(f64::MIN));
    assert!(serde_json::from_str::<Interval>("[1.0, 0.0]").is_err());
    assert_eq!(serde_json::from_str::<Interval>("[null, null]").ok(), Some(entire));
}

#[test]
fn formulas_over_duals_of_intervals_hold_their_derivatives() {
    let x = Interval::new(0.5, 0.5625).expect("in order");
    let dual = Dual::<Interval>::variable(x, 0);
    let f = (dual * dual + Dual::ratio(1, 3)).sqrt() / dual;
    for t in [0.5, 0.53125, 0.5625_f64] {
        let root = (t * t + 1.0 / 3.0).sqrt();
        assert!(f.value.contains(root / t));
        assert!(f.parts[0].contains(1.0 / root - root / (t * t)));
    }
}

proptest! {
    #[test]
    fn arguments_are_enclosed(x in -3.0..3.0_f64, y in -3.0..3.0_f64, radius in 0.0..0.1_f64, s in -1.0..1.0_f64, t in -1.0..1.0_f64) {
        let (bx, by) = (Interval::around(x, radius), Interval::around(y, radius));
        let inside = (y + t * radius).atan2(x + s * radius);
        // the library's atan2 is right within an ulp or so
        let found = Interval::argument(bx, by);
        prop_assert!(found.lo() - 1e-15 <= inside && inside <= found.hi() + 1e-15);
        let point = Interval::argument(Interval::point(x), Interval::point(y));
        prop_assert!(point.width() < 2e-15 || (y == 0.0 && x <= 0.0), "{point:?}");
        prop_assert!((point.mid() - y.atan2(x)).abs() < 2e-15);
    }
}

#[test]
fn arc_tangents_of_known_angles() {
    // tan(pi/8) = sqrt 2 - 1, tan(pi/12) = 2 - sqrt 3, and the addition theorem of Machin's formula
    let pi = Interval::pi();
    let over = |q: i64| pi / Interval::integer(q);
    let root = |q: i64| Interval::integer(q).sqrt();
    for (tangent, angle) in [
        (root(2) - Interval::point(1.0), over(8)),
        (Interval::point(2.0) - root(3), over(12)),
        (root(3), over(3)),
        (Interval::point(1.0), over(4)),
        (-root(3), -over(3)),
    ] {
        assert!(tangent.atan().intersect(angle).is_some());
        assert!(tangent.atan().width() < 2e-15);
    }
    let four = Interval::integer(4);
    let machin = four * (four * Interval::ratio(1, 5).atan() - Interval::ratio(1, 239).atan());
    assert!(machin.contains(std::f64::consts::PI) && machin.width() < 1e-14);
    assert_eq!(Interval::ENTIRE.atan().hi(), (pi / Interval::integer(2)).hi());
    assert_eq!(
        Interval::argument(Interval::point(-1.0), Interval::point(0.0)),
        pi * Interval::unit()
    );
}
