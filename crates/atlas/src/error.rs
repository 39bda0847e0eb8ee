//! Why something cannot be done, with the offending values and what is accepted in their place.

use std::fmt;
use std::path::{Path, PathBuf};

/// Everything that can go wrong. A message is one sentence, which ends with what is accepted wherever a value
/// is refused; [`Error::accepted`] gives that part by itself.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// From the rules: a valence, a parameter or a name.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// From splines, curves and grids.
    #[error(transparent)]
    Spline(#[from] eigenring_spline::Error),
    /// From matrices, eigenvalues and maps.
    #[error(transparent)]
    Spectral(#[from] eigenring_spectral::Error),
    /// From the objective of the tuning.
    #[error(transparent)]
    Objective(#[from] eigenring_tune::objective::Error),
    /// From the search over the feasible domain.
    #[error(transparent)]
    Search(#[from] eigenring_tune::search::Error),
    /// From samples over lambda.
    #[error(transparent)]
    Sweep(#[from] eigenring_tune::sweep::Error),
    /// From the study of a valence.
    #[error(transparent)]
    Study(#[from] eigenring_tune::study::Error),
    /// From meshes and surfaces.
    #[error(transparent)]
    Surface(#[from] eigenring_surface::Error),
    /// From knot intervals.
    #[error(transparent)]
    NonUniform(#[from] eigenring_nonuniform::Error),
    /// From finite elements.
    #[error(transparent)]
    Iga(#[from] eigenring_iga::Error),
    /// From drawing.
    #[error(transparent)]
    Figure(#[from] eigenring_figure::Error),
    /// From proofs and certificates.
    #[error(transparent)]
    Certify(#[from] eigenring_certify::Error),
    /// A file or folder cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A file or folder cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// What a file holds is refused.
    #[error("{}: {source}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong there.
        source: Box<Error>,
    },
    /// Text or stored data make no sense.
    #[error("{message}{}", accepted.as_ref().map_or(String::new(), |accepted| format!(": accepted {accepted}")))]
    Content {
        /// What is wrong, and where.
        message: String,
        /// What is accepted, if that can be said.
        accepted: Option<Accepted>,
    },
    /// A value is out of range.
    #[error("{what} {given} is out of range: accepted is {accepted}")]
    Range {
        /// What the value is.
        what: &'static str,
        /// The value as it was given.
        given: String,
        /// The values that are accepted.
        accepted: String,
    },
    /// What was asked for does not exist, or not together.
    #[error("{message}: accepted is {accepted}")]
    Usage {
        /// What is wrong.
        message: String,
        /// What is accepted.
        accepted: String,
    },
}

/// What is accepted in place of refused content, with the verb that fits it in a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Accepted {
    /// "accepted is ..".
    Is(String),
    /// "accepted are ..".
    Are(String),
}

impl Accepted {
    /// The words without the verb.
    pub fn words(&self) -> &str {
        match self {
            Accepted::Is(words) | Accepted::Are(words) => words,
        }
    }
}

impl fmt::Display for Accepted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Accepted::Is(words) => write!(f, "is {words}"),
            Accepted::Are(words) => write!(f, "are {words}"),
        }
    }
}

impl Error {
    /// Content that makes no sense, where nothing can be said of what would.
    pub fn content(message: impl Into<String>) -> Self {
        Error::Content {
            message: message.into(),
            accepted: None,
        }
    }

    /// Content in place of which something else is accepted.
    pub fn refused(message: impl Into<String>, accepted: Accepted) -> Self {
        Error::Content {
            message: message.into(),
            accepted: Some(accepted),
        }
    }

    /// The same, with the file that it is about.
    pub fn in_file(self, path: &Path) -> Self {
        Error::InFile {
            path: path.to_owned(),
            source: Box::new(self),
        }
    }

    /// What is accepted, in the words with which the message ends; `None` where no value is refused.
    pub fn accepted(&self) -> Option<String> {
        match self {
            Error::Range { accepted, .. } | Error::Usage { accepted, .. } => Some(accepted.clone()),
            Error::Content { accepted, .. } => accepted.as_ref().map(|accepted| accepted.words().to_owned()),
            Error::InFile { source, .. } => source.accepted(),
            Error::Read { .. } | Error::Write { .. } => None,
            // the libraries below keep their numbers in fields of their own, and end their messages with the
            // accepted ones
            Error::Scheme(_)
            | Error::Spline(_)
            | Error::Spectral(_)
            | Error::Objective(_)
            | Error::Search(_)
            | Error::Sweep(_)
            | Error::Study(_)
            | Error::Surface(_)
            | Error::NonUniform(_)
            | Error::Iga(_)
            | Error::Figure(_)
            | Error::Certify(_) => accepted_in(&self.to_string()),
        }
    }
}

/// The end of a message that says what is accepted, without the verb.
pub fn accepted_in(message: &str) -> Option<String> {
    let (_, accepted) = message.rsplit_once("accepted ")?;
    let accepted = accepted.trim_start_matches("is ").trim_start_matches("are ");
    Some(accepted.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_end_with_what_is_accepted() {
        let range = Error::Range {
            what: "margin",
            given: "2".to_owned(),
            accepted: "0 to 1".to_owned(),
        };
        let lambda = Error::from(eigenring_scheme::Error::Lambda { lambda: 2.0 });
        let content = Error::refused("row 2 is short", Accepted::Are("rows of equal length".to_owned()));
        for (error, accepted) in [
            (range, "0 to 1"),
            (lambda, "0.125 < lambda < 1"),
            (
                content.in_file(Path::new("accepted is nothing.csv")),
                "rows of equal length",
            ),
        ] {
            assert_eq!(error.accepted().as_deref(), Some(accepted));
            assert!(error.to_string().ends_with(accepted), "{error}");
        }
        assert_eq!(Error::content("no JSON").accepted(), None);
    }

    #[test]
    fn the_file_is_named_and_the_reason_kept() {
        let error = Error::from(eigenring_scheme::Error::Valence { valence: 2 }).in_file(Path::new("a.toml"));
        assert!(error.to_string().starts_with("a.toml: valence 2"), "{error}");
        let source = std::error::Error::source(&error).and_then(|source| source.downcast_ref::<Box<Error>>());
        assert!(source.is_some_and(|source| matches!(**source, Error::Scheme(_))));
    }
}
