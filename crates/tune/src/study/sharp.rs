//! Splines with the same 17 coefficients that lose less against the samples.
//!
//! The paper fits f2 and f3 by least squares: a distance of 0.01 counts the same wherever it lies, though it
//! may cost a thousandth of the objective at one lambda and a tenth at another. Here
//!
//! * squared distances are weighted by what they cost, `(E(f + d)/E - 1)/d^2`;
//! * f2 is fitted to the best values beside the fitted f3, not beside the tuned one;
//! * the weights of samples grow with what the spline loses there, round by round (the rule of Lawson 1961
//!   for least maxima), and the best round is kept;
//! * the triple knots b and d move to whichever lose least, of the kinks and of the paper's, both together or
//!   one after the other, with the weights above or with equal ones.
//!
//! Interpolation at lambda_C* and the bounds are those of the usual fit.

use super::admissible::Admissible;
use super::{TINY, fit_feasible, objective};
use crate::objective::Objective;
use crate::spline::{Band, FitError, StencilBounds, StencilFit, StencilSample};
use crate::sweep::{BranchSample, Options, Range};
use eigenring_scheme::lambda::{LAMBDA_R1, LambdaKnots};

/// Rounds of weights with each choice of knots. Empirical.
const ROUNDS: usize = 10;

/// Distance at which the cost of a deviation is measured: the usual splines deviate by 1e-3 to 1e-2.
const DISTANCE: f64 = 1e-3;

/// The least weight beside the largest, so that every sample has a say. Empirical.
const LEAST: f64 = 1e-5;

/// What is fitted, and what stays the same whatever the knots are.
pub(super) struct Sharp<'a> {
    pub samples: &'a [BranchSample],
    pub labelled: &'a [StencilSample],
    pub fixed: &'a [(f64, f64, f64)],
    pub range: &'a Range,
    pub options: &'a Options,
    pub admissible: &'a Admissible<'a>,
    /// Where what is lost counts: from lambda_r1 to here.
    pub end: f64,
}

/// Knots, whether they are kinks, and the fit with the least loss found.
pub(super) struct Found {
    pub knots: LambdaKnots,
    pub kinks: [bool; 3],
    pub fit: StencilFit,
    loss: f64,
}

/// A sample with its objective.
struct Place<'a> {
    sample: &'a BranchSample,
    objective: Option<Objective>,
    band: Band,
}

impl Place<'_> {
    /// `E/E_sample - 1`; infinite where there is no E.
    fn loss(&self, f2: f64, f3: f64) -> f64 {
        match &self.objective {
            Some(objective) => objective
                .value(f2, f3)
                .map_or(f64::INFINITY, |value| value / self.sample.minimum.total - 1.0),
            None => 0.0,
        }
    }

    /// The best f2 beside an f3, near the tuned one: a golden section.
    fn best_f2(&self, f3: f64) -> f64 {
        let tuned = self.sample.minimum.f2;
        if self.objective.is_none() {
            return tuned;
        }
        let (mut low, mut high) = ((tuned - 0.05).max(self.band.lower), (tuned + 0.05).min(self.band.upper));
        if low >= high {
            return tuned;
        }
        let part = 0.5 * (5.0_f64.sqrt() - 1.0);
        let (mut left, mut right) = (high - part * (high - low), low + part * (high - low));
        let (mut at_left, mut at_right) = (self.loss(left, f3), self.loss(right, f3));
        // to 1e-7 of the width, at which E is flat
        for _ in 0..34 {
            if at_left <= at_right {
                (high, right, at_right) = (right, left, at_left);
                left = high - part * (high - low);
                at_left = self.loss(left, f3);
            } else {
                (low, left, at_left) = (left, right, at_right);
                right = low + part * (high - low);
                at_right = self.loss(right, f3);
            }
        }
        0.5 * (low + high)
    }

    /// What a squared distance in f2 and in f3 costs.
    fn costs(&self) -> [f64; 2] {
        let (f2, f3) = (self.sample.minimum.f2, self.sample.minimum.f3);
        let cost = |losses: [f64; 2]| {
            let finite = losses.into_iter().filter(|loss| loss.is_finite());
            finite.fold(0.0, f64::max) / (DISTANCE * DISTANCE)
        };
        let beside = |d: f64| self.loss(self.best_f2(f3 + d), f3 + d);
        [
            cost([self.loss(f2 + DISTANCE, f3), self.loss(f2 - DISTANCE, f3)]),
            cost([beside(DISTANCE), beside(-DISTANCE)]),
        ]
    }
}

