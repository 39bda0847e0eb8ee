//! `eigenring stencil`: all weights at one valence and lambda.

use crate::args;
use crate::error::Error;
use crate::output::Output;
use crate::valences::Valence;
use clap::Args;
use eigenring_atlas::schemes::feasible;
use eigenring_atlas::stencil::weights;
use std::process::ExitCode;

/// Print the full set of stencil weights at one lambda.
///
/// Without --f2 and --f3 the weights are those of the embedded spline table; where it does not reach
/// (valences above 20, lambda outside [0.15, 0.9], another s) they are tuned, which is said on standard
/// error, and remembered.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring stencil -N 6 --lambda 0.55\n  eigenring stencil -N 6 --lambda 0.55 --f2 0.25 --f3 0.2 --format json"
)]
pub struct Arguments {
    #[command(flatten)]
    valence: Valence,
    /// Subdominant eigenvalue, 1/8 < lambda < 1
    #[arg(long, value_name = "L", value_parser = args::number, allow_negative_numbers = true)]
    lambda: f64,
    /// Weight of each edge neighbour in the face stencil
    #[arg(long, value_name = "X", value_parser = args::finite, requires = "f3", allow_negative_numbers = true)]
    f2: Option<f64>,
    /// Weight of the opposite corner in the face stencil
    #[arg(long, value_name = "X", value_parser = args::finite, requires = "f2", allow_negative_numbers = true)]
    f3: Option<f64>,
    /// Relaxation mu/lambda^2; by default the smallest feasible one, 1 where curvature can be bounded
    #[arg(long, value_name = "S", value_parser = args::number, allow_negative_numbers = true)]
    s: Option<f64>,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        let member = match (self.f2, self.f3) {
            (Some(f2), Some(f3)) => feasible(self.valence.valence, self.lambda, self.s, 6.0, [f2, f3])?,
            _ => args::tuner().at(self.valence.valence, self.lambda, self.s)?,
        };
        self.output.emit(&weights(&member).render(format))?;
        Ok(ExitCode::SUCCESS)
    }
}
