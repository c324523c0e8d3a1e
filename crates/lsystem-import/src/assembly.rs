//! A system from statements about it: an axiom, rules, angles, meanings, each with its place.

use crate::angle::{NoAngle, by_value, tidy};
use crate::draft::Draft;
use crate::source::Source;
use core::ops::Range;
use lsystem_base::number::number;
use lsystem_base::{counted, decimal, say, word};
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symbols {
    /// The usual symbols of the field, as descriptions and books use them.
    Usual,
    /// Those of a program that is not known: the usual ones, with a remark.
    Program,
    /// Only those that are said.
    Said,
}

/// All that a text says about one system.
#[derive(Clone, Debug)]
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
        Self {
            name: name.to_owned(),
            names: Vec::new(),
            start,
            axiom: None,
            rules: Vec::new(),
            angle: None,
            left: None,
            right: None,
            heading: None,
            iterations: None,
            factor: None,
            lines: Vec::new(),
            images: Vec::new(),
            meanings: Vec::new(),
            meant: HashSet::new(),
            symbols,
            remarks: Vec::new(),
            extents: Vec::new(),
            comments: Vec::new(),
        }
    }

    pub(super) fn note(&mut self, span: Range<usize>, why: String) {
        self.remarks.push((span, why, false));
    }

    pub(super) fn refuse(&mut self, span: Range<usize>, why: String) {
        self.remarks.push((span, why, true));
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
        // `*` stands for no context.
        let (left, rest) = match from.split_once('<') {
            Some((left, rest)) if !left.is_empty() && !rest.is_empty() => (left.trim_matches('*'), rest),
            _ => ("", from.as_str()),
        };
        let (strict, right) = match rest.split_once('>') {
            Some((strict, right)) if !strict.is_empty() && !right.is_empty() => (strict, right.trim_matches('*')),
            _ => (rest, ""),
        };
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
        let said = (self.said.angle.take(), self.said.left.take(), self.said.right.take());
        let (angle, left, right) = said;
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
                    self.draft.note(self.draft.line, "", say!("The text gives no angle; 90 degrees is chosen"));
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
        let said = core::mem::take(&mut self.said.meanings);
        let is_said = |symbol: char| said.iter().any(|(known, _)| *known == symbol);
        let letters = |c: &char| c.is_alphabetic() || c.is_numeric();
        let draws = said.iter().any(|(symbol, words)| symbols.contains(symbol) && words.value.contains("draw"));
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
            let known =
                [('F', "draw"), ('G', "draw"), ('f', "move"), ('g', "move"), ('+', "turn left"), ('-', "turn right")];
            for (symbol, actions) in
                known.into_iter().chain([('|', "turn round"), ('[', "open branch"), (']', "close branch")])
            {
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

/// Whether actions turn by the angle of the system.
fn needs_angle(words: &str) -> bool {
    words.split(',').any(|action| {
        let action = action.trim();
        ["turn left", "turn right", "pitch up", "pitch down", "roll left", "roll right"].contains(&action)
    })
}

/// A word of plain symbols. White space is left out, and typographic look-alikes are read as what they look like.
pub(super) fn word(text: &str) -> Vec<Module> {
    let plain = text.chars().map(|ch| look_alike(ch).unwrap_or(ch));
    plain.filter(|ch| !ch.is_whitespace()).map(Module::from).collect()
}

fn shown(word: &str) -> String {
    word.chars().filter(|c| !c.is_whitespace()).collect()
}
