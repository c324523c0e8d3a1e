//! The number of random cases of a property test.

use proptest::prelude::ProptestConfig;

/// The number in the environment variable `LSYSTEM_CASES`, or 500.
pub(crate) fn cases() -> ProptestConfig {
    let cases = std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(500);
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}
