//! `eigenring tune`: the best stencil at one lambda, or over all.

use super::with_words;
use crate::args::{self, TuningArgs};
use crate::error::Error;
use crate::output::Output;
use crate::progress::Terminal;
use crate::threads::Threads;
use crate::valences::Valence;
use clap::{ArgGroup, Args};
use eigenring_atlas::table::{Format, pretty};
use eigenring_atlas::tune::{Found, at, over_lambda};
use serde_json::Value;
use std::process::ExitCode;

const EXAMPLES: &str = "Examples:\n  eigenring tune -N 6 --lambda 0.39\n  eigenring tune -N 25 --global --format json";

/// Optimise f2 and f3 at one lambda, or lambda too.
///
/// At one lambda there may be several local minima; the one reported is that of the branch which is continued
/// from the global optimum over lambda (branch: "continued"), as far as the valence is tabulated, else the
/// lowest (branch: "lowest"). The lowest value is reported beside it.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("target").required(true))]
#[command(
    after_help = EXAMPLES,
    after_long_help = with_words(EXAMPLES, "tune")
)]
pub struct Arguments {
    #[command(flatten)]
    valence: Valence,
    /// Subdominant eigenvalue, 1/8 < lambda < 1
    #[arg(
        long,
        value_name = "L",
        value_parser = args::number,
        group = "target",
        allow_negative_numbers = true
    )]
    lambda: Option<f64>,
    /// Optimise lambda as well, over [0.15, 0.9]
    #[arg(long, group = "target")]
    global: bool,
    #[command(flatten)]
    tuning: TuningArgs,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        self.threads.start()?;
        let options = self.tuning.options();
        let found = match self.lambda {
            Some(lambda) => at(self.valence.valence, lambda, &options)?,
            None => over_lambda(self.valence.valence, &options, &Terminal)?,
        };
        let Found {
            record,
            active,
            title,
            minima,
        } = found;
        let text = match format {
            Format::Json => {
                let mut object = record.json();
                object.insert("active".to_owned(), active.into());
                object.insert(title.to_owned(), minima.json());
                pretty(&Value::Object(object))
            }
            Format::Text => {
                let record = record.with("active", active.join("+"));
                let title = title.replace('_', " ");
                format!("{}\n{title}\n{}", record.text(), minima.render(Format::Text))
            }
            format => record.with("active", active.join("+")).render(format),
        };
        self.output.emit(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}
