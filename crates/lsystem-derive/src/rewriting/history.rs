//! The history of a derivation: any module of any generation, with its ancestors.
//!
//! The history records the production that replaced each module, in one byte except for the largest grammars. The
//! modules of a page are computed from these records, from the axiom on. Systems with both contexts and parameters keep
//! whole generations instead, because arguments may come from contexts, and so do systems with queries.

mod making;

use super::choices::{Choice, Choices};
use super::modules::{Chance, Modules, NotFinite};
use super::step::Rewriter;
use crate::access::{Ancestor, DerivedPart};
use crate::rules::{Letter, Rule, Rules};
use core::ops::Range;
use lsystem_base::{Limits, MAX_ITERATIONS, Meter, Progress};
use std::sync::Arc;

/// Modules in a block. Sums are stored for each block, so that a search looks at fewer modules than this.
const BLOCK: usize = 256;

/// Modules of a page that are computed together.
const PAGE: usize = 4096;

/// Modules handled between two checks of the caller's budget.
const PIECE: usize = 1 << 12;

/// Bytes reserved beside the records, for a step that is being counted.
const SPARE: u64 = 1 << 16;

/// The generations of a system that [`Word`](crate::Word) cannot read: chance, conditions or neighbours decide
/// successors, or branches are cut. A history is made in resumable steps. Generations derived so far can be read
/// meanwhile.
#[derive(Clone, Debug)]
pub struct History {
    rules: Arc<Rules>,
    seed: u32,
    n: u32,
    /// By letter: the number of segments it draws.
    drawn: Vec<u64>,
    /// By production: its place in the rules, and the number of segments its successor draws.
    productions: Vec<Option<SourceProduction>>,
    axiom: Modules,
    /// By generation except the last: the records of the step after it.
    steps: Vec<StepRecord>,
    /// By generation: the number of modules.
    lengths: Vec<usize>,
    /// By generation: its modules; `None` if generations are not kept.
    words: Option<Vec<Kept>>,
    /// The images of the modules of generation `n`, once counted.
    images: Option<StepRecord>,
    /// The bytes of the records.
    bytes: u64,
    /// The most bytes of the records and the generations under construction together.
    memory: u64,
    stage: Stage,
    /// The units of work of all steps.
    spent: u64,
}

#[derive(Clone, Debug)]
enum Stage {
    Derive(Box<Rewriter>),
    /// Counting the modules that a step made.
    Sum(Box<Rewriter>, StepRecord),
    /// Copying a generation. The number is the index of the next module's first argument.
    Keep(Box<Rewriter>, Kept, usize),
    /// Counting the segments of the last generation.
    Count {
        rewriter: Box<Rewriter>,
        sums: PrefixSums,
        choices: Choices,
        /// The index of the next module's first argument.
        argument: usize,
    },
    Done,
}

#[derive(Clone, Copy, Debug)]
struct SourceProduction {
    letter: u16,
    index: usize,
    /// Whether the production stands below `draw:`.
    image: bool,
    modules: u32,
    segments: u64,
}

/// The records of one derivation step.
#[derive(Clone, Debug, Default)]
struct StepRecord {
    choices: Choices,
    /// The number of modules that the modules before each block made.
    sums: PrefixSums,
}

/// A whole generation.
#[derive(Clone, Debug)]
struct Kept {
    word: Modules,
    /// The number of arguments before each block.
    arguments: PrefixSums,
}

/// Sums over the modules before each block.
#[derive(Clone, Debug, Default)]
struct PrefixSums {
    before: Vec<u64>,
    total: u64,
    count: usize,
}

impl PrefixSums {
    /// Sums of `count` modules, without memory yet.
    fn of(count: usize) -> Self {
        Self { count, ..Self::default() }
    }

    /// The bytes that the sums will take.
    fn bytes(&self) -> u64 {
        8 * self.count.div_ceil(BLOCK) as u64
    }

    /// Empty sums with the memory reserved.
    fn ready(self) -> Self {
        Self { before: Vec::with_capacity(self.count.div_ceil(BLOCK)), ..Self::default() }
    }

    fn add(&mut self, amount: u64) {
        if self.count.is_multiple_of(BLOCK) {
            self.before.push(self.total);
        }
        self.count += 1;
        self.total += amount;
    }

    /// The sum before the block of `place`, and the block's start.
    fn block(&self, place: usize) -> (u64, usize) {
        let block = place / BLOCK;
        (self.before.get(block).copied().unwrap_or(self.total), block * BLOCK)
    }

    /// The sum before the block that contains `amount`, and the block's start.
    fn holding(&self, amount: u64) -> (u64, usize) {
        let block = self.before.partition_point(|&before| before <= amount).saturating_sub(1);
        (self.before.get(block).copied().unwrap_or(0), block * BLOCK)
    }
}

