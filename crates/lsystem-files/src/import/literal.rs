//! JavaScript's literals: objects, lists, strings and simple arithmetic. Everything else is kept as text.

use lsystem_syntax::{Meter, decimal};

/// A value of a script.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Literal {
    Text(String),
    /// A number, and whether it was computed with `PI`.
    Number {
        value: f64,
        has_pi: bool,
    },
    Object(Vec<(String, Literal)>),
    List(Vec<Literal>),
    /// Code that is not read, such as a function.
    Code,
}

impl Literal {
    pub(super) fn text(&self) -> Option<String> {
        match self {
            Self::Text(text) => Some(text.clone()),
            // A list of one-letter strings is a word too.
            Self::List(items) => items.iter().map(Self::text).collect::<Option<String>>(),
            _ => None,
        }
    }

    pub(super) fn number(&self) -> Option<(f64, bool)> {
        match self {
            Self::Number { value, has_pi } => Some((*value, *has_pi)),
            Self::Text(text) => decimal::read(text.trim().trim_end_matches(['°', ' '])).map(|value| (value, false)),
            _ => None,
        }
    }
}

/// The most nested objects and lists.
const DEPTH: usize = 32;

/// Reads one literal at the start of `text`, which is `{` or `[`. Returns the literal and its length in bytes.
pub(super) fn literal(text: &str, meter: &mut Meter) -> Option<(Literal, usize)> {
    let mut reader = Reader { text, at: 0, meter };
    let value = reader.value(0)?;
    Some((value, reader.at))
}

struct Reader<'a, 'm> {
    text: &'a str,
    at: usize,
    meter: &'m mut Meter,
}

impl Reader<'_, '_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn take(&mut self) -> Option<char> {
        let ch = self.peek()?;
        self.at += ch.len_utf8();
        Some(ch)
    }

    /// Skips white space and comments.
    fn skip(&mut self) {
        loop {
            let text = self.text;
            let trimmed = text[self.at..].trim_start();
            self.at = text.len() - trimmed.len();
            let end = if trimmed.starts_with("//") {
                trimmed.find('\n')
            } else if trimmed.starts_with("/*") {
                trimmed.find("*/").map(|end| end + 2)
            } else {
                return;
            };
            self.at += end.unwrap_or(trimmed.len());
        }
    }

    fn value(&mut self, depth: usize) -> Option<Literal> {
        self.skip();
        self.meter.charge(1);
        if depth > DEPTH || self.meter.is_spent() {
            return None;
        }
        match self.peek()? {
            '{' => self.object(depth),
            '[' => self.list(depth),
            '"' | '\'' | '`' => {
                let text = self.string()?;
                self.skip();
                // A string that is computed further is code.
                if matches!(self.peek(), Some(',' | '}' | ']') | None) {
                    Some(Literal::Text(text))
                } else {
                    self.code()
                }
            }
            _ => self.code(),
        }
    }

    fn string(&mut self) -> Option<String> {
        let quote = self.take()?;
        let mut text = String::new();
        loop {
            match self.take()? {
                ch if ch == quote => return Some(text),
                '\\' => match self.take()? {
                    'n' => text.push('\n'),
                    't' => text.push('\t'),
                    'u' => {
                        let code = u32::from_str_radix(self.rest().get(..4)?, 16).ok()?;
                        self.at += 4;
                        text.push(char::from_u32(code)?);
                    }
                    ch => text.push(ch),
                },
                ch => text.push(ch),
            }
        }
    }

    fn object(&mut self, depth: usize) -> Option<Literal> {
        self.take();
        let mut fields = Vec::new();
        loop {
            self.skip();
            match self.peek()? {
                '}' => {
                    self.take();
                    return Some(Literal::Object(fields));
                }
                ',' => {
                    self.take();
                }
                _ => {
                    let key = match self.peek()? {
                        '"' | '\'' | '`' => self.string()?,
                        _ => {
                            let end = self.rest().find(|ch: char| !ch.is_alphanumeric() && !"_$".contains(ch))?;
                            let key = self.rest()[..end].to_owned();
                            self.at += end;
                            key
                        }
                    };
                    self.skip();
                    if self.peek()? != ':' || key.is_empty() {
                        return None;
                    }
                    self.take();
                    fields.push((key, self.value(depth + 1)?));
                }
            }
        }
    }

    fn list(&mut self, depth: usize) -> Option<Literal> {
        self.take();
        let mut items = Vec::new();
        loop {
            self.skip();
            match self.peek()? {
                ']' => {
                    self.take();
                    return Some(Literal::List(items));
                }
                ',' => {
                    self.take();
                }
                _ => items.push(self.value(depth + 1)?),
            }
        }
    }

    /// A number, or code up to the next comma or bracket outside brackets and strings.
    fn code(&mut self) -> Option<Literal> {
        let start = self.at;
        let mut open = 0_usize;
        loop {
            match self.peek()? {
                ',' | '}' | ']' if open == 0 => break,
                '(' | '{' | '[' => open += 1,
                ')' | '}' | ']' => open = open.saturating_sub(1),
                '"' | '\'' | '`' => {
                    self.string()?;
                    continue;
                }
                _ => {}
            }
            self.take();
        }
        let text = self.text[start..self.at].trim();
        let value = arithmetic(text);
        Some(value.map_or(Literal::Code, |value| Literal::Number { value, has_pi: text.contains("PI") }))
    }
}

/// The value of `2 * Math.PI / 7` and the like: products and quotients of numbers and `PI`.
fn arithmetic(text: &str) -> Option<f64> {
    let plain: String = text.replace("Math.PI", "π").replace("PI", "π").replace(['(', ')', ' ', '\n', '\t'], "");
    let (sign, plain) = plain.strip_prefix('-').map_or((1.0, &plain[..]), |rest| (-1.0, rest));
    let mut value = sign;
    let mut rest = plain;
    let mut divide = false;
    loop {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let factor: f64 = match &rest[..end] {
            "π" => core::f64::consts::PI,
            digits => decimal::read(digits)?,
        };
        value = if divide { value / factor } else { value * factor };
        let Some(operator) = rest[end..].chars().next() else { break };
        divide = operator == '/';
        rest = &rest[end + 1..];
    }
    value.is_finite().then_some(value)
}
