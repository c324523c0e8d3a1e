//! The lines of a text of rules: productions, constants and headings.

use super::constants::ConstantPlace;
use super::constants::Constants;
use super::expression;
use super::production::{self, ProductionLine};
use super::token::{Token, span_of, text_of, tokens};
use super::word::is_name;
use super::{Reading, arrow};
use crate::grammar::{NamedCurve, NamedShape};
use crate::notes::{DiagnosticList, excerpt, named};
use crate::{Class, Constant, Curve, Diagnostic, Expr, Meaning, Production, Role, Seen, Shape};
use core::ops::Range;
use lsystem_base::say;
use std::collections::HashMap;
use std::sync::Arc;

/// Reads all lines of `text` into `reading`. The constants serve the axiom, which is read later.
pub(crate) fn read(text: &str, reading: &mut Reading, constants: &mut Constants, notes: &mut DiagnosticList) {
    let mut rules = RulesReader { text, reading, notes, constants, productions: Vec::new(), drawing: false };
    for line in super::lines(text) {
        if super::is_comment(&text[line.clone()]) {
            rules.notes.class(Class::Comment, line);
        } else {
            rules.line(line);
        }
    }
    for line in core::mem::take(&mut rules.productions) {
        production::read(&line, rules.constants, rules.reading, rules.notes);
    }
    let Reading { grammar, productions, images, .. } = rules.reading;
    note_never_applied(&grammar.productions, productions.iter().map(|places| &places.predecessor), rules.notes);
    note_never_applied(&grammar.images, images.iter().map(|places| &places.predecessor), rules.notes);
}

struct RulesReader<'a> {
    text: &'a str,
    reading: &'a mut Reading,
    notes: &'a mut DiagnosticList,
    constants: &'a mut Constants,
    /// The lines with an arrow, read after all constants.
    productions: Vec<ProductionLine>,
    /// Whether the present line is below `draw:`.
    drawing: bool,
}

