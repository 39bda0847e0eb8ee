//! Progress of long work: bars on standard error, and only if that is a terminal.
//!
//! Nothing is shown of work that takes less than a second. Whatever a command does, a line with the time that
//! has passed appears then ([`watch`]); bars of counted work stand below it.

use eigenring_atlas::progress::{Progress, Task};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::sync::LazyLock;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

/// How long work may take without a word.
const PATIENCE: Duration = Duration::from_secs(1);

/// When the program was started, or near enough.
static START: LazyLock<Instant> = LazyLock::new(Instant::now);

/// All bars on the screen: work that is started within work has a line of its own. Hidden unless standard
/// error is a terminal.
static BARS: LazyLock<MultiProgress> = LazyLock::new(|| MultiProgress::with_draw_target(ProgressDrawTarget::hidden()));

/// Shows what is going on as soon as it takes longer than a second, until it is dropped.
pub struct Watch(Option<(Sender<()>, std::thread::JoinHandle<()>)>);

/// Watches the whole command. Does nothing unless standard error is a terminal.
pub fn watch() -> Watch {
    LazyLock::force(&START);
    if !std::io::stderr().is_terminal() {
        return Watch(None);
    }
    let (sender, receiver) = channel::<()>();
    let thread = std::thread::spawn(move || {
        if receiver.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
            return;
        }
        BARS.set_draw_target(ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{spinner} {msg}  {elapsed} elapsed");
        let line = BARS.insert(0, ProgressBar::new_spinner().with_elapsed(START.elapsed()));
        line.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        line.set_message("working");
        line.enable_steady_tick(Duration::from_millis(200));
        // until the command is done
        let _ = receiver.recv();
        line.finish_and_clear();
    });
    Watch(Some((sender, thread)))
}

impl Drop for Watch {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.0.take() {
            drop(sender);
            let _ = thread.join();
        }
    }
}

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

/// Does something with the bars off the screen.
pub fn pause<T>(work: impl FnOnce() -> T) -> T {
    BARS.suspend(work)
}

/// A line on standard error, above the bars.
pub fn say(text: &str) {
    // whoever does not listen is not told
    pause(|| drop(writeln!(std::io::stderr(), "{text}")));
}

/// A remark on standard error, above the bars.
pub fn note(text: &str) {
    say(&format!("note: {text}"));
}
