//! Brute force against the definitions, and what the closed forms promise.

use super::*;
use crate::Error;
use crate::lambda::Relaxation;
use approx::assert_relative_eq;
use std::f64::consts::PI;

/// The smallest slack of the definitions at a point: weights, eigenvalues of the Fourier blocks, angle of the
/// natural configuration. Uses nothing of the domain, and of the plane only its stencil.
fn direct(plane: &Plane<f64>, bounds: Bounds, margin: f64, f2: f64, f3: f64) -> f64 {
    let n = plane.valence;
    let stencil = plane.stencil(f2, f3);
    let w = stencil.weights;
    let (lambda, mu) = (plane.lambda, plane.s * plane.lambda * plane.lambda);
    let m = (1.0 - margin) * mu;
    let mut worst = f64::INFINITY;
    let mut demand = |slack: f64| {
        worst = if slack.is_nan() {
            f64::NEG_INFINITY
        } else {
            worst.min(slack)
        };
    };
    for weight in [f2, f3, w.f1, w.d1, w.d2, w.e1, w.e2, w.beta, 1.0 - w.alpha - w.beta] {
        demand(weight);
    }
    if n == 4 {
        demand(-(f3 - mu).abs());
    }
    // block 0 on (V, E, F): eigenvalues 1, mu and what the trace leaves
    let trace = (1.0 - w.alpha - w.beta) + (w.d2 + 2.0 * w.e1) + w.f3;
    demand(m - (trace - 1.0 - mu).abs());
    for k in 1..=n / 2 {
        let (sin, cos) = (2.0 * PI * k as f64 / n as f64).sin_cos();
        // the entries (1, e2 (1+w^-k)) and (f2 (1+w^k), 1) are conjugate up to the weights
        let (ee, ff) = (w.d2 + 2.0 * w.e1 * cos, w.f3);
        let ef_fe = w.e2 * w.f2 * ((1.0 + cos).powi(2) + sin.powi(2));
        let (trace, det) = (ee + ff, ee * ff - ef_fe);
        match (n, k) {
            (3, 1) | (4, 2) => {}
            (_, 1) => demand(m - (trace - lambda).abs()),
            (_, 2) => demand(m - (trace - mu).abs()),
            _ => {
                let discriminant = trace * trace / 4.0 - det;
                let root = discriminant.abs().sqrt();
                demand(if discriminant < 0.0 {
                    m - (trace / 2.0).hypot(root)
                } else {
                    m - (trace / 2.0 + root).abs().max((trace / 2.0 - root).abs())
                });
            }
        }
    }
    if n > 4 && bounds == Bounds::Paper {
        demand(stencil.g3 + m);
    }
    // natural configuration: E at 1, F = f2 (1+w)/(lambda-f3)
    let (sin, cos) = (2.0 * PI / n as f64).sin_cos();
    let scale = f2 / (lambda - f3);
    let f = [scale * (1.0 + cos), scale * sin];
    let (to_v, to_e) = ([-f[0], -f[1]], [1.0 - f[0], -f[1]]);
    let dot = to_v[0] * to_e[0] + to_v[1] * to_e[1];
    let cross = to_v[0] * to_e[1] - to_v[1] * to_e[0];
    demand(PI / 2.0 - PI / (2.0 * n as f64) - cross.abs().atan2(dot));
    worst
}

