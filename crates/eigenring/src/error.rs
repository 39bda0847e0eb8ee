//! Why a command fails, and how it is said: one line, exit code 2.

use eigenring_atlas::accepted_in;

/// Everything that can go wrong, with the offending values.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// What was asked for cannot be computed, read or written.
    #[error(transparent)]
    Atlas(#[from] eigenring_atlas::Error),
    #[error("cannot write to standard output: {0}")]
    Output(#[source] std::io::Error),
    #[error("cannot start this program again: {0}")]
    Start(#[source] std::io::Error),
    #[error("'{command}' failed: {message}")]
    Rebuild { command: String, message: String },
    /// What the command line parser says, cut to one line.
    #[error("{0}")]
    CommandLine(String),
}

impl From<eigenring_certify::Error> for Error {
    fn from(error: eigenring_certify::Error) -> Self {
        Error::Atlas(error.into())
    }
}

impl From<eigenring_figure::Error> for Error {
    fn from(error: eigenring_figure::Error) -> Self {
        Error::Atlas(error.into())
    }
}

impl From<eigenring_scheme::Error> for Error {
    fn from(error: eigenring_scheme::Error) -> Self {
        Error::Atlas(error.into())
    }
}

impl From<eigenring_surface::Error> for Error {
    fn from(error: eigenring_surface::Error) -> Self {
        Error::Atlas(error.into())
    }
}

impl From<eigenring_spline::Error> for Error {
    fn from(error: eigenring_spline::Error) -> Self {
        Error::Atlas(error.into())
    }
}

fn one_line(text: &str) -> String {
    let words = text.split_whitespace().map(|word| {
        let ends = |letter: char| !letter.is_ascii_digit() && letter != '.';
        let number = word.trim_matches(ends);
        match number.parse::<f64>() {
            // hundreds of zeros say less than an exponent
            Ok(value) if number.len() > LONG && value.is_finite() && !word.contains('/') => {
                word.replace(number, &format!("{value:e}"))
            }
            _ => word.to_owned(),
        }
    });
    words.collect::<Vec<_>>().join(" ")
}

/// Characters of the longest number that is printed digit by digit: those of all digits of a double.
const LONG: usize = 24;

impl Error {
    /// A combination of arguments that makes no sense.
    pub fn usage(message: impl Into<String>, accepted: impl Into<String>) -> Self {
        Error::Atlas(eigenring_atlas::Error::Usage {
            message: message.into(),
            accepted: accepted.into(),
        })
    }

    /// An argument out of range.
    pub fn range(what: &'static str, given: impl ToString, accepted: impl Into<String>) -> Self {
        Error::Atlas(eigenring_atlas::Error::Range {
            what,
            given: given.to_string(),
            accepted: accepted.into(),
        })
    }

    /// The message on one line.
    pub fn line(&self) -> String {
        one_line(&self.to_string())
    }

    /// The accepted values, with which every message about a value out of range ends.
    pub fn accepted(&self) -> Option<String> {
        let accepted = match self {
            Error::Atlas(error) => error.accepted(),
            // the parser has sentences only, and so has a command that was run
            Error::CommandLine(_) | Error::Rebuild { .. } => accepted_in(&self.line()),
            Error::Output(_) | Error::Start(_) => None,
        };
        accepted.map(|accepted| one_line(&accepted))
    }

    /// `{error, accepted}` for programs.
    pub fn json(&self) -> String {
        serde_json::json!({ "error": self.line(), "accepted": self.accepted() }).to_string()
    }
}
