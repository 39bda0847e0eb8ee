//! Galerkin solutions against closed forms, a prototype's numbers, and code that shares nothing.

mod analysis;
mod common;
mod hnuss;
mod intervals;
mod multigrid;
mod problems;
mod spectra;
mod tensor;
