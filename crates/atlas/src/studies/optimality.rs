//! Proofs that tuned stencils are the best of all at their lambda.
//!
//! A search finds local minima; that none was missed is proven by covering all admissible stencils with boxes
//! ([`eigenring_certify::optimum`]). Here the stencils of the tables at lambda_C*, and those tuned there
//! without the weight, are taken one by one.

use crate::error::Error;
use crate::progress::{Progress, each};
use crate::table::{Format, Record, Table};
use eigenring_certify::optimum::{Limits, Problem, Proof};
use eigenring_scheme::lambda::LambdaTable;
use eigenring_tune::objective::Settings;
use eigenring_tune::sweep::{Options, sample};

/// A tuned stencil, and what it was tuned for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuned {
    /// The valence.
    pub valence: usize,
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// `mu / lambda^2`.
    pub s: f64,
    /// f2 and f3.
    pub stencil: [f64; 2],
    /// Whether the objective has its weight.
    pub weighted: bool,
    /// The relative margin of the eigenvalues' bounds.
    pub margin: f64,
}

/// Relative tolerance, where none is asked for.
pub const EPSILON: f64 = 1e-6;

/// The most boxes of one of the [`Problem::PARTS`] parts, ten times what the largest valences that were
/// decided need in all: a part that cannot be decided is given up after some minutes.
const LIMITS: Limits = Limits {
    width: 1e-7,
    boxes: 20_000,
};

/// Proves for each stencil that no admissible one is better by more than `epsilon` of its objective.
///
/// # Errors
/// Those of [`Problem::new`] and [`Problem::prove_part`].
pub fn prove(tuned: &[Tuned], epsilon: f64, progress: &dyn Progress) -> Result<Vec<Proof>, Error> {
    let problem = |t: &Tuned| Problem::new(t.valence, t.lambda, t.s, t.weighted, t.margin);
    let problems = tuned.iter().map(problem).collect::<Result<Vec<_>, _>>()?;
    let parts: Vec<(usize, usize)> = (0..tuned.len())
        .flat_map(|index| (0..Problem::PARTS).map(move |part| (index, part)))
        .collect();
    let proofs = each(progress, "parts of the plane", &parts, |&(index, part)| {
        problems[index].prove_part(part, tuned[index].stencil, epsilon, LIMITS)
    })?;
    let whole = |parts: &[Proof]| parts.iter().cloned().reduce(Proof::and);
    Ok(proofs.chunks(Problem::PARTS).filter_map(whole).collect())
}

/// A row for each stencil: what it is, and what was shown of it.
pub fn table(tuned: &[Tuned], proofs: &[Proof], epsilon: f64) -> Table {
    let mut table = Table::new([
        "valence",
        "weighted",
        "lambda",
        "s",
        "f2",
        "f3",
        "E",
        "epsilon",
        "status",
        "bound",
        "boxes",
        "excluded",
        "undecided",
    ]);
    for (tuned, proof) in tuned.iter().zip(proofs) {
        table.push(vec![
            tuned.valence.into(),
            usize::from(tuned.weighted).into(),
            tuned.lambda.into(),
            tuned.s.into(),
            tuned.stencil[0].into(),
            tuned.stencil[1].into(),
            // the middle of the enclosure
            (0.5 * (proof.value[0] + proof.value[1])).into(),
            epsilon.into(),
            proof.status().to_string().into(),
            proof.bound.into(),
            (proof.boxes as usize).into(),
            (proof.excluded as usize).into(),
            (proof.undecided as usize).into(),
        ]);
    }
    table
}

/// A tuned stencil's record with what was proven of it.
#[must_use]
pub fn with_proof(record: Record, proof: &Proof, epsilon: f64) -> Record {
    let better = proof.better.map(|[f2, f3]| format!("f2 = {f2}, f3 = {f3}"));
    record
        .with("global_minimum", proof.status().to_string())
        .with("global_epsilon", epsilon)
        .with("global_bound", proof.bound)
        .with("boxes", proof.boxes as usize)
        .with("undecided_boxes", proof.undecided as usize)
        .with("better", better)
}

/// The tabulated valences, from the first with a plane of stencils on.
const VALENCES: std::ops::RangeInclusive<usize> = 5..=20;

/// The stencils at lambda_C*, with and without the weight.
fn subjects() -> Result<Vec<Tuned>, Error> {
    let mut subjects = Vec::new();
    for weighted in [true, false] {
        for valence in VALENCES {
            let settings = Settings {
                weighted,
                ..Settings::default()
            };
            let options = Options {
                settings,
                ..Options::default()
            };
            let lambda = LambdaTable::embedded()?.entry(valence)?.lambda_optimal;
            let found = sample(valence, lambda, &options)?;
            let best = &found.minima[0];
            subjects.push(Tuned {
                valence,
                lambda,
                s: found.s,
                stencil: [best.f2, best.f3],
                weighted,
                margin: options.margin,
            });
        }
    }
    Ok(subjects)
}

pub(super) fn files(progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let subjects = subjects()?;
    let proofs = prove(&subjects, EPSILON, progress)?;
    let text = table(&subjects, &proofs, EPSILON).render(Format::Csv);
    Ok(vec![("optimality.csv".into(), text.into_bytes())])
}
