//! The macros of the preprocessor, and functions that are written in place of others.

use lsystem_base::word;
use std::cell::Cell;
use std::collections::BTreeMap;

/// All macros of a text.
pub(super) struct Macros {
    known: BTreeMap<String, Macro>,
    /// How many characters may still be written.
    work: Cell<usize>,
    /// How many texts are being written inside one another.
    depth: Cell<usize>,
}

struct Macro {
    /// The names of its parameters; `None` for a macro without parentheses.
    parameters: Option<Vec<String>>,
    body: String,
    /// Whether the macro is also a constant, which arithmetic leaves as it stands.
    is_constant: bool,
    /// Whether the text defines the macro, which then also counts where symbols stand.
    is_own: bool,
}

/// What is replaced.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Replaced {
    All,
    /// All but constants.
    Texts,
}

/// The most characters that are written for a text.
const MAX_WORK: usize = 4_000_000;
/// The most macros inside one another: they are replaced recursively.
const DEEPEST: usize = 50;
/// The reason for a text that is too long.
pub(super) const TOO_LONG: &str = word!("Macros or loops make this too long");

impl Macros {
    /// Functions of another program in words of ours, from the lines of `functions.txt` that begin so.
    pub(super) fn new(program: &str) -> Self {
        let mut macros = Self { known: BTreeMap::new(), work: Cell::new(MAX_WORK), depth: Cell::new(0) };
        for line in include_str!("functions.txt").lines().filter_map(|line| line.strip_prefix(program)) {
            let Some((name, (parameters, body))) =
                line.split_once('(').and_then(|(name, rest)| Some((name, rest.split_once(") = ")?)))
            else {
                continue;
            };
            let parameters = parameters.split(", ").filter(|name| !name.is_empty()).map(str::to_owned).collect();
            macros.define(name.to_owned(), Some(parameters), body.to_owned(), false);
        }
        macros.known.values_mut().for_each(|known| known.is_own = false);
        macros
    }

    /// Defines a macro. Returns whether it takes the place of another.
    pub(super) fn define(
        &mut self,
        name: String,
        parameters: Option<Vec<String>>,
        body: String,
        is_constant: bool,
    ) -> bool {
        self.known.insert(name, Macro { parameters, body, is_constant, is_own: true }).is_some()
    }

    /// Forgets a constant.
    pub(super) fn forget(&mut self, name: &str) {
        self.known.remove(name);
    }

    pub(super) fn len(&self) -> usize {
        self.known.len()
    }

    /// Whether this is the name of a macro of the text with parameters.
    pub(super) fn has_parameters(&self, name: &str) -> bool {
        self.known.get(name).is_some_and(|found| found.is_own && found.parameters.is_some())
    }

    /// The text with macros replaced, as the preprocessor replaces them: where a whole name stands. An error if that
    /// takes too long.
    pub(super) fn expand(&self, text: &str, replaced: Replaced) -> Result<String, &'static str> {
        if self.known.is_empty() {
            return Ok(text.to_owned());
        }
        let mut out = String::new();
        self.depth.set(0);
        self.write(text, replaced, &mut Vec::new(), &mut out)?;
        Ok(out)
    }

    fn write<'m>(
        &'m self,
        text: &str,
        replaced: Replaced,
        active: &mut Vec<&'m str>,
        out: &mut String,
    ) -> Result<(), &'static str> {
        self.spend(text.len())?;
        let depth = self.depth.get();
        if depth >= DEEPEST {
            return Err(TOO_LONG);
        }
        self.depth.set(depth + 1);
        let mut rest = text;
        while let Some(token) = token(rest) {
            let behind = &rest[token.len()..];
            rest = behind;
            let found = self.known.get_key_value(token).filter(|(name, found)| {
                !active.contains(&name.as_str()) && (replaced == Replaced::All || !found.is_constant)
            });
            let Some((name, found)) = found else {
                out.push_str(token);
                continue;
            };
            let body = match &found.parameters {
                None => found.body.clone(),
                Some(parameters) => {
                    let opened = behind.trim_start();
                    let Some((arguments, after)) = opened.strip_prefix('(').and_then(arguments) else {
                        // The text behind was searched in vain.
                        self.spend(if opened.starts_with('(') { opened.len() } else { 0 })?;
                        out.push_str(token);
                        continue;
                    };
                    let given = if parameters.is_empty() && arguments == [""] { 0 } else { arguments.len() };
                    if given != parameters.len() {
                        out.push_str(token);
                        continue;
                    }
                    rest = after;
                    let mut values = Vec::new();
                    for argument in arguments {
                        let mut value = String::new();
                        self.write(argument.trim(), replaced, active, &mut value)?;
                        values.push(value);
                    }
                    self.filled(&found.body, parameters, &values)?
                }
            };
            if !found.is_own {
                // The words of ours are final: read again, an argument would be turned into our units twice.
                out.push_str(&body);
                continue;
            }
            active.push(name);
            self.write(&body, replaced, active, out)?;
            active.pop();
        }
        self.depth.set(depth);
        Ok(())
    }

    /// The body of a macro with the values of its parameters.
    fn filled(&self, body: &str, parameters: &[String], values: &[String]) -> Result<String, &'static str> {
        let mut out = String::new();
        let mut rest = body;
        while let Some(token) = token(rest) {
            rest = &rest[token.len()..];
            let value = parameters.iter().position(|name| name == token).and_then(|at| values.get(at));
            let part = value.map_or(token, String::as_str);
            self.spend(part.len())?;
            out.push_str(part);
        }
        Ok(out)
    }

    /// Counts work; an error when too much is done.
    pub(super) fn spend(&self, work: usize) -> Result<(), &'static str> {
        self.work.set(self.work.get().checked_sub(work + 1).ok_or(TOO_LONG)?);
        Ok(())
    }
}

/// The first token of a text: a name, a number, or one other character.
pub(super) fn token(text: &str) -> Option<&str> {
    let first = text.chars().next()?;
    let is_number = first.is_ascii_digit();
    let end = if is_part(first) {
        text.find(|c: char| !(is_part(c) || is_number && c == '.')).unwrap_or(text.len())
    } else {
        first.len_utf8()
    };
    Some(&text[..end])
}

/// Whether a name may contain the character.
pub(super) fn is_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The arguments up to the parenthesis that closes, and the text behind it.
pub(super) fn arguments(inside: &str) -> Option<(Vec<&str>, &str)> {
    let (mut depth, mut from) = (0_usize, 0);
    let mut found = Vec::new();
    for (at, ch) in inside.char_indices() {
        match ch {
            '(' | '[' | '{' => depth += 1,
            ')' if depth == 0 => {
                found.push(&inside[from..at]);
                return Some((found, &inside[at + 1..]));
            }
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                found.push(&inside[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    None
}
