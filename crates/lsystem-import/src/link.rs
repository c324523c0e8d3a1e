//! Links of our own page, in the readable and in the compressed form: `#v=1&axiom=F&rules=F%20-%3E%20FF`. Each link of a
//! text is a system. A text of links alone is read before all others, and links in other texts behind all others.

use crate::MAX_ENTRIES;
use crate::draft::Draft;
use crate::source::Source;
use lsystem_base::say;
use lsystem_files::link::{fields_of, read_fields};
use lsystem_files::read_link;
use lsystem_syntax::FIELDS;
use lsystem_syntax::notes::excerpt;
use std::collections::HashMap;

/// Keys of links that are not of the system: how it is shown, and exercises.
const OTHERS: [&str; 9] = ["v", "z", "controls", "theme", "host", "x", "by", "hand", "film"];

/// Keys of which a link of a system has one.
const SYSTEM: [&str; 3] = ["axiom", "rules", "z"];

/// The most compressed links of a text: a short link may unpack to a long system.
const MAX_PACKED: usize = 100;

/// The links in a text of links alone.
pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    links(source, source.text.split_whitespace().map(without_marks), |_| None)
}

/// The links in any text.
pub(super) fn read_within<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let words = source.text.split_whitespace().map(|word| without_marks(word).trim_end_matches(['.', ',', ';']));
    links(source, words, Some).filter(|drafts| !drafts.is_empty())
}

/// Reads all words that are links; at other words `other` decides whether to go on.
fn links<'a>(
    source: Source<'a>,
    words: impl Iterator<Item = &'a str>,
    other: fn(Vec<Draft<'a>>) -> Option<Vec<Draft<'a>>>,
) -> Option<Vec<Draft<'a>>> {
    let (mut drafts, mut packed) = (Vec::new(), 0);
    for word in words {
        match link(source, word, &mut packed) {
            Some(draft) => drafts.push(draft),
            None => drafts = other(drafts)?,
        }
        if drafts.len() > MAX_ENTRIES {
            break;
        }
    }
    Some(drafts)
}

/// A word without the brackets and quotes around a link in it. Links have none of these characters.
fn without_marks(word: &str) -> &str {
    let Some(hash) = word.find('#') else { return word };
    let start = word[..hash].rfind(['(', '<', '"', '`', '[']).map_or(0, |at| at + 1);
    let end = word[hash..].find([')', '>', '"', '`', ']']).map_or(word.len(), |at| hash + at);
    &word[start..end]
}

