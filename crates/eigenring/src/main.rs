//! The eigenring command.
//!
//! Each module of `commands` is one subcommand: its arguments and what it does. `table` and `files` put results out, `schemes`
//! finds schemes by name, `run` computes what is tabulated and `results` puts it into files. Exit codes: 0 done or proven, 1 refuted or
//! different, 2 bad input.

mod args;
mod cache;
mod checkpoint;
mod command_line;
mod commands;
mod compare;
mod error;
mod figures;
mod files;
mod index;
mod progress;
mod results;
mod run;
mod schemes;
mod table;
mod tension;

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
            if json {
                eprintln!("{}", error.json());
            } else {
                eprintln!("error: {}", error.line());
            }
            ExitCode::from(2)
        }
    }
}