impl History {
    /// A history up to generation `n`, with only the axiom so far. `drawn` is the number of segments that each letter
    /// draws.
    /// `None` if `n` is above [`MAX_ITERATIONS`], a number in the axiom is not finite, or the axiom exceeds the memory.
    #[must_use]
    pub fn new(rules: &Arc<Rules>, seed: u32, n: u32, drawn: Vec<u64>, limits: &Limits) -> Option<Self> {
        if n > MAX_ITERATIONS {
            return None;
        }
        let all = || rules.by_letter.iter().chain(&rules.images).flatten();
        let count = all().map(|rule| rule.production + 1).max().unwrap_or(0);
        let mut productions = vec![None; count];
        for (image, lists) in [(false, &rules.by_letter), (true, &rules.images)] {
            for (letter, list) in lists.iter().enumerate() {
                for (index, rule) in list.iter().enumerate() {
                    let segments = rule.successor.letters.iter().map(|&letter| drawn[usize::from(letter)]).sum();
                    let modules = rule.successor.letters.len() as u32;
                    productions[rule.production] =
                        Some(SourceProduction { letter: letter as u16, index, image, modules, segments });
                }
            }
        }
        // The drawing was made within the limit of work, but here contexts are matched once more.
        let limits = Limits { work: limits.work.saturating_mul(8), ..*limits };
        let mut rewriter = Rewriter::new(rules.clone(), seed, limits).ok()?;
        rewriter.record_steps(count);
        let surrounded = rules.by_letter.iter().flatten().any(Rule::is_context_sensitive);
        let axiom = rewriter.word().clone();
        let mut history = Self {
            words: ((surrounded || rules.interpreter.is_some()) && rules.is_parametric()).then(Vec::new),
            rules: rules.clone(),
            seed,
            n,
            drawn,
            productions,
            steps: vec![],
            lengths: vec![axiom.letters.len()],
            images: None,
            bytes: axiom.bytes(),
            memory: limits.memory,
            stage: Stage::Done,
            axiom,
            spent: 0,
        };
        history.begin_keep(Box::new(rewriter))?;
        Some(history)
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Derives for about `budget` units of work. The history ends early at a limit or at a number that is not finite.
    /// The limits are [`Limits::memory`] for the records and the generations under construction, [`Limits::modules`],
    /// and eight times [`Limits::work`].
    pub fn step(&mut self, budget: usize) -> Progress {
        let mut meter = Meter::new(budget as u64);
        let mut progress = Progress::More;
        while progress == Progress::More && !meter.is_spent() {
            progress = self.piece(&mut meter);
        }
        self.spent += meter.spent();
        progress
    }

    /// The number of modules of generation `generation`; `None` if it is not derived.
    #[must_use]
    pub fn symbols(&self, generation: u32) -> Option<u128> {
        self.lengths.get(generation as usize).map(|&length| length as u128)
    }

    /// Whether generation `n` is derived and its segments are counted.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.images.is_some()
    }

    /// Calls `visit` for at most `length` modules of a generation from position `start` (0-based) on, fewer at the end.
    /// A generation that is not derived has no modules.
    pub fn modules(&self, generation: u32, start: u128, length: usize, visit: &mut dyn FnMut(char, &[f64])) {
        let end = self.lengths.get(generation as usize).copied().unwrap_or(0);
        let mut at = usize::try_from(start).unwrap_or(usize::MAX).min(end);
        let end = at.saturating_add(length).min(end);
        while at < end {
            let page = at..(at + PAGE).min(end);
            at = page.end;
            let word = self.word(generation, page);
            let mut arguments = word.arguments.as_slice();
            for &letter in &word.letters {
                let Letter { symbol, arity } = self.rules.letters[usize::from(letter)];
                let (own, rest) = arguments.split_at(usize::from(arity));
                arguments = rest;
                visit(symbol, own);
            }
        }
    }

    /// As [`History::modules`], but as text with arguments in parentheses.
    #[must_use]
    pub fn slice(&self, generation: u32, start: u128, length: usize) -> String {
        let mut text = String::new();
        let mut visit = |symbol, arguments: &[f64]| lsystem_syntax::print_module(symbol, arguments, &mut text);
        self.modules(generation, start, length, &mut visit);
        text
    }