/// (points, feasible ones, disagreements) of the closed forms and of `contains` with the definitions, on a
/// grid of the whole triangle and one around the domain.
fn compare(domain: &Domain, size: usize) -> [usize; 3] {
    let plane = *domain.plane();
    let [lower, upper] = domain.f3_range().map(|end| end.f3);
    let reach = 0.3 * (upper - lower).max(1e-3);
    let mut counts = [0; 3];
    for (low, high) in [(0.0, 1.1 * plane.lambda), (lower - reach, upper + reach)] {
        let even = (0..size).map(|j| low + (high - low) * (j as f64 + 0.37) / size as f64);
        let near = [lower, upper]
            .into_iter()
            .flat_map(|end| [-1e-5, -1e-7, 1e-7, 1e-5].map(|step| end + step));
        for f3 in even.chain(near).chain([plane.mu()]) {
            let intervals = domain.f2_intervals(f3);
            let ends = intervals.iter().flat_map(|i| [i.lower.f2, i.upper.f2]);
            let near = ends.flat_map(|end| [-1e-2, -1e-4, -1e-6, 1e-6, 1e-4, 1e-2].map(|step| end + step));
            let even = (0..size).map(|i| 0.52 * (i as f64 + 0.41) / size as f64);
            for f2 in even.chain(near).filter(|&f2| f2 > 0.0) {
                let slack = direct(&plane, domain.bounds(), domain.margin(), f2, f3);
                if slack.abs() < 1e-9 && plane.valence != 4 {
                    continue;
                }
                let expected = slack >= if plane.valence == 4 { -1e-15 } else { 0.0 };
                let found = intervals.iter().any(|i| i.lower.f2 <= f2 && f2 <= i.upper.f2);
                counts[0] += 1;
                counts[1] += usize::from(expected);
                counts[2] += usize::from(found != expected || domain.contains(f2, f3) != expected);
            }
        }
    }
    counts
}

fn sweep(valences: impl Iterator<Item = usize>, phis: &[f64], margins: &[f64], size: usize) {
    let mut total = [0; 3];
    for valence in valences {
        let rule = Relaxation::new(valence).unwrap();
        for i in 0..16 {
            // valences interleave, so that all of [0.15, 0.9) is covered densely
            let lambda = 0.15 + 0.75 * (f64::from(i) + 0.2 * (valence % 5) as f64) / 16.0;
            for &phi in phis {
                let plane = Plane {
                    phi,
                    ..rule.plane(lambda).unwrap()
                };
                for &margin in margins {
                    for bounds in [Bounds::Sharp, Bounds::Paper] {
                        let domain = match Domain::new(plane, bounds, margin) {
                            Ok(domain) => domain,
                            // the rule's addition to s leaves no room for a large margin
                            Err(Error::Infeasible { .. }) if margin > 1e-3 => continue,
                            Err(error) => panic!("{error}"),
                        };
                        let counts = compare(&domain, size);
                        assert_eq!(counts[2], 0, "{domain:?}");
                        for (sum, count) in total.iter_mut().zip(counts) {
                            *sum += count;
                        }
                    }
                }
            }
        }
    }
    assert!(total[1] > total[0] / 20 && total[1] < total[0] / 2, "{total:?}");
}

#[test]
fn closed_forms_agree_with_the_definitions() {
    sweep(3..=20, &[6.0], &[0.0, 2e-6], 30);
}

#[test]
fn closed_forms_agree_with_the_definitions_at_high_valences() {
    sweep([23, 32, 45, 64].into_iter(), &[6.0], &[0.0, 2e-6], 30);
}

#[test]
fn closed_forms_agree_with_the_definitions_at_other_vertex_weights() {
    sweep(3..=12, &[0.0, 4.0, 20.0], &[0.0], 24);
}

#[test]
fn closed_forms_agree_with_the_definitions_at_large_margins() {
    sweep(3..=16, &[6.0], &[1e-3, 0.03, 0.3], 20);
}

#[test]
fn lowest_f3_at_valence_three() {
    // z0 = mu meets the theta bound f2 = lambda - f3; values of an independent computation, given to four
    // digits
    for (lambda, lowest) in [
        (0.16, 0.1276),
        (0.25, 0.1352),
        (0.39, 0.1729),
        (0.4112, 0.1899),
        (0.5, 0.2702),
        (0.65, 0.4396),
        (0.8, 0.6515),
        (0.89, 0.7990),
    ] {
        let domain = domain(3, lambda, Bounds::Sharp, 0.0);
        let [lower, upper] = domain.f3_range();
        assert!((lower.f3 - lowest).abs() <= 1e-4, "{lambda}: {}", lower.f3);
        assert!((upper.f3 - lambda).abs() < 1e-15);
        assert_eq!((lower.edge, upper.edge), (None, None));
        let [theta, z0] = [ConstraintCurve::Theta, ConstraintCurve::Z0Upper(Root::Larger)]
            .map(|c| domain.curve(c, lower.f3).unwrap().0);
        assert_relative_eq!(theta, z0, epsilon = 1e-12);
        assert_relative_eq!(theta, lambda - lower.f3, epsilon = 1e-15);
    }
}

