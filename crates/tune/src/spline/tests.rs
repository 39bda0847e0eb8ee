//! One function: planted truths and independent optima.

use super::*;
use eigenring_scheme::lambda::{LambdaKnots, PAPER_TABLE_1};
use eigenring_spline::{Knots, Spline};

pub(super) const KNOTS: LambdaKnots = LambdaKnots {
    a: 0.15,
    b: 0.25,
    c: 0.3536,
    d: 0.55,
    e: 0.9,
    singles: LambdaKnots::SINGLES,
};

/// The paper's 100 sample values.
pub(super) fn lambdas(knots: &LambdaKnots) -> Vec<f64> {
    let LambdaKnots { a, c, e, .. } = *knots;
    let first = (0..50).map(|i| a + i as f64 * (c - a) / 49.0);
    first
        .chain((1..=50).map(|i| e.min(c + i as f64 * (e - c) / 50.0)))
        .collect()
}

pub(super) fn grid(n: usize) -> Vec<f64> {
    (0..=n).map(|i| (0.15 + 0.75 * i as f64 / n as f64).min(0.9)).collect()
}

/// A fixed sequence in [0, 1): the low-order digits of a linear congruence.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn samples(values: impl Fn(f64) -> f64) -> Vec<Datum> {
    lambdas(&KNOTS)
        .into_iter()
        .map(|lambda| Datum {
            lambda,
            value: values(lambda),
            weight: 1.0,
        })
        .collect()
}

fn solve<'a>(
    knots: &'a Knots,
    samples: &'a [Datum],
    interpolate: &'a [(f64, f64)],
    bounds: &'a [Bound],
    smooth: &'a [f64],
) -> Result<Fit, FitError> {
    FitProblem {
        knots,
        samples,
        interpolate,
        bounds,
        smooth,
    }
    .solve()
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Gaussian elimination with column pivoting.
fn gauss(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (upper, lower) = a.split_at_mut(k + 1);
        let pivot = &upper[k];
        for (i, row) in lower.iter_mut().enumerate() {
            let t = row[k] / pivot[k];
            row.iter_mut().zip(pivot).for_each(|(x, p)| *x -= t * p);
            b[k + 1 + i] -= t * b[k];
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            b[k] -= a[k][j] * b[j];
        }
        b[k] /= a[k][k];
    }
    b
}

fn dense_basis(knots: &Knots, lambda: f64) -> Vec<f64> {
    let basis = knots.basis(knots.span(lambda).unwrap(), lambda);
    let mut row = vec![0.0; knots.dimension()];
    row[basis.first..][..basis.values.len()].copy_from_slice(&basis.values);
    row
}

fn objective(knots: &Knots, samples: &[Datum], coefficients: &[f64]) -> f64 {
    let spline = Spline::new(knots.clone(), coefficients.to_vec()).unwrap();
    samples
        .iter()
        .map(|s| s.weight * (spline.value(s.lambda).unwrap() - s.value).powi(2))
        .sum()
}

#[test]
fn a_planted_spline_is_recovered() {
    for row in PAPER_TABLE_1 {
        let knots = row.knots();
        let space = knots.knots().unwrap();
        let mut random = noise(row.valence as u64);
        let truth = Spline::new(space.clone(), (0..17).map(|_| random()).collect()).unwrap();
        let samples: Vec<Datum> = lambdas(&knots)
            .into_iter()
            .map(|lambda| Datum {
                lambda,
                value: truth.value(lambda).unwrap(),
                weight: 0.5 + random(),
            })
            .collect();
        let interpolate = [(row.lambda_c_star, truth.value(row.lambda_c_star).unwrap())];
        let fit = solve(&space, &samples, &interpolate, &[], &[]).unwrap();
        let error = difference(fit.spline.coefficients(), truth.coefficients());
        assert!(error < 1e-10, "N = {}: {error:e}", row.valence);
        assert_eq!(fit.energy, 0.0);
        assert!(fit.kkt.worst() < 1e-14 && fit.max_residual < 1e-13);
    }
}

