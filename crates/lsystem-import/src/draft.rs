//! A system while a reader translates it.

use crate::account::{Fate, Mark};
use crate::source::Source;
use crate::vocabulary::{Key, rows};
use crate::{Entry, Remark};
use core::array::IntoIter;
use core::iter::Flatten;
use core::ops::{Range, RangeInclusive};
use lsystem_base::{MAX_ITERATIONS, decimal, say, sorted, sorted::set};
use lsystem_drawing::System;
use lsystem_syntax::notes::excerpt;
use lsystem_syntax::{
    Action, Definition, Grammar, Module, Production, Style, look_alike, parse, parse_overrides, print_axiom,
    print_rules,
};
use std::collections::{HashMap, HashSet};

/// A system while it is read: texts in our notation, and what was not carried over.
#[derive(Debug)]
pub(super) struct Draft<'a> {
    /// The text that is read.
    pub(super) source: Source<'a>,
    /// The result so far.
    pub(super) definition: Definition,
    /// The actions of symbols in the words of custom symbols, such as `turn left 90`; empty for no action. Only symbols
    /// that occur and act differently in the dialect become custom symbols.
    pub(super) meanings: Vec<(char, String)>,
    /// The actions of all other symbols; `None` leaves them to the dialect.
    pub(super) others: Option<&'static str>,
    /// Whether the text gives the number of iterations.
    pub(super) has_iterations: bool,
    /// Whether the text is in our own notation: its custom symbols are complete, and its look is meant.
    pub(super) is_ours: bool,
    /// The first line of the system in the text, from 1.
    pub(super) line: usize,
    remarks: Vec<Remark>,
    marks: Vec<Mark>,
    /// The parts of the text that belong to the system. What stands there without a mark is noted as not understood.
    extents: Vec<Range<usize>>,
}

/// Characters between statements without a meaning of their own.
const SEPARATORS: &str = ",;:.=(){}[]'\"`“”‘’*_|•·-–";
/// The most characters that say what a part became.
const MAX_WORDS: usize = 200;
/// The most remarks of a system.
const MAX_REMARKS: usize = 100;

impl<'a> Draft<'a> {
    /// An empty draft of a system that begins in this line of the text.
    pub(super) fn new(source: Source<'a>, name: &str, line: usize) -> Self {
        let name = name.trim().chars().take(200).collect();
        Self {
            source,
            definition: Definition { name, ..Definition::default() },
            meanings: Vec::new(),
            others: None,
            has_iterations: false,
            is_ours: false,
            line,
            remarks: Vec::new(),
            marks: Vec::new(),
            extents: Vec::new(),
        }
    }

    /// The place of a slice of the text; empty at its start for any other text.
    pub(super) fn place(&self, part: &str) -> Range<usize> {
        self.source.place(part).unwrap_or_default()
    }

    /// These bytes belong to the system.
    pub(super) fn covers(&mut self, span: Range<usize>) {
        self.extents.push(span);
    }

    /// This part is read; `became` says what it is in the definition, such as `angle 60`. Long words are shortened,
    /// because marks inside divide the part, and each division has the words.
    pub(super) fn read(&mut self, span: Range<usize>, became: String) {
        let mut words = became;
        if let Some((end, _)) = words.char_indices().nth(MAX_WORDS) {
            words.truncate(end);
            words.push('…');
        }
        self.marks.push(Mark { span, fate: Fate::Read, words });
    }

    /// This part has no meaning for the system: a comment, markup, punctuation.
    pub(super) fn pass(&mut self, span: Range<usize>) {
        self.marks.push(Mark { span, fate: Fate::Passed, words: String::new() });
    }

    /// Adds a remark on a part of a line: the system is read without it, or with a part that the text does not give.
    pub(super) fn note(&mut self, line: usize, text: &str, message: String) {
        let span = self.source.place_in_line(line, text);
        self.remark(line, span, text, message, false);
    }

    /// Refuses the system for this reason.
    pub(super) fn refuse(&mut self, line: usize, text: &str, message: String) {
        let span = self.source.place_in_line(line, text);
        self.remark(line, span, text, message, true);
    }

