//! **Claim**: eigenvalues and multiplicities of Stam's scheme of orders 11 to 32 are those of arithmetic with
//! 200 digits, the small ones and those that agree to 18 digits too. **Oracle**: `tests/data/high_orders.py`,
//! which folds, refines and smooths points in fixed-point numbers of 800 bits by code of its own and has Arb
//! find the eigenvalues; values within 1e-40 are one there.

use eigenring_scheme::families::tension;
use eigenring_spectral::{Eigenvalue, Extended, LocalSystem};

/// A value, its multiplicity.
type Known = ((f64, f64), usize);

/// `re*m`, `re+imi*m`, `re`: numbers in exponential form, so that a sign after a digit begins the imaginary
/// part.
fn known(text: &str) -> Known {
    let (value, multiplicity) = text.split_once('*').unwrap_or((text, "1"));
    let bytes = value.as_bytes();
    let split = (1..bytes.len()).find(|&i| matches!(bytes[i], b'+' | b'-') && bytes[i - 1] != b'e');
    let (re, im) = match split {
        Some(i) => (&value[..i], value[i..].trim_end_matches('i')),
        None => (value, "0"),
    };
    (
        (re.parse().unwrap(), im.parse().unwrap()),
        multiplicity.parse().unwrap(),
    )
}

/// Compares the sets that are wanted; gives how many eigenvalues are repeated, how many are complex, and how
/// close the closest ones are, relatively.
fn compare(wanted: impl Fn(usize, usize) -> bool) -> (usize, usize, f64) {
    let text = include_str!("../../../tests/data/high_orders.txt");
    let mut last = (0, 0, Vec::new());
    let (mut repeated, mut complex, mut closest) = (0, 0, f64::INFINITY);
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let (place, values) = line.split_once(':').unwrap();
        let place: Vec<usize> = place.split(' ').map(|word| word.parse().unwrap()).collect();
        let &[order, valence, index] = place.as_slice() else {
            panic!("{line}")
        };
        if !wanted(order, valence) {
            continue;
        }
        if (last.0, last.1) != (order, valence) {
            let scheme = tension::<f64>(valence, order, 1.0).unwrap();
            let system = LocalSystem::new(scheme.limit(), scheme.closed_rings().unwrap()).unwrap();
            let extended = tension::<Extended>(valence, order, 1.0).unwrap();
            let found = system.spectrum_of(extended.limit()).unwrap().eigenvalues;
            let total: usize = found.iter().map(|e| e.multiplicity).sum();
            assert_eq!(total, system.numbering().count());
            assert!(found.iter().all(|e| e.geometric <= Some(e.multiplicity)));
            last = (order, valence, found);
        }
        let copies = if index == 0 || 2 * index == valence { 1 } else { 2 };
        let mut expected: Vec<Known> = values.split_whitespace().map(known).collect();
        let mut found: Vec<&Eigenvalue> = last.2.iter().filter(|e| e.fourier == Some(index)).collect();
        expected.sort_by(|a, b| b.0.0.total_cmp(&a.0.0).then(b.0.1.total_cmp(&a.0.1)));
        found.sort_by(|a, b| {
            b.value
                .re
                .total_cmp(&a.value.re)
                .then(b.value.im.total_cmp(&a.value.im))
        });
        assert_eq!(
            found.len(),
            expected.len(),
            "order {order}, N = {valence}, block {index}"
        );
        for (e, (value, multiplicity)) in found.iter().zip(&expected) {
            let error = (e.value.re - value.0).hypot(e.value.im - value.1);
            assert!(
                error <= 1e-12 * value.0.hypot(value.1) && e.multiplicity == copies * multiplicity,
                "order {order}, N = {valence}, block {index}: {e:?}, expected {value:?} {multiplicity} times"
            );
            repeated += usize::from(*multiplicity > 1);
            complex += usize::from(value.1 != 0.0);
        }
        for pair in expected.windows(2).filter(|pair| pair[0].0.1 == 0.0) {
            closest = closest.min((pair[0].0.0 - pair[1].0.0) / pair[0].0.0);
        }
    }
    (repeated, complex, closest)
}

/// Asks for all stored sets: `scripts/high-orders.sh`.
const ALL: &str = "EIGENRING_ALL_ORDERS";

/// The time of a block grows with the sixth power of the order, to 3 s of order 32: without the variable
/// [`ALL`] only smaller ones are compared.
#[test]
fn spectra_are_those_of_many_digits() {
    let all = std::env::var_os(ALL).is_some();
    let wanted = move |order: usize, valence: usize| all || order <= 18 || valence * (order - 10) <= 50;
    let halves = std::thread::scope(|scope| {
        let half = |odd| scope.spawn(move || compare(|order, valence| valence % 2 == odd && wanted(order, valence)));
        [half(0), half(1)].map(|half| half.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    });
    let [(repeated, complex, closest), (r, c, d)] = halves;
    let (repeated, complex, closest) = (repeated + r, complex + c, closest.min(d));
    let (many, close) = if all { (200, 1e-14) } else { (100, 1e-12) };
    assert!(
        repeated > many && complex > 4 && closest < close,
        "{repeated} {complex} {closest}"
    );
}
