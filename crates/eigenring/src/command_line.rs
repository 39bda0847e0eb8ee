//! What the parser of the command line refuses, in one line that ends with what is accepted.

use crate::commands::Cli;
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;

/// The parser's complaint about these arguments, on one line.
pub fn explain(error: &clap::Error, arguments: &[OsString]) -> String {
    let context = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        Some(ContextValue::Strings(texts)) => Some(texts.join(", ")),
        _ => None,
    };
    let commands: Vec<String> = Cli::command()
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    match error.kind() {
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            return format!("no command is given: accepted are {}", commands.join(", "));
        }
        ErrorKind::InvalidSubcommand => {
            let given = context(ContextKind::InvalidSubcommand).unwrap_or_default();
            return format!("unknown command '{given}': accepted are {}", commands.join(", "));
        }
        ErrorKind::UnknownArgument => {
            let given = context(ContextKind::InvalidArg).unwrap_or_default();
            let similar =
                context(ContextKind::SuggestedArg).map_or(String::new(), |arg| format!(" (similar: '{arg}')"));
            let command = arguments
                .iter()
                .skip(1)
                .filter_map(|argument| argument.to_str())
                .find(|argument| commands.iter().any(|command| command == argument));
            let help = command.map_or("eigenring --help".to_owned(), |name| format!("eigenring {name} --help"));
            return format!("unexpected argument '{given}'{similar}: accepted are the options that '{help}' lists");
        }
        // an option with a list of words, or without its value
        ErrorKind::InvalidValue => {
            let given = context(ContextKind::InvalidValue).unwrap_or_default();
            let option = context(ContextKind::InvalidArg).unwrap_or_default();
            let complaint = match given.as_str() {
                "" => format!("no value is given for '{option}'"),
                given => format!("invalid value '{given}' for '{option}'"),
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
    line.trim_start_matches("error: ").to_owned()
}
