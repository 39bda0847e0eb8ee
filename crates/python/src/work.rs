//! Long work: without the interpreter's lock, on a thread of its own, while the calling thread listens for
//! Ctrl-C and tells the caller's callback how far the work has come.
//!
//! The pool of threads is the package's own. That of rayon is made once in a process: it is not there after a
//! fork, and a callback on one of its threads that asks for further work would wait for itself.
//!
//! Work ends early at the next step that it reports: the report unwinds through it. What reports nothing for
//! a while runs on in the background until then, and its result is dropped.

use crate::failure::Failure;
use crate::input::shown;
use eigenring_atlas::memory::excess;
use eigenring_atlas::progress::{Progress, Task};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// How long an interrupt may wait.
const PAUSE: Duration = Duration::from_millis(50);

/// The pool, and the process that has made it.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads on which work falls into parts.
fn pool() -> Result<Arc<ThreadPool>, Failure> {
    let new = || {
        let named = ThreadPoolBuilder::new().thread_name(|index| format!("eigenring-{index}"));
        let built = named.build();
        built.map(Arc::new).map_err(|error| {
            let message = format!("no threads can be started: {error}");
            Failure::from(PyRuntimeError::new_err(message))
        })
    };
    // work within work has threads of its own
    if rayon::current_thread_index().is_some() {
        return new();
    }
    // after a fork in which another thread had the lock there is nobody to open it
    let Ok(mut kept) = POOL.try_lock() else {
        return new();
    };
    let process = std::process::id();
    if let Some((owner, pool)) = kept.as_ref()
        && *owner == process
    {
        return Ok(Arc::clone(pool));
    }
    let pool = new()?;
    // the threads of the other process cannot be told to stop
    std::mem::forget(kept.replace((process, Arc::clone(&pool))));
    Ok(pool)
}

/// Later work gets other threads.
fn abandon(pool: &Arc<ThreadPool>) {
    if let Ok(mut kept) = POOL.try_lock()
        && kept.as_ref().is_some_and(|(_, kept)| Arc::ptr_eq(kept, pool))
    {
        *kept = None;
    }
}

/// What is being done: name, steps done, steps in all.
#[derive(Debug, Default)]
struct Stage {
    what: String,
    done: AtomicUsize,
    total: usize,
}

/// How far work has come, and whether it is still wanted.
#[derive(Clone, Debug, Default)]
pub struct Reporter {
    stage: Arc<Mutex<Arc<Stage>>>,
    cancelled: Arc<AtomicBool>,
}

/// What unwinds when work is no longer wanted.
struct Cancelled;

/// A stage of the work that has begun.
struct Running<'a> {
    reporter: &'a Reporter,
    stage: Arc<Stage>,
}

impl Reporter {
    fn check(&self) {
        if self.cancelled.load(Ordering::Relaxed) {
            // without the message of a panic
            resume_unwind(Box::new(Cancelled));
        }
    }

    /// Work is no longer wanted.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    fn now(&self) -> Arc<Stage> {
        let stage = self.stage.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        Arc::clone(&stage)
    }
}

impl Progress for Reporter {
    fn started<'a>(&'a self, what: &str, total: usize) -> Box<dyn Task + 'a> {
        self.check();
        let stage = Arc::new(Stage {
            what: what.to_owned(),
            done: AtomicUsize::new(0),
            total,
        });
        *self.stage.lock().unwrap_or_else(|poisoned| poisoned.into_inner()) = Arc::clone(&stage);
        Box::new(Running { reporter: self, stage })
    }

    fn note(&self, _: &str) {}
}

impl Task for Running<'_> {
    fn advanced(&self) {
        self.stage.done.fetch_add(1, Ordering::Relaxed);
        self.reporter.check();
    }
}

/// Refuses what does not fit into memory.
///
/// # Errors
/// More than a part of what is available.
pub fn check(bytes: f64, what: &str) -> Result<(), Failure> {
    match excess(bytes) {
        None => Ok(()),
        Some([available, accepted]) => {
            let gigabytes = |bytes: f64| format!("{:.3e} GB", bytes / 1e9);
            let message = format!(
                "{what} would take {} of {} of memory",
                gigabytes(bytes),
                gigabytes(available)
            );
            Err(Failure::usage(message, format!("up to {}", gigabytes(accepted))))
        }
    }
}

/// Work in one piece that reports nothing. If it may take `long`, it leaves the calling thread free for
/// Ctrl-C; what takes well below a millisecond would be delayed by the change of threads.
///
/// # Errors
/// Those of the work; KeyboardInterrupt.
pub fn alone<T, F>(py: Python<'_>, long: bool, work: F) -> Result<T, Failure>
where
    T: Send + 'static,
    F: FnOnce() -> Result<T, Failure> + Send + 'static,
{
    let listens = || -> PyResult<bool> {
        let threading = py.import("threading")?;
        let main = threading.call_method0("main_thread")?;
        Ok(threading.call_method0("current_thread")?.is(&main))
    };
    // interrupts reach the main thread alone
    match long && listens()? {
        true => run(py, None, move |_| work()),
        false => py.detach(work),
    }
}

/// Runs work and returns its result. `callback(what, done, total)` is called on the calling thread.
///
/// # Errors
/// Those of the work; KeyboardInterrupt; whatever the callback raises.
pub fn run<T, F>(py: Python<'_>, callback: Option<Py<PyAny>>, work: F) -> Result<T, Failure>
where
    T: Send + 'static,
    F: FnOnce(&Reporter) -> Result<T, Failure> + Send + 'static,
{
    if let Some(callback) = callback.as_ref().filter(|callback| !callback.bind(py).is_callable()) {
        let message = format!("progress is {}", shown(callback.bind(py)));
        return Err(Failure::usage(message, "a function of what, done and total"));
    }
    let pool = pool()?;
    let reporter = Reporter::default();
    let (sender, receiver) = channel();
    let own = reporter.clone();
    pool.spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(|| work(&own)));
        // whoever waited may be gone
        let _ = sender.send(result);
    });
    // the lock only makes the receiver fit to be used without the interpreter's own
    let receiver = Mutex::new(receiver);
    let mut told = (String::new(), usize::MAX);
    loop {
        let received = py.detach(|| {
            let receiver = receiver.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            receiver.recv_timeout(PAUSE)
        });
        let stage = reporter.now();
        let at = (stage.what.clone(), stage.done.load(Ordering::Relaxed));
        let listened = py.check_signals().and_then(|()| {
            let Some(callback) = callback.as_ref().filter(|_| at != told && !stage.what.is_empty()) else {
                return Ok(());
            };
            callback.call1(py, (at.0.as_str(), at.1, stage.total)).map(|_| ())
        });
        told = at;
        if let Err(error) = listened {
            reporter.cancel();
            // what reports nothing keeps its thread for a while, and others shall not wait for it
            abandon(&pool);
            return Err(error.into());
        }
        match received {
            Ok(Ok(result)) => return result,
            Ok(Err(_)) | Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the computation stopped: this is a mistake of eigenring").into());
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
}
