//! Systems in running text, lists, tables and formulas, as in papers, encyclopedias, settings and books.
//!
//! ```text
//! axiom X, angle 25°, rules (X → F+[[X]-X]-F[-FX]+X), (F → FF)
//! ```
//!
//! Labels say what stands behind them; arrows make rules; sentences such as `+ means turn right` say what symbols do. A
//! system ends where the axiom is said anew.

mod labels;
mod line;
mod rules;

use crate::MAX_ENTRIES;
use crate::assembly::{Angle, Rule, Said, Statements, Symbols};
use crate::decode::Decoded;
use crate::draft::{Draft, turtle};
use crate::prose_words::is_prose;
use crate::rules::ARROWS;
use crate::source::Source;
use crate::vocabulary::{Key, key, words};
use crate::wrappings::tables;
use core::ops::Range;
use line::{is_title, squeezed};
use lsystem_base::say;
use std::collections::HashSet;

/// Longer predecessors and sentences are none, in bytes.
const LONGEST: usize = 1000;
/// A text with more arrows is no description of a system.
const MAX_RULES: usize = 20_000;

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let start = source.text.trim_start();
    // Objects and programs have a reader of their own.
    if start.starts_with('{') || start.starts_with("[{") || is_program(source.text) {
        return None;
    }
    let decoded = Decoded::new(source.text);
    let mut reader = Reader::new(&decoded);
    reader.lines();
    reader.next_system();
    let systems = reader.systems;
    let drafts: Vec<Draft<'a>> = systems.into_iter().map(|said| said.assemble(source, &decoded.markup)).collect();
    (!drafts.is_empty()).then_some(drafts)
}

/// The angle in degrees and the number of iterations that a text beside a system gives, if it gives one of each.
pub(super) fn beside(text: &str) -> (Option<Said<f64>>, Option<Said<u32>>) {
    let decoded = Decoded::new(text);
    let mut reader = Reader::new(&decoded);
    reader.said.axiom = Some(Said::new(String::new(), 0..0));
    reader.lines();
    let Statements { angle, iterations, remarks, .. } = reader.said;
    let signs = ["°", "degree"].iter().map(|sign| text.matches(sign).count()).sum::<usize>();
    let degrees = match angle {
        Some(Said { value: Angle::Degrees(degrees), span }) => Some(Said::new(degrees, span)),
        _ => reader.degrees.filter(|_| signs == 1),
    };
    let iterations = iterations.and_then(|n| Some(Said::new(n.value.parse().ok()?, n.span)));
    (degrees.filter(|_| !remarks.iter().any(|(.., refuses)| *refuses)), iterations)
}

/// Whether several lines of a text are those of a program.
fn is_program(text: &str) -> bool {
    // Blocks such as `koch {` hold descriptions, too.
    let has_calls = text.contains([';', '(']);
    let is_code = |line: &&str| {
        let line = line.trim_start();
        let begins = |word: &&&str| {
            let is_word = word.ends_with(char::is_alphanumeric);
            line.strip_prefix(**word).is_some_and(|rest| !is_word || rest.is_empty() || rest.starts_with(' '))
        };
        let is_start = words(Key::Code).iter().any(|word| begins(&word)) || line.starts_with('}') && has_calls;
        is_start && !line.starts_with("from the ") && !line.contains("->")
    };
    text.lines().filter(is_code).take(3).count() == 3
}

/// What the lines below a heading are.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    None,
    Rules,
    Meanings,
    /// Rules that replace symbols before they are drawn.
    Images,
}

struct Reader<'t> {
    decoded: &'t Decoded,
    said: Statements,
    systems: Vec<Statements>,
    section: Section,
    title: Option<Range<usize>>,
    next_title: Option<Range<usize>>,
    /// Whether a semicolon ends the statements.
    semicolons: bool,
    /// Names with numbers, which rules with parameters may use.
    constants: Vec<Said<String>>,
    /// The first number before a sign of degrees.
    degrees: Option<Said<f64>>,
    arrows: usize,
    is_named: bool,
    /// Whether the text is for Inkscape's dialog, whose letters are known.
    is_inkscape: bool,
    /// A symbol whose successors stand below, and the weight of the next one.
    pending: Option<String>,
    chance: Option<f64>,
}

/// A label in a line.
#[derive(Debug)]
struct Label {
    start: usize,
    value: usize,
    key: Key,
    word: String,
}

