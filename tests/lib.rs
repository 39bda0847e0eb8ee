//! Shared pieces of the oracles: the reference cases, and a comparison that reports its worst entries.
//!
//! The cases under `data/` were computed once by an independent implementation in another language; they are
//! facts to be met, never inputs of the program.

pub mod oracle;

use eigenring_scheme::Complex;
use eigenring_spectral::Spectrum;
use serde::Deserialize;
use std::collections::BTreeMap;

/// An eigenvalue of a reference case, by value or by modulus.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct ReferenceEigenvalue {
    /// The real eigenvalue, or the modulus.
    #[serde(alias = "abs")]
    pub value: f64,
    /// The Fourier index `k <= N/2`; blocks k and N-k are listed once.
    pub fourier: usize,
}

/// A stencil of the lambda-scheme with what follows from it.
#[derive(Clone, Debug, Deserialize)]
#[allow(missing_docs)] // the names are those of the paper and of `Plane`
pub struct LambdaCase {
    pub valence: usize,
    #[serde(rename = "lam")]
    pub lambda: f64,
    pub s: f64,
    pub mu: f64,
    pub f2: f64,
    pub f3: f64,
    pub lambda_l: f64,
    pub stencil: BTreeMap<String, f64>,
    pub one_ring_spectrum: Vec<ReferenceEigenvalue>,
    pub corner_radius: f64,
}

/// The leading eigenvalues of one level of the generalised tension scheme.
#[derive(Clone, Debug, Deserialize)]
pub struct TensionCase {
    /// The order k.
    pub order: usize,
    /// The valence N.
    pub valence: usize,
    /// The tension of this level.
    pub u: f64,
    /// The largest moduli on the smallest closed rings, falling.
    pub leading: Vec<ReferenceEigenvalue>,
}

/// The cases of `data/lambda_scheme_cases.json`.
pub fn lambda_cases() -> Vec<LambdaCase> {
    serde_json::from_str(include_str!("data/lambda_scheme_cases.json")).expect("the committed file is a list of cases")
}

/// The cases of `data/tension_scheme_cases.json`.
pub fn tension_cases() -> Vec<TensionCase> {
    serde_json::from_str(include_str!("data/tension_scheme_cases.json")).expect("the committed file is a list of cases")
}

/// The eigenvalues block by block, `k = 0 .. N/2`, each as often as it is an eigenvalue of **its block**, by
/// falling modulus.
pub fn by_block(spectrum: &Spectrum, valence: usize) -> Vec<(Complex<f64>, usize)> {
    let in_block = |fourier: usize| if fourier == 0 || 2 * fourier == valence { 1 } else { 2 };
    let repeated = spectrum.eigenvalues.iter().flat_map(|e| {
        let fourier = e.fourier.expect("a rotation-symmetric scheme has Fourier indices");
        std::iter::repeat_n((e.value, fourier), e.multiplicity / in_block(fourier))
    });
    repeated.collect()
}

/// Compares many numbers with what they should be, and panics at the end with the worst of those that differ.
#[derive(Debug)]
pub struct Comparison {
    what: &'static str,
    tolerance: f64,
    count: usize,
    failures: Vec<(f64, String)>,
}

impl Comparison {
    /// A comparison with an absolute tolerance.
    pub fn new(what: &'static str, tolerance: f64) -> Self {
        Comparison {
            what,
            tolerance,
            count: 0,
            failures: Vec::new(),
        }
    }

    /// Compares one number. A NaN differs from everything.
    pub fn check(&mut self, label: impl std::fmt::Display, found: f64, expected: f64) {
        self.count += 1;
        let error = (found - expected).abs();
        if error > self.tolerance || error.is_nan() {
            let text = format!("{label}: {found:.17e}, expected {expected:.17e}, difference {error:.1e}");
            self.failures
                .push((if error.is_nan() { f64::INFINITY } else { error }, text));
        }
    }

    /// How many numbers were compared.
    pub fn count(&self) -> usize {
        self.count
    }

    /// # Panics
    /// If a number differed, or if none was compared.
    pub fn finish(mut self) {
        assert!(self.count > 0, "{}: nothing was compared", self.what);
        if self.failures.is_empty() {
            return;
        }
        self.failures.sort_by(|a, b| b.0.total_cmp(&a.0));
        let worst: Vec<&str> = self.failures.iter().take(10).map(|(_, text)| text.as_str()).collect();
        panic!(
            "{}: {} of {} numbers differ by more than {:e}; the worst (left: new value):\n{}",
            self.what,
            self.failures.len(),
            self.count,
            self.tolerance,
            worst.join("\n")
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comparison_within_tolerance_passes() {
        let mut comparison = Comparison::new("near", 1e-3);
        comparison.check("a", 1.0, 1.0005);
        comparison.finish();
    }

    #[test]
    #[should_panic(expected = "2 of 3 numbers differ")]
    fn differences_and_nan_are_reported() {
        let mut comparison = Comparison::new("far", 1e-3);
        comparison.check("a", 1.0, 1.0);
        comparison.check("b", 1.0, 1.1);
        comparison.check("c", f64::NAN, 1.0);
        comparison.finish();
    }

    #[test]
    #[should_panic(expected = "nothing was compared")]
    fn an_empty_comparison_fails() {
        Comparison::new("none", 1.0).finish();
    }
}