    /// As [`Draft::note`], on any bytes of the text.
    pub(super) fn note_at(&mut self, span: Range<usize>, message: String) {
        self.remark_at(span, message, false);
    }

    /// As [`Draft::refuse`], for any bytes of the text.
    pub(super) fn refuse_at(&mut self, span: Range<usize>, message: String) {
        self.remark_at(span, message, true);
    }

    fn remark_at(&mut self, span: Range<usize>, message: String, refused: bool) {
        let line = self.source.line_of(span.start);
        let text = self.source.text.get(span.clone()).unwrap_or_default();
        self.remark(line, span, text, message, refused);
    }

    fn remark(&mut self, line: usize, span: Range<usize>, text: &str, message: String, refused: bool) {
        if !text.trim().is_empty() {
            let fate = if refused { Fate::Refused } else { Fate::Noted };
            self.marks.push(Mark { span: span.clone(), fate, words: message.clone() });
        }
        let remark = Remark { line, text: excerpt(text), message, refused, span };
        if self.remarks.len() < MAX_REMARKS && !self.remarks.contains(&remark) {
            self.remarks.push(remark);
        } else if refused && !self.is_refused() {
            self.remarks.pop();
            self.remarks.push(remark);
        }
    }

    /// Whether the system is refused already.
    pub(super) fn is_refused(&self) -> bool {
        self.remarks.iter().any(|remark| remark.refused)
    }

    /// Sets the actions of a symbol, in the words of custom symbols; empty for no action. The last ones count.
    pub(super) fn meaning(&mut self, symbol: char, actions: impl Into<String>) {
        self.meanings.push((symbol, actions.into()));
    }

    /// Takes over a system that was read from a text inside this one, such as the code in a link. All its remarks are
    /// about `span`.
    pub(super) fn adopt(&mut self, mut inner: Draft<'_>, span: &Range<usize>) {
        inner.account();
        let line = self.source.line_of(span.start);
        for Remark { text, message, refused, .. } in inner.remarks {
            self.remark(line, span.clone(), &text, message, refused);
        }
        (self.definition, self.meanings, self.others) = (inner.definition, inner.meanings, inner.others);
        (self.has_iterations, self.is_ours) = (inner.has_iterations, inner.is_ours);
    }

    /// The symbols of a part of the text without white space. Typographic look-alikes, as on web pages, are read as what
    /// they look like, with a remark.
    pub(super) fn symbols(&mut self, part: &str) -> Vec<char> {
        let start = self.place(part).start;
        let mut symbols = Vec::new();
        for (at, ch) in part.char_indices().filter(|(_, ch)| !ch.is_whitespace()) {
            let read = look_alike(ch);
            let span = start + at..start + at + ch.len_utf8();
            match read {
                Some(' ') => self.note_at(span, say!("This invisible character is left out")),
                Some(read) => self.note_at(span, say!("Read as `{}`", read)),
                None => {}
            }
            symbols.extend(Some(read.unwrap_or(ch)).filter(|ch| *ch != ' '));
        }
        symbols
    }

    /// Takes over a grammar of plain symbols.
    pub(super) fn grammar(&mut self, grammar: &Grammar) {
        self.definition.axiom = print_axiom(grammar);
        self.definition.rules = print_rules(grammar);
    }

    /// Takes over the number of iterations, which must be whole and within our limit.
    pub(super) fn iterations(&mut self, line: usize, text: &str) {
        let number = decimal::read(text.trim()).filter(|n| n.is_finite() && *n >= 0.0);
        match number {
            Some(n) if n.fract() == 0.0 && n <= f64::from(MAX_ITERATIONS) => {
                self.definition.iterations = n as u32;
                self.has_iterations = true;
            }
            Some(n) if n.fract() == 0.0 => {
                self.definition.iterations = MAX_ITERATIONS;
                self.has_iterations = true;
                self.note(line, text, say!("At most {} iterations are possible", MAX_ITERATIONS));
            }
            _ => self.note(line, text, say!("The number of iterations cannot be read")),
        }
    }

