//! The scheme on an interval of lambda.

use super::Problem;
use crate::{Centred, Enclose, Interval};
use eigenring_scheme::lambda::{Addition, Branch, LambdaStencil, Plane, Relaxation, Term};
use eigenring_spline::Scalar;

/// All schemes of an interval of lambda, on one branch of s.
#[derive(Clone, Debug)]
pub struct StencilBox {
    /// The branch.
    pub branch: Branch,
    /// lambda, s, mu and the cosines.
    pub plane: Plane<Centred<1>>,
    /// Weight of the edge neighbours in the face rule.
    pub f2: Centred<1>,
    /// Weight of the face point in the face rule.
    pub f3: Centred<1>,
    /// `2 g2 f2`.
    pub h: Centred<1>,
    /// The weights.
    pub stencil: LambdaStencil<Centred<1>>,
}

/// The branches of s that may hold somewhere in an interval of lambda: at least one, and all that do.
///
/// The largest of the terms counts, so a term is left out if it is certainly smaller than another on the
/// whole interval. The addition is its full value where a term beside 1 is at least 1, falls linearly while
/// the line is between the full value and zero, and is zero after that.
pub fn branches(relaxation: &Relaxation, valence: usize, lambda: Interval) -> Vec<Branch> {
    let value = |term, addition| relaxation.s_on_branch(Branch { term, addition }, lambda);
    let terms: &[Term] = if valence < 5 {
        &[Term::Bounded, Term::OuterRings]
    } else {
        &[Term::Bounded, Term::OuterRings, Term::EdgeWeight, Term::LastBlock]
    };
    let values: Vec<Interval> = terms.iter().map(|&term| value(term, Addition::Off)).collect();
    let floor = values.iter().map(|value| value.lo()).fold(0.0, f64::max);
    let one = Interval::one();
    let full = Interval::ratio(1, Relaxation::ADDITION_INVERSE);
    let line = value(Term::Bounded, Addition::Falling) - one;
    let mut additions = Vec::new();
    if values[1..].iter().any(|value| value.hi() >= 1.0) {
        additions.push(Addition::Full);
    }
    if line.hi() >= 0.0 && line.lo() <= full.hi() {
        additions.push(Addition::Falling);
    }
    if line.lo() <= 0.0 {
        additions.push(Addition::Off);
    }
    let mut branches = Vec::new();
    for (&term, value) in terms.iter().zip(&values) {
        if value.hi() < floor {
            continue;
        }
        for &addition in &additions {
            // beyond the last kink the largest term is 1
            if addition == Addition::Full || term == Term::Bounded {
                branches.push(Branch { term, addition });
            }
        }
    }
    branches
}

/// The schemes on a tile, one for each branch of s that may hold there. `None` if a knot lies inside the
/// tile.
pub(crate) fn points(problem: &Problem, ends: [f64; 2]) -> Option<Vec<StencilBox>> {
    let range = Interval::new(ends[0], ends[1])?;
    let lambda = Centred::<1>::parameter(range, 0);
    let (f2, f3) = problem.weights(ends, lambda)?;
    let points = branches(&problem.relaxation, problem.valence, range)
        .into_iter()
        .map(|branch| {
            let plane = Plane {
                valence: problem.valence,
                lambda,
                s: problem.relaxation.s_on_branch(branch, lambda),
                phi: Centred::ratio(6, 1),
            };
            let f3 = f3.unwrap_or_else(|| plane.mu());
            StencilBox {
                branch,
                plane,
                f2,
                f3,
                h: plane.g3_and_h(f3).1,
                stencil: plane.stencil(f2, f3),
            }
        });
    Some(points.collect())
}

impl StencilBox {
    /// Whether all weights have a value on the whole interval: no closed form may divide by zero.
    pub fn is_bounded(&self) -> bool {
        let weights = self.stencil.weights.named().into_iter().map(|(_, weight)| weight);
        let all = weights.chain([self.stencil.g1, self.stencil.g2, self.stencil.g3]);
        all.into_iter().all(|weight| weight.enclosure().is_bounded())
    }

    /// Whether s is 1 by the formula, so that `mu = lambda^2`.
    pub fn has_square(&self) -> bool {
        self.branch.term == Term::Bounded && self.branch.addition == Addition::Off
    }

    /// The third eigenvalue of block 0 beside 1 and mu: `g3 + 2h + f3 - (1 + phi) beta - mu`.
    pub fn z0(&self) -> Centred<1> {
        let one = Centred::one();
        self.stencil.g3 + self.h + self.h + self.f3
            - (one + self.plane.phi) * self.stencil.weights.beta
            - self.plane.mu()
    }

    /// An enclosure of lambda.
    pub fn lambda(&self) -> Interval {
        self.plane.lambda.enclosure()
    }
}
