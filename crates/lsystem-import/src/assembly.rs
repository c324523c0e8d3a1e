//! A system from statements about it: an axiom, rules, angles, meanings, each with its place.

use crate::angle::{NoAngle, by_value, tidy};
use crate::draft::{Draft, turtle};
use crate::source::Source;
use crate::vocabulary::{Key, is_vague};
use core::ops::Range;
use lsystem_base::{counted, decimal, number::number, say, word, words::said};
use lsystem_syntax::{Dialect, Expr, Grammar, Module, Pattern, Production, look_alike, parse};
use std::collections::{HashMap, HashSet};

/// A value, and the place of its statement.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Said<T> {
    pub(super) value: T,
    pub(super) span: Range<usize>,
}

impl<T> Said<T> {
    pub(super) fn new(value: T, span: Range<usize>) -> Self {
        Self { value, span }
    }
}

/// A rule as it is written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rule {
    /// The predecessor with its contexts and its condition, as in our notation: `A < B(x) > C : x > 2`.
    pub(super) from: String,
    pub(super) to: String,
    pub(super) weight: Option<f64>,
    pub(super) span: Range<usize>,
}

/// An angle as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Angle {
    Degrees(f64),
    Radians(f64),
    /// A number without a unit.
    Unknown(f64),
}

/// What a text says about what symbols do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Symbols {
    /// The usual symbols of the field, as descriptions and books use them.
    #[default]
    Usual,
    /// Those of a program that is not known: the usual ones, with a remark.
    Program,
    /// Only those that are said.
    Said,
}

/// All that a text says about one system.
#[derive(Clone, Debug, Default)]
pub(super) struct Statements {
    pub(super) name: String,
    /// Where names stand.
    pub(super) names: Vec<Said<String>>,
    /// The first byte.
    pub(super) start: usize,
    pub(super) axiom: Option<Said<String>>,
    pub(super) rules: Vec<Rule>,
    pub(super) angle: Option<Said<Angle>>,
    pub(super) left: Option<Said<Angle>>,
    pub(super) right: Option<Said<Angle>>,
    pub(super) heading: Option<Said<f64>>,
    pub(super) iterations: Option<Said<String>>,
    pub(super) factor: Option<Said<f64>>,
    /// Lines of our notation that stand before the rules: `ignore: +-`, constants; and below them: `draw:` and images.
    pub(super) lines: Vec<Said<String>>,
    pub(super) images: Vec<Said<String>>,
    /// Symbols and their actions in the words of custom symbols.
    pub(super) meanings: Vec<(char, Said<String>)>,
    meant: HashSet<char>,
    pub(super) symbols: Symbols,
    /// Remarks, and whether they refuse the system.
    pub(super) remarks: Vec<(Range<usize>, String, bool)>,
    /// What belongs to the system.
    pub(super) extents: Vec<Range<usize>>,
    /// Comments and markup inside.
    pub(super) comments: Vec<Range<usize>>,
}

impl Statements {
    pub(super) fn new(name: &str, start: usize, symbols: Symbols) -> Self {
        Self { name: name.to_owned(), start, symbols, ..Self::default() }
    }

    pub(super) fn note(&mut self, span: Range<usize>, why: String) {
        self.remarks.push((span, why, false));
    }

    pub(super) fn refuse(&mut self, span: Range<usize>, why: String) {
        self.remarks.push((span, why, true));
    }

    /// Takes over an angle. Two that differ contradict each other, unless the word may mean another angle.
    pub(super) fn say_angle(&mut self, key: Key, word: &str, angle: Said<Angle>) {
        let known = match key {
            Key::LeftAngle => &mut self.left,
            Key::RightAngle => &mut self.right,
            _ => &mut self.angle,
        };
        match known {
            Some(first) if first.value != angle.value && key == Key::Angle && is_vague(word) => {
                self.note(angle.span, say!("`{}` is not carried over", word));
            }
            Some(first) if first.value != angle.value => {
                let first = first.span.clone();
                self.contradict(first, angle.span);
            }
            _ => *known = Some(angle),
        }
    }

    /// Refuses the system, because two statements contradict each other.
    pub(super) fn contradict(&mut self, first: Range<usize>, second: Range<usize>) {
        self.refuse(first, say!("Two statements contradict each other"));
        self.refuse(second, say!("Two statements contradict each other"));
    }

