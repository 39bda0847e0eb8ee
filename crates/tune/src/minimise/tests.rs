//! **Oracle**: functions whose minima are known in closed form.

use super::*;

type Gradient = fn(&[f64]) -> Vec<f64>;

/// A function, its conditions and its smooth form.
struct Known {
    dimension: usize,
    value: fn(&[f64]) -> f64,
    slacks: fn(&[f64]) -> Vec<f64>,
    gradient: Option<Gradient>,
}

impl Problem for Known {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn worth(&self, point: &[f64]) -> Worth {
        Worth {
            value: (self.value)(point),
            slacks: (self.slacks)(point),
        }
    }

    fn smooth(&self, point: &[f64]) -> Option<(f64, Vec<f64>)> {
        Some(((self.value)(point), (self.gradient?)(point)))
    }
}

fn minimum(problem: &Known, seed: u64) -> Found {
    let points = samples(problem.dimension, 64, seed);
    let worths: Vec<Worth> = points.iter().map(|point| problem.worth(point)).collect();
    let mut found: Vec<Found> = starts(&points, &worths, 4)
        .into_iter()
        .map(|index| descend(problem, &points[index]))
        .collect();
    found.push(descend(problem, &swarm(problem, seed).point));
    polish(problem, &best(&found).unwrap().point)
}

fn check(problem: &Known, expected: &[f64], tolerance: f64) {
    for seed in [1, 2] {
        let found = minimum(problem, seed);
        assert!(found.worth.is_feasible());
        for (x, expected) in found.point.iter().zip(expected) {
            assert!((x - expected).abs() < tolerance, "{found:?} {expected:?}");
        }
        assert_eq!(found, minimum(problem, seed));
    }
}

#[test]
fn smooth_minima_inside_and_at_the_border() {
    // Rosenbrock's valley, scaled; without and with its gradient
    let mut valley = Known {
        dimension: 2,
        value: |x| (1.0 - 2.0 * x[0]).powi(2) + 100.0 * (2.0 * x[1] - 4.0 * x[0] * x[0]).powi(2),
        slacks: |_| vec![],
        gradient: None,
    };
    check(&valley, &[0.5, 0.5], 1e-6);
    valley.gradient = Some(|x| {
        let (a, b) = (1.0 - 2.0 * x[0], 2.0 * x[1] - 4.0 * x[0] * x[0]);
        vec![-4.0 * a - 1600.0 * b * x[0], 400.0 * b]
    });
    check(&valley, &[0.5, 0.5], 1e-7);
    let border = Known {
        dimension: 3,
        value: |x| (x[0] - 1.2).powi(2) + (x[1] + 0.3).powi(2) + (x[2] - 0.4).powi(2) + x[0] * x[2],
        slacks: |_| vec![],
        gradient: None,
    };
    // at x = 1: 2 (z - 0.4) + 1 = 0 is met below the cube
    check(&border, &[1.0, 0.0, 0.0], 1e-9);
}

#[test]
fn kinks_and_active_conditions() {
    let kink = Known {
        dimension: 1,
        value: |x| (x[0] - 1.0 / 3.0).abs(),
        slacks: |_| vec![],
        gradient: None,
    };
    check(&kink, &[1.0 / 3.0], 1e-14);
    // the nearest point of a slanted line, of a circle, and a corner of both
    let line = Known {
        dimension: 2,
        value: |x| (x[0] - 0.9).powi(2) + (x[1] - 0.9).powi(2),
        slacks: |x| vec![0.8 - x[0] - 0.5 * x[1]],
        gradient: None,
    };
    let shift = (0.8 - 1.35) / 1.25;
    check(&line, &[0.9 + shift, 0.9 + 0.5 * shift], 1e-6);
    let circle = Known {
        dimension: 2,
        value: |x| x[0] + x[1],
        slacks: |x| vec![0.09 - (x[0] - 0.5).powi(2) - (x[1] - 0.5).powi(2)],
        gradient: None,
    };
    let side = 0.5 - 0.3 / 2.0_f64.sqrt();
    // the value is met to 2e-11, so x, along the circle, to its root
    check(&circle, &[side, side], 1e-5);
    let corner = Known {
        dimension: 2,
        value: |x| -x[0] - 0.1 * x[1],
        slacks: |x| vec![0.7 - x[0], 0.9 - x[0] - 0.5 * x[1]],
        gradient: None,
    };
    check(&corner, &[0.7, 0.4], 1e-6);
}

#[test]
fn what_is_undefined_or_infeasible_is_never_taken_for_better() {
    // defined on a small part only, and smaller where it is not feasible
    let part = Known {
        dimension: 2,
        value: |x| if x[0] < 0.6 { f64::NAN } else { x[0] },
        slacks: |x| vec![x[1] - 0.75],
        gradient: None,
    };
    let found = minimum(&part, 3);
    assert!(found.worth.is_feasible() && (found.point[0] - 0.6).abs() < 1e-6 && found.point[1] >= 0.75);
    let nowhere = Known {
        dimension: 1,
        value: |x| x[0],
        slacks: |x| vec![x[0] - 2.0, f64::NAN],
        gradient: None,
    };
    assert!(!minimum(&nowhere, 3).worth.is_feasible());
}
