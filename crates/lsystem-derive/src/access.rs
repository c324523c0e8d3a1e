//! Random access into a generation that may be too long to store.
//!
//! The counts of each letter's derivation show which letter contains a given position. A search therefore goes down
//! from the axiom, one generation at a time, however long the string is.

use crate::counts::Depths;
use crate::{Key, LetterId, Rule, Rules, Template};
use core::ops::Range;
use lsystem_base::{MAX_ITERATIONS, Meter};
use lsystem_syntax::Code;

/// Generation `n` of a system in which each letter always has the same successor, read without expanding the string.
/// Modules may have parameters, even random ones, but the letters of a successor must not depend on parameters.
#[derive(Clone, Debug)]
pub struct Word<'a> {
    rules: &'a Rules,
    seed: u32,
    n: u32,
    /// Numbers of symbols derived; `u128::MAX` means that many or more.
    symbols: Depths,
    /// Numbers of segments drawn; `u128::MAX` means that many or more.
    segments: Depths,
}

/// The most units of work for the counts, about ten milliseconds.
const MAX: u64 = 1 << 20;

/// A symbol's ancestor in one generation: its place and the production that made it.
#[derive(Clone, Debug, PartialEq)]
pub struct Ancestor {
    /// The generation, 0 for the axiom.
    pub generation: u32,
    /// The symbol.
    pub symbol: char,
    /// The symbol's arguments.
    pub arguments: Vec<f64>,
    /// The symbol's position in the string of that generation, 0-based.
    pub index: u128,
    /// The production that made the symbol, as an index into
    /// [`Grammar::productions`](lsystem_syntax::Grammar::productions). `None` for a symbol of the axiom, and for a
    /// symbol that stayed because no production rewrites it.
    pub production: Option<usize>,
    /// The symbol's place in that production's successor or in the axiom, 0-based; 0 for a symbol that stayed.
    pub position: usize,
}

/// The part of a generation that derives from one symbol of an earlier generation. Positions and segments are 0-based
/// and saturating.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DerivedPart {
    /// The positions of the derived symbols.
    pub symbols: Range<u128>,
    /// The segments that these symbols draw, in drawing order.
    pub segments: Range<u128>,
}

/// A module on the path from the axiom.
#[derive(Clone, Debug)]
struct PathModule {
    symbol: LetterId,
    arguments: Vec<f64>,
    /// The random key; unused if no argument is random.
    key: Key,
}

/// The modules of the axiom or of a successor, made on demand: most modules of a long word are skipped.
struct ModuleReader<'a> {
    rules: &'a Rules,
    seed: u32,
    letters: &'a [LetterId],
    /// The compiled arguments of the modules that follow.
    codes: &'a [Code],
    /// The predecessor; `None` for the axiom.
    parent: Option<PathModule>,
    /// The derivation step that makes these modules, 0 for the axiom.
    step: u32,
    /// The number of modules returned or skipped.
    passed: usize,
}

impl<'a> ModuleReader<'a> {
    /// The letter of the next module.
    fn symbol(&self) -> Option<LetterId> {
        self.letters.get(self.passed).copied()
    }

    /// Skips the next module. Returns its compiled arguments.
    fn skip_module(&mut self) -> &'a [Code] {
        let arity = self.symbol().map_or(0, |letter| self.rules.arity(letter));
        let (own, rest) = self.codes.split_at(arity.min(self.codes.len()));
        self.codes = rest;
        self.passed += 1;
        own
    }
}

impl Iterator for ModuleReader<'_> {
    type Item = PathModule;

    fn next(&mut self) -> Option<PathModule> {
        let symbol = self.symbol()?;
        let (place, step, seed) = (self.passed as u64, self.step, self.seed);
        let key = self.parent.as_ref().map_or_else(|| Key::root(place), |parent| parent.key.child(step, place));
        let maker = self.parent.as_ref().map_or(key, |parent| parent.key);
        let random = |place| maker.number(seed, step, place);
        let codes = self.skip_module();
        let slots = self.parent.as_ref().map_or(&[][..], |parent| &parent.arguments);
        Some(PathModule { symbol, arguments: codes.iter().map(|code| code.value(slots, &random)).collect(), key })
    }
}

impl<'a> Word<'a> {
    /// Generation `n`, and the units of work spent. `drawn` is the number of segments that each letter draws. The word
    /// is
    /// `None` in these cases:
    /// - `drawn` is unknown.
    /// - Chance, conditions or neighbours decide the successor of a symbol. [`History`](crate::History) reads such
    ///   systems.
    /// - Branches are cut.
    /// - `n` is above [`MAX_ITERATIONS`].
    /// - The counts would take more than 16 MiB or 2^20 units of work.
    #[must_use]
    pub fn new(rules: &'a Rules, seed: u32, n: u32, drawn: Option<&[u64]>) -> (Option<Self>, u64) {
        let mut meter = Meter::new(MAX);
        (Self::within(rules, seed, n, drawn, &mut meter), meter.spent())
    }

