//! Interval operations at the ends of the range of doubles, against exact integers.
//!
//! Claim: every operation holds every result on members of its operands, and is exact or leaves one double to
//! each side on points. Oracle: doubles as multiples of `2^-1074`, in big integers, for products `2^-2148`.
//! Angles and cosines are held against fixed-point series of 400 binary digits.

use super::Interval;
use super::oracle::{Operands, UNIT, between, units};
use eigenring_spline::Scalar;
use num_bigint::{BigInt, Sign};

const COUNT: usize = 100_000;

/// Where a double stands in the order of doubles.
fn ordinal(x: f64) -> i64 {
    let bits = x.abs().to_bits() as i64;
    if x < 0.0 { -bits } else { bits }
}

/// Doubles from one bound to the other.
fn steps(interval: Interval) -> i64 {
    ordinal(interval.hi()) - ordinal(interval.lo())
}

/// No bound is a negative zero, so that equal bounds have equal bits.
fn is_proper(interval: Interval) -> bool {
    let (lo, hi) = (interval.lo(), interval.hi());
    lo <= hi && [lo, hi].iter().all(|bound| bound.to_bits() != (-0.0_f64).to_bits())
}

/// Whether a result on points is exact or between neighbours. Where a residual may underflow it is only known
/// to lie between the two neighbours of the rounded result.
fn is_sharp(interval: Interval, exact: &BigInt, more: u32) -> bool {
    let small = exact.bits() < u64::from(UNIT + more) - 960;
    if interval.is_point() {
        return units(interval.lo()) << more == *exact;
    }
    steps(interval) <= if small { 2 } else { 1 }
}

#[test]
fn sums_hold_the_exact_ones() {
    let mut operands = Operands::new(1);
    for _ in 0..COUNT {
        let x = operands.double();
        let y = operands.partner(x);
        let exact = units(x) + units(y);
        let sum = Interval::point(x) + Interval::point(y);
        assert!(between(sum, &exact, 0) && is_proper(sum), "{x:e} + {y:e} = {sum:?}");
        // where the rounding of the two-sum overflows both neighbours are kept
        let overflows = x.abs().max(y.abs()) > f64::MAX / 4.0;
        let sharp = sum.is_point() == (units((x + y).clamp(f64::MIN, f64::MAX)) == exact);
        assert!(overflows || sharp && steps(sum) <= 1, "{x:e} + {y:e} = {sum:?}");
        let difference = Interval::point(x) - Interval::point(y);
        assert!(between(difference, &(units(x) - units(y)), 0) && is_proper(difference));
        let around = Interval::around(x, y);
        for end in [units(x) - units(y), units(x) + units(y)] {
            assert!(
                between(around, &end, 0) && is_proper(around),
                "{x:e} +- {y:e}: {around:?}"
            );
        }
    }
}

#[test]
fn products_and_quotients_hold_the_exact_ones() {
    let mut operands = Operands::new(2);
    for _ in 0..COUNT {
        let x = operands.double();
        let y = operands.partner(x);
        let exact = units(x) * units(y);
        let product = Interval::point(x) * Interval::point(y);
        assert!(
            between(product, &exact, UNIT) && is_proper(product),
            "{x:e} * {y:e} = {product:?}"
        );
        assert!(is_sharp(product, &exact, UNIT), "{x:e} * {y:e} = {product:?}");
        let quotient = Interval::point(x) / Interval::point(y);
        if y == 0.0 {
            assert_eq!(quotient, Interval::ENTIRE);
            continue;
        }
        assert!(
            is_proper(quotient) && quotient_holds(quotient, x, y),
            "{x:e} / {y:e} = {quotient:?}"
        );
        let is_large = quotient.mig() > 2f64.powi(-900) && x.abs() > 2f64.powi(-900);
        assert!(
            steps(quotient) <= if is_large { 1 } else { 2 },
            "{x:e} / {y:e} = {quotient:?}"
        );
        // one changes nothing, however small the other is
        let (one, of) = (Interval::point(1.0), Interval::point(x));
        assert!(
            one * of == of && of * -one == -of && of / one == of && of / -one == -of,
            "{x:e}"
        );
    }
}

