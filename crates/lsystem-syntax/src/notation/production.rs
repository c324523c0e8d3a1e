//! Reading one production: contexts, predecessor, condition, successor, weight.

use super::constants::{Constants, Scope};
use super::expression;
use super::token::{Token, span_of, text_of};
use super::word::{is_empty, patterns, word};
use super::{Places, Reading};
use crate::notes::{DiagnosticList, excerpt};
use crate::{Class, Code, Diagnostic, Expr, Pattern, Production, Role};
use core::ops::Range;
use lsystem_base::sorted::{repeated, set};
use lsystem_base::{LimitName, MAX_CONTEXT, say};

/// A line with an arrow. Such lines are read after all constants.
pub(super) struct ProductionLine {
    pub(super) tokens: Vec<Token>,
    /// The arrow's range among the tokens.
    pub(super) arrow: Range<usize>,
    /// The end of the line in the text, in bytes.
    pub(super) end: usize,
    /// Whether the line stands below `draw:`.
    pub(super) drawing: bool,
}

/// A wrong expression is noted, and replaced so that the production still has a condition or a weight.
const PLACEHOLDER: Expr = Expr::Number(1.0);

/// Reads a production into `reading`. A line without a single predecessor is only noted.
pub(super) fn read(
    line: &ProductionLine,
    constants: &mut Constants,
    reading: &mut Reading,
    notes: &mut DiagnosticList,
) {
    let ProductionLine { tokens, arrow, end, drawing } = line;
    let (before, after) = (&tokens[..arrow.start], &tokens[arrow.end..]);
    let is_double = tokens[arrow.start].is('=');
    let arrow = span_of(&tokens[arrow.clone()], *end);
    let (head, condition) = match outside_parentheses(before, ':').next() {
        Some(colon) => (&before[..colon], Some(&before[colon..])),
        None => (before, None),
    };
    let second = super::arrow::find(after).is_some();
    // `A(x) : x => 1` has no arrow at all.
    let incomplete = |condition: &[Token]| condition.iter().all(|t| expression::is_name_part(t.ch) || t.is(':'));
    let number = after.first().is_some_and(|t| t.ch.is_ascii_digit());
    if is_double && condition.is_some_and(|condition| second || (number && incomplete(condition))) {
        return notes.error(arrow, say!("This is read as an arrow"), say!("For at least write `>=`."));
    }
    let (successor, weight) = match outside_parentheses(after, ':').last() {
        Some(colon) => (&after[..colon], Some(&after[colon..])),
        None => (after, None),
    };
    notes.class(Class::Mark, arrow.clone());
    let condition = condition.map(|condition| classed(condition, Class::Condition, notes));
    let weight = weight.map(|weight| classed(weight, Class::Weight, notes));
    let has_head = !head.is_empty();
    let head = read_head(head, &arrow, notes);
    let parameters = head.names(notes);
    if *drawing && let Some(span) = head.context_span() {
        notes.error(
            span,
            say!("Rules below `draw:` have no contexts"),
            say!("Let a rule above `draw:` make another symbol there, and draw that."),
        );
    }
    let mut scope = Scope { parameters, constants };
    let condition = condition.filter(|tokens| !is_star(tokens) && has_head).map(|tokens| {
        let read = expression::read(tokens, arrow.start, Role::Condition, &mut scope, notes);
        let Some(condition) = read else { return PLACEHOLDER };
        if let Ok(Code::Constant(value)) = expression::code(&condition, &mut scope) {
            let holds = value != 0.0;
            notes.warn(
                span_of(tokens, arrow.start),
                if holds { say!("This condition is always true") } else { say!("This condition is always false") },
                weight_place(),
            );
        }
        condition
    });
    note_misread(successor, *end, notes);
    let successor = word(successor, Role::Argument, &mut scope, notes);
    let weight = weight.map(|tokens| read_weight(tokens, *end, &mut scope, notes));
    let Head { left, strict: Some((predecessor, span)), right } = head else { return };
    let (left, left_spans): (Vec<Pattern>, Vec<_>) = left.into_iter().unzip();
    let (right, right_spans): (Vec<Pattern>, Vec<_>) = right.into_iter().unzip();
    let production = Production { left, predecessor, right, condition, successor: successor.modules, weight };
    let places = Places { predecessor: span, left: left_spans, right: right_spans, successor: successor.spans };
    let (list, places_list) = if *drawing {
        (&mut reading.grammar.images, &mut reading.images)
    } else {
        (&mut reading.grammar.productions, &mut reading.productions)
    };
    list.push(production);
    places_list.push(places);
}

