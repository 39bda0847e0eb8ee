//! Particles that share what they find.

use super::{Found, Problem, inside};
use argmin::core::{CostFunction, Error, Executor, State};
use argmin::solver::particleswarm::ParticleSwarm;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use std::cell::Cell;

/// How often the particles move.
const STEPS: u64 = 12;

/// The best point that a swarm finds, of eight particles and two more for each coordinate.
pub fn swarm(problem: &dyn Problem, seed: u64) -> Found {
    let dimension = problem.dimension();
    let cost = Cost {
        problem,
        evaluations: Cell::new(0),
    };
    let bounds = (vec![0.0; dimension], vec![1.0; dimension]);
    let solver =
        ParticleSwarm::new(bounds, 8 + 2 * dimension).with_rng_generator(Xoshiro256PlusPlus::seed_from_u64(seed));
    let executor = Executor::new(&cost, solver).configure(|state| state.max_iters(STEPS));
    let result = executor.timer(false).run();
    let found = result
        .ok()
        .and_then(|result| Some(result.state().get_best_param()?.position.clone()));
    // the middle stands for a swarm that found nothing
    let point = inside(&found.unwrap_or_else(|| vec![0.5; dimension]));
    Found {
        worth: problem.worth(&point),
        point,
        evaluations: cost.evaluations.get() + 1,
    }
}

struct Cost<'a> {
    problem: &'a dyn Problem,
    evaluations: Cell<usize>,
}

impl CostFunction for &Cost<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        self.evaluations.set(self.evaluations.get() + 1);
        Ok(self.problem.worth(&inside(point)).merit())
    }
}
