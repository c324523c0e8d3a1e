//! The cost of deriving whole generations, and of remembering them.

use super::record::{Record, SHARE};
use super::systems::{Case, LENGTHS, cases, generations, shrinking};
use lsystem::base::{LimitName, Meter};
use lsystem::derive::{Fault, Rewriter};
use lsystem::drawing::why_empty;
use lsystem::{Definition, Limits, Progress, System};
use test_effort::{is_thorough, sampled};

/// Small limits, so that derivations exceed them soon.
const LIMITS: Limits =
    Limits { symbols: 4 << 20, modules: 1 << 20, segments: u32::MAX as u64, work: 100_000, memory: 24 << 20 };

/// The most units of a call that is not resumable.
const MAX_OF_A_CALL: u64 = 1 << 24;

fn rewriter(system: &System, limits: Limits) -> Option<Rewriter> {
    Rewriter::new(system.rules.clone(), system.seed, limits).ok()
}

/// Derives up to generation `n`, a `share` at a time.
fn derive(rewriter: &mut Rewriter, n: u32, share: u64, record: &mut Record) -> Result<(), Fault> {
    while rewriter.generation() < n {
        let before = rewriter.spent();
        let outcome = rewriter.advance(&mut Meter::new(share));
        record.step(share, rewriter.spent() - before);
        outcome?;
    }
    Ok(())
}

#[test]
fn a_step_of_a_derivation_is_bounded() {
    let all = LENGTHS.into_iter().flat_map(|length| cases(length).into_iter().map(move |case| (case, length)));
    for (Case { name, definition }, length) in sampled(all, 3, 0) {
        let Ok(system) = System::new(&definition) else { panic!("{name}") };
        // For the longest texts, only the last number of steps is tested: its derivation includes the others.
        let passed = if length < 20_000 || is_thorough() { 0 } else { generations(length).len() - 1 };
        for &n in &generations(length)[passed..] {
            let mut record = Record::new("derivation", &name, n);
            if let Some(mut rewriter) = rewriter(&system, LIMITS) {
                let _ = derive(&mut rewriter, n, SHARE, &mut record);
                record.finish(16 * LIMITS.work);
            }
            let mut record = Record::new("history", &name, n);
            if let Some(mut history) = system.history(n, &LIMITS) {
                while {
                    let before = history.spent();
                    let progress = history.step(SHARE as usize);
                    record.step(SHARE, history.spent() - before);
                    progress == Progress::More
                } {}
                record.finish(32 * LIMITS.work);
            }
            counts(&name, &system, n);
            whole_strings(&name, &system, n);
        }
    }
}

/// Symbols and segments are counted in bounded steps, however large the numbers are.
fn counts(name: &str, system: &System, n: u32) {
    for mut counter in [system.symbols(n), system.segments(n)] {
        let mut record = Record::new("counts", name, n);
        let mut steps = 0;
        // In long counts, the first steps are like the others.
        while steps < 50 && {
            let before = counter.spent();
            let progress = counter.step(SHARE);
            record.step(SHARE, counter.spent() - before);
            steps += 1;
            progress == Progress::More
        } {}
        record.finish(u64::MAX);
    }
}

/// Calls that are not resumable have a bounded total.
fn whole_strings(name: &str, system: &System, n: u32) {
    let limits = Limits { symbols: 1 << 20, work: 50_000, ..LIMITS };
    let mut record = Record::new("expand", name, n);
    let (_, spent) = lsystem::drawing::expand_counted(system, n, &limits);
    record.call(spent);
    record.finish(MAX_OF_A_CALL);
    let mut record = Record::new("word", name, n);
    let (word, spent) = system.word_counted(n);
    record.call(spent);
    record.finish(MAX_OF_A_CALL);
    if let Some(word) = word {
        let start = word.symbols() / 2;
        assert!(word.slice(start, 100).chars().count() >= 100.min((word.symbols() - start) as usize));
        assert!(word.ancestry(start).len() <= n as usize + 1);
    }
    let _ = why_empty(system, n);
}

/// The last complete generation of a derivation, the number of its modules, and the reason of the end.
fn outcome(system: &System, n: u32, share: u64, limits: Limits) -> (u32, usize, Result<(), Fault>) {
    let mut rewriter = rewriter(system, limits).expect("an axiom of finite numbers");
    let ended = derive(&mut rewriter, n, share, &mut Record::new("derivation", "", n));
    (rewriter.generation(), rewriter.word().letters.len(), ended)
}

#[test]
fn limits_are_passed_at_the_same_place_whatever_the_steps_are() {
    for Case { name, definition } in sampled(cases(100), 3, 1) {
        let system = System::new(&definition).expect("a system");
        if system.rules.is_plain() {
            continue;
        }
        for limits in [
            Limits { work: 20_000, ..LIMITS },
            Limits { modules: 3_000, ..LIMITS },
            Limits { memory: 1 << 20, ..LIMITS },
            Limits { memory: 300_000, work: 30_000, modules: 30_000, ..LIMITS },
        ] {
            let whole = outcome(&system, 12, u64::MAX, limits);
            for share in [1, 7, 1_000] {
                assert_eq!(outcome(&system, 12, share, limits), whole, "{name}, {share}, {limits:?}");
            }
        }
    }
}

#[test]
fn limits_are_checked_before_modules_are_made() {
    let definition = Definition { axiom: "AF".into(), rules: shrinking(300), ..Definition::default() };
    let system = System::new(&definition).expect("a system");
    for share in [1, SHARE, u64::MAX] {
        let (generation, modules, ended) = outcome(&system, 12, share, Limits { modules: 1 << 16, ..LIMITS });
        assert!(matches!(ended, Err(Fault::Limit(LimitName::Modules))), "{ended:?}");
        assert!(generation < 12 && modules <= 1 << 16);
    }
}
