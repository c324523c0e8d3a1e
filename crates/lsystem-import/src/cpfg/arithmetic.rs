//! Arithmetic of cpfg and of Python in our notation.

use super::Kind;
use super::choices::without_choices;
use super::macros::{Macros, Replaced, is_part, token};
use lsystem_base::{number::number, say};
use lsystem_syntax::parse;
use std::collections::BTreeMap;

/// What arithmetic can refer to.
pub(super) struct Arithmetic {
    pub(super) kind: Kind,
    pub(super) macros: Macros,
    /// The elements of arrays that never change.
    pub(super) arrays: BTreeMap<String, Vec<f64>>,
    /// The functions of cpfg's files in their order: their names there, and as curves, if they can be read.
    pub(super) curves: Vec<(String, Option<String>)>,
}

/// A reason why arithmetic cannot be read.
pub(super) type Wrong = String;

/// The functions of ours that arithmetic may call.
pub(super) const FUNCTIONS: [&str; 19] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "exp", "ln", "abs", "floor", "ceil", "min", "max",
    "random", "ran", "nran", "not",
];

impl Arithmetic {
    pub(super) fn new(kind: Kind) -> Self {
        let mut macros = Macros::new(if kind == Kind::Cpfg { "cpfg " } else { "L-Py " });
        if kind == Kind::LPy {
            macros.define("pi".to_owned(), None, "3.141592653589793".to_owned(), false);
        }
        Self { kind, macros, arrays: BTreeMap::new(), curves: Vec::new() }
    }

    /// Arithmetic in our notation.
    pub(super) fn read(&self, text: &str) -> Result<String, Wrong> {
        self.written(text, Replaced::Texts)
    }

    /// Arithmetic in our notation, without the macros that are `replaced`.
    fn written(&self, text: &str, replaced: Replaced) -> Result<String, Wrong> {
        let text = self.macros.expand(text, replaced)?;
        match self.kind {
            Kind::Cpfg => self.translate(&without_choices(&text, &self.macros)?),
            Kind::LPy => self.translate(&text),
        }
    }

    /// The value of arithmetic of constants.
    pub(super) fn value(&self, text: &str) -> Option<f64> {
        let text = self.written(text, Replaced::All).ok()?;
        let number = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')).unwrap_or(&text);
        if number.starts_with(|c: char| c.is_ascii_digit())
            && let Ok(value) = number.parse::<f64>()
        {
            return Some(value).filter(|value| value.is_finite());
        }
        // Long sums are refused by the parser, so that this takes a time in proportion.
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let (grammar, diagnostics) = parse("", &format!("value_ = {text}"));
        let wrong = diagnostics.iter().any(lsystem_syntax::Diagnostic::is_error);
        grammar.constant("value_").filter(|value| value.is_finite() && !wrong)
    }

    fn translate(&self, text: &str) -> Result<String, Wrong> {
        let mut out = String::new();
        let mut rest = text;
        // Whether a value stands before.
        let mut valued = false;
        while let Some(token) = token(rest) {
            rest = &rest[token.len()..];
            let opened = rest.trim_start();
            let first = token.chars().next().unwrap_or_default();
            if first.is_whitespace() {
                if !out.ends_with(' ') {
                    out.push(' ');
                }
                continue;
            }
            if is_part(first) && !first.is_ascii_digit() {
                if self.kind == Kind::LPy {
                    let word = python_word(token, &mut rest)?;
                    valued = !matches!(token, "and" | "or" | "not");
                    let curve = self.curves.iter().find(|(name, _)| name == token).filter(|_| opened.starts_with('('));
                    if let Some((_, own)) = curve {
                        let wrong = || say!("The curve `{}` is no clamped cubic with weights of 1", token);
                        out.push_str(own.as_ref().ok_or_else(wrong)?);
                        continue;
                    }
                    out.push_str(word);
                    self.check_function(word, opened)?;
                    continue;
                }
                valued = true;
                if let Some(inside) = opened.strip_prefix('[') {
                    rest = self.element(token, inside, &mut out)?;
                    continue;
                }
                if token == "func"
                    && let Some(inside) = opened.strip_prefix('(')
                {
                    rest = self.curve(inside, &mut out)?;
                    valued = false;
                    continue;
                }
                self.check_function(token, opened)?;
                out.push_str(token);
                continue;
            }
            match (first, self.kind) {
                ('"' | '\'', _) => return Err(say!("Texts in arithmetic are not read")),
                ('?', Kind::Cpfg) => return Err(say!("The choice `? :` is not read")),
                ('[' | '{' | ']' | '}', _) => return Err(say!("Lists in arithmetic are not read")),
                ('<', Kind::Cpfg) if opened.starts_with('>') && rest.starts_with('>') => {
                    out.push_str("!=");
                    rest = &rest[1..];
                }
                ('*', Kind::LPy) if rest.starts_with('*') => {
                    out.push('^');
                    rest = &rest[1..];
                }
                ('/', Kind::LPy) if rest.starts_with('/') => {
                    return Err(say!("The whole division `//` of Python has no equal here"));
                }
                ('^' | '~', Kind::LPy) => return Err(say!("`{}` of Python works on bits", first)),
                ('&' | '|', _) if rest.starts_with(first) => {
                    out.extend([first, first]);
                    rest = &rest[1..];
                }
                ('&', Kind::Cpfg) if !valued => return Err(say!("The address `&` of a number is not read")),
                // In cpfg a sign binds tighter than `^`.
                ('-', Kind::Cpfg) if !valued && self.is_power(opened) => {
                    return Err(say!("`-` in front of a power needs parentheses here"));
                }
                _ => out.push(first),
            }
            valued = first.is_ascii_digit() || first == ')';
            if first.is_ascii_digit() {
                // The rest of the number.
                out.push_str(&token[1..]);
                if token.ends_with(['e', 'E']) && rest.starts_with(['+', '-']) {
                    out.push_str(&rest[..1]);
                    rest = &rest[1..];
                }
            }
        }
        Ok(out.trim().to_owned())
    }

