//! Arithmetic in weights, constants, conditions and arguments.

use super::token::{Token, span_of, text_of};
use crate::code::{Code, Meaning, Unusable};
use crate::expr::{Expr, Function, Operator};
use crate::notes::{Notes, similar};
use crate::{Class, Kind, Role};
use core::ops::Range;

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
pub(crate) fn read(tokens: &[Token], end: usize, role: Role, names: &mut dyn Names, notes: &mut Notes) -> Option<Expr> {
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
        Ok(Code::Constant(value)) if !value.is_finite() => notes.add(Kind::ArithmeticRange, span),
        Ok(code) if role == Role::Constant && code.is_random() => notes.add(Kind::ConstantRandom, span),
        Ok(_) => return Some(expr),
        Err(_) => notes.add(Kind::ArithmeticDepth, span),
    }
    None
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
    notes: &'a mut Notes,
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
        let kind = if comparison && self.role == Role::Weight {
            Kind::WeightCondition
        } else {
            Kind::ArithmeticUnexpected { found: token.ch, role: self.role }
        };
        self.notes.add(kind, token.span());
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
            self.notes.add(Kind::ComparisonChain, span_of(&self.tokens[from..self.at], self.end));
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
            self.notes.add(Kind::ArithmeticDepth, span_of(self.tokens, self.end));
            return None;
        }
        let right = read(self)?;
        Some(Expr::Binary(operator, Box::new(left), Box::new(right)))
    }

    fn nested(&mut self, at: Token, read: fn(&mut Self) -> Option<Expr>) -> Option<Expr> {
        if self.depth == DEPTH {
            self.notes.add(Kind::ArithmeticDepth, at.span());
            return None;
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    fn operand(&mut self) -> Option<Expr> {
        let Some(token) = self.peek() else {
            self.notes.add(Kind::NumberExpected, self.end..self.end);
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
        match self.peek() {
            Some(other) => self.unexpected(other),
            None => self.notes.add(Kind::ArithmeticUnclosed, open.span()),
        }
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
                self.notes.add(Kind::NumberRange { text: crate::notes::excerpt(&digits) }, span);
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
                self.notes.add(Kind::NumberMalformed { text: crate::notes::excerpt(&digits) }, span);
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
        let kind = if function(&name).is_some() || matches!(meaning, Some(Meaning::Curve(_))) {
            Kind::FunctionBare { name: text }
        } else if is_reserved(&name) {
            Kind::NumberExpected
        } else {
            let similar = if self.notes.is_full() { None } else { self.names.similar(&name) };
            Kind::UnknownConstant { name: text, similar, below: false, role: self.role }
        };
        self.notes.add(kind, span);
        None
    }

    fn call(&mut self, name: &str, span: Range<usize>, open: Token) -> Option<Expr> {
        let Some(function) = function(name) else {
            let known = Function::ALL.iter().map(|f| f.name());
            let meaning = self.names.meaning(name);
            if let Some(Meaning::Curve(_)) = meaning {
                return self.curve(name, span, open);
            }
            let kind = if meaning.is_some() {
                Kind::NotAFunction { name: crate::notes::excerpt(name) }
            } else {
                let similar = if self.notes.is_full() { None } else { similar(name, known) };
                Kind::UnknownFunction { name: crate::notes::excerpt(name), similar }
            };
            self.notes.add(kind, span);
            return None;
        };
        self.notes.class(Class::Function, span.clone());
        self.at += 1;
        let mut arguments = Vec::new();
        if function.takes_shape() {
            arguments.push(self.shape_name(open)?);
            if self.take(&[',']).is_none() {
                self.closed(open)?;
                let (expected, found) = (function.arity(), 1);
                self.notes.add(Kind::FunctionArity { function, expected, found }, span);
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
            let (expected, found) = (function.arity(), arguments.len());
            self.notes.add(Kind::FunctionArity { function, expected, found }, span);
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
                self.notes.add(Kind::ShapeExpected { found: crate::notes::excerpt(&name) }, span);
                None
            }
        }
    }
}

/// The name in cpfg of a random number from 0 up to the only argument.
const RAN: &str = "ran";

/// The function with this name.
pub(super) fn function(name: &str) -> Option<Function> {
    if name == RAN {
        return Some(Function::Random);
    }
    Function::ALL.into_iter().find(|function| function.name() == name)
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
