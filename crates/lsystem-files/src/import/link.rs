//! Links of our own page in the readable form: `#v=1&axiom=F&rules=F%20-%3E%20FF`. The page itself reads the compressed
//! form.

use super::draft::Draft;
use lsystem_syntax::{Expected, FIELDS, Value};

pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    let text = text.trim();
    if text.contains(char::is_whitespace) {
        return None;
    }
    let (before, hash) = text.split_once('#')?;
    let is_address = before.is_empty() || before.contains("://") || before.ends_with(".html") || before.ends_with('/');
    let parts = hash.split('&').filter_map(|part| part.split_once('='));
    let has = |name: &str| parts.clone().any(|(key, _)| key == name);
    if !is_address || !has("v") || !has("axiom") || has("z") {
        return None;
    }
    let mut draft = Draft::new("", 1);
    draft.has_iterations = true;
    for (key, value) in parts {
        if matches!(key, "v" | "view" | "camera" | "controls" | "theme" | "host") {
            continue;
        }
        let Some(spec) = FIELDS.iter().find(|spec| spec.link == key && spec.is_defined()) else {
            draft.note(1, key, "This key is unknown");
            continue;
        };
        let Some(text) = decoded(value) else {
            draft.note(1, value, format!("The value of `{key}` is damaged"));
            continue;
        };
        let value = field(spec.expected, &text);
        let valid = value.filter(|value| spec.admits(value));
        if !valid.is_some_and(|value| spec.set(&mut draft.definition, &value)) {
            draft.note(1, &text, format!("The value of `{key}` must be {}", spec.expected_words()));
        }
    }
    draft.keeps_overrides = true;
    Some(vec![draft])
}

/// The value of a field.
fn field(expected: Expected, text: &str) -> Option<Value> {
    let number = |text: &str| (text.len() <= 40).then(|| text.parse().ok()).flatten().map(Value::Number);
    let colour = |text: &str| Value::Text(format!("#{text}"));
    match expected {
        Expected::Text(_) | Expected::Word(_) | Expected::String => Some(Value::Text(text.to_owned())),
        Expected::Boolean => Some(Value::Flag(text == "1")),
        Expected::Colour => Some(colour(text)),
        Expected::Palette => Some(Value::List(text.split(',').map(colour).collect())),
        Expected::Each(..) => text.split(',').map(number).collect::<Option<Vec<Value>>>().map(Value::List),
        _ => number(text),
    }
}

/// A percent-encoded text.
fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let mut digit = || char::from(rest.next()?).to_digit(16);
        let (high, low) = (digit()?, digit()?);
        bytes.push((high * 16 + low) as u8);
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::super::tests::check;
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
                note 1 "x": The value of `n` must be a whole number from 0 to 1,000
                note 1 "1000": The value of `hue` must be a number from -360 to 360
                note 1 "moon": This key is unknown"#]],
        );
        check("#v=1&z=eNpLrMjMz7", expect!["not recognised"]);
    }
}
