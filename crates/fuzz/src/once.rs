//! One execution of a target.

use crate::{Gauge, Source, Target, told, worker};
use anyhow::{Context, Result, bail};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Once;

thread_local! {
    /// The place and the message of the last panic.
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Runs a target with an input. Returns the resources used, and the fault, if any.
pub(crate) fn once(target: &Target, source: &mut Source<'_>) -> (Gauge, Result<(), String>) {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        std::panic::set_hook(Box::new(|info| {
            let place = info.location().map(|place| format!("{}:{}", place.file(), place.line())).unwrap_or_default();
            let payload = info.payload();
            let text = payload.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("?");
            PANIC.with_borrow_mut(|message| *message = format!("{place}: {text}"));
        }));
    });
    let mut gauge = Gauge::new();
    let ended = catch_unwind(AssertUnwindSafe(|| (target.run)(source, &mut gauge)));
    let outcome = ended.map_err(|_| PANIC.take()).and_then(|()| gauge.check());
    (gauge, outcome)
}

/// Runs a target with an input for libFuzzer, whose own limit of time is one on the wall.
///
/// # Panics
/// If a property does not hold.
pub fn guided(target: &Target, bytes: &[u8]) {
    worker::begin();
    let mut gauge = Gauge::new();
    (target.run)(&mut Source::new(bytes), &mut gauge);
    if let Err(message) = gauge.check() {
        panic!("{message}");
    }
}

/// Tries the input in a file: a system if the name ends in `.json`, bytes otherwise.
///
/// # Errors
/// The fault, or a file that cannot be read.
pub fn replay(target: &Target, path: &Path) -> Result<()> {
    told::speak();
    let bytes = std::fs::read(path).with_context(|| format!("reading {}", path.display()))?;
    let is_system = path.extension().is_some_and(|ending| ending == "json");
    // The other choices of a failing system are in a file beside it.
    let beside = std::fs::read(path.with_extension("bytes")).unwrap_or_default();
    let mut source = Source::new(if is_system { &beside } else { &bytes });
    source.is_shown = true;
    if is_system {
        source.given = lsystem::read_file(&bytes).definition;
        if source.given.is_none() {
            bail!("{} has no system", path.display());
        }
    }
    let (gauge, outcome) = once(target, &mut source);
    let ((name, time), total, peak) = (gauge.slowest, gauge.total, gauge.peak() >> 10);
    println!("{}: peak {peak} KiB, {total} units of work, slowest call {name} {time:?}", target.name);
    outcome.map_err(|message| anyhow::anyhow!("{message}"))
}