    /// The ancestors of the module at `index` of a generation, from the axiom on, one for each generation; empty if
    /// there is no such module.
    #[must_use]
    pub fn ancestry(&self, generation: u32, index: u128) -> Vec<Ancestor> {
        let Some(mut place) = self.place(generation, index) else { return vec![] };
        // The ancestors' places, from the last generation back.
        let mut places = vec![place];
        for step in self.steps[..generation as usize].iter().rev() {
            place = self.parent(step, place);
            places.push(place);
        }
        places.reverse();
        let mut chain = Vec::with_capacity(places.len());
        let mut word = self.axiom_from(places[0]..places[0] + 1);
        let (mut production, mut position) = (None, places[0]);
        for (at, &place) in places.iter().enumerate() {
            if self.words.is_some() {
                word = self.word(at as u32, place..place + 1);
            }
            let symbol = self.rules.letters[usize::from(word.letters[0])].symbol;
            let arguments = word.arguments.clone();
            let index = place as u128;
            chain.push(Ancestor { generation: at as u32, symbol, arguments, index, production, position });
            let Some(&next) = places.get(at + 1) else { break };
            let step = &self.steps[at];
            let first = self.first(step, place);
            (production, position) = match step.choices.get(place) {
                Choice::Made(production) => (Some(production), next - first),
                Choice::Stayed | Choice::Cut => (None, 0),
            };
            if self.words.is_none() {
                word = self.derived(&word, step, place..place + 1, at as u32 + 1, next - first..next - first + 1);
            }
        }
        chain
    }

    /// The part of generation `later` that derives from the module at `index` of `generation`. Segments are known only
    /// in generation `n`, and are `0..0` otherwise. `None` if there is no such module, or a generation is not derived.
    #[must_use]
    pub fn part(&self, generation: u32, index: u128, later: u32) -> Option<DerivedPart> {
        let place = self.place(generation, index)?;
        let steps = self.steps.get(generation as usize..later as usize)?;
        let mut range = place..place + 1;
        for step in steps {
            range = self.first(step, range.start)..self.first(step, range.end);
        }
        let segments = |place: usize| self.segments_before(place as u128);
        let segments = if later == self.n { segments(range.start).zip(segments(range.end)) } else { None };
        let (from, to) = segments.unwrap_or((0, 0));
        Some(DerivedPart { symbols: range.start as u128..range.end as u128, segments: from..to })
    }

    /// The number of segments that the modules before position `index` of generation `n` draw; `None` if not counted
    /// yet.
    #[must_use]
    pub fn segments_before(&self, index: u128) -> Option<u128> {
        let images = self.images.as_ref()?;
        let place = usize::try_from(index).unwrap_or(usize::MAX).min(images.sums.count);
        let (mut before, block) = images.sums.block(place);
        let word = self.word(self.n, block..place);
        for (place, &letter) in (block..).zip(&word.letters) {
            before += self.segments(images, place, letter);
        }
        Some(u128::from(before))
    }

    /// The position of the module of generation `n` that draws the segment at `segment` (0-based, in drawing order).
    #[must_use]
    pub fn symbol_of_segment(&self, segment: u128) -> Option<u128> {
        let images = self.images.as_ref()?;
        let segment = u64::try_from(segment).ok().filter(|&segment| segment < images.sums.total)?;
        let (mut before, block) = images.sums.holding(segment);
        let word = self.word(self.n, block..(block + BLOCK).min(images.sums.count));
        let place = (block..).zip(&word.letters).find(|&(place, &letter)| {
            before += self.segments(images, place, letter);
            segment < before
        });
        place.map(|(place, _)| place as u128)
    }

    fn place(&self, generation: u32, index: u128) -> Option<usize> {
        let length = *self.lengths.get(generation as usize)?;
        usize::try_from(index).ok().filter(|&place| place < length)
    }

    fn rule(&self, source: SourceProduction) -> &Rule {
        let lists = if source.image { &self.rules.images } else { &self.rules.by_letter };
        &lists[usize::from(source.letter)][source.index]
    }

    fn made(&self, production: usize) -> Option<&Rule> {
        self.productions.get(production).copied().flatten().map(|source| self.rule(source))
    }

    fn segments(&self, images: &StepRecord, place: usize, letter: u16) -> u64 {
        match images.choices.get(place) {
            Choice::Made(production) => self.productions[production].map_or(0, |source| source.segments),
            Choice::Stayed | Choice::Cut => self.drawn[usize::from(letter)],
        }
    }

    /// The place of the first module in the next generation that the module at `place` makes.
    fn first(&self, step: &StepRecord, place: usize) -> usize {
        let (before, block) = step.sums.block(place);
        (block..place).fold(before, |sum, place| sum + made_of(&self.productions, step.choices.get(place))) as usize
    }

    /// The place of the module that made the module at `place` of the next generation.
    fn parent(&self, step: &StepRecord, place: usize) -> usize {
        let (mut before, mut at) = step.sums.holding(place as u64);
        loop {
            before += made_of(&self.productions, step.choices.get(at));
            if before > place as u64 || at + 1 >= step.sums.count {
                return at;
            }
            at += 1;
        }
    }

