//! One binary for all tests.

mod blending;
mod common;
mod local;
mod meshes;
mod reference;
mod surface;
