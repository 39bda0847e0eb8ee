//! Polynomials in Bernstein form over intervals hold the exact ones: what the proofs about maps rest on.

use crate::Interval;
use crate::interval::oracle::Operands;
use eigenring_spline::TensorPatch;
use eigenring_spline::bernstein::{Polynomial, Scaled, binomials};
use eigenring_spline::uniform::to_bernstein;
use num_rational::BigRational;
use proptest::prelude::*;

proptest! {
    #[test]
    fn patches_hold_their_values(d in 2..7_usize, seed in 0.1..3.0_f64, u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
        let control: Vec<f64> = (0..(d + 1).pow(2)).map(|i| (seed * (i as f64 + 1.7)).sin()).collect();
        let patch = TensorPatch { degree: d, control };
        let points: Vec<Interval> = patch.control.iter().map(|&c| Interval::point(c)).collect();
        let g = Polynomial::from_control(&points, &to_bernstein(d));
        let value = g.value(Interval::point(u), Interval::point(v));
        prop_assert!((value.mid() - patch.jet(u, v).value).abs() < 1e-13 && value.width() < 1e-12);
    }
}

fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).expect("finite")
}

/// The value of a Bernstein form in exact arithmetic, by its definition.
fn exact_value([m, n]: [usize; 2], coefficients: &[f64], [u, v]: [f64; 2]) -> BigRational {
    let basis = |degree: usize, t: f64| -> Vec<BigRational> {
        let (t, rest) = (rational(t), rational(1.0) - rational(t));
        let power = |x: &BigRational, e: usize| (0..e).fold(rational(1.0), |product, _| product * x);
        let binomials = binomials::<f64>(degree).into_iter().map(rational).enumerate();
        binomials
            .map(|(i, b)| b * power(&t, i) * power(&rest, degree - i))
            .collect()
    };
    let (in_u, in_v) = (basis(m, u), basis(n, v));
    let rows = coefficients.chunks(m + 1).zip(&in_v);
    rows.flat_map(|(row, b)| row.iter().zip(&in_u).map(move |(&c, a)| rational(c) * a * b))
        .sum()
}

fn holds(interval: Interval, exact: &BigRational) -> bool {
    let low = interval.lo() == f64::NEG_INFINITY || rational(interval.lo()) <= *exact;
    low && (interval.hi() == f64::INFINITY || *exact <= rational(interval.hi()))
}

/// What a proof of a sign rests on: on every part the values lie between the coefficients, those at its
/// corners are values, and raising the degree, products and derivatives are those of the function, at all
/// sizes of coefficients.
#[test]
fn coefficients_of_parts_bound_the_values_there() {
    let mut operands = Operands::new(21);
    for round in 0..300 {
        let degree = [1 + operands.below(4), 1 + operands.below(4)];
        let count = (degree[0] + 1) * (degree[1] + 1);
        let mut number = || match round % 3 {
            0 => operands.fraction() * operands.sign(),
            1 => f64::from_bits(operands.bits() >> (12 + operands.below(40))) * operands.sign(),
            _ => operands.double().clamp(-1e150, 1e150),
        };
        let members: Vec<f64> = (0..count).map(|_| number()).collect();
        let mut around = |x: f64| match operands.below(3) {
            0 => Interval::around(x, x.abs() * operands.fraction() * 1e-3),
            _ => Interval::point(x),
        };
        let f = Polynomial::from_fn(degree, |i, j| around(members[j * (degree[0] + 1) + i]));
        let raised = f.scaled().product(&Scaled::one([2, 3])).unscaled();
        let square = f.scaled().product(&f.scaled()).unscaled();
        for (which, part) in f.quarters().iter().enumerate() {
            let corner = [(which % 2) as f64 / 2.0, (which / 2) as f64 / 2.0];
            let hull = part
                .coefficients()
                .iter()
                .copied()
                .reduce(Interval::hull)
                .expect("some");
            for at in 0..6 {
                let t = match at {
                    0..4 => [(at % 2) as f64, (at / 2) as f64],
                    _ => [operands.below(17) as f64 / 16.0, operands.below(17) as f64 / 16.0],
                };
                let at_point = [corner[0] + t[0] / 2.0, corner[1] + t[1] / 2.0];
                let exact = exact_value(degree, &members, at_point);
                let [u, v] = t.map(Interval::point);
                assert!(
                    holds(hull, &exact) && holds(part.value(u, v), &exact),
                    "{f:?} {at_point:?}"
                );
                if at < 4 {
                    assert!(holds(part.corners()[at], &exact));
                }
                let [u, v] = at_point.map(Interval::point);
                assert!(
                    holds(f.value(u, v), &exact) && holds(raised.value(u, v), &exact),
                    "{f:?} {at_point:?}"
                );
                assert!(holds(square.value(u, v), &(&exact * &exact)), "{f:?} {at_point:?}");
            }
        }
        // differences of values of a polynomial that is linear in u are derivatives
        if degree[0] == 1 {
            let v = operands.below(9) as f64 / 8.0;
            let slope = exact_value(degree, &members, [1.0, v]) - exact_value(degree, &members, [0.0, v]);
            assert!(holds(f.by_u().value(Interval::point(0.5), Interval::point(v)), &slope));
        }
    }
}

#[test]
fn binomials_of_large_rows_are_enclosed() {
    // C(128, 64) = 23951146041928082866135587776380551750
    let middle = binomials::<Interval>(128)[64];
    let exact = Interval::parse("23951146041928082866135587776380551750").expect("a decimal");
    assert!(middle.encloses(exact) && middle.width() < 1e-12 * middle.mid());
}
