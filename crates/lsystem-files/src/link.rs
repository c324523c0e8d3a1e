//! Links of our own page: `#v=1&axiom=F&rules=F%20-%3E%20FF`, in the readable and in the compressed form. The page
//! reads them in the same way; `docs/links.md` describes the format.

use super::packed::unpack;
use lsystem_base::sorted::repeated;
use lsystem_base::words::said;
use lsystem_base::{MAX_PALETTE, decimal};
use lsystem_base::{say, word};
use lsystem_syntax::notes::excerpt;
use lsystem_syntax::{Definition, Expected, FIELDS, FieldSpec, Value};

/// Longer links are not read, in UTF-16 units.
const LONGEST: usize = 2_000_000;
/// Longer numbers are not read, in bytes.
const LONGEST_NUMBER: usize = 40;
/// The most bytes that a compressed part unpacks to.
const MAX_UNPACKED: usize = 4 << 20;
/// The most problems that are listed.
const MAX_PROBLEMS: usize = 100;

/// A link as read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Link {
    /// The system in the link. Fields that the link leaves out have their defaults.
    pub definition: Definition,
    /// The fields of the link that are not part of a definition, decoded, in the order of the link. `v` and `z` are
    /// left out. A key is listed once, with its last value.
    pub others: Vec<(String, String)>,
    /// Fields that were left out or changed.
    pub problems: Vec<LinkProblem>,
}

/// A field of a link that was left out or changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkProblem {
    /// An excerpt of the value; of the link if the link as a whole is meant.
    pub text: String,
    /// The problem, in words.
    pub message: String,
}

impl Link {
    /// The decoded value of a field that is not part of a definition.
    #[must_use]
    pub fn other(&self, key: &str) -> Option<&str> {
        self.others.iter().find(|(other, _)| other == key).map(|(_, value)| value.as_str())
    }

    fn problem(&mut self, text: &str, message: String) {
        if self.problems.len() < MAX_PROBLEMS {
            self.problems.push(LinkProblem { text: excerpt(text), message });
        }
    }
}

/// Reads a link: a full address, its part from `#` on, or the fields alone. Every link is read; damaged fields are left
/// out and reported. Returns `None` if the text is no link: it has neither a version nor a known field.
#[must_use]
pub fn read_link(text: &str) -> Option<Link> {
    read_link_within(text, LONGEST, MAX_UNPACKED)
}

/// As [`read_link`], of a link of at most `longest` UTF-16 units whose compressed part unpacks to at most `unpacked` bytes.
#[must_use]
pub fn read_link_within(text: &str, longest: usize, unpacked: usize) -> Option<Link> {
    let text = text.trim();
    let hash = text.split_once('#').map_or(text, |(_, hash)| hash);
    let known = |key: &str| matches!(key, "v" | "x" | "z") || FIELDS.iter().any(|spec| spec.link == key);
    if !fields_of(hash).any(|(key, _)| known(key)) {
        return None;
    }
    if hash.len() > longest && hash.encode_utf16().count() > longest {
        let mut link = Link::default();
        link.problem(hash, say!("The link is longer than {} characters and was not read", longest));
        return Some(link);
    }
    let packed = fields_of(hash).filter(|(key, _)| *key == "z").last().map(|(_, value)| value);
    let inside = packed.map(|packed| {
        let bytes = unpack(packed, unpacked)?;
        String::from_utf8(bytes).map_err(|_| word!("is damaged or cut off"))
    });
    let (inside, wrong) = match inside {
        Some(Ok(inside)) => (inside, None),
        Some(Err(wrong)) => (String::new(), Some(wrong)),
        None => (String::new(), None),
    };
    let mut link = read_fields(fields_of(&inside).chain(fields_of(hash)));
    if let Some(wrong) = wrong {
        link.problem(
            packed.unwrap_or_default(),
            say!("The compressed part of the link {} and was not read", said(wrong)),
        );
    }
    Some(link)
}

/// The keys and undecoded values of a link without its `#`.
pub fn fields_of(hash: &str) -> impl Iterator<Item = (&str, &str)> + Clone {
    hash.split('&').filter_map(|part| part.split_once('=')).filter(|(key, _)| !key.is_empty())
}

