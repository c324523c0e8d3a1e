//! Shared by the tests of several files.

/// The number of cases of a property test: the environment variable `LSYSTEM_CASES`, or 500.
pub(crate) fn cases() -> u32 {
    std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(500)
}