    fn within(rules: &'a Rules, seed: u32, n: u32, drawn: Option<&[u64]>, meter: &mut Meter) -> Option<Self> {
        if n > MAX_ITERATIONS || rules.is_cutting() || !rules.is_deterministic() {
            return None;
        }
        let drawn = drawn?;
        let symbols = Depths::new(rules, n, |_| 1, meter)?;
        let segments = Depths::new(rules, n, |letter| drawn[usize::from(letter)], meter)?;
        Some(Self { rules, seed, n, symbols, segments })
    }

    /// The number of symbols that a letter derives in `depth` steps, saturating. `depth` is at most `n`.
    #[must_use]
    pub fn derived(&self, letter: LetterId, depth: u32) -> u128 {
        self.symbols.get(depth as usize, letter)
    }

    /// The number of symbols. `u128::MAX` means that many or more; further symbols cannot be reached.
    #[must_use]
    pub fn symbols(&self) -> u128 {
        self.symbols.sum(self.n as usize, &self.rules.axiom.letters)
    }

    /// The number of segments drawn; `u128::MAX` means that many or more.
    #[must_use]
    pub fn segments(&self) -> u128 {
        self.segments.sum(self.n as usize, &self.rules.axiom.letters)
    }

    /// The text of at most `length` symbols from position `start` (0-based) on, fewer at the end. Arguments stand in
    /// parentheses.
    #[must_use]
    pub fn slice(&self, start: u128, length: usize) -> String {
        let mut text = String::new();
        let plain = self.rules.is_plain();
        self.modules(start, length, &mut |symbol, arguments| {
            if plain { text.push(symbol) } else { lsystem_syntax::print_module(symbol, arguments, &mut text) }
        });
        text
    }

    /// Calls `visit` for at most `length` modules from position `start` (0-based) on, fewer at the end.
    pub fn modules(&self, start: u128, length: usize, visit: &mut dyn FnMut(char, &[f64])) {
        let mut left = length;
        // The words to be read with the steps that remain, innermost last.
        let mut open = vec![(self.axiom(), self.n)];
        let mut skip = start;
        while left > 0 {
            let Some((modules, depth)) = open.last_mut() else { break };
            let depth = *depth;
            let Some(symbol) = modules.symbol() else {
                open.pop();
                continue;
            };
            let count = self.symbols.get(depth as usize, symbol);
            if skip >= count {
                skip -= count;
                modules.skip_module();
                continue;
            }
            let Some(module) = modules.next() else { break };
            match self.successor(symbol, depth) {
                Some(word) => open.push((self.children(module, word, self.n - depth + 1), depth - 1)),
                None => {
                    visit(self.letter(symbol), &module.arguments);
                    left -= 1;
                }
            }
        }
    }

    /// The ancestors of the symbol at `index`, from the axiom on, one for each generation; empty if there is no such
    /// symbol.
    #[must_use]
    pub fn ancestry(&self, index: u128) -> Vec<Ancestor> {
        self.descend(index, &self.symbols)
    }

    /// The position of the symbol that draws the segment at `segment` (0-based, in drawing order).
    #[must_use]
    pub fn symbol_of_segment(&self, segment: u128) -> Option<u128> {
        Some(self.descend(segment, &self.segments).last()?.index)
    }

    /// The number of segments that the symbols before position `index` draw.
    #[must_use]
    pub fn segments_before(&self, index: u128) -> u128 {
        let mut segments = 0_u128;
        let (mut word, mut depth, mut skip) = (self.rules.axiom.letters.as_slice(), self.n as usize, index);
        loop {
            let inside = word.iter().find(|&&s| {
                let count = self.symbols.get(depth, s);
                if skip >= count {
                    skip -= count;
                    segments = segments.saturating_add(self.segments.get(depth, s));
                    return false;
                }
                true
            });
            match inside.and_then(|&symbol| self.successor(symbol, depth as u32)) {
                Some(successor) => (word, depth) = (successor, depth - 1),
                None => return segments,
            }
        }
    }