fn domain(valence: usize, lambda: f64, bounds: Bounds, margin: f64) -> Domain {
    let plane = Relaxation::new(valence).unwrap().plane(lambda).unwrap();
    Domain::new(plane, bounds, margin).unwrap()
}

/// Domains with the paper's vertex weights at some lambda of each valence.
fn domains() -> impl Iterator<Item = Domain> {
    let valences = (3..=20).chain([33, 64]);
    let cases = valences.flat_map(|n| (0..40).map(move |i| (n, 0.15 + 0.75 * f64::from(i) / 39.0)));
    cases.flat_map(|(n, lambda)| {
        [(Bounds::Sharp, 2e-6), (Bounds::Paper, 0.0)].map(|(bounds, margin)| domain(n, lambda, bounds, margin))
    })
}

#[test]
fn no_row_is_empty_and_every_start_is_feasible() {
    for domain in domains() {
        let (n, lambda) = (domain.plane().valence, domain.plane().lambda);
        for j in 0..=200 {
            let intervals = domain.f2_intervals(domain.f3_at(f64::from(j) / 200.0));
            assert!(!intervals.is_empty(), "N = {n}, lambda = {lambda}, row {j}");
            assert!(intervals.len() == 1 || (n == 3 && lambda < 0.516));
            assert!(intervals.is_sorted_by(|a, b| a.upper.f2 < b.lower.f2));
        }
        let starts = domain.starts(10);
        match n {
            3 => assert!((100..=200).contains(&starts.len())),
            4 => assert_eq!(starts.len(), 10),
            _ => assert_eq!(starts.len(), 100),
        }
        for [f2, f3] in starts {
            assert!(domain.contains(f2, f3), "N = {n}, lambda = {lambda}, ({f2}, {f3})");
            assert_eq!(domain.check(f2, f3, 0.0), Ok(()));
            assert_eq!(domain.clamp(f2, f3), Some([f2, f3]));
        }
    }
}