/// Marks of lists, headings and quotations; the first ones are nothing else.
const BULLETS: [char; 11] = ['•', '·', '▪', '◦', '‣', '-', '*', '>', '–', '—', '#'];
/// Quotes and markup around words.
const QUOTES: [char; 12] = ['"', '\'', '`', '“', '”', '‘', '’', '*', ' ', '\t', '«', '»'];

impl<'t> Reader<'t> {
    fn new(decoded: &'t Decoded) -> Self {
        let text = &decoded.mapped.text;
        let lower = text.to_lowercase();
        Self {
            decoded,
            said: Statements::default(),
            systems: Vec::new(),
            section: Section::None,
            title: None,
            next_title: None,
            semicolons: text.lines().filter(|line| line.trim_end().ends_with(';')).count() > 1,
            constants: Vec::new(),
            degrees: None,
            arrows: 0,
            is_inkscape: lower.contains("step length (px):"),
            pending: None,
            chance: None,
            is_named: lower.contains("axiom") || lower.contains("ω") || lower.contains("omega"),
        }
    }

    fn lines(&mut self) {
        let decoded = self.decoded;
        let mut at = 0;
        for line in decoded.mapped.text.split('\n') {
            self.line(at..at + line.len());
            at += line.len() + 1;
            if self.systems.len() > MAX_ENTRIES {
                break;
            }
            if self.arrows > MAX_RULES {
                let end = decoded.mapped.place(decoded.mapped.text.len());
                return self.said.refuse(end..end, say!("A text with more than {} rules is not read", MAX_RULES));
            }
        }
    }

    fn span(&self, range: &Range<usize>) -> Range<usize> {
        self.decoded.mapped.span(range)
    }

    fn text(&self, range: &Range<usize>) -> &str {
        self.decoded.mapped.text.get(range.clone()).unwrap_or_default()
    }

    /// A range without white space and these characters around it.
    fn trimmed(&self, range: &Range<usize>, around: &[char]) -> Range<usize> {
        let text = self.text(range);
        let is = |c: char| c.is_whitespace() || around.contains(&c);
        let start = range.start + text.len() - text.trim_start_matches(is).len();
        start..(start + text.trim_matches(is).len()).max(start)
    }

    fn line(&mut self, whole: Range<usize>) {
        let mut line = self.trimmed(&whole, &[]);
        let text = self.text(&line);
        if text.is_empty() {
            if self.text(&whole) == tables::END.trim_end_matches('\n') {
                self.next_system();
            }
            return;
        }
        // A comment behind a blank.
        let comment = [" // ", " # ", " /* "].iter().filter_map(|mark| text.find(mark)).min();
        if let Some(at) = comment.or(text.starts_with("// ").then_some(0)) {
            let rest = line.start + at..line.end;
            self.said.comments.push(self.span(&rest));
            line = self.trimmed(&(line.start..line.start + at), &[]);
        }
        if self.semicolons && self.text(&line).ends_with(';') {
            line.end -= 1;
        }
        let whole = line;
        let line = self.without_bullet(&whole);
        self.cover(&(whole.start..line.start));
        let text = self.text(&line).to_owned();
        if text.is_empty() {
            return;
        }
        // Sections of settings: `[rules]`.
        if let Some(name) = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'))
            && let Some(key) = key(name.rsplit('.').next().unwrap_or(name))
        {
            self.cover(&line);
            self.section = if key == Key::Rules { Section::Rules } else { Section::None };
            return;
        }
        let labels = self.labels(&line, &text);
        // `n = 0 : A` lists a generation.
        if let [Label { key: Key::Iterations, value, .. }, ..] = &labels[..] {
            let rest = &text[value - line.start..];
            let digits = rest.trim_start();
            let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
            let behind = digits[end..].trim_start();
            if end > 0 && (behind.starts_with(':') || behind.starts_with('→')) && behind.len() > 1 {
                let span = self.span(&line);
                return self.said.note(span, say!("This lists a generation"));
            }
        }
        // The first title since the last system; behind rules the title of the next one.
        if labels.is_empty() && is_title(&text) {
            let title = if self.said.rules.is_empty() { &mut self.title } else { &mut self.next_title };
            title.get_or_insert(line.clone());
        }
        let first = labels.first().map_or(line.end, |label| label.start);
        let before = line.start..first;
        // A line with words before its first label has no rules there unless it has an arrow.
        self.region(&before, self.section, labels.is_empty());
        for (index, label) in labels.iter().enumerate() {
            let end = labels.get(index + 1).map_or(line.end, |next| next.start);
            self.labelled(label, label.value..end.max(label.value), index + 1 == labels.len());
        }
        self.counted(&line, &text);
        self.note_degrees(&line, &text);
    }

