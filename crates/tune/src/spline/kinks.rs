//! Where the stencils have kinks, and which of them get the two free triple knots.
//!
//! The tuned f2 and f3 are smooth in lambda as long as the same bounds are active at the optimum, and s is
//! given by the same formula. Where the active set changes between two neighbouring samples a kink lies
//! between them, and both samples are candidates; the kinks of s are candidates where they are. A valence has
//! more kinks than the structure of Eq. 21 has triple knots: lambda_c is lambda_l, one goes to its left
//! (lambda_b), one to its right (lambda_d). The pair is chosen whose unconstrained least-squares splines of
//! f2 and f3 leave the smallest residual.
//!
//! Where lambda_l is beyond the range, as it is from N = 24 on with the paper's, s is smooth on all of it,
//! and lambda_c is as free as the other two: of all triples the best is chosen.
//!
//! Defaults, as in the paper's Table 1, stand in where there is no kink; there the splines stay twice
//! differentiable.

use super::error::FitError;
use super::fit::{continuity, value_row};
use super::reduce::{Factored, Row};
use super::stencils::StencilSample;
use eigenring_scheme::lambda::LambdaKnots;

/// Which knot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// lambda_b, left of lambda_l.
    B,
    /// lambda_d, right of lambda_l.
    D,
    /// Any of b, c and d, where lambda_l is beyond the range.
    Any,
}

/// Why a lambda is a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A sample next to which the set of active bounds changes.
    ActiveSet {
        /// The sample's own label.
        here: u32,
        /// The neighbour's.
        there: u32,
    },
    /// A kink of s.
    Analytic,
    /// No kink: one of the values that Table 1 of the paper uses then.
    Default,
}

/// A possible triple knot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The subdominant eigenvalue at which it is so.
    pub lambda: f64,
    /// For which knot.
    pub slot: Slot,
    /// What suggests a kink there.
    pub source: Source,
    /// Root mean square of the residuals of f2 and f3 with the best partner in the other slot; `None` if it
    /// leaves too few samples between neighbouring triple knots.
    pub residual: Option<f64>,
}

/// The chosen knots.
#[derive(Clone, Debug, PartialEq)]
pub struct KnotChoice {
    /// The knots.
    pub knots: LambdaKnots,
    /// Whether b, c, d are kinks.
    pub kinks: [bool; 3],
    /// Root mean square of the residuals.
    pub residual: f64,
    /// All candidates, those for b first, each by lambda.
    pub candidates: Vec<Candidate>,
}

/// Samples strictly between neighbouring triple knots: as many as there are coefficients that no neighbour
/// shares.
const NEEDED: usize = 3;
/// As for a fit.
const RANK_TOLERANCE: f64 = 1e-6;
const DEFAULTS: [f64; 5] = [0.2, 0.25, 0.3, 0.5, 0.55];

/// Chooses lambda_b and lambda_d, and lambda_c if lambda_l is not between the ends; see the module page.
///
/// `samples` ascend in lambda; `ends` are lambda_a and lambda_e; `optimum` = (lambda, f2, f3) is
/// interpolated; `analytic` are the kinks of s.
///
/// # Errors
/// [`FitError::NoKnots`] if no choice leaves enough samples between neighbours.
pub fn choose_knots(
    samples: &[StencilSample],
    ends: (f64, f64),
    lambda_l: f64,
    optimum: (f64, f64, f64),
    analytic: &[f64],
) -> Result<KnotChoice, FitError> {
    let enough = |left: f64, right: f64| {
        let inside = samples.iter().filter(|s| left < s.lambda && s.lambda < right);
        left < right && inside.count() >= NEEDED
    };
    let mut candidates = candidates(samples, ends, lambda_l, analytic);
    let fixed = Candidate {
        lambda: lambda_l,
        slot: Slot::Any,
        source: Source::Analytic,
        residual: None,
    };
    let inside = ends.0 < lambda_l && lambda_l < ends.1;
    let middles: Vec<(Option<usize>, Candidate)> = if inside {
        vec![(None, fixed)]
    } else {
        (candidates.iter().enumerate()).map(|(i, c)| (Some(i), *c)).collect()
    };
    let mut best: Option<KnotChoice> = None;
    for (middle, c) in middles {
        for left in 0..candidates.len() {
            let b = candidates[left];
            if !(enough(ends.0, b.lambda) && enough(b.lambda, c.lambda)) {
                continue;
            }
            for right in left + 1..candidates.len() {
                let d = candidates[right];
                if !(enough(c.lambda, d.lambda) && enough(d.lambda, ends.1)) {
                    continue;
                }
                let knots = LambdaKnots {
                    a: ends.0,
                    b: b.lambda,
                    c: c.lambda,
                    d: d.lambda,
                    e: ends.1,
                    singles: LambdaKnots::SINGLES,
                };
                let kinks = [b, c, d].map(|candidate| candidate.source != Source::Default);
                let Some(residual) = residual(&knots, kinks, samples, optimum)? else {
                    continue;
                };
                for index in [Some(left), middle, Some(right)].into_iter().flatten() {
                    let known = &mut candidates[index].residual;
                    *known = Some(known.map_or(residual, |known| known.min(residual)));
                }
                if best.as_ref().is_none_or(|best| residual < best.residual) {
                    best = Some(KnotChoice {
                        knots,
                        kinks,
                        residual,
                        candidates: Vec::new(),
                    });
                }
            }
        }
    }
    let mut best = best.ok_or(FitError::NoKnots { needed: NEEDED })?;
    best.candidates = candidates;
    Ok(best)
}

