//! Local assignments of cpfg's productions: `A(x) : {y = x + 1;} y < 3 {z = 2 * y;} --> A(z)`. The values are written in
//! place of the names.

use super::macros::{is_part, token};

/// The most characters of a production with its values in place.
const LONGEST: usize = 4000;

/// The most names with values.
const MOST_VALUES: usize = 100;

/// The reason for other code.
const OTHER: &str = "Of the code in a production, only assignments are read";

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
    let condition = values.put(condition.trim(), 1).ok_or(OTHER)?;
    values.assign_all(second, is_global)?;
    let successor = values.put(successor, 0).ok_or(OTHER)?;
    Ok((condition, successor))
}

/// The values of names, by the last assignment.
#[derive(Clone, Debug, Default)]
pub(super) struct Values(Vec<(String, String)>);

impl Values {
    /// Reads assignments. Code that only prints has no effect.
    fn assign_all(&mut self, block: &str, is_global: &dyn Fn(&str) -> bool) -> Result<(), &'static str> {
        for statement in block.split(';').map(str::trim).filter(|statement| !statement.is_empty()) {
            if prints(statement) {
                continue;
            }
            let (name, value) = assignment(statement).ok_or(OTHER)?;
            if is_global(name) {
                return Err("This code changes a number of the whole system while it grows, which has no equal here");
            }
            self.assign(name, value).ok_or(OTHER)?;
        }
        Ok(())
    }

    /// Assigns a value in which earlier names may stand; `None` if it becomes too long.
    pub(super) fn assign(&mut self, name: &str, value: &str) -> Option<()> {
        let value = self.put(value.trim(), 1)?;
        self.0.retain(|(known, _)| known != name);
        if self.0.len() >= MOST_VALUES {
            return None;
        }
        self.0.push((name.to_owned(), value));
        Some(())
    }

    /// Writes values in place of names inside parentheses; `depth` is 1 for arithmetic, which is inside already. `None`
    /// if that becomes too long.
    pub(super) fn put(&self, text: &str, mut depth: usize) -> Option<String> {
        if self.0.is_empty() {
            return Some(text.to_owned());
        }
        let mut out = String::new();
        let mut rest = text;
        while let Some(ch) = rest.chars().next() {
            depth = (depth + usize::from(ch == '(')).saturating_sub(usize::from(ch == ')'));
            let word = if depth > 0 { token(rest)? } else { &rest[..ch.len_utf8()] };
            match self.0.iter().find(|(name, _)| depth > 0 && name == word) {
                Some((_, value)) => out.extend(["(", value, ")"]),
                None => out.push_str(word),
            }
            if out.len() > LONGEST {
                return None;
            }
            rest = &rest[word.len()..];
        }
        Some(out)
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
