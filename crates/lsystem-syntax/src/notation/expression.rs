//! Arithmetic in weights, constants, conditions and arguments.

mod functions;
mod role;

pub(super) use functions::function;
pub(crate) use role::Role;

use super::token::{Token, span_of, text_of};
use crate::code::{Code, Meaning, Unusable};
use crate::expr::{Expr, Function, Operator};
use crate::notes::{DiagnosticList, excerpt, named, similar};
use crate::{Class, Diagnostic};
use core::ops::Range;
use functions::{RAN, unknown_function, wrong_arity};
use lsystem_base::say;

/// The names that arithmetic may use.
pub(crate) trait Names {
    /// The meaning of `name`; a constant then counts as used.
    fn meaning(&mut self, name: &str) -> Option<Meaning>;
    /// A similar known name.
    fn similar(&self, name: &str) -> Option<String>;
}

/// The most nested parentheses, signs and powers: the reader is recursive.
const DEPTH: u32 = 64;
/// The most binary operators in one expression: its compiler and printer are recursive.
const LENGTH: u32 = 500;

/// The operators that are words.
const WORDS: [&str; 3] = ["and", "or", "not"];

/// Reads the arithmetic in `tokens`; `None` if it is wrong, which is noted. `end` is the place of a missing number, in
/// bytes; `role` is the role of the value.
///
/// From tight to loose: `^` (to the right), signs and `!`, `* / %`, `+ -`, comparisons (not to be chained), `not`,
/// `&&`, `||`.
pub(crate) fn read(
    tokens: &[Token],
    end: usize,
    role: Role,
    names: &mut dyn Names,
    notes: &mut DiagnosticList,
) -> Option<Expr> {
    let mut reader = ExpressionReader { tokens, at: 0, end, depth: 0, length: 0, role, names, notes };
    let expr = match role {
        Role::Condition | Role::Argument | Role::Axiom => reader.disjunction()?,
        Role::Constant | Role::Weight => reader.sum()?,
    };
    if let Some(token) = reader.peek() {
        reader.unexpected(token);
        return None;
    }
    let span = span_of(tokens, end);
    match code(&expr, names) {
        Ok(Code::Constant(value)) if !value.is_finite() => {
            notes.error(span, say!("The result is not a finite number"), say!("Is something divided by zero?"));
            None
        }
        Ok(code) if role == Role::Constant && code.is_random() => {
            notes.error(
                span,
                say!("A constant has the same value everywhere, so it cannot be random"),
                say!("Use `random` in the arguments of a rule."),
            );
            None
        }
        Ok(_) => Some(expr),
        Err(_) => too_deep(span, notes),
    }
}

/// Notes arithmetic that is nested too deeply.
pub(super) fn too_deep<T>(span: Range<usize>, notes: &mut DiagnosticList) -> Option<T> {
    let hint = say!("Name a part of it, as in `r = 0.9 * 0.7`.");
    notes.error(span, say!("The arithmetic is too long or nested too deeply"), hint);
    None
}

/// Notes a parenthesis without its partner.
pub(super) fn unclosed<T>(open: Token, notes: &mut DiagnosticList) -> Option<T> {
    notes.error(open.span(), say!("This `(` is never closed"), say!("Add `)`."));
    None
}

fn number_missing() -> Diagnostic {
    Diagnostic::error(say!("A number is missing here"))
}

/// Compiles an expression.
pub(crate) fn code(expr: &Expr, names: &mut dyn Names) -> Result<Code, Unusable> {
    let names = core::cell::RefCell::new(names);
    Code::new(expr, &|name: &str| names.borrow_mut().meaning(name), &mut 0)
}

struct ExpressionReader<'a> {
    tokens: &'a [Token],
    at: usize,
    end: usize,
    depth: u32,
    length: u32,
    role: Role,
    names: &'a mut dyn Names,
    notes: &'a mut DiagnosticList,
}

