//! Do descents from the grid's minima find what descents from all 100 starts find?
//!
//! `cargo run --release -p eigenring-tune --example agreement [first valence] [last valence]` searches all
//! 100 sample lambdas of each valence (3 to 20 by default) both ways, and prints one row per valence: the
//! largest relative excess of the default search over the full one with its lambda, the largest KKT residual
//! of the lowest optima, the most distinct minima at one lambda, then means per lambda: milliseconds,
//! descents, evaluations of value and gradient in each descent, and milliseconds of the full search.

use eigenring_tune::search::Starts;
use eigenring_tune::sweep::{Error, Options, Problem, sample_lambdas};
use std::time::Instant;

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args()
        .skip(1)
        .filter_map(|argument| argument.parse::<usize>().ok());
    let (first, last) = (arguments.next().unwrap_or(3), arguments.next().unwrap_or(20));
    println!("  N  excess   at lambda   kkt      minima  ms     descents  gradients  full ms  gradients");
    for valence in first..=last {
        row(valence)?;
    }
    Ok(())
}

fn row(valence: usize) -> Result<(), Error> {
    let lambdas = sample_lambdas(valence)?;
    let (mut excess, mut kkt, mut minima) = ((f64::NEG_INFINITY, 0.0), 0.0_f64, 0);
    let mut seconds = [0.0; 2];
    let mut descents = [0; 2];
    let mut gradients = [0; 2];
    for &lambda in &lambdas {
        let mut lowest = [0.0; 2];
        for (i, starts) in [Starts::Grid, Starts::Full].into_iter().enumerate() {
            let clock = Instant::now();
            let search = Problem::new(valence, lambda, &Options::default())?.search(starts)?;
            seconds[i] += clock.elapsed().as_secs_f64();
            descents[i] += search.descents;
            gradients[i] += search.gradient_evaluations;
            lowest[i] = search.lowest().total;
            kkt = kkt.max(search.lowest().kkt_residual);
            minima = minima.max(search.optima.len());
        }
        let difference = lowest[0] / lowest[1] - 1.0;
        if difference > excess.0 {
            excess = (difference, lambda);
        }
    }
    let count = lambdas.len() as f64;
    println!(
        "{valence:3}  {:7.1e}  {:.5}     {kkt:7.1e}  {minima:6}  {:5.2}  {:8.2}  {:9.1}  {:7.1}  {:9.1}",
        excess.0,
        excess.1,
        1e3 * seconds[0] / count,
        descents[0] as f64 / count,
        gradients[0] as f64 / descents[0] as f64,
        1e3 * seconds[1] / count,
        gradients[1] as f64 / descents[1] as f64,
    );
    Ok(())
}
