//! Proofs that a tabulated stencil is the best of all.
//!
//! The stencils of the lambda-scheme at one (N, lambda, s) form a plane with coordinates (f2, f3); tuning
//! looks for the admissible one with the smallest [objective](self#the-statement). A search from many starts
//! finds local minima and can miss one. Here the admissible part of the plane is covered by boxes, on each of
//! which either some bound of the admissible stencils certainly fails, or the objective is certainly above a
//! threshold next to the tabulated value (branch and bound; Hansen and Walster 2004, *Global optimization
//! using interval analysis*, chapter 12).
//!
//! # The statement
//!
//! For the doubles N, lambda, s, f2 and f3 taken as exact numbers, and the objective E of Ma, Wang and Ma
//! (2023, Eqs. 11 to 20) in the normalisation of the paper with Gauss's rule of 5 by 5 points: **every
//! admissible stencil has `E >= (1 - epsilon) E(f2, f3)`**. Admissible are the paper's bounds, with a
//! relative margin to the bounds of eigenvalues (see [`Constraint`](eigenring_scheme::lambda::Constraint)),
//! so long as the natural configuration folds at no point of the quadrature: E has no value otherwise. It is
//! a statement on the sum that is minimised, not on the integral that the sum stands for.
//!
//! Values over a box are [`Centred`](crate::Centred) forms in the corner radius and f3. Their overestimation
//! falls with the square of the box, so that boxes around a minimum need not be much smaller than the square
//! root of epsilon. Where the minimum lies on a bound, the bound is a side of the rectangle that is covered
//! (see
//! `domain.rs`).
//!
//! ```
//! use eigenring_certify::Status;
//! use eigenring_certify::optimum::{Limits, Problem};
//!
//! // lambda_C* and its stencil at N = 6, without the weight to be quick
//! let problem = Problem::new(6, 0.5929333475416836, 1.0, false, 2e-6)?;
//! let proof = problem.prove([0.3056670211900076, 0.170227973519123], 0.5, Limits::default())?;
//! assert_eq!(proof.status(), Status::Proven);
//! # Ok::<(), eigenring_certify::Error>(())
//! ```

mod domain;
mod fields;
mod objective;

use crate::{Enclose, Error, Interval, Status};
use domain::Domain;
use eigenring_scheme::Scalar;
use eigenring_scheme::lambda::Plane;
use objective::{Fold, Objective};
use serde::{Deserialize, Serialize};

/// The smallest and the largest valence: below 5 the plane is not two-dimensional or blocks coincide; above
/// the largest nothing was tried.
pub const VALENCES: [usize; 2] = [5, 64];

/// All stencils at one (N, lambda, s), and what is minimised over them.
pub struct Problem {
    objective: Objective,
    domain: Domain,
}

/// When to give up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Boxes are not cut when both sides are below this part of the whole rectangle's.
    pub width: f64,
    /// The most boxes of one part of the rectangle.
    pub boxes: u64,
}

impl Default for Limits {
    /// Empirical: at lambda_C*, N = 5 to 20, no box is given up with epsilon = 1e-6.
    fn default() -> Self {
        Limits {
            width: 1e-7,
            boxes: 1_000_000,
        }
    }
}

/// What a search has shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proof {
    /// An enclosure of the tabulated stencil's objective.
    pub value: [f64; 2],
    /// No admissible stencil outside of the undecided boxes has an objective below.
    pub bound: f64,
    /// All boxes that were looked at.
    pub boxes: u64,
    /// Those without admissible stencils, or on which the map folds.
    pub excluded: u64,
    /// Those without a stencil below the bound.
    pub above: u64,
    /// Those that were given up, of which nothing is known.
    pub undecided: u64,
    /// An admissible stencil (f2, f3) that is better by more than epsilon, at which the search ended.
    pub better: Option<[f64; 2]>,
}

impl Proof {
    /// Proven if every box was decided, refuted by a better stencil.
    pub fn status(&self) -> Status {
        match self.better {
            Some(_) => Status::Refuted,
            None if self.undecided == 0 => Status::Proven,
            None => Status::Undecided,
        }
    }

