//! Derivation: from the axiom to the string of generation n.
//!
//! A letter without random choices in its derivation always derives the same text. The text is written once and then
//! copied, so that expansion runs near the speed of memory. Random choices are keyed by place (`key.rs`), so that
//! letters are derived depth first, and no intermediate generation is held in memory.

use crate::counts::{Depths, counts_until};
use crate::walk::{DepthFirst, Next};
use crate::{Fault, Key, Letter, LetterId, Rewrite, Rewriter, Rule, Rules};
use lsystem_base::LimitName;
use lsystem_base::{Limits, MAX_ITERATIONS, Meter, say};
use lsystem_syntax::{Diagnostic, Kind};
use lsystem_syntax::{Field, Grammar};
use std::sync::Arc;

/// The longest text that is copied whole, in bytes. Longer texts are composed of such copies, so that the source of a
/// copy stays in the first-level cache.
const COPIED: u128 = 16 << 10;

/// The successor of `symbol` in one derivation step, as text. `roll`, uniform in `0.0..1.0`, selects among stochastic
/// productions. A symbol without a production stays. The symbol has neither neighbours nor parameters, so productions
/// with contexts do not apply; for words of modules there is [`derive_once`].
#[must_use]
pub fn derive_symbol(rules: &Rules, symbol: char, roll: f64) -> String {
    if !rules.is_plain() {
        return alone(rules, symbol, roll);
    }
    let rewrite = rules.letter(symbol, 0).map(|letter| &rules.rewrites[usize::from(letter)]);
    match rewrite.and_then(|rewrite| rewrite.successor(|| roll)) {
        None => symbol.to_string(),
        Some(successor) => successor.iter().map(|&letter| rules.symbol(letter)).collect(),
    }
}

/// The text of `word` after derivation step `step` (1-based). The symbols of `word` have the random keys of an axiom's
/// symbols. If the rules are not [plain](Rules::is_plain), `word` is read in the notation, with arguments in
/// parentheses. The word stays if it is malformed, if a number is not finite, or if the result exceeds
/// [`Limits::default`].
#[must_use]
pub fn derive_once(grammar: &Grammar, rules: &Rules, seed: u32, word: &str, step: u32) -> String {
    if !rules.is_plain() {
        return once(grammar, rules, seed, word, step).unwrap_or_else(|| word.to_owned());
    }
    let mut text = String::new();
    for (index, symbol) in word.chars().enumerate() {
        text += &derive_symbol(rules, symbol, Key::root(index as u64).choice(seed, step));
        if text.len() as u64 > Limits::default().symbols {
            return word.to_owned();
        }
    }
    text
}

/// The successor of a symbol without neighbours and parameters, for rules that are not plain.
fn alone(rules: &Rules, symbol: char, roll: f64) -> String {
    let random = |_| roll;
    let own = rules.letter(symbol, 0).map_or(&[][..], |letter| &rules.by_letter[usize::from(letter)]);
    let holds = |rule: &&Rule| {
        // Contexts never match here. Their parameters, which a condition may name, do not exist.
        !rule.is_context_sensitive()
            && rule.condition.as_ref().is_none_or(|condition| {
                let value = condition.value(&[], &random);
                value != 0.0 && !value.is_nan()
            })
    };
    let applying: Vec<&Rule> = own.iter().filter(holds).collect();
    let weight = |rule: &Rule| {
        let weight = rule.weight.as_ref().map_or(0.0, |weight| weight.value(&[], &random));
        if weight > 0.0 && weight.is_finite() { weight } else { 0.0 }
    };
    let mut left = roll * applying.iter().map(|rule| weight(rule)).sum::<f64>();
    let chosen = match applying.first() {
        Some(first) if first.weight.is_some() => {
            applying.iter().copied().filter(|rule| weight(rule) > 0.0).find(|rule| {
                left -= weight(rule);
                left < 0.0
            })
        }
        first => first.copied(),
    };
    let mut text = String::new();
    match chosen {
        None => lsystem_syntax::print_module(symbol, &[], &mut text),
        Some(Rule { successor, .. }) => {
            let arguments: Vec<f64> = successor.arguments.iter().map(|code| code.value(&[], &random)).collect();
            write_word(rules, &successor.letters, &arguments, u64::MAX, &mut text);
        }
    }
    text
}

