//! **Claim**: the stencils of the lambda-scheme, the rule for s and the one-ring spectra are those of Ma,
//! Wang and Ma (2023), Eqs. 23, 24, 27, 30, 31. **Oracle**: `data/lambda_scheme_cases.json`, thirteen
//! stencils of valences 3 to 20 computed by an independent implementation that solves for them numerically,
//! its spectra by QR on the one-ring blocks.

use eigenring_scheme::lambda::{Plane, Relaxation};
use eigenring_spectral::LocalSystem;
use eigenring_tests::{Comparison, by_block, lambda_cases};

#[test]
fn stencils() {
    let mut stencils = Comparison::new("weights of the stencils", 1e-12);
    let mut rules = Comparison::new("mu, lambda_l, s, corner radius", 1e-12);
    let cases = lambda_cases();
    assert_eq!(cases.len(), 13);
    for case in cases {
        let label = |name: &str| format!("N = {}, lambda = {}, {name}", case.valence, case.lambda);
        let plane = Plane::new(case.valence, case.lambda, case.s).unwrap();
        let stencil = plane.stencil(case.f2, case.f3);
        let extra = [("g1", stencil.g1), ("g2", stencil.g2), ("g3", stencil.g3)];
        let weights = stencil.weights.named().into_iter().chain(extra);
        let mut named = 0;
        for (name, weight) in weights {
            stencils.check(label(name), weight, case.stencil[name]);
            named += 1;
        }
        assert_eq!(named, case.stencil.len(), "every weight of the reference is compared");

        let relaxation = Relaxation::new(case.valence).unwrap();
        rules.check(label("mu"), plane.mu(), case.mu);
        rules.check(label("lambda_l"), relaxation.lambda_l(), case.lambda_l);
        rules.check(label("s"), relaxation.s(case.lambda).unwrap(), case.s);
        rules.check(
            label("corner radius"),
            plane.corner_radius(case.f2, case.f3),
            case.corner_radius,
        );
    }
    stencils.finish();
    rules.finish();
}

#[test]
fn one_ring_spectra() {
    let mut spectra = Comparison::new("eigenvalues of the one-ring matrix", 1e-10);
    for case in lambda_cases() {
        let n = case.valence;
        let stencil = Plane::new(n, case.lambda, case.s).unwrap().stencil(case.f2, case.f3);
        let scheme = stencil.weights.scheme("reference case", n).unwrap();
        let spectrum = LocalSystem::new(scheme.limit(), 1).unwrap().spectrum().unwrap();
        let ours = by_block(&spectrum, n);
        assert_eq!(ours.len(), case.one_ring_spectrum.len());
        for k in 0..=n / 2 {
            let mut found: Vec<f64> = ours.iter().filter(|e| e.1 == k).map(|e| e.0.re).collect();
            let in_block = case.one_ring_spectrum.iter().filter(|e| e.fourier == k);
            let mut expected: Vec<f64> = in_block.map(|e| e.value).collect();
            assert_eq!(found.len(), expected.len(), "N = {n}, block {k}");
            found.sort_by(f64::total_cmp);
            expected.sort_by(f64::total_cmp);
            for (found, expected) in found.into_iter().zip(expected) {
                spectra.check(format!("N = {n}, lambda = {}, block {k}", case.lambda), found, expected);
            }
        }
        assert!(
            ours.iter().all(|e| e.0.im == 0.0),
            "all eigenvalues are real in the domain"
        );
    }
    spectra.finish();
}