    /// The finished system, and the marks on the text. It is refused if it does not compile.
    pub(super) fn finish(mut self) -> (Entry, Vec<Mark>) {
        self.account();
        if !self.is_refused() {
            self.check();
        }
        let Self { mut definition, remarks, marks, is_ours, .. } = self;
        // A text that says nothing about colours and widths gets a look that suits the drawing.
        definition.style.auto |= !is_ours && definition.style == Style::default();
        let refused = remarks.iter().any(|remark| remark.refused);
        (Entry { name: definition.name.clone(), definition: (!refused).then_some(definition), remarks }, marks)
    }

    /// Notes what stands inside the system and has no mark.
    fn account(&mut self) {
        let mut marked: Vec<Range<usize>> = self.marks.iter().map(|mark| mark.span.clone()).collect();
        sorted::sort_by_key(&mut marked, |span| span.start);
        let mut extents = core::mem::take(&mut self.extents);
        sorted::sort_by_key(&mut extents, |span| span.start);
        let mut gaps = Vec::new();
        let (mut next, mut at) = (0, 0);
        for extent in extents {
            at = at.max(extent.start);
            while let Some(span) = marked.get(next).filter(|span| span.start < extent.end) {
                gaps.push(at..span.start);
                at = at.max(span.end);
                next += 1;
            }
            gaps.push(at..extent.end);
            at = at.max(extent.end);
        }
        for gap in gaps {
            for line in self.source.text.get(gap).unwrap_or_default().lines() {
                let words = line.split(|c: char| c.is_whitespace() || SEPARATORS.contains(c));
                if words.filter(|word| !word.is_empty()).any(|word| !rows(word).has(Key::Filler)) {
                    self.note_at(self.place(line.trim()), say!("This is not understood"));
                }
            }
        }
    }

    /// Completes the definition and checks that it compiles.
    fn check(&mut self) {
        if let Some(wrong) = self.definition.out_of_range().first() {
            return self.refuse(self.line, "", wrong.message.clone());
        }
        let (grammar, _) = parse(&self.definition.axiom, &self.definition.rules);
        if !self.is_ours {
            self.custom_symbols(&grammar);
        }
        if !self.has_iterations {
            self.definition.iterations = fitting_iterations(&grammar);
            let n = self.definition.iterations;
            self.note(self.line, "", chosen_iterations(n));
        }
        let mut problems = self.definition.out_of_range();
        if problems.is_empty() {
            problems = System::problems(&self.definition);
        }
        if let Some(error) = problems.iter().find(|problem| problem.is_error()) {
            let found = self.definition.text(error.field).and_then(|text| text.get(error.span.clone()));
            let (found, message) = (found.unwrap_or_default().to_owned(), error.message.clone());
            self.refuse(self.line, &found, say!("In our notation: {}", message));
        }
    }

    /// Writes the custom symbols: those that occur and act differently in the dialect.
    fn custom_symbols(&mut self, grammar: &Grammar) {
        let images = grammar.images.iter().flat_map(|image| &image.successor);
        let symbols = set(grammar.made().chain(images).map(|module| module.symbol));
        let meanings: HashMap<char, &str> =
            self.meanings.iter().map(|(known, words)| (*known, words.as_str())).collect();
        let mut lines = Vec::new();
        for symbol in symbols {
            let words = match (meanings.get(&symbol), self.others) {
                (Some(words), _) => *words,
                (None, Some(words)) => words,
                (None, None) => continue,
            };
            if actions(words).as_deref() != Some(self.definition.dialect.actions(symbol)) {
                lines.push(lsystem_syntax::overrides::line(symbol, if words.is_empty() { "nothing" } else { words }));
            }
        }
        self.definition.overrides = lines.join("\n");
    }
}

/// What the symbols of a program do, in the words of custom symbols: its line of `turtles.txt`.
pub(super) fn turtle(program: &str) -> impl Iterator<Item = (char, &'static str)> {
    let mut lines = include_str!("turtles.txt").lines();
    let own = lines.find_map(|line| line.strip_prefix(program)?.strip_prefix(": ")).unwrap_or_default();
    own.split(", ").filter_map(|one| Some((one.chars().next()?, one.split_once(' ')?.1)))
}

