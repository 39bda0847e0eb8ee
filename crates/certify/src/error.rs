//! What can be wrong with what is handed in. An open question is no error: it is an undecided check.

/// Errors of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// From the rules: a valence, a parameter or a file that is not accepted.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// Coefficients that are no spline.
    #[error(transparent)]
    Spline(#[from] eigenring_spline::Error),
    /// From running the rules.
    #[error(transparent)]
    Spectral(#[from] eigenring_spectral::Error),
    /// A number that is not finite.
    #[error("{what} = {value} is not a finite number: accepted are finite numbers")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The valence of a certificate is the number of sectors of its corner.
    #[error("a corner of {found} sectors at valence {valence}: accepted is {found}")]
    Sectors {
        /// Sectors of the corner.
        found: usize,
        /// The valence that was given.
        valence: usize,
    },
    /// The net is too large to be certified.
    #[error("the local matrix has blocks of {size} unknowns: accepted are at most {maximum}")]
    Size {
        /// Unknowns of the largest block.
        size: usize,
        /// Largest accepted number.
        maximum: usize,
    },
    /// The weight f2 of the edge neighbours in the face rule, by which others are divided.
    #[error("f2 = 0: the closed forms divide by f2; accepted are other numbers")]
    EdgeWeight,
    /// A range of lambda that is empty or leaves the tabulated domain.
    #[error("lambda range {start}..{end}: accepted are {lower} <= A < B <= {upper}")]
    Range {
        /// Its start.
        start: f64,
        /// Its end.
        end: f64,
        /// Smallest accepted start.
        lower: f64,
        /// Largest accepted end.
        upper: f64,
    },
    /// A range of a parameter that is empty, or none of a scheme file.
    #[error("the range {}..{} of a parameter: accepted is A..B with A < B, of a parameter of a scheme file", ends[0], ends[1])]
    ParameterRange {
        /// Its ends, as text.
        ends: [String; 2],
    },
    /// All valences from one on that has, or comes before one that has, other blocks.
    #[error("all valences from {from} on: accepted is {least} to {most}")]
    Valences {
        /// The first.
        from: usize,
        /// Smallest accepted one.
        least: usize,
        /// Largest accepted one.
        most: usize,
    },
    /// A valence whose plane of stencils is another, or at which nothing was tried.
    #[error("the best stencil at valence {valence}: accepted are valences {least} to {most}")]
    Optimum {
        /// The valence.
        valence: usize,
        /// Smallest accepted one.
        least: usize,
        /// Largest accepted one.
        most: usize,
    },
    /// A margin that leaves nothing admissible.
    #[error("no stencil is admissible with a relative margin of {margin}: accepted are smaller ones from 0 on")]
    Margin {
        /// The margin.
        margin: f64,
    },
    /// A tolerance that is none.
    #[error("epsilon = {epsilon}: accepted is 0 < epsilon < 1")]
    Epsilon {
        /// The tolerance.
        epsilon: f64,
    },
    /// A requirement that is not known.
    #[error("requirement '{name}' is not known: accepted are {accepted}")]
    Requirement {
        /// What was asked for.
        name: String,
        /// Accepted names.
        accepted: String,
    },
    /// A certificate that is not JSON or not of this structure.
    #[error("certificate: line {line}, column {column}: {message}: accepted is a file of 'eigenring verify -o'")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
    },
    /// A certificate of another format.
    #[error("certificate: format version {found}: accepted is {accepted}")]
    Version {
        /// The file's version.
        found: u32,
        /// The version of this program.
        accepted: u32,
    },
}
