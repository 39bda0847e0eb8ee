//! The eigenring command.
//!
//! Each module of `commands` is one subcommand: its arguments and what it does. `table` and `files` put results out, `schemes`
//! finds schemes by name, `run` computes what is tabulated and `results` puts it into files. Exit codes: 0 done or proven, 1 refuted or
//! different, 2 bad input.

mod args;
mod cache;
mod checkpoint;
mod commands;
mod compare;
mod error;
mod files;
mod progress;
mod results;
mod run;
mod schemes;
mod table;

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
            // --help and --version
            print!("{}", error.render().ansi());
            return ExitCode::SUCCESS;
        }
        Err(error) => Err(Error::CommandLine(one_line(&error))),
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

/// The parser's message without its usage section, on one line.
fn one_line(error: &clap::Error) -> String {
    if error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "no command is given: accepted are the commands that 'eigenring --help' lists".to_owned();
    }
    let text = error.render().to_string();
    let message = text.split("\n\nUsage:").next().unwrap_or(&text);
    let message = message.split("\n\nFor more information").next().unwrap_or(message);
    let line = message.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = line.trim_start_matches("error: ").to_owned();
    line.replace("[possible values:", "[accepted are")
}
