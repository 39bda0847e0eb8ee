//! `eigenring glossary`: what the words in tables, help texts and JSON mean.

use crate::error::Error;
use crate::files;
use clap::Args;
use eigenring_atlas::glossary;
use std::process::ExitCode;

/// Say what the words mean that tables, help texts and JSON use.
#[derive(Args, Debug)]
#[command(after_long_help = glossary::plain(None))]
pub struct Arguments {}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        files::emit(None, glossary::plain(None).as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}
