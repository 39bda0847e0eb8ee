//! `--threads`: how many threads work in parallel.

use crate::error::Error;
use clap::Args;

/// How many threads there are.
#[derive(Args, Clone, Copy, Debug)]
pub struct Threads {
    /// Threads; by default one for each core. Results do not depend on it
    #[arg(long, value_name = "T", value_parser = count, allow_negative_numbers = true)]
    threads: Option<u16>,
}

fn count(text: &str) -> Result<u16, String> {
    let count = text.parse().ok().filter(|count| (1..=1024).contains(count));
    count.ok_or_else(|| "accepted is 1 to 1024".to_owned())
}

impl Threads {
    /// Starts them, before anything is done in parallel.
    ///
    /// # Errors
    /// More than the system allows.
    pub fn start(self) -> Result<(), Error> {
        let Some(count) = self.threads else {
            return Ok(());
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count.into());
        pool.build_global()
            .map_err(|error| Error::usage(format!("cannot start {count} threads: {error}"), "a smaller --threads"))
    }

    /// How many were asked for.
    pub fn given(self) -> Option<u16> {
        self.threads
    }
}
