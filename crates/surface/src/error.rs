//! Why a mesh is refused or a surface has no answer.

use crate::defects::{Defect, in_words};

/// Everything that can go wrong here. A message is one line that ends with what is accepted where a value is
/// refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// From the rules.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// From local matrices.
    #[error(transparent)]
    Spectral(#[from] eigenring_spectral::Error),
    /// A file cannot be understood.
    #[error("{}{what}: accepted {accepted}", place(*line))]
    Syntax {
        /// The line, from 1; in binary files none.
        line: Option<u32>,
        /// What is wrong.
        what: String,
        /// What is accepted, with its verb.
        accepted: &'static str,
    },
    /// A file cannot be read or written to its end.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// A face names a point that is not there.
    #[error("face {face} names point {index}: accepted are 0 to {} (there are {points} points)", *points as i64 - 1)]
    NoSuchPoint {
        /// The face.
        face: usize,
        /// The index.
        index: i64,
        /// How many points there are.
        points: usize,
    },
    /// More than 32 bits can count.
    #[error("{count} {what}: accepted are up to {}", u32::MAX - 1)]
    TooLarge {
        /// Of what.
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// The mesh is no surface.
    #[error("{}", in_words(.0))]
    Defects(Vec<(Defect, Option<u32>)>),
    /// A mesh without faces.
    #[error("the mesh has no faces: accepted are meshes with one face or more")]
    Empty,
    /// A surface with one side only.
    #[error("the surface has one side (face {face} meets itself turned over): accepted are orientable surfaces")]
    NotOrientable {
        /// Where that is noticed.
        face: u32,
    },
    /// The scheme has no rules for something on the mesh.
    #[error("{what} at {elements}: accepted {accepted}")]
    NoRule {
        /// What has no rule.
        what: String,
        /// The elements, up to ten.
        elements: String,
        /// What is accepted, with its verb.
        accepted: String,
    },
    /// A place on the surface that does not exist.
    #[error("{what} {given} is out of range: accepted is {accepted}")]
    Range {
        /// What the value is.
        what: &'static str,
        /// The value.
        given: String,
        /// What is accepted.
        accepted: String,
    },
}

fn place(line: Option<u32>) -> String {
    line.map_or(String::new(), |line| format!("line {line}: "))
}

impl From<Vec<Defect>> for Error {
    fn from(defects: Vec<Defect>) -> Self {
        Error::Defects(defects.into_iter().map(|defect| (defect, None)).collect())
    }
}
