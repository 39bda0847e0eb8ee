//! One valence from samples to spline stencils: everything that is tabulated.
//!
//! The steps of Ma, Wang and Ma (2023, section 4) in order: the global optimum over lambda, the branch of
//! tuned stencils through it, the triple knots, the splines of f3 and f2, and the featured values of lambda.
//! A [`Study`] is plain data; whatever it claims about its splines ([`Accuracy`]) is measured on the splines
//! themselves, at lambdas other than those at which the fit imposed its bounds.

mod admissible;
mod fine;
mod recommended;
mod sharp;

pub use eigenring_scheme::lambda::{LAMBDA_A, LAMBDA_M, LAMBDA_R1};
pub use fine::ENOUGH;
pub use recommended::second_ring_convexity;

use crate::global::{Global, global};
use crate::objective::Objective;
use crate::spline::{self, FitError, Slot, Source, StencilFit, StencilSample, fit_stencils};
use crate::sweep::{self, BranchSample, LambdaSample, Options, Range, branch};
use admissible::Admissible;
use eigenring_scheme::lambda::{LambdaEntry, LambdaKnots, PAPER_TABLE_1, PaperRow, Relaxation};
use fine::Fine;
use serde::{Deserialize, Serialize};
use sharp::Sharp;

/// The relative margin with which the splines keep within the eigenvalue bounds: half of that of the samples,
/// so that a spline may pass between them.
pub const SPLINE_MARGIN: f64 = 1e-6;

/// Lambdas in equal steps, besides the samples and the kinks of s, at which the splines' bounds are imposed
/// first. Between them a spline may pass a bound; see [`fit_feasible`].
const DENSE: usize = 2000;

/// The splines are checked on steps this many times shorter.
const FINER: usize = 8;

/// A bound missed by less than this is met: rounding of f2 and f3.
const MET: f64 = 1e-12;

/// Rounds of imposing bounds where they were missed; two to four are usual, as each shortens the steps there
/// and the miss is quadratic in the step.
const ROUNDS: usize = 12;

/// Coefficients below this are zero: where a bound f3 >= 0 holds over an interval, the exact coefficients
/// vanish, and the fit's are rounding errors.
const ZERO: f64 = 1e-13;

/// Which triple knots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Knots {
    /// Found from the samples: kinks of s and changes of the active bounds.
    #[default]
    Detected,
    /// Those of the paper's Table 1, where it has the valence.
    Paper,
    /// Those candidates, and that fit, with which the objective of the splines exceeds that of the samples
    /// least: the maximum of `E/E_sample - 1` instead of the squares of distances in f2 and f3.
    Sharp,
    /// The detected ones, with more single knots where the splines lose more than [`ENOUGH`].
    Fine,
}

/// The tabulated results of one valence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// The valence.
    pub valence: usize,
    /// The smallest lambda with bounded curvature.
    pub lambda_l: f64,
    /// The minima over lambda; the first is lambda_C*.
    pub global: Global,
    /// The branch through the global optimum, at the sample lambdas.
    pub samples: Vec<BranchSample>,
    /// The triple knots.
    pub knots: KnotTable,
    /// The spline of f2.
    pub f2: SplineTable,
    /// The spline of f3; at N = 4 only an approximation of mu.
    pub f3: SplineTable,
    /// The featured lambdas with the splines' stencils there.
    pub featured: Vec<Featured>,
    /// How well the splines stand for the samples.
    pub accuracy: Accuracy,
}

/// The knots and how they were found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KnotTable {
    /// Detected or the paper's.
    pub source: Knots,
    /// The knots.
    pub values: LambdaKnots,
    /// Whether b, c, d are kinks; where they are not, the splines are twice differentiable.
    pub kinks: [bool; 3],
    /// All candidates.
    pub candidates: Vec<KnotCandidate>,
}

/// A possible kink.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KnotCandidate {
    /// The subdominant eigenvalue at which it is so.
    pub lambda: f64,
    /// "b" or "d".
    pub slot: String,
    /// "active_set", "relaxation" or "default".
    pub source: String,
    /// Root mean square residual of an unconstrained fit with the best partner; none if too few samples lie
    /// between.
    pub residual: Option<f64>,
}

