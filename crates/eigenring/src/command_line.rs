//! What the parser of the command line refuses, in one line that ends with what is accepted.

use crate::commands::Cli;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory};
use std::ffi::OsString;

/// The parser's complaint about these arguments, on one line.
pub fn explain(error: &clap::Error, arguments: &[OsString]) -> String {
    let context = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        Some(ContextValue::Strings(texts)) => Some(texts.join(", ")),
        _ => None,
    };
    let similar = |kind| context(kind).map_or(String::new(), |name| format!(" (did you mean '{name}'?)"));
    let mut cli = Cli::command();
    // so that the names of options can be asked for
    cli.build();
    let commands: Vec<&str> = cli.get_subcommands().map(Command::get_name).collect();
    let words = arguments.iter().skip(1).filter_map(|argument| argument.to_str());
    let command = words.clone().find(|word| commands.contains(word));
    let command = command.and_then(|name| cli.find_subcommand(name));
    let help = command.map_or("eigenring --help".to_owned(), |command| {
        format!("eigenring {} --help", command.get_name())
    });
    match error.kind() {
        ErrorKind::MissingRequiredArgument => {
            let missing = context(ContextKind::InvalidArg).unwrap_or_default();
            return format!("{missing} is missing: accepted is a command line with it, see '{help}'");
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            return format!("no command is given: accepted are {}", commands.join(", "));
        }
        ErrorKind::InvalidSubcommand => {
            let given = context(ContextKind::InvalidSubcommand).unwrap_or_default();
            let similar = similar(ContextKind::SuggestedSubcommand);
            return format!(
                "unknown command '{given}'{similar}: accepted are {}",
                commands.join(", ")
            );
        }
        ErrorKind::UnknownArgument => {
            let given = context(ContextKind::InvalidArg).unwrap_or_default();
            let similar = similar(ContextKind::SuggestedArg);
            return format!("unexpected argument '{given}'{similar}: accepted are the options that '{help}' lists");
        }
        // an option with a list of words, or without its value
        ErrorKind::InvalidValue => {
            let given = context(ContextKind::InvalidValue).unwrap_or_default();
            let option = context(ContextKind::InvalidArg).unwrap_or_default();
            let option = as_typed(&option, command, arguments);
            let complaint = match given.as_str() {
                "" => format!("no value is given for '{option}'"),
                given => {
                    let similar = similar(ContextKind::SuggestedValue);
                    format!("invalid value '{given}' for '{option}'{similar}")
                }
            };
            return match context(ContextKind::ValidValue).filter(|values| !values.is_empty()) {
                Some(values) => format!("{complaint}: accepted are {values}"),
                None => complaint,
            };
        }
        _ => {}
    }
    // the message without the usage section
    let text = error.render().to_string();
    let message = text.split("\n\nUsage:").next().unwrap_or(&text);
    let message = message.split("\n\nFor more information").next().unwrap_or(message);
    let line = message.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = line.trim_start_matches("error: ").to_owned();
    // each option that the message names
    let named = [ContextKind::InvalidArg, ContextKind::PriorArg]
        .into_iter()
        .filter_map(|kind| error.get(kind));
    let named = named.flat_map(|value| match value {
        ContextValue::String(text) => vec![text.clone()],
        ContextValue::Strings(texts) => texts.clone(),
        _ => Vec::new(),
    });
    let line = named.fold(line, |line, option| {
        line.replace(&option, &as_typed(&option, command, arguments))
    });
    match error.kind() {
        ErrorKind::ArgumentConflict => line + ": accepted is one of them",
        _ => line,
    }
}

/// An option in the form in which it was typed, such as `-N` for `--valence <N>`, or as the parser shows it
/// where it was not.
fn as_typed(shown: &str, command: Option<&Command>, arguments: &[OsString]) -> String {
    let shows = |arg: &&Arg| arg.to_string() == shown;
    let Some(arg) = command.and_then(|command| command.get_arguments().find(shows)) else {
        return shown.to_owned();
    };
    let mut names: Vec<String> = arg
        .get_long_and_visible_aliases()
        .unwrap_or_default()
        .iter()
        .map(|long| format!("--{long}"))
        .collect();
    names.extend(arg.get_short().map(|short| format!("-{short}")));
    let typed = |word: &str| {
        let is = |name: &&String| match word.strip_prefix(name.as_str()) {
            Some(rest) => rest.is_empty() || rest.starts_with('=') || !name.starts_with("--"),
            None => false,
        };
        names.iter().find(is).cloned()
    };
    let mut words = arguments.iter().skip(1).filter_map(|argument| argument.to_str());
    words.find_map(typed).unwrap_or_else(|| shown.to_owned())
}
