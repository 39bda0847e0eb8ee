//! Smallest values of any function over a box, under conditions.
//!
//! For schemes of which nothing is known but how to measure them. Points lie in the unit cube; a
//! [`Problem`] says what a point is [`Worth`]: a value, and for each condition a slack that is negative where
//! the condition fails. Points are compared by feasibility first (Deb 2000): any point that satisfies all
//! conditions is better than one that does not, and among the latter the sum of what is missing counts.
//!
//! The steps, each of which is a function, so that a caller can run them in parallel and keep what is found:
//!
//! 1. [`samples`]: points of a Halton sequence, shifted by a seed, and [`starts`], the best of them that lie
//!    apart;
//! 2. [`swarm`]: particles (Kennedy and Eberhart 1995), of which the best is a start too;
//! 3. from each start [`descend`]: quasi-Newton steps (L-BFGS with the line search of More and Thuente) where
//!    the problem has a [`Problem::smooth`] form, then a simplex (Nelder and Mead 1965);
//! 4. from the best of them [`polish`]: the same, with simplices begun anew in ever smaller size until they
//!    find nothing better; where a condition is active, along it by an augmented Lagrangian.
//!
//! The solvers are those of argmin. Everything is a function of the problem and the seed.

mod active;
mod descent;
mod sampling;
mod swarm;

pub use descent::{descend, polish};
pub use sampling::{samples, starts};
pub use swarm::swarm;

/// What a point is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Worth {
    /// What is minimised; not finite where it is not defined.
    pub value: f64,
    /// One for each condition: negative where it fails, NaN where it cannot be judged.
    pub slacks: Vec<f64>,
}

/// A function over the unit cube, with conditions.
pub trait Problem: Sync {
    /// How many coordinates a point has.
    fn dimension(&self) -> usize;

    /// What a point of the cube is worth.
    fn worth(&self, point: &[f64]) -> Worth;

    /// Value and gradient of a smooth function which has its minima where this one has, but for the
    /// conditions, where there is one.
    fn smooth(&self, _point: &[f64]) -> Option<(f64, Vec<f64>)> {
        None
    }
}

/// Beyond all values of feasible points.
const LARGE: f64 = 1e30;

/// What a slack or a value that is not defined counts as.
const UNDEFINED: f64 = 1e6;

impl Worth {
    /// Whether the value is defined and every condition satisfied.
    pub fn is_feasible(&self) -> bool {
        self.missing() == 0.0
    }

    /// How much is missing to feasibility, 0 if nothing is.
    fn missing(&self) -> f64 {
        let below = |slack: f64| match slack {
            slack if slack.is_nan() => UNDEFINED,
            slack => (-slack).clamp(0.0, UNDEFINED),
        };
        let undefined = !(self.value.abs() < LARGE);
        self.slacks.iter().map(|&slack| below(slack)).sum::<f64>() + f64::from(u8::from(undefined)) * UNDEFINED
    }

    /// A number that is smaller for better points.
    pub fn merit(&self) -> f64 {
        match self.missing() {
            0.0 => self.value,
            missing => LARGE * (1.0 + missing),
        }
    }
}

/// A point that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Where it is in the unit cube.
    pub point: Vec<f64>,
    /// What it is worth.
    pub worth: Worth,
    /// How often the problem was asked.
    pub evaluations: usize,
}

/// The best of those that were found: the first of equal ones.
pub fn best(found: &[Found]) -> Option<&Found> {
    found
        .iter()
        .reduce(|best, other| match other.worth.merit() < best.worth.merit() {
            true => other,
            false => best,
        })
}

/// The nearest point of the cube.
fn inside(point: &[f64]) -> Vec<f64> {
    point.iter().map(|x| x.clamp(0.0, 1.0)).collect()
}

#[cfg(test)]
mod tests;