#[test]
fn without_active_bounds_it_is_the_normal_equations() {
    let space = KNOTS.knots().unwrap();
    let mut random = noise(7);
    let mut samples = samples(|lambda| (9.0 * lambda).sin() + lambda);
    samples.iter_mut().for_each(|s| {
        s.value += 0.01 * random();
        s.weight = 0.2 + random();
    });
    let interpolate = [(0.6, 0.4), (0.2, 1.2)];
    let loose: Vec<Bound> = grid(100)
        .into_iter()
        .map(|lambda| Bound {
            lambda,
            lower: -2.0,
            upper: 4.0,
        })
        .collect();
    let fit = solve(&space, &samples, &interpolate, &loose, &[]).unwrap();
    // the saddle-point system of the equality-constrained problem
    let n = space.dimension();
    let mut matrix = vec![vec![0.0; n + 2]; n + 2];
    let mut right = vec![0.0; n + 2];
    for s in &samples {
        let basis = dense_basis(&space, s.lambda);
        for i in 0..n {
            right[i] += s.weight * basis[i] * s.value;
            for j in 0..n {
                matrix[i][j] += s.weight * basis[i] * basis[j];
            }
        }
    }
    for (k, (lambda, value)) in interpolate.into_iter().enumerate() {
        for (i, b) in dense_basis(&space, lambda).into_iter().enumerate() {
            matrix[i][n + k] = b;
            matrix[n + k][i] = b;
        }
        right[n + k] = value;
    }
    let expected = gauss(matrix, right);
    let error = difference(fit.spline.coefficients(), &expected[..n]);
    assert!(error < 1e-12, "{error:e}");
    assert!(fit.active.is_empty() && fit.kkt.worst() < 1e-14, "{:?}", fit.kkt);
    for (lambda, value) in interpolate {
        assert!((fit.spline.value(lambda).unwrap() - value).abs() < 1e-14);
    }
    assert!((fit.objective - objective(&space, &samples, fit.spline.coefficients())).abs() < 1e-14);
}

/// A curve that must be bent: bounds cut its crests and a stretch of it.
fn bent() -> (Knots, Vec<Datum>, Vec<Bound>) {
    let bounds = grid(2000)
        .into_iter()
        .map(|lambda| Bound {
            lambda,
            lower: 0.1 - 0.3 * (lambda - 0.5).max(0.0),
            upper: if lambda < 0.7 { 0.8 } else { f64::INFINITY },
        })
        .collect();
    (
        KNOTS.knots().unwrap(),
        samples(|lambda| 0.5 + 0.5 * (14.0 * lambda).sin()),
        bounds,
    )
}

#[test]
fn the_constrained_optimum_cannot_be_improved() {
    let (space, samples, bounds) = bent();
    let interpolate = [(0.4, 0.3)];
    let fit = solve(&space, &samples, &interpolate, &bounds, &[KNOTS.b]).unwrap();
    assert!(fit.active.len() >= 4, "{:?}", fit.active);
    assert!(fit.kkt.worst() < 1e-13, "{:?}", fit.kkt);
    assert!(fit.active.iter().all(|active| active.multiplier > 0.0));
    for b in &bounds {
        let value = fit.spline.value(b.lambda).unwrap();
        assert!(value >= b.lower - 1e-14 && value <= b.upper + 1e-14);
    }
    for active in &fit.active {
        let b = bounds.iter().find(|b| b.lambda == active.lambda).unwrap();
        let bound = if active.side == Side::Lower { b.lower } else { b.upper };
        assert!((fit.spline.value(active.lambda).unwrap() - bound).abs() < 1e-14);
    }

    // random moves, made feasible by shrinking: equalities by projection, bounds by the longest feasible step
    let row = dense_basis(&space, 0.4);
    let basis_at = |span| space.basis(span, KNOTS.b);
    let (left, right) = (
        basis_at(space.span_before(KNOTS.b).unwrap()),
        basis_at(space.span(KNOTS.b).unwrap()),
    );
    let jump = |l: &[f64], r: &[f64]| {
        let mut row = vec![0.0; 17];
        l.iter().enumerate().for_each(|(k, v)| row[left.first + k] -= v);
        r.iter().enumerate().for_each(|(k, v)| row[right.first + k] += v);
        row
    };
    let mut equalities: Vec<Vec<f64>> = Vec::new();
    for mut row in [
        row,
        jump(&left.first_derivatives, &right.first_derivatives),
        jump(&left.second_derivatives, &right.second_derivatives),
    ] {
        for _ in 0..2 {
            for q in &equalities {
                let t: f64 = q.iter().zip(&row).map(|(a, b)| a * b).sum();
                row.iter_mut().zip(q).for_each(|(r, q)| *r -= t * q);
            }
        }
        let norm = row.iter().map(|v| v * v).sum::<f64>().sqrt();
        equalities.push(row.into_iter().map(|v| v / norm).collect());
    }
    let best = objective(&space, &samples, fit.spline.coefficients());
    let mut random = noise(3);
    let mut moved = 0;
    for _ in 0..1000 {
        let mut step: Vec<f64> = (0..17).map(|_| 2.0 * random() - 1.0).collect();
        for q in &equalities {
            let t: f64 = q.iter().zip(&step).map(|(a, b)| a * b).sum();
            step.iter_mut().zip(q).for_each(|(s, q)| *s -= t * q);
        }
        let direction = Spline::new(space.clone(), step.clone()).unwrap();
        let mut length: f64 = 0.1;
        for b in &bounds {
            let (value, slope) = (fit.spline.value(b.lambda).unwrap(), direction.value(b.lambda).unwrap());
            if slope < 0.0 {
                length = length.min((b.lower - value) / slope);
            } else if slope > 0.0 {
                length = length.min((b.upper - value) / slope);
            }
        }
        if length > 1e-9 {
            moved += 1;
            let coefficients: Vec<f64> = fit
                .spline
                .coefficients()
                .iter()
                .zip(&step)
                .map(|(c, s)| c + length * s)
                .collect();
            assert!(objective(&space, &samples, &coefficients) >= best - 1e-15);
        }
    }
    assert!(moved > 5, "only {moved} feasible moves");
}