/// Reads a word; `None` if it is no link. `compressed` counts the compressed links.
fn link<'a>(source: Source<'a>, word: &'a str, compressed: &mut usize) -> Option<Draft<'a>> {
    let (before, hash) = word.split_once('#')?;
    let is_address = before.is_empty() || before.contains("://") || before.ends_with(".html") || before.ends_with('/');
    let has = |name: &str| fields_of(hash).any(|(key, _)| key == name);
    if !is_address || !has("v") || !SYSTEM.iter().any(|key| has(key)) {
        return None;
    }
    let place = source.place(word)?;
    let mut draft = Draft::new(source, "", source.line_of(place.start));
    draft.covers(place.clone());
    *compressed += usize::from(has("z"));
    if has("z") && *compressed > MAX_PACKED {
        draft.refuse_at(place, say!("A text may have {} compressed links", MAX_PACKED));
        return Some(draft);
    }
    let link = read_link(word)?;
    draft.pass(place.clone());
    for part in hash.split('&').filter(|part| part.find('=').is_none_or(|at| at == 0) && !part.is_empty()) {
        draft.note_at(draft.place(part), say!("This is no field of a link"));
    }
    let mut problems = link.problems;
    let mut last: HashMap<&str, &str> = HashMap::new();
    for (key, value) in fields_of(hash) {
        let place = draft.place(key).start..draft.place(value).end;
        let is_known = FIELDS.iter().any(|spec| spec.link == key && spec.is_defined());
        if is_known && let Some(old) = last.insert(key, value) {
            draft.note_at(draft.place(old), say!("A later `{}` replaces this one", key));
        }
        // The problems of this field alone, to know their place.
        let mut own = if key == "z" { Vec::new() } else { read_fields([(key, value)].into_iter()).problems };
        own.retain(|own| problems.iter().position(|other| other == own).map(|at| problems.swap_remove(at)).is_some());
        if is_known {
            draft.read(place, format!("{key} {value}"));
        } else if OTHERS.contains(&key) || FIELDS.iter().any(|spec| spec.link == key) {
            draft.pass(place);
        } else {
            draft.note_at(draft.place(key), say!("The key `{}` is unknown", excerpt(key)));
            draft.pass(draft.place(value));
        }
        own.into_iter().for_each(|own| draft.note_at(draft.place(value), own.message));
    }
    draft.definition = link.definition;
    (draft.has_iterations, draft.is_ours) = (true, true);
    // The rest is about the compressed part, or about the link as a whole.
    let packed = fields_of(hash).filter(|(key, _)| *key == "z").last().map(|(_, value)| value);
    for problem in problems {
        draft.note_at(draft.place(packed.unwrap_or(hash)), problem.message);
    }
    if let Some(packed) = packed {
        draft.read(draft.place(packed), say!("a compressed system"));
    }
    if draft.definition.axiom.is_empty() {
        draft.refuse_at(place, say!("The link gives no axiom"));
    }
    Some(draft)
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cases() {
        check(
            "#v=1&title=Koch%20island&axiom=F-F-F-F&rules=F%20-%3E%20F-F+F+FF-F-F+F&n=3&angle=90",
            expect![[r#"
                a link
                []
                n 3, angle 90, heading 90, abop
                  F-F-F-F
                  F -> F-F+F+FF-F-F+F"#]],
        );
        check(
            "https://example.org/l/#v=1&axiom=A&rules=A%20-%3E%20FA%0AF%20-%3E%20FF&n=x&do=A%3A%20draw&start=1,2&palette=ff0000,00ff00&hue=1000&moon=1&view=1,2,3",
            expect![[r#"
                a link
                []
                n 1, angle 0, heading 90, abop
                  A
                  A -> FA
                  F -> FF
                  | A: draw
                note 1 "x": The value of `n` must be a whole number from 0 to 1,000; it was left out
                note 1 "1000": The value of `hue` must be a number from -360 to 360; the nearest value was taken
                note 1 "moon": The key `moon` is unknown"#]],
        );
        check(
            "#v=1&z=eNpLrMjMz7",
            expect![[r##"
            a link
            []
            note 1 "eNpLrMjMz7": The compressed part of the link is damaged or cut off and was not read
            refused 1 "#v=1&z=eNpLrMjMz7": The link gives no axiom"##]],
        );
        check(
            "https://example.org/l/#v=1&z=eNpLrMjMz7WNUCsqzUktto1Q0LVTcIvWjoh1i9aNiNWO4HIDi7ip5dmaqiXmpeek2hqZ6pkDAMlCD48",
            expect![[r#"
                a link
                []
                n 5, angle 25.7, heading 90, abop
                  X
                  X -> F[+X]F[-X]+X
                  F -> FF"#]],
        );
        check(
            "#v=1&axiom=F&n=2\n<#v=1&axiom=FF&n=3&n=4>\n",
            expect![[r#"
            a link
            []
            n 2, angle 0, heading 90, abop
              F
            []
            n 4, angle 0, heading 90, abop
              FF
            note 2 "3": A later `n` replaces this one"#]],
        );
        check(
            "#v=1&rules=F%20-%3E%20FF",
            expect![[r##"
            a link
            []
            refused 1 "#v=1&rules=F%20-%3E%20FF": The link gives no axiom"##]],
        );
        check("#v=1&n=3", expect!["not recognised"]);
        check(
            "See [the line](https://example.org/#v=1&axiom=F&n=2), and (#v=1&axiom=G).",
            expect![[r#"
            a link
            []
            n 2, angle 0, heading 90, abop
              F
            []
            n 1, angle 0, heading 90, abop
              G"#]],
        );
        check(
            "See https://example.org/#v=1&axiom=F&n=2.",
            expect![[r#"
            a link
            []
            n 2, angle 0, heading 90, abop
              F"#]],
        );
        check("See issue #5 (v=1&axiom=F)", expect!["not recognised"]);
    }
}
