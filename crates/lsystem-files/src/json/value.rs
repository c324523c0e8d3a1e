//! Reading JSON values by their expected type, and noting wrong values.

use super::*;
use lsystem_base::MAX_PALETTE;
use lsystem_base::decimal;
use lsystem_syntax::Value as Held;
use lsystem_syntax::look_alike;

impl JsonFile {
    /// Notes unknown keys (unless `known` is empty) and repeated keys.
    pub(super) fn check_keys(&mut self, object: &Object<'_>, known: &[&'static str]) {
        let repeated = repeated(object.properties.iter().map(|p| p.name.as_str()));
        for (property, repeated) in object.properties.iter().zip(repeated) {
            let key = property.name.as_str();
            let span = self.span(&property.name);
            if repeated {
                let message = say!("`{}` stands here a second time; this one counts", excerpt(key));
                self.notes.add(span, Diagnostic::warning(message));
            } else if !known.is_empty() && !known.contains(&key) && !is_disused(key) {
                let near = || if self.notes.is_full() { None } else { similar(key, known.iter().copied()) };
                let similar = self.other_name(key).filter(|key| known.contains(key)).or_else(near);
                let warning = Diagnostic::warning(say!("Unknown key `{}`", excerpt(key)))
                    .hint(similar.map(|similar| say!("Did you mean `{}`?", similar)));
                self.notes.add(span, warning.kind(Kind::UnknownKey { is_like_another: similar.is_some() }));
            }
        }
    }

    /// The name here of a field that other programs, files or links call `key`.
    fn other_name(&self, key: &str) -> Option<&'static str> {
        let alias = ALIASES.iter().find(|(alias, _)| *alias == key).map(|&(_, key)| key);
        if self.names == Names::Keys {
            return alias;
        }
        let is_meant = |spec: &&FieldSpec| spec.file.is_some_and(|(_, here)| here == alias.unwrap_or(key));
        let by_link = || FIELDS.iter().find(|spec| spec.link == key);
        FIELDS.iter().find(is_meant).or_else(by_link).map(|spec| spec.name)
    }

    /// The symbol that is a property's key; a key that is not one symbol is noted.
    pub(super) fn symbol(&mut self, property: &ObjectProp<'_>) -> Option<char> {
        let key = property.name.as_str();
        let mut chars = key.chars();
        if let (Some(symbol), None) = (chars.next(), chars.next()) {
            return Some(symbol);
        }
        let message = match excerpt(key) {
            key if key.is_empty() => say!("The key is empty; it must be one symbol"),
            key => say!("`{}` must be one symbol", key),
        };
        self.notes.add(self.span(&property.name), Diagnostic::error(message));
        None
    }

    /// Reads one string, or a list of strings as lines.
    pub(super) fn lines(&mut self, key: &str, expected: Expected, value: &Value<'_>) -> Option<String> {
        match value {
            Value::StringLit(text) => Some(text.value.to_string()),
            Value::Array(lines) => {
                let mut text = Vec::new();
                for line in &lines.elements {
                    match line {
                        Value::StringLit(line) => text.push(line.value.as_ref()),
                        other => self.wrong_type(key, Expected::String, other),
                    }
                }
                Some(text.join("\n"))
            }
            other => {
                self.wrong_type(key, expected, other);
                None
            }
        }
    }

    /// Reads a value of the expected type and range. A wrong value is noted at its place.
    pub(super) fn value(&mut self, key: &str, expected: Expected, value: &Value<'_>) -> Option<Held> {
        let found = match (expected, value) {
            (Expected::Each(count, each), Value::Array(list)) if list.elements.len() == count => {
                return self.list(key, *each, &list.elements);
            }
            (Expected::Palette, Value::Array(list)) if (1..=MAX_PALETTE).contains(&list.elements.len()) => {
                return self.list(key, Expected::Colour, &list.elements);
            }
            (Expected::Each(..), _) => None,
            (Expected::Palette, Value::Array(_)) => Some(Held::List(Vec::new())),
            (_, Value::StringLit(text)) => Some(Held::Text(text.value.to_string())),
            (_, Value::NumberLit(number)) => Some(Held::Number(decimal::read(number.value).unwrap_or(f64::NAN))),
            (_, Value::BooleanLit(flag)) => Some(Held::Flag(flag.value)),
            _ => None,
        };
        match found.filter(|found| expected.takes(found)) {
            None => self.wrong_type(key, expected, value),
            Some(found) if expected.admits_value(&found) => return Some(found),
            Some(_) => self.wrong_value(key, expected, value),
        }
        None
    }

    /// Reads the values of a list; `None` if one of them is wrong.
    fn list(&mut self, key: &str, expected: Expected, values: &[Value<'_>]) -> Option<Held> {
        let read: Vec<_> = values.iter().map(|value| self.value(key, expected, value)).collect();
        read.into_iter().collect::<Option<_>>().map(Held::List)
    }

    /// A field's text in a special form, if it is within the field's range; otherwise it is noted.
    pub(super) fn text(&mut self, name: &str, text: String, object: &Object<'_>) -> String {
        let Some((spec, (_, key))) = field(name).and_then(|spec| Some((spec, spec.file?))) else { return text };
        let key = if self.names == Names::Keys { key } else { spec.name };
        let text = Held::Text(text);
        if !spec.admits(&text)
            && let Some(value) = last(object, key)
        {
            self.wrong_value(key, spec.expected, value);
        }
        if let Held::Text(text) = text { text } else { String::new() }
    }

    /// A word of plain characters. Look-alikes are replaced and noted, white space is noted.
    pub(super) fn plain_word(&mut self, text: &str, value: &Value<'_>) -> Vec<Module> {
        let span = self.span(value);
        if text.contains(char::is_whitespace) {
            self.notes.warn(
                span.clone(),
                say!("White space is a symbol here"),
                say!("In this form of rules each character is a symbol; remove the space if it is not meant."),
            );
        }
        let plain = text.chars().map(|found| match look_alike(found) {
            Some(meant) => {
                self.notes.look_alike(found, meant, span.clone());
                meant
            }
            None => found,
        });
        plain.map(Module::from).collect()
    }

    pub(super) fn wrong_type(&mut self, key: &str, expected: Expected, value: &Value<'_>) {
        let found = match value {
            Value::StringLit(_) => word!("a string"),
            Value::NumberLit(_) => word!("a number"),
            Value::BooleanLit(b) if b.value => "true",
            Value::BooleanLit(_) => "false",
            Value::Object(_) => word!("an object"),
            Value::Array(_) => word!("a list"),
            Value::NullKeyword(_) => "null",
        };
        let message = match excerpt(key) {
            key if key.is_empty() => say!("The file must hold {}, not {}", expected.words(), said(found)),
            key => say!("`{}` must be {}, not {}", key, expected.words(), said(found)),
        };
        self.notes.add(self.span(value), Diagnostic::error(message));
    }

    pub(super) fn wrong_value(&mut self, key: &str, expected: Expected, value: &Value<'_>) {
        let message = say!("`{}` must be {}", excerpt(key), expected.words());
        self.notes.add(self.span(value), Diagnostic::error(message));
    }

    pub(super) fn span(&self, value: &impl Ranged) -> Range<usize> {
        value.start() + self.base..value.end() + self.base
    }
}
