//! Local matrices, spectra, limits and first levels against the prototype's numbers.

use crate::common::{Local, cases, difference};
use eigenring_nonuniform::{EigenPolyhedron, Error, FirstLevel, NGon, Spokes, first_level, nurss};
use eigenring_spectral::{Block, Matrix};

fn matrix_difference(found: &Matrix<f64>, expected: &[Vec<f64>]) -> f64 {
    difference(found.entries(), expected.iter().flatten())
}

/// Eigenvalues with multiplicities, by falling real part.
fn eigenvalues(matrix: &Matrix<f64>) -> Vec<[f64; 2]> {
    let values = Block::Real(matrix.clone()).eigenvalues().unwrap();
    let repeated = values
        .iter()
        .flat_map(|e| std::iter::repeat_n([e.value.re, e.value.im], e.multiplicity));
    sorted(repeated.collect())
}

fn sorted(mut values: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    // conjugates and near values in one order
    let key = |z: &[f64; 2]| ((z[0] * 1e8).round() as i64, (z[1] * 1e8).round() as i64);
    values.sort_by_key(key);
    values
}

fn check_spectrum(found: Vec<[f64; 2]>, expected: &[[f64; 2]], tolerance: f64) {
    let expected = sorted(expected.to_vec());
    let error = difference(found.iter().flatten(), expected.iter().flatten());
    assert!(error < tolerance, "{error:e}: {found:?} {expected:?}");
}

fn check(case: &Local) {
    let spokes = Spokes::new(case.d.clone(), case.a.clone()).unwrap();
    let label = format!("{:?}", case.d);
    let first = nurss::matrix::<f64>(&spokes).unwrap();
    assert!(matrix_difference(&first, &case.nurss.matrix) < 1e-12, "{label}");
    let stationary = nurss::matrix::<f64>(&spokes.after_a_level()).unwrap();
    check_spectrum(eigenvalues(&stationary), &case.nurss.stationary_spectrum, 1e-10);

    let expected = &case.eigen_polyhedron;
    let found = EigenPolyhedron::anywhere(&case.d).unwrap();
    assert!((found.gamma - expected.gamma).abs() < 1e-13 && (found.lambda - expected.lambda).abs() < 1e-13);
    assert!(
        difference(&found.d_minus, expected.d_minus.as_ref().unwrap()) < 1e-11,
        "{label}"
    );
    assert!(
        difference(&found.lengths, expected.l.as_ref().unwrap()) < 1e-11,
        "{label}"
    );
    assert!(difference(&found.centre, expected.centre.as_ref().unwrap()) < 1e-12 * case.d[0].max(1.0));
    // outside of the domain the weights are of any size, and ill-conditioned
    let pairs = |found: &[[f64; 2]], expected: &Option<Vec<[f64; 2]>>| {
        let expected = expected.as_ref().unwrap();
        let size = expected.iter().flatten().fold(1.0, |m: f64, x| m.max(x.abs()));
        difference(found.iter().flatten(), expected.iter().flatten()) / size
    };
    let tolerances = if expected.in_domain {
        [1e-12, 1e-12]
    } else {
        [1e-11, 1e-3]
    };
    assert!(pairs(&found.alpha, &expected.alpha) < tolerances[0], "{label}");
    assert!(pairs(&found.beta, &expected.beta) < tolerances[1], "{label}");
    assert_eq!(found.is_inside(), expected.in_domain, "{label}");
    if expected.in_domain {
        check_spectrum(
            eigenvalues(&found.matrix().unwrap()),
            expected.spectrum.as_ref().unwrap(),
            1e-10,
        );
        let strict = EigenPolyhedron::new(&case.d).unwrap();
        assert!(matrix_difference(&strict.matrix().unwrap(), expected.matrix.as_ref().unwrap()) < 1e-12);
        let limit = strict.limit_weights().unwrap();
        let error = difference(&limit, expected.limit_weights.as_ref().unwrap());
        assert!(error < 1e-12, "{label} {error:e} {limit:?}");
        let limit = strict.limit_of_first_step(&spokes).unwrap();
        assert!(
            difference(&limit, expected.limit_of_first_step.as_ref().unwrap()) < 1e-12,
            "{label}"
        );
    } else {
        assert!(
            matches!(EigenPolyhedron::new(&case.d), Err(Error::OutsideDomain { .. })),
            "{label}"
        );
    }

    let ngon = NGon::new(&case.d).unwrap();
    let n = case.d.len() as f64;
    let alpha: Vec<f64> = ngon.scaled_alpha().iter().map(|alpha| alpha / n).collect();
    assert!(difference(&alpha, &case.hnuss.alpha) < 1e-12, "{label}");
    assert!(difference(ngon.beta(), &case.hnuss.beta) < 1e-12, "{label}");
    assert!(matrix_difference(&ngon.matrix(), &case.hnuss.matrix) < 1e-12, "{label}");
    assert!(difference(&ngon.spectrum(), &case.hnuss.spectrum) < 1e-10, "{label}");
    assert!(
        difference(&ngon.limit_weights(), &case.hnuss.limit_weights) < 1e-12,
        "{label}"
    );
    for (found, expected) in ngon.tangent_weights().iter().zip(&case.hnuss.tangent_weights) {
        // up to a factor
        let scale = expected
            .iter()
            .fold(0.0_f64, |m, x| if x.abs() > m.abs() { *x } else { m });
        let at = expected.iter().position(|x| *x == scale).unwrap();
        let ratio = scale / found[at];
        let scaled: Vec<f64> = found.iter().map(|x| x * ratio / scale).collect();
        let expected: Vec<f64> = expected.iter().map(|x| x / scale).collect();
        assert!(difference(&scaled, &expected) < 1e-12, "{label}");
    }
    let rules = [
        ("simple", FirstLevel::Simple),
        ("printed", FirstLevel::Printed),
        ("improved", FirstLevel::Improved),
    ];
    for (name, rule) in rules {
        if let Some(Some(expected)) = case.first_level.get(name) {
            let found = first_level::rows(&spokes, rule).unwrap();
            let error = matrix_difference(&found, expected);
            assert!(error < 1e-12, "{label} {name} {error:e}");
        } else {
            assert!(
                !case.eigen_polyhedron.in_domain && rule.needs_polyhedron(),
                "{label} {name}"
            );
        }
    }
}

#[test]
fn local_rules_are_those_of_the_prototype() {
    let cases = cases();
    assert!(cases.local.len() >= 8);
    cases.local.iter().for_each(check);
}
