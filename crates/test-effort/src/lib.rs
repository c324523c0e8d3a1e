//! How much the tests of all crates try. `cargo xtask test --thorough` sets the environment variable `LSYSTEM_CASES`
//! to more than the usual number of random cases, and tests with a fixed list of cases then try the full list.

use proptest::test_runner::Config;

/// The number of random cases of a property test, unless `LSYSTEM_CASES` has another.
const USUAL: u32 = 200;

/// The number of random cases of a property test.
pub fn cases() -> u32 {
    std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(USUAL)
}

/// The configuration of a property test.
pub fn config() -> Config {
    Config { cases: cases(), failure_persistence: None, ..Config::default() }
}

/// Whether a test with a fixed list of cases tries all of them, in full size.
pub fn is_thorough() -> bool {
    cases() > USUAL
}

/// Of a list of cases one in `every`, beginning with the number `from`: always the same ones. All cases if the test is
/// thorough.
pub fn sampled<T>(cases: impl IntoIterator<Item = T>, every: usize, from: usize) -> impl Iterator<Item = T> {
    cases.into_iter().enumerate().filter(move |(at, _)| is_thorough() || at % every == from).map(|(_, case)| case)
}
