//! Words: axioms, successors, predecessors and contexts.

use super::arrow;
use super::expression::{self, Names};
use super::token::{Token, span_of, text_of};
use crate::notes::DiagnosticList;
use crate::{Class, Diagnostic, Expr, Module, Pattern, Role};
use core::ops::Range;
use lsystem_base::{LimitName, MAX_PARAMETERS, say};

/// The modules of a word, and each module's span in the text, in bytes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SpannedWord {
    pub(crate) modules: Vec<Module>,
    pub(crate) spans: Vec<Range<usize>>,
}

/// Reads an axiom or a successor; `role` is the role of its arguments. `*` or `ε` alone is the empty word. A separate
/// arrow is noted.
pub(crate) fn word(tokens: &[Token], role: Role, names: &mut dyn Names, notes: &mut DiagnosticList) -> SpannedWord {
    let mut word = SpannedWord::default();
    if is_empty(tokens) {
        return word;
    }
    if role == Role::Axiom {
        note_wrapping(tokens, notes);
    }
    if let Some(arrow) = stray_arrow(tokens) {
        let (message, hint) = match role {
            Role::Axiom => (say!("There is an arrow in the axiom"), say!("Rules belong below the axiom, not in it.")),
            _ => (say!("There is a second arrow in this line"), say!("Write each rule on a line of its own.")),
        };
        notes.error(arrow, message, hint);
    }
    for_each_module(tokens, notes, |notes, token, inside, span| {
        if !token.literal {
            notes.class(Class::of_symbol(token.ch), token.span());
        }
        let arguments = inside.map_or(Vec::new(), |inside| {
            if is_branch(inside, names) {
                let inside = text_of(inside);
                let error = Diagnostic::error(say!("Parentheses hold numbers, not symbols"))
                    .hint(say!("A branch stands in brackets: write `[{}]`.", inside));
                notes.add(token.span().end..span.end, error.fix(format!("[{inside}]")));
                return Vec::new();
            }
            arguments(inside, &span, role, names, notes)
        });
        word.modules.push(Module { symbol: token.ch, arguments });
        word.spans.push(span);
    });
    word
}

/// Reads a context or a predecessor: symbols with the names of their parameters. `*` or `ε` alone is the empty
/// context.
pub(crate) fn patterns(tokens: &[Token], notes: &mut DiagnosticList) -> (Vec<Pattern>, Vec<Range<usize>>) {
    let (mut patterns, mut spans) = (Vec::new(), Vec::new());
    for_each_module(tokens, notes, |notes, token, inside, span| {
        let parameters = inside.map_or(Vec::new(), |inside| parameters(inside, &span, notes));
        patterns.push(Pattern { symbol: token.ch, parameters });
        spans.push(span);
    });
    (patterns, spans)
}

/// Notes quotes around a word, and a comma behind it, which are read as symbols.
pub(crate) fn note_wrapping(tokens: &[Token], notes: &mut DiagnosticList) {
    let [inside @ .., last] = tokens else { return };
    let comma = last.is(',') && !inside.is_empty();
    let quoted = if comma { inside } else { tokens };
    match quoted {
        [first, inside @ .., last]
            if matches!(first.ch, '"' | '\'') && !first.literal && last.is(first.ch) && !inside.is_empty() =>
        {
            let inside = text_of(inside);
            let warning = Diagnostic::warning(say!("These quotes are read as symbols"))
                .hint(say!("Strings need no quotes: write `{}`.", inside));
            notes.add(span_of(tokens, 0), warning.fix(inside));
        }
        _ if comma => {
            let warning = Diagnostic::warning(say!("This comma is read as a symbol"))
                .hint(say!("Lines need no comma at the end."));
            notes.add(last.span(), warning.fix(String::new()));
        }
        _ => {}
    }
}

/// Whether the tokens are the empty word or context.
pub(crate) fn is_empty(tokens: &[Token]) -> bool {
    matches!(tokens, [] | [Token { ch: '*' | 'ε', literal: false, .. }])
}

/// Calls `module` for each symbol with the tokens in the parentheses directly after it, and the span of both.
fn for_each_module(
    tokens: &[Token],
    notes: &mut DiagnosticList,
    mut module: impl FnMut(&mut DiagnosticList, Token, Option<&[Token]>, Range<usize>),
) {
    let mut at = 0;
    while let Some(&token) = tokens.get(at) {
        at += 1;
        if token.is('(') || token.is(')') {
            parenthesis_symbol(token, notes);
        }
        let Some(open) = tokens.get(at).filter(|t| t.is('(') && t.joined) else {
            module(notes, token, None, token.span());
            continue;
        };
        let Some(length) = closing(&tokens[at..]) else {
            return notes.error(
                open.span(),
                say!("This `(` is never closed"),
                say!("Add `)`, or write `(` in backquotes to use it as a symbol."),
            );
        };
        let inside = &tokens[at + 1..at + length];
        at += length + 1;
        module(notes, token, Some(inside), token.span().start..tokens[at - 1].span().end);
    }
}

/// Warns of a parenthesis that does not directly follow a symbol.
pub(super) fn parenthesis_symbol(token: Token, notes: &mut DiagnosticList) {
    notes.warn(
        token.span(),
        say!("`{}` is read as a symbol here", token.ch),
        say!(
            "Arguments follow their symbol without a space; write the parenthesis in backquotes if a symbol is meant."
        ),
    );
}

