//! Systems in running text, lists, tables and formulas, as in papers, encyclopedias, settings and books.
//!
//! ```text
//! axiom X, angle 25°, rules (X → F+[[X]-X]-F[-FX]+X), (F → FF)
//! ```
//!
//! Labels say what stands behind them; arrows make rules; sentences such as `+ means turn right` say what symbols do. A
//! system ends where the axiom is said anew.

use crate::MAX_ENTRIES;
use crate::angle::angle;
use crate::assembly::{Angle, Rule, Said, Statements, Symbols};
use crate::decode::Decoded;
use crate::draft::Draft;
use crate::keys::{Key, key, letter_of};
use crate::phrases::{actions, symbols};
use crate::source::Source;
use crate::words::{is_language, is_prose, weight, weighted};
use core::ops::Range;
use lsystem_base::{decimal, say};
use std::collections::HashSet;

/// Longer predecessors and sentences are none, in bytes.
const LONGEST: usize = 1000;
/// A text with more arrows is no description of a system.
const MOST_RULES: usize = 20_000;

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let start = source.text.trim_start();
    // Objects and programs have a reader of their own.
    if start.starts_with('{') || start.starts_with("[{") || is_program(source.text) {
        return None;
    }
    let decoded = Decoded::new(source.text);
    let lower = decoded.text.to_lowercase();
    let semicolons = decoded.text.lines().filter(|line| line.trim_end().ends_with(';')).count() > 1;
    let mut reader = Reader {
        decoded: &decoded,
        said: Statements::new("", 0, Symbols::Usual),
        systems: Vec::new(),
        section: Section::None,
        title: None,
        next_title: None,
        semicolons,
        constants: Vec::new(),
        columns: Vec::new(),
        last: None,
        degrees: None,
        arrows: 0,
        is_named: lower.contains("axiom") || lower.contains("ω") || lower.contains("omega"),
    };
    let mut at = 0;
    for line in decoded.text.split('\n') {
        reader.line(at..at + line.len());
        at += line.len() + 1;
        if reader.arrows > MOST_RULES {
            let why = say!("A text with more than {} rules is not read", MOST_RULES);
            let end = source.text.len();
            reader.said.refuse(end..end, why);
            break;
        }
    }
    reader.finish();
    let systems = reader.systems;
    let drafts: Vec<Draft<'a>> = systems.into_iter().map(|said| said.assemble(source, &decoded.markup)).collect();
    (!drafts.is_empty()).then_some(drafts)
}