fn quotient_holds(quotient: Interval, x: f64, y: f64) -> bool {
    let (numerator, denominator) = ((units(x) * y.signum() as i64) << UNIT, units(y.abs()));
    let below = quotient.lo() == f64::NEG_INFINITY || units(quotient.lo()) * &denominator <= numerator;
    below && (quotient.hi() == f64::INFINITY || numerator <= units(quotient.hi()) * &denominator)
}

#[test]
fn roots_and_powers_hold_the_exact_ones() {
    let mut operands = Operands::new(3);
    for _ in 0..COUNT {
        let x = operands.double();
        let square = Interval::point(x).square();
        let exact = units(x) * units(x);
        assert!(between(square, &exact, UNIT) && square.lo() >= 0.0, "{x:e}: {square:?}");
        assert_eq!(square, Interval::point(x).powi(2));
        let root = Interval::point(x.abs()).sqrt();
        let shifted = units(x.abs()) << UNIT;
        let [low, high] = [root.lo(), root.hi()].map(|end| units(end) * units(end));
        assert!(low <= shifted && shifted <= high && root.lo() >= 0.0, "{x:e}: {root:?}");
        assert!(!root.is_point() || low == shifted);
        // a root of a small number may be rounded to either side, a residual above them says to which
        assert!(
            steps(root) <= if x.abs() < 2f64.powi(-900) { 2 } else { 1 },
            "{x:e}: {root:?}"
        );
    }
    for _ in 0..COUNT / 20 {
        let of = operands.double();
        let (a, members) = operands.interval(of);
        for x in members {
            let mut power = BigInt::from(1);
            for exponent in 0..6 {
                let found = a.powi(exponent);
                // x^n in units of 2^(-1074 n); bounds in units of 2^-1074
                let more = UNIT * exponent.max(1) - UNIT;
                let scaled = if exponent == 0 { &power << UNIT } else { power.clone() };
                assert!(
                    between(found, &scaled, more) && is_proper(found),
                    "{a:?}^{exponent}: {found:?}"
                );
                power *= units(x);
            }
        }
    }
}

#[test]
fn operations_on_intervals_hold_those_on_members() {
    let mut operands = Operands::new(4);
    for _ in 0..COUNT / 4 {
        let of = operands.double();
        let (a, xs) = operands.interval(of);
        let of = operands.partner(of);
        let (b, ys) = operands.interval(of);
        let results = [a + b, a - b, a * b, a / b, a.hull(b), a.min(b), a.max(b)];
        assert!(results.into_iter().all(is_proper), "{a:?} {b:?} {results:?}");
        for &x in &xs {
            let ux = units(x);
            assert!(a.contains(x) && between(-a, &-ux.clone(), 0) && between(a.abs(), &units(x.abs()), 0));
            assert!(between(a.square(), &(&ux * &ux), UNIT) && a.square().lo() >= 0.0);
            assert!(a.mig() <= x.abs() && x.abs() <= a.mag());
            if a.lo() >= 0.0 {
                let (root, shifted) = (a.sqrt(), &ux << UNIT);
                let low = units(root.lo());
                assert!(&low * &low <= shifted);
                assert!(root.hi() == f64::INFINITY || shifted <= units(root.hi()) * units(root.hi()));
            } else {
                assert_eq!(a.sqrt(), Interval::ENTIRE);
            }
            for &y in &ys {
                let uy = units(y);
                assert!(between(a + b, &(&ux + &uy), 0) && between(a - b, &(&ux - &uy), 0));
                assert!(between(a * b, &(&ux * &uy), UNIT), "{a:?} * {b:?} = {:?}", a * b);
                assert!(y == 0.0 || quotient_holds(a / b, x, y), "{a:?} / {b:?} = {:?}", a / b);
                assert!(a.hull(b).contains(x) && a.hull(b).contains(y));
                assert!(a.min(b).contains(x.min(y)) && a.max(b).contains(x.max(y)));
                // what is certain holds for every pair
                assert!(!a.certainly_lt(b) || x < y);
                assert!(!a.certainly_le(b) || x <= y);
                assert!(!a.certainly_gt(b) || x > y);
                assert!(!a.disjoint(b) || x != y);
                assert!(x != y || a.intersect(b).is_some());
            }
            assert!(!a.encloses(b) || ys.iter().all(|&y| a.contains(y)));
            assert!(!a.certainly_positive() || x > 0.0);
            assert!(!a.certainly_negative() || x < 0.0);
            assert!(!a.certainly_nonzero() || x != 0.0);
            let sign = if x == 0.0 { 0 } else { x.signum() as i8 };
            assert!(a.sign().is_none_or(|known| known == sign));
            // middle, radius, width, halves
            let (mid, radius) = (a.mid(), a.radius());
            assert!(mid.is_finite() && a.contains(mid));
            assert!(radius == f64::INFINITY || (&ux - units(mid)).magnitude() <= units(radius).magnitude());
            assert!(a.split().iter().any(|half| half.contains(x)) && a.split().into_iter().all(is_proper));
            if a.is_bounded() && a.width().is_finite() {
                assert!(units(a.hi()) - units(a.lo()) <= units(a.width()));
            }
        }
        if let Some(common) = a.intersect(b) {
            assert!(is_proper(common) && a.encloses(common) && b.encloses(common));
        }
        // the interior: no bound is shared but an infinite one, of which the inner interval falls short
        if a.encloses_strictly(b) {
            assert!(a.encloses(b) && (a.lo() < b.lo()) && (b.hi() < a.hi()));
        }
        let text = serde_json::to_string(&a).expect("numbers");
        assert_eq!(serde_json::from_str::<Interval>(&text).expect("as written"), a);
    }
}

