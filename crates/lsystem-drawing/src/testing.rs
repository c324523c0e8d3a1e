//! What the tests of several files share.

/// How many cases a property test tries: 500, or what the environment variable `LSYSTEM_CASES` says.
pub(crate) fn cases() -> u32 {
    std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(500)
}
