//! Our own JSON and that of the course, as `read_json` reads it.
//!
//! The problems of the file are the remarks, at their places. An error refuses the system.

use crate::draft::Draft;
use crate::source::Source;
use lsystem_files::read_json;

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text.trim_start_matches('\u{feff}').trim_start();
    if !text.starts_with(['{', '/']) || !has_key(text, "initial") {
        return None;
    }
    let (definition, diagnostics) = read_json(source.text);
    // Other texts with comments and braces may have such a word, too.
    if definition.is_none() && !text.starts_with('{') {
        return None;
    }
    let all = source.text.trim();
    let mut draft = Draft::new(source, "", 1);
    draft.covers(draft.place(all));
    if let Some(definition) = definition {
        draft.read(draft.place(all), "the system");
        draft.definition = definition;
    }
    (draft.has_iterations, draft.keeps_overrides) = (true, true);
    for diagnostic in diagnostics {
        let hint = diagnostic.hint().map_or(String::new(), |hint| format!(". {hint}"));
        let message = format!("{}{hint}", diagnostic.message());
        if diagnostic.is_error() {
            draft.refuse_at(diagnostic.span, message);
        } else {
            draft.note_at(diagnostic.span, message);
        }
    }
    Some(vec![draft])
}

/// Whether a text has a key of JSON: the word, perhaps in quotes, before a colon.
fn has_key(text: &str, key: &str) -> bool {
    text.match_indices(key).any(|(at, _)| {
        let (before, behind) = (text[..at].chars().next_back(), &text[at + key.len()..]);
        let behind = behind.strip_prefix(['"', '\'']).unwrap_or(behind);
        let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '$' | '-');
        !before.is_some_and(is_part) && behind.trim_start().starts_with(':')
    })
}

#[cfg(test)]
mod tests {
    use crate::import;
    use crate::tests::check;
    use expect_test::expect;
    use lsystem_files::{read_json, write_json};
    use lsystem_syntax::{Definition, Dialect, Style};

    #[test]
    fn cases() {
        check(r#"{"initial": "F", "rules": {"F": "F+F"}, "angle_deg": 60, "num_iters": 2}"#, expect![[r#""#]]);
        check(r#"{"initial": "F", "rules": ["F -> F+F"], "turtle": {"overrides": {"G": "move"}}}"#, expect![[r#""#]]);
        check("// a comment\n{initial: 'F', rules: ['F -> FF : 0.5'], turtle: {}, moon: 1}", expect![[r#""#]]);
        check("{\"initial\": \"F\",\n \"rules\": {\"F\": \"FF\"}", expect![[r#""#]]);
        check("{\"initial\": \"F\", \"rules\": {\"F\" \"FF\"}}", expect![[r#""#]]);
        check("{\"initial\": \"F\", \"rules\": [\"F -> F(\"], \"turtle\": {}}", expect![[r#""#]]);
        check("{\"initial\": \"F\", \"rules\": {\"F\": [{\"p\": 0.5, \"e\": \"FF\"}]}}", expect![[r#""#]]);
        check("{\"initial_line_width\": 1, \"axiom\": \"F\"}", expect!["not recognised"]);
    }

    /// What is written is read in the same way, without a remark.
    #[test]
    fn files_are_read_as_read_json_does() {
        let course = Definition {
            axiom: "F".into(),
            rules: "F -> FF".into(),
            dialect: Dialect::EveryLetter,
            style: Style::course(),
            ..Definition::default()
        };
        let ours = Definition {
            name: "a".into(),
            title: "A \"title\"".into(),
            axiom: "A(1)".into(),
            rules: "r = 0.9\nA(l) : l > 0.1 -> F(l)[+A(l*r)] : 2\ndraw:\nA -> F".into(),
            overrides: "G: move".into(),
            angle: 22.5,
            ..Definition::default()
        };
        for definition in [course, ours] {
            let text = write_json(&definition);
            let imported = import(&text).unwrap();
            assert_eq!(imported.notation, "our own JSON");
            let [entry] = &imported.entries[..] else { panic!("{imported:?}") };
            assert_eq!(entry.definition, read_json(&text).0);
            assert_eq!((entry.definition.as_ref(), &entry.remarks[..]), (Some(&definition), &[][..]), "{text}");
        }
    }
}
