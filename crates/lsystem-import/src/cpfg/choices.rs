//! The choice `condition ? one : other` of cpfg's arithmetic, which ours has not: a sum of which one part is 0.

use super::assignments::is_random;
use super::macros::{Macros, arguments};
use lsystem_base::word;

/// The most choices and parentheses inside one another, which are read recursively.
const DEEPEST: usize = 50;

/// Arithmetic with sums in place of choices: `c ? a : b` becomes `(((c) != 0)*(a) + ((c) == 0)*(b))`.
pub(super) fn without_choices(text: &str, macros: &Macros) -> Result<String, &'static str> {
    if text.contains('?') { whole(text, macros, 0) } else { Ok(text.to_owned()) }
}

/// Arithmetic whose parts are separated by commas.
fn whole(text: &str, macros: &Macros, depth: usize) -> Result<String, &'static str> {
    if depth > DEEPEST {
        return Err(word!("These choices `? :` are too deep inside one another"));
    }
    macros.spend(text.len())?;
    let closed = format!("{text})");
    let parts = arguments(&closed).filter(|(_, behind)| behind.is_empty()).map(|(parts, _)| parts);
    let parts = parts.ok_or(word!("The parentheses of a choice `? :` do not match"))?;
    let read: Result<Vec<String>, _> = parts.into_iter().map(|part| one(part, macros, depth)).collect();
    Ok(read?.join(","))
}

/// Arithmetic without commas outside of parentheses.
fn one(text: &str, macros: &Macros, depth: usize) -> Result<String, &'static str> {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(['(', '?']) {
        let behind = &rest[at + 1..];
        if rest[at..].starts_with('?') {
            out.push_str(&rest[..at]);
            let end = other(behind).ok_or(word!("The choice `?` has no `:`"))?;
            let (first, second) =
                (one(&behind[..end], macros, depth + 1)?, one(&behind[end + 1..], macros, depth + 1)?);
            if is_random(&out) {
                return Err(word!("A choice `? :` by chance is not read"));
            }
            macros.spend(2 * out.len() + first.len() + second.len())?;
            return Ok(format!("((({out}) != 0)*({first}) + (({out}) == 0)*({second}))"));
        }
        let (_, after) = arguments(behind).ok_or(word!("The parentheses of a choice `? :` do not match"))?;
        let inside = &behind[..behind.len() - after.len() - 1];
        out.push_str(&rest[..=at]);
        out.push_str(&whole(inside, macros, depth + 1)?);
        out.push(')');
        rest = after;
    }
    out.push_str(rest);
    Ok(out)
}

/// The place of the `:` that belongs to the `?` before the text.
fn other(text: &str) -> Option<usize> {
    let (mut depth, mut choices) = (0_usize, 0_usize);
    text.char_indices().find_map(|(at, ch)| {
        match ch {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            '?' if depth == 0 => choices += 1,
            ':' if depth == 0 && choices == 0 => return Some(at),
            ':' if depth == 0 => choices -= 1,
            _ => {}
        }
        None
    })
}
