//! **Claim**: lambda_l and lambda_CC of Ma, Wang and Ma (2023), Table 1, follow from the mathematics alone.
//! **Oracle**: the printed table (`PAPER_TABLE_1`; the rows N = 7, 11, 13, 18 are missing in the text it was
//! taken from), and for every N = 3..=20 the closed form of Catmull-Clark's subdominant eigenvalue against
//! the spectrum of its local matrix.
//!
//! The other columns: lambda_C* is compared with the embedded table (`embedded_table.rs`); lambda_r1,
//! lambda_A*, lambda_M* are choices, and lambda_b, lambda_d positions of knots, with nothing to derive them
//! from.

use eigenring_scheme::families::catmull_clark;
use eigenring_scheme::lambda::{PAPER_TABLE_1, Relaxation};
use eigenring_spectral::LocalSystem;
use eigenring_tests::Comparison;

/// Four printed digits; the last bits are for values that lie half way.
const PRINTED: f64 = 5e-5 + 1e-12;

fn spectrum_lambda(valence: usize) -> f64 {
    let scheme = catmull_clark::<f64>(valence).unwrap();
    let rings = scheme.closed_rings().unwrap();
    let spectrum = LocalSystem::new(scheme.limit(), rings).unwrap().spectrum().unwrap();
    let subdominant = spectrum.subdominant().unwrap();
    assert_eq!((subdominant.fourier, subdominant.multiplicity), (Some(1), 2));
    subdominant.value.re
}

#[test]
fn printed_digits() {
    let mut comparison = Comparison::new("columns of Table 1", PRINTED);
    for row in PAPER_TABLE_1 {
        let n = row.valence;
        let lambda_l = Relaxation::new(n).unwrap().lambda_l();
        comparison.check(format!("N = {n}, lambda_l"), lambda_l, row.lambda_l);
        comparison.check(format!("N = {n}, lambda_CC"), spectrum_lambda(n), row.lambda_cc);
    }
    assert_eq!(comparison.count(), 28);
    comparison.finish();
}

/// E. Catmull and J. Clark (1978): `lambda = (c + 5 + sqrt((c+9)(c+1)))/16`, `c = cos(2 pi/N)`.
#[test]
fn catmull_clark_in_closed_form() {
    let mut comparison = Comparison::new("lambda_CC", 1e-14);
    for n in 3..=20 {
        let c = (std::f64::consts::TAU / n as f64).cos();
        let closed_form = (c + 5.0 + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0;
        comparison.check(format!("N = {n}"), spectrum_lambda(n), closed_form);
    }
    comparison.finish();
}

/// Eq. 23: lambda_l is where s_l first reaches 1: just below s_l > 1, from there on s_l = 1 exactly.
#[test]
fn lambda_l_is_where_curvature_becomes_bounded() {
    for n in 3..=20 {
        let relaxation = Relaxation::new(n).unwrap();
        let lambda_l = relaxation.lambda_l();
        let s_l = |lambda: f64| relaxation.s_lower(lambda).unwrap();
        assert!(s_l(lambda_l - 1e-9) > 1.0, "N = {n}: {}", s_l(lambda_l - 1e-9));
        assert_eq!(s_l(lambda_l + 1e-9), 1.0, "N = {n}");
        // the addition ds has ended at lambda_l + 0.01
        assert_eq!(relaxation.s(lambda_l + 0.010_001).unwrap(), 1.0, "N = {n}");
    }
}
