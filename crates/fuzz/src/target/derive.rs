//! Derivation: strings, counts and pages, compared with the naive reference.

use crate::gauge::WORK;
use crate::make;
use crate::naive::{self, Module};
use crate::{Gauge, Source};
use lsystem::derive::{GenerationReader, History, Tally};
use lsystem::drawing::{expand_once, expand_symbol, kind, legend, why_empty};
use lsystem::syntax::print_module;
use lsystem::{Definition, Dialect, Limits, System, count_segments, count_symbols, expand};

/// Longer words are not compared, because parts of the naive reference take quadratic time.
const FEW: usize = 400;

/// Whether the naive reference supports all of a system. The reference cuts only at `%`, and knows images of plain
/// symbols only in the ABOP dialect without overrides.
pub(super) fn is_supported(definition: &Definition, system: &System) -> bool {
    let Definition { dialect, overrides, .. } = definition;
    let abop = *dialect == Dialect::Abop;
    let images = system.rules.is_plain() && !system.grammar.images.is_empty();
    let others_cut = overrides.contains("cut") || overrides.contains('%') || !abop;
    !(others_cut && (overrides.contains("cut") || system.rules.letters.iter().any(|letter| letter.symbol == '%')))
        && (!images || abop && overrides.is_empty())
        // The reference has no turtle and no shapes.
        && !system.rules.asks()
        && system.grammar.shapes.is_empty()
}

/// The words of the generations up to `n` by the naive reference, until a word is too long or a number is not finite.
pub(super) fn words(system: &System, n: u32) -> Vec<Vec<Module>> {
    let limits = Limits { symbols: 8 * FEW as u64, modules: FEW as u64, ..Limits::default() };
    let short = |n: u32| expand(system, n, &limits).is_ok_and(|text| text.chars().count() < 8 * FEW);
    let word = |n: u32| short(n).then(|| naive::modules(&system.grammar, system.seed, n)).flatten();
    (0..=n.min(12)).map_while(word).take_while(|word| word.len() < FEW).collect()
}

/// Strings and counts.
pub(super) fn derive(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    gauge.reach("system");
    let n = definition.iterations;
    let limits = make::limits(source);
    let text = gauge.call("expand", || expand(&system, n, &limits));
    let symbols = gauge.call("count_symbols", || count_symbols(&system, n));
    let segments = gauge.call("count_segments", || count_segments(&system, n));
    gauge.call("words", || {
        let _ = (legend(&system), kind(&system), why_empty(&system, n));
    });
    if let Ok(text) = &text {
        assert!(text.chars().count() as u64 <= limits.symbols, "longer than the limit");
        gauge.reach("expanded");
    }
    let symbol = source.pick_char("FABX+[é");
    let _ = gauge.call("expand_symbol", || expand_symbol(&system, symbol, 0.5));
    let line = make::random_pieces(source);
    let _ = gauge.call("expand_once", || expand_once(&system, &line, n));
    let words = words(&system, n);
    if !is_supported(&definition, &system) {
        return;
    }
    let Some(word) = words.last().filter(|_| words.len() as u64 == u64::from(n) + 1) else { return };
    gauge.reach("compared");
    if let Ok(text) = text {
        assert_eq!(text, printed(&system, word), "the string of generation {n}");
    }
    if let Some(symbols) = symbols {
        assert_eq!(symbols, Tally::from(word.len() as u64), "the symbols of generation {n}");
    }
    if let Some(segments) = segments {
        let drawn: usize = naive::segments_of_each(&system, word).iter().sum();
        assert_eq!(segments, Tally::from(drawn as u64), "the segments of generation {n}");
    }
}

/// A word as text.
fn printed(system: &System, word: &[Module]) -> String {
    let mut text = String::new();
    for module in word {
        if system.rules.is_plain() {
            text.push(module.symbol);
        } else {
            print_module(module.symbol, &module.arguments, &mut text);
        }
    }
    text
}

/// Pages, ancestors and parts.
pub(super) fn access(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let n = definition.iterations;
    let mut limits = make::limits(source);
    limits.modules = limits.modules.min(200_000);
    let mut history = gauge.call("history", || system.history(n, &limits));
    if let Some(history) = &mut history {
        gauge.steps("history step", WORK, history, History::step, History::spent);
    }
    let history = history.filter(History::is_complete);
    let words = if is_supported(&definition, &system) { words(&system, n) } else { vec![] };
    let is_whole = words.len() as u64 == u64::from(n) + 1;
    let index = [u128::from(source.word() % 500), source.pick(&[0, 1, u128::MAX, 1 << 64, 12_345])];
    for (name, is_counted) in [("counted", true), ("remembered", false)] {
        let reader = |generation| match is_counted {
            true => system.word(generation).map(GenerationReader::Counted),
            false => history.as_ref().map(|history| GenerationReader::Remembered(history, generation)),
        };
        let Some(last) = gauge.call("word", || reader(n)) else { continue };
        gauge.reach(name);
        for (place, index) in index.into_iter().enumerate() {
            let generation = source.below(n as usize + 1) as u32;
            let name = if place == 0 { "near" } else { "far" };
            let mut page = vec![];
            let Some(read) = reader(generation) else { continue };
            let mut visit = |symbol: char, arguments: &[f64]| page.push((symbol, arguments.to_vec()));
            gauge.call("page", || read.modules(index, 17, &mut visit));
            let ancestry = gauge.call("ancestry", || read.ancestry(index));
            let part = gauge.call("part", || last.part(generation, index));
            gauge.call("symbol_of_segment", || last.symbol_of_segment(index));
            gauge.call("segments_before", || last.segments_before(index));
            let Some(word) = words.get(generation as usize) else { continue };
            gauge.reach(name);
            let start = usize::try_from(index).unwrap_or(usize::MAX);
            let expected = word.iter().skip(start).take(17).map(|m| (m.symbol, m.arguments.clone()));
            assert_eq!(page, expected.collect::<Vec<_>>(), "a page of generation {generation} from {index}");
            assert_eq!(ancestry.len(), if start < word.len() { generation as usize + 1 } else { 0 });
            if is_whole && start < word.len() {
                let mut own = vec![start];
                for later in &words[generation as usize + 1..] {
                    let from = later.iter().filter(|module| own.contains(&module.parent));
                    own = from.map(|module| module.index).collect();
                }
                let part = part.expect("the symbol is there");
                assert_eq!(part.symbols.end - part.symbols.start, own.len() as u128, "what became of {index}");
            }
        }
    }
}
