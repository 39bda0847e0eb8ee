//! The built-in families, one file each: a constructor that returns a [`Scheme`](crate::Scheme).

mod catmull_clark;
mod doo_sabin;
mod tension;

pub use catmull_clark::{catmull_clark, catmull_clark_weights};
pub use doo_sabin::doo_sabin;
pub use tension::{MAX_ORDER, tension};
