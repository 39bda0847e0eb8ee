//! What is printed of schemes with knot intervals.

pub mod blending;
pub mod certificate;
pub mod counts;
pub mod limits;
pub mod picture;
pub mod verify;
