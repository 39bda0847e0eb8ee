//! Progress of long work: a bar on standard error, and only if that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;

/// A bar of `length` steps with a title; hidden unless standard error is a terminal.
pub fn bar(title: &str, length: usize) -> ProgressBar {
    let target = if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    };
    let style = ProgressStyle::with_template("{msg:22} [{bar:40}] {pos}/{len}  {elapsed} elapsed, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::with_draw_target(Some(length as u64), target)
        .with_style(style)
        .with_message(title.to_owned())
}

/// A remark on standard error, for people; programs read standard output.
pub fn note(text: &str) {
    eprintln!("note: {text}");
}