impl ExpressionReader<'_> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    /// Steps over the next token if it is one of `chars`.
    fn take(&mut self, chars: &[char]) -> Option<char> {
        let token = self.peek().filter(|t| !t.literal && chars.contains(&t.ch))?;
        self.at += 1;
        Some(token.ch)
    }

    /// Steps over the next tokens if they are the characters of `mark`.
    fn take_mark(&mut self, mark: &str) -> bool {
        let rest = &self.tokens[self.at..];
        let length = mark.chars().count();
        let found = rest.len() >= length
            && mark.chars().zip(rest).enumerate().all(|(at, (ch, t))| t.is(ch) && (at == 0 || t.joined));
        self.at += if found { length } else { 0 };
        found
    }

    /// Steps over the next tokens if they are exactly this word.
    fn take_word(&mut self, word: &str) -> bool {
        let before = self.at;
        if self.peek().is_some_and(|t| !t.literal && is_name_start(t.ch)) {
            let found = self.run(|_, t| is_name_part(t.ch));
            if found.iter().map(|t| t.ch).eq(word.chars()) {
                return true;
            }
        }
        self.at = before;
        false
    }

    fn unexpected(&mut self, token: Token) {
        let comparison = matches!(token.ch, '<' | '>' | '=' | '!' | '&' | '|' | '≤' | '≥' | '≠') && !token.literal;
        let (message, hint) = if comparison && self.role == Role::Weight {
            (
                say!("This compares values, and a weight is a number"),
                say!("Conditions come before the arrow, as in `A(x) : x > 1 -> B`."),
            )
        } else {
            (say!("{} has no place in arithmetic", named(token.ch)), self.role.instead_of(token.ch))
        };
        self.notes.error(token.span(), message, hint);
    }

    fn disjunction(&mut self) -> Option<Expr> {
        let mut value = self.conjunction()?;
        while self.take_mark("||") || self.take_word("or") {
            value = self.binary(Operator::Or, value, Self::conjunction)?;
        }
        Some(value)
    }

    fn conjunction(&mut self) -> Option<Expr> {
        let mut value = self.negation()?;
        while self.take_mark("&&") || self.take_word("and") {
            value = self.binary(Operator::And, value, Self::negation)?;
        }
        Some(value)
    }

    fn negation(&mut self) -> Option<Expr> {
        let at = self.peek();
        if self.take_word("not") {
            return self.nested(at?, Self::negation).map(|a| Expr::Not(Box::new(a)));
        }
        self.comparison()
    }

    fn comparison(&mut self) -> Option<Expr> {
        let left = self.sum()?;
        let Some(operator) = self.comparator() else { return Some(left) };
        let value = self.binary(operator, left, Self::sum)?;
        let from = self.at;
        if self.comparator().is_some() {
            self.notes.error(
                span_of(&self.tokens[from..self.at], self.end),
                say!("Comparisons cannot be chained"),
                say!("Write them one by one, as in `0 < x && x < 5`."),
            );
            return None;
        }
        Some(value)
    }

    fn comparator(&mut self) -> Option<Operator> {
        const MARKS: [(&str, Operator); 12] = [
            ("==", Operator::Equal),
            ("!=", Operator::NotEqual),
            ("<>", Operator::NotEqual),
            ("<=", Operator::LessOrEqual),
            ("=<", Operator::LessOrEqual),
            (">=", Operator::GreaterOrEqual),
            ("<", Operator::Less),
            (">", Operator::Greater),
            ("=", Operator::Equal),
            ("≤", Operator::LessOrEqual),
            ("≥", Operator::GreaterOrEqual),
            ("≠", Operator::NotEqual),
        ];
        MARKS.into_iter().find(|(mark, _)| self.take_mark(mark)).map(|(_, operator)| operator)
    }

    fn sum(&mut self) -> Option<Expr> {
        let mut value = self.product()?;
        while let Some(sign) = self.take(&['+', '-']) {
            let operator = if sign == '+' { Operator::Add } else { Operator::Subtract };
            value = self.binary(operator, value, Self::product)?;
        }
        Some(value)
    }

    fn product(&mut self) -> Option<Expr> {
        let mut value = self.signed()?;
        while let Some(at) = self.peek()
            && let Some(sign) = self.take(&['*', '/', '%'])
        {
            let operator = match sign {
                '*' => Operator::Multiply,
                '/' => Operator::Divide,
                // `33%` is a percentage.
                _ if self.peek().is_none() => {
                    self.unexpected(at);
                    return None;
                }
                _ => Operator::Remainder,
            };
            value = self.binary(operator, value, Self::signed)?;
        }
        Some(value)
    }

    fn signed(&mut self) -> Option<Expr> {
        let sign = self.peek();
        match self.take(&['+', '-', '!']) {
            Some('-') => self.nested(sign?, Self::signed).map(|a| match a {
                Expr::Number(value) => Expr::Number(-value),
                a => Expr::Negative(Box::new(a)),
            }),
            Some('!') => self.nested(sign?, Self::signed).map(|a| Expr::Not(Box::new(a))),
            Some(_) => self.nested(sign?, Self::signed),
            None => self.power(),
        }
    }

    fn power(&mut self) -> Option<Expr> {
        let base = self.operand()?;
        let caret = self.peek();
        match self.take(&['^']) {
            Some(_) => {
                let exponent = self.nested(caret?, Self::signed)?;
                Some(Expr::Binary(Operator::Power, Box::new(base), Box::new(exponent)))
            }
            None => Some(base),
        }
    }

    fn binary(&mut self, operator: Operator, left: Expr, read: fn(&mut Self) -> Option<Expr>) -> Option<Expr> {
        self.length += 1;
        if self.length > LENGTH {
            return too_deep(span_of(self.tokens, self.end), self.notes);
        }
        let right = read(self)?;
        Some(Expr::Binary(operator, Box::new(left), Box::new(right)))
    }

    fn nested(&mut self, at: Token, read: fn(&mut Self) -> Option<Expr>) -> Option<Expr> {
        if self.depth == DEPTH {
            return too_deep(at.span(), self.notes);
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    fn operand(&mut self) -> Option<Expr> {
        let Some(token) = self.peek() else {
            self.notes.add(self.end..self.end, number_missing());
            return None;
        };
        match token.ch {
            _ if token.literal => {}
            '(' => {
                self.at += 1;
                let value = self.nested(token, Self::disjunction)?;
                return self.closed(token).map(|()| value);
            }
            '0'..='9' | '.' => return self.number(),
            ch if is_name_start(ch) => return self.name(),
            _ => {}
        }
        self.unexpected(token);
        None
    }

    /// Steps over the `)` that belongs to `open`.
    fn closed(&mut self, open: Token) -> Option<()> {
        if self.take(&[')']).is_some() {
            return Some(());
        }
        let Some(other) = self.peek() else { return unclosed(open, self.notes) };
        self.unexpected(other);
        None
    }

    /// Takes the next token and the joined tokens after it for which `part` holds, given the tokens before.
    fn run(&mut self, part: impl Fn(&[Token], Token) -> bool) -> &[Token] {
        let rest = &self.tokens[self.at..];
        let length = (1..rest.len())
            .find(|&i| rest[i].literal || !rest[i].joined || !part(&rest[..i], rest[i]))
            .unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn number(&mut self) -> Option<Expr> {
        let run = self.run(|before, t| {
            let exponent_sign = matches!(t.ch, '+' | '-')
                && matches!(before, [.., digit, e] if matches!(e.ch, 'e' | 'E') && digit.ch != 'e')
                && !before[..before.len() - 1].iter().any(|t| t.ch.is_alphabetic());
            t.ch.is_alphanumeric() || t.ch == '.' || exponent_sign
        });
        let (digits, span): (String, _) = (run.iter().map(|t| t.ch).collect(), span_of(run, 0));
        match lsystem_base::decimal::read(&digits) {
            Some(value) if value.is_infinite() => {
                let message = say!("`{}` is too large a number", excerpt(&digits));
                self.notes.error(span, message, say!("Numbers can be up to 1e308."));
                None
            }
            Some(value) => {
                // In conditions and weights, numbers keep the class of the condition or weight.
                if matches!(self.role, Role::Constant | Role::Argument | Role::Axiom) {
                    self.notes.class(Class::Number, span);
                }
                Some(Expr::Number(value))
            }
            None => {
                let message = say!("`{}` is not a number", excerpt(&digits));
                self.notes.error(span, message, say!("Write numbers as 2, 0.5 or 1e-3."));
                None
            }
        }
    }

    fn name(&mut self) -> Option<Expr> {
        let run = self.run(|_, t| is_name_part(t.ch));
        let (name, text, span): (String, _, _) = (run.iter().map(|t| t.ch).collect(), text_of(run), span_of(run, 0));
        if let Some(open) = self.peek().filter(|t| t.is('(') && t.joined) {
            return self.call(&name, span, open);
        }
        let meaning = self.names.meaning(&name);
        if let Some(Meaning::Constant(_) | Meaning::Slot(_)) = meaning {
            let constant = matches!(meaning, Some(Meaning::Constant(_)));
            self.notes.class(if constant { Class::Constant } else { Class::Parameter }, span);
            return Some(Expr::Name(name));
        }
        let error = if function(&name).is_some() || matches!(meaning, Some(Meaning::Curve(_))) {
            Diagnostic::error(say!("`{}` needs its argument in parentheses", text))
                .hint(say!("Write it as in `{}(30)`.", text))
        } else if is_reserved(&name) {
            number_missing()
        } else {
            let similar = if self.notes.is_full() { None } else { self.names.similar(&name) };
            self.role.unknown(text, similar)
        };
        self.notes.add(span, error);
        None
    }

    fn call(&mut self, name: &str, span: Range<usize>, open: Token) -> Option<Expr> {
        let Some(function) = function(name) else {
            let known = Function::ALL.iter().map(|f| f.name());
            let meaning = self.names.meaning(name);
            if let Some(Meaning::Curve(_)) = meaning {
                return self.curve(name, span, open);
            }
            let text = excerpt(name);
            let error = if meaning.is_some() {
                Diagnostic::error(say!("`{}` is not a function", text))
                    .hint(say!("For a product write `{}*(...)`.", text))
            } else {
                unknown_function(&text, if self.notes.is_full() { None } else { similar(name, known) })
            };
            self.notes.add(span, error);
            return None;
        };
        self.notes.class(Class::Function, span.clone());
        self.at += 1;
        let mut arguments = Vec::new();
        if function.takes_shape() {
            arguments.push(self.shape_name(open)?);
            if self.take(&[',']).is_none() {
                self.closed(open)?;
                self.notes.add(span, wrong_arity(function, 1));
                return None;
            }
        }
        if self.peek().is_none_or(|t| !t.is(')')) {
            loop {
                arguments.push(self.nested(open, Self::disjunction)?);
                if self.take(&[',']).is_none() {
                    break;
                }
            }
        }
        self.closed(open)?;
        if name == RAN && arguments.len() == 1 {
            arguments.insert(0, Expr::Number(0.0));
        }
        let in_plane = function.takes_shape() && arguments.len() + 1 == function.arity();
        if arguments.len() != function.arity() && !in_plane {
            self.notes.add(span, wrong_arity(function, arguments.len()));
            return None;
        }
        Some(Expr::Call(function, arguments))
    }
}

impl ExpressionReader<'_> {
    /// Steps over the argument of a curve.
    fn curve(&mut self, name: &str, span: Range<usize>, open: Token) -> Option<Expr> {
        self.notes.class(Class::Function, span);
        self.at += 1;
        let argument = self.nested(open, Self::disjunction)?;
        self.closed(open)?;
        Some(Expr::Curve(name.to_owned(), Box::new(argument)))
    }

    /// Steps over the name of a shape after `open`.
    fn shape_name(&mut self, open: Token) -> Option<Expr> {
        let start = self.peek().filter(|t| !t.literal && is_name_start(t.ch));
        let run = if start.is_some() { self.run(|_, t| is_name_part(t.ch)) } else { &[] };
        let (name, span): (String, _) = (run.iter().map(|t| t.ch).collect(), span_of(run, open.span().end));
        match self.names.meaning(&name) {
            Some(Meaning::Shape(_)) => {
                self.notes.class(Class::Constant, span);
                Some(Expr::Name(name))
            }
            _ => {
                let message = if name.is_empty() {
                    say!("The name of a shape is missing")
                } else {
                    say!("`{}` is not the name of a shape", excerpt(&name))
                };
                let hint = say!("Define one in a line above, as in `shape crown = ball(0, 10, 0, 5)`.");
                self.notes.error(span, message, hint);
                None
            }
        }
    }
}

/// Whether `name` is an operator.
pub(crate) fn is_reserved(name: &str) -> bool {
    WORDS.contains(&name)
}

/// Whether a name may start with `ch`.
pub(crate) fn is_name_start(ch: char) -> bool {
    ch.is_alphabetic() || ch == '_'
}

/// Whether a name may contain `ch`.
pub(crate) fn is_name_part(ch: char) -> bool {
    ch.is_alphanumeric() || ch == '_'
}