impl RulesReader<'_> {
    fn line(&mut self, line: Range<usize>) {
        let text = self.text[line.clone()].trim_start_matches(crate::characters::is_blank);
        let define = "#define";
        if let Some(rest) = text.strip_prefix(define)
            && rest.starts_with(crate::characters::is_blank)
        {
            let from = line.end - rest.len();
            self.notes.class(Class::Heading, from - define.len()..from);
            let tokens = tokens(self.text, from..line.end, self.notes);
            return self.define(&tokens, line.end);
        }
        if let Some(note) = foreign_comment(text) {
            return self.no_arrow(line.end - text.len()..line.end, Some(format!("// {note}")));
        }
        let tokens = tokens(self.text, line.clone(), self.notes);
        if self.foreign_heading(&tokens) {
            return;
        }
        if let Some((word, after)) = heading(&tokens)
            && self.heading(&word, &tokens, after, line.end)
        {
            return;
        }
        self.statement(&tokens, line.end);
    }

    /// Reads a production or a constant.
    fn statement(&mut self, tokens: &[Token], end: usize) {
        if tokens.is_empty() {
            return;
        }
        if let Some(arrow) = arrow::find(tokens) {
            self.productions.push(ProductionLine { tokens: tokens.to_vec(), arrow, end, drawing: self.drawing });
        } else if let Some(places) = super::shape::name(tokens, "shape") {
            self.shape(tokens, places, end);
        } else if let Some(places) = super::shape::name(tokens, "curve") {
            self.curve(tokens, places, end);
        } else if let Some(equals) = tokens.iter().position(|t| t.is('=')) {
            self.constant(tokens, equals, end);
        } else {
            self.no_arrow(span_of(tokens, 0), suggestion(tokens));
        }
    }

    /// Reads a heading of another program, with or without a colon. Returns whether the line was one.
    fn foreign_heading(&mut self, tokens: &[Token]) -> bool {
        let colon = tokens.iter().take(24).position(|t| t.is(':'));
        let (words, rest) = tokens.split_at(colon.unwrap_or(tokens.len()).min(24));
        if arrow::find(rest).is_some() || words.iter().any(|t| t.literal || !t.ch.is_alphabetic()) && colon.is_some() {
            return false;
        }
        let place = span_of(words, 0);
        let parts: Vec<String> =
            words.chunk_by(|_, next| next.joined).map(|word| text_of(word).to_ascii_lowercase()).collect();
        let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
        match parts[..] {
            ["homomorphism" | "interpretation"] if rest.len() <= 1 => self.drawing = true,
            ["production" | "productions" | "rules"] if rest.len() <= 1 => self.drawing = false,
            ["derivation", "length"] | ["lsystem" | "seed"] if colon.is_some() => {
                self.other_field(&parts.join(" "), place);
                return true;
            }
            ["endlsystem"] | ["axiom" | "angle" | "delta" | "start" | "initial" | "iterations", _] => {
                self.other_field(parts[0], place);
                return true;
            }
            _ => return false,
        }
        self.notes.class(Class::Heading, span_of(tokens, 0));
        true
    }

    /// Reads a line that starts with `word:`. Returns whether the word was a heading or a label.
    fn heading(&mut self, word: &str, tokens: &[Token], after: usize, end: usize) -> bool {
        let place = span_of(&tokens[..after], 0);
        match word {
            "ignore" | "consider" => {
                self.notes.class(Class::Heading, place.clone());
                self.seen(word == "consider", &tokens[after..], place);
            }
            "draw" => {
                self.notes.class(Class::Heading, place);
                self.drawing = true;
                self.statement(&tokens[after..], end);
            }
            // Labels of productions in books, as in `p1: F -> FF`.
            _ if arrow::find(&tokens[after..]).is_some() && is_label(word) => {
                self.notes.class(Class::Comment, place);
                self.statement(&tokens[after..], end);
            }
            "axiom" | "initial" | "start" | "omega" | "ω" | "angle" | "delta" | "δ" | "iterations" | "generations"
            | "depth" | "step" | "seed"
                if arrow::find(&tokens[after..]).is_none() =>
            {
                self.other_field(word, place);
            }
            _ => return false,
        }
        true
    }

    /// Reads the symbols that contexts skip, or see if `only`.
    fn seen(&mut self, only: bool, symbols: &[Token], place: Range<usize>) {
        for token in symbols.iter().filter(|t| t.is('(') || t.is(')')) {
            super::word::parenthesis_symbol(*token, self.notes);
        }
        let symbols = symbols.iter().map(|t| t.ch);
        match (&mut self.reading.grammar.seen, only) {
            (seen @ Seen::All, true) => *seen = Seen::Only(symbols.collect()),
            (seen @ Seen::All, false) => *seen = Seen::Except(symbols.collect()),
            (Seen::Only(list), true) | (Seen::Except(list), false) => list.extend(symbols),
            _ => self.notes.error(
                place,
                say!("There is `ignore:` as well as `consider:`"),
                say!("Keep one of them: `ignore:` lists what contexts skip, `consider:` all that they see."),
            ),
        }
    }

    /// Reads `#define name value`, from the name on.
    fn define(&mut self, tokens: &[Token], end: usize) {
        let name = tokens.iter().skip(1).position(|t| !t.joined).map_or(tokens.len(), |at| at + 1);
        let (name, mut value) = tokens.split_at(name);
        // `#define r = 0.9` is a common mistake.
        if let [equals, rest @ ..] = value
            && equals.is('=')
        {
            self.notes.class(Class::Mark, equals.span());
            value = rest;
        }
        self.add_constant(name, value, end);
    }

    /// Reads `name = value`.
    fn constant(&mut self, tokens: &[Token], equals: usize, end: usize) {
        let (name, value) = (&tokens[..equals], &tokens[equals + 1..]);
        let word: String = name.iter().map(|t| t.ch.to_ascii_lowercase()).collect();
        if matches!(word.as_str(), "axiom" | "initial" | "omega" | "ω") {
            return self.other_field(&word, span_of(name, end));
        }
        let call = value.iter().position(|t| t.is('(')).is_some_and(|open| {
            expression::function(&value[..open].iter().map(|t| t.ch).collect::<String>()).is_some()
        });
        let arithmetic = call || value.first().is_some_and(|t| t.ch.is_ascii_digit() || t.ch == '.' || t.ch == '(');
        let mut quiet = DiagnosticList::new(crate::Field::Rules);
        let named = is_name(name);
        let mut is_number = || expression::read(value, end, Role::Constant, self.constants, &mut quiet).is_some();
        // One module before the sign and no number after it: probably a production.
        let module = name.get(1).is_some_and(|t| t.is('(')) && name.last().is_some_and(|t| t.is(')'));
        if (name.len() == 1 || module) && !value.is_empty() && (!named || (!arithmetic && !is_number())) {
            let (left, right) = (text_of(name), text_of(value));
            let error = Diagnostic::error(say!("`=` gives a constant its value, and `{}` is not a number", right))
                .hint(say!("For a rule write `{} -> {}`.", left, right));
            return self.notes.add(tokens[equals].span(), error.fix(String::from("->")));
        }
        // Probably an arrow, as in `F := FF`.
        if !named && name.iter().skip(1).any(|t| is_mark(*t)) {
            return self.no_arrow(span_of(tokens, 0), suggestion(tokens));
        }
        self.notes.class(Class::Mark, tokens[equals].span());
        self.add_constant(name, value, end);
    }

    /// Reads `shape name = …`; the name and `=` are at these places.
    fn shape(&mut self, tokens: &[Token], places: (usize, usize), end: usize) {
        let Some((name, span)) = self.named(tokens, places, end) else { return };
        // A wrong shape is noted already. The name is defined, so that its uses are not noted too.
        let shape = super::shape::read(&tokens[places.1 + 1..], end, self.constants, self.notes);
        let shape = Arc::new(shape.unwrap_or(Shape::Ball([0.0; 4])));
        self.constants.other(name.clone(), Meaning::Shape(shape.clone()), span);
        self.reading.grammar.shapes.push(NamedShape { name, shape });
    }

    /// Reads `curve name = …`; the name and `=` are at these places.
    fn curve(&mut self, tokens: &[Token], places: (usize, usize), end: usize) {
        let Some((name, span)) = self.named(tokens, places, end) else { return };
        if expression::function(&name).is_some() {
            return self.defined_already(&name, span);
        }
        // As with shapes, the name is defined in any case.
        let curve = super::curve::read(&tokens[places.1 + 1..], end, self.constants, self.notes);
        let Some(curve) = curve.or_else(|| Curve::new(vec![[0.0; 2], [1.0; 2]])).map(Arc::new) else { return };
        self.constants.other(name.clone(), Meaning::Curve(curve.clone()), span);
        self.reading.grammar.curves.push(NamedCurve { name, curve });
    }

    /// The name in a line such as `shape name = …`, with its span; `None` if it is wrong or taken, which is noted.
    fn named(
        &mut self,
        tokens: &[Token],
        (name, equals): (usize, usize),
        end: usize,
    ) -> Option<(String, Range<usize>)> {
        self.notes.class(Class::Heading, span_of(&tokens[..name], end));
        self.notes.class(Class::Mark, tokens[equals].span());
        let words = &tokens[name..equals];
        let (span, text): (_, String) = (span_of(words, end), words.iter().map(|t| t.ch).collect());
        if !is_name(words) || expression::is_reserved(&text) {
            self.constant_name(&text_of(words), span);
            return None;
        }
        if self.constants.contains(&text) {
            self.defined_already(&text, span);
            return None;
        }
        self.notes.class(Class::Constant, span.clone());
        Some((text, span))
    }

    fn no_arrow(&mut self, span: Range<usize>, suggestion: Option<String>) {
        let hint = match &suggestion {
            Some(production) => say!("Write `{}`.", production),
            None => say!("Write a rule as `F -> FF`, a constant as `r = 0.9`, a comment after `//`."),
        };
        let error = Diagnostic::error(say!("This line is neither a rule nor a constant")).hint(hint);
        self.notes.add(span, error.fix(suggestion));
    }

    /// Notes `axiom: F` or `angle: 25` among the productions.
    fn other_field(&mut self, word: &str, place: Range<usize>) {
        let hint = match word {
            "endlsystem" | "lsystem" | "seed" => say!("Leave this line out."),
            "axiom" | "initial" | "start" | "omega" | "ω" => say!("The axiom has a field of its own."),
            "angle" | "delta" | "δ" => say!("The angle has a field of its own."),
            _ => say!("The axiom, the angle and the number of iterations have fields of their own."),
        };
        self.notes.error(place, say!("`{}` does not belong among the rules", word), hint);
    }

    fn defined_already(&mut self, name: &str, span: Range<usize>) {
        self.notes.error(span, say!("`{}` is defined already", excerpt(name)), say!("Give one of them another name."));
    }

    fn constant_name(&mut self, text: &str, span: Range<usize>) {
        if text.is_empty() {
            return self.notes.error(span, say!("The constant has no name"), say!("Write it as `r = 0.9`."));
        }
        self.notes.error(
            span,
            say!("`{}` cannot be the name of a constant", text),
            say!("A name is a letter followed by letters, digits or `_`; a rule needs an arrow, as in `F -> FF`."),
        );
    }

    fn add_constant(&mut self, name: &[Token], value: &[Token], end: usize) {
        let span = span_of(name, value.first().map_or(end, |t| t.span().start));
        let text: String = name.iter().map(|t| t.ch).collect();
        if !is_name(name) || expression::is_reserved(&text) {
            return self.constant_name(&text_of(name), span);
        }
        self.notes.class(Class::Constant, span_of(name, end));
        let (name, text, place) = (text, text_of(value), span_of(value, end));
        let expr = expression::read(value, end, Role::Constant, self.constants, self.notes);
        if self.constants.contains(&name) {
            return self.defined_already(&name, span);
        }
        let is_number = matches!(expr, Some(Expr::Number(_))) && !value.iter().any(|t| t.is('('));
        // A wrong value is noted already. The name is defined, so that its uses are not noted too.
        let value = match expr.map(|expr| expression::code(&expr, self.constants)) {
            Some(Ok(crate::Code::Constant(value))) => Some(value),
            _ => None,
        };
        let value =
            self.constants.define(ConstantPlace { name: name.clone(), value, span: place, is_number }, text, span);
        self.reading.grammar.constants.push(Constant { name, value });
    }
}

