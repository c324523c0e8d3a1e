//! How many random systems a property is tried with.

use proptest::prelude::ProptestConfig;

/// 500 cases, or as many as `LSYSTEM_CASES` says.
pub(crate) fn cases() -> ProptestConfig {
    let cases = std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(500);
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}
