//! One binary for all tests.

mod common;
mod local;
mod meshes;
mod reference;
mod surface;
