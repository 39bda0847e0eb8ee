//! Limits and refusals of the objective; its numbers are tested in `direct`.

use super::*;
use approx::assert_relative_eq;

fn objective(valence: usize, lambda: f64, s: f64) -> Objective {
    Objective::new(Plane::new(valence, lambda, s).unwrap(), Settings::default()).unwrap()
}

#[test]
fn settings_out_of_range_are_refused_with_their_number() {
    let plane = Plane::new(6, 0.55, 1.0).unwrap();
    let refused = |settings: Settings| Objective::new(plane, settings).unwrap_err();
    let default = Settings::default();
    for epsilon in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(refused(Settings { epsilon, ..default }), Error::Epsilon { epsilon });
    }
    let epsilon = f64::NAN;
    assert!(matches!(
        refused(Settings { epsilon, ..default }),
        Error::Epsilon { .. }
    ));
    for n in [0.5, f64::INFINITY] {
        assert_eq!(refused(Settings { n, ..default }), Error::N { n });
    }
    for order in [0, 21] {
        let settings = Settings {
            quadrature_order: order,
            ..default
        };
        assert_eq!(refused(settings), Error::QuadratureOrder { order });
    }
}

#[test]
fn planes_out_of_range_and_resonances_are_refused() {
    let refused = |plane: Plane<f64>| Objective::new(plane, Settings::default()).unwrap_err();
    let plane = Plane::new(6, 0.55, 1.0).unwrap();
    assert!(matches!(refused(Plane { phi: -1.0, ..plane }), Error::Phi { .. }));
    assert!(matches!(refused(Plane { phi: f64::NAN, ..plane }), Error::Phi { .. }));
    assert!(matches!(refused(Plane { valence: 2, ..plane }), Error::Plane(_)));
    assert!(matches!(
        refused(Plane {
            lambda: f64::NAN,
            ..plane
        }),
        Error::Plane(_)
    ));
    // mu = s lambda^2 = 1/8
    let resonant = Plane::new(6, 0.25, 2.0).unwrap();
    assert_eq!(
        refused(resonant),
        Error::Resonance {
            eigenvalue: 0.125,
            outer: 0.125
        }
    );
}

#[test]
fn arguments_that_are_not_finite_are_refused() {
    let objective = objective(6, 0.5935, 1.0);
    for (f2, f3) in [
        (f64::NAN, 0.17),
        (0.3, f64::NAN),
        (f64::INFINITY, 0.17),
        (0.3, f64::NEG_INFINITY),
        (0.0, 0.17),
    ] {
        assert!(
            matches!(objective.value(f2, f3), Err(Error::NotFinite { .. })),
            "{f2} {f3}"
        );
        assert!(matches!(
            objective.value_and_gradient(f2, f3),
            Err(Error::NotFinite { .. })
        ));
        assert!(matches!(objective.parts(f2, f3), Err(Error::NotFinite { .. })));
    }
}

#[test]
fn a_folded_configuration_is_refused() {
    // either puts the face points on the wrong side of the centre
    let objective = objective(6, 0.5935, 1.0);
    for (f2, f3) in [(-0.3, 0.17), (0.3, 0.65)] {
        assert!(
            matches!(objective.value(f2, f3), Err(Error::Folded { jacobian, .. }) if jacobian <= 0.0),
            "{f2} {f3}"
        );
    }
}

#[test]
fn at_valence_four_f3_is_mu() {
    let objective = objective(4, 0.55, 1.0);
    let (value, gradient) = objective.value_and_gradient(0.26, 0.3025).unwrap();
    assert_eq!(objective.value_and_gradient(0.26, 0.1).unwrap(), (value, gradient));
    assert_eq!(gradient[1], 0.0);
    assert!(gradient[0] != 0.0);
}

#[test]
fn quadrature_converges() {
    let plane = Plane::new(7, 0.6, 1.0).unwrap();
    let value = |order: usize| {
        let settings = Settings {
            quadrature_order: order,
            ..Settings::default()
        };
        Objective::new(plane, settings).unwrap().value(0.32, 0.12).unwrap()
    };
    let limit = value(20);
    assert_relative_eq!(value(16), limit, max_relative = 1e-7);
    assert!((value(5) - limit).abs() > (value(10) - limit).abs());
}

#[test]
fn without_a_penalty_the_weight_is_one() {
    let plane = Plane::new(9, 0.6, 1.0).unwrap();
    let value = |n: f64, weighted: bool| {
        let settings = Settings {
            n,
            weighted,
            ..Settings::default()
        };
        Objective::new(plane, settings).unwrap().value(0.35, 0.05).unwrap()
    };
    assert_relative_eq!(value(1.0, true), value(5.0, false), max_relative = 1e-13);
    assert!(value(5.0, true) > value(5.0, false));
}

/// Large valences have no special role: sectors are summed by class.
#[test]
fn large_valences_evaluate() {
    for valence in [21, 33, 64, 101, 128] {
        let plane = Plane::new(valence, 0.9, 1.0).unwrap();
        let objective = Objective::new(plane, Settings::default()).unwrap();
        let (value, gradient) = objective.value_and_gradient(0.46, 0.0).unwrap();
        assert!(value > 0.0 && gradient.iter().all(|g| g.is_finite()));
    }
}

/// Relative parts are the same from either scale of the eigenvectors, and what the fit leaves and what it
/// explains add up to the mean square.
#[test]
fn relative_parts_have_no_scale() {
    for (valence, lambda, s, f2, f3) in [
        (3, 0.5, 1.0, 0.26, 0.33),
        (4, 0.55, 1.0, 0.26, 0.3025),
        (7, 0.6, 1.0, 0.32, 0.12),
        (13, 0.7, 1.03, 0.417, 0.001),
    ] {
        let plane = Plane::new(valence, lambda, s).unwrap();
        let objective = |normalisation, weighted| {
            let settings = Settings {
                normalisation,
                weighted,
                ..Settings::default()
            };
            Objective::new(plane, settings).unwrap()
        };
        let relative = objective(Normalisation::Relative, true);
        let (value, gradient) = relative.value_and_gradient(f2, f3).unwrap();
        for scale in [Normalisation::Paper, Normalisation::UnitRing] {
            let list = |parts: Parts| [parts.cup, parts.saddle_re, parts.saddle_im];
            let parts = list(objective(scale, true).parts(f2, f3).unwrap());
            let bare = list(objective(scale, false).parts(f2, f3).unwrap());
            let ratio = |(part, bare): (Part, Part)| {
                part.value / (bare.value + bare.a * bare.a + bare.b * bare.b + bare.c * bare.c)
            };
            let sum: f64 = parts.into_iter().zip(bare).map(ratio).sum();
            assert_relative_eq!(sum, value, max_relative = 1e-11);
        }
        assert_relative_eq!(relative.parts(f2, f3).unwrap().total(), value, max_relative = 1e-13);
        let step = 1e-6;
        let at = |d2: f64, d3: f64| relative.value(f2 + d2, f3 + d3).unwrap();
        let difference = [
            (at(step, 0.0) - at(-step, 0.0)) / (2.0 * step),
            (at(0.0, step) - at(0.0, -step)) / (2.0 * step),
        ];
        for (found, expected) in gradient.into_iter().zip(difference) {
            assert_relative_eq!(found, expected, max_relative = 1e-6, epsilon = 1e-7);
        }
    }
}