/// Notes productions that never apply because of an earlier production with the same predecessor and contexts.
fn note_never_applied<'a>(
    productions: &[Production],
    places: impl Iterator<Item = &'a Range<usize>>,
    notes: &mut DiagnosticList,
) {
    // The first production for each key.
    let mut firsts: HashMap<String, usize> = HashMap::new();
    for (at, (production, place)) in productions.iter().zip(places).enumerate() {
        let weighted = production.weight.is_some();
        let always = key(production, false);
        let own = key(production, true);
        let first = firsts.get(&always).or_else(|| firsts.get(&own)).map(|&first| productions[first].weight.is_some());
        let name = || named(production.predecessor.symbol);
        let (message, hint) = match (first, weighted) {
            (None, _) => {
                firsts.insert(if production.condition.is_some() { own } else { always }, at);
                continue;
            }
            (Some(true), true) => continue,
            (Some(false), false) => {
                let hint = if production.condition.is_some() && firsts.contains_key(&always) {
                    say!("Move it above the one without a condition.")
                } else {
                    say!("Give both a weight to choose between them at random, as in `F -> FF : 0.5`.")
                };
                (say!("This rule never applies: there is one for {} above", name()), hint)
            }
            (Some(first), _) => {
                let message = if first {
                    say!("This rule never applies: the first one for {} has a weight", name())
                } else {
                    say!("This rule never applies: the first one for {} has no weight", name())
                };
                (message, say!("Give all rules for {} a weight, or none.", name()))
            }
        };
        notes.warn(place.clone(), message, hint);
    }
}

