//! Our own JSON and that of the course, as `read_json` reads it.
//!
//! The problems of the file are the remarks, at their places. An error refuses the system.

use crate::draft::Draft;
use crate::source::Source;
use core::ops::Range;
use lsystem_base::say;
use lsystem_drawing::System;
use lsystem_files::read_json;
use lsystem_syntax::{Definition, Diagnostic};

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let all = source.text.trim_start_matches('\u{feff}').trim();
    let (text, from) = (all, source.place(all)?.start);
    if !text.starts_with(['{', '/']) || !has_key(text, "initial") {
        return None;
    }
    let (definition, diagnostics) = read_json(text);
    // Other texts with comments and braces may have such a word, too.
    if definition.is_none() && !text.starts_with('{') {
        return None;
    }
    let mut draft = Draft::new(source, "", source.line_of(from));
    draft.covers(draft.place(all));
    draft.read(draft.place(all), say!("the system"));
    (draft.has_iterations, draft.is_ours) = (true, true);
    for diagnostic in diagnostics {
        let hint = diagnostic.hint.as_ref().map_or(String::new(), |hint| format!(". {hint}"));
        let message = format!("{}{hint}", diagnostic.message);
        let place = from + diagnostic.span.start..from + diagnostic.span.end;
        if diagnostic.is_error() {
            draft.refuse_at(place, message);
        } else {
            draft.note_at(place, message);
        }
    }
    if let Some(definition) = definition {
        if let Some(error) = System::problems(&definition).iter().find(|problem| problem.is_error())
            && let Some(place) = place_of(source.text, &definition, error)
        {
            draft.refuse_at(place, error.message.clone());
        }
        draft.definition = definition;
    }
    Some(vec![draft])
}

/// The place of a problem with a definition in the text of its file: of the line with the problem, if it stands there
/// without escapes.
fn place_of(text: &str, definition: &Definition, problem: &Diagnostic) -> Option<Range<usize>> {
    let own = definition.text(problem.field)?;
    let before = own.get(..problem.span.start)?;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = own.get(start..)?.lines().next()?;
    let at = text.find(line).filter(|_| !line.trim().is_empty())?;
    let span = problem.span.start - start..problem.span.end.min(start + line.len()).max(problem.span.start) - start;
    Some(at + span.start..at + span.end)
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
    use std::path::Path;

    #[test]
    fn cases() {
        check(
            r#"{"initial": "F", "rules": {"F": "F+F"}, "angle_deg": 60, "num_iters": 2}"#,
            expect![[r#"
            our own JSON
            []
            n 2, angle 60, heading 90, every-letter
              F
              F -> F+F"#]],
        );
        check(
            r#"{"initial": "F", "rules": ["F -> F+F"], "turtle": {"overrides": {"G": "move"}}}"#,
            expect![[r#"
            our own JSON
            []
            n 1, angle 0, heading 90, abop
              F
              F -> F+F
              | G: move"#]],
        );
        check(
            "// a comment\n{initial: 'F', rules: ['F -> FF : 0.5'], turtle: {}, moon: 1}",
            expect![[r#"
            our own JSON
            []
            n 1, angle 0, heading 90, abop
              F
              F -> FF : 0.5
            note 2 "moon": Unknown key `moon`"#]],
        );
        check(
            "{\"initial\": \"F\",\n \"rules\": {\"F\": \"FF\"}",
            expect![[r#"
            our own JSON
            []
            refused 1 "{": This object is never closed. Add `}`."#]],
        );
        check(
            "{\"initial\": \"F\", \"rules\": {\"F\" \"FF\"}}",
            expect![[r#"
            our own JSON
            []
            refused 1 "": A colon is missing after the key"#]],
        );
        check(
            "{\"initial\": \"F\", \"rules\": [\"F -> F(\"], \"turtle\": {}}",
            expect![[r#"
            our own JSON
            []
            refused 1 "(": This `(` is never closed"#]],
        );
        check(
            "{\"initial\": \"F\", \"rules\": {\"F\": [{\"p\": 0.5, \"e\": \"FF\"}]}}",
            expect![[r#"
            our own JSON
            []
            n 1, angle 0, heading 90, every-letter
              F
              F -> FF : 0.5
            note 1 "[{\"p\": 0.5, \"e\": \"FF\"}]": The probabilities sum to 0.5, not to 1. They are read as weights: each is divided by the sum."#]],
        );
        check(
            "```json\n{\"initial\": \"F\",\n \"moon\": 1, \"rules\": {\"F\": \"FF\"}}\n```\n",
            expect![[r#"
            our own JSON
            []
            n 1, angle 0, heading 90, every-letter
              F
              F -> FF
            note 3 "\"moon\"": Unknown key `moon`"#]],
        );
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

    #[test]
    fn all_systems_of_the_corpus_open() {
        let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in")];
        let mut files = 0;
        while let Some(folder) = folders.pop() {
            for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "json") {
                    let text = std::fs::read_to_string(&path).unwrap();
                    let Some((expected, _)) = Some(read_json(&text)).filter(|found| found.0.is_some()) else {
                        continue;
                    };
                    let entries = import(&text).unwrap_or_else(|| panic!("{}", path.display())).entries;
                    assert_eq!(entries[0].definition, expected, "{}", path.display());
                    files += 1;
                }
            }
        }
        assert!(files >= 100, "{files} files");
    }
}
