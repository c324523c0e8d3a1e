//! Writing systems as links of our own page. `link.rs` reads them; the page writes the same links
//! (`www/js/state/link.js`).

use super::packed::pack;
use lsystem_base::number::number;
use lsystem_syntax::{Definition, Expected, FIELDS, Value};

/// Longer links are compressed, in bytes, as mail and chat programs cut them.
const LONG: usize = 1500;

/// The part of a link from `#` on: readable, or compressed if the readable form is long and the compressed one shorter.
#[must_use]
pub fn write_link(definition: &Definition) -> String {
    let readable = format!("#v=1{}", fields(definition, escaped));
    if readable.len() <= LONG {
        return readable;
    }
    let least = fields(definition, |text| text.replace('%', "%25").replace('&', "%26"));
    let packed = format!("#v=1&z={}", pack(least.trim_start_matches('&').as_bytes()));
    if packed.len() < readable.len() { packed } else { readable }
}

/// The fields that differ from their defaults, each as `&key=value`.
fn fields(definition: &Definition, guard: impl Fn(&str) -> String) -> String {
    let usual = Definition::default();
    let values = FIELDS.iter().filter_map(|spec| Some((spec, spec.get(definition)?, spec.get(&usual)?)));
    let changed = values.filter(|(_, value, usual)| value != usual);
    changed.map(|(spec, value, _)| format!("&{}={}", spec.link, guard(&text(spec.expected, &value)))).collect()
}

/// A value as the text of a link.
fn text(expected: Expected, value: &Value) -> String {
    match value {
        // No field that may be left out has another default.
        Value::Nothing => String::new(),
        Value::Flag(flag) => u8::from(*flag).to_string(),
        Value::Number(value) => number(*value),
        Value::Text(text) if matches!(expected, Expected::Colour | Expected::Palette) => {
            text.trim_start_matches('#').to_owned()
        }
        Value::Text(text) => text.clone(),
        Value::List(list) => list.iter().map(|value| text(expected, value)).collect::<Vec<_>>().join(","),
    }
}

/// A percent-encoded text. Parentheses are encoded, because chat programs cut links at them.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for byte in text.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' => out.push(char::from(byte)),
            b'-' | b'_' | b'.' | b'!' | b'~' | b'*' | b'\'' => out.push(char::from(byte)),
            b'+' | b',' | b'/' | b':' | b';' | b'=' | b'@' => out.push(char::from(byte)),
            _ => out.push_str(&format!("%{byte:02X}")),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_link;

    /// The page reads and writes the same links in its own tests.
    #[test]
    fn links_of_the_page_are_written_as_the_page_writes_them() {
        let cases: Vec<serde_json::Value> =
            serde_json::from_str(include_str!("../../../www/test/unit/links.json")).unwrap();
        let mut equal = 0;
        for case in &cases {
            let definition: Definition = serde_json::from_value(case["state"].clone()).unwrap();
            let link = write_link(&definition);
            let read = read_link(&link).unwrap();
            assert_eq!((read.definition, read.problems), (definition, vec![]), "{link}");
            equal += usize::from(case["hash"] == link);
        }
        // The others have a view, old spellings or fields with their defaults.
        assert!(equal >= 15, "{equal} of {} links are equal", cases.len());
    }

    #[test]
    fn long_links_are_compressed() {
        let rules = vec!["F -> F[+F]F & 100% of (F)"; 100].join("\n");
        let definition = Definition { axiom: "F".into(), rules, ..Definition::default() };
        let link = write_link(&definition);
        assert!(link.starts_with("#v=1&z=") && link.len() < 300, "{link}");
        assert_eq!(read_link(&link).unwrap().definition, definition);
        assert_eq!(escaped("a (1)\u{e9}&%#\"[]"), "a%20%281%29%C3%A9%26%25%23%22%5B%5D");
    }
}