/// The part of a production that decides where it applies: contexts and predecessor, and if `conditional` also the
/// names of parameters and the condition.
fn key(production: &Production, conditional: bool) -> String {
    let mut key = String::new();
    for (at, patterns) in
        [&production.left[..], core::slice::from_ref(&production.predecessor), &production.right].iter().enumerate()
    {
        key.push(['\u{1}', '\u{2}', '\u{3}'][at]);
        for pattern in *patterns {
            key.push(pattern.symbol);
            key.push(char::from(b'0' + pattern.parameters.len().min(9) as u8));
            if conditional {
                key.push_str(&pattern.parameters.join(","));
            }
        }
    }
    if let Some(condition) = production.condition.as_ref().filter(|_| conditional) {
        key.push_str(&condition.to_string());
    }
    key
}

/// The word before a colon at the start of a line, in lower case, and the number of tokens up to the colon. A `#` may
/// stand before the word.
fn heading(tokens: &[Token]) -> Option<(String, usize)> {
    let from = usize::from(tokens.first()?.is('#'));
    let colon = tokens.iter().take(16).position(|t| t.is(':'))?;
    let word = tokens.get(from..colon)?;
    is_name(word).then(|| (word.iter().map(|t| t.ch.to_ascii_lowercase()).collect(), colon + 1))
}

