//! `eigenring compare`: schemes side by side.

use super::with_words;
use crate::args::{Schemes, tuner};
use crate::error::Error;
use crate::output::{Output, Wide};
use crate::threads::Threads;
use crate::valences::{self, Valences};
use clap::Args;
use eigenring_atlas::compare::{compare, table, text};
use eigenring_atlas::table::Format;
use std::process::ExitCode;

const EXAMPLES: &str =
    "Example:\n  eigenring compare --schemes catmull-clark,lambda:optimal,tension:order=4,u0=2 --valences 3..12";

/// Compare schemes over valences.
///
/// Columns are lambda, mu/lambda^2, K_m, E, theta, gap, strict, hull and a remark; the long help says what
/// they mean. K_m and E are those of bicubic schemes around a vertex only. `verify` prints the same margins.
#[derive(Args, Debug)]
#[command(
    after_help = EXAMPLES,
    after_long_help = with_words(EXAMPLES, "compare")
)]
pub struct Arguments {
    #[command(flatten)]
    schemes: Schemes,
    /// Valences: numbers and ranges; by default 3..12, or that of scheme files for one valence
    #[arg(
        short = 'N',
        long,
        visible_alias = "valence",
        value_name = "LIST",
        value_parser = valences::list,
        allow_hyphen_values = true
    )]
    valences: Option<Valences>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    wide: Wide,
    #[command(flatten)]
    output: Output,
}

/// Valences by default.
const USUAL: std::ops::RangeInclusive<usize> = 3..=12;

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        let wide = self.wide.of(format)?;
        self.threads.start()?;
        let schemes = self.schemes.required()?;
        let valences = match (&self.valences, self.schemes.only_valence()?) {
            (Some(valences), _) => valences.closed()?.to_vec(),
            (None, Some(only)) => vec![only],
            (None, None) => USUAL.collect(),
        };
        let rows = compare(&schemes, &valences, &tuner())?;
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