/// One derivation step of a word of modules; `None` if the word is malformed, a number is not finite, or a limit is
/// exceeded.
fn once(grammar: &Grammar, rules: &Rules, seed: u32, word: &str, step: u32) -> Option<String> {
    let (read, diagnostics) = lsystem_syntax::parse(word, "");
    if diagnostics.iter().any(Diagnostic::is_error) {
        return None;
    }
    let grammar = Grammar { axiom: read.axiom, ..grammar.clone() };
    let Rules { letters, cuts, .. } = rules;
    let cutting = |symbol: char| letters.iter().zip(cuts).any(|(l, cuts)| l.symbol == symbol && *cuts);
    let rules = Rules::new(&grammar, vec![], cutting, true).ok()?;
    let mut rewriter = Rewriter::new(Arc::new(rules), seed, Limits::default()).ok()?.at(step.saturating_sub(1));
    while !rewriter.step(usize::MAX).ok()? {}
    let (word, mut text) = (rewriter.word(), String::new());
    write_word(rewriter.rules(), &word.letters, &word.arguments, u64::MAX, &mut text);
    Some(text)
}

/// Replaces `text` with the string of generation `n`. Reusing the buffer saves the first access to its memory, which
/// costs more than the derivation. The work is at most about [`Limits::symbols`] plus a few times [`Limits::work`]
/// units.
///
/// # Errors
/// [`Kind::Limit`] if the string has more than [`Limits::symbols`] symbols, if the
/// derivation exceeds another limit, or if `n` is above [`MAX_ITERATIONS`].
/// [`Kind::NotFinite`] if a number is not finite. `text` is then empty.
pub fn derive_string(
    rules: &Arc<Rules>,
    seed: u32,
    n: u32,
    limits: &Limits,
    text: &mut String,
    meter: &mut Meter,
) -> Result<(), Diagnostic> {
    text.clear();
    if n > MAX_ITERATIONS {
        return Err(Diagnostic::limit(LimitName::Iterations, u64::from(MAX_ITERATIONS), Some(MAX_ITERATIONS)));
    }
    if !rules.is_plain() {
        return write_modules(rules, seed, n, limits, text, meter);
    }
    let too_long = |largest| Diagnostic::limit(LimitName::Symbols, limits.symbols, largest);
    let mut own = Meter::new(limits.work);
    let known = counts_until(rules, n, limits.symbols, |_| 1, &mut own);
    meter.charge(own.spent());
    if let Ok(generations) = &known
        && generations.last().is_some_and(|&symbols| symbols > u128::from(limits.symbols))
    {
        return Err(too_long((generations.len() as u32).checked_sub(2)));
    }
    let bytes = |symbol: LetterId| rules.symbol(symbol).len_utf8() as u64;
    let lengths = Depths::new(rules, n, bytes, &mut Meter::new(limits.work));
    let mut writer = TextWriter::new(rules, lengths, text);
    if known.is_ok() && !writer.reserve(n, &rules.axiom.letters) {
        return Err(too_long(None));
    }
    let mut derivation = DepthFirstRun::new(rules, seed);
    let outcome = derivation.run(n, limits, limits.work, |symbol, depth| writer.write(symbol, depth));
    meter.charge(derivation.spent + writer.text.len() as u64 / 64);
    outcome.map_err(|stopped| {
        text.clear();
        let largest = derivation.largest_within(n, limits);
        meter.charge(derivation.spent);
        Diagnostic::limit(stopped, limits.value(stopped), largest)
    })
}

/// Derives whole generations, and writes the last: symbols with their arguments in parentheses.
fn write_modules(
    rules: &Arc<Rules>,
    seed: u32,
    n: u32,
    limits: &Limits,
    text: &mut String,
    meter: &mut Meter,
) -> Result<(), Diagnostic> {
    let started = Rewriter::new(rules.clone(), seed, *limits);
    let mut rewriter = started.map_err(|error| fault(rules, error, 0, limits, None))?;
    while rewriter.generation() < n {
        let reached = rewriter.generation();
        rewriter.advance(meter).map_err(|error| fault(rules, error, reached, limits, Some(reached)))?;
    }
    // Frees memory for the text.
    rewriter.rest();
    let word = rewriter.word();
    let written = write_word(rules, &word.letters, &word.arguments, limits.symbols, text);
    meter.charge(text.len() as u64);
    if written {
        return Ok(());
    }
    drop(rewriter);
    *text = String::new();
    Err(Diagnostic::limit(LimitName::Symbols, limits.symbols, longest_within(rules, seed, n, limits, meter)))
}

/// Appends modules with their arguments in parentheses. Returns false if the text becomes longer than `most` bytes.
fn write_word(rules: &Rules, letters: &[LetterId], arguments: &[f64], most: u64, text: &mut String) -> bool {
    let mut modules = ModuleIter { letters, arguments };
    while let Some((symbol, own)) = modules.next(rules) {
        // Grows by a quarter, because doubling may take too much memory.
        if text.capacity() - text.len() < PRINTED {
            text.reserve_exact((text.len() / 4).max(PRINTED));
        }
        lsystem_syntax::print_module(symbol, own, text);
        if text.len() as u64 > most {
            return false;
        }
    }
    true
}

