//! `eigenring compare`: schemes side by side.

use crate::args::{Schemes, tuner};
use crate::error::Error;
use crate::output::{Output, Wide};
use crate::threads::Threads;
use crate::valences::{self, Valences};
use clap::Args;
use eigenring_atlas::compare::{compare, table, text};
use eigenring_atlas::table::Format;
use std::process::ExitCode;

/// Compare schemes over valences.
///
/// Columns: lambda; mu/lambda^2 (1: bounded curvature without a flat spot); K_m, the reach of the
/// second-order maps' Gauss curvatures to the wrong side of zero, and the unweighted objective E, both over
/// the annulus from 2 to 4 with unit 5-ring norm (bicubic schemes around a vertex only); theta, the angle at
/// F between V and E, in degrees; and margins: gap = 1 - |mu|/lambda; strict = 1 - |next eigenvalue|/mu,
/// where mu is the smallest of the three eigenvalues of the quadratic terms, empty where the next is not
/// below it; hull, the smallest weight that is not zero of the rules of one level, passes composed. `verify`
/// prints the same margins.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  eigenring compare --schemes catmull-clark,lambda:optimal,tension:order=4,u0=2 --valences 3..12"
)]
pub struct Arguments {
    #[command(flatten)]
    schemes: Schemes,
    /// Valences: numbers and ranges
    #[arg(
        short = 'N',
        long,
        visible_alias = "valence",
        value_name = "LIST",
        default_value = "3..12",
        value_parser = valences::list,
        allow_hyphen_values = true
    )]
    valences: Valences,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    wide: Wide,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        let wide = self.wide.of(format)?;
        self.threads.start()?;
        let rows = compare(&self.schemes.required()?, self.valences.closed()?, &tuner())?;
        let printed = match format {
            Format::Text => text(&rows, wide),
            _ => table(rows)
                .headed(format, &[("E", "E (unweighted)"), ("theta", "theta (deg)")])
                .render(format),
        };
        self.output.emit(&printed)?;
        Ok(ExitCode::SUCCESS)
    }
}