#[test]
fn what_is_compared_with_infinite_bounds_is_not_certain() {
    let (up, down) = (
        Interval::new(f64::MAX, f64::INFINITY).expect("in order"),
        Interval::new(f64::NEG_INFINITY, f64::MIN).expect("in order"),
    );
    for (a, b) in [(up, up), (down, down), (up, Interval::ENTIRE), (Interval::ENTIRE, down)] {
        assert!(!a.certainly_lt(b) && !b.certainly_lt(a) && !a.disjoint(b) && !a.encloses_strictly(a));
    }
    assert!(!up.certainly_le(up) && down.certainly_lt(up) && up.certainly_gt(down));
    assert!(Interval::ENTIRE.encloses_strictly(Interval::unit()) && !Interval::ENTIRE.encloses_strictly(up));
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Interval::point(value), Interval::ENTIRE);
        assert_eq!(Interval::around(1.0, value), Interval::ENTIRE);
        assert_eq!(Interval::around(value, 1.0), Interval::ENTIRE);
        assert!(!Interval::ENTIRE.contains(f64::NAN));
    }
}

/// Decimals beside doubles and beside the middles between doubles, where the last digit decides the rounding.
#[test]
fn decimals_hold_what_is_written() {
    let mut operands = Operands::new(5);
    for round in 0..4000 {
        let x = operands.double().abs();
        // twice the double, or the odd number between two neighbours, in half units of 2^-1075
        let between_two = operands.below(2) == 1 && x < f64::MAX;
        let mut halves: BigInt = units(x) * 2;
        if between_two {
            halves = units(x) + units(x.next_up());
        }
        // h 2^-1075 = h 5^1075 10^-1075
        let mut digits = halves * BigInt::from(5).pow(1075);
        // one unit of a further digit to either side, or none
        digits = digits * 1000 + [-1, 0, 1][round % 3];
        let negative = operands.below(2) == 1;
        let sign = if digits.sign() == Sign::Minus || !negative {
            ""
        } else {
            "-"
        };
        let text = format!("{sign}{digits}e-1078");
        let parsed = Interval::parse(&text).expect("a decimal");
        if negative && digits.sign() != Sign::Minus {
            digits = -digits;
        }
        // lo <= digits 10^-1078, in units of 2^-1074 5^-1078 2^-4
        let scaled = |bound: f64| (units(bound) << 4) * BigInt::from(5).pow(1078);
        let below = parsed.lo() == f64::NEG_INFINITY || scaled(parsed.lo()) <= digits;
        assert!(
            below && (parsed.hi() == f64::INFINITY || digits <= scaled(parsed.hi())),
            "{text}"
        );
        assert!(parsed.is_point() || steps(parsed) == 1, "{text} {parsed:?}");
        assert!(is_proper(parsed));
    }
}

/// Binary digits of the fixed-point numbers below.
const DIGITS: u32 = 400;

