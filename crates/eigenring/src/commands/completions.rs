//! `eigenring completions`: what a shell needs to complete command lines, and pages for man.

use super::Cli;
use crate::error::Error;
use crate::files;
use clap::builder::PossibleValue;
use clap::{Args, Command, CommandFactory, ValueEnum};
use clap_complete::{Shell, generate};
use std::process::ExitCode;

/// Print a script that makes a shell complete commands and options, or a page for man.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring completions bash    save as ~/.local/share/bash-completion/completions/eigenring\n  eigenring completions zsh     save as _eigenring in a folder of $fpath\n  eigenring completions fish    save as ~/.config/fish/completions/eigenring.fish\n  eigenring completions man     save as ~/.local/share/man/man1/eigenring.1\n  eigenring completions man tune    save as ~/.local/share/man/man1/eigenring-tune.1"
)]
pub struct Arguments {
    /// The shell, or man
    #[arg(value_enum)]
    shell: Reader,
    /// With man: the command whose page it is, in place of the page of them all
    command: Vec<String>,
}

/// Who reads what is printed.
#[derive(Clone, Copy, Debug)]
enum Reader {
    Shell(Shell),
    Man,
}

impl ValueEnum for Reader {
    fn value_variants<'a>() -> &'a [Self] {
        &[
            Reader::Shell(Shell::Bash),
            Reader::Shell(Shell::Elvish),
            Reader::Shell(Shell::Fish),
            Reader::Shell(Shell::PowerShell),
            Reader::Shell(Shell::Zsh),
            Reader::Man,
        ]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Reader::Shell(shell) => shell.to_possible_value(),
            Reader::Man => Some(PossibleValue::new("man")),
        }
    }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let mut text = Vec::new();
        let mut cli = Cli::command();
        match (self.shell, self.command.first()) {
            (Reader::Shell(shell), None) => generate(shell, &mut cli, "eigenring", &mut text),
            (Reader::Shell(_), Some(command)) => {
                let message = format!("'{command}' after the name of a shell");
                return Err(Error::usage(message, "a command after man"));
            }
            (Reader::Man, _) => {
                // gives commands below others their whole names
                cli.build();
                let page = self.command.iter().try_fold(&cli, below)?.clone();
                let source = format!("eigenring {}", env!("CARGO_PKG_VERSION"));
                let man = clap_mangen::Man::new(page).source(source);
                man.render(&mut text).map_err(Error::Output)?;
            }
        }
        files::emit(None, &text)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The command of a name below another.
fn below<'a>(command: &'a Command, name: &String) -> Result<&'a Command, Error> {
    command.find_subcommand(name).ok_or_else(|| {
        let names = command.get_subcommands().map(Command::get_name);
        let accepted: Vec<_> = names.filter(|&name| name != "help").collect();
        let accepted = match accepted.is_empty() {
            true => "no further name".to_owned(),
            false => accepted.join(", "),
        };
        Error::usage(format!("no command '{name}' below {}", command.get_name()), accepted)
    })
}