    /// Whether a power stands at the start: a name or a number before `^`.
    fn is_power(&self, text: &str) -> bool {
        let Some(base) = token(text) else { return false };
        let Some(behind) = text[base.len()..].trim_start().strip_prefix('^') else { return false };
        is_part(base.chars().next().unwrap_or_default()) && !behind.is_empty()
    }

    fn check_function(&self, name: &str, behind: &str) -> Result<(), Wrong> {
        if !behind.starts_with('(') || FUNCTIONS.contains(&name) || matches!(name, "" | "and" | "or") {
            return Ok(());
        }
        Err(match (name, self.kind) {
            (_, Kind::Cpfg) => say!("The function `{}` of cpfg has no equal here", name),
            (_, Kind::LPy) => say!("Python code is not run: `{}(...)`", name),
        })
    }

    /// Writes the beginning of a curve's value, up to its argument, for `func(1, x)` or `func(taper, x)`; `inside` begins
    /// behind the parenthesis. Returns the text of the argument and behind.
    fn curve<'t>(&self, inside: &'t str, out: &mut String) -> Result<&'t str, Wrong> {
        let Some((which, rest)) = inside.split_once(',') else { return Err(say!("`func` needs two arguments")) };
        let which = which.trim();
        let named = self.curves.iter().find(|(name, _)| name == which);
        let found = named.or_else(|| self.curves.get((self.value(which)? as usize).checked_sub(1)?));
        let Some((_, Some(name))) = found else {
            return Err(say!("`func` reads a curve of another file, which is not given or cannot be read"));
        };
        out.extend([name, "("]);
        Ok(rest)
    }

    /// Writes an element of an array as arithmetic; `inside` begins behind the bracket. Returns the text behind.
    fn element<'t>(&self, name: &str, inside: &'t str, out: &mut String) -> Result<&'t str, Wrong> {
        let Some(elements) = self.arrays.get(name) else {
            return Err(say!("The array `{}` is not known, or it changes while the system grows", name));
        };
        let end = inside.find([']', '[']).filter(|end| inside[*end..].starts_with(']'));
        let Some(end) = end else { return Err(say!("The index of an array is not read")) };
        let (index, behind) = (&inside[..end], &inside[end + 1..]);
        if behind.trim_start().starts_with('[') {
            return Err(say!("Arrays of several dimensions are not read"));
        }
        if let Some(value) = self.value(index) {
            let value =
                elements.get(value as usize).ok_or_else(|| say!("The index of an array is out of its range"))?;
            out.push_str(&number(*value));
            return Ok(behind);
        }
        if elements.len() > 64 {
            return Err(say!("An array of so many numbers is not read"));
        }
        let index = self.translate(index)?;
        let parts: Vec<String> = elements
            .iter()
            .enumerate()
            .map(|(at, value)| format!("(floor({index}) == {at})*{}", number(*value)))
            .collect();
        let parts = parts.join(" + ");
        self.macros.spend(parts.len())?;
        out.extend(["(", &parts, ")"]);
        Ok(behind)
    }
}

/// A word of Python in our arithmetic. Names of modules such as `math.` are left out.
fn python_word<'t>(word: &'t str, rest: &mut &str) -> Result<&'t str, Wrong> {
    match word {
        "math" | "random" | "rd" | "np" | "numpy" if rest.starts_with('.') => {
            *rest = &rest[1..];
            Ok("")
        }
        "True" => Ok("1"),
        "False" => Ok("0"),
        "if" | "else" | "lambda" | "for" | "in" | "is" | "None" => {
            Err(say!("Python code is not run: `{}` in arithmetic", word))
        }
        _ if rest.starts_with('.') => Err(say!("Python code is not run: `{}.`", word)),
        _ => Ok(word),
    }
}