    /// The modules of a derived generation in a range within it.
    fn word(&self, generation: u32, range: Range<usize>) -> Modules {
        if range.is_empty() {
            return Modules::default();
        }
        if let Some(kept) = self.words.as_ref().and_then(|words| words.get(generation as usize)) {
            let (before, block) = kept.arguments.block(range.start);
            let arity = |range: Range<usize>| {
                let letters = &kept.word.letters[range];
                letters.iter().map(|&letter| usize::from(self.rules.letters[usize::from(letter)].arity)).sum::<usize>()
            };
            let from = before as usize + arity(block..range.start);
            let mut word = Modules::default();
            word.keep(&kept.word, range.clone(), from..from + arity(range));
            return word;
        }
        // The ancestors' ranges, from the last generation back.
        let steps = &self.steps[..generation as usize];
        let mut ranges = vec![range];
        for step in steps.iter().rev() {
            let of = &ranges[ranges.len() - 1];
            ranges.push(self.parent(step, of.start)..self.parent(step, of.end - 1) + 1);
        }
        ranges.reverse();
        let mut word = self.axiom_from(ranges[0].clone());
        for (at, step) in steps.iter().enumerate() {
            let [of, wanted] = [&ranges[at], &ranges[at + 1]];
            let first = self.first(step, of.start);
            word = self.derived(&word, step, of.clone(), at as u32 + 1, wanted.start - first..wanted.end - first);
        }
        word
    }

    /// The modules of the axiom in a range.
    fn axiom_from(&self, range: Range<usize>) -> Modules {
        let mut word = Modules::default();
        let arguments = 0..self.axiom.arguments.len();
        word.keep(&self.axiom, 0..self.axiom.letters.len(), arguments);
        self.trim(&mut word, range);
        word
    }

    /// The modules that derivation step `number` makes of `word`, limited to those in `range`. `word` are the modules
    /// at
    /// `places` of their generation; `range` counts from the first module made.
    fn derived(
        &self,
        word: &Modules,
        step: &StepRecord,
        places: Range<usize>,
        number: u32,
        range: Range<usize>,
    ) -> Modules {
        let mut next = Modules::default();
        let mut argument = 0;
        for (at, place) in places.enumerate() {
            let arity = usize::from(self.rules.letters[usize::from(word.letters[at])].arity);
            let own = argument..argument + arity;
            argument = own.end;
            match step.choices.get(place) {
                Choice::Stayed => next.keep(word, at..at + 1, own),
                Choice::Cut => {}
                Choice::Made(production) => {
                    let Some(rule) = self.made(production) else { continue };
                    let chance = Chance { key: word.key_of(at), seed: self.seed, step: number };
                    let random = word.has_keys();
                    // No error: all numbers were finite when the step was derived.
                    let (Ok(()) | Err(NotFinite)) = next.make(&rule.successor, &word.arguments[own], &chance, random);
                }
            }
        }
        self.trim(&mut next, range);
        next
    }

    /// Removes all modules outside `range`.
    fn trim(&self, word: &mut Modules, range: Range<usize>) {
        let arity = |&letter: &u16| usize::from(self.rules.letters[usize::from(letter)].arity);
        let before: usize = word.letters[..range.start].iter().map(arity).sum();
        let own: usize = word.letters[range.clone()].iter().map(arity).sum();
        word.move_down(range.clone(), 0, before..before + own, 0);
        word.truncate(range.len(), own);
    }
}

/// The number of modules that one module makes.
fn made_of(productions: &[Option<SourceProduction>], choice: Choice) -> u64 {
    match choice {
        Choice::Stayed => 1,
        Choice::Cut => 0,
        Choice::Made(production) => productions[production].map_or(0, |source| u64::from(source.modules)),
    }
}

#[cfg(test)]
mod tests {
    use super::{BLOCK, PrefixSums};

    #[test]
    fn a_sum_at_the_end_of_a_block_is_held_by_the_next() {
        let mut sums = PrefixSums::default();
        // Blocks 1 and 2 add nothing, so a search skips them.
        (0..BLOCK).for_each(|_| sums.add(3));
        (BLOCK..3 * BLOCK).for_each(|_| sums.add(0));
        (3 * BLOCK..4 * BLOCK).for_each(|_| sums.add(1));
        let first = 3 * BLOCK as u64;
        assert_eq!(sums.holding(0), (0, 0));
        assert_eq!(sums.holding(first - 1), (0, 0));
        assert_eq!(sums.holding(first), (first, 3 * BLOCK));
        assert_eq!(sums.holding(first + 1), (first, 3 * BLOCK));
        assert_eq!(sums.block(3 * BLOCK - 1), (first, 2 * BLOCK));
        assert_eq!(sums.block(3 * BLOCK), (first, 3 * BLOCK));
    }
}
