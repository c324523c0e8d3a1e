//! How much the tests of all crates try. `cargo xtask test --thorough` sets the environment variable `LSYSTEM_CASES`
//! to more than the usual number of random cases, and tests with a fixed list of cases then try the full list.

use proptest::test_runner::Config;

/// The number of random cases of a property test, unless `LSYSTEM_CASES` has another.
const USUAL: u32 = 500;

/// The number of random cases of a property test.
#[must_use]
pub fn cases() -> u32 {
    std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(USUAL)
}

/// The configuration of a property test.
#[must_use]
pub fn config() -> Config {
    Config { cases: cases(), failure_persistence: None, ..Config::default() }
}

/// Whether a test with a fixed list of cases tries all of them, in full size.
#[must_use]
pub fn is_thorough() -> bool {
    cases() > USUAL
}
