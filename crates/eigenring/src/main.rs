//! The eigenring command.
//!
//! Each module of `commands` is one subcommand: its arguments, and where the results go. What is computed is
//! a function of `eigenring-atlas`, which is told of arguments as plain values and knows nothing of command
//! lines, terminals and exit codes. Exit codes: 0 done or proven, 1 refuted or different, 2 bad input.

mod args;
mod checkpoint;
mod command_line;
mod commands;
mod error;
mod files;
mod memory;
mod output;
mod progress;
mod threads;
mod valences;

use clap::Parser;
use error::Error;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args_os().collect();
    // known before parsing, since errors of parsing are reported in this format too
    let json = arguments
        .windows(2)
        .any(|pair| pair[0] == "--format" && pair[1] == "json")
        || arguments.iter().any(|argument| argument == "--format=json");
    let result = match commands::Cli::try_parse_from(&arguments) {
        Ok(cli) => cli.run(),
        Err(error) if !error.use_stderr() => {
            // --help and --version, in colour only on a terminal; a reader that has gone away is no error
            let _ = error.print();
            return ExitCode::SUCCESS;
        }
        Err(error) => Err(Error::CommandLine(command_line::explain(&error, &arguments))),
    };
    match result {
        Ok(verdict) => verdict,
        Err(error) => {
            progress::say(&match json {
                true => error.json(),
                false => format!("error: {}", error.line()),
            });
            ExitCode::from(2)
        }
    }
}
