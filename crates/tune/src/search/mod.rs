//! Minima of a smooth function over the feasible domain of one plane.
//!
//! Tuning at one lambda is a problem in two variables (Ma, Wang and Ma 2023, Algorithm 1): minimise E(f2, f3)
//! over a [`Domain`], which has curved sides with corners, is about 1e-4 wide in f3 where s > 1, and at N = 3
//! has a hole. At many lambda the optimum lies on a side or in a corner. The search has two stages.
//!
//! 1. **Starts.** E is evaluated at the middles of 10 x 10 cells of the domain; a descent starts from each
//!    local minimum of this grid ([`Starts::Grid`]) or from every point of it ([`Starts::Full`]).
//! 2. **Descent** (`descent.rs`), a trust-region method. E is modelled by a quadratic form, whose minimum
//!    over the *true* domain within a box is found by enumeration (`model.rs`): in two variables it is an
//!    interior point, lies on a side of the box or of the domain, or in a corner, and each of these is a
//!    closed form or a short Newton iteration on boundary curves alone. Hence sides and corners are hit
//!    exactly, and curvature of the sides enters at no cost in evaluations.
//!
//! Every point at which E is evaluated lies in the domain, up to rounding of its bounds. Where E has no
//! finite value it counts as infinitely large.
//!
//! Lengths are measured in units of the domain (`frame.rs`): f3 in its range, f2 in its longest interval. The
//! first-order conditions (Karush, Kuhn and Tucker) are reported with each [`Optimum`]. Nothing is random;
//! results depend on the input only.

mod descent;
mod error;
mod frame;
mod grid;
mod kkt;
mod model;
#[cfg(test)]
mod tests;

pub use error::Error;

use crate::objective::Objective;
use descent::Descent;
use eigenring_scheme::lambda::{Constraint, Domain};
use frame::Frame;

/// What is minimised: a function of (f2, f3), twice differentiable inside the domain.
pub trait Function {
    /// The value; anything that is not finite counts as infinitely large.
    fn value(&self, f2: f64, f3: f64) -> f64;

    /// The value and its derivatives by f2 and f3.
    fn value_and_gradient(&self, f2: f64, f3: f64) -> (f64, [f64; 2]);
}

impl Function for Objective {
    fn value(&self, f2: f64, f3: f64) -> f64 {
        Objective::value(self, f2, f3).unwrap_or(f64::NAN)
    }

    fn value_and_gradient(&self, f2: f64, f3: f64) -> (f64, [f64; 2]) {
        Objective::value_and_gradient(self, f2, f3).unwrap_or((f64::NAN, [f64::NAN; 2]))
    }
}

/// From where to descend.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Starts {
    /// From the local minima of the grid of starting points; from all of its points if that shows the
    /// function to be rough.
    #[default]
    Grid,
    /// From every point of the grid.
    Full,
}

impl Starts {
    /// Rows of the grid, and points per row and interval of f2; the paper's number. With 10 rows the two
    /// choices of starts find the same lowest minimum at all samples of N = 3..20 (`examples/agreement.rs`).
    pub const COUNT: usize = 10;
}

/// A bound on which an optimum lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveBound {
    /// Which one.
    pub constraint: Constraint,
    /// How fast the optimal value rises when the bound moves into the domain: by f2 for the curves that bound
    /// f2 at a given f3, by f3 for the ends of its range. Never negative; zero if the bound does not hold the
    /// optimum back.
    pub multiplier: f64,
}

/// A local minimum over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// The face stencil's weight of each edge neighbour.
    pub f2: f64,
    /// The face stencil's weight of the opposite corner.
    pub f3: f64,
    /// The objective E there.
    pub total: f64,
    /// The bounds on which it lies, by [`Constraint`]. The equation `f3 = mu` at N = 4 is not listed.
    pub active: Vec<ActiveBound>,
    /// Length of what remains of the gradient after subtracting non-negative multiples of the active bounds'
    /// normals, over the sum of the lengths of gradient and Hessian, all in units of the domain: roughly the
    /// distance from the exact minimum as a fraction of the domain.
    pub kkt_residual: f64,
}

impl Optimum {
    /// The names of the active bounds.
    pub fn active_names(&self) -> Vec<&'static str> {
        self.active.iter().map(|bound| bound.constraint.name()).collect()
    }
}

/// All local minima that were found, and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// The distinct local minima by rising value; at least one. Two are the same if they lie within [`MERGE`]
    /// of each other.
    pub optima: Vec<Optimum>,
    /// Points of the grid.
    pub starts: usize,
    /// Descents made.
    pub descents: usize,
    /// Distinct ends of descents that are left out because their KKT residual exceeds [`CONVERGED`].
    pub unconverged: usize,
    /// Evaluations of the value alone.
    pub evaluations: usize,
    /// Evaluations of value and gradient.
    pub gradient_evaluations: usize,
}

impl Search {
    /// The lowest minimum.
    pub fn lowest(&self) -> &Optimum {
        &self.optima[0]
    }
}

