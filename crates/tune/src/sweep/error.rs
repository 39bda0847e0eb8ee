//! What can go wrong in a sweep.

use crate::{objective, search};

/// Why a sample, a branch or a global optimum is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Valence, lambda, s, margin or phi is out of range, or no stencil is admissible.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// The objective cannot be set up.
    #[error(transparent)]
    Objective(#[from] objective::Error),
    /// The search found nothing.
    #[error(transparent)]
    Search(#[from] search::Error),
    /// The range of lambda is empty or its parts are.
    #[error(
        "range {start} to {end} with {below} + {above} steps: accepted are 0.125 < start < end < 1 and at least one step each"
    )]
    Range {
        /// Start of the range.
        start: f64,
        /// End of the range.
        end: f64,
        /// Steps below lambda_l.
        below: usize,
        /// Steps above lambda_l.
        above: usize,
    },
    /// Samples must belong to one valence, ascend strictly in lambda and have minima.
    #[error(
        "sample {index} at lambda = {lambda} of valence {valence}: accepted are samples of one valence with ascending lambda, each with a minimum"
    )]
    Samples {
        /// Position of the first bad sample.
        index: usize,
        /// Its lambda.
        lambda: f64,
        /// Its valence.
        valence: usize,
    },
    /// A minimum over lambda takes at least three samples to bracket.
    #[error("{count} samples: accepted are 3 and more")]
    TooFew {
        /// How many there are.
        count: usize,
    },
}