/// Reads the weight of a production.
fn read_weight(tokens: &[Token], end: usize, scope: &mut Scope<'_>, notes: &mut DiagnosticList) -> Expr {
    let Some(weight) = expression::read(tokens, end, Role::Weight, scope, notes) else {
        return PLACEHOLDER;
    };
    match expression::code(&weight, scope) {
        // Bounded so that the sum of weights stays finite.
        Ok(Code::Constant(value)) if !(1e-100..=1e100).contains(&value) => {
            notes.error(
                span_of(tokens, end),
                say!("{} cannot be a weight", lsystem_base::number::number(value)),
                say!("A weight is a number above zero, from 1e-100 to 1e100."),
            );
        }
        _ => {}
    }
    weight
}

/// Notes words in a successor that are read as symbols but probably mean something else: a condition after `if`, a
/// comment after `//` or `#`, and a weight at either end.
fn note_misread(tokens: &[Token], end: usize, notes: &mut DiagnosticList) {
    super::word::note_wrapping(tokens, notes);
    let weight = tokens.windows(2).position(|pair| pair[0].is(':') && (pair[1].is('.') || pair[1].ch.is_ascii_digit()));
    if let Some(at) = weight {
        let digits = tokens[at + 1..].iter().take_while(|t| t.ch.is_ascii_digit() || t.is('.')).count();
        return notes.add(span_of(&tokens[at..at + 1 + digits], end), weight_of_symbols());
    }
    let after = |found: Option<usize>| found.map_or(0, |at| at + 1);
    let compared = after(tokens.iter().rposition(|t| matches!(t.ch, '<' | '>' | '=' | '≤' | '≥')));
    let active = after(tokens.iter().rposition(|t| Class::of_symbol(t.ch) != Class::Plain));
    let mut rest = tokens;
    for part in tokens.chunk_by(|_, t| t.joined) {
        let (start, behind) = (rest, &rest[part.len()..]);
        rest = behind;
        let (is_first, is_last) = (start.len() == tokens.len(), behind.is_empty());
        if part.iter().any(|t| t.literal) || (is_first && is_last) {
            continue;
        }
        let from = tokens.len() - behind.len();
        let text = text_of(part);
        let (warning, slip) = match text.as_str() {
            "if" if !is_first && from < compared => (condition_behind(), start),
            "//" | "#" if !is_first && from >= active && is_word(behind) => (comment_behind(), start),
            ";" | "--" | "%" if !is_first && is_word(behind) => (comment_behind(), start),
            _ if has_note(part, behind) => {
                let from = part.iter().position(|t| t.is(';')).unwrap_or(0);
                (comment_behind(), &start[from..])
            }
            _ if (is_first || is_last) && is_weight(part) => (weight_of_symbols(), part),
            _ => continue,
        };
        return notes.add(span_of(slip, end), warning);
    }
}

fn condition_behind() -> Diagnostic {
    Diagnostic::warning(say!("`if` and what follows are read as symbols"))
        .hint(say!("A condition stands before the arrow, as in `A(x) : x < 3 -> B`."))
}

fn comment_behind() -> Diagnostic {
    Diagnostic::warning(say!("This comment is read as symbols"))
        .hint(say!("A comment needs a line of its own, or stands between `/*` and `*/`."))
        .fix(String::new())
}

fn weight_of_symbols() -> Diagnostic {
    Diagnostic::warning(say!("This number is read as symbols")).hint(weight_place())
}

fn weight_place() -> String {
    say!("A weight stands at the end of the line, as in `F -> FF : 0.5`.")
}

/// Whether a comment begins at a `;` in these joined tokens: two words of three letters or more stand behind it.
fn has_note(part: &[Token], behind: &[Token]) -> bool {
    let Some(at) = part.iter().position(|t| t.is(';')) else { return false };
    let joined_word = |tokens: &[Token]| is_word(tokens) && tokens.iter().all(|t| t.ch.is_alphabetic());
    joined_word(&part[at + 1..]) && behind.iter().take(3).count() == 3 && is_word(behind)
}

/// Whether the tokens look like a weight: `0.5`, `(.5)` or `50%`.
fn is_weight(tokens: &[Token]) -> bool {
    let (mut digits, mut marks) = (false, false);
    for token in tokens {
        match token.ch {
            '0'..='9' => digits = true,
            '.' | '%' => marks = true,
            '(' | ')' => {}
            _ => return false,
        }
    }
    digits && marks
}

