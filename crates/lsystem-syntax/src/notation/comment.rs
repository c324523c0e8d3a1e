//! Comments between `/*` and `*/`, which may span lines.

use crate::Class;
use crate::notes::DiagnosticList;
use lsystem_base::say;
use std::borrow::Cow;

/// The text with spaces in place of its comments, so that all places stay the same. Line ends stay. A comment that is
/// never closed ends with its line, and is noted.
pub(super) fn without_comments<'a>(text: &'a str, notes: &mut DiagnosticList) -> Cow<'a, str> {
    if !text.contains("/*") {
        return text.into();
    }
    let mut plain = text.as_bytes().to_vec();
    let mut at = 0;
    while let Some(found) = text[at..].find(['/', '`']) {
        let start = at + found;
        let rest = &text[start..];
        if let Some(literal) = rest.strip_prefix('`') {
            // A character in backquotes is a symbol.
            let character = literal.chars().next().map_or(0, char::len_utf8);
            at = start + 1 + character + usize::from(literal[character..].starts_with('`'));
        } else if let Some(inside) = rest.strip_prefix("/*") {
            let closed = inside.find("*/").map(|length| length + 4);
            let end = start + closed.unwrap_or_else(|| rest.find(['\n', '\r']).unwrap_or(rest.len()));
            if closed.is_none() {
                notes.warn(start..start + 2, say!("This comment is never closed"), say!("Add `*/`."));
            }
            notes.class(Class::Comment, start..end);
            plain[start..end].iter_mut().filter(|byte| !matches!(byte, b'\n' | b'\r')).for_each(|byte| *byte = b' ');
            at = end;
        } else {
            at = start + 1;
        }
    }
    // Whole characters were replaced, so the bytes are still UTF-8.
    String::from_utf8(plain).map_or_else(|_| text.into(), Cow::Owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_become_spaces() {
        for (text, expected) in [
            ("F/*é*/F", "F      F"),
            ("a /* b\nc */ d", "a     \n     d"),
            ("`/`*F*/ /**/", "`/`*F*/     "),
            ("F /* open\nG", "F        \nG"),
            ("/`*`F`", "/`*`F`"),
        ] {
            let mut notes = DiagnosticList::new(crate::Field::Rules);
            assert_eq!(without_comments(text, &mut notes), expected);
            assert_eq!(notes.finish().len(), usize::from(text.contains("open")));
        }
    }
}
