//! Why a command fails, and how it is said: one line, exit code 2.

use std::path::PathBuf;

/// Everything that can go wrong, with the offending values.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    #[error(transparent)]
    Spline(#[from] eigenring_spline::Error),
    #[error(transparent)]
    Spectral(#[from] eigenring_spectral::Error),
    #[error(transparent)]
    Objective(#[from] eigenring_tune::objective::Error),
    #[error(transparent)]
    Search(#[from] eigenring_tune::search::Error),
    #[error(transparent)]
    Sweep(#[from] eigenring_tune::sweep::Error),
    #[error(transparent)]
    Study(#[from] eigenring_tune::study::Error),
    #[error(transparent)]
    Figure(#[from] eigenring_figure::Error),
    #[error(transparent)]
    Certify(#[from] eigenring_certify::Error),
    #[error("cannot read {}: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("cannot write {}: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    #[error("cannot write to standard output: {0}")]
    Output(#[source] std::io::Error),
    #[error("{}: {message}", path.display())]
    BadFile { path: PathBuf, message: String },
    #[error("{what} {given} is out of range: accepted is {accepted}")]
    Range {
        what: &'static str,
        given: String,
        accepted: String,
    },
    #[error("{message}: accepted is {accepted}")]
    Usage { message: String, accepted: String },
    #[error("cannot start this program again: {0}")]
    Start(#[source] std::io::Error),
    #[error("'{command}' failed: {message}")]
    Rebuild { command: String, message: String },
    /// What the command line parser says, cut to one line.
    #[error("{0}")]
    CommandLine(String),
}

impl Error {
    /// The message on one line.
    pub fn line(&self) -> String {
        self.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// The accepted values, which every message about a value out of range ends with.
    pub fn accepted(&self) -> Option<String> {
        let line = self.line();
        let (_, accepted) = line.rsplit_once("accepted ")?;
        let accepted = accepted.trim_start_matches("is ").trim_start_matches("are ");
        Some(accepted.to_owned())
    }

    /// `{error, accepted}` for programs.
    pub fn json(&self) -> String {
        serde_json::json!({ "error": self.line(), "accepted": self.accepted() }).to_string()
    }
}
