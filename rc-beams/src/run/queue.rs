//! Several beams at once: one after the other from a queue, each on its share of the threads.

use std::sync::Mutex;
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::RunError;
use crate::exit::Exit;

/// Threads of one worker, and the prefix of their names.
#[derive(Debug)]
pub(super) struct Worker {
    pool: ThreadPool,
    /// Prefix of the names of the threads.
    pub threads: String,
}

/// Workers for a number of beams on a number of threads (0: one per core): as many as there is work for, the
/// threads shared out evenly. A beam gains little from a second thread, a second beam all of it.
pub(super) fn workers(beams: usize, threads: usize) -> Result<Vec<Worker>, RunError> {
    let threads = match threads {
        0 => thread::available_parallelism().map_or(1, usize::from),
        n => n,
    };
    let count = threads.min(beams).max(1);
    (0..count)
        .map(|w| {
            let own = threads / count + usize::from(w < threads % count);
            let prefix = format!("beam{w}-");
            let name = prefix.clone();
            let pool = ThreadPoolBuilder::new()
                .num_threads(own)
                .thread_name(move |i| format!("{name}{i}"))
                .build()?;
            let threads = prefix;
            Ok(Worker { pool, threads })
        })
        .collect()
}

/// Runs every item, in order of the queue; after one that could not be written, or an interruption, no other is started. The
/// gravest exit and the items that were not started.
pub(super) fn run<'t, T: Sync>(
    workers: &[Worker],
    items: &'t [T],
    job: impl Fn(&T, &Worker) -> Exit + Sync,
) -> (Exit, &'t [T]) {
    let state = Mutex::new((items.iter(), Exit::Done));
    let next = || {
        let mut guard = state
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        let stopped = matches!(guard.1, Exit::File | Exit::Interrupted);
        if stopped { None } else { guard.0.next() }
    };
    let done = |exit: Exit| {
        let mut guard = state
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        guard.1 = guard.1.max(exit);
    };
    thread::scope(|scope| {
        for worker in workers {
            scope.spawn(|| {
                while let Some(item) = next() {
                    done(worker.pool.install(|| job(item, worker)));
                }
            });
        }
    });
    let (left, gravest) = state
        .into_inner()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    (gravest, left.as_slice())
}

#[cfg(test)]
mod tests {
    //! Protects the queue: every beam is run once, and none is begun after the user has stopped the program.
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn threads_are_shared_out() {
        let sizes = |beams, threads| -> Vec<usize> {
            let workers = workers(beams, threads).unwrap();
            workers
                .iter()
                .map(|w| w.pool.current_num_threads())
                .collect()
        };
        assert_eq!(sizes(1, 2), [2]);
        assert_eq!(sizes(21, 2), [1, 1]);
        assert_eq!(sizes(2, 5), [3, 2]);
    }

    #[test]
    fn every_item_is_run_once() {
        let items: Vec<AtomicUsize> = (0..20).map(|_| AtomicUsize::new(0)).collect();
        let (exit, left) = run(&workers(20, 2).unwrap(), &items, |item, _| {
            item.fetch_add(1, Ordering::Relaxed);
            Exit::StoppedEarly
        });
        assert_eq!(exit, Exit::StoppedEarly);
        assert!(left.is_empty());
        assert!(items.iter().all(|n| n.load(Ordering::Relaxed) == 1));
    }

    #[test]
    fn nothing_is_started_after_an_interruption_or_on_a_full_disk() {
        for end in [Exit::Interrupted, Exit::File] {
            let begun = AtomicUsize::new(0);
            let run = run(&workers(1, 1).unwrap(), &[0, 1, 2], |_, _| {
                begun.fetch_add(1, Ordering::Relaxed);
                end
            });
            assert_eq!(run, (end, &[1, 2][..]));
            assert_eq!(begun.load(Ordering::Relaxed), 1);
        }
    }
}
