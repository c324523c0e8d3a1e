//! Parallel work on many files: a worker for each core, and results in the order of the files.

use crate::progress::DelayedBar;
use crate::{CommandFailure, say};
use lsystem::base::word;
use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::{Mutex, PoisonError, RwLock, mpsc};
use std::thread;

/// Calls `work` on this thread and on `workers - 1` others, or on fewer if the system starts no more.
pub(crate) fn side_by_side(workers: usize, work: impl Fn() + Sync) {
    thread::scope(|scope| {
        let start = |_: &usize| thread::Builder::new().spawn_scoped(scope, &work).is_ok();
        (1..workers).take_while(start).count();
        work();
    });
}

/// Starts up to `workers` threads with work from `work`, beside this thread.
///
/// # Errors
/// [`CommandFailure::Words`] if the system starts none.
pub(crate) fn start<'scope, W: FnOnce() + Send + 'scope>(
    scope: &'scope thread::Scope<'scope, '_>,
    workers: usize,
    work: impl Fn() -> W,
) -> Result<(), CommandFailure> {
    for started in 0..workers {
        if let Err(error) = thread::Builder::new().spawn_scoped(scope, work()) {
            return if started > 0 { Ok(()) } else { Err(CommandFailure::io("threads", &error)) };
        }
    }
    Ok(())
}

/// The number of threads that run at the same time.
pub(crate) fn count() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// A receiver of messages about a file.
pub(crate) type Say<'a> = &'a mut dyn FnMut(&str);

/// The division of the limits among the files that are worked on at the same time.
pub(crate) struct SharedLimits {
    workers: u64,
    /// Work within a share holds the read lock; work that needs all limits holds the write lock.
    gate: RwLock<()>,
}

impl SharedLimits {
    fn new(workers: usize) -> Self {
        Self { workers: workers as u64, gate: RwLock::new(()) }
    }

    /// Calls `make` with the number of equal shares of the limits; `make` may use one share. If `make` exceeds a limit,
    /// it is called again with 1, while no other work runs. Returns the last result.
    pub(crate) fn make<T>(&self, mut make: impl FnMut(u64) -> Result<T, CommandFailure>) -> Result<T, CommandFailure> {
        if self.workers > 1 {
            let _beside_others = self.gate.read();
            let made = make(self.workers);
            if !matches!(made, Err(CommandFailure::Limit(_))) {
                return made;
            }
        }
        let _alone = self.gate.write();
        make(1)
    }
}

/// Does `work` for all `jobs`, on all cores. Prints messages and failures in the order of the jobs.
///
/// Returns the results of the successful jobs, in order, and whether all jobs succeeded.
pub(crate) fn in_order<J: Sync, R: Send>(
    jobs: &[J],
    work: impl Fn(&J, &SharedLimits, Say<'_>) -> Result<R, CommandFailure> + Sync,
) -> Result<(Vec<R>, bool), CommandFailure> {
    with_workers(count().min(jobs.len()), jobs, work)
}

fn with_workers<J: Sync, R: Send>(
    workers: usize,
    jobs: &[J],
    work: impl Fn(&J, &SharedLimits, Say<'_>) -> Result<R, CommandFailure> + Sync,
) -> Result<(Vec<R>, bool), CommandFailure> {
    let limits = SharedLimits::new(workers);
    let mut done = Done { results: vec![], is_good: true };
    if let [job] = jobs {
        done.add(work(job, &limits, &mut say))?;
        return Ok((done.results, done.is_good));
    }
    let queue = Mutex::new(jobs.iter().enumerate());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let (sender, receiver) = mpsc::channel();
    let worker = |sender: mpsc::Sender<_>| {
        while let Some((at, job)) = next() {
            let mut messages = String::new();
            let result = work(job, &limits, &mut |text| messages.push_str(text));
            if sender.send((at, messages, result)).is_err() {
                break;
            }
        }
    };
    thread::scope(|scope| {
        start(scope, workers, || {
            let (sender, worker) = (sender.clone(), &worker);
            move || worker(sender)
        })?;
        drop(sender);
        let mut progress = DelayedBar::new(word!("files"), Some(jobs.len() as u64));
        // Results that wait for earlier jobs, and the number of jobs whose messages are printed.
        let (mut waiting, mut printed) = (BTreeMap::new(), 0);
        for (at, messages, result) in receiver {
            waiting.insert(at, (messages, result));
            progress.at((printed + waiting.len()) as u64);
            while let Some((messages, result)) = waiting.remove(&printed) {
                say(&messages);
                done.add(result)?;
                printed += 1;
            }
        }
        Ok((done.results, done.is_good))
    })
}

/// The results so far.
struct Done<R> {
    results: Vec<R>,
    /// Whether no job has failed.
    is_good: bool,
}

impl<R> Done<R> {
    fn add(&mut self, result: Result<R, CommandFailure>) -> Result<(), CommandFailure> {
        match result {
            Ok(result) => self.results.push(result),
            Err(failure) => {
                self.is_good = false;
                failure.tell()?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    #[test]
    fn results_keep_the_order_of_the_jobs() {
        let jobs: Vec<u64> = (0..50).collect();
        let work = |&job: &u64, _: &SharedLimits, _: Say<'_>| {
            thread::sleep(Duration::from_micros(job * 7 % 13 * 100));
            if job == 20 { Err(CommandFailure::Said) } else { Ok(job) }
        };
        for workers in [1, 4] {
            let Ok((results, is_good)) = with_workers(workers, &jobs, work) else { panic!("no reader is gone") };
            assert!(!is_good && results.is_sorted() && results.len() == 49, "{results:?}");
        }
    }

    #[test]
    fn work_that_needs_all_is_alone() {
        let jobs: Vec<u64> = (0..40).collect();
        let at_work = AtomicUsize::new(0);
        let work = |&job: &u64, limits: &SharedLimits, _: Say<'_>| {
            limits.make(|shares| {
                let others = at_work.fetch_add(1, Ordering::SeqCst);
                thread::sleep(Duration::from_micros(200));
                at_work.fetch_sub(1, Ordering::SeqCst);
                match shares {
                    1 => Ok(others == 0),
                    _ if job % 5 == 0 => Err(CommandFailure::Limit(String::new())),
                    _ => Ok(true),
                }
            })
        };
        let Ok((results, true)) = with_workers(4, &jobs, work) else { panic!("nothing fails") };
        assert!(results.len() == 40 && results.iter().all(|&was_alone| was_alone));
    }
}