/// Reads fields. If a key stands twice, its last value counts, at its place.
pub fn read_fields<'a>(fields: impl Iterator<Item = (&'a str, &'a str)>) -> Link {
    let mut link = Link::default();
    // Each value is decoded once, so that the time grows with the length only.
    let fields: Vec<(&str, &str)> = fields.filter(|(key, _)| *key != "z").collect();
    let mut overridden = repeated(fields.iter().rev().map(|(key, _)| *key));
    for &(key, value) in &fields {
        if overridden.pop() == Some(true) {
            continue;
        }
        let Some(text) = decoded(value) else {
            link.problem(value, say!("The value of `{}` is damaged", excerpt(key)));
            continue;
        };
        if key == "v" {
            if number(&text) != Some(1.0) {
                link.problem(&text, say!("The link has another version; parts of the drawing may be missing"));
            }
            continue;
        }
        match FIELDS.iter().find(|spec| spec.link == key && spec.is_defined()) {
            Some(spec) => set(&mut link, spec, &text),
            None => link.others.push((key.to_owned(), text)),
        }
    }
    link
}

/// Sets a field to the nearest valid value.
fn set(link: &mut Link, spec: &FieldSpec, text: &str) {
    let given = value(spec.expected, text);
    let taken = given.as_ref().and_then(|given| nearest(spec.expected, given));
    let is_set = taken.as_ref().is_some_and(|taken| spec.admits(taken) && spec.set(&mut link.definition, taken));
    if !is_set || taken != given {
        let expected = spec.expected_words();
        let words = if is_set {
            say!("The value of `{}` must be {}; the nearest value was taken", spec.link, expected)
        } else {
            say!("The value of `{}` must be {}; it was left out", spec.link, expected)
        };
        link.problem(text, words);
    }
}

/// The value that a text stands for.
fn value(expected: Expected, text: &str) -> Option<Value> {
    // Adding 0 turns -0 into 0.
    let number = |text: &str| number(text).map(|number| Value::Number(number + 0.0));
    let colour = |text: &str| Value::Text(format!("#{}", text.to_ascii_lowercase()));
    match expected {
        Expected::Text(_) | Expected::Word(_) | Expected::String => {
            Some(Value::Text(text.replace("\r\n", "\n").replace('\r', "\n")))
        }
        Expected::Boolean => match text {
            "0" => Some(Value::Flag(false)),
            "1" => Some(Value::Flag(true)),
            _ => None,
        },
        Expected::Colour => Some(colour(text)),
        Expected::Palette => Some(Value::List(text.split(',').take(MAX_PALETTE + 1).map(colour).collect())),
        Expected::Each(count, _) => {
            text.split(',').take(count + 1).map(number).collect::<Option<Vec<Value>>>().map(Value::List)
        }
        _ => number(text),
    }
}

/// A decimal number; `None` for any other text, and for numbers that are not finite.
fn number(text: &str) -> Option<f64> {
    let is_short = text.len() <= LONGEST_NUMBER;
    is_short.then(|| decimal::read(text)).flatten().filter(|number| number.is_finite())
}

/// The nearest value in the range; `None` if there is none.
fn nearest(expected: Expected, value: &Value) -> Option<Value> {
    Some(match (expected, value) {
        (Expected::Between(low, high), Value::Number(number)) => Value::Number(number.clamp(low, high)),
        (Expected::Whole(low, high), Value::Number(number)) => {
            Value::Number(libm::floor(number + 0.5).clamp(low as f64, high as f64))
        }
        (Expected::Text(most), Value::Text(text)) => Value::Text(shortened(text, most)),
        (Expected::Palette, Value::List(list)) => Value::List(list.iter().take(MAX_PALETTE).cloned().collect()),
        (Expected::Each(count, each), Value::List(list)) if list.len() == count => {
            Value::List(list.iter().map(|value| nearest(*each, value)).collect::<Option<_>>()?)
        }
        (_, value) => value.clone(),
    })
}

