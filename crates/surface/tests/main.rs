//! Meshes and surfaces against other programs and independent evaluations, and files of all kinds. One
//! binary, since linking takes longer than running.

mod common;
mod files;
mod limits;
mod partial_creases;
mod rational;
mod references;
mod tension_limits;