/// Whether the tokens begin with a word: three joined letters.
fn is_word(tokens: &[Token]) -> bool {
    (0..3).all(|at| tokens.get(at).is_some_and(|t| t.ch.is_alphabetic() && (at == 0 || t.joined)))
}

/// Notes the classes of a colon and of what follows it, which is given back.
fn classed<'a>(part: &'a [Token], class: Class, notes: &mut DiagnosticList) -> &'a [Token] {
    let (colon, rest) = part.split_at(1);
    notes.class(Class::Mark, span_of(colon, 0));
    notes.class(class, span_of(rest, 0));
    rest
}

/// The part before the condition: patterns and their places. `strict` is `None` where it could not be read.
#[derive(Default)]
struct Head {
    left: Vec<(Pattern, Range<usize>)>,
    strict: Option<(Pattern, Range<usize>)>,
    right: Vec<(Pattern, Range<usize>)>,
}

impl Head {
    fn patterns(&self) -> impl Iterator<Item = &(Pattern, Range<usize>)> {
        self.left.iter().chain(&self.strict).chain(&self.right)
    }

    /// The names of all parameters, sorted. Repeated names are noted.
    fn names(&self, notes: &mut DiagnosticList) -> Vec<&str> {
        let names =
            || self.patterns().flat_map(|(pattern, span)| pattern.parameters.iter().map(move |name| (name, span)));
        for ((name, span), repeated) in names().zip(repeated(names().map(|(name, _)| name))) {
            if repeated {
                let name = excerpt(name);
                notes.error(
                    span.clone(),
                    say!("Two parameters are called `{}`", name),
                    say!("Give them different names; compare them in a condition, as in `: {} == {}1`.", name, name),
                );
            }
        }
        set(names().map(|(name, _)| name.as_str()))
    }

    fn context_span(&self) -> Option<Range<usize>> {
        let (_, first) = self.left.first().or(self.right.first())?;
        let (_, last) = self.right.last().or(self.left.last())?;
        Some(first.start..last.end)
    }
}

/// Reads contexts and predecessor.
fn read_head(head: &[Token], arrow: &Range<usize>, notes: &mut DiagnosticList) -> Head {
    let [less, greater] = ['<', '>'].map(|mark| outside_parentheses(head, mark).collect::<Vec<_>>());
    match head {
        [] => {
            no_predecessor(arrow.clone(), notes);
            return Head::default();
        }
        [only] if only.is('<') || only.is('>') => {
            no_predecessor(only.span(), notes);
            return Head::default();
        }
        _ => {}
    }
    let disorder = match (less.as_slice(), greater.as_slice()) {
        ([_, second, ..], _) | (_, [_, second, ..]) => Some(*second),
        ([less], [greater]) if greater < less => Some(*less),
        _ => None,
    };
    if let Some(at) = disorder {
        notes.error(
            head[at].span(),
            say!("A rule has one left and one right context at most"),
            say!("Write it as `A < B > C -> D`; conditions come after `:`, and the symbols `<` and `>` in backquotes."),
        );
        return Head::default();
    }
    let from = less.first().map_or(0, |at| at + 1);
    let to = greater.first().copied().unwrap_or(head.len());
    let strict = &head[from..to];
    notes.class(Class::Predecessor, span_of(strict, 0));
    let left = less.first().map_or(Vec::new(), |&at| context(&head[..at], head[at], notes));
    let right = greater.first().map_or(Vec::new(), |&at| context(&head[at + 1..], head[at], notes));
    check_contexts(&left, &right, notes);
    let (patterns, spans) = patterns(strict, notes);
    let is_number = |tokens: &[Token]| !tokens.is_empty() && tokens.iter().all(|t| t.ch.is_ascii_digit() || t.is('.'));
    let compared = (is_number(strict) && left.iter().any(|(p, _)| !p.parameters.is_empty()))
        || (greater.first().is_some_and(|&at| is_number(&head[at + 1..])) && strict.iter().any(|t| t.is('(')));
    if compared {
        notes.warn(
            span_of(head, arrow.start),
            say!("This is read as a context, not as a comparison"),
            say!(
                "Conditions come after `:`, as in `A(x) : x < 3 -> B`; write the digits in backquotes if they are symbols."
            ),
        );
    }
    let mut patterns: Vec<_> = patterns.into_iter().zip(spans).collect();
    let strict = match patterns.len() {
        1 => patterns.pop(),
        0 => {
            let at = strict.first().map_or(arrow.clone(), |_| span_of(strict, arrow.start));
            // Otherwise an unclosed parenthesis, which is noted already.
            if strict.is_empty() {
                no_predecessor(at, notes);
            }
            None
        }
        _ => {
            long_predecessor(&text_of(strict), span_of(strict, arrow.start), notes);
            None
        }
    };
    Head { left, strict, right }
}