    /// The part of this generation that derives from the symbol at `index` of `generation`, at most `n`; `None` if
    /// there is no such symbol.
    #[must_use]
    pub fn part(&self, generation: u32, index: u128) -> Option<DerivedPart> {
        let mut word = self.rules.axiom.letters.as_slice();
        let mut skip = index;
        let (mut symbols, mut segments) = (0_u128, 0_u128);
        for steps in (0..=generation).rev() {
            let depth = (self.n.checked_sub(generation)? + steps) as usize;
            let held = word.iter().find(|&&s| {
                let count = self.symbols.get(steps as usize, s);
                if skip < count {
                    return true;
                }
                skip -= count;
                symbols = symbols.saturating_add(self.symbols.get(depth, s));
                segments = segments.saturating_add(self.segments.get(depth, s));
                false
            })?;
            if steps == 0 {
                let letter = *held;
                return Some(DerivedPart {
                    symbols: symbols..symbols.saturating_add(self.symbols.get(depth, letter)),
                    segments: segments..segments.saturating_add(self.segments.get(depth, letter)),
                });
            }
            word = self.successor(*held, depth as u32).unwrap_or(core::slice::from_ref(held));
        }
        None
    }

    /// The ancestors of the letter that contains `place`, where `counts` are the sizes of letters.
    fn descend(&self, place: u128, counts: &Depths) -> Vec<Ancestor> {
        let mut chain: Vec<Ancestor> = Vec::new();
        // By generation: the number of symbols before the current letter.
        let mut before = vec![0_u128; self.n as usize + 1];
        // By letter: the number of times it was skipped in the current word.
        let mut passed = vec![0_u32; self.rules.letters.len()];
        let (mut modules, mut made_by) = (self.axiom(), None);
        let mut skip = place;
        for generation in 0..=self.n {
            let depth = self.n - generation;
            loop {
                let Some(symbol) = modules.symbol() else { return Vec::new() };
                let count = counts.get(depth as usize, symbol);
                if skip < count {
                    break;
                }
                skip -= count;
                passed[usize::from(symbol)] += 1;
                modules.skip_module();
            }
            let position = modules.passed;
            for &symbol in &modules.letters[..position] {
                let times = core::mem::take(&mut passed[usize::from(symbol)]);
                for later in (generation..=self.n).filter(|_| times > 0) {
                    let derived = self.symbols.get((later - generation) as usize, symbol);
                    let slot = &mut before[later as usize];
                    *slot = slot.saturating_add(derived.saturating_mul(times.into()));
                }
            }
            let Some(module) = modules.next() else { return Vec::new() };
            let successor = self.successor(module.symbol, depth);
            // A letter without a successor stays to the end.
            let last = if successor.is_some() { generation } else { self.n };
            for at in generation..=last {
                chain.push(Ancestor {
                    generation: at,
                    symbol: self.letter(module.symbol),
                    arguments: module.arguments.clone(),
                    index: before[at as usize],
                    production: made_by.filter(|_| at == generation),
                    position: if at == generation { position } else { 0 },
                });
            }
            let Some(successor) = successor else { break };
            made_by = self.production(module.symbol);
            modules = self.children(module, successor, generation + 1);
        }
        chain
    }

    fn letter(&self, symbol: LetterId) -> char {
        self.rules.symbol(symbol)
    }

    /// The production that rewrites a letter.
    fn production(&self, symbol: LetterId) -> Option<usize> {
        self.rule(symbol).map(|rule| rule.production)
    }