/// Whether several lines of a text are those of a program.
fn is_program(text: &str) -> bool {
    const STARTS: [&str; 29] = [
        "import ",
        "from ",
        "def ",
        "class ",
        "function ",
        "public ",
        "private ",
        "using ",
        "#include",
        "package ",
        "const ",
        "let ",
        "var ",
        "fn ",
        "export ",
        "return ",
        "for (",
        "while (",
        "if (",
        "}",
        "void ",
        "static ",
        "end",
        "local ",
        "elif ",
        "else:",
        "//!",
        "///",
        "use ",
    ];
    let is_code = |line: &&str| {
        let line = line.trim_start();
        STARTS.iter().any(|start| line.starts_with(start)) && !line.starts_with("from the ") && !line.contains("->")
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
    /// The columns of a table.
    columns: Vec<Option<Key>>,
    /// A row that may be the head of a table.
    last: Option<Vec<String>>,
    /// The first number before a sign of degrees.
    degrees: Option<Said<f64>>,
    arrows: usize,
    is_named: bool,
}

/// A label in a line.
#[derive(Debug)]
struct Label {
    start: usize,
    value: usize,
    key: Key,
    word: String,
}

/// Arrows of rules, longer ones first.
const ARROWS: [&str; 15] = ["|->", "--->", "==>", "-->", "::=", "->", "=>", ":=", "→", "⟶", "⇒", "⟹", "↦", "➔", "➝"];
/// Quotes and markup around words.
const QUOTES: [char; 12] = ['"', '\'', '`', '“', '”', '‘', '’', '*', ' ', '\t', '«', '»'];

impl Reader<'_> {
    fn span(&self, range: &Range<usize>) -> Range<usize> {
        self.decoded.span(range)
    }

    fn text(&self, range: &Range<usize>) -> &str {
        self.decoded.text.get(range.clone()).unwrap_or_default()
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
            return;
        }
        // A comment behind a blank.
        let comment = ["// ", " # ", "/* "].iter().filter_map(|mark| text.find(mark)).min();
        if let Some(at) = comment.filter(|at| *at > 0 || text.starts_with("//")) {
            let rest = line.start + at..line.end;
            self.said.comments.push(self.span(&rest));
            line = self.trimmed(&(line.start..line.start + at), &[]);
        }
        if self.semicolons && self.text(&line).ends_with(';') {
            line.end -= 1;
        }
        if self.row(&line) {
            return;
        }
        self.last = None;
        let whole = line;
        let line = self.without_bullet(&whole);
        self.cover(&(whole.start..line.start));
        let text = self.text(&line).to_owned();
        if text.is_empty() {
            return;
        }
        // Sections of settings: `[rules]`.
        if let Some(name) = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'))
            && let Some(key) = key(name)
        {
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
        self.note_degrees(&line, &text);
    }

    /// A line without the mark of a list before it: `-`, `1.`, `p1:`.
    fn without_bullet(&self, line: &Range<usize>) -> Range<usize> {
        let mut line = line.clone();
        for _ in 0..3 {
            let text = self.text(&line);
            let mut length = 0;
            if text.starts_with(['•', '·', '▪', '◦', '‣'])
                || (text.starts_with(['-', '*', '>', '–', '#']) && text[1..].starts_with([' ', '#']))
            {
                let marks =
                    text.len() - text.trim_start_matches(['•', '·', '▪', '◦', '‣', '-', '*', '>', '–', '#']).len();
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

    /// Reads a row of a table; whether the line is one.
    fn row(&mut self, line: &Range<usize>) -> bool {
        let text = self.text(line).to_owned();
        if !text.starts_with('|') || text.matches('|').count() < 3 {
            if !text.contains('\t') {
                self.columns.clear();
            }
            return false;
        }
        let mut cells: Vec<Range<usize>> = Vec::new();
        let mut from = line.start + 1;
        for (at, _) in text.match_indices('|').skip(1) {
            cells.push(self.trimmed(&(from..line.start + at), &[]));
            from = line.start + at + 1;
        }
        if from < line.end {
            cells.push(self.trimmed(&(from..line.end), &[]));
        }
        let is_rule = cells.iter().all(|cell| {
            let cell = self.text(cell);
            !cell.is_empty() && cell.chars().all(|c| matches!(c, '-' | ':' | ' '))
        });
        if is_rule {
            let head = self.last.take().unwrap_or_default();
            self.columns = head.iter().map(|name| key(name.trim_matches(QUOTES))).collect();
            return true;
        }
        let has = |columns: &[Option<Key>], wanted: Key| columns.contains(&Some(wanted));
        if !has(&self.columns, Key::Axiom) || !(has(&self.columns, Key::Rules) || has(&self.columns, Key::Rule)) {
            self.last = Some(cells.iter().map(|cell| self.text(cell).to_owned()).collect());
            return self.columns.is_empty();
        }
        self.next_system();
        let columns = self.columns.clone();
        for (column, cell) in columns.into_iter().zip(cells) {
            let Some(key) = column else { continue };
            let label = Label { start: cell.start, value: cell.start, key, word: "axiom".to_owned() };
            self.labelled(&label, cell, false);
        }
        self.next_system();
        true
    }

    /// The labels of a line, in order.
    fn labels(&self, line: &Range<usize>, text: &str) -> Vec<Label> {
        let mut found: Vec<Label> = Vec::new();
        let mut at = 0;
        let mut before = ' ';
        while let Some(ch) = text[at..].chars().next() {
            let begins = ch.is_alphabetic() && !(before.is_alphanumeric() || before == '_');
            if begins && let Some((length, key, word, value)) = label_at(&text[at..], before) {
                found.push(Label { start: line.start + at, value: line.start + at + value, key, word });
                at += length.max(1);
                before = 'x';
                // What follows is a value: it begins with the label's own sign.
                at = at.max(value + at - length);
                continue;
            }
            // A word is passed as a whole, so that the work stays in proportion to the text.
            let skipped = if begins || ch.is_alphanumeric() {
                text[at..].find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len() - at)
            } else {
                ch.len_utf8()
            };
            before = text[at..at + skipped].chars().next_back().unwrap_or(' ');
            at += skipped;
        }
        found
    }

    /// Reads what stands behind a label.
    fn labelled(&mut self, label: &Label, value: Range<usize>, is_last: bool) {
        let whole = label.start..value.end;
        let mut inner = self.trimmed(&value, &QUOTES);
        if !is_last {
            inner.end = inner.start + self.text(&inner).trim_end_matches([';', ',', ' ', '|']).len();
        }
        let text = self.text(&inner).to_owned();
        match label.key {
            Key::Axiom => {
                self.section = Section::None;
                let value = self.trimmed(&value, &[]);
                self.axiom(label, &value);
            }
            Key::Rules | Key::Rule => {
                self.section = Section::Rules;
                let letter = letter_of(&label.word);
                let has_arrow = ARROWS.iter().any(|arrow| text.contains(arrow));
                match letter.filter(|_| !has_arrow && weak(&text).is_none() && !text.is_empty() && !is_prose(&text)) {
                    Some(letter) => self.push_rule(&letter.to_string(), text, None, &whole),
                    None => self.region(&inner, Section::Rules, true),
                }
                let head = label.start..inner.start.min(label.value.max(label.start));
                self.cover(&head);
            }
            Key::Meanings => {
                self.section = if label.word.eq_ignore_ascii_case("draw") && text.is_empty() {
                    Section::Images
                } else {
                    Section::Meanings
                };
                self.cover(&(label.start..label.value));
                self.region(&inner, Section::Meanings, true);
            }
            Key::Angle | Key::LeftAngle | Key::RightAngle => match angle(&text) {
                Ok((degrees, radians, end)) => {
                    let span = self.span(&(label.start..inner.start + end));
                    self.extent(&span);
                    let said = Said::new(Angle::Degrees(degrees), span.clone());
                    if radians && !text[..end].contains(['π', 'p', 'P', 'r']) {
                        self.said.note(span.clone(), say!("This angle is read as radians"));
                    }
                    let known = match label.key {
                        Key::LeftAngle => &mut self.said.left,
                        Key::RightAngle => &mut self.said.right,
                        _ => &mut self.said.angle,
                    };
                    match known {
                        Some(known) if known.value != said.value => {
                            let first = known.span.clone();
                            let why = say!("Two statements contradict each other");
                            self.said.refuse(first, why.clone());
                            self.said.refuse(span, why);
                        }
                        _ => *known = Some(said),
                    }
                    let rest = inner.start + end..value.end;
                    self.rest(&rest, is_last);
                }
                Err(why) if text.chars().any(|c| c.is_ascii_digit()) || why == crate::angle::NoAngle::Unclear => {
                    let span = self.span(&whole);
                    self.extent(&span);
                    let why = match why {
                        crate::angle::NoAngle::Unclear => {
                            say!("This angle may be meant in degrees or in radians; the text does not say which")
                        }
                        crate::angle::NoAngle::NoNumber => say!("This angle cannot be read"),
                    };
                    self.said.refuse(span, why);
                }
                Err(_) => {}
            },
            Key::Iterations => {
                let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
                if end > 0 && end < 8 {
                    let span = self.span(&(label.start..inner.start + end));
                    self.extent(&span);
                    if self.said.iterations.is_none() {
                        self.said.iterations = Some(Said::new(text[..end].to_owned(), span));
                    }
                    let rest = inner.start + end..value.end;
                    self.rest(&rest, is_last);
                }
            }
            Key::Name => {
                if !text.is_empty() && self.said.name.is_empty() {
                    self.said.name.clone_from(&text);
                    let span = self.span(&whole);
                    self.extent(&span);
                    self.said.names.push(Said::new(text, span));
                }
            }
            Key::LengthFactor | Key::Heading => {
                let number = angle(&text).ok().map(|(number, ..)| number);
                let plain = decimal::read(&text.trim().replace(',', "."));
                let span = self.span(&whole);
                match (label.key, plain, number) {
                    (Key::LengthFactor, Some(factor), _) => self.said.factor = Some(Said::new(factor, span.clone())),
                    (Key::Heading, _, Some(degrees)) => self.said.heading = Some(Said::new(degrees, span.clone())),
                    _ => self.said.note(span.clone(), say!("This cannot be read")),
                }
                self.extent(&span);
            }
            Key::Ignore => {
                let span = self.span(&whole);
                self.extent(&span);
                self.said.lines.push(Said::new(format!("ignore: {text}"), span));
            }
            Key::Step => {
                if text.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
                    let span = self.span(&whole);
                    self.said.note(span, say!("The length of a step changes only the size, which is fitted"));
                }
            }
        }
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

    fn axiom(&mut self, label: &Label, value: &Range<usize>) {
        let (inner, end) = self.word(value);
        let text: String = self.text(&inner).to_owned();
        if text.is_empty() || !label.word.to_lowercase().contains("axiom") && is_prose(&text) {
            return;
        }
        if is_prose(&text) && text.split_whitespace().count() > 2 {
            return;
        }
        match &self.said.axiom {
            Some(known) if squeezed(&known.value) == squeezed(&text) && self.said.rules.is_empty() => return,
            Some(_) => self.next_system(),
            None => {}
        }
        let span = self.span(&(label.start..inner.end));
        self.extent(&span);
        self.said.axiom = Some(Said::new(text, span));
        let rest = end..value.end;
        self.rest(&rest, true);
    }

    /// The word of symbols at the start of a range, and where it ends.
    fn word(&self, range: &Range<usize>) -> (Range<usize>, usize) {
        let range = self.trimmed(range, &[]);
        let text = self.text(&range);
        // In quotes, exactly what stands there.
        for (open, close) in [('`', '`'), ('"', '"'), ('“', '”'), ('\'', '\''), ('«', '»')] {
            if let Some(inside) = text.strip_prefix(open)
                && let Some(end) = inside.find(close)
            {
                let start = range.start + open.len_utf8();
                return (start..start + end, start + end + close.len_utf8());
            }
        }
        // In parentheses as a whole.
        if let Some(inside) = text.strip_prefix('(')
            && let Some(end) = inside.find(')')
            && inside[end + 1..].trim_matches(['.', ',', ' ', ';']).is_empty()
        {
            return (range.start + 1..range.start + 1 + end, range.end);
        }
        let start = range.start + text.len() - text.trim_start_matches(['*', '`']).len();
        let text = &text[start - range.start..];
        let tokens = tokens(text);
        let mut end = 0;
        let mut separated = false;
        for token in &tokens {
            let own = &text[token.clone()];
            if is_language(own, 3)
                || separated
                || matches!(own, "and" | "is" | "with" | "where" | "at" | "to" | "in" | "–" | "—")
            {
                break;
            }
            end = token.end;
            separated = own.ends_with([',', ';']) && own.len() > 1;
        }
        let word = text[..end].trim_end_matches(['.', ',', ';', '"', '`', '*', ' ', '”']);
        // Brackets and braces that only close.
        let word = if word.ends_with('}') && !word.contains('{') { word.trim_end_matches('}') } else { word };
        let word = if word.ends_with(')') && !word.contains('(') { word.trim_end_matches(')') } else { word };
        (start..start + word.len(), start + end)
    }

    /// Reads rules and meanings in a range of a line.
    fn region(&mut self, range: &Range<usize>, section: Section, alone: bool) {
        let range = self.trimmed(range, &[]);
        let text = self.text(&range).to_owned();
        if text.is_empty() {
            return;
        }
        if section == Section::Meanings {
            return self.meanings(&range);
        }
        let arrows = arrows(&text);
        self.arrows += arrows.len();
        if !arrows.is_empty() {
            return self.rules(&range, &text, &arrows, section);
        }
        if !alone {
            return self.meanings(&range);
        }
        // Rules with a weak sign: the whole text must be such rules.
        let mut pieces: Vec<Range<usize>> = Vec::new();
        let mut from = 0;
        for (at, ch) in text.char_indices().filter(|(_, ch)| matches!(ch, ';' | ',')) {
            let behind = text[at + 1..].trim_start();
            let next_is_rule = behind.chars().nth(1).is_some_and(|c| matches!(c, '=' | ':' | '>' | ' '));
            if ch == ';' && section == Section::Rules || next_is_rule && weak(behind).is_some() {
                pieces.push(from..at);
                from = at + 1;
            }
        }
        pieces.push(from..text.len());
        let found: Option<Vec<(Range<usize>, Weak)>> = pieces
            .into_iter()
            .filter(|piece| !text[piece.clone()].trim().is_empty())
            .map(|piece| weak(&text[piece.clone()]).map(|weak| (piece, weak)))
            .collect();
        match found.filter(|found| !found.is_empty()) {
            Some(found) => {
                for (piece, (from, to)) in found {
                    let place = range.start + piece.start..range.start + piece.end;
                    let place = self.trimmed(&place, &[]);
                    if let Some(number) =
                        constant(&to).filter(|_| section != Section::Rules && from.chars().all(char::is_alphabetic))
                    {
                        self.constants.push(Said::new(format!("{from} = {number}"), self.span(&place)));
                        continue;
                    }
                    if is_prose(&to) {
                        self.meanings(&place);
                        continue;
                    }
                    let (to, weight) = weighted(&to);
                    self.push_rule(&from, to.to_owned(), weight, &place);
                }
            }
            None => {
                self.constant_line(&range, &text);
                self.meanings(&range);
            }
        }
    }

    /// A constant of rules with parameters: `#define r 2`, `ratio = 0.9`.
    fn constant_line(&mut self, range: &Range<usize>, text: &str) {
        let define = text.strip_prefix("#define").or_else(|| text.strip_prefix("define")).map(str::trim);
        let pair = match define {
            Some(rest) => rest.split_once(char::is_whitespace),
            None => text.split_once('='),
        };
        let Some((name, value)) = pair else { return };
        let name = name.trim();
        if !name.is_empty()
            && name.len() < 30
            && name.chars().all(|c| c.is_alphanumeric() || c == '_')
            && let Some(number) = constant(value.trim())
        {
            self.constants.push(Said::new(format!("{name} = {number}"), self.span(range)));
        }
    }

    fn push_rule(&mut self, from: &str, to: String, weight: Option<f64>, place: &Range<usize>) {
        // `*` stands for any context.
        let bare = from.trim();
        let bare = bare.strip_prefix('*').map_or(bare, |rest| rest.trim_start().strip_prefix('<').unwrap_or(bare));
        let bare = bare.strip_suffix('*').map_or(bare, |rest| rest.trim_end().strip_suffix('>').unwrap_or(bare));
        let from = bare.trim().to_owned();
        let span = self.span(place);
        self.extent(&span);
        if self.section == Section::Images {
            self.said.images.push(Said::new(format!("{from} -> {to}"), span));
            return;
        }
        self.said.rules.push(Rule { from, to, weight, span });
    }

    /// Reads the rules of a text with arrows.
    fn rules(&mut self, range: &Range<usize>, text: &str, arrows: &[Range<usize>], section: Section) {
        let mut from = 0;
        for (index, arrow) in arrows.iter().enumerate() {
            let before = &text[from..arrow.start];
            let (head, head_weight) = predecessor(before);
            let start = arrow.start - (before.len() - head.start);
            let own = before[head.clone()].to_owned();
            let limit = arrows.get(index + 1).map_or(text.len(), |next| {
                let between = &text[arrow.end..next.start];
                arrow.end + predecessor(between).0.start
            });
            let after = &text[arrow.end..limit];
            // Marks and numbers between rules: `, p_2 :`.
            let between = before[..head.start].trim_matches(|c: char| c.is_whitespace() || ",;:({.".contains(c));
            let is_number = between.trim_start_matches(['p', 'r', 'P', 'R', '_']).chars().all(|c| c.is_ascii_digit());
            if is_number && from + head.start > from {
                self.cover(&(range.start + from..range.start + from + head.start));
            }
            let opened = before[..head.start].trim_end().ends_with(['(', '{']);
            let (to, end, said) = successor(after, opened, index + 1 < arrows.len());
            let place = range.start + start..range.start + arrow.end + end;
            from = arrow.end + end;
            if own.is_empty() || is_prose(&own) && !own.contains('(') {
                continue;
            }
            if let Some(phrase) = said {
                let place = range.start + start..range.start + limit;
                self.meaning(&own.chars().filter(|c| !QUOTES.contains(c)).collect::<Vec<_>>(), &phrase, &place);
                from = limit;
                continue;
            }
            let (word, weight) = weighted(&to);
            let word = word.trim_matches(['"', '`', '“', '”', '\'']).trim();
            let word =
                if matches!(word, "ε" | "λ" | "∅" | "ϵ" | "epsilon" | "*" | "\"\"" | "''") { "" } else { word };
            let _ = section;
            self.push_rule(&own, word.to_owned(), weight.or(head_weight), &place);
        }
        let rest = range.start + from..range.end;
        let rest = self.trimmed(&rest, &[',', ';', '.', ')', '(']);
        self.meanings(&rest);
    }

    /// Reads what symbols do, in the sentences of a range.
    fn meanings(&mut self, range: &Range<usize>) {
        let text = self.text(range).to_owned();
        let mut from = 0;
        let ends = text.match_indices(['.', ';', ',']).map(|(at, _)| at).chain([text.len()]);
        // A sentence ends at a point before a blank, at a semicolon, or at a comma before further symbols.
        for end in ends.collect::<Vec<_>>() {
            if end < from {
                continue;
            }
            let behind = &text[(end + 1).min(text.len())..];
            let cut = end == text.len()
                || text[end..].starts_with(';')
                || text[end..].starts_with('.') && behind.starts_with(char::is_whitespace)
                || text[end..].starts_with(',') && symbols(behind).is_some();
            if !cut {
                continue;
            }
            // `A mean draw forward and B mean move forward`
            let sentence = &text[from..end];
            let mut part = from;
            let joints = sentence.match_indices(" and ").filter(|_| sentence.len() <= LONGEST);
            for (at, _) in joints.map(|(at, word)| (from + at, word)).collect::<Vec<_>>() {
                if symbols(&text[at + 5..end]).is_some_and(|(_, begins)| actions(&text[at + 5 + begins..end]).is_some())
                    && symbols(&text[part..at]).is_some_and(|(_, begins)| actions(&text[part + begins..at]).is_some())
                {
                    self.sentence(range.start + part..range.start + at);
                    part = at + 5;
                }
            }
            self.sentence(range.start + part..range.start + end);
            from = end + 1;
        }
    }

    fn sentence(&mut self, range: Range<usize>) {
        let range = self.trimmed(&range, &['•']);
        let text = self.text(&range).to_owned();
        let Some((symbols, at)) = symbols(&text) else { return };
        self.meaning(&symbols, &text[at..], &range);
    }

    fn meaning(&mut self, symbols: &[char], phrase: &str, place: &Range<usize>) {
        let Some((actions, degrees)) = actions(phrase) else { return };
        let span = self.span(place);
        self.extent(&span);
        for symbol in symbols {
            let symbol = lsystem_syntax::look_alike(*symbol).unwrap_or(*symbol);
            let with_angle = |action: &&str| match degrees {
                Some(degrees) if action.starts_with("turn ") && **action != *"turn round" => {
                    format!("{action} {}", lsystem_base::number::number(degrees))
                }
                _ => (*action).to_owned(),
            };
            let words: Vec<String> = actions.iter().map(with_angle).collect();
            self.said.mean(symbol, words.join(", "), span.clone());
        }
    }

    /// Keeps the first number before a sign of degrees, for texts without a labelled angle.
    fn note_degrees(&mut self, line: &Range<usize>, text: &str) {
        if self.degrees.is_some() {
            return;
        }
        let Some(sign) =
            ["°", " degrees", "-degree", " deg", " degree"].iter().filter_map(|sign| text.find(sign)).min()
        else {
            return;
        };
        let digits = &text[..sign];
        let start = digits
            .rfind(|ch: char| !ch.is_ascii_digit() && !matches!(ch, '.' | ','))
            .map_or(0, |at| at + digits[at..].chars().next().map_or(1, char::len_utf8));
        if let Some(number) = decimal::read(&digits[start..].replace(',', ".")) {
            let span = self.span(&(line.start + start..line.start + sign));
            self.degrees = Some(Said::new(number, span));
        }
    }

    /// Ends a system.
    fn next_system(&mut self) {
        let next = Statements::new("", 0, Symbols::Usual);
        let mut said = core::mem::replace(&mut self.said, next);
        let title = core::mem::replace(&mut self.title, self.next_title.take());
        let constants = core::mem::take(&mut self.constants);
        let degrees = self.degrees.take();
        self.section = Section::None;
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
        let (Some(axiom), true) = (&said.axiom, !said.rules.is_empty()) else { return };
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
        if !said.rules.iter().filter_map(strict).any(occurs)
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
            let inner = self.trimmed(&title, &['#', '*', '=', '_', ':', '.', '-']);
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
        let place = self.decoded.place_of(at);
        let text = &self.decoded.text;
        let end = self.decoded.break_before(place)?;
        let start = self.decoded.break_before(text[..end].trim_end().len()).map_or(0, |at| at + 1);
        let range = self.trimmed(&(start..end), &QUOTES);
        let line = self.text(&range);
        let plain = !line.is_empty() && line.len() <= 200 && !line.contains([' ', '=', ':', '.']) && !is_prose(line);
        (plain && line.contains(['F', 'X', 'L', 'A', 'S'])).then(|| Said::new(line.to_owned(), self.span(&range)))
    }

    fn finish(&mut self) {
        self.next_system();
    }
}

/// A label at the start of a text: its length, key and word, and where its value begins.
fn label_at(text: &str, before: char) -> Option<(usize, Key, String, usize)> {
    // Up to four words.
    let mut ends = Vec::new();
    let mut at = 0;
    for _ in 0..4 {
        let word =
            text[at..].find(|c: char| !c.is_alphanumeric() && !matches!(c, '_' | '’')).unwrap_or(text.len() - at);
        if word == 0 || word > 40 {
            break;
        }
        ends.push(at + word);
        at += word;
        let blank = text[at..].len() - text[at..].trim_start_matches([' ', '-']).len();
        if blank == 0 || blank > 2 {
            break;
        }
        at += blank;
    }
    for end in ends.into_iter().rev() {
        let word = &text[..end];
        let Some(key) = key(word) else { continue };
        // A sign behind the label, perhaps behind markup and an explanation in parentheses.
        let mut behind =
            end + text[end..].len() - text[end..].trim_start_matches(['*', '_', '`', '"', ' ', '”', '\t']).len();
        if text[behind..].starts_with('(')
            && let Some(close) = text[behind..].find(')').filter(|close| *close < 40)
            && text[behind + close + 1..].trim_start().starts_with([':', '='])
        {
            behind += close + 1;
            behind += text[behind..].len() - text[behind..].trim_start().len();
        }
        let rest = &text[behind..];
        let sign = [":=", "::=", ":", "=", "≈"].iter().find(|sign| rest.starts_with(**sign));
        let is_sign =
            |sign: &str| !(rest.starts_with("=>") || rest.starts_with("==") || rest.starts_with("::") && sign == ":");
        if let Some(sign) = sign.filter(|sign| is_sign(sign)) {
            let value = behind + sign.len();
            let value = value + text[value..].len() - text[value..].trim_start_matches(['*', ' ', '_', '\t']).len();
            // `A: ...` of a rule is no label; single letters are, where a number follows.
            let single = word.chars().count() == 1;
            let number = text[value..]
                .starts_with(|c: char| c.is_ascii_digit() || matches!(c, 'π' | '(' | '~' | '≈' | '-' | '.'));
            if single && !number && !matches!(word, "ω") {
                continue;
            }
            return Some((end, key, word.to_owned(), value));
        }
        if word.chars().count() < 4 && word != "n" || before == '"' && key != Key::Axiom {
            continue;
        }
        // Without a sign, only words that can be nothing else, before a value that fits.
        let rest = ["is ", "are ", "of ", "ist ", "est ", "es "]
            .iter()
            .find_map(|word| rest.strip_prefix(word))
            .unwrap_or(rest);
        let value = text.len() - rest.len() + (rest.len() - rest.trim_start().len());
        let rest = &text[value..];
        let lower = word.to_lowercase();
        let fits = match key {
            Key::Axiom => {
                let first = rest.split_whitespace().next().unwrap_or_default();
                lower.contains("axiom")
                    && !first.is_empty()
                    && !is_language(first, 3)
                    && first.chars().any(char::is_alphabetic)
            }
            Key::Angle | Key::LeftAngle | Key::RightAngle => {
                rest.starts_with(|c: char| c.is_ascii_digit() || c == 'π' || c == '.') && angle(rest).is_ok()
            }
            Key::Iterations => rest.starts_with(|c: char| c.is_ascii_digit()) && lower.len() > 4,
            Key::Rules | Key::Rule => lower.starts_with("rule") || lower.starts_with("production"),
            _ => false,
        };
        if fits {
            return Some((end, key, word.to_owned(), value));
        }
    }
    None
}

/// The arrows of rules in a text. An arrow inside a word is none: `X -> XFX-F>X->`.
fn arrows(text: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let Some(arrow) = ARROWS.iter().find(|arrow| rest.starts_with(**arrow)) else {
            at += rest.chars().next().map_or(1, char::len_utf8);
            continue;
        };
        let place = at..at + arrow.len();
        at = place.end;
        let before = &text[found.last().map_or(0, |last| last.end)..place.start];
        let head = before.trim_end();
        if head.is_empty() {
            continue;
        }
        if found.is_empty() || !arrow.is_ascii() {
            found.push(place);
            continue;
        }
        // A further arrow stands behind a predecessor that is apart, and before a successor.
        let near = &head[head.floor_char_boundary(head.len().saturating_sub(LONGEST))..];
        let own = near.rsplit([' ', ',', ';', '(', '\t']).next().unwrap_or_default().trim_matches(QUOTES);
        let apart = near.len() > own.len() && (own.chars().count() == 1 || own.ends_with(')'));
        if apart && !text[place.end..].trim().is_empty() {
            found.push(place);
        }
    }
    found
}

/// The tokens of a text: parted by blanks outside of parentheses.
fn tokens(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = None;
    let mut depth = 0_usize;
    let last = text.rfind(')').unwrap_or_default();
    for (at, ch) in text.char_indices() {
        match ch {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        // Parentheses that nothing closes join nothing.
        if ch.is_whitespace() && (depth == 0 || last < at) {
            if let Some(start) = start.take() {
                found.push(start..at);
            }
        } else if start.is_none() {
            start = Some(at);
        }
        if found.len() > 100_000 {
            break;
        }
    }
    if let Some(start) = start {
        found.push(start..text.len());
    }
    found
}

/// The predecessor at the end of a text, with its contexts and its condition, and a weight before the arrow.
fn predecessor(before: &str) -> (Range<usize>, Option<f64>) {
    let text = before.trim_end();
    let mut end = text.len();
    let mut weighted = None;
    // `F (0.9) →`
    if text.ends_with(')')
        && let Some(open) = text.rfind('(')
        && text[..open].ends_with(char::is_whitespace)
        && let Some(found) = weight(&text[open + 1..text.len() - 1])
    {
        weighted = Some(found);
        end = text[..open].trim_end().len();
    }
    let text = &text[..end];
    let all = tokens(text);
    let Some(last) = all.last() else { return (end..end, weighted) };
    let mut start = last.start;
    let mut index = all.len() - 1;
    let own = |index: usize| &text[all[index].clone()];
    // Contexts in blanks: `B < A > C`.
    while index >= 2 && matches!(own(index - 1), "<" | ">") {
        index -= 2;
        start = all[index].start;
    }
    // A condition: `A(x) : x > 2`.
    if let Some(colon) = text.rfind(':') {
        let module = text[..colon].trim_end();
        let rest = text[colon + 1..].trim();
        let is_condition = module.ends_with(')') || rest == "*" || module.contains(['<', '>']);
        if is_condition && !rest.is_empty() {
            let (head, _) = predecessor(module);
            return (head.start..if rest == "*" { head.end } else { end }, weighted);
        }
    }
    // A weight before the predecessor: `0.3: F`.
    if index >= 1
        && own(index - 1).ends_with(':')
        && let Some(found) = weight(own(index - 1).trim_end_matches(':'))
    {
        weighted = Some(found);
    }
    let mut token = &text[start..end];
    // Behind a label, a bracket or a separator in the same token.
    for separator in [": ", ", ", "; "] {
        // Not inside the parentheses of a module.
        if let Some(at) = token.rfind(separator).filter(|at| !token[..*at].contains('(')) {
            start += at + separator.len();
            token = &text[start..end];
        }
    }
    if let Some(at) =
        token.rfind([',', ';', ':', '{']).filter(|at| *at + 1 < token.len() && !token.contains('(') && token.len() > 1)
    {
        let found = weight(&token[..at]).filter(|_| token[at..].starts_with(':'));
        weighted = weighted.or(found);
        start += at + 1;
        token = &text[start..end];
    }
    let has_context = token.contains(['<', '>']);
    let opened = token.starts_with('(') && token.len() > 1 && !token.ends_with(')');
    let trimmed = token.trim_start_matches(|c: char| {
        c == '(' && opened || "\"'`“‘•*".contains(c) && !(c == '*' && has_context) && token.chars().count() > 1
    });
    start += token.len() - trimmed.len();
    let trimmed =
        if trimmed.chars().count() > 1 { trimmed.trim_end_matches(['"', '\'', '`', '”', '’']) } else { trimmed };
    (start..start + trimmed.len(), weighted)
}

/// The successor at the start of a text, its end, and the words that stand in its place.
fn successor(after: &str, opened: bool, more: bool) -> (String, usize, Option<String>) {
    let lead = after.len() - after.trim_start().len();
    let text = &after[lead..];
    for (open, close) in [('"', '"'), ('`', '`'), ('“', '”')] {
        if let Some(inside) = text.strip_prefix(open)
            && let Some(end) = inside.find(close)
        {
            let rest = &inside[end + close.len_utf8()..];
            // What stands behind the quotes may be a weight.
            let (_, weight) = weighted(rest.trim_start().split(", ").next().unwrap_or_default());
            let plain = weight.is_none() || rest.trim().is_empty();
            if plain {
                return (inside[..end].to_owned(), lead + open.len_utf8() + end + close.len_utf8(), None);
            }
        }
    }
    // In running text a rule ends at its bracket.
    let mut depth = 0_i32;
    let mut limit = text.len();
    for (at, ch) in text.char_indices() {
        depth += i32::from(ch == '(') - i32::from(ch == ')');
        if ch == ')' && depth < 0 && opened {
            limit = at;
            break;
        }
    }
    let text = &text[..limit];
    let all = tokens(text);
    let mut end = 0;
    for (index, token) in all.iter().enumerate() {
        let own = &text[token.clone()];
        let weight_follows = index > 0 && matches!(own, "with" | "probability" | "prob." | "prob" | "weight");
        if (is_language(own.trim_start_matches('('), 3)
            || own.starts_with('(') && is_prose(own)
            || matches!(own, "and" | "is" | "where" | "for" | "in" | "to" | "or"))
            && !weight_follows
        {
            if index == 0 && !own.starts_with('(') {
                let words = text[..text.find(". ").unwrap_or(text.len())].to_owned();
                return (String::new(), lead + words.len(), Some(words));
            }
            break;
        }
        end = token.end;
        let separated = own.ends_with([',', ';']) && own.chars().count() > 1 && index + 1 < all.len();
        let stops = own.ends_with('.') && own.len() > 1;
        let next_is_weight =
            all.get(index + 1).is_some_and(|next| weight(&text[next.clone()]).is_some() && index + 2 == all.len());
        if separated && !next_is_weight || stops && (more || index + 1 < all.len()) {
            break;
        }
    }
    let word = text[..end].trim_end();
    let cut = word.trim_end_matches([',', ';', '.']);
    let word = if cut.is_empty() {
        word
    } else if word.ends_with(['.']) || more || end < text.trim_end().len() {
        cut
    } else {
        word.trim_end_matches('.')
    };
    (word.to_owned(), lead + end, None)
}

type Weak = (String, String);

/// A rule whose sign is weak: one symbol, `=`, `:` or `>`, and a word.
fn weak(text: &str) -> Option<Weak> {
    let text = text.trim();
    let bare = text.trim_start_matches(['"', '\'', '`']);
    let mut chars = bare.chars();
    let from = chars.next()?;
    if from.is_whitespace() || matches!(from, '=' | '<' | '(' | '#') {
        return None;
    }
    // A module with parameters: `A(x) = ..`.
    let mut head = from.to_string();
    let mut rest = chars.as_str();
    if rest.starts_with('(')
        && let Some(close) = rest.find(')')
    {
        head.push_str(&rest[..=close]);
        rest = &rest[close + 1..];
    }
    let rest = rest.trim_start_matches(['"', '\'', '`']).trim_start();
    let to = ["=", ":", ">"].iter().find_map(|sign| rest.strip_prefix(sign))?;
    if to.starts_with(['=', '>']) {
        return None;
    }
    let to = to.trim().trim_end_matches(',').trim_matches(['"', '\'', '`', '“', '”']);
    Some((head, to.to_owned()))
}

/// A number of a constant.
fn constant(text: &str) -> Option<String> {
    let text = text.trim().trim_end_matches([';', ',']);
    decimal::read(text).filter(|number| number.is_finite()).map(|_| text.to_owned())
}

/// Whether a line is a title: words without an arrow and without a label.
fn is_title(line: &str) -> bool {
    // `variables : F G` is none.
    if line.split_once(':').is_some_and(|(_, rest)| !rest.trim().is_empty() && !is_prose(rest)) {
        return false;
    }
    line.chars().filter(|ch| ch.is_alphabetic()).count() > 3
        && line.len() < 100
        && !line.contains(['→', '=', '{', ',', '>'])
        && !line.contains("->")
        && !line.trim_end().ends_with('.')
        && is_prose(line)
}

fn squeezed(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}