    /// Leaves out rules, with a remark.
    pub(super) fn leave_out(&mut self, why: &str, is_left_out: impl FnMut(&mut Rule) -> bool) {
        let left_out: Vec<Rule> = self.rules.extract_if(.., is_left_out).collect();
        left_out.into_iter().for_each(|rule| self.note(rule.span, said(why)));
    }

    /// Keeps one rule of each symbol, as programs do that know no chance.
    pub(super) fn keep_one(&mut self, is_last: bool) {
        let mut kept: HashMap<String, usize> = HashMap::new();
        for (at, rule) in self.rules.iter().enumerate() {
            let place = kept.entry(rule.from.clone()).or_insert(at);
            *place = if is_last { at } else { *place };
        }
        let mut at = 0..;
        let why = if is_last { REPLACED } else { EARLIER };
        self.leave_out(why, |rule| at.next() != kept.get(&rule.from).copied());
    }

    /// The actions of a symbol; a later statement counts.
    pub(super) fn mean(&mut self, symbol: char, actions: impl Into<String>, span: Range<usize>) {
        if !self.meant.insert(symbol) {
            self.meanings.retain(|(known, _)| *known != symbol);
        }
        self.meanings.push((symbol, Said::new(actions.into(), span)));
    }

    /// The system.
    pub(super) fn assemble<'a>(self, source: Source<'a>, comments: &[Range<usize>]) -> Draft<'a> {
        let mut draft = Draft::new(source, &self.name, source.line_of(self.start));
        for extent in &self.extents {
            draft.covers(extent.clone());
            let from = comments.partition_point(|comment| comment.start < extent.start);
            for comment in comments[from..].iter().take_while(|comment| comment.start < extent.end) {
                draft.pass(comment.clone());
            }
        }
        for comment in &self.comments {
            draft.pass(comment.clone());
        }
        Assembly { said: self, draft, grammar: Grammar::default() }.finish()
    }
}

/// The remark on a system without an angle.
pub(super) const NO_ANGLE: &str = word!("The text gives no angle; 90 degrees is chosen");

/// Why a rule of a symbol with several ones is left out.
pub(super) const REPLACED: &str = word!("A later rule for the same symbol replaces this one");
pub(super) const EARLIER: &str = word!("An earlier rule for the same symbol counts");

/// Symbols that the field uses in space.
const IN_SPACE: [char; 4] = ['&', '^', '\\', '/'];

struct Assembly<'a> {
    said: Statements,
    draft: Draft<'a>,
    grammar: Grammar,
}

