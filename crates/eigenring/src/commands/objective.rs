//! `eigenring objective`: the tuning objective at one stencil.

use super::with_words;
use crate::args::{self, ObjectiveArgs};
use crate::error::Error;
use crate::output::Output;
use crate::valences::Valence;
use clap::Args;
use eigenring_atlas::schemes::feasible;
use eigenring_atlas::stencil::objective;
use eigenring_atlas::table::{Format, pretty};
use serde_json::Value;
use std::process::ExitCode;

const EXAMPLES: &str = "Example:\n  eigenring objective -N 6 --lambda 0.55 --f2 0.25 --f3 0.2";

/// Evaluate the objective E, its three parts and the curvature extremes at one stencil.
///
/// gauss_min and gauss_max are the extremes of z_xx z_yy - z_xy^2 over the Gauss points, unsigned;
/// sign_change is K_m, which is zero if no second-order map changes the sign of its curvature.
#[derive(Args, Debug)]
#[command(
    after_help = EXAMPLES,
    after_long_help = with_words(EXAMPLES, "objective")
)]
pub struct Arguments {
    #[command(flatten)]
    valence: Valence,
    /// Subdominant eigenvalue, 1/8 < lambda < 1
    #[arg(long, value_name = "L", value_parser = args::number, allow_negative_numbers = true)]
    lambda: f64,
    /// Weight of each edge neighbour in the face stencil
    #[arg(long, value_name = "X", value_parser = args::finite, allow_negative_numbers = true)]
    f2: f64,
    /// Weight of the opposite corner in the face stencil
    #[arg(long, value_name = "X", value_parser = args::finite, allow_negative_numbers = true)]
    f3: f64,
    /// Relaxation mu/lambda^2; by default the smallest feasible one
    #[arg(long, value_name = "S", value_parser = args::number, allow_negative_numbers = true)]
    s: Option<f64>,
    #[command(flatten)]
    objective: ObjectiveArgs,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        let weights = [self.f2, self.f3];
        let member = feasible(self.valence.valence, self.lambda, self.s, self.objective.phi, weights)?;
        let (head, table) = objective(&member, self.objective.settings())?;
        let text = match format {
            Format::Json => {
                let mut object = head.json();
                object.insert("parts".to_owned(), table.json());
                pretty(&Value::Object(object))
            }
            Format::Text => format!("{}\n{}", head.text(), table.render(Format::Text)),
            format => table.render(format),
        };
        self.output.emit(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}
