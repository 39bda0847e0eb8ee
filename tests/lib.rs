//! Shared pieces of the oracles.