/// The parts of `inside` between commas, except commas in parentheses, and the end of each part in bytes.
pub(super) fn parts(inside: &[Token]) -> impl Iterator<Item = (&[Token], usize)> {
    let mut depth = 0_usize;
    let mut at = 0;
    let parts = inside.split(move |t| {
        depth = (depth + usize::from(t.is('('))).saturating_sub(usize::from(t.is(')')));
        depth == 0 && t.is(',')
    });
    parts.map(move |part| {
        let end = match (part.last(), inside.get(at)) {
            (Some(last), _) => last.span().end,
            (None, Some(comma)) => comma.span().start,
            (None, None) => inside.last().map_or(0, |comma| comma.span().end),
        };
        at += part.len() + 1;
        (part, end)
    })
}

/// Whether there are 1 to [`MAX_PARAMETERS`] parts; noted otherwise.
fn is_countable(inside: &[Token], span: &Range<usize>, notes: &mut DiagnosticList) -> bool {
    if inside.is_empty() {
        notes.error(
            span.clone(),
            say!("There is nothing between these parentheses"),
            say!("Leave them out, or write arguments."),
        );
        return false;
    }
    let fits = parts(inside).count() <= MAX_PARAMETERS;
    if !fits {
        notes.add(span.clone(), Diagnostic::limit(LimitName::Parameters, MAX_PARAMETERS as u64, None));
    }
    fits
}

fn arguments(
    inside: &[Token],
    span: &Range<usize>,
    role: Role,
    names: &mut dyn Names,
    notes: &mut DiagnosticList,
) -> Vec<Expr> {
    if !is_countable(inside, span, notes) {
        return Vec::new();
    }
    parts(inside)
        // A wrong argument is noted, and replaced so that the number of arguments stays right.
        .map(|(part, end)| expression::read(part, end, role, names, notes).unwrap_or(Expr::Number(0.0)))
        .collect()
}

/// Whether the tokens in parentheses are symbols with turns, such as `+F`, and not arithmetic.
fn is_branch(inside: &[Token], names: &mut dyn Names) -> bool {
    let is_letter = |t: &Token| !t.literal && t.ch.is_ascii_alphabetic();
    let is_turn = |t: &Token| !t.literal && Class::of_symbol(t.ch) != Class::Plain;
    let single = inside
        .chunk_by(|a, b| is_letter(a) == is_letter(b))
        .all(|part| !is_letter(&part[0]) || part.iter().all(|t| t.ch.is_ascii_uppercase()));
    single
        && inside.iter().all(|t| is_letter(t) || is_turn(t))
        && inside.iter().any(is_turn)
        && inside.chunk_by(|a, b| is_letter(a) == is_letter(b)).any(|part| {
            let mut unknown = |name: String| names.meaning(&name).is_none();
            is_letter(&part[0])
                && unknown(part.iter().map(|t| t.ch).collect())
                && part.iter().any(|t| unknown(t.ch.to_string()))
        })
}

fn parameters(inside: &[Token], span: &Range<usize>, notes: &mut DiagnosticList) -> Vec<String> {
    if !is_countable(inside, span, notes) {
        return Vec::new();
    }
    parts(inside)
        .map(|(part, end)| {
            let name: String = part.iter().map(|t| t.ch).collect();
            notes.class(Class::Parameter, span_of(part, end));
            if !is_name(part) || expression::is_reserved(&name) {
                parameter_name(&text_of(part), span_of(part, end), notes);
            }
            name
        })
        .collect()
}

/// Notes a text in place of a parameter's name.
fn parameter_name(text: &str, span: Range<usize>, notes: &mut DiagnosticList) {
    let hint = match text.chars().next() {
        Some(first) if first.is_alphabetic() => {
            say!("Before the arrow parentheses hold names only, as in `A(l, w)`; compute after the arrow.")
        }
        Some(_) => say!("Write a name and a condition, as in `A(x) : x == {} -> ...`.", text),
        None => say!("Write a name, as in `A(l, w)`."),
    };
    notes.error(span, say!("`{}` cannot be the name of a parameter", text), hint);
}

/// The index of the `)` that closes the `(` at the start of `tokens`.
pub(super) fn closing(tokens: &[Token]) -> Option<usize> {
    let mut depth = 0_usize;
    tokens.iter().position(|t| {
        depth += usize::from(t.is('('));
        depth -= usize::from(t.is(')'));
        depth == 0
    })
}

/// An arrow that cannot be meant as symbols: with white space on both sides, or `→`.
fn stray_arrow(tokens: &[Token]) -> Option<Range<usize>> {
    let mut at = 0;
    while at < tokens.len() {
        let Some(length) = arrow::length(&tokens[at..]) else {
            at += 1;
            continue;
        };
        let apart = !tokens[at].joined && at > 0 && tokens.get(at + length).is_some_and(|t| !t.joined);
        if apart || tokens[at].is('→') {
            return Some(span_of(&tokens[at..at + length], 0));
        }
        at += length;
    }
    None
}

/// Whether the tokens are a name: a letter or `_`, then letters, digits or `_`, without spaces.
pub(super) fn is_name(tokens: &[Token]) -> bool {
    match tokens {
        [first, rest @ ..] => {
            !first.literal
                && expression::is_name_start(first.ch)
                && rest.iter().all(|t| t.joined && !t.literal && expression::is_name_part(t.ch))
        }
        [] => false,
    }
}