#[test]
fn the_interior_point_solution_is_the_same() {
    let (space, samples, bounds) = bent();
    let fit = solve(&space, &samples, &[(0.4, 0.3)], &bounds, &[]).unwrap();
    assert!(
        fit.interior_iterations > 0 && fit.interior_difference < 1e-5,
        "{}",
        fit.interior_difference
    );
}

#[test]
fn a_spline_on_its_bound_over_an_interval() {
    // max(lambda - 0.55, 0) with a kink knot there is in the space: bounds carry it on all of [0.15, 0.55]
    let space = KNOTS.knots().unwrap();
    let samples = samples(|lambda| (lambda - 0.55).max(0.0) - if lambda < 0.5 { 0.01 } else { 0.0 });
    let bounds: Vec<Bound> = grid(2000)
        .into_iter()
        .map(|lambda| Bound {
            lambda,
            lower: 0.0,
            upper: f64::INFINITY,
        })
        .collect();
    let fit = solve(&space, &samples, &[(0.6, 0.05)], &bounds, &[]).unwrap();
    assert!(fit.kkt.worst() < 1e-13, "{:?}", fit.kkt);
    for lambda in grid(500).into_iter().filter(|&lambda| lambda < 0.3536) {
        assert!(fit.spline.value(lambda).unwrap().abs() < 1e-14);
    }
}

#[test]
fn smooth_knots_are_twice_differentiable() {
    let (space, samples, bounds) = bent();
    let fit = solve(&space, &samples, &[(0.5, 0.5)], &bounds, &[KNOTS.b, KNOTS.d]).unwrap();
    let jumps = |lambda: f64| {
        let c = fit.spline.coefficients();
        let [left, right] =
            [space.span_before(lambda), space.span(lambda)].map(|span| space.basis(span.unwrap(), lambda));
        let first = left.combine(&left.first_derivatives, c) - right.combine(&right.first_derivatives, c);
        let second = left.combine(&left.second_derivatives, c) - right.combine(&right.second_derivatives, c);
        (first.abs(), second.abs())
    };
    for lambda in [KNOTS.b, KNOTS.d] {
        let (first, second) = jumps(lambda);
        assert!(first < 1e-12 && second < 1e-10, "{first:e} {second:e}");
    }
    assert!(jumps(KNOTS.c).1 > 1e-3);
    // the same as fitting with simple knots
    let mut values = space.values().to_vec();
    for knot in [KNOTS.b, KNOTS.d] {
        let first = values.partition_point(|&u| u < knot);
        values.drain(first..first + 2);
    }
    let coarse = Knots::new(3, values).unwrap();
    let same = solve(&coarse, &samples, &[(0.5, 0.5)], &bounds, &[]).unwrap();
    for lambda in grid(300) {
        let difference = fit.spline.value(lambda).unwrap() - same.spline.value(lambda).unwrap();
        assert!(difference.abs() < 1e-11, "{lambda}: {difference:e}");
    }
}

