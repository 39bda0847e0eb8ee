//! Branch and bound over stencils against the objective and the domain in doubles, which share no code with
//! it.

use eigenring_certify::Status;
use eigenring_certify::optimum::{Limits, Problem};
use eigenring_scheme::lambda::Relaxation;
use eigenring_tune::objective::Settings;
use eigenring_tune::sweep::{self, Options};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};

/// A number in [0, 1).
fn unit(random: &mut Xoshiro256PlusPlus) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// The same plane in doubles and in intervals, at a lambda with s = 1 or with s > 1.
fn problems(random: &mut Xoshiro256PlusPlus) -> (sweep::Problem, Problem) {
    let valence = 5 + (unit(random) * 12.0) as usize;
    let relaxation = Relaxation::new(valence).expect("a valence");
    let end = relaxation.ramp_end();
    let lambda = if unit(random) < 0.7 {
        end + 0.02 + unit(random) * (0.9 - end).max(0.0)
    } else {
        0.3 + 0.1 * unit(random)
    };
    let weighted = unit(random) < 0.7;
    let options = Options {
        settings: Settings {
            weighted,
            ..Settings::default()
        },
        ..Options::default()
    };
    let doubles = sweep::Problem::new(valence, lambda, &options).expect("a plane");
    let s = doubles.domain.plane().s;
    let intervals = Problem::new(valence, lambda, s, weighted, options.margin).expect("a plane");
    (doubles, intervals)
}

/// A feasible stencil.
fn feasible(problem: &sweep::Problem, random: &mut Xoshiro256PlusPlus) -> [f64; 2] {
    let [low, high] = problem.domain.f3_range().map(|end| end.f3);
    let f3 = low + (high - low) * unit(random);
    let interval = problem.domain.f2_intervals(f3)[0];
    let f2 = interval.lower.f2 + (interval.upper.f2 - interval.lower.f2) * unit(random);
    [f2, f3]
}

fn radius(problem: &sweep::Problem, [f2, f3]: [f64; 2]) -> f64 {
    problem.domain.plane().corner_radius(f2, f3)
}

#[test]
fn enclosures_hold_the_objective() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(61);
    let mut compared = 0;
    for _ in 0..16 {
        let (doubles, intervals) = problems(&mut random);
        let stencil = feasible(&doubles, &mut random);
        let [low, high] = intervals.rectangle();
        let r = radius(&doubles, stencil);
        assert!(low[0] - 1e-9 <= r && r <= low[1] + 1e-9 && high[0] <= stencil[1] && stencil[1] <= high[1] + 1e-12);
        // folds have no objective
        let Ok(value) = doubles.objective.value(stencil[0], stencil[1]) else {
            continue;
        };
        let found = intervals.value(stencil);
        assert!(
            found.lo() <= value * (1.0 + 1e-9) && value * (1.0 - 1e-9) <= found.hi(),
            "{value} {found:?}"
        );
        // near mu = 1/8 the second ring is all but undetermined
        if found.width() < 1e-6 * value {
            compared += 1;
        }
    }
    assert!(compared > 8, "{compared}");
}

#[test]
fn boxes_never_exceed_their_members() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(62);
    let (mut bounded, mut excluded) = (0, 0);
    for round in 0..24 {
        let (doubles, intervals) = problems(&mut random);
        let stencil = feasible(&doubles, &mut random);
        let width = [0.3, 0.03, 3e-3, 3e-5][round % 4];
        let sides = intervals.rectangle();
        let centre = [radius(&doubles, stencil), stencil[1]];
        let [r, f3] = [0, 1].map(|i| {
            let half = width * (sides[i][1] - sides[i][0]);
            let shift = half * (2.0 * unit(&mut random) - 1.0);
            [centre[i] - half + shift, centre[i] + half + shift]
        });
        let inside = |f3: f64| f3.max(0.0);
        let (r, f3) = (
            [r[0].max(0.9), r[1]],
            [inside(f3[0]), f3[1].min(0.99 * doubles.domain.plane().lambda)],
        );
        let least = intervals.least(r, f3).expect("in order");
        let mut members = vec![stencil];
        members.extend((0..8).map(|_| {
            let plane = doubles.domain.plane();
            let (radius, f3) = (
                r[0] + (r[1] - r[0]) * unit(&mut random),
                f3[0] + (f3[1] - f3[0]) * unit(&mut random),
            );
            [radius * (plane.lambda - f3) / (2.0 * plane.cos_half_sector()), f3]
        }));
        for [f2, f3] in members {
            if !doubles.domain.contains(f2, f3) {
                continue;
            }
            if let Ok(value) = doubles.objective.value(f2, f3) {
                assert!(
                    least <= value * (1.0 + 1e-9),
                    "{least} {value} at {f2}, {f3} of {r:?} {f3:?}"
                );
            }
        }
        bounded += usize::from(least.is_finite());
        excluded += usize::from(least == f64::INFINITY);
    }
    assert!(bounded > 8 && excluded == 0, "{bounded} {excluded}");
}

#[test]
fn a_stencil_beside_the_best_is_refuted() {
    let (valence, lambda) = (6, 0.5929333475416836);
    let problem = Problem::new(valence, lambda, 1.0, false, 2e-6).expect("a plane");
    let options = Options {
        settings: Settings {
            weighted: false,
            ..Settings::default()
        },
        ..Options::default()
    };
    let doubles = sweep::Problem::new(valence, lambda, &options).expect("a plane");
    let value = |[f2, f3]: [f64; 2]| doubles.objective.value(f2, f3).expect("no fold");
    let worse = [0.33, 0.17];
    let proof = problem.prove(worse, 1e-3, Limits::default()).expect("a stencil");
    assert_eq!(proof.status(), Status::Refuted);
    let better = proof.better.expect("a witness");
    assert!(doubles.domain.contains(better[0], better[1]) && value(better) < value(worse) * (1.0 - 1e-3));
}
