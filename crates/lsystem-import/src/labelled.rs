//! Our own notation as one text: the axiom and other fields on lines of their own, by their keys in links or their
//! attributes in HTML, and below them the rules. Books write systems in this form (`docs/books.md`), and the element
//! `<l-system>` reads the same text (`www/l-system.js`).
//!
//! ```text
//! axiom: X
//! angle: 20
//! n: 6
//! X -> F[+X]F[-X]+X
//! F -> FF
//! ```

use crate::draft::Draft;
use crate::source::Source;
use lsystem_drawing::System;
use lsystem_files::link::read_fields;
use lsystem_syntax::FIELDS;
use std::collections::BTreeMap;

/// Fields of the element that are not of the system.
const OTHERS: [&str; 2] = ["controls", "theme"];
/// Fields that `auto` chooses: a text that gives one of them has the look that it says.
const LOOK: [&str; 4] = ["auto", "colour", "width", "thinner"];

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let all = source.text.trim_start_matches('\u{feff}').trim();
    let place = source.place(all)?;
    let mut draft = Draft::new(source, "", source.line_of(place.start));
    let mut fields: BTreeMap<&str, String> = BTreeMap::new();
    let mut rules = Vec::new();
    for line in all.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let field = field(line).filter(|_| rules.is_empty());
        let rule = field.map_or(line, |(key, value)| if key == "rules" { value } else { "" });
        if !rule.is_empty() {
            draft.read(draft.place(rule), rule.to_owned());
            rules.push(rule);
        }
        let Some((key, value)) = field.filter(|(key, _)| *key != "rules") else { continue };
        if OTHERS.contains(&key) {
            draft.pass(draft.place(line));
            continue;
        }
        let mut written = value.replace('%', "%25");
        if ["bg", "palette"].contains(&key) {
            written.retain(|symbol| symbol != '#' && !symbol.is_whitespace());
        }
        for problem in read_fields([(key, &*written)].into_iter()).problems {
            draft.note_at(draft.place(value), problem.message);
        }
        draft.read(draft.place(line), format!("{key} {value}"));
        // Custom symbols are lines; of any other field, the last value counts.
        match fields.get_mut(key).filter(|_| key == "do") {
            Some(lines) => *lines += &format!("\n{written}"),
            None => drop(fields.insert(key, written)),
        }
    }
    // Other texts leave the number of iterations to the reader.
    if !["axiom", "n"].iter().all(|key| fields.contains_key(key)) || rules.is_empty() {
        return None;
    }
    draft.definition = read_fields(fields.iter().map(|(key, value)| (*key, &**value))).definition;
    draft.definition.rules = rules.join("\n");
    draft.definition.style.auto |= !LOOK.iter().any(|key| fields.contains_key(key));
    (draft.has_iterations, draft.is_ours) = (true, true);
    draft.covers(place);
    // Running text may begin like this, too.
    let is_ours = !System::problems(&draft.definition).iter().any(lsystem_syntax::Diagnostic::is_error);
    is_ours.then(|| vec![draft])
}

/// The key in links and the value of a line such as `n: 6`.
fn field(line: &str) -> Option<(&'static str, &str)> {
    let (name, value) = line.split_once(':')?;
    let key = FIELDS.iter().find(|spec| spec.attribute() == name || spec.link == name).map(|spec| spec.link);
    Some((key.or_else(|| OTHERS.into_iter().find(|other| *other == name))?, value.trim()))
}

#[cfg(test)]
mod tests {
    use crate::import;
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cases() {
        check(
            "title: Weed\naxiom: F\nseed: 3\nn: 4\nangle: 25.7\ncontrols: angle,n\n\n// alternatives\nF -> F[+F]F : 0.5\n  F -> FF : 0.5\n",
            expect![[r#"
                our own notation
                []
                n 4, angle 25.7, heading 90, abop, seed 3
                  F
                  // alternatives
                  F -> F[+F]F : 0.5
                  F -> FF : 0.5"#]],
        );
        check(
            "```lsystem\naxiom: A\ndo: A: draw\ndo: B: move\nn: 3000\nrules:\np1: A -> AB\n```",
            expect![[r#"
                our own notation
                []
                n 1000, angle 0, heading 90, abop
                  A
                  p1: A -> AB
                  | A: draw
                  | B: move
                note 5 "3000": The value of `n` must be a whole number from 0 to 1,000; the nearest value was taken"#]],
        );
        // Capitals, words that are no rules, and a text without an axiom or iterations are for other readers.
        for text in
            ["Axiom: F\nn: 3\nF -> FF", "axiom: F\nn: 3\nF -> FF\nThat is all.", "n: 3\nF -> FF", "axiom: F\nF -> FF"]
        {
            assert_ne!(import(text).map(|found| found.notation), Some("our own notation"), "{text}");
        }
    }

    #[test]
    fn a_text_without_a_look_gets_one() {
        let look = |line: &str| {
            let found = import(&format!("axiom: F\nn: 3\n{line}\nF -> F[+F]F")).unwrap();
            found.entries[0].definition.as_ref().unwrap().style.clone()
        };
        assert!(
            look("").auto && look("palette: #ff0000, #00f").auto && !look("width: 0.2").auto && !look("auto: 0").auto
        );
        assert_eq!(look("palette: #ff0000, #00ff00").palette.len(), 2);
        assert_eq!(look("stroke: 0.2").width, 0.2);
    }
}