#[test]
fn undetermined_directions_take_the_least_curvature() {
    let knots = LambdaKnots { b: 0.16, ..KNOTS };
    let space = knots.knots().unwrap();
    // 0.15 and 0.1624 enclose the first two knot intervals: nothing inside them
    let samples: Vec<Datum> = samples(|lambda| 1.0 - lambda)
        .into_iter()
        .filter(|s| s.lambda != 0.15416)
        .collect();
    let samples: Vec<Datum> = samples
        .into_iter()
        .enumerate()
        .filter(|&(i, _)| !(1..3).contains(&i))
        .map(|(_, s)| s)
        .collect();
    let fit = solve(&space, &samples, &[], &[], &[]).unwrap();
    assert!(fit.energy > 0.0);
    for lambda in grid(100) {
        // a line has no curvature: it is recovered
        assert!((fit.spline.value(lambda).unwrap() - (1.0 - lambda)).abs() < 1e-8);
    }
    assert!(matches!(
        solve(&space, &samples[90..], &[], &[], &[]),
        Err(FitError::Undetermined { .. })
    ));
}

#[test]
fn contradictions_are_errors() {
    let space = KNOTS.knots().unwrap();
    let samples = samples(|lambda| lambda);
    let bound = |lambda, lower, upper| Bound { lambda, lower, upper };
    let inf = f64::INFINITY;
    // the interpolated value violates its own bound
    match solve(&space, &samples, &[(0.5, 0.5)], &[bound(0.5, 0.6, inf)], &[]) {
        Err(FitError::Infeasible {
            lambda: 0.5,
            side: Side::Lower,
            bound: 0.6,
            value,
            ..
        }) => assert!((value - 0.5).abs() < 1e-12),
        other => panic!("{other:?}"),
    }
    // a zigzag narrower than the cubic pieces can follow
    let zigzag: Vec<Bound> = (0..40)
        .map(|i| {
            let (lambda, level) = (0.6 + 0.005 * i as f64, f64::from(i % 2));
            bound(lambda, level - 0.1, level + 0.1)
        })
        .collect();
    match solve(&space, &samples, &[], &zigzag, &[]) {
        Err(FitError::Infeasible { lambda, conflicts, .. }) => {
            assert!((0.6..0.8).contains(&lambda) && !conflicts.is_empty());
            assert!(conflicts.iter().all(|lambda| (0.6..0.8).contains(lambda)));
        }
        other => panic!("{other:?}"),
    }
    let interpolate = [(0.5, 0.5), (0.5, 0.6)];
    assert!(matches!(
        solve(&space, &samples, &interpolate, &[], &[]),
        Err(FitError::Contradiction { lambda: 0.5, .. })
    ));
    assert!(matches!(
        solve(&space, &samples, &[], &[bound(0.5, 0.2, 0.1)], &[]),
        Err(FitError::EmptyBand { lambda: 0.5, .. })
    ));
    for (interpolate, bounds) in [
        (vec![(f64::NAN, 0.1)], vec![]),
        (vec![(0.3, f64::NAN)], vec![]),
        (vec![(0.95, 0.1)], vec![]),
        (vec![], vec![bound(0.3, f64::NAN, 1.0)]),
        (vec![], vec![bound(0.3, inf, inf)]),
        (vec![], vec![bound(0.1, 0.0, 1.0)]),
    ] {
        let result = solve(&space, &samples, &interpolate, &bounds, &[]);
        assert!(matches!(result, Err(FitError::Point { .. })), "{result:?}");
    }
    for (value, weight) in [(f64::NAN, 1.0), (0.1, 0.0), (0.1, -1.0), (0.1, f64::NAN)] {
        let mut bad = samples.clone();
        bad[3] = Datum {
            value,
            weight,
            ..bad[3]
        };
        assert!(matches!(
            solve(&space, &bad, &[], &[], &[]),
            Err(FitError::Point {
                what: "sample",
                index: 3,
                ..
            })
        ));
    }
    for lambda in [0.15, 0.3, 0.9, f64::NAN] {
        assert!(matches!(
            solve(&space, &samples, &[], &[], &[lambda]),
            Err(FitError::NotAKnot { .. })
        ));
    }
    assert!(matches!(
        solve(&space, &[], &[], &[], &[]),
        Err(FitError::Undetermined { rank: 0, free: 17 })
    ));
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let (space, samples, bounds) = bent();
    let bits = || -> Vec<u64> {
        let fit = solve(&space, &samples, &[(0.4, 0.3)], &bounds, &[]).unwrap();
        fit.spline.coefficients().iter().map(|c| c.to_bits()).collect()
    };
    assert_eq!(bits(), bits());
}