#[test]
fn named_constraints_are_active_and_no_other_is_violated() {
    for domain in domains() {
        let slack_of = |f2, f3, constraint| {
            let slack = domain.slack(f2, f3);
            assert!(
                slack.iter().all(|&(_, s)| s > -1e-12),
                "{domain:?} ({f2}, {f3}) {slack:?}"
            );
            slack.iter().find(|&&(c, _)| c == constraint).unwrap().1
        };
        for j in 1..20 {
            let f3 = domain.f3_at(f64::from(j) / 20.0);
            for interval in domain.f2_intervals(f3) {
                for end in [interval.lower, interval.upper] {
                    let active = slack_of(end.f2, f3, end.curve.constraint());
                    assert!(active.abs() < 1e-12, "{domain:?} {f3} {end:?} {active:e}");
                    assert_relative_eq!(domain.curve(end.curve, f3).unwrap().0, end.f2, max_relative = 1e-13);
                }
            }
        }
        for end in domain.f3_range() {
            for interval in domain.f2_intervals(end.f3) {
                for u in [0.0, 0.3, 1.0] {
                    if let Some(edge) = end.edge {
                        assert!(slack_of(interval.at(u), end.f3, edge).abs() < 1e-12, "{domain:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn slopes_are_those_of_central_differences() {
    let mut seen = std::collections::BTreeSet::new();
    for domain in domains().filter(|d| d.plane().valence != 4) {
        for j in 1..10 {
            let v = f64::from(j) / 10.0;
            let f3 = domain.f3_at(v);
            // the range of f3 sets the scale of the curves
            let step = 1e-4 * (domain.f3_at(1.0) - domain.f3_at(0.0));
            for interval in domain.f2_intervals(f3) {
                // d1 is never the tightest bound here
                for curve in [interval.lower.curve, interval.upper.curve, ConstraintCurve::D1] {
                    let (Some((_, slope)), Some((left, _)), Some((right, _))) = (
                        domain.curve(curve, f3),
                        domain.curve(curve, f3 - step),
                        domain.curve(curve, f3 + step),
                    ) else {
                        continue;
                    };
                    let difference = (right - left) / (2.0 * step);
                    // truncation is of the order of (step/range)^2, far from the ends; rounding of 1e-16/step
                    let tolerance = 1e-4 * slope.abs() + 1e-14 / step;
                    assert!(
                        (slope - difference).abs() < tolerance,
                        "{domain:?} {curve:?} {v}: {slope} {difference}"
                    );
                    seen.insert(curve.constraint());
                }
            }
        }
    }
    use Constraint::*;
    assert_eq!(Vec::from_iter(seen), [F1, D1, Centre, Theta, Z0Lower, Z0Upper]);
}

#[test]
fn strips_cover_the_range_and_end_where_curves_meet() {
    for domain in domains() {
        let strips = domain.strips();
        let [lower, upper] = domain.f3_range().map(|end| end.f3);
        assert_eq!((strips[0].f3[0], strips[strips.len() - 1].f3[1]), (lower, upper));
        assert!(strips.len() < 12, "{domain:?} {strips:?}");
        for pair in strips.windows(2) {
            let (before, after) = (pair[0].f3[1], pair[1].f3[0]);
            assert!(before <= after && after - before <= 1e-15);
            assert_ne!(pair[0].curves, pair[1].curves);
            // where one curve takes over from another they agree
            if pair[0].curves.len() == pair[1].curves.len() {
                let rows = [domain.f2_intervals(before), domain.f2_intervals(after)];
                for (left, right) in rows[0].iter().zip(&rows[1]) {
                    assert_relative_eq!(left.lower.f2, right.lower.f2, epsilon = 1e-6);
                    assert_relative_eq!(left.upper.f2, right.upper.f2, epsilon = 1e-6);
                }
            }
        }
        for strip in &strips {
            let f3 = 0.5 * (strip.f3[0] + strip.f3[1]);
            let curves: Vec<_> = domain
                .f2_intervals(f3)
                .iter()
                .map(|i| [i.lower.curve, i.upper.curve])
                .collect();
            assert_eq!(curves, strip.curves);
        }
    }
}

#[test]
fn valence_four_is_an_interval() {
    for i in 0..40 {
        let lambda = 0.15 + 0.75 * f64::from(i) / 39.0;
        let domain = domain(4, lambda, Bounds::Paper, 0.0);
        let mu = domain.plane().mu();
        assert_eq!(
            domain.f3_range().map(|end| (end.f3, end.edge)),
            [(mu, Some(Constraint::F3EqualsMu)); 2]
        );
        let intervals = domain.f2_intervals(mu);
        assert_eq!(intervals.len(), 1);
        assert_relative_eq!(intervals[0].lower.f2, (lambda - mu) / 2.0_f64.sqrt(), epsilon = 1e-15);
        assert_relative_eq!(intervals[0].upper.f2, (1.0 - mu) / 2.0, epsilon = 1e-15);
    }
    let bicubic = domain(4, 0.5, Bounds::Paper, 2e-6);
    assert!(bicubic.contains(0.25, 0.25));
}

#[test]
fn the_sharp_domain_contains_that_of_the_paper() {
    for valence in 3..=20 {
        for i in 0..20 {
            let lambda = 0.15 + 0.75 * f64::from(i) / 19.0;
            let [paper, sharp] = [Bounds::Paper, Bounds::Sharp].map(|b| domain(valence, lambda, b, 0.0).f3_range()[1]);
            assert!(paper.f3 <= sharp.f3);
            let differ = paper.edge == Some(Constraint::LastBlock) && valence % 2 == 1;
            assert_eq!(paper.f3 < sharp.f3, differ, "N = {valence}, lambda = {lambda}");
        }
    }
}

#[test]
fn theta_is_the_corner_radius() {
    let domain = domain(7, 0.5, Bounds::Sharp, 0.0);
    for i in 1..100 {
        for j in 0..50 {
            let (f2, f3) = (f64::from(i) / 100.0, f64::from(j) / 100.0);
            let radius = domain.plane().corner_radius(f2, f3);
            assert_eq!(domain.theta(f2, f3) <= domain.theta_max(), radius >= 1.0);
        }
    }
    assert_relative_eq!(
        domain.theta(0.5 / (2.0 * (PI / 7.0).cos()), 0.0),
        domain.theta_max(),
        epsilon = 1e-14
    );
}

#[test]
fn infeasible_points_are_named() {
    let domain = domain(6, 0.55, Bounds::Paper, 0.0);
    let refused = |f2, f3| match domain.check(f2, f3, 1e-6) {
        Err(Error::Point(point)) => *point,
        other => panic!("({f2}, {f3}): {other:?}"),
    };
    let point = refused(0.9, 0.1);
    assert_eq!((point.constraint, point.coordinate), (Constraint::F1, "f2"));
    assert_relative_eq!(point.distance, 0.45, epsilon = 1e-15);
    let message = point.to_string();
    for part in [
        "N = 6",
        "lambda = 0.55",
        "f1 >= 0 is missed by 4.5",
        "<= f2 <= 0.45 at this f3",
        "0 <= f3 <= ",
    ] {
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(refused(0.1, 0.1).constraint, Constraint::Theta);
    let low = refused(0.4, -0.01);
    assert_eq!(
        (low.constraint, low.coordinate, low.distance),
        (Constraint::F3, "f3", 0.01)
    );
    let high = domain.f3_range()[1];
    assert_eq!(Some(refused(0.3, high.f3 + 0.01).constraint), high.edge);
    assert!(refused(f64::NAN, 0.1).distance.is_nan());
    assert!(refused(0.3, f64::NAN).distance.is_nan());
    assert_eq!(domain.check(0.45 + 0.9e-6, 0.1, 1e-6), Ok(()));
    assert_eq!(domain.check(0.4, -0.9e-6, 1e-6), Ok(()));
    assert_eq!(domain.clamp(0.9, 0.1), Some([0.45, 0.1]));
    assert_eq!(domain.clamp(f64::NAN, 0.1), None);
    assert_eq!(domain.clamp(0.3, f64::NAN), None);
    for (f2, f3) in [(0.0, 0.0), (f64::NAN, 0.1), (0.3, f64::NAN), (0.3, f64::INFINITY)] {
        assert!(!domain.contains(f2, f3));
        assert!(domain.slack(f2, f3).iter().all(|(_, slack)| !slack.is_nan()));
    }
}

#[test]
fn parameters_out_of_range_are_refused() {
    let plane = Plane::new(6, 0.5, 1.0).unwrap();
    for margin in [-1e-9, 1.0, f64::NAN] {
        assert!(matches!(
            Domain::new(plane, Bounds::Paper, margin),
            Err(Error::Margin { .. })
        ));
    }
    for phi in [-1.0, f64::INFINITY, f64::NAN] {
        let plane = Plane { phi, ..plane };
        assert!(matches!(Domain::new(plane, Bounds::Paper, 0.0), Err(Error::Phi { .. })));
    }
    // bounded curvature below lambda_l
    let plane = Plane::new(12, 0.5, 1.0).unwrap();
    assert!(matches!(
        Domain::new(plane, Bounds::Sharp, 0.0),
        Err(Error::Infeasible { valence: 12, .. })
    ));
}
