//! Progress of long work: a bar on standard error, and only if that is a terminal.

use eigenring_atlas::progress::{Progress, Task};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::LazyLock;

/// All bars on the screen: work that is started within work has a line of its own. Hidden unless standard
/// error is a terminal.
static BARS: LazyLock<MultiProgress> = LazyLock::new(|| {
    let target = if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    };
    MultiProgress::with_draw_target(target)
});

/// Bars and notes on standard error, for people; programs read standard output.
#[derive(Clone, Copy, Debug)]
pub struct Terminal;

/// A bar that is taken off the screen when its work is done.
struct Bar(ProgressBar);

impl Progress for Terminal {
    fn started<'a>(&'a self, what: &str, total: usize) -> Box<dyn Task + 'a> {
        Box::new(Bar(bar(what, total)))
    }

    fn note(&self, text: &str) {
        note(text);
    }
}

impl Task for Bar {
    fn advanced(&self) {
        self.0.inc(1);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A bar of `length` steps with a title.
pub fn bar(title: &str, length: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:22} [{bar:40}] {pos}/{len}  {elapsed} elapsed, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = BARS.add(ProgressBar::new(length as u64));
    bar.with_style(style).with_message(title.to_owned())
}

/// A remark on standard error, above the bars.
pub fn note(text: &str) {
    BARS.suspend(|| eprintln!("note: {text}"));
}
