//! From one start to a minimum.

use super::{Found, Problem, Worth, inside};
use argmin::core::{CostFunction, Error, Executor, Gradient, State};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::neldermead::NelderMead;
use argmin::solver::quasinewton::LBFGS;
use std::cell::{Cell, RefCell};

/// The size of the first simplex, in the unit cube.
const FIRST: f64 = 0.1;

/// Simplices below this size are not begun.
const LAST: f64 = 1e-9;

/// A condition whose slack is below this may be active at the minimum.
const NEAR: f64 = 1e-3;

/// The most simplices of a descent.
const MAX_SIMPLICES: usize = 60;

/// A relative improvement that counts, and the relative deviation of the values at the corners of a simplex
/// at which it ends: rounding in sums over quadrature points is some 1e-13.
const IMPROVED: f64 = 1e-10;
const FLAT: f64 = 1e-12;

/// The same deviation where it is only to be seen which of several minima is the lowest.
const ROUGHLY: f64 = 1e-4;

/// Steps that quasi-Newton methods remember, and how many they make.
const MEMORY: usize = 7;
const MAX_STEPS: u64 = 60;

/// Descends from a point of the cube towards a minimum, as far as it takes to compare it with others.
pub fn descend(problem: &dyn Problem, start: &[f64]) -> Found {
    let asked = Asked::new(problem, start);
    asked.quasi_newton(start);
    let (point, _) = asked.best.borrow().clone();
    asked.simplex(&point, FIRST, ROUGHLY, 0);
    asked.found()
}

/// Descends to the minimum itself.
pub fn polish(problem: &dyn Problem, start: &[f64]) -> Found {
    let asked = Asked::new(problem, start);
    asked.quasi_newton(start);
    asked.simplices(FIRST / 4.0);
    let bound = asked.best.borrow().1.slacks.iter().any(|slack| !(*slack > NEAR));
    if bound {
        // conditions cut simplices off, and along a curved one they get stuck
        asked.along_conditions();
        asked.simplices(FIRST / 64.0);
    }
    asked.found()
}

/// A problem, with the best of the points that were asked for.
pub(super) struct Asked<'a> {
    problem: &'a dyn Problem,
    pub best: RefCell<(Vec<f64>, Worth)>,
    evaluations: Cell<usize>,
}

impl<'a> Asked<'a> {
    fn new(problem: &'a dyn Problem, start: &[f64]) -> Self {
        let start = inside(start);
        let worth = problem.worth(&start);
        Asked {
            problem,
            best: RefCell::new((start, worth)),
            evaluations: Cell::new(1),
        }
    }

    fn found(self) -> Found {
        let (point, worth) = self.best.into_inner();
        Found {
            point,
            worth,
            evaluations: self.evaluations.get(),
        }
    }

    /// What a point is worth; the best is kept.
    pub fn worth(&self, point: &[f64]) -> Worth {
        let point = inside(point);
        let worth = self.problem.worth(&point);
        self.evaluations.set(self.evaluations.get() + 1);
        let mut best = self.best.borrow_mut();
        if worth.merit() < best.1.merit() {
            *best = (point, worth.clone());
        }
        worth
    }

    fn merit(&self, point: &[f64]) -> f64 {
        self.worth(point).merit()
    }

    /// Simplices, each begun at the best point, until they find nothing better at any size.
    fn simplices(&self, mut size: f64) {
        for round in 0..MAX_SIMPLICES {
            let before = self.best.borrow().clone();
            self.simplex(&before.0, size, FLAT, round);
            let merit = before.1.merit();
            if merit - self.best.borrow().1.merit() > IMPROVED * merit.abs() {
                continue;
            }
            size /= 8.0;
            if size < LAST {
                break;
            }
        }
    }

    /// One run of Nelder and Mead from a simplex at a point.
    fn simplex(&self, point: &[f64], size: f64, flat: f64, round: usize) {
        let corners = simplex_at(point, size, round);
        let flat = flat * self.best.borrow().1.merit().abs();
        // what it returns is kept already; a run that fails has its best points too
        nelder_mead(Cost(self), corners, flat);
    }

    /// Quasi-Newton steps, where the problem has a smooth form; they end at the border of the cube.
    fn quasi_newton(&self, start: &[f64]) {
        if self.problem.smooth(start).is_none() {
            return;
        }
        let solver = LBFGS::new(MoreThuenteLineSearch::new(), MEMORY);
        let executor = Executor::new(Smooth(self), solver);
        let executor = executor.configure(|state| state.param(start.to_vec()).max_iters(MAX_STEPS));
        if let Ok(result) = executor.timer(false).run()
            && let Some(point) = result.state().get_best_param()
        {
            self.merit(point);
        }
    }
}

/// The corners of a simplex at a point; its edges point to where the cube is, and in alternate directions.
pub(super) fn simplex_at(point: &[f64], size: f64, round: usize) -> Vec<Vec<f64>> {
    let mut corners = vec![point.to_vec()];
    for axis in 0..point.len() {
        let mut corner = point.to_vec();
        let step = if (round + axis).is_multiple_of(2) { size } else { -size };
        let outside = !(0.0..=1.0).contains(&(corner[axis] + step));
        corner[axis] += if outside { -step } else { step };
        corners.push(corner);
    }
    corners
}

/// One run of Nelder and Mead: the best point it has met, if it has come to its end.
pub(super) fn nelder_mead<C>(cost: C, corners: Vec<Vec<f64>>, flat: f64) -> Option<Vec<f64>>
where
    C: CostFunction<Param = Vec<f64>, Output = f64>,
{
    let steps = 80 * (corners.len() as u64 - 1);
    let solver = NelderMead::new(corners).with_sd_tolerance(flat).ok()?;
    let executor = Executor::new(cost, solver).configure(|state| state.max_iters(steps));
    let result = executor.timer(false).run().ok()?;
    result.state().get_best_param().cloned()
}

struct Cost<'a, 'b>(&'a Asked<'b>);

impl CostFunction for Cost<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.0.merit(point))
    }
}

/// The smooth form; an error where there is none, and outside of the cube.
struct Smooth<'a, 'b>(&'a Asked<'b>);

impl Smooth<'_, '_> {
    fn at(&self, point: &[f64]) -> Result<(f64, Vec<f64>), Error> {
        // each point that is met counts, so that a run that ends at the border has not been in vain
        self.0.merit(point);
        let found = match point.iter().all(|x| (0.0..=1.0).contains(x)) {
            true => self.0.problem.smooth(point),
            false => None,
        };
        found.ok_or_else(|| Error::msg("no smooth form here"))
    }
}

impl CostFunction for Smooth<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.at(point)?.0)
    }
}

impl Gradient for Smooth<'_, '_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, point: &Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok(self.at(point)?.1)
    }
}