    /// Reads a number before its word: `4 iterations`, `three iterations`.
    fn counted(&mut self, line: &Range<usize>, text: &str) {
        let is_end = |c: char| !c.is_alphanumeric();
        if self.said.axiom.is_none() {
            return;
        }
        for (at, word) in text.match_indices(char::is_whitespace).take(LONGEST) {
            let behind = &text[at + word.len()..];
            let name = &behind[..behind.find(is_end).unwrap_or(behind.len())];
            let number = text[..at].rsplit(is_end).next().unwrap_or_default();
            let lower = number.to_lowercase();
            let named = || words(Key::Numbers).iter().position(|word| *word == lower).map(|at| at % 10 + 1);
            let Some(n) = number.parse().ok().or_else(named).filter(|_| name.chars().count() > 7) else { continue };
            if key(name) == Some(Key::Iterations) && self.said.iterations.is_none() {
                let span = self.span(&(line.start + at - number.len()..line.start + at + word.len() + name.len()));
                self.extent(&span);
                self.said.iterations = Some(Said::new(n.to_string(), span));
            }
        }
    }

    /// A line without the mark of a list before it: `-`, `1.`, `p1:`.
    fn without_bullet(&self, line: &Range<usize>) -> Range<usize> {
        let mut line = line.clone();
        for _ in 0..3 {
            let text = self.text(&line);
            let mut length = 0;
            let next = text.chars().nth(1);
            if text.starts_with(&BULLETS[..5])
                || text.starts_with(BULLETS) && next.is_some_and(|next| matches!(next, ' ' | '#'))
            {
                let marks = text.len() - text.trim_start_matches(BULLETS).len();
                let rest = text[marks..].trim_start();
                // Not of `- -> turn left` and `* < F > *`.
                let is_symbol =
                    ARROWS.iter().any(|arrow| rest.starts_with(arrow)) || rest.starts_with(['<', '>', '=', ':']);
                if !is_symbol {
                    length = marks;
                }
            } else {
                // `1.`, `(2)`, `p1:`, `p_1 :`
                let inner = text.strip_prefix('(').unwrap_or(text);
                let name = inner.strip_prefix(['p', 'P', 'r', 'R']).unwrap_or(inner);
                let name = name.strip_prefix('_').unwrap_or(name);
                let digits = name.len() - name.trim_start_matches(|c: char| c.is_ascii_digit()).len();
                let behind = name[digits..].trim_start();
                if digits > 0
                    && digits < 3
                    && behind.starts_with(['.', ')', ':'])
                    && behind[1..].starts_with([' ', '\t'])
                {
                    let rest = behind[1..].trim_start();
                    let labelled = text.starts_with(['p', 'P', 'r', 'R', '(']) || behind.starts_with(['.', ')']);
                    // `1: draw` says what the symbol `1` does; `0.3: F -> F` is a weight.
                    if labelled && !rest.is_empty() {
                        length = text.len() - behind.len() + 1;
                    }
                }
            }
            if length == 0 {
                break;
            }
            line = self.trimmed(&(line.start + length..line.end), &[]);
        }
        line
    }

    /// What stands behind the value of a label on the same line: rules and meanings, or words.
    fn rest(&mut self, range: &Range<usize>, is_last: bool) {
        let range = self.trimmed(range, &[',', ';', '.', '|', ')', '(']);
        if !range.is_empty() && is_last {
            self.region(&range, Section::None, false);
        }
    }

    fn extent(&mut self, span: &Range<usize>) {
        self.said.extents.push(span.clone());
        if self.said.extents.len() == 1 {
            self.said.start = span.start;
        }
    }

    fn cover(&mut self, range: &Range<usize>) {
        let span = self.span(range);
        if !span.is_empty() {
            self.said.comments.push(span);
        }
    }