    fn rule(&self, symbol: LetterId) -> Option<&'a Rule> {
        self.rules.by_letter[usize::from(symbol)].first()
    }

    fn axiom(&self) -> ModuleReader<'a> {
        let Template { letters, arguments } = &self.rules.axiom;
        ModuleReader { rules: self.rules, seed: self.seed, letters, codes: arguments, parent: None, step: 0, passed: 0 }
    }

    /// The modules that derivation step `step` makes of `parent`, whose letters are `letters`.
    fn children(&self, parent: PathModule, letters: &'a [LetterId], step: u32) -> ModuleReader<'a> {
        let codes = self.rule(parent.symbol).map_or(&[][..], |rule| &rule.successor.arguments);
        ModuleReader { rules: self.rules, seed: self.seed, letters, codes, parent: Some(parent), step, passed: 0 }
    }

    /// The successor of a letter with `depth` steps remaining; `None` if the letter stays to the end.
    #[must_use]
    pub fn successor(&self, symbol: LetterId, depth: u32) -> Option<&'a [LetterId]> {
        self.rules.rewrites[usize::from(symbol)].always().filter(|_| depth > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{TestSystem, expand, system};
    use lsystem_base::Limits;
    use proptest::prelude::*;

    /// A word whose letters draw nothing.
    fn word(system: &TestSystem, n: u32) -> Word<'_> {
        Word::new(&system.rules, 0, n, Some(&vec![0; system.rules.letters.len()])).0.unwrap()
    }

    #[test]
    fn a_page_of_an_endless_string() {
        let system = system("X", &[('X', "F[+X]F[-X]+X", None), ('F', "FF", None)], 0);
        let word = word(&system, 60);
        assert_eq!(word.slice(0, 8), "FFFFFFFF");
        assert!(word.symbols() > 1 << 90);
        assert_eq!(word.slice(word.symbols() - 12, 99), "F[+X]F[-X]+X");
        let chain = word.ancestry(word.symbols() - 1);
        assert_eq!(chain.len(), 61);
        let last = chain.last().unwrap();
        assert_eq!((last.symbol, last.production, last.position), ('X', Some(0), 11));
        assert_eq!(word.ancestry(word.symbols()), []);
    }

    #[test]
    fn long_productions_are_read_in_place() {
        // Keeping all modules on the path took gigabytes here.
        let long = system("F", &[('F', &"F+".repeat(100_000), None)], 0);
        let word = word(&long, 1000);
        assert_eq!(word.slice(1, 4), "+F+F");
        assert_eq!(word.ancestry(200_000).last().unwrap().index, 200_000);
        assert_eq!(word.ancestry(200_000)[999].position, 1);
    }

    #[test]
    fn what_was_made_one_by_one_is_found() {
        let slow = system("A", &[('A', &("F".repeat(2000) + "A"), None)], 0);
        let word = word(&slow, 1000);
        assert_eq!(word.symbols(), 2_000_001);
        let chain = word.ancestry(2_000_000);
        assert!(chain.iter().all(|link| (link.symbol, link.index) == ('A', 2000 * u128::from(link.generation))));
        let kept = word.ancestry(1_234_567);
        assert_eq!((kept[1000].symbol, kept[1000].index, kept[1000].production), ('F', 1_234_567, None));
        assert_eq!(kept[618], Ancestor { position: 567, index: 1_234_567, ..kept[618].clone() });
        assert_eq!((kept[618].production, kept[617].symbol), (Some(0), 'A'));
    }

    proptest! {
        #![proptest_config(test_effort::config())]
        #[test]
        fn places_equal_those_of_the_string(
            axiom in "[ABF+]{1,5}",
            a in "[ABF+]{0,4}",
            b in "[ABF+]{0,4}",
            n in 0_u32..6,
            start in 0_usize..2000,
            length in 0_usize..300,
        ) {
            let system = system(&axiom, &[('A', &a, None), ('B', &b, None)], 0);
            let drawn: Vec<u64> = (system.rules.letters.iter())
                .map(|letter| match letter.symbol { 'F' => 1, 'B' => 2, _ => 0 })
                .collect();
            let strings: Vec<Vec<char>> =
                (0..=n).map(|n| expand(&system, n, &Limits::default()).unwrap().chars().collect()).collect();
            let string = strings.last().unwrap();
            let word = Word::new(&system.rules, 0, n, Some(&drawn)).0.unwrap();
            prop_assert_eq!(word.symbols(), string.len() as u128);
            let expected: String = string.iter().skip(start).take(length).collect();
            prop_assert_eq!(word.slice(start as u128, length), expected);

            let draws = |c: &char| match c { 'F' => 1, 'B' => 2, _ => 0 };
            if let Some(&symbol) = string.get(start) {
                let chain = word.ancestry(start as u128);
                prop_assert_eq!(chain.len(), n as usize + 1);
                prop_assert_eq!(chain.last().unwrap().symbol, symbol);
                prop_assert_eq!(chain.last().unwrap().index, start as u128);
                for link in &chain {
                    prop_assert_eq!(strings[link.generation as usize][link.index as usize], link.symbol);
                    let part = word.part(link.generation, link.index).unwrap();
                    prop_assert!(part.symbols.contains(&(start as u128)));
                    prop_assert_eq!(part.segments.start, word.segments_before(part.symbols.start));
                    prop_assert_eq!(part.segments.end, word.segments_before(part.symbols.end));
                    prop_assert_eq!(word.part(link.generation, strings[link.generation as usize].len() as u128), None);
                }
                let before: usize = string[..start].iter().map(draws).sum();
                prop_assert_eq!(word.segments_before(start as u128), before as u128);
            }
            let drawing: Vec<usize> =
                string.iter().enumerate().flat_map(|(i, c)| vec![i; draws(c)]).collect();
            prop_assert_eq!(word.segments(), drawing.len() as u128);
            let found = word.symbol_of_segment(start as u128);
            prop_assert_eq!(found, drawing.get(start).map(|&i| i as u128));
        }
    }
}
