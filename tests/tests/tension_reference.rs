//! **Claim**: the generalised tension scheme (Fang, Ma and Wang) of even and odd order has the spectra that
//! its rules imply. **Oracles**: `data/tension_scheme_cases.json`, even orders by an independent
//! implementation; odd moduli of another one, for the rule that a smoothed point is the mean of the centroids
//! of its four faces; order 3 in closed form.

use eigenring_scheme::families::tension;
use eigenring_spectral::LocalSystem;
use eigenring_tests::{Comparison, by_block, tension_cases};

/// Moduli with Fourier indices of the first level, on the smallest closed rings, falling.
fn moduli(valence: usize, order: usize, u: f64) -> Vec<(f64, usize)> {
    let scheme = tension::<f64>(valence, order, u).unwrap();
    let rings = scheme.closed_rings().unwrap();
    let spectrum = LocalSystem::new(scheme.level(0), rings).unwrap().spectrum().unwrap();
    let values = by_block(&spectrum, valence).into_iter();
    values.map(|(value, k)| (value.modulus(), k)).collect()
}

#[test]
fn even_orders() {
    const TOLERANCE: f64 = 1e-9;
    let mut comparison = Comparison::new("leading moduli of even orders", TOLERANCE);
    let cases = tension_cases();
    assert_eq!(cases.len(), 7);
    for case in cases {
        let mut left = moduli(case.valence, case.order, case.u);
        let label = format!("k = {}, N = {}, u = {}", case.order, case.valence, case.u);
        assert!(left.len() >= case.leading.len(), "{label}: too few eigenvalues");
        for (rank, expected) in case.leading.iter().enumerate() {
            comparison.check(format!("{label}, rank {rank}"), left[rank].0, expected.value);
        }
        // the same moduli in the same blocks; where several blocks share a modulus their order is of no
        // meaning
        for expected in &case.leading {
            let same =
                |&(modulus, k): &(f64, usize)| k == expected.fourier && (modulus - expected.value).abs() <= TOLERANCE;
            let position = left.iter().position(same);
            let position = position.unwrap_or_else(|| panic!("{label}: {expected:?} is not among {left:?}"));
            left.remove(position);
        }
    }
    comparison.finish();
}

/// Subdominant and next modulus at u = 1, to the ten digits that are known.
#[test]
fn order_five() {
    let mut comparison = Comparison::new("moduli of order 5", 6e-11);
    for (valence, subdominant, next) in [
        (3, 0.388_751_107_7, 0.25),
        (5, 0.573_639_665_0, 0.332_239_777_6),
        (6, 0.620_505_400_0, 0.404_840_326_9),
    ] {
        let moduli = moduli(valence, 5, 1.0);
        assert_eq!(moduli[0].1, 0);
        assert_eq!(moduli[1].1, 1, "N = {valence}: the subdominant eigenvalue has index 1");
        comparison.check(format!("N = {valence}, dominant"), moduli[0].0, 1.0);
        comparison.check(format!("N = {valence}, subdominant"), moduli[1].0, subdominant);
        comparison.check(format!("N = {valence}, next"), moduli[2].0, next);
    }
    comparison.finish();
}

/// `ev_m = u (N u + 2N - 4 + 4 c_m) / (N (1+u)^2)`, m >= 1: the corner stencil's discrete Fourier transform.
#[test]
fn order_three() {
    let closed_form = |n: usize, u: f64, m: usize| {
        let (n, c) = (n as f64, (std::f64::consts::TAU * m as f64 / n as f64).cos());
        u * (n * u + 2.0 * n - 4.0 + 4.0 * c) / (n * (1.0 + u) * (1.0 + u))
    };
    let mut comparison = Comparison::new("eigenvalues of order 3", 1e-14);
    for n in 3..=20 {
        for u in [0.2, 1.0, 3.0] {
            let ours = moduli(n, 3, u);
            assert_eq!(ours.len(), n / 2 + 1);
            for (modulus, k) in ours {
                let expected = if k == 0 { 1.0 } else { closed_form(n, u, k) };
                comparison.check(format!("N = {n}, u = {u}, k = {k}"), modulus, expected);
            }
        }
    }
    comparison.finish();

    let mut printed = Comparison::new("subdominant eigenvalues of order 3 at u = 1, four digits", 5e-5);
    for (n, lambda) in [(3, 0.25), (4, 0.5), (5, 0.6118), (6, 0.6667)] {
        printed.check(format!("N = {n}"), moduli(n, 3, 1.0)[1].0, lambda);
    }
    printed.finish();
}
