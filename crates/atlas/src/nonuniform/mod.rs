//! What is printed of schemes with knot intervals.

pub mod blending;
pub mod limits;
pub mod verify;
