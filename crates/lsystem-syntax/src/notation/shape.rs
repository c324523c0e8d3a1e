//! Shapes in lines such as `shape crown = ball(0, 10, 0, 5) - half(0, 3, 0, 0, 1, 0)`.

use super::expression::{self, Names};
use super::token::{Token, span_of, text_of};
use crate::code::Code;
use crate::notes::Notes;
use crate::shape::{SOLIDS, Shape};
use crate::{Class, Kind, Role};

/// The most nested parentheses, and the most signs in a shape: printing and measuring it are recursive.
const DEPTH: usize = 64;

/// The places of the name and of `=` in a line that begins with `word`; `None` for another line.
pub(super) fn name(tokens: &[Token], word: &str) -> Option<(usize, usize)> {
    let is_word = tokens.len() > word.len()
        && word.chars().zip(tokens).enumerate().all(|(at, (ch, t))| t.is(ch) && (at == 0 || t.joined))
        && !tokens[word.len()].joined;
    let equals = tokens.iter().position(|t| t.is('='))?;
    (is_word && equals > word.len()).then_some((word.len(), equals))
}

/// Reads a shape; `None` if it is wrong, which is noted. `end` is the place of what is missing, in bytes.
pub(super) fn read(tokens: &[Token], end: usize, names: &mut dyn Names, notes: &mut Notes) -> Option<Shape> {
    let mut reader = ShapeReader { tokens, at: 0, end, depth: 0, signs: 0, names, notes };
    let shape = reader.combination()?;
    match reader.peek() {
        None => Some(shape),
        Some(token) => reader.unexpected(token),
    }
}

struct ShapeReader<'a> {
    tokens: &'a [Token],
    at: usize,
    end: usize,
    depth: usize,
    signs: usize,
    names: &'a mut dyn Names,
    notes: &'a mut Notes,
}

impl ShapeReader<'_> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    fn unexpected<T>(&mut self, token: Token) -> Option<T> {
        self.notes.add(Kind::SolidExpected { found: text_of(&[token]) }, token.span());
        None
    }

    /// Solids with signs between them, from left to right.
    fn combination(&mut self) -> Option<Shape> {
        let mut shape = self.solid()?;
        while let Some(sign) = self.peek().filter(|t| t.is('+') || t.is('-') || t.is('&')) {
            self.at += 1;
            self.signs += 1;
            if self.signs > DEPTH {
                self.notes.add(Kind::ArithmeticDepth, sign.span());
                return None;
            }
            let (a, b) = (Box::new(shape), Box::new(self.solid()?));
            shape = match sign.ch {
                '+' => Shape::Union(a, b),
                '-' => Shape::Difference(a, b),
                _ => Shape::Intersection(a, b),
            };
        }
        Some(shape)
    }

    fn solid(&mut self) -> Option<Shape> {
        let Some(first) = self.peek() else {
            self.notes.add(Kind::SolidExpected { found: String::new() }, self.end..self.end);
            return None;
        };
        if first.is('(') {
            self.depth += 1;
            if self.depth > DEPTH {
                self.notes.add(Kind::ArithmeticDepth, first.span());
                return None;
            }
            self.at += 1;
            let shape = self.combination()?;
            self.depth -= 1;
            return match self.peek() {
                Some(close) if close.is(')') => {
                    self.at += 1;
                    Some(shape)
                }
                Some(other) => self.unexpected(other),
                None => {
                    self.notes.add(Kind::ArithmeticUnclosed, first.span());
                    None
                }
            };
        }
        let rest = &self.tokens[self.at..];
        let length = rest.iter().take_while(|t| !t.literal && expression::is_name_part(t.ch)).count();
        let name: String = rest[..length].iter().map(|t| t.ch).collect();
        let span = span_of(&rest[..length.max(1)], self.end);
        let Some(&(name, wanted)) = SOLIDS.iter().find(|(known, _)| *known == name) else {
            self.notes.add(Kind::SolidExpected { found: crate::notes::excerpt(&name) }, span);
            return None;
        };
        self.notes.class(Class::Function, span.clone());
        let Some(open) = rest.get(length).copied().filter(|t| t.is('(')) else {
            self.notes.add(Kind::SolidExpected { found: name.to_owned() }, span);
            return None;
        };
        self.at += length;
        let rest = &self.tokens[self.at..];
        let Some(close) = super::word::closing(rest) else {
            self.notes.add(Kind::ArithmeticUnclosed, open.span());
            return None;
        };
        let inside = &rest[1..close];
        self.at += close + 1;
        let mut numbers = Vec::new();
        for (part, end) in super::word::parts(inside) {
            let expr = expression::read(part, end, Role::Constant, self.names, self.notes)?;
            match expression::code(&expr, self.names) {
                Ok(Code::Constant(value)) => numbers.push(value),
                _ => return None,
            }
        }
        let shape = Shape::solid(name, &numbers);
        if shape.is_none() {
            self.notes.add(Kind::SolidNumbers { name, expected: wanted, found: numbers.len() }, span);
        }
        shape
    }
}