/// A fitted spline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SplineTable {
    /// The coefficients: 17 but with finer knots.
    pub coefficients: Vec<f64>,
    /// Largest distance from a sample.
    pub max_residual: f64,
    /// The lambda of that sample.
    pub worst_sample: f64,
    /// Largest defect of the optimality conditions of the constrained least-squares problem.
    pub kkt: f64,
    /// Bounds that carry the optimum.
    pub active_bounds: usize,
}

/// A featured lambda.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Featured {
    /// The name in the paper's Table 1: lambda_r1, lambda_b, lambda_A, lambda_l, lambda_M, lambda_CC,
    /// lambda_d, lambda_C, lambda_r2.
    pub name: String,
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// The value in the paper, if it has the valence.
    pub paper: Option<f64>,
    /// The spline's f2 there.
    pub f2: f64,
    /// The spline's f3 there (N = 4: mu).
    pub f3: f64,
    /// The objective there.
    pub total: f64,
}

/// What the splines lose against the samples, and how far they stay from the bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Largest `|f2 - sample|` for lambda in the recommended region.
    pub f2: f64,
    /// Largest `|f3 - sample|` for lambda in the recommended region.
    pub f3: f64,
    /// Largest `E / E_sample - 1` in the recommended region, over samples with `E_sample` above [`TINY`].
    pub excess: f64,
    /// The lambda of that sample.
    pub excess_at: f64,
    /// Largest `E / E_sample - 1` over all samples with `E_sample` above [`TINY`].
    pub excess_overall: f64,
    /// Smallest `1 - |lambda_6| / mu` over 16000 lambdas in equal steps, the samples and the kinks of s.
    pub strictness: f64,
    /// Smallest slack of all constraints over the same lambdas, with the margin of [`SPLINE_MARGIN`]:
    /// negative only by rounding.
    pub slack: f64,
    /// The lambda of the smallest slack.
    pub slack_at: f64,
}

/// E near a quadratic precision of rounding: a ratio to it means nothing (N = 4, lambda = 1/2).
pub const TINY: f64 = 1e-9;