/// The first `most` UTF-16 units of a text. Half a character becomes U+FFFD.
fn shortened(text: &str, most: usize) -> String {
    if text.len() <= most {
        return text.to_owned();
    }
    let mut units = 0;
    let mut short = String::new();
    for c in text.chars() {
        if units + c.len_utf16() > most {
            short.extend((units < most).then_some('\u{fffd}'));
            break;
        }
        units += c.len_utf16();
        short.push(c);
    }
    short
}

/// A percent-encoded text; `None` if it is damaged.
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
    use super::*;
    use crate::packed::pack;
    use lsystem_base::MAX_TEXT;

    /// The page reads the same links in its own tests.
    #[test]
    fn old_links_mean_what_they_mean_on_the_page() {
        let cases: Vec<serde_json::Value> =
            serde_json::from_str(include_str!("../../../www/test/unit/links.json")).unwrap();
        assert!(cases.len() >= 40);
        for case in cases {
            let hash = case["hash"].as_str().unwrap();
            let expected: Definition = serde_json::from_value(case["state"].clone()).unwrap();
            let link = read_link(&format!("https://example.org/l/{hash}")).unwrap();
            assert_eq!(link.definition, expected, "{hash}");
            assert_eq!(link.problems, [], "{hash}");
        }
    }

    #[test]
    fn other_fields_are_kept() {
        let z = pack(b"axiom=F&by=Nobody&z=x&title=100%25 %26");
        let link = read_link(&format!("#v=1&x=abc_-&z={z}&n=3&by=Ada%20L.&moon=1")).unwrap();
        assert_eq!((link.definition.axiom.as_str(), link.definition.iterations), ("F", 3));
        assert_eq!(link.definition.title, "100% &");
        assert_eq!(link.others.len(), 3);
        assert_eq!([link.other("x"), link.other("by"), link.other("moon")], [Some("abc_-"), Some("Ada L."), Some("1")]);
        assert_eq!(link.problems, []);
        for text in ["", "#", "hello", "#a=1&b=2", "https://example.org/?n=3#top", "{\"initial\": \"F\"}"] {
            assert_eq!(read_link(text), None, "{text}");
        }
    }

    #[test]
    fn damaged_fields_are_told_and_the_rest_is_read() {
        let long = "F".repeat(MAX_TEXT + 1);
        let bomb = pack(&vec![b'F'; MAX_UNPACKED + 1]);
        let damaged = pack(b"axiom=F+F").replace('e', "f");
        for (fields, key) in [
            ("n=x", "`n`"),
            ("n=1e999", "`n`"),
            ("angle=NaN", "`angle`"),
            ("angle=inf", "`angle`"),
            ("palette=ff0000,red", "`palette`"),
            ("start=1", "`start`"),
            ("start=1,2,3", "`start`"),
            ("hold=yes", "`hold`"),
            ("turtle=__proto__", "`turtle`"),
            ("rules=%E0%A4%A", "`rules`"),
            ("rules=%", "`rules`"),
            ("v=2", "version"),
            (&format!("z={bomb}"), "compressed"),
            (&format!("z={damaged}"), "compressed"),
            ("z=%%%", "compressed"),
            ("z=%FF", "compressed"),
            ("z=", "compressed"),
            (&format!("z={}", pack(b"\xff")), "compressed"),
        ] {
            let link = read_link(&format!("#axiom=F&{fields}")).unwrap();
            assert_eq!(link.definition, Definition { axiom: "F".into(), ..Definition::default() }, "{fields}");
            let [problem] = &link.problems[..] else { panic!("{fields}: {:?}", link.problems) };
            assert!(problem.message.contains(key), "{fields}: {problem:?}");
        }
        let link = read_link(&format!("#n=1001&seed=3.5&axiom={long}&step=0")).unwrap();
        let Definition { iterations, seed, axiom, step, .. } = link.definition;
        assert_eq!((iterations, seed, axiom.len(), step, link.problems.len()), (1000, 4, MAX_TEXT, 1e-9, 4));
        assert_eq!(shortened("ab🌿", 3), "ab\u{fffd}");
        let endless = read_link(&format!("#axiom={}", "F".repeat(LONGEST))).unwrap();
        assert_eq!((endless.definition, endless.problems.len()), (Definition::default(), 1));
    }
}
