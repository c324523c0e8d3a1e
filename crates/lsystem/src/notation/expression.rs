//! Arithmetic in weights and constants.

use super::token::{Token, span_of, text_of};
use crate::Kind;
use crate::notes::Notes;

/// The constants that arithmetic may name.
pub(crate) trait Names {
    /// The value of the constant `name`, which counts as used then.
    fn value(&mut self, name: &str) -> Option<f64>;
    /// A name like this one.
    fn similar(&self, name: &str) -> Option<String>;
}

/// Parentheses, signs and powers inside each other.
const DEPTH: u32 = 64;

/// The value of the arithmetic in `tokens`; `None` where something is wrong, which is noted. `end` is where a missing
/// number would stand. `weight` says what the number is for.
///
/// `^` binds tightest and to the right, then signs, then `* /`, then `+ -`.
pub(crate) fn evaluate(
    tokens: &[Token],
    end: usize,
    weight: bool,
    names: &mut dyn Names,
    notes: &mut Notes,
) -> Option<f64> {
    let mut reader = Reader { tokens, at: 0, end, depth: 0, weight, names, notes };
    let value = reader.sum()?;
    if let Some(token) = reader.peek() {
        reader.unexpected(token);
        return None;
    }
    if !value.is_finite() {
        reader.notes.add(Kind::ArithmeticRange, span_of(tokens, end));
        return None;
    }
    Some(value)
}

struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
    end: usize,
    depth: u32,
    weight: bool,
    names: &'a mut dyn Names,
    notes: &'a mut Notes,
}

impl Reader<'_> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    /// Steps over the next token if it is one of `chars`.
    fn take(&mut self, chars: &[char]) -> Option<char> {
        let token = self.peek().filter(|t| !t.literal && chars.contains(&t.ch))?;
        self.at += 1;
        Some(token.ch)
    }

    fn unexpected(&mut self, token: Token) {
        self.notes.add(Kind::ArithmeticUnexpected { found: token.ch, weight: self.weight }, token.span());
    }

    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        while let Some(operator) = self.take(&['+', '-']) {
            let right = self.product()?;
            value = if operator == '+' { value + right } else { value - right };
        }
        Some(value)
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.signed()?;
        while let Some(operator) = self.take(&['*', '/']) {
            let right = self.signed()?;
            value = if operator == '*' { value * right } else { value / right };
        }
        Some(value)
    }

    fn signed(&mut self) -> Option<f64> {
        let sign = self.peek();
        match self.take(&['+', '-']) {
            Some('-') => self.deeper(sign?, Self::signed).map(|v| -v),
            Some(_) => self.deeper(sign?, Self::signed),
            None => self.power(),
        }
    }

    fn power(&mut self) -> Option<f64> {
        let base = self.operand()?;
        let caret = self.peek();
        match self.take(&['^']) {
            Some(_) => Some(libm::pow(base, self.deeper(caret?, Self::signed)?)),
            None => Some(base),
        }
    }

    fn deeper(&mut self, at: Token, read: fn(&mut Self) -> Option<f64>) -> Option<f64> {
        if self.depth == DEPTH {
            self.notes.add(Kind::ArithmeticDepth, at.span());
            return None;
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    fn operand(&mut self) -> Option<f64> {
        let Some(token) = self.peek() else {
            self.notes.add(Kind::NumberExpected, self.end..self.end);
            return None;
        };
        match token.ch {
            _ if token.literal => {}
            '(' => {
                self.at += 1;
                let value = self.deeper(token, Self::sum)?;
                if self.take(&[')']).is_some() {
                    return Some(value);
                }
                match self.peek() {
                    Some(other) => self.unexpected(other),
                    None => self.notes.add(Kind::ArithmeticUnclosed, token.span()),
                }
                return None;
            }
            '0'..='9' | '.' => return self.number(),
            ch if is_name_start(ch) => return self.name(),
            _ => {}
        }
        self.unexpected(token);
        None
    }

    /// Joined tokens from here on, as long as they are `part` of it.
    fn run(&mut self, part: impl Fn(&[Token], Token) -> bool) -> &[Token] {
        let rest = &self.tokens[self.at..];
        let length = (1..rest.len())
            .find(|&i| rest[i].literal || !rest[i].joined || !part(&rest[..i], rest[i]))
            .unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn number(&mut self) -> Option<f64> {
        let run = self.run(|before, t| {
            let exponent_sign = matches!(t.ch, '+' | '-')
                && matches!(before, [.., digit, e] if matches!(e.ch, 'e' | 'E') && digit.ch != 'e')
                && !before[..before.len() - 1].iter().any(|t| t.ch.is_alphabetic());
            t.ch.is_alphanumeric() || t.ch == '.' || exponent_sign
        });
        let (digits, span): (String, _) = (run.iter().map(|t| t.ch).collect(), span_of(run, 0));
        // Rust also reads `inf` and `nan`, which cannot start with a digit or a point.
        match digits.parse::<f64>() {
            Ok(value) => Some(value),
            Err(_) => {
                self.notes.add(Kind::NumberMalformed { text: crate::notes::excerpt(&digits) }, span);
                None
            }
        }
    }

    fn name(&mut self) -> Option<f64> {
        let run = self.run(|_, t| is_name_part(t.ch));
        let (name, text, span): (String, _, _) = (run.iter().map(|t| t.ch).collect(), text_of(run), span_of(run, 0));
        let value = self.names.value(&name);
        if value.is_none() {
            let similar = if self.notes.is_full() { None } else { self.names.similar(&name) };
            self.notes.add(Kind::UnknownConstant { name: text, similar, below: false, weight: self.weight }, span);
        }
        value
    }
}

/// Whether a constant's name may start with `ch`.
pub(crate) fn is_name_start(ch: char) -> bool {
    ch.is_alphabetic() || ch == '_'
}

/// Whether a constant's name may contain `ch`.
pub(crate) fn is_name_part(ch: char) -> bool {
    ch.is_alphanumeric() || ch == '_'
}
