//! Processor time, which does not depend on the load of the machine.

use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// The time of the first call.
static START: LazyLock<Instant> = LazyLock::new(Instant::now);

/// The processor time of this process so far, to a hundredth of a second. Without Linux's `/proc`, the wall-clock time
/// since the first call.
pub(crate) fn processor_time() -> Duration {
    let told = std::fs::read_to_string("/proc/self/stat").ok().and_then(|text| ticks(&text));
    // The clock of `/proc` counts hundredths of a second on every machine.
    told.map_or_else(|| START.elapsed(), |ticks| Duration::from_millis(10 * ticks))
}

/// The ticks in user and kernel mode: fields 14 and 15. Field 2, a name in parentheses, may contain any characters.
fn ticks(text: &str) -> Option<u64> {
    let mut fields = text.rsplit_once(')')?.1.split_whitespace().skip(11);
    Some(fields.next()?.parse::<u64>().ok()? + fields.next()?.parse::<u64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_times_behind_any_name() {
        let text = "12 (a) b) R 1 2 3 4 5 6 7 8 9 10 150 25 0 0 20 0";
        assert_eq!(ticks(text), Some(175));
        assert_eq!(ticks("12 (a"), None);
    }
}
