//! What can go wrong in a search.

/// Why there is no optimum.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The function is finite at no starting point. For the objective this happens near lambda = 1, where the
    /// natural configurations of all feasible stencils fold over.
    #[error(
        "at N = {valence}, lambda = {lambda} the objective is finite at none of {points} starting points: accepted is a smaller lambda (0.15 to 0.9 is tabulated)"
    )]
    NoFiniteValue {
        /// The valence.
        valence: usize,
        /// The subdominant eigenvalue.
        lambda: f64,
        /// How many points were tried.
        points: usize,
    },
    /// A given starting point is not a number.
    #[error("starting point f2 = {f2}, f3 = {f3}: accepted are finite numbers")]
    NotFinite {
        /// The face stencil's weight of each edge neighbour.
        f2: f64,
        /// The face stencil's weight of the opposite corner.
        f3: f64,
    },
}