/// The actions that words name; `None` if a word is unknown.
fn actions(words: &str) -> Option<Vec<Action>> {
    if words.is_empty() {
        return Some(Vec::new());
    }
    let (mut found, diagnostics) = parse_overrides(&format!("X: {words}"));
    if diagnostics.is_empty() { Some(found.pop()?.actions) } else { None }
}

/// A production of plain symbols.
pub(super) fn production(symbol: char, successor: impl IntoIterator<Item = char>) -> Production {
    Production::new(symbol, successor.into_iter().map(Module::from).collect())
}

/// Single characters that a system does not use, for actions and names that need a symbol of their own.
#[derive(Debug)]
pub(super) struct FreeSymbols {
    used: HashSet<char>,
    given: HashMap<String, char>,
    /// The letters that were not tried yet.
    letters: Flatten<IntoIter<RangeInclusive<char>, 4>>,
}

impl Default for FreeSymbols {
    fn default() -> Self {
        // Letters without an action in any dialect that readers use, then Greek, then Latin and CJK letters.
        let letters = ['a'..='z', 'α'..='ω', '\u{100}'..='\u{17f}', '\u{4e00}'..='\u{9fff}'];
        Self { used: HashSet::new(), given: HashMap::new(), letters: letters.into_iter().flatten() }
    }
}

impl FreeSymbols {
    /// Marks the characters of a text as used.
    pub(super) fn add_used(&mut self, text: &str) {
        self.used.extend(text.chars());
    }

    /// The keys and their symbols.
    pub(super) fn given(&self) -> impl Iterator<Item = (&str, char)> {
        self.given.iter().map(|(key, symbol)| (key.as_str(), *symbol))
    }

    /// The symbol for a key, the same one for equal keys. There are more letters than custom symbols, so the last one
    /// is never needed in a system that compiles.
    pub(super) fn get(&mut self, key: &str) -> char {
        if let Some(&symbol) = self.given.get(key) {
            return symbol;
        }
        let acts = |c: char| matches!(c, 'f' | 'g' | 'v' | 'ε' | 'ς');
        let symbol = self.letters.find(|c| !acts(*c) && !self.used.contains(c)).unwrap_or('\u{ac00}');
        self.used.insert(symbol);
        self.given.insert(key.to_owned(), symbol);
        symbol
    }
}

/// The remark on a system without a number of iterations.
pub(super) fn chosen_iterations(n: u32) -> String {
    say!("The text gives no number of iterations; {} is chosen by the size", n)
}

/// A number of iterations that gives a picture of a usual size: the largest whose string has at most 20,000 symbols.
pub(super) fn fitting_iterations(grammar: &Grammar) -> u32 {
    const MAX: f64 = 20_000.0;
    const STEPS: u32 = 16;
    if !grammar.is_plain() {
        return 5;
    }
    let letters = set(grammar.made().chain(grammar.productions.iter().flat_map(|p| &p.successor)).map(|m| m.symbol));
    let index = |symbol: char| letters.binary_search(&symbol).ok();
    // By letter: the letters of its successor. Of several random productions, the longest counts.
    let mut successors: Vec<Option<Vec<usize>>> = vec![None; letters.len()];
    for production in &grammar.productions {
        let Some(letter) = index(production.predecessor.symbol) else { continue };
        let own: Vec<usize> = production.successor.iter().filter_map(|module| index(module.symbol)).collect();
        if successors[letter].as_ref().is_none_or(|known| known.len() <= own.len()) {
            successors[letter] = Some(own);
        }
    }
    let mut counts = vec![0.0; letters.len()];
    grammar.axiom.iter().filter_map(|module| index(module.symbol)).for_each(|letter| counts[letter] += 1.0);
    for step in 0..STEPS {
        let mut next = vec![0.0; letters.len()];
        for (letter, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0.0) {
            match &successors[letter] {
                Some(made) => made.iter().for_each(|&made| next[made] += count),
                None => next[letter] += count,
            }
        }
        if next.iter().sum::<f64>() > MAX || next == counts {
            return step.max(1);
        }
        counts = next;
    }
    STEPS
}
