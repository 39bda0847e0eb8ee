//! How much memory there is, and what does not fit.

use crate::error::Error;

/// The part of the available memory that a command may plan to use.
const SHARE: f64 = 0.8;

/// The memory that can be had without swapping, in bytes; `None` where the system does not say.
fn available() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// Refuses work that would take so many bytes if that is too much and not forced.
pub fn check(bytes: f64, force: bool, what: &str) -> Result<(), Error> {
    let Some(available) = available().filter(|_| !force) else {
        return Ok(());
    };
    if bytes <= SHARE * available {
        return Ok(());
    }
    let gigabytes = |bytes: f64| format!("{:.3e} GB", bytes / 1e9);
    Err(Error::usage(
        format!(
            "{what} would take {} of {} of memory",
            gigabytes(bytes),
            gigabytes(available)
        ),
        format!("up to {} (--force overrides)", gigabytes(SHARE * available)),
    ))
}