fn no_predecessor(span: Range<usize>, notes: &mut DiagnosticList) {
    notes.error(
        span,
        say!("There is no symbol before the arrow"),
        say!(
            "Write the symbol to be replaced first, as in `F -> FF`; `<`, `>`, `:` and a `-` right before the arrow need \
             backquotes or a space."
        ),
    );
}

fn long_predecessor(text: &str, span: Range<usize>, notes: &mut DiagnosticList) {
    let hint = match text.chars().next() {
        Some(first) if first.is_alphabetic() => say!("Write one rule for each symbol, as in `{} -> ...`.", first),
        _ => say!("Write one rule for each symbol, without quotes, bullets or numbers."),
    };
    let error = Diagnostic::error(say!("A rule replaces one symbol, not `{}`", text)).hint(hint);
    notes.add(span, error.fix(only_symbol(text).map(String::from)));
}

/// The predecessor in a text like `"F"` or `1.F`: quotes, bullets and numbers around one letter.
fn only_symbol(text: &str) -> Option<char> {
    let mut letters = text.chars().filter(|ch| ch.is_alphabetic());
    let letter = letters.next()?;
    let others = text
        .chars()
        .all(|ch| ch == letter || ch.is_ascii_digit() || matches!(ch, '"' | '\'' | '.' | ')' | '-' | '*' | '•'));
    (letters.next().is_none() && others).then_some(letter)
}

fn context(tokens: &[Token], mark: Token, notes: &mut DiagnosticList) -> Vec<(Pattern, Range<usize>)> {
    notes.class(Class::Mark, mark.span());
    notes.class(Class::Context, span_of(tokens, 0));
    if tokens.is_empty() {
        let message = match mark.ch {
            '<' => say!("There is no context before `<`"),
            other => say!("There is no context after `{}`", other),
        };
        notes.error(mark.span(), message, say!("Write `*` for any context, or leave `{}` out.", mark.ch));
    }
    if is_empty(tokens) {
        return Vec::new();
    }
    let (patterns, spans) = patterns(tokens, notes);
    if patterns.len() > MAX_CONTEXT {
        notes.add(span_of(tokens, 0), Diagnostic::limit(LimitName::Context, MAX_CONTEXT as u64, None));
    }
    patterns.into_iter().zip(spans).collect()
}

/// Notes misplaced brackets in contexts.
fn check_contexts(left: &[(Pattern, Range<usize>)], right: &[(Pattern, Range<usize>)], notes: &mut DiagnosticList) {
    for (pattern, span) in left {
        if matches!(pattern.symbol, '[' | ']') {
            return notes.error(
                span.clone(),
                say!("A left context has no brackets: it is read along the way to the root"),
                say!("Leave out finished branches and the `[` of the branch itself."),
            );
        }
    }
    let mut open = Vec::new();
    let mut wrong = right.iter().filter(|(pattern, span)| match pattern.symbol {
        '[' | ']' if !pattern.parameters.is_empty() => true,
        '[' => {
            open.push(span);
            false
        }
        ']' => open.pop().is_none(),
        _ => false,
    });
    let wrong = wrong.next().map(|(_, span)| span).or_else(|| open.pop());
    if let Some(span) = wrong {
        notes.error(
            span.clone(),
            say!("Brackets in a right context come in pairs and have no parameters"),
            say!("Write a branch as in `B > C[D]E`."),
        );
    }
}

/// The indices of the tokens `ch` outside parentheses.
fn outside_parentheses(tokens: &[Token], ch: char) -> impl Iterator<Item = usize> {
    let mut depth = 0_usize;
    tokens.iter().enumerate().filter_map(move |(at, t)| {
        depth = (depth + usize::from(t.is('('))).saturating_sub(usize::from(t.is(')')));
        (depth == 0 && t.is(ch)).then_some(at)
    })
}

/// Whether the tokens are `*`, the empty condition.
fn is_star(tokens: &[Token]) -> bool {
    matches!(tokens, [only] if only.is('*'))
}
