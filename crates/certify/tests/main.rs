//! The tests of this crate's public side, one binary.

mod certificates;
mod common;
mod corners;
mod faults;
mod stored;
