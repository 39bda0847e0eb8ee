//! The bounds of the splines along lambda.

use crate::spline::{Band, StencilBounds};
use crate::sweep::{BranchSample, Options};
use eigenring_scheme::lambda::{Bounds, Domain, Relaxation};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The admissible stencils of a valence, on the branch's side of a gap in f2.
pub(super) struct Admissible<'a> {
    relaxation: Relaxation,
    bounds: Bounds,
    margin: f64,
    phi: f64,
    samples: &'a [BranchSample],
    /// Domains by the bits of lambda: the rounds of a fit ask for the same ones.
    known: RefCell<BTreeMap<u64, Slice>>,
}

/// A domain and the branch's f2 near it; without domain where there is none.
#[derive(Clone, Copy)]
pub(super) struct Slice {
    domain: Option<Domain>,
    f2: f64,
}

impl<'a> Admissible<'a> {
    pub(super) fn new(relaxation: Relaxation, options: &Options, margin: f64, samples: &'a [BranchSample]) -> Self {
        Admissible {
            relaxation,
            bounds: options.bounds,
            margin,
            phi: options.phi,
            samples,
            known: RefCell::default(),
        }
    }

    /// The s rule of the valence.
    pub(super) fn relaxation(&self) -> &Relaxation {
        &self.relaxation
    }

    /// The smallest slack of all constraints at a stencil; at N = 4 f3 is mu whatever is given.
    pub(super) fn slack(&self, lambda: f64, f2: f64, f3: f64) -> f64 {
        let Ok(mut plane) = self.relaxation.plane(lambda) else {
            return f64::NEG_INFINITY;
        };
        plane.phi = self.phi;
        let f3 = if plane.valence == 4 { plane.mu() } else { f3 };
        let slack = plane.slack(self.bounds, self.margin, f2, f3);
        slack.into_iter().map(|(_, slack)| slack).fold(f64::INFINITY, f64::min)
    }

    /// The branch's f2 at lambda, interpolated between samples.
    fn reference(&self, lambda: f64) -> f64 {
        let after = self.samples.partition_point(|sample| sample.lambda < lambda);
        let at = |index: usize| self.samples.get(index).map(|sample| (sample.lambda, sample.minimum.f2));
        match (after.checked_sub(1).and_then(at), at(after)) {
            (Some((l0, y0)), Some((l1, y1))) => y0 + (y1 - y0) * (lambda - l0) / (l1 - l0),
            (Some((_, y)), None) | (None, Some((_, y))) => y,
            (None, None) => f64::NAN,
        }
    }
}

/// No stencil at all: the fit reports the lambda as infeasible.
const EMPTY: Band = Band {
    lower: f64::INFINITY,
    upper: f64::NEG_INFINITY,
};

impl StencilBounds for Admissible<'_> {
    type Domain = Slice;

    fn domain(&self, lambda: f64) -> Slice {
        if let Some(&slice) = self.known.borrow().get(&lambda.to_bits()) {
            return slice;
        }
        let plane = self.relaxation.plane(lambda).map(|mut plane| {
            plane.phi = self.phi;
            plane
        });
        let slice = Slice {
            domain: plane
                .and_then(|plane| Domain::new(plane, self.bounds, self.margin))
                .ok(),
            f2: self.reference(lambda),
        };
        self.known.borrow_mut().insert(lambda.to_bits(), slice);
        slice
    }

    fn f3(&self, slice: &Slice) -> Band {
        match &slice.domain {
            None => EMPTY,
            // f3 is mu, which the spline only approximates
            Some(domain) if domain.plane().valence == 4 => Band::FREE,
            Some(domain) => {
                let [lower, upper] = domain.f3_range().map(|end| end.f3);
                Band { lower, upper }
            }
        }
    }

    fn f2(&self, slice: &Slice, f3: f64) -> Band {
        let Some(domain) = &slice.domain else {
            return EMPTY;
        };
        let f3 = if domain.plane().valence == 4 {
            domain.plane().mu()
        } else {
            f3
        };
        let distance = |interval: &Band| (interval.lower - slice.f2).max(slice.f2 - interval.upper);
        domain
            .f2_intervals(f3)
            .into_iter()
            .map(|interval| Band {
                lower: interval.lower.f2,
                upper: interval.upper.f2,
            })
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(EMPTY)
    }
}
