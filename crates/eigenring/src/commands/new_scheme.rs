//! `eigenring new-scheme`: a scheme file to start from.

use crate::error::Error;
use crate::files;
use clap::Args;
use eigenring_scheme::user::{Starter, starters};
use std::path::PathBuf;
use std::process::ExitCode;

/// Write a commented scheme file to start from: a built-in scheme as formulas.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  eigenring new-scheme --like catmull-clark -o my.toml\n  eigenring verify --scheme file:my.toml,a=1.4 -N 5"
)]
pub struct Arguments {
    /// The scheme that it is at first
    #[arg(long, value_name = "SCHEME", value_parser = starter)]
    like: Starter,
    /// The file to write; standard output by default
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The file of a scheme.
fn starter(text: &str) -> Result<Starter, String> {
    let found = starters().iter().find(|starter| starter.like == text);
    found.copied().ok_or_else(|| {
        let known: Vec<&str> = starters().iter().map(|starter| starter.like).collect();
        format!("accepted are {}", known.join(", "))
    })
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        if let Some(path) = self.output.as_deref().filter(|path| path.exists()) {
            let message = format!("{} exists", path.display());
            return Err(Error::usage(message, "the name of a new file"));
        }
        files::emit(self.output.as_deref(), self.like.text.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}