impl<'a> Assembly<'a> {
    fn finish(mut self) -> Draft<'a> {
        for (span, why, refused) in core::mem::take(&mut self.said.remarks) {
            if refused { self.draft.refuse_at(span, why) } else { self.draft.note_at(span, why) }
        }
        for name in core::mem::take(&mut self.said.names) {
            self.draft.read(name.span, say!("name {}", name.value));
        }
        shared_angle(&mut self.said);
        shared_length(&mut self.said);
        let Some(axiom) = self.said.axiom.take() else {
            self.draft.refuse(self.draft.line, "", say!("There is no axiom"));
            return self.draft;
        };
        self.weights();
        let is_plain = self.said.lines.is_empty()
            && self.said.images.is_empty()
            && !axiom.value.contains(['(', ')'])
            && self.said.rules.iter().all(|rule| !rule.from.contains(['(', ':']) && !rule.to.contains(['(', ')']));
        if is_plain || !self.notation(&axiom) {
            self.plain(&axiom);
        }
        self.numbers();
        self.meanings();
        if self.draft.definition.rules.is_empty() && self.draft.definition.axiom.is_empty() {
            let grammar = core::mem::take(&mut self.grammar);
            self.draft.grammar(&grammar);
        }
        self.draft
    }

    /// Several rules of one symbol are alternatives.
    fn weights(&mut self) {
        let mut counts: HashMap<&str, usize> = HashMap::new();
        self.said.rules.iter().for_each(|rule| *counts.entry(&rule.from).or_default() += 1);
        let repeated: Vec<bool> = self.said.rules.iter().map(|rule| counts[&*rule.from] > 1).collect();
        for (rule, repeated) in self.said.rules.iter_mut().zip(repeated) {
            if repeated && rule.weight.is_none() && !rule.from.contains(':') {
                rule.weight = Some(1.0);
                let symbol = &rule.from;
                self.draft.note_at(
                    rule.span.clone(),
                    say!("`{}` has several rules; each is as likely as the others", symbol),
                );
            }
        }
    }

    /// Reads the words in our notation, with parameters, conditions and contexts; whether that succeeds.
    fn notation(&mut self, axiom: &Said<String>) -> bool {
        let mut lines: Vec<String> = self.said.lines.iter().map(|line| line.value.clone()).collect();
        for rule in &self.said.rules {
            let weight = rule.weight.map_or(String::new(), |weight| format!(" : {}", number(weight)));
            let to = if rule.to.trim().is_empty() { "*" } else { rule.to.trim() };
            lines.push(format!("{} -> {to}{weight}", rule.from.trim()));
        }
        if !self.said.images.is_empty() {
            lines.push("draw:".to_owned());
            lines.extend(self.said.images.iter().map(|line| line.value.clone()));
        }
        let text = lines.join("\n");
        let (grammar, problems) = parse(&axiom.value, &text);
        if problems.iter().any(lsystem_syntax::Diagnostic::is_error) {
            return false;
        }
        self.draft.definition.axiom.clone_from(&axiom.value);
        self.draft.definition.rules = text;
        self.draft.read(axiom.span.clone(), say!("axiom {}", axiom.value));
        for rule in &self.said.rules {
            self.draft.read(rule.span.clone(), format!("{} -> {}", rule.from.trim(), rule.to.trim()));
        }
        for line in self.said.lines.iter().chain(&self.said.images) {
            self.draft.read(line.span.clone(), line.value.clone());
        }
        self.grammar = grammar;
        true
    }

    /// Reads the words as plain symbols.
    fn plain(&mut self, axiom: &Said<String>) {
        self.grammar = Grammar { axiom: word(&axiom.value), ..Grammar::default() };
        self.draft.read(axiom.span.clone(), say!("axiom {}", shown(&axiom.value)));
        for line in core::mem::take(&mut self.said.lines) {
            self.draft.refuse_at(line.span, say!("This cannot be read together with the rules"));
        }
        for rule in core::mem::take(&mut self.said.rules) {
            self.production(&rule);
        }
    }

    fn production(&mut self, rule: &Rule) {
        let from: String = rule.from.chars().filter(|c| !c.is_whitespace()).collect();
        if rule.from.contains('(') || rule.to.contains('(') {
            let why = say!("This has parentheses, and cannot be read as a word with parameters");
            return self.draft.refuse_at(rule.span.clone(), why);
        }
        let [left, strict, right] = sides(&from);
        let mut letters = strict.chars();
        let (Some(letter), None) = (letters.next(), letters.next()) else {
            return self.draft.refuse_at(rule.span.clone(), say!("The left side of a rule must be one symbol"));
        };
        let mut made = Production::new(look_alike(letter).unwrap_or(letter), word(&rule.to));
        let patterns =
            |word: &str| word.chars().map(|symbol| Pattern { symbol, parameters: Vec::new() }).collect::<Vec<_>>();
        (made.left, made.right) = (patterns(left), patterns(right));
        match rule.weight {
            Some(0.0) => return,
            Some(p) if p.is_finite() && p > 0.0 => made.weight = Some(Expr::Number(p)),
            Some(_) => {
                return self.draft.refuse_at(rule.span.clone(), say!("The weight of a random choice must be positive"));
            }
            None => {}
        }
        self.draft.read(rule.span.clone(), format!("{from} -> {}", shown(&rule.to)));
        self.grammar.productions.push(made);
    }

    fn numbers(&mut self) {
        let (angle, left, right) = (self.said.angle.take(), self.said.left.take(), self.said.right.take());
        let symbols = self.symbols();
        let turns = |symbol: char| symbols.contains(&symbol);
        match (angle.or(left.clone()), right) {
            (Some(angle), right) => {
                if let Some(degrees) = self.degrees(&angle, word!("angle {}")) {
                    self.draft.definition.angle = degrees;
                }
                if let Some(left) = left.and_then(|left| self.degrees(&left, word!("left angle {}"))) {
                    self.draft.definition.angle = left;
                }
                if let Some(right) = right.and_then(|right| self.degrees(&right, word!("right angle {}")))
                    && right != self.draft.definition.angle
                {
                    self.draft.definition.right_angle = Some(right);
                }
            }
            (None, Some(right)) => {
                if let Some(degrees) = self.degrees(&right, word!("angle {}")) {
                    self.draft.definition.angle = degrees;
                }
            }
            (None, None) => {
                self.draft.definition.angle = 90.0;
                // An angle that every turn has of its own is not missing.
                let own = |symbol: char| {
                    self.said.meanings.iter().any(|(known, words)| *known == symbol && !needs_angle(&words.value))
                };
                if ['+', '-', '&', '^', '/', '\\'].into_iter().any(|symbol| turns(symbol) && !own(symbol)) {
                    self.draft.note(self.draft.line, "", said(NO_ANGLE));
                }
            }
        }
        if let Some(heading) = self.said.heading.take() {
            self.draft.definition.heading = heading.value;
            self.draft.read(heading.span, say!("heading {}", number(heading.value)));
        }
        if let Some(iterations) = self.said.iterations.take() {
            let line = self.draft.source.line_of(iterations.span.start);
            self.draft.iterations(line, &iterations.value);
            if self.draft.has_iterations {
                let n = self.draft.definition.iterations;
                self.draft.read(iterations.span, counted!(n, "{} iteration", "{} iterations"));
            }
        }
    }

    fn degrees(&mut self, angle: &Said<Angle>, what: &str) -> Option<f64> {
        let degrees = match angle.value {
            Angle::Degrees(degrees) => degrees,
            Angle::Radians(radians) => tidy(radians.to_degrees()),
            Angle::Unknown(value) => match by_value(value) {
                Ok((degrees, true)) => {
                    self.draft.note_at(angle.span.clone(), say!("This angle is read as radians"));
                    degrees
                }
                Ok((degrees, false)) => degrees,
                Err(NoAngle::Unclear | NoAngle::NoNumber) => {
                    let why = say!("This angle may be meant in degrees or in radians; the text does not say which");
                    self.draft.refuse_at(angle.span.clone(), why);
                    return None;
                }
            },
        };
        self.draft.read(angle.span.clone(), say!(what, number(degrees)));
        Some(degrees)
    }

    /// The symbols of the axiom and of all successors, sorted, each once.
    fn symbols(&self) -> Vec<char> {
        let images = self.grammar.images.iter().flat_map(|image| &image.successor);
        lsystem_base::sorted::set(self.grammar.made().chain(images).map(|module| module.symbol))
    }

    fn meanings(&mut self) {
        let symbols = self.symbols();
        let line = self.draft.line;
        let mut said = core::mem::take(&mut self.said.meanings);
        let letters = |c: &char| c.is_alphabetic() || c.is_numeric();
        let has = |said: &[(char, Said<String>)], symbol: char, word: &str| {
            said.iter().any(|(known, words)| *known == symbol && words.value.contains(word))
        };
        // A program that only moves shows its way by other means, such as objects.
        let is_shown =
            |symbol: &char| has(&said, *symbol, "draw") || "FG".contains(*symbol) && !has(&said, *symbol, "move");
        if self.said.symbols == Symbols::Program && !symbols.iter().any(is_shown) {
            let moves = said.iter_mut().filter(|(_, words)| words.value == "move");
            moves.for_each(|(_, words)| words.value = "draw".to_owned());
        }
        let is_said = |symbol: char| said.iter().any(|(known, _)| *known == symbol);
        let draws = symbols.iter().any(|symbol| has(&said, *symbol, "draw"));
        match self.said.symbols {
            Symbols::Said => self.draft.others = Some(""),
            Symbols::Usual => {
                if !draws && !symbols.iter().any(|c| matches!(c, 'F' | 'G')) {
                    let free: Vec<char> = symbols.iter().copied().filter(|c| letters(c) && !is_said(*c)).collect();
                    if !free.is_empty() {
                        self.draft.note(line, "", say!("No symbol is said to draw, so every letter draws"));
                    }
                    free.into_iter().for_each(|letter| self.draft.meaning(letter, "draw"));
                } else if draws {
                    // Letters that the text leaves out, beside those that it explains, do nothing.
                    let left_out =
                        symbols.iter().copied().filter(|c| letters(c) && !is_said(*c) && *c != 'F' && *c != 'f');
                    left_out.for_each(|letter| self.draft.meaning(letter, ""));
                }
            }
            Symbols::Program => self.program(
                &symbols,
                &said.iter().map(|(symbol, words)| (*symbol, &*words.value)).collect::<Vec<_>>(),
                draws,
            ),
        }
        if let Some(factor) = self.said.factor.take() {
            let inverse = number(1.0 / factor.value);
            if !symbols.iter().any(|symbol| matches!(symbol, '<' | '>')) {
                self.draft.note_at(factor.span, say!("This is not carried over"));
            } else if factor.value > 0.0 && factor.value.is_finite() {
                self.draft.read(factor.span, say!("length times {}", number(factor.value)));
                self.draft.meaning('>', format!("length times {}", number(factor.value)));
                self.draft.meaning('<', format!("length times {inverse}"));
            } else {
                self.draft.refuse_at(factor.span, say!("The length factor must be positive"));
            }
        }
        for (symbol, words) in said {
            let became = if words.value.is_empty() { "nothing" } else { &words.value };
            self.draft.read(words.span.clone(), format!("{symbol}: {became}"));
            self.draft.meaning(symbol, words.value);
        }
    }

    /// Whether a turn follows a symbol in its branch, so that an exchange of left and right would matter.
    fn turns_behind(&self, symbol: char) -> bool {
        let words = self.grammar.productions.iter().map(|production| &production.successor);
        words.chain([&self.grammar.axiom]).any(|word| {
            let mut depth = 0_i32;
            let mut seen: Option<i32> = None;
            word.iter().any(|module| {
                match module.symbol {
                    '[' => depth += 1,
                    ']' => {
                        depth -= 1;
                        seen = seen.filter(|level| depth >= *level);
                    }
                    own if own == symbol => seen = seen.or(Some(depth)),
                    '+' | '-' => return seen.is_some(),
                    _ => {}
                }
                false
            })
        })
    }

    /// The symbols of a program that is not known.
    fn program(&mut self, symbols: &[char], said: &[(char, &str)], draws: bool) {
        let line = self.draft.line;
        let is_said = |symbol: char| said.iter().any(|(known, _)| *known == symbol);
        let free = |symbol: &char| !is_said(*symbol);
        let usual = symbols.iter().any(|c| matches!(c, 'F' | 'G'));
        if usual || draws {
            if symbols.iter().any(|c| "FGf+-|".contains(*c) && free(c)) {
                let why = say!("The text does not say what symbols do; here F and G draw, f moves, + turns left");
                self.draft.note(line, "", why);
            }
            self.draft.others = Some("");
            let is_left = |symbol: char| {
                let (_, words) = said.iter().find(|(known, _)| *known == symbol)?;
                Some(words.starts_with("turn left")).filter(|_| words.starts_with("turn "))
            };
            for (symbol, actions) in turtle("a program") {
                // If one turn is said, the other is its opposite.
                let opposite = match (symbol, is_left('+'), is_left('-')) {
                    ('-', Some(left), _) | ('+', _, Some(left)) => Some(if left { "turn right" } else { "turn left" }),
                    _ => None,
                };
                let actions = opposite.unwrap_or(actions);
                // In a program whose letters are said, only those draw.
                if !draws || !symbol.is_alphabetic() {
                    self.draft.meaning(symbol, actions);
                }
            }
        } else {
            self.draft.note(
                line,
                "",
                say!("The text does not say what symbols do; here every letter draws, + turns left"),
            );
            self.draft.definition.dialect = Dialect::EveryLetter;
            let marks = symbols.iter().filter(|c| !c.is_alphanumeric() && !"+-[]".contains(**c));
            marks.for_each(|symbol| self.draft.meaning(*symbol, if *symbol == '|' { "turn round" } else { "" }));
        }
        let has = |symbol: char| symbols.contains(&symbol) && !is_said(symbol);
        let in_space: Vec<char> = IN_SPACE.into_iter().filter(|symbol| has(*symbol)).collect();
        let exchanged = in_space == ['&'] && said.is_empty() && self.turns_behind('&');
        if exchanged {
            let why = say!("The text does not say whether `&` pitches the turtle or exchanges left and right");
            self.draft.refuse(line, "&", why);
        } else if !in_space.is_empty() {
            self.draft.note(line, "", say!("The symbols `& ^ \\ /` are read as turns in space, as in ABOP"));
            let turns = [('&', "pitch down"), ('^', "pitch up"), ('\\', "roll left"), ('/', "roll right")];
            turns
                .into_iter()
                .filter(|(symbol, _)| has(*symbol))
                .for_each(|(symbol, words)| self.draft.meaning(symbol, words));
        }
        for symbol in symbols.iter().copied().filter(|c| !c.is_alphanumeric() && !"+-|[]&^\\/".contains(*c) && has(*c))
        {
            if matches!(symbol, '<' | '>' | '(' | ')' | '@') && self.said.factor.is_none() {
                self.draft.refuse(line, &symbol.to_string(), say!("The text does not say what `{}` does", symbol));
            } else if !matches!(symbol, '<' | '>') {
                self.draft.note(line, "", say!("The text does not say what `{}` does; here it does nothing", symbol));
            }
        }
    }
}

