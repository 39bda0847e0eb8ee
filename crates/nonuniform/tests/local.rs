//! Properties of the local rules at any valence and interval set.