    /// Both parts of the plane together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Proof {
            value: self.value,
            bound: self.bound.min(other.bound),
            boxes: self.boxes + other.boxes,
            excluded: self.excluded + other.excluded,
            above: self.above + other.above,
            undecided: self.undecided + other.undecided,
            better: self.better.or(other.better),
        }
    }
}

/// A box of corner radii and f3.
type Sides = [Interval; 2];

impl Problem {
    /// The stencils of a valence at `lambda` and `mu = s lambda^2`, with or without the objective's weight,
    /// and with the relative margin of the bounds on eigenvalues.
    ///
    /// # Errors
    /// [`Error::Optimum`] outside [`VALENCES`]; the plane's own errors; [`Error::Margin`] if nothing is
    /// admissible.
    pub fn new(valence: usize, lambda: f64, s: f64, weighted: bool, margin: f64) -> Result<Self, Error> {
        let [least, most] = VALENCES;
        if !(least..=most).contains(&valence) {
            return Err(Error::Optimum { valence, least, most });
        }
        Plane::new(valence, lambda, s)?;
        let plane = Plane {
            valence,
            lambda: Interval::point(lambda),
            s: Interval::point(s),
            phi: Interval::integer(6),
        };
        let domain = Domain::new(&plane, Interval::point(margin)).ok_or(Error::Margin { margin })?;
        Ok(Problem {
            objective: Objective::new(plane, weighted),
            domain,
        })
    }

    /// An enclosure of the objective of one stencil: entirely unknown where the natural configuration may
    /// fold.
    pub fn value(&self, [f2, f3]: [f64; 2]) -> Interval {
        let [f2, f3] = [f2, f3].map(Interval::point);
        let radius = self.objective.plane.corner_radius(f2, f3);
        let value = self.objective.over(radius, f3);
        value.map_or(Interval::ENTIRE, |value| value.enclosure())
    }

    /// A rectangle of corner radii (from, to) and f3 that holds all admissible stencils.
    pub fn rectangle(&self) -> [[f64; 2]; 2] {
        self.domain.rectangle.map(|side| [side.lo(), side.hi()])
    }

    /// The objective's least value on a box, as far as intervals tell; infinity without admissible stencils.
    pub fn least(&self, radius: [f64; 2], f3: [f64; 2]) -> Option<f64> {
        let side = |[from, to]: [f64; 2]| Interval::new(from, to);
        Some(match self.bound([side(radius)?, side(f3)?]) {
            Bound::Excluded => f64::INFINITY,
            Bound::Known { least, .. } => least,
            Bound::Unknown => f64::NEG_INFINITY,
        })
    }

    /// Proves that no admissible stencil is better than the given one by more than `epsilon` of its
    /// objective, as far as `limits` allow.
    ///
    /// # Errors
    /// [`Error::Epsilon`] unless `0 < epsilon < 1`; [`Error::NotFinite`] if the stencil has no objective.
    pub fn prove(&self, stencil: [f64; 2], epsilon: f64, limits: Limits) -> Result<Proof, Error> {
        let mut whole: Option<Proof> = None;
        for part in 0..Self::PARTS {
            let proof = self.prove_part(part, stencil, epsilon, limits)?;
            let refuted = proof.better.is_some();
            whole = Some(match whole {
                Some(whole) => whole.and(proof),
                None => proof,
            });
            if refuted {
                break;
            }
        }
        Ok(whole.expect("there are parts"))
    }

    /// The parts of the rectangle that can be looked at apart, [`Problem::prove_part`]: it is cut into 16
    /// intervals of R and of f3.
    pub const PARTS: usize = 256;

