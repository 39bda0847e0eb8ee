//! How much memory there is, and what does not fit.

/// The part of the available memory that work may plan to use.
const SHARE: f64 = 0.8;

/// The memory that can be had without swapping, in bytes; `None` where the system does not say.
fn available() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// If so many bytes are too many: the bytes that are available, and those that are accepted.
pub fn excess(bytes: f64) -> Option<[f64; 2]> {
    let available = available()?;
    // a NaN is refused
    (!(bytes <= SHARE * available)).then_some([available, SHARE * available])
}