/// Minima nearer than this in both coordinates, in units of the domain, are one. Descents end within 1e-8 of
/// a minimum; distinct minima are 1e-2 and more apart (observed for N = 3..20).
pub const MERGE: f64 = 1e-5;

/// If so many distinct minima are found, and the second is within [`COMPARABLE`] of the lowest, the grid is
/// too coarse for the function, and [`Starts::Grid`] turns into [`Starts::Full`]. Of N = 3..20 this happens
/// only at N = 3 and lambda < 0.22: there mu is close to 1/8, E is a plateau with a valley 1e-3 wide, and as
/// fitted curvatures are nearly zero in it, the weight of a Gauss point is a step and E a staircase. Where E
/// is smooth there are at most two comparable minima. Both numbers are empirical.
const ROUGH: usize = 3;

/// A factor between values, see [`ROUGH`].
const COMPARABLE: f64 = 2.0;

/// KKT residual up to which the end of a descent is a minimum. Where E is smooth, residuals are below 1e-9;
/// on the plateaus and stairs of N = 3 some descents get stuck. The lowest end is always kept: its residual
/// says what it is.
pub const CONVERGED: f64 = 1e-4;

/// Searches a domain for its local minima.
///
/// # Errors
/// [`Error::NoFiniteValue`] if the function is finite at none of the starting points.
pub fn search(function: &impl Function, domain: &Domain, starts: Starts) -> Result<Search, Error> {
    let frame = Frame::new(domain);
    let grid = grid::Grid::new(function, domain, Starts::COUNT);
    let mut search = Search {
        optima: Vec::new(),
        starts: grid.len(),
        descents: 0,
        unconverged: 0,
        evaluations: grid.len(),
        gradient_evaluations: 0,
    };
    let descend = |from: Vec<[f64; 2]>, search: &mut Search| {
        for start in from {
            if let Some(end) = Descent::GRID.run(function, &frame, start) {
                search.descents += 1;
                search.gradient_evaluations += end.evaluations;
                insert(&mut search.optima, end.optimum, &frame);
            }
        }
    };
    descend(grid.starts(starts), &mut search);
    sort(&mut search.optima);
    let rough = search.optima.len() >= ROUGH && search.optima[1].total <= COMPARABLE * search.optima[0].total;
    if starts == Starts::Grid && rough {
        descend(grid.starts(Starts::Full), &mut search);
    }
    if search.optima.is_empty() {
        return Err(no_finite_value(domain, grid.len()));
    }
    sort(&mut search.optima);
    let (ends, lowest) = (search.optima.len(), search.optima[0].clone());
    search.optima.retain(|o| o.kkt_residual <= CONVERGED || *o == lowest);
    search.unconverged = ends - search.optima.len();
    Ok(search)
}

/// The local minimum to which a descent from a nearby minimum leads, with the number of evaluations of value
/// and gradient. A starting point outside of the domain is moved to it first; steps are short, so that the
/// descent stays in its basin.
///
/// # Errors
/// [`Error::NotFinite`] for a starting point that is not a number, [`Error::NoFiniteValue`] if the function
/// is not finite there.
pub fn continue_from(function: &impl Function, domain: &Domain, start: [f64; 2]) -> Result<(Optimum, usize), Error> {
    let [f2, f3] = start;
    if !(f2.is_finite() && f3.is_finite()) {
        return Err(Error::NotFinite { f2, f3 });
    }
    let end = Descent::NEAR.run(function, &Frame::new(domain), start);
    let end = end.ok_or_else(|| no_finite_value(domain, 1))?;
    Ok((end.optimum, end.evaluations))
}

/// Whether two points are one minimum, in the sense of [`MERGE`].
pub fn same_minimum(domain: &Domain, a: [f64; 2], b: [f64; 2]) -> bool {
    Frame::new(domain).distance(a, b) <= MERGE
}

/// The distance of two points in units of the domain: the larger of the differences in f2 over the longest
/// interval of f2 and in f3 over the range of f3.
pub fn distance(domain: &Domain, a: [f64; 2], b: [f64; 2]) -> f64 {
    Frame::new(domain).distance(a, b)
}

/// Adds an optimum unless it is known; of two that are one, the one with the lower value stays.
fn insert(optima: &mut Vec<Optimum>, new: Optimum, frame: &Frame) {
    let known = |old: &&mut Optimum| frame.distance([old.f2, old.f3], [new.f2, new.f3]) <= MERGE;
    match optima.iter_mut().find(known) {
        Some(old) if new.total < old.total => *old = new,
        Some(_) => {}
        None => optima.push(new),
    }
}

/// By rising value; equal ones stay in the order of the starts.
fn sort(optima: &mut [Optimum]) {
    optima.sort_by(|a, b| a.total.total_cmp(&b.total));
}

fn no_finite_value(domain: &Domain, points: usize) -> Error {
    let plane = domain.plane();
    Error::NoFiniteValue {
        valence: plane.valence,
        lambda: plane.lambda,
        points,
    }
}