/// The length of modules as text, in bytes; `None` if more than `most`.
fn written_length(rules: &Rules, letters: &[LetterId], arguments: &[f64], most: u64) -> Option<u64> {
    let (mut modules, mut text, mut length) = (ModuleIter { letters, arguments }, String::new(), 0);
    while let Some((symbol, own)) = modules.next(rules) {
        text.clear();
        lsystem_syntax::print_module(symbol, own, &mut text);
        length += text.len() as u64;
        if length > most {
            return None;
        }
    }
    Some(length)
}

/// The most bytes of a module as text.
const PRINTED: usize = 4_096;

/// An iterator over modules with their arguments.
struct ModuleIter<'a> {
    letters: &'a [LetterId],
    arguments: &'a [f64],
}

impl<'a> ModuleIter<'a> {
    /// The next module's symbol and arguments.
    fn next(&mut self, rules: &Rules) -> Option<(char, &'a [f64])> {
        let (&letter, letters) = self.letters.split_first()?;
        let Letter { symbol, arity } = rules.letters[usize::from(letter)];
        let (own, arguments) = self.arguments.split_at(usize::from(arity));
        (self.letters, self.arguments) = (letters, arguments);
        Some((symbol, own))
    }
}

/// The last generation before `n` up to which all texts are within the limits, or an earlier generation if the search
/// takes too long.
fn longest_within(rules: &Arc<Rules>, seed: u32, n: u32, limits: &Limits, meter: &mut Meter) -> Option<u32> {
    /// The most work of the search, in texts of the greatest length allowed.
    const TEXTS: u64 = 4;
    let mut rewriter = Rewriter::new(rules.clone(), seed, *limits).ok()?;
    let mut left = limits.symbols.saturating_mul(TEXTS);
    loop {
        let (word, generation) = (rewriter.word(), rewriter.generation());
        let length = written_length(rules, &word.letters, &word.arguments, limits.symbols);
        let Some(length) = length.filter(|_| generation < n) else { return generation.checked_sub(1) };
        meter.charge(length);
        left = left.saturating_sub(length);
        while left > 0 && !rewriter.advance(meter).ok()? {}
        if left == 0 {
            return Some(generation);
        }
    }
}

/// The diagnostic for a fault in the derivation step after generation `reached`. `largest` is the largest number of
/// derivation steps within the limit.
pub fn fault(rules: &Rules, fault: Fault, reached: u32, limits: &Limits, largest: Option<u32>) -> Diagnostic {
    match fault {
        Fault::Limit(name) => Diagnostic::limit(name, limits.value(name), largest),
        Fault::NotFinite(production) => {
            let (message, field) = match production {
                None => (say!("An argument of the axiom is not a finite number"), Field::Axiom),
                Some(_) => {
                    let step = reached + 1;
                    (say!("An argument that this rule computes in step {} is not a finite number", step), Field::Rules)
                }
            };
            let span = production.and_then(|at| rules.spans.get(at)).cloned().unwrap_or_default();
            Diagnostic::error(message)
                .hint(say!("Is something divided by zero, or does it grow without end? A condition can stop it."))
                .kind(Kind::NotFinite)
                .at(field, span)
        }
    }
}

/// Derives generations depth first.
struct DepthFirstRun<'a> {
    rules: &'a Rules,
    seed: u32,
    /// By letter: whether its derivation has no random choice.
    fixed: Vec<bool>,
    /// The units of work so far, in all runs.
    spent: u64,
}

impl<'a> DepthFirstRun<'a> {
    fn new(rules: &'a Rules, seed: u32) -> Self {
        Self { rules, seed, fixed: fixed(rules), spent: 0 }
    }

    /// Derives generation `n` and calls `visit` for its letters, with the number of derivation steps that remain.
    /// Letters without random choices are visited as soon as they occur. At most `work` letters of all generations are
    /// visited.
    fn run(
        &mut self,
        n: u32,
        limits: &Limits,
        work: u64,
        mut visit: impl FnMut(LetterId, u32),
    ) -> Result<(), LimitName> {
        let Self { rules, seed, fixed, .. } = self;
        let mut meter = Meter::new(limits.work);
        let symbols = Depths::new(rules, n, |_| 1, &mut meter);
        let mut walk = DepthFirst::new(n, *seed);
        let mut left = limits.symbols;
        let outcome = loop {
            // Without the sums, every letter of generation `n` is visited.
            match walk.next(rules, |symbol| symbols.is_some() && fixed[usize::from(symbol)], work) {
                Next::Letter(symbol, depth) => {
                    let derived = symbols.as_ref().map_or(1, |symbols| symbols.get(depth as usize, symbol));
                    let derived = u64::try_from(derived).ok();
                    let Some(rest) = derived.and_then(|derived| left.checked_sub(derived)) else {
                        break Err(LimitName::Symbols);
                    };
                    left = rest;
                    visit(symbol, depth);
                }
                Next::Pause => break Err(LimitName::Work),
                Next::End => break Ok(()),
            }
        };
        self.spent = self.spent.saturating_add(walk.work + meter.spent());
        outcome
    }