/// `atan(x)` for a fixed-point `0 <= x <= 1`, right within `2^-380`: four halvings of the angle by
/// `tan(a / 2) = tan a / (1 + sqrt(1 + tan^2 a))` and the series.
fn arc_tangent(x: &BigInt) -> BigInt {
    let one = BigInt::from(1) << DIGITS;
    let mut x = x.clone();
    for _ in 0..4 {
        let root = (&one * &one + &x * &x).sqrt();
        x = (&x << DIGITS) / (&one + root);
    }
    let square = (&x * &x) >> DIGITS;
    let (mut power, mut sum) = (x, BigInt::from(0));
    for j in 0..200_i64 {
        let term: BigInt = &power / (2 * j + 1);
        sum += if j % 2 == 0 { term } else { -term };
        power = (&power * &square) >> DIGITS;
    }
    sum << 4
}

/// A finite double of magnitude at least `2^-300` or zero, in fixed point, rounded down.
fn fixed(x: f64) -> BigInt {
    units(x) >> (UNIT - DIGITS)
}

/// Whether a fixed-point number that is right within `2^-370` may be in an interval.
fn meets(interval: Interval, value: &BigInt) -> bool {
    let slack = BigInt::from(1) << (DIGITS - 370);
    fixed(interval.lo()) <= value + &slack && value - &slack <= fixed(interval.hi())
}

#[test]
fn angles_hold_those_of_a_series() {
    let mut operands = Operands::new(6);
    let quarter: BigInt = arc_tangent(&(BigInt::from(1) << DIGITS));
    for _ in 0..500 {
        let (x, y) = (operands.double(), operands.double());
        if x == 0.0 && y == 0.0 {
            continue;
        }
        // the angle of (|x|, |y|) in the first octant, then the reflections
        let (small, large) = if x.abs() < y.abs() { (x, y) } else { (y, x) };
        let ratio = (units(small.abs()) << DIGITS) / units(large.abs());
        let mut angle = arc_tangent(&ratio);
        if x.abs() < y.abs() {
            angle = 2 * &quarter - angle;
        }
        if x < 0.0 {
            angle = 4 * &quarter - angle;
        }
        if y < 0.0 {
            angle = -angle;
        }
        let found = Interval::argument(Interval::point(x), Interval::point(y));
        assert!(meets(found, &angle), "({x:e}, {y:e}): {found:?}");
        assert!(
            found.width() < 4e-15 || x < 0.0 && y == 0.0,
            "({x:e}, {y:e}): {found:?}"
        );
        if y != 0.0 && x > 0.0 {
            let tangent = Interval::point(y) / Interval::point(x);
            assert!(meets(tangent.atan(), &angle), "({x:e}, {y:e}): {tangent:?}");
        }
    }
}

/// Turns of any 64-bit integers: `cos^2 + sin^2 = 1`, the addition to a whole turn, and the arc tangent.
#[test]
fn turns_of_large_integers_are_enclosed() {
    let mut operands = Operands::new(7);
    let full: BigInt = 8 * arc_tangent(&(BigInt::from(1) << DIGITS));
    for round in 0..2000 {
        let shift = operands.below(60);
        let n = (operands.bits() >> shift) as i64;
        let k = match round % 4 {
            // beside a multiple of a quarter turn
            0 => n / 4 + operands.below(3) as i64 - 1,
            _ => operands.bits() as i64,
        };
        if n == 0 {
            assert_eq!(Interval::cos_turn(k, n), Interval::ENTIRE);
            continue;
        }
        let (cos, sin) = (Interval::cos_turn(k, n), Interval::sin_turn(k, n));
        assert!((cos.square() + sin.square()).contains(1.0), "{k}/{n}: {cos:?} {sin:?}");
        assert!(cos.mag() <= 1.0 && sin.mag() <= 1.0);
        // the angle of (cos, sin) is 2 pi k / n up to whole turns; arguments of axes are not sharp
        let turn = (BigInt::from(k) * n.signum()) % n.unsigned_abs();
        let angle: BigInt = &full * turn / n.unsigned_abs();
        let found = Interval::argument(cos, sin);
        let holds = [-1, 0, 1].iter().any(|&more| meets(found, &(&angle + more * &full)));
        assert!(holds, "{k}/{n}: {cos:?} {sin:?} {found:?}");
    }
}
