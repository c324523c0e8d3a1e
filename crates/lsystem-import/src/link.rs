//! Links of our own page in the readable form: `#v=1&axiom=F&rules=F%20-%3E%20FF`. The page itself reads the compressed
//! form.

use crate::draft::Draft;
use crate::source::Source;
use lsystem_files::link::{fields_of, read_fields};

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let text = text.trim();
    if text.contains(char::is_whitespace) {
        return None;
    }
    let (before, hash) = text.split_once('#')?;
    let is_address = before.is_empty() || before.contains("://") || before.ends_with(".html") || before.ends_with('/');
    let has = |name: &str| fields_of(hash).any(|(key, _)| key == name);
    if !is_address || !has("v") || !has("axiom") || has("z") {
        return None;
    }
    let link = read_fields(fields_of(hash));
    let mut draft = Draft::new(source, "", 1);
    draft.definition = link.definition;
    draft.has_iterations = true;
    draft.keeps_overrides = true;
    for problem in link.problems {
        draft.note(1, &problem.text, problem.message);
    }
    for (key, _) in link.others {
        if !matches!(key.as_str(), "view" | "camera" | "controls" | "theme" | "host") {
            draft.note(1, &key, "This key is unknown");
        }
    }
    Some(vec![draft])
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
                note 1 "moon": This key is unknown"#]],
        );
        check("#v=1&z=eNpLrMjMz7", expect!["not recognised"]);
    }
}