    /// The last generation before `n` that is within the limits, or an earlier generation if the search takes too long.
    /// The search doubles the number of steps until a limit is exceeded, then bisects.
    fn largest_within(&mut self, n: u32, limits: &Limits) -> Option<u32> {
        let (mut fits, mut exceeds) = (None, n);
        // About eight failing derivations.
        let most = self.spent.saturating_add(limits.work.saturating_mul(8));
        loop {
            let first = fits.map_or(0, |fits: u32| fits + 1);
            if first >= exceeds || self.spent >= most {
                return fits;
            }
            let trial = first + first.min((exceeds - first) / 2);
            match self.run(trial, limits, limits.work.min(most - self.spent), |_, _| ()) {
                Ok(()) => fits = Some(trial),
                Err(_) => exceeds = trial,
            }
        }
    }
}

/// Writes the texts of letters without random choices. Each text is written once and then copied.
struct TextWriter<'a> {
    rules: &'a Rules,
    text: &'a mut String,
    /// The lengths of texts in bytes; `None` if there are too many letters and depths.
    lengths: Option<Depths>,
    /// By cell of `lengths`: the start of the letter's text in `text`, once written.
    written: Vec<Option<usize>>,
}

impl<'a> TextWriter<'a> {
    fn new(rules: &'a Rules, lengths: Option<Depths>, text: &'a mut String) -> Self {
        let written = vec![None; lengths.as_ref().map_or(0, Depths::cells)];
        Self { rules, text, lengths, written }
    }

    /// Reserves memory for the text of `word` after `n` steps, as far as its length is known. Returns false if there is
    /// not enough memory.
    fn reserve(&mut self, n: u32, word: &[LetterId]) -> bool {
        let bytes = self.lengths.as_ref().map_or(0, |lengths| lengths.sum(n as usize, word));
        usize::try_from(bytes).is_ok_and(|bytes| self.text.try_reserve_exact(bytes).is_ok())
    }

    /// Appends the text of a letter after `depth` steps. The recursion depth is `depth`, at most 1,000.
    fn write(&mut self, symbol: LetterId, depth: u32) {
        let column = usize::from(symbol);
        let successor = match &self.rules.rewrites[column] {
            Rewrite::Always(successor) if depth > 0 => successor,
            _ => return self.text.push(self.rules.letters[column].symbol),
        };
        let cell = self.lengths.as_ref().and_then(|lengths| lengths.cell(depth as usize, symbol));
        let length = self.lengths.as_ref().map_or(0, |lengths| lengths.get(depth as usize, symbol));
        if let Some(start) = cell.and_then(|cell| self.written[cell]) {
            return self.text.extend_from_within(start..start + length as usize);
        }
        let start = self.text.len();
        for &child in successor {
            self.write(child, depth - 1);
        }
        if let Some(cell) = cell.filter(|_| length <= COPIED) {
            self.written[cell] = Some(start);
        }
    }
}

/// By letter: whether its derivation has no random choice.
fn fixed(rules: &Rules) -> Vec<bool> {
    // Pairs of a letter and a letter whose successor contains it, later sorted by the first.
    let mut makers: Vec<(LetterId, LetterId)> = Vec::new();
    let mut open: Vec<LetterId> = Vec::new();
    let mut fixed = vec![true; rules.rewrites.len()];
    let mut seen = vec![LetterId::MAX; rules.rewrites.len()];
    for (maker, rewrite) in rules.rewrites.iter().enumerate() {
        let maker = maker as LetterId;
        match rewrite {
            Rewrite::Keep => {}
            Rewrite::Choose(_) => {
                fixed[usize::from(maker)] = false;
                open.push(maker);
            }
            Rewrite::Always(word) => {
                // Skips most repeated pairs.
                for &made in word {
                    if maker == LetterId::MAX || core::mem::replace(&mut seen[usize::from(made)], maker) != maker {
                        makers.push((made, maker));
                    }
                }
            }
        }
    }
    if open.is_empty() {
        return fixed;
    }
    lsystem_base::sorted::sort(&mut makers);
    while let Some(letter) = open.pop() {
        let from = makers.partition_point(|&(made, _)| made < letter);
        for &(_, maker) in makers[from..].iter().take_while(|&&(made, _)| made == letter) {
            if core::mem::replace(&mut fixed[usize::from(maker)], false) {
                open.push(maker);
            }
        }
    }
    fixed
}

#[cfg(test)]
mod tests;
