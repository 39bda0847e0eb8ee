//! How long work tells of its progress, and the one loop that does it in parallel.
//!
//! What is told is for whoever waits, and changes no result. A command draws bars and prints notes; a program
//! that does not care passes [`Silent`].

use rayon::prelude::*;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Somebody who is told how far work has come. Work may be started within work, and from several threads.
pub trait Progress: fmt::Debug + Sync {
    /// Work of `total` equal steps begins; it is done when the returned value is dropped.
    fn started<'a>(&'a self, what: &str, total: usize) -> Box<dyn Task + 'a>;

    /// A remark on where numbers come from, in a sentence for people.
    fn note(&self, text: &str);
}

/// Work that has begun.
pub trait Task: Send + Sync {
    /// One more step is done.
    fn advanced(&self);
}

/// Nobody is told.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn started<'a>(&'a self, _: &str, _: usize) -> Box<dyn Task + 'a> {
        Box::new(Silent)
    }

    fn note(&self, _: &str) {}
}

impl Task for Silent {
    fn advanced(&self) {}
}

/// Maps items in parallel, on the threads of the current pool of rayon. Results are in the order of the items
/// and do not depend on the number of threads.
///
/// # Errors
/// The first one in the order of the items, whatever the number of threads. After an error no later item is
/// begun.
pub fn each<T: Sync, R: Send, E: Send>(
    progress: &dyn Progress,
    what: &str,
    items: &[T],
    work: impl Fn(&T) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let task = progress.started(what, items.len());
    let failed = AtomicUsize::new(usize::MAX);
    let results: Vec<Option<Result<R, E>>> = items
        .par_iter()
        .enumerate()
        // items differ much in size, the largest may take a thousand times as long as the smallest: each is
        // handed out by itself
        .with_max_len(1)
        .map(|(index, item)| {
            if index > failed.load(Ordering::Relaxed) {
                return None;
            }
            let result = work(item);
            if result.is_err() {
                failed.fetch_min(index, Ordering::Relaxed);
            }
            task.advanced();
            Some(result)
        })
        .collect();
    // what was left out comes after an error
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Default)]
    struct Counter {
        steps: AtomicUsize,
        done: AtomicUsize,
    }

    struct Counting<'a>(&'a Counter);

    impl Progress for Counter {
        fn started<'a>(&'a self, _: &str, _: usize) -> Box<dyn Task + 'a> {
            Box::new(Counting(self))
        }

        fn note(&self, _: &str) {}
    }

    impl Task for Counting<'_> {
        fn advanced(&self) {
            self.0.steps.fetch_add(1, Ordering::Relaxed);
        }
    }

    impl Drop for Counting<'_> {
        fn drop(&mut self) {
            self.0.done.fetch_add(1, Ordering::Relaxed);
        }
    }

    #[test]
    fn results_are_in_order_and_every_step_is_told() {
        let counter = Counter::default();
        let items: Vec<usize> = (0..100).collect();
        let squares = each(&counter, "squares", &items, |n| Ok::<_, ()>(n * n));
        assert_eq!(squares, Ok(items.iter().map(|n| n * n).collect()));
        assert_eq!(counter.steps.into_inner(), 100);
        assert_eq!(counter.done.into_inner(), 1);
        let failed = each(&Silent, "odd", &items, |n| if n % 2 == 0 { Ok(()) } else { Err(*n) });
        assert_eq!(failed, Err(1));
    }
}