    /// [`Problem::prove`] on one of the [`Problem::PARTS`] parts.
    ///
    /// # Errors
    /// As for [`Problem::prove`].
    pub fn prove_part(&self, part: usize, stencil: [f64; 2], epsilon: f64, limits: Limits) -> Result<Proof, Error> {
        if !(epsilon > 0.0 && epsilon < 1.0) {
            return Err(Error::Epsilon { epsilon });
        }
        let value = self.value(stencil);
        if !value.is_bounded() {
            let what = "the objective of the stencil";
            return Err(Error::NotFinite {
                what,
                value: value.hi(),
            });
        }
        let threshold = (Interval::point(value.hi()) * (Interval::one() - Interval::point(epsilon))).hi();
        let below = (Interval::point(value.lo()) * (Interval::one() - Interval::point(epsilon))).lo();
        let mut proof = Proof {
            value: [value.lo(), value.hi()],
            bound: threshold,
            boxes: 0,
            excluded: 0,
            above: 0,
            undecided: 0,
            better: None,
        };
        let cut = |side: Interval, index: usize| -> Interval {
            let at = |i: usize| side.lo() + (side.hi() - side.lo()) * (i as f64 / 16.0);
            let to = if index == 15 { side.hi() } else { at(index + 1) };
            Interval::new(at(index), to).unwrap_or(side)
        };
        let [radius, f3] = self.domain.rectangle;
        let mut stack = vec![[cut(radius, part / 16), cut(f3, part % 16)]];
        while let Some(sides) = stack.pop() {
            proof.boxes += 1;
            let direction = match self.bound(sides) {
                Bound::Excluded => {
                    proof.excluded += 1;
                    continue;
                }
                Bound::Known { least, .. } if least >= threshold => {
                    proof.above += 1;
                    continue;
                }
                Bound::Known { central, .. } if central < below && self.admits(sides) => {
                    proof.better = Some(self.stencil(sides));
                    return Ok(proof);
                }
                Bound::Known { direction, .. } => direction,
                Bound::Unknown => self.longest(sides),
            };
            let width = |i: usize| sides[i].width() / self.domain.rectangle[i].width();
            if proof.boxes + stack.len() as u64 >= limits.boxes || width(0).max(width(1)) < limits.width {
                proof.undecided += 1;
                continue;
            }
            for half in sides[direction].split() {
                let mut next = sides;
                next[direction] = half;
                stack.push(next);
            }
        }
        Ok(proof)
    }

    /// The side that is longest beside the rectangle's.
    fn longest(&self, sides: Sides) -> usize {
        let width = |i: usize| sides[i].width() / self.domain.rectangle[i].width();
        usize::from(width(1) > width(0))
    }

    /// Whether the stencil at the centre of a box is certainly admissible.
    fn admits(&self, [radius, f3]: Sides) -> bool {
        self.domain.admits(radius.mid(), f3.mid())
    }

    /// The stencil at the centre of a box.
    fn stencil(&self, [radius, f3]: Sides) -> [f64; 2] {
        let plane = &self.objective.plane;
        let f2 = Interval::point(radius.mid()) * (plane.lambda - Interval::point(f3.mid()))
            / (Interval::integer(2) * plane.cos_half_sector());
        [f2.mid(), f3.mid()]
    }

    fn bound(&self, [radius, f3]: Sides) -> Bound {
        if self.domain.excludes(radius, f3) {
            return Bound::Excluded;
        }
        let value = match self.objective.over(radius, f3) {
            Ok(value) => value,
            Err(Fold::Everywhere) => return Bound::Excluded,
            Err(Fold::Somewhere) => return Bound::Unknown,
        };
        let (least, central) = (value.enclosure().lo(), value.central().hi());
        let [along, across] = value.slopes().map(Interval::width);
        if !(along.is_finite() && across.is_finite() && least.is_finite()) {
            return Bound::Unknown;
        }
        // what overestimates is the width of the slopes
        let direction = usize::from(across > along);
        Bound::Known {
            least,
            central,
            direction,
        }
    }
}

/// What is known of the stencils of a box.
enum Bound {
    /// None is admissible, or none has an objective.
    Excluded,
    /// The objective is nowhere below `least` and at the centre not above `central`; `direction` is to be
    /// cut.
    Known { least: f64, central: f64, direction: usize },
    /// Nothing.
    Unknown,
}