/// Why a study fails.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A sample, the global optimum or the branch.
    #[error(transparent)]
    Sweep(#[from] sweep::Error),
    /// The splines.
    #[error("valence {valence}: {source}")]
    Fit {
        /// The valence.
        valence: usize,
        /// What is wrong.
        source: FitError,
    },
    /// The scheme's own closed forms.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// The natural configuration.
    #[error(transparent)]
    Spectral(#[from] eigenring_spectral::Error),
    /// The objective at a spline's stencil.
    #[error(transparent)]
    Objective(#[from] crate::objective::Error),
}

/// The row of the paper's Table 1.
pub fn paper_row(valence: usize) -> Option<&'static PaperRow> {
    PAPER_TABLE_1.iter().find(|row| row.valence == valence)
}

/// The subdominant eigenvalue of Catmull-Clark subdivision: `(5 + c + sqrt((c+9)(c+1)))/16`, `c = cos(2
/// pi/N)`.
pub fn lambda_catmull_clark(valence: usize) -> f64 {
    let c = (std::f64::consts::TAU / valence as f64).cos();
    (5.0 + c + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0
}

impl Study {
    /// Everything that follows from the samples of one valence, which must be those of `range`, ascending in
    /// lambda, computed with the same options.
    ///
    /// # Errors
    /// Those of the steps.
    pub fn new(samples: &[LambdaSample], range: &Range, options: &Options, knots: Knots) -> Result<Self, Error> {
        let global = global(samples, options)?;
        let optimum = global.optimum();
        let (valence, best) = (global.valence, &optimum.minimum);
        let samples = branch(samples, optimum.lambda, best.f2, best.f3, options)?;
        let relaxation = Relaxation::new(valence)?;
        let lambda_l = relaxation.lambda_l();
        let failed = |source| Error::Fit { valence, source };

        let interpolated = (optimum.lambda, best.f2, best.f3);
        let labelled = label(&samples);
        let (values, kinks, candidates) =
            choose(&labelled, range, &relaxation, interpolated, knots, valence).map_err(failed)?;
        let admissible = Admissible::new(relaxation, options, SPLINE_MARGIN, &samples);
        // at the kink lambda_l the sample stands for both sides; at N = 3 mu is next to the outer rings' 1/8
        // there, and E rises by orders of magnitude within the distance that a least-squares spline leaves
        let at_kink = labelled
            .iter()
            .filter(|sample| sample.lambda == lambda_l && sample.lambda != optimum.lambda);
        let fixed: Vec<(f64, f64, f64)> = std::iter::once(interpolated)
            .chain(at_kink.map(|sample| (sample.lambda, sample.f2, sample.f3)))
            .collect();
        let fit = fit_feasible(&values, kinks, &labelled, &fixed, range, &admissible).map_err(failed)?;
        let entry = |values, fit: &StencilFit| LambdaEntry {
            valence,
            knots: values,
            f2: coefficients(&fit.f2),
            f3: coefficients(&fit.f3),
            lambda_optimal: optimum.lambda,
            lambda_l,
            lambda_r1: LAMBDA_R1,
            lambda_r2: range.end,
            phi: options.phi,
        };
        let (values, kinks, fit) = if knots == Knots::Fine {
            let fine = Fine::new(valence, &samples, options)?;
            let again = |values: &LambdaKnots| fit_feasible(values, kinks, &labelled, &fixed, range, &admissible);
            let (values, fit) = fine.fit(values, fit, again, entry).map_err(failed)?;
            (values, kinks, fit)
        } else if knots == Knots::Sharp {
            let sharp = Sharp {
                samples: &samples,
                labelled: &labelled,
                fixed: &fixed,
                range,
                options,
                admissible: &admissible,
                end: recommended::end(&entry(values, &fit), range.end)?,
            };
            let free = |slot: &str, paper: fn(&PaperRow) -> f64| {
                let own = candidates.iter().filter(|c| c.slot == slot && c.residual.is_some());
                let mut lambdas: Vec<f64> = own.map(|c| c.lambda).collect();
                lambdas.extend(paper_row(valence).map(paper));
                lambdas
            };
            let [b, d] = [free("b", |row| row.lambda_b), free("d", |row| row.lambda_d)];
            let paper = |row: &PaperRow| (with_triple_knots(row.knots(), range, lambda_l), [true; 3]);
            let found = sharp.fit((values, kinks, fit), paper_row(valence).map(paper), [&b, &d]);
            (found.knots, found.kinks, found.fit)
        } else {
            (values, kinks, fit)
        };
        let [f2, f3] = [&fit.f2, &fit.f3].map(|fit| SplineTable {
            coefficients: coefficients(fit),
            max_residual: fit.max_residual,
            worst_sample: fit.worst_sample,
            kkt: fit.kkt.worst(),
            active_bounds: fit.active.len(),
        });
        let mut study = Study {
            valence,
            lambda_l,
            global,
            samples,
            knots: KnotTable {
                source: knots,
                values,
                kinks,
                candidates,
            },
            f2,
            f3,
            featured: Vec::new(),
            accuracy: Accuracy {
                f2: 0.0,
                f3: 0.0,
                excess: 0.0,
                excess_at: 0.0,
                excess_overall: 0.0,
                strictness: 0.0,
                slack: 0.0,
                slack_at: 0.0,
            },
        };
        let end = recommended::end(&study.entry(options.phi, range.end), range.end)?;
        let entry = study.entry(options.phi, end);
        study.featured = study.feature(&entry, options)?;
        study.accuracy = study.measure(&entry, range, options)?;
        Ok(study)
    }

    /// The entry of the embedded table.
    pub fn entry(&self, phi: f64, lambda_r2: f64) -> LambdaEntry {
        LambdaEntry {
            valence: self.valence,
            knots: self.knots.values,
            f2: self.f2.coefficients.clone(),
            f3: self.f3.coefficients.clone(),
            lambda_optimal: self.global.optimum().lambda,
            lambda_l: self.lambda_l,
            lambda_r1: LAMBDA_R1,
            lambda_r2,
            phi,
        }
    }

    /// The value of a featured lambda.
    pub fn featured(&self, name: &str) -> Option<&Featured> {
        self.featured.iter().find(|featured| featured.name == name)
    }

    fn feature(&self, entry: &LambdaEntry, options: &Options) -> Result<Vec<Featured>, Error> {
        let paper = paper_row(self.valence);
        let column = |get: fn(&PaperRow) -> f64| paper.map(get);
        let knots = &self.knots.values;
        [
            ("lambda_r1", LAMBDA_R1, column(|row| row.lambda_r1)),
            ("lambda_b", knots.b, column(|row| row.lambda_b)),
            ("lambda_A", LAMBDA_A, column(|row| row.lambda_a_star)),
            ("lambda_l", self.lambda_l, column(|row| row.lambda_l)),
            ("lambda_M", LAMBDA_M, column(|row| row.lambda_m_star)),
            (
                "lambda_CC",
                lambda_catmull_clark(self.valence),
                column(|row| row.lambda_cc),
            ),
            ("lambda_d", knots.d, column(|row| row.lambda_d)),
            ("lambda_C", entry.lambda_optimal, column(|row| row.lambda_c_star)),
            ("lambda_r2", entry.lambda_r2, column(|row| row.lambda_r2)),
        ]
        .into_iter()
        .filter(|&(_, lambda, _)| (knots.a..=knots.e).contains(&lambda))
        .map(|(name, lambda, paper)| {
            let (f2, f3) = entry.weights(lambda)?;
            Ok(Featured {
                name: name.to_owned(),
                lambda,
                paper,
                f2,
                f3,
                total: objective(self.valence, lambda, options)?.value(f2, f3)?,
            })
        })
        .collect()
    }

    fn measure(&self, entry: &LambdaEntry, range: &Range, options: &Options) -> Result<Accuracy, Error> {
        let relaxation = Relaxation::new(self.valence)?;
        let mut accuracy = Accuracy {
            f2: 0.0,
            f3: 0.0,
            excess: 0.0,
            excess_at: LAMBDA_R1,
            excess_overall: 0.0,
            strictness: f64::INFINITY,
            slack: f64::INFINITY,
            slack_at: range.start,
        };
        for sample in &self.samples {
            let (f2, f3) = entry.weights(sample.lambda)?;
            let total = objective(self.valence, sample.lambda, options)?.value(f2, f3)?;
            let excess = if sample.minimum.total > TINY {
                total / sample.minimum.total - 1.0
            } else {
                0.0
            };
            accuracy.excess_overall = accuracy.excess_overall.max(excess);
            if (entry.lambda_r1..=entry.lambda_r2).contains(&sample.lambda) {
                accuracy.f2 = accuracy.f2.max((f2 - sample.minimum.f2).abs());
                accuracy.f3 = accuracy.f3.max((f3 - sample.minimum.f3).abs());
                if excess > accuracy.excess {
                    (accuracy.excess, accuracy.excess_at) = (excess, sample.lambda);
                }
            }
        }
        let lambdas = steps(range, &relaxation, FINER * (DENSE - 1));
        for lambda in lambdas
            .into_iter()
            .chain(self.samples.iter().map(|sample| sample.lambda))
        {
            let (f2, f3) = entry.weights(lambda)?;
            let mut plane = relaxation.plane(lambda)?;
            plane.phi = options.phi;
            for (constraint, slack) in plane.slack(options.bounds, SPLINE_MARGIN, f2, f3) {
                // the slack of an eigenvalue bound is (1 - margin) mu - |eigenvalue|
                if constraint.is_eigenvalue_bound() {
                    accuracy.strictness = accuracy.strictness.min(slack / plane.mu() + SPLINE_MARGIN);
                }
                if slack < accuracy.slack {
                    (accuracy.slack, accuracy.slack_at) = (slack, lambda);
                }
            }
        }
        Ok(accuracy)
    }
}

fn coefficients(fit: &spline::Fit) -> Vec<f64> {
    let rounded = |&coefficient: &f64| if coefficient.abs() < ZERO { 0.0 } else { coefficient };
    fit.spline.coefficients().iter().map(rounded).collect()
}

fn objective(valence: usize, lambda: f64, options: &Options) -> Result<Objective, Error> {
    let mut plane = Relaxation::new(valence)?.plane(lambda)?;
    plane.phi = options.phi;
    Ok(Objective::new(plane, options.settings)?)
}

/// The range in equal steps, and the kinks of s in it.
fn steps(range: &Range, relaxation: &Relaxation, count: usize) -> Vec<f64> {
    let at = |i: usize| {
        if i == count {
            range.end
        } else {
            range.start + (range.end - range.start) * i as f64 / count as f64
        }
    };
    let inside = |lambda: &f64| (range.start..=range.end).contains(lambda);
    let mut lambdas: Vec<f64> = (0..=count)
        .map(at)
        .chain(relaxation.kinks().into_iter().filter(inside))
        .collect();
    lambdas.sort_by(f64::total_cmp);
    lambdas.dedup();
    lambdas
}

/// Fits with bounds at every lambda of a fine grid, though only those at a coarser one and at those that were
/// missed are imposed: the exchange method of semi-infinite programming.
fn fit_feasible(
    knots: &LambdaKnots,
    kinks: [bool; 3],
    samples: &[StencilSample],
    fixed: &[(f64, f64, f64)],
    range: &Range,
    admissible: &Admissible<'_>,
) -> Result<StencilFit, FitError> {
    let fine = steps(range, admissible.relaxation(), FINER * (DENSE - 1));
    let mut imposed = steps(range, admissible.relaxation(), DENSE - 1);
    for _ in 1..ROUNDS {
        let fit = fit_stencils(knots, kinks, samples, fixed, &imposed, admissible)?;
        let at = |fit: &spline::Fit, lambda| fit.spline.value(lambda).unwrap_or(f64::NAN);
        let slack = |&lambda: &f64| admissible.slack(lambda, at(&fit.f2, lambda), at(&fit.f3, lambda));
        let slacks: Vec<f64> = fine.iter().map(slack).collect();
        // the worst lambda of each run of missing ones, and every other one, to close gaps quickly
        let worst = |i: usize| {
            let next = (i + 1).min(slacks.len() - 1);
            slacks[i] <= slacks[i.saturating_sub(1)] && slacks[i] <= slacks[next]
        };
        let added: Vec<f64> = (0..fine.len())
            .filter(|&i| slacks[i] < -MET && (worst(i) || i % 2 == 0) && !imposed.contains(&fine[i]))
            .map(|i| fine[i])
            .collect();
        if added.is_empty() {
            return Ok(fit);
        }
        imposed.extend(added);
        imposed.sort_by(f64::total_cmp);
    }
    fit_stencils(knots, kinks, samples, fixed, &fine, admissible)
}

/// The samples with their sets of active bounds as labels: one number for each set, in order of appearance.
fn label(samples: &[BranchSample]) -> Vec<StencilSample> {
    let mut sets: Vec<&Vec<String>> = Vec::new();
    let mut labelled = Vec::with_capacity(samples.len());
    for sample in samples {
        let set = &sample.minimum.active;
        let index = sets.iter().position(|known| *known == set).unwrap_or_else(|| {
            sets.push(set);
            sets.len() - 1
        });
        labelled.push(StencilSample {
            lambda: sample.lambda,
            f2: sample.minimum.f2,
            f3: sample.minimum.f3,
            active: index as u32,
            weights: [1.0; 2],
        });
    }
    labelled
}

/// The triple knots b and d of `knots` in a range, with the exact lambda_l.
fn with_triple_knots(knots: LambdaKnots, range: &Range, lambda_l: f64) -> LambdaKnots {
    LambdaKnots {
        a: range.start,
        c: lambda_l,
        e: range.end,
        ..knots
    }
}

type Choice = (LambdaKnots, [bool; 3], Vec<KnotCandidate>);

fn choose(
    samples: &[StencilSample],
    range: &Range,
    relaxation: &Relaxation,
    optimum: (f64, f64, f64),
    knots: Knots,
    valence: usize,
) -> Result<Choice, FitError> {
    let inside = |lambda: &f64| range.start < *lambda && *lambda < range.end;
    let kinks: Vec<f64> = relaxation.kinks().into_iter().filter(inside).collect();
    let ends = (range.start, range.end);
    let choice = spline::choose_knots(samples, ends, relaxation.lambda_l(), optimum, &kinks)?;
    let candidates = choice
        .candidates
        .iter()
        .map(|candidate| KnotCandidate {
            lambda: candidate.lambda,
            slot: match candidate.slot {
                Slot::B => "b",
                Slot::D => "d",
                Slot::Any => "b, c or d",
            }
            .to_owned(),
            source: match candidate.source {
                Source::ActiveSet { .. } => "active_set",
                Source::Analytic => "relaxation",
                Source::Default => "default",
            }
            .to_owned(),
            residual: candidate.residual,
        })
        .collect();
    Ok(match paper_row(valence).filter(|_| knots == Knots::Paper) {
        // the printed digits of lambda_c are replaced by the exact value; every tabulated knot may be a kink
        Some(row) => {
            let values = with_triple_knots(row.knots(), range, relaxation.lambda_l());
            (values, [true; 3], candidates)
        }
        None => (choice.knots, choice.kinks, candidates),
    })
}
