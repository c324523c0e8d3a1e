//! Fuzzing by libFuzzer, which chooses inputs by the code that they reach. The environment variable `LSYSTEM_FUZZ`
//! names the target; the arguments are libFuzzer's.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lsystem_fuzz::{Target, guided, watch};
use std::sync::OnceLock;

static TARGET: OnceLock<&Target> = OnceLock::new();

fuzz_target!(
    init: {
        let name = std::env::var("LSYSTEM_FUZZ").unwrap_or_default();
        let target = Target::named(&name).unwrap_or_else(|| panic!("LSYSTEM_FUZZ names no target: `{name}`"));
        let _ = TARGET.set(target);
        watch();
    },
    |bytes: &[u8]| {
        if let Some(target) = TARGET.get() {
            guided(target, bytes);
        }
    }
);
