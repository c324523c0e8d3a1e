//! Local assignments of cpfg's productions: `A(x) : {y = x + 1;} y < 3 {z = 2 * y;} --> A(z)`. The values are written
//! in place of the names.

use super::macros::{is_part, token};
use core::cell::Cell;
use lsystem_base::word;

/// The most characters of a production with its values in place.
const LONGEST: usize = 4000;

/// The most names with values.
const MAX_VALUES: usize = 100;

/// The reason for other code.
const OTHER: &str = word!("Of the code in a production, only assignments are read");

/// A condition and a successor without the blocks of assignments of the condition. `is_global` names numbers of the
/// whole system.
pub(super) fn inlined(
    condition: &str,
    successor: &str,
    is_global: &dyn Fn(&str) -> bool,
) -> Result<(String, String), &'static str> {
    let (first, rest) = match condition.trim_start().strip_prefix('{') {
        Some(inside) => inside.split_once('}').ok_or(OTHER)?,
        None => ("", condition),
    };
    let (condition, second) = match rest.split_once('{') {
        Some((condition, second)) => (condition, second.trim_end().strip_suffix('}').ok_or(OTHER)?),
        None => (rest, ""),
    };
    let mut values = Values::default();
    values.assign_all(first, is_global)?;
    let condition = values.put(condition.trim(), 1)?;
    values.assign_all(second, is_global)?;
    let successor = values.put(successor, 0)?;
    Ok((condition, successor))
}

/// The reason for values that become too long in their places.
pub(super) const TOO_LONG: &str = word!("This rule becomes too long with values in place of names");

/// The functions whose values are random, in cpfg and in Python.
const RANDOM: [&str; 6] = ["ran(", "random(", "uniform(", "gauss(", "normalvariate(", "randint("];

/// The reason for one random number in several places.
pub(super) const SEVERAL: &str = word!("A random number that is used several times has no equal here");

/// Whether arithmetic has random numbers.
pub(super) fn is_random(text: &str) -> bool {
    RANDOM.iter().any(|name| text.contains(name))
}

/// The values of names, by the last assignment.
#[derive(Clone, Debug, Default)]
pub(super) struct Values(Vec<Value>);

#[derive(Clone, Debug)]
struct Value {
    name: String,
    text: String,
    /// Whether a random value was written already.
    used: Cell<bool>,
}

impl Values {
    /// Reads assignments. Code that only prints has no effect.
    fn assign_all(&mut self, block: &str, is_global: &dyn Fn(&str) -> bool) -> Result<(), &'static str> {
        for statement in block.split(';').map(str::trim).filter(|statement| !statement.is_empty()) {
            if prints(statement) {
                continue;
            }
            let (name, value) = assignment(statement).ok_or(OTHER)?;
            if is_global(name) {
                return Err(word!(
                    "This code changes a number of the whole system while it grows, which has no equal here"
                ));
            }
            self.assign(name, value)?;
        }
        Ok(())
    }

    /// Assigns a value in which earlier names may stand.
    pub(super) fn assign(&mut self, name: &str, value: &str) -> Result<(), &'static str> {
        let text = self.put(value.trim(), 1)?;
        self.0.retain(|known| known.name != name);
        if self.0.len() >= MAX_VALUES {
            return Err(TOO_LONG);
        }
        self.0.push(Value { name: name.to_owned(), text, used: Cell::new(false) });
        Ok(())
    }

    /// Writes values in place of names inside parentheses; `depth` is 1 for arithmetic, which is inside already.
    pub(super) fn put(&self, text: &str, mut depth: usize) -> Result<String, &'static str> {
        if self.0.is_empty() {
            return Ok(text.to_owned());
        }
        let mut out = String::new();
        let mut rest = text;
        while let Some(ch) = rest.chars().next() {
            depth = (depth + usize::from(ch == '(')).saturating_sub(usize::from(ch == ')'));
            let word = if depth > 0 { token(rest).unwrap_or(rest) } else { &rest[..ch.len_utf8()] };
            match self.0.iter().find(|value| depth > 0 && value.name == word) {
                Some(value) => {
                    // Written twice, it would be two random numbers.
                    if is_random(&value.text) && value.used.replace(true) {
                        return Err(SEVERAL);
                    }
                    out.extend(["(", &value.text, ")"]);
                }
                None => out.push_str(word),
            }
            if out.len() > LONGEST {
                return Err(TOO_LONG);
            }
            rest = &rest[word.len()..];
        }
        Ok(out)
    }
}

/// The name and the value of `name = value`.
pub(super) fn assignment(statement: &str) -> Option<(&str, &str)> {
    let (name, value) = statement.split_once('=')?;
    let (name, value) = (name.trim(), value.trim());
    (is_name(name) && !value.is_empty() && !value.contains(['=', '{', '"'])).then_some((name, value))
}

/// Whether a text is a name.
pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_') && text.chars().all(is_part)
}

/// Whether a statement only writes texts.
pub(super) fn prints(statement: &str) -> bool {
    ["printf", "fprintf", "print", "fflush", "fopen", "fclose"].iter().any(|name| {
        statement.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('(') && rest.ends_with(')'))
    })
}
