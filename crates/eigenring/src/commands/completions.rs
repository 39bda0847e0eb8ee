//! `eigenring completions`: what a shell needs to complete command lines.

use super::Cli;
use crate::error::Error;
use crate::files;
use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};
use std::process::ExitCode;

/// Print a script that makes a shell complete commands and options.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring completions bash    save as ~/.local/share/bash-completion/completions/eigenring\n  eigenring completions zsh     save as _eigenring in a folder of $fpath\n  eigenring completions fish    save as ~/.config/fish/completions/eigenring.fish"
)]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let mut script = Vec::new();
        generate(self.shell, &mut Cli::command(), "eigenring", &mut script);
        files::emit(None, &script)?;
        Ok(ExitCode::SUCCESS)
    }
}