/// The text of a line that is a comment in other notations, after `;`, `--` or `%`. A line with an arrow is none.
fn foreign_comment(line: &str) -> Option<&str> {
    let note = line.strip_prefix("--").or_else(|| line.strip_prefix([';', '%']))?;
    let arrow = ["->", "=>", "→"].iter().any(|arrow| note.contains(arrow));
    (!arrow && note.contains(char::is_alphabetic)).then(|| note.trim())
}

/// Whether a word is the label of a production: two characters or more, the last a digit. A predecessor has only one
/// character.
fn is_label(word: &str) -> bool {
    word.chars().nth(1).is_some() && word.ends_with(char::is_numeric)
}

/// Whether a character may be part of a mistyped arrow.
fn is_mark(token: Token) -> bool {
    !token.literal && matches!(token.ch, ':' | '-' | '>' | '<' | '~' | '|' | '=')
}

/// `tokens` with an arrow in place of a mistyped or missing one, or as a constant for `r := 0.9`.
fn suggestion(tokens: &[Token]) -> Option<String> {
    let tokens = match tokens {
        // A pair of a JSON object, without its braces.
        [open, symbol, close, rest @ ..]
            if is_quote(*open) && close.is(open.ch) && rest.first().is_some_and(|t| t.is(':')) =>
        {
            &[&[*symbol], rest].concat()[..]
        }
        tokens => tokens,
    };
    let [first, rest @ ..] = tokens else { return None };
    if let Some(equals) = last_equals(tokens) {
        let [left, right] = [&tokens[..equals], &tokens[equals + 1..]].map(text_of);
        return Some(format!("{left} -> {right}"));
    }
    let marks = rest.iter().take_while(|t| is_mark(**t)).count();
    let word = unwrapped(&rest[marks..]);
    let apart = rest.first().is_some_and(|t| !t.joined);
    // `r := 0.9`
    let number = word.first().is_some_and(|t| t.ch.is_ascii_digit() || t.is('.'));
    if number && is_name(&tokens[..1]) && rest[..marks].iter().any(|t| t.is('=')) {
        return Some(format!("{} = {}", first.ch, text_of(word)));
    }
    let words = if marks == 0 && apart { link_words(word) } else { 0 };
    let word = &word[words..];
    (!word.is_empty() && (marks > 0 || apart)).then(|| format!("{} -> {}", first.ch, text_of(word)))
}

fn is_quote(token: Token) -> bool {
    token.is('"') || token.is('\'')
}

/// A word without quotes around it and without a comma behind.
fn unwrapped(word: &[Token]) -> &[Token] {
    let word = match word {
        [inside @ .., comma] if comma.is(',') => inside,
        word => word,
    };
    match word {
        [first, inside @ .., last] if is_quote(*first) && last.is(first.ch) => inside,
        word => word,
    }
}

/// The number of tokens at the start that are English words between a predecessor and a successor, as in `F is replaced
/// by FF`.
fn link_words(tokens: &[Token]) -> usize {
    const WORDS: [&str; 16] = [
        "to", "into", "is", "are", "replaced", "by", "with", "becomes", "become", "maps", "goes", "turns", "produces",
        "yields", "gives", "rewrites",
    ];
    let words = tokens.chunk_by(|_, next| next.joined);
    words.take_while(|word| WORDS.contains(&text_of(word).to_ascii_lowercase().as_str())).map(<[Token]>::len).sum()
}

/// The last `=` outside parentheses that is no part of a comparison, if something stands on both sides: the arrow of
/// other programs, as in `A(i):i<=3=FA(i+1)`.
fn last_equals(tokens: &[Token]) -> Option<usize> {
    let is = |at: Option<usize>, marks: [char; 4]| {
        at.and_then(|at| tokens.get(at)).is_some_and(|t| marks.iter().any(|&mark| t.is(mark)))
    };
    let mut depth = 0_usize;
    let mut found = None;
    for (at, token) in tokens.iter().enumerate() {
        depth = (depth + usize::from(token.is('('))).saturating_sub(usize::from(token.is(')')));
        let compares = is(at.checked_sub(1), ['<', '>', '=', '!']) || is(Some(at + 1), ['=', '>', '<', '=']);
        if depth == 0 && token.is('=') && !compares && !is(at.checked_sub(1), [':', '~', '|', '-']) {
            found = Some(at);
        }
    }
    found.filter(|&at| at > 1 && at + 1 < tokens.len())
}
