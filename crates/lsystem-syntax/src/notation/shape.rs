//! Shapes in lines such as `shape crown = ball(0, 10, 0, 5) - half(0, 3, 0, 0, 1, 0)`.

use super::expression::{self, Names, too_deep, unclosed};
use super::token::{Token, span_of, text_of};
use crate::code::Code;
use crate::notes::DiagnosticList;
use crate::shape::{MAX_SIDES, SOLIDS, Shape};
use crate::{Class, Role};
use core::ops::Range;
use lsystem_base::{counted, say};

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
pub(super) fn read(tokens: &[Token], end: usize, names: &mut dyn Names, notes: &mut DiagnosticList) -> Option<Shape> {
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
    notes: &'a mut DiagnosticList,
}

impl ShapeReader<'_> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    fn unexpected<T>(&mut self, token: Token) -> Option<T> {
        self.no_solid(&text_of(&[token]), token.span())
    }

    fn no_solid<T>(&mut self, found: &str, span: Range<usize>) -> Option<T> {
        self.notes.error(
            span,
            if found.is_empty() {
                say!("A solid is missing")
            } else {
                say!("`{}` is not a solid with its numbers", found)
            },
            say!("Solids are ball(x, y, z, r), box, cylinder, cone, half, outline and mesh, joined by +, - or &."),
        );
        None
    }

    /// Solids with signs between them, from left to right.
    fn combination(&mut self) -> Option<Shape> {
        let mut shape = self.solid()?;
        while let Some(sign) = self.peek().filter(|t| t.is('+') || t.is('-') || t.is('&')) {
            self.at += 1;
            self.signs += 1;
            if self.signs > DEPTH {
                return too_deep(sign.span(), self.notes);
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
            return self.no_solid("", self.end..self.end);
        };
        if first.is('(') {
            self.depth += 1;
            if self.depth > DEPTH {
                return too_deep(first.span(), self.notes);
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
                None => unclosed(first, self.notes),
            };
        }
        let rest = &self.tokens[self.at..];
        let length = rest.iter().take_while(|t| !t.literal && expression::is_name_part(t.ch)).count();
        let name: String = rest[..length].iter().map(|t| t.ch).collect();
        let span = span_of(&rest[..length.max(1)], self.end);
        let Some(&(name, wanted)) = SOLIDS.iter().find(|(known, _)| *known == name) else {
            return self.no_solid(&crate::notes::excerpt(&name), span);
        };
        self.notes.class(Class::Function, span.clone());
        let Some(open) = rest.get(length).copied().filter(|t| t.is('(')) else {
            return self.no_solid(name, span);
        };
        self.at += length;
        let rest = &self.tokens[self.at..];
        let Some(close) = super::word::closing(rest) else {
            return unclosed(open, self.notes);
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
            self.wrong_numbers(name, wanted, numbers.len(), span);
        }
        shape
    }

    /// Notes a wrong number of numbers; `expected` is `None` for a list.
    fn wrong_numbers(&mut self, name: &str, expected: Option<usize>, found: usize, span: Range<usize>) {
        let message = match expected {
            Some(expected) => {
                say!("`{}` takes {}, not {}", name, counted!(expected, "{} number", "{} numbers"), found)
            }
            None if name == "mesh" => say!("`mesh` takes nine numbers for each of 4 to {} triangles", MAX_SIDES),
            None => say!("`{}` takes two numbers for each of 3 to {} corners", name, MAX_SIDES),
        };
        let hint = match name {
            "ball" => say!("`ball(x, y, z, r)` has a centre and a radius."),
            "box" => say!("`box(x, y, z, x, y, z)` has two opposite corners."),
            "cylinder" | "cone" => say!("`{}(x, y, z, x, y, z, r)` has two ends and a radius.", name),
            "half" => say!("`half(x, y, z, a, b, c)` has a point of its plane, and a direction out of it."),
            "mesh" => say!("`mesh(x, y, z, x, y, z, x, y, z, ...)` has the corners of its triangles."),
            _ => say!("`outline(x, y, x, y, x, y)` has its corners in order."),
        };
        self.notes.error(span, message, hint);
    }
}
