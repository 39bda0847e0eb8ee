//! Brute force against the definitions, and what the closed forms promise.

use super::*;
use crate::Error;
use crate::lambda::Relaxation;
use approx::assert_relative_eq;
use std::f64::consts::PI;

/// The smallest slack of the definitions at a point: weights, eigenvalues of the Fourier blocks, angle of the natural
/// configuration. Uses nothing of the domain, and of the plane only its stencil.
fn direct(plane: &Plane<f64>, bounds: Bounds, margin: f64, f2: f64, f3: f64) -> f64 {
    let n = plane.valence;
    let stencil = plane.stencil(f2, f3);
    let w = stencil.weights;
    let (lambda, mu) = (plane.lambda, plane.s * plane.lambda * plane.lambda);
    let m = (1.0 - margin) * mu;
    let mut worst = f64::INFINITY;
    let mut demand = |slack: f64| {
        worst = if slack.is_nan() { f64::NEG_INFINITY } else { worst.min(slack) };
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

/// (points, feasible ones, disagreements) of the closed forms and of `contains` with the definitions, on a grid of the
/// whole triangle and one around the domain.
fn compare(domain: &Domain, size: usize) -> [usize; 3] {
    let plane = *domain.plane();
    let [lower, upper] = domain.f3_range().map(|end| end.f3);
    let reach = 0.3 * (upper - lower).max(1e-3);
    let mut counts = [0; 3];
    for (low, high) in [(0.0, 1.1 * plane.lambda), (lower - reach, upper + reach)] {
        for j in 0..size {
            let mut f3 = low + (high - low) * (j as f64 + 0.37) / size as f64;
            if plane.valence == 4 && j % 2 == 0 {
                f3 = plane.mu();
            }
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
                if found != expected || domain.contains(f2, f3) != expected {
                    counts[2] += 1;
                    if counts[2] < 4 {
                        println!(
                            "N = {} lambda = {} s = {} phi = {} {:?} {:e}: f2 = {f2} f3 = {f3} in {lower}..{upper} slack {slack:e} expected {expected} found {found} {intervals:?} {:?}",
                            plane.valence, plane.lambda, plane.s, plane.phi, domain.bounds(), domain.margin(),
                            domain.slack(f2, f3),
                        );
                    }
                }
            }
        }
    }
    counts
}

fn sweep(valences: impl Iterator<Item = usize>, lambdas: usize, phis: &[f64], size: usize) {
    let mut total = [0; 3];
    for valence in valences {
        let rule = Relaxation::new(valence).unwrap();
        for i in 0..lambdas {
            let lambda = 0.15 + 0.75 * (i as f64 + 0.2 * (valence % 5) as f64) / lambdas as f64;
            for &phi in phis {
                let plane = Plane { phi, ..rule.plane(lambda).unwrap() };
                for (bounds, margin) in [(Bounds::Sharp, 0.0), (Bounds::Sharp, 2e-6), (Bounds::Paper, 0.0), (Bounds::Paper, 1e-3)] {
                    match Domain::new(plane, bounds, margin) {
                        Ok(domain) => {
                            for (t, c) in total.iter_mut().zip(compare(&domain, size)) { *t += c; }
                        }
                        Err(e) => println!("{e} {bounds:?} {margin}"),
                    }
                }
            }
        }
    }
    println!("{total:?}");
    assert_eq!(total[2], 0, "disagreements among {} points, {} feasible", total[0], total[1]);
    assert!(total[1] > total[0] / 20);
}

#[test]
fn closed_forms_agree_with_the_definitions() {
    sweep(3..=20, 16, &[6.0], 30);
}

#[test]
fn closed_forms_agree_with_the_definitions_at_high_valences() {
    sweep([23, 32, 45, 64].into_iter(), 16, &[6.0], 30);
}

#[test]
fn closed_forms_agree_with_the_definitions_at_other_vertex_weights() {
    sweep(3..=12, 16, &[4.0, 9.0], 24);
}