fn candidates(samples: &[StencilSample], ends: (f64, f64), lambda_l: f64, analytic: &[f64]) -> Vec<Candidate> {
    let mut found: Vec<(f64, Source)> = analytic.iter().map(|&lambda| (lambda, Source::Analytic)).collect();
    for pair in samples.windows(2).filter(|pair| pair[0].active != pair[1].active) {
        for (here, there) in [(&pair[0], &pair[1]), (&pair[1], &pair[0])] {
            let (here_set, there_set) = (here.active, there.active);
            let source = Source::ActiveSet {
                here: here_set,
                there: there_set,
            };
            found.push((here.lambda, source));
        }
    }
    found.extend(DEFAULTS.map(|lambda| (lambda, Source::Default)));
    if lambda_l >= DEFAULTS[3] && lambda_l < ends.1 {
        found.push((0.5 * (lambda_l + ends.1), Source::Default));
    }
    found.retain(|&(lambda, _)| ends.0 < lambda && lambda < ends.1 && lambda != lambda_l);
    // stable: of two reasons at one lambda the first found is kept
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.dedup_by(|later, earlier| later.0 == earlier.0);
    let candidate = |(lambda, source)| Candidate {
        lambda,
        slot: match lambda < lambda_l {
            _ if lambda_l >= ends.1 => Slot::Any,
            true => Slot::B,
            false => Slot::D,
        },
        source,
        residual: None,
    };
    found.into_iter().map(candidate).collect()
}

/// The knots of Eq. 21 that are not kinks.
pub(super) fn smooth(knots: &LambdaKnots, kinks: [bool; 3]) -> Vec<f64> {
    let triple = [knots.b, knots.c, knots.d];
    triple
        .into_iter()
        .zip(kinks)
        .filter(|&(_, kink)| !kink)
        .map(|(lambda, _)| lambda)
        .collect()
}

/// Root mean square residual of the unconstrained splines; `None` if the samples do not determine them.
fn residual(
    lambda_knots: &LambdaKnots,
    kinks: [bool; 3],
    samples: &[StencilSample],
    (lambda, f2, f3): (f64, f64, f64),
) -> Result<Option<f64>, FitError> {
    let knots = lambda_knots.knots()?;
    let rows: Vec<Row> = samples.iter().map(|s| value_row(&knots, s.lambda)).collect();
    let mut equalities = Vec::new();
    for lambda in smooth(lambda_knots, kinks) {
        equalities.extend(continuity(&knots, lambda)?);
    }
    let mut e = vec![0.0; equalities.len() + 1];
    equalities.push(value_row(&knots, lambda));
    let factored = Factored::new(knots.dimension(), &rows, &equalities, RANK_TOLERANCE);
    let (rank, free) = factored.rank();
    if rank < free {
        return Ok(None);
    }
    let mut sum = 0.0;
    let values = |value: fn(&StencilSample) -> f64| samples.iter().map(value).collect::<Vec<f64>>();
    for (at_optimum, y) in [(f2, values(|s| s.f2)), (f3, values(|s| s.f3))] {
        e[equalities.len() - 1] = at_optimum;
        let Ok(reduced) = factored.reduce(&y, &e) else {
            return Ok(None);
        };
        let x = factored.point(&reduced.origin, &reduced.target);
        sum += rows
            .iter()
            .zip(&y)
            .map(|(row, y)| (row.dot(&x) - y).powi(2))
            .sum::<f64>();
    }
    let rms = (sum / (2 * samples.len()) as f64).sqrt();
    Ok(rms.is_finite().then_some(rms))
}
