//! What is printed of schemes with knot intervals.

pub mod limits;
pub mod verify;
