//! A table of what is found in pictures: how many systems of each family, from which inputs, in which time.
//!
//! `table [FAMILY ...] [inputs=clean,blur] [known=all,n,angle] [seconds=10] [of=100] [name=PART]
//! [verbose]`. Times are those of one thread,
//! on the processor where the system measures that.

mod cases;
mod inputs;

use cases::Case;
use lsystem_find::{FOUND, Finder, Question, Searched, Share};
use lsystem_syntax::Definition;
use std::sync::Arc;
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let option =
        |name: &str| words.iter().find_map(|word| word.strip_prefix(name)?.strip_prefix('=')).map(str::to_owned);
    let seconds: f64 = option("seconds").and_then(|text| text.parse().ok()).unwrap_or(10.0);
    let count = option("of").and_then(|text| text.parse().ok()).unwrap_or(100);
    let list = |name: &str, usual: &str| {
        option(name).unwrap_or_else(|| usual.to_owned()).split(',').map(str::to_owned).collect::<Vec<_>>()
    };
    let families: Vec<&String> = words.iter().filter(|word| !word.contains('=') && *word != "verbose").collect();
    let is_wanted = |family: &str| families.is_empty() || families.iter().any(|wanted| *wanted == family);
    let is_verbose = words.iter().any(|word| word == "verbose");
    println!(
        "{:<14}{:<14}{:<10}{:>10}{:>10}{:>10}{:>10}",
        "family", "input", "known", "found", "of", "median s", "most s"
    );
    for family in cases::FAMILIES.into_iter().filter(|family| is_wanted(family)) {
        let mut cases = cases::family(family, count);
        let wanted = option("name").unwrap_or_default();
        cases.retain(|case| case.name.contains(&wanted));
        for input in list("inputs", "clean") {
            for known in list("known", "all") {
                let mut times = Vec::new();
                for case in &cases {
                    let (is_found, time, said) = run(case, &input, &known, seconds);
                    if is_found {
                        times.push(time);
                    }
                    if is_verbose {
                        println!("  {is_found:<6}{time:>6.2} s  {}: {said}", case.name);
                    }
                }
                times.sort_by(f64::total_cmp);
                let (median, most) = (times.get(times.len() / 2), times.last());
                let time = |time: Option<&f64>| time.map_or("-".to_owned(), |time| format!("{time:.2}"));
                let (found, of) = (times.len(), cases.len());
                println!("{family:<14}{input:<14}{known:<10}{found:>10}{of:>10}{:>10}{:>10}", time(median), time(most));
            }
        }
    }
}

/// Whether a system is found that draws the same, or, for a picture of no system, whether one counts as found; the time
/// in seconds; and the best system.
fn run(case: &Case, input: &str, known: &str, seconds: f64) -> (bool, f64, String) {
    let shown = inputs::picture(case, input);
    let begin = now();
    let picture = match shown {
        Ok(picture) => Arc::new(picture),
        Err(why) => return (false, 0.0, why.to_owned()),
    };
    let system = &case.definition;
    let question = Question {
        axiom: Some(system.axiom.clone()),
        angle: (known != "angle").then_some(system.angle),
        n: (known == "all").then_some(system.iterations),
        ..Question::default()
    };
    let mut finder = match Finder::new(&picture, &question, Share::WHOLE) {
        Ok(finder) => finder,
        Err(why) => return (false, 0.0, why.to_owned()),
    };
    while !finder.is_same() && now() - begin < seconds && finder.step(2048) == Searched::More {}
    let time = now() - begin;
    let Some(best) = finder.found().first() else { return (false, time, finder.searched()) };
    let rules = best.found.text().replace('\n', "; ");
    let said = format!("{:.4} {rules} n={} {}° heading {}°", best.agreement, best.found.n, best.angle, best.heading);
    if !finder.is_found() {
        return (false, time, format!("{said} | {}", finder.searched()));
    }
    let same = if case.lines.is_some() { 1.0 } else { agreement(&best.definition(), system) };
    (same >= FOUND, time, format!("{said}; {same:.4} as drawn (heading {}°)", system.heading))
}

/// How much of the ink of both agrees.
fn agreement(a: &Definition, b: &Definition) -> f64 {
    match (inputs::clean(a, 512), inputs::clean(b, 512)) {
        (Ok(a), Ok(b)) => a.agreement(&b),
        _ => 0.0,
    }
}

/// Seconds of this thread on the processor, or else of the clock.
fn now() -> f64 {
    use std::sync::OnceLock;
    static BEGIN: OnceLock<Instant> = OnceLock::new();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|told| told.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| BEGIN.get_or_init(Instant::now).elapsed().as_secs_f64(), |told| told / 1e9)
}
