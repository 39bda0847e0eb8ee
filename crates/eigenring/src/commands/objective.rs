//! `eigenring objective`: the tuning objective at one stencil.

use crate::args::{self, ObjectiveArgs, Output};
use crate::error::Error;
use crate::files;
use crate::schemes::Point;
use crate::table::{Format, Record, Table, pretty};
use clap::Args;
use eigenring_tune::objective::Objective;
use serde_json::Value;
use std::process::ExitCode;

/// Evaluate the objective E, its three parts and the curvature extremes at one stencil.
///
/// gauss_min and gauss_max are the extremes of z_xx z_yy - z_xy^2 over the Gauss points, unsigned; sign_change is K_m, which is
/// zero if no second-order map changes the sign of its curvature.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  eigenring objective -N 6 --lambda 0.55 --f2 0.25 --f3 0.2")]
pub struct Arguments {
    /// Valence
    #[arg(short = 'N', long, value_name = "N", value_parser = args::valence, allow_negative_numbers = true)]
    valence: usize,
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
        let valence = self.valence;
        let point = Point::given(valence, self.lambda, self.s, self.objective.phi, self.f2, self.f3)?;
        let objective = Objective::new(point.plane, self.objective.settings())?;
        let parts = objective.parts(point.f2, point.f3)?;
        let head = Record::default()
            .with("valence", valence)
            .with("lambda", point.plane.lambda)
            .with("s", point.plane.s)
            .with("f2", point.f2)
            .with("f3", point.f3)
            .with("total", parts.total())
            .with("sign_change", parts.sign_change());
        let mut table = Table::new(["map", "value", "a", "b", "c", "gauss_min", "gauss_max"]);
        for (name, part) in [
            ("cup", parts.cup),
            ("saddle_re", parts.saddle_re),
            ("saddle_im", parts.saddle_im),
        ] {
            let numbers = [part.value, part.a, part.b, part.c, part.gauss_min, part.gauss_max];
            let cells = std::iter::once(name.into()).chain(numbers.map(Into::into));
            table.push(cells.collect());
        }
        let text = match self.output.format {
            Format::Json => {
                let mut object = head.json();
                object.insert("parts".to_owned(), table.json());
                pretty(&Value::Object(object))
            }
            Format::Text => format!("{}\n{}", head.text(), table.render(Format::Text)),
            format => table.render(format),
        };
        files::emit(None, text.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}