    /// Ends a system.
    fn next_system(&mut self) {
        let mut said = core::mem::take(&mut self.said);
        let title = core::mem::replace(&mut self.title, self.next_title.take());
        let constants = core::mem::take(&mut self.constants);
        let degrees = self.degrees.take();
        self.section = Section::None;
        (self.pending, self.chance) = (None, None);
        // One more than are read, so that the rest is noted.
        if self.systems.len() > MAX_ENTRIES {
            return;
        }
        // A caption: the axiom alone on the line before the first rule.
        if said.axiom.is_none() && (said.angle.is_some() || degrees.is_some()) && !self.is_named {
            said.axiom = said.rules.first().and_then(|rule| self.caption(rule.span.start));
        }
        // The axiom said again, without rules: what else is said there belongs to the system before.
        if said.rules.is_empty()
            && let (Some(again), Some(last)) = (&said.axiom, self.systems.last_mut())
            && last.axiom.as_ref().is_some_and(|axiom| squeezed(&axiom.value) == squeezed(&again.value))
        {
            last.angle = last.angle.take().or(said.angle);
            last.iterations = last.iterations.take().or(said.iterations);
            last.extents.extend(said.extents);
            return;
        }
        let (Some(axiom), true) = (&said.axiom, !said.rules.is_empty() || self.is_inkscape) else { return };
        let strict = |rule: &Rule| rule.from.chars().next();
        let begun: HashSet<char> = axiom.value.chars().collect();
        if !self.is_named && !said.rules.iter().filter_map(strict).any(|symbol| begun.contains(&symbol)) {
            return;
        }
        let is_module = |rule: &Rule| rule.from.chars().count() == 1 || rule.from.contains(['(', '<', '>']);
        if !self.is_named && !said.rules.iter().all(is_module) {
            return;
        }
        let made = said.rules.iter().map(|rule| &*rule.to).chain([&*axiom.value]).flat_map(str::chars);
        let made: HashSet<char> = made.collect();
        let occurs = |symbol: char| made.contains(&symbol);
        if !self.is_inkscape
            && !said.rules.iter().filter_map(strict).any(occurs)
            && said.rules.len() < 2
            && said.meanings.is_empty()
            && said.angle.is_none()
        {
            return;
        }
        // The words of what has arguments.
        let with_arguments = said.rules.iter().filter(|rule| rule.from.contains('(') || rule.to.contains('('));
        let texts = with_arguments.flat_map(|rule| [&*rule.from, &*rule.to]);
        let words = texts.chain([&*axiom.value].into_iter().filter(|axiom| axiom.contains('(')));
        let words: HashSet<&str> =
            words.flat_map(|text| text.split(|c: char| !c.is_alphanumeric() && c != '_')).collect();
        let uses = |name: &str| words.contains(name);
        let own: Vec<Said<String>> = constants
            .into_iter()
            .filter(|constant| constant.value.split_once(" = ").is_some_and(|(name, _)| uses(name)))
            .collect();
        said.extents.extend(own.iter().map(|constant| constant.span.clone()));
        said.lines.splice(0..0, own);
        if self.is_inkscape {
            said.symbols = Symbols::Said;
            turtle("Inkscape").for_each(|(symbol, words)| said.mean(symbol, words, 0..0));
        }
        if said.angle.is_none()
            && said.left.is_none()
            && said.right.is_none()
            && let Some(degrees) = degrees
        {
            let is_of_turn = said.meanings.iter().any(|(_, words)| words.value.contains("turn"));
            if !is_of_turn {
                said.extents.push(degrees.span.clone());
                said.angle = Some(Said::new(Angle::Degrees(degrees.value), degrees.span));
            }
        }
        // From the first to the last statement, all lines belong to the system.
        let start = said.extents.iter().map(|extent| extent.start).min().unwrap_or_default();
        let end = said.extents.iter().map(|extent| extent.end).max().unwrap_or_default();
        said.extents.clear();
        said.extents.push(self.decoded.lines_around(start..end));
        said.start = start;
        if said.name.is_empty()
            && let Some(title) = title
        {
            let inner = self.trimmed(&title, &['#', '*', '=', '_', ':', '.', '-', '[', ']']);
            let span = self.span(&inner);
            if span.end <= start || span.start >= start {
                self.text(&inner).clone_into(&mut said.name);
                said.names.push(Said::new(said.name.clone(), span));
            }
        }
        self.systems.push(said);
    }

    /// The axiom of a caption: alone on the line before a place of the source.
    fn caption(&self, at: usize) -> Option<Said<String>> {
        let place = self.decoded.mapped.at(at);
        let text = &self.decoded.mapped.text;
        let end = self.decoded.break_before(place)?;
        let start = self.decoded.break_before(text[..end].trim_end().len()).map_or(0, |at| at + 1);
        let range = self.trimmed(&(start..end), &QUOTES);
        let line = self.text(&range);
        let plain = !line.is_empty() && line.len() <= 200 && !line.contains([' ', '=', ':', '.']) && !is_prose(line);
        (plain && line.contains(['F', 'X', 'L', 'A', 'S'])).then(|| Said::new(line.to_owned(), self.span(&range)))
    }
}
