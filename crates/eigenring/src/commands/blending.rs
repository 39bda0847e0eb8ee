//! `eigenring blending`: the blending function of an extraordinary vertex with knot intervals.

use crate::args::{self, Schemes, number};
use crate::error::Error;
use crate::output::Output;
use crate::progress::Terminal;
use crate::threads::Threads;
use clap::Args;
use eigenring_atlas::nonuniform::blending;
use eigenring_nonuniform::{Scheme, Spokes};
use std::process::ExitCode;

/// Count the maxima of the blending function of an extraordinary vertex under schemes with knot intervals.
///
/// The function is the surface's height where the vertex has height 1 and all others 0. Others are the maxima
/// beside the highest one; a maximum counts if the function falls by more than 0.2 % of its highest value on
/// the way to a higher one, and depth is how far it falls from the deepest of them.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring blending --knots 10,1,1,10,1,1 --next 1,1,1,1,1,1\n  eigenring blending --knots 10,10,1,10,1 --next 1,1,1,1,1 --schemes nurss,hnuss --format csv"
)]
pub struct Arguments {
    /// Knot intervals of the first edge of each spoke, separated by commas
    #[arg(long, value_name = "D0,D1,..", value_delimiter = ',', value_parser = number, allow_hyphen_values = true, required = true)]
    knots: Vec<f64>,
    /// The intervals of all further edges of each spoke; by default the same
    #[arg(long, value_name = "A0,A1,..", value_delimiter = ',', value_parser = number, allow_hyphen_values = true)]
    next: Vec<f64>,
    #[command(flatten)]
    schemes: Schemes,
    /// Levels of the net at whose vertices the function is taken
    #[arg(long, value_name = "COUNT", default_value_t = 5, value_parser = args::count, allow_negative_numbers = true)]
    levels: usize,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        self.threads.start()?;
        let schemes: Vec<Scheme> = match self.schemes.given() {
            true => self
                .schemes
                .all()?
                .iter()
                .map(blending::with_intervals)
                .collect::<Result<_, _>>()?,
            false => blending::ALL.to_vec(),
        };
        let next = if self.next.is_empty() {
            self.knots.clone()
        } else {
            self.next
        };
        let spokes = Spokes::new(self.knots, next).map_err(eigenring_atlas::Error::from)?;
        let table = blending::table(&schemes, &spokes, self.levels, &Terminal)?;
        self.output.emit(&table.render(format))?;
        Ok(ExitCode::SUCCESS)
    }
}