impl Sharp<'_> {
    /// The best splines with the knots of the usual fit or others, or with one of the given lambdas in the
    /// place of b and d: at least as good as the usual fits with either knots.
    pub fn fit(
        &self,
        (knots, kinks, fit): (LambdaKnots, [bool; 3], StencilFit),
        others: Option<(LambdaKnots, [bool; 3])>,
        free: [&[f64]; 2],
    ) -> Found {
        let places: Vec<Place<'_>> = self.samples.iter().map(|sample| self.place(sample)).collect();
        let costs: Vec<[f64; 2]> = places.iter().map(Place::costs).collect();
        let losses = self.losses(&fit, &places);
        let mut best = Found {
            knots,
            kinks,
            fit,
            loss: losses.into_iter().fold(0.0, f64::max),
        };
        let consider = |best: &mut Found, knots, kinks| {
            // knots that leave a part undetermined are no choice
            if let Ok(found) = self.rounds(knots, kinks, &places, &costs)
                && found.loss < best.loss
            {
                *best = found;
            }
        };
        consider(&mut best, knots, kinks);
        if let Some((knots, kinks)) = others {
            consider(&mut best, knots, kinks);
        }
        for (slot, lambdas) in free.into_iter().enumerate() {
            for &lambda in lambdas {
                let (mut knots, mut kinks) = (best.knots, best.kinks);
                let (knot, kink) = match slot {
                    0 => (&mut knots.b, &mut kinks[0]),
                    _ => (&mut knots.d, &mut kinks[2]),
                };
                if *knot != lambda {
                    // a free knot may be a kink
                    (*knot, *kink) = (lambda, true);
                    consider(&mut best, knots, kinks);
                }
            }
        }
        best
    }

    /// What a fit loses at each sample, where it counts.
    fn losses(&self, fit: &StencilFit, places: &[Place<'_>]) -> Vec<f64> {
        let loss = |place: &Place<'_>| {
            let lambda = place.sample.lambda;
            let f2 = fit.f2.spline.value(lambda).unwrap_or(f64::NAN);
            let counts = (LAMBDA_R1..=self.end).contains(&lambda);
            if counts {
                place.loss(f2, self.f3(fit, place)).max(0.0)
            } else {
                0.0
            }
        };
        places.iter().map(loss).collect()
    }

    /// A fit's f3 at a sample: mu at valence 4, whatever the spline says.
    fn f3(&self, fit: &StencilFit, place: &Place<'_>) -> f64 {
        match self.admissible.relaxation().valence() {
            4 => place.sample.minimum.f3,
            _ => fit.f3.spline.value(place.sample.lambda).unwrap_or(f64::NAN),
        }
    }

    fn place<'b>(&self, sample: &'b BranchSample) -> Place<'b> {
        let counts = sample.minimum.total > TINY;
        let slice = self.admissible.domain(sample.lambda);
        Place {
            objective: counts
                .then(|| objective(self.admissible.relaxation().valence(), sample.lambda, self.options).ok())
                .flatten(),
            band: self.admissible.f2(&slice, sample.minimum.f3),
            sample,
        }
    }

    fn rounds(
        &self,
        knots: LambdaKnots,
        kinks: [bool; 3],
        places: &[Place<'_>],
        costs: &[[f64; 2]],
    ) -> Result<Found, FitError> {
        let mut samples = self.labelled.to_vec();
        let mut factors = vec![1.0; samples.len()];
        let mut best: Option<Found> = None;
        for round in 0..=ROUNDS {
            // equal weights come first
            for which in if round == 0 { 0..0 } else { 0..2 } {
                let raised = costs.iter().zip(&factors).map(|(cost, factor)| cost[which] * factor);
                let largest = raised.clone().fold(f64::MIN_POSITIVE, f64::max);
                for (sample, cost) in samples.iter_mut().zip(raised) {
                    sample.weights[which] = (cost / largest).max(LEAST);
                }
            }
            let fit = fit_feasible(&knots, kinks, &samples, self.fixed, self.range, self.admissible)?;
            let losses = self.losses(&fit, places);
            for (place, sample) in places.iter().zip(&mut samples) {
                sample.f2 = place.best_f2(self.f3(&fit, place));
            }
            let loss = losses.iter().copied().fold(0.0, f64::max);
            if best.as_ref().is_none_or(|best| loss < best.loss) {
                best = Some(Found {
                    knots,
                    kinks,
                    fit,
                    loss,
                });
            }
            if loss <= 0.0 {
                break;
            }
            if round == 0 {
                continue;
            }
            for (factor, own) in factors.iter_mut().zip(&losses) {
                // half the rule's power and at most halved, so that weights change slowly; empirical. A loss
                // is infinite where the map folds
                let part = if *own == loss { 1.0 } else { own / loss };
                *factor *= part.sqrt().max(0.5);
            }
        }
        Ok(best.expect("there is a round"))
    }
}
