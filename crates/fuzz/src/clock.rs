//! Processor time, which does not depend on the load of the machine. Systems other than Unix use the time on the wall.

#[cfg(unix)]
mod clocks {
    use rustix::time::{ClockId, clock_gettime};
    use std::time::Duration;

    fn time(clock: ClockId) -> Duration {
        let time = clock_gettime(clock);
        Duration::new(time.tv_sec.unsigned_abs(), time.tv_nsec.unsigned_abs() as u32)
    }

    /// The processor time of this process so far.
    pub(crate) fn process_time() -> Duration {
        time(ClockId::ProcessCPUTime)
    }

    /// The processor time of this thread so far.
    pub(crate) fn thread_time() -> Duration {
        time(ClockId::ThreadCPUTime)
    }
}

#[cfg(not(unix))]
mod clocks {
    use std::sync::LazyLock;
    use std::time::{Duration, Instant};

    /// The time of the first call.
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);

    pub(crate) fn process_time() -> Duration {
        START.elapsed()
    }

    pub(crate) use process_time as thread_time;
}

pub(crate) use clocks::{process_time, thread_time};

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn sleep_takes_no_processor_time() {
        let before = thread_time();
        std::thread::sleep(Duration::from_millis(300));
        let asleep = thread_time() - before;
        assert!(!cfg!(unix) || asleep < Duration::from_millis(100), "{asleep:?}");
        let (process, thread) = (process_time(), thread_time());
        // `black_box` keeps the loop, which has no result.
        (0..20_000_000_u64).for_each(|number| _ = std::hint::black_box(number));
        let thread = thread_time() - thread;
        let process = process_time() - process;
        assert!(process >= thread && thread > Duration::ZERO, "{process:?} {thread:?}");
    }
}
