//! Work that does not fit into memory.

use crate::error::Error;
use eigenring_atlas::memory::excess;

/// Refuses work that would take so many bytes if that is too much and not forced.
pub fn check(bytes: f64, force: bool, what: &str) -> Result<(), Error> {
    let Some([available, accepted]) = excess(bytes).filter(|_| !force) else {
        return Ok(());
    };
    let gigabytes = |bytes: f64| format!("{:.3e} GB", bytes / 1e9);
    Err(Error::usage(
        format!(
            "{what} would take {} of {} of memory",
            gigabytes(bytes),
            gigabytes(available)
        ),
        format!("up to {} (--force overrides)", gigabytes(accepted)),
    ))
}
