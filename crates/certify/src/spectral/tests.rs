use super::*;
use crate::find;
use eigenring_scheme::{Complex, FourierNet, Spec};
use eigenring_spectral::LocalSystem;

fn spectrum(spec: &str, valence: usize) -> EnclosedSpectrum {
    let spec: Spec = spec.parse().unwrap();
    let input = Input::from_spec(&spec, valence).unwrap();
    let problem = problem_of(&input, valence).unwrap().unwrap();
    let evidence = find::evidence(&problem.blocks);
    EnclosedSpectrum::new(problem, &evidence)
}

/// Every eigenvalue found by QR iterations is accounted for, with its multiplicity.
#[test]
fn spectra_agree_with_those_in_doubles() {
    for spec in [
        "catmull-clark",
        "doo-sabin",
        "lambda:optimal",
        "lambda:lambda=0.3",
        "tension:order=5",
        "tension:order=6",
    ] {
        for valence in [3, 4, 5, 6, 9, 12] {
            let found = spectrum(spec, valence);
            let scheme = spec.parse::<Spec>().unwrap().scheme::<f64>(valence).unwrap();
            let system = LocalSystem::new(scheme.limit(), found.patches.numbering().rings).unwrap();
            for (index, block) in system.blocks().iter().enumerate() {
                let entries = || found.entries.iter().filter(|entry| entry.index == index);
                let bounds = found.bounds.iter().filter(|bound| bound.index == index);
                let count = entries().count() + bounds.clone().map(|bound| bound.count).sum::<usize>();
                assert_eq!(
                    count + usize::from(index == 0),
                    block.size(),
                    "{spec} {valence} {index}"
                );
                for value in block.eigenvalues().unwrap() {
                    let near = |entry: &EnclosedEigenvalue| {
                        let inflated = |x: Interval| x + Interval::around(0.0, 1e-12);
                        inflated(entry.value.re).contains(value.value.re)
                            && inflated(entry.value.im).contains(value.value.im)
                    };
                    let one = index == 0 && (value.value.re - 1.0).abs() < 1e-12;
                    let bounded = bounds.clone().any(|bound| value.value.re.abs() < bound.radius);
                    assert!(
                        one || bounded || entries().any(near),
                        "{spec} {valence} {index}: {value:?}"
                    );
                }
            }
            for entry in &found.entries {
                assert!(entry.value.re.width() < 1e-12, "{spec} {valence}: {entry:?}");
            }
        }
    }
}

#[test]
fn eigenvectors_are_those_of_the_modes_and_sharp() {
    for spec in ["catmull-clark", "doo-sabin", "lambda:optimal", "tension:order=6"] {
        for valence in [3, 5, 8] {
            let found = spectrum(spec, valence);
            let scheme = spec.parse::<Spec>().unwrap().scheme::<f64>(valence).unwrap();
            let system = LocalSystem::new(scheme.limit(), found.patches.numbering().rings).unwrap();
            for index in [0, 1, 2] {
                let Some(entry) = found
                    .entries
                    .iter()
                    .filter(|entry| entry.index == index)
                    .max_by(|a, b| a.value.re.mid().total_cmp(&b.value.re.mid()))
                else {
                    continue;
                };
                // Doo-Sabin's 1/4 is also the outer ring's eigenvalue: no vector
                let Some(net) = found.net(entry, entry.value.re) else {
                    assert!(spec == "doo-sabin" && index != 1, "{spec} {valence} {index}");
                    continue;
                };
                let Ok(mode) = system.single(index, entry.value.re.mid()) else {
                    assert!(spec == "doo-sabin" && index != 1);
                    continue;
                };
                // the same up to a factor: compare where both are largest
                let pivot = (0..net.len())
                    .max_by(|&a, &b| mode.values[a].modulus().total_cmp(&mode.values[b].modulus()))
                    .unwrap();
                let at_pivot = net[pivot].map(Interval::mid);
                let ratio = at_pivot / mode.values[pivot];
                for (point, value) in net.iter().zip(&mode.values) {
                    let error = (point.map(Interval::mid) - *value * ratio).modulus();
                    assert!(error < 1e-9, "{spec} {valence} {index}: {error}");
                    assert!(
                        point.re.width() < 1e-11 * at_pivot.modulus().max(1.0),
                        "{spec} {valence} {index}: {}",
                        point.re.width()
                    );
                }
            }
        }
    }
}

#[test]
fn nets_are_spread_as_by_the_rules() {
    for spec in ["catmull-clark", "doo-sabin"] {
        let scheme = spec.parse::<Spec>().unwrap().scheme::<f64>(5).unwrap();
        let numbering = scheme.numbering(3);
        for index in [0, 1, 2] {
            let rules = FourierNet::<f64>::new(numbering, index, true).unwrap();
            let unknowns: Vec<f64> = (0..rules.size()).map(|i| (i as f64 * 0.7 + 0.3).sin()).collect();
            let pairs: Vec<Complex<f64>> = unknowns.iter().copied().map(Complex::real).collect();
            for (site, value) in numbering.sites().into_iter().zip(net(numbering, index, &unknowns, 0)) {
                let expected = rules.mode(&pairs, site).unwrap();
                assert!((value - expected).modulus() < 1e-14);
            }
        }
    }
}

#[test]
fn false_evidence_costs_sharpness_and_nothing_else() {
    let input = Input::from_spec(&"tension:order=6".parse().unwrap(), 5).unwrap();
    let problem = problem_of(&input, 5).unwrap().unwrap();
    let mut evidence = find::evidence(&problem.blocks);
    let honest = EnclosedSpectrum::new(problem.clone(), &evidence);
    for peel in evidence.iter_mut().flatten() {
        for (value, vector) in &mut peel.pairs {
            *value += 0.3;
            vector.iter_mut().for_each(|x| *x = -*x + 0.1);
        }
        if let Some(rest) = &mut peel.rest {
            rest.radius *= 0.5;
        }
    }
    let misled = EnclosedSpectrum::new(problem.clone(), &evidence);
    // what is still claimed is compatible with the truth
    let largest = |spectrum: &EnclosedSpectrum| spectrum.largest_other(&[]).unwrap().0.hi();
    assert!(largest(&misled) >= largest(&honest) * (1.0 - 1e-9));
    let none = EnclosedSpectrum::new(problem, &Vec::new());
    assert!(largest(&none) >= largest(&honest) * (1.0 - 1e-9));
}