/// Turns that all have one angle have the angle of the system.
fn shared_angle(said: &mut Statements) {
    let mut angles: Vec<&str> = Vec::new();
    for (_, words) in &said.meanings {
        for action in words.value.split(", ") {
            if let Some(degrees) = action.strip_prefix("turn left ").or_else(|| action.strip_prefix("turn right ")) {
                angles.push(degrees);
            }
        }
    }
    let Some(first) = angles.first().map(|angle| (*angle).to_owned()) else { return };
    if angles.iter().any(|angle| **angle != first) {
        return;
    }
    let Some(degrees) = decimal::read(&first) else { return };
    let span =
        said.meanings.iter().find(|(_, words)| words.value.contains(&first)).map(|(_, words)| words.span.clone());
    match &said.angle {
        None => said.angle = span.map(|span| Said::new(Angle::Degrees(degrees), span)),
        Some(known) if known.value == Angle::Degrees(degrees) => {}
        Some(_) => return,
    }
    for (_, words) in &mut said.meanings {
        for turn in ["turn left", "turn right"] {
            words.value = words.value.replace(&format!("{turn} {first}"), turn);
        }
    }
}

/// Lengths that are all equal, or that only some lines have, are the length of a step.
fn shared_length(said: &mut Statements) {
    let length = |action: &str| {
        let length = action.strip_prefix("draw").or(action.strip_prefix("move"))?.trim_start();
        (length.is_empty() || decimal::read(length).is_some()).then(|| length.to_owned())
    };
    let lengths = said.meanings.iter().flat_map(|(_, words)| words.value.split(", ")).filter_map(length);
    let lengths: HashSet<String> = lengths.collect();
    if lengths.len() > 1 && !lengths.contains("") {
        return;
    }
    for (_, words) in &mut said.meanings {
        let bare = |action: &str| if length(action).is_some() { action[..4].to_owned() } else { action.to_owned() };
        words.value = words.value.split(", ").map(bare).collect::<Vec<_>>().join(", ");
    }
}

/// Whether actions turn by the angle of the system.
fn needs_angle(words: &str) -> bool {
    words.split(',').any(|action| {
        let action = action.trim();
        ["turn left", "turn right", "pitch up", "pitch down", "roll left", "roll right"].contains(&action)
    })
}

/// The left context, the symbol and the right context of a predecessor. `*` stands for no context.
pub(super) fn sides(from: &str) -> [&str; 3] {
    let (left, rest) = match from.split_once('<') {
        Some((left, rest)) if !left.is_empty() && !rest.is_empty() => (left.trim_matches('*'), rest),
        _ => ("", from),
    };
    match rest.split_once('>') {
        Some((strict, right)) if !strict.is_empty() && !right.is_empty() => [left, strict, right.trim_matches('*')],
        _ => [left, rest, ""],
    }
}

/// A word of plain symbols. White space is left out, and typographic look-alikes are read as what they look like.
pub(super) fn word(text: &str) -> Vec<Module> {
    let plain = text.chars().map(|ch| look_alike(ch).unwrap_or(ch));
    plain.filter(|ch| !ch.is_whitespace()).map(Module::from).collect()
}

fn shown(word: &str) -> String {
    word.chars().filter(|c| !c.is_whitespace()).collect()
}
