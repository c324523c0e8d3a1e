//! Reading values of JSON: each of its kind, with what is wrong about it.

use super::*;

impl File {
    /// Notes keys that nothing reads (unless `known` is empty) and those that stand twice.
    pub(super) fn check_keys(&mut self, object: &Object<'_>, known: &[&'static str]) {
        let repeated = repeated(object.properties.iter().map(|p| p.name.as_str()));
        for (property, repeated) in object.properties.iter().zip(repeated) {
            let key = property.name.as_str();
            let span = self.span(&property.name);
            if repeated {
                self.notes.add(Kind::DuplicateKey { key: excerpt(key) }, span);
            } else if !known.is_empty() && !known.contains(&key) && !is_disused(key) {
                let alias = ALIASES.iter().find(|(alias, _)| *alias == key).map(|&(_, key)| key);
                let near = || if self.notes.is_full() { None } else { similar(key, known.iter().copied()) };
                let similar = alias.filter(|key| known.contains(key)).or_else(near);
                self.notes.add(Kind::UnknownKey { key: excerpt(key), similar }, span);
            }
        }
    }

    /// The one symbol that is a property's key.
    pub(super) fn symbol(&mut self, property: &ObjectProp<'_>) -> Option<char> {
        let key = property.name.as_str();
        let mut chars = key.chars();
        if let (Some(symbol), None) = (chars.next(), chars.next()) {
            return Some(symbol);
        }
        self.notes.add(Kind::RuleKey { key: excerpt(key) }, self.span(&property.name));
        None
    }

    pub(super) fn string(&mut self, object: &Object<'_>, key: &str, into: &mut String) {
        match last(object, key) {
            None => {}
            Some(Value::StringLit(text)) => *into = text.value.to_string(),
            Some(other) => self.wrong_type(key, Expected::String, other),
        }
    }

    /// One string, or a list of them as lines.
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

    pub(super) fn number(&mut self, object: &Object<'_>, key: &str, expected: Expected, into: &mut f64) {
        if let Some(value) = last(object, key) {
            self.number_value(key, expected, value, into);
        }
    }

    /// A list of as many numbers as there is room for.
    pub(super) fn point(
        &mut self,
        object: &Object<'_>,
        key: &str,
        quantity: Quantity,
        expected: Expected,
        into: &mut [f64],
    ) {
        match last(object, key) {
            None => {}
            Some(Value::Array(list)) if list.elements.len() == into.len() => {
                for (value, into) in list.elements.iter().zip(into) {
                    self.number_value(key, quantity.expected(), value, into);
                }
            }
            Some(other) => self.wrong_type(key, expected, other),
        }
    }

    pub(super) fn number_value(&mut self, key: &str, expected: Expected, value: &Value<'_>, into: &mut f64) {
        let Value::NumberLit(number) = value else { return self.wrong_type(key, expected, value) };
        match number.value.parse::<f64>() {
            Ok(number) if expected.admits(number) => *into = number,
            _ => self.wrong_value(key, expected, value),
        }
    }

    /// The index of a word among those allowed.
    pub(super) fn word(&mut self, object: &Object<'_>, key: &str, allowed: &'static [&'static str]) -> Option<usize> {
        let value = last(object, key)?;
        let Value::StringLit(word) = value else {
            self.wrong_type(key, Expected::String, value);
            return None;
        };
        let index = allowed.iter().position(|name| *name == word.value);
        if index.is_none() {
            let kind = Kind::WrongWord { key: excerpt(key), found: excerpt(&word.value), allowed };
            self.notes.add(kind, self.span(value));
        }
        index
    }

    pub(super) fn check_spaces(&mut self, text: &str, value: &Value<'_>) {
        if text.contains(char::is_whitespace) {
            self.notes.add(Kind::SpaceSymbol, self.span(value));
        }
    }

    pub(super) fn wrong_type(&mut self, key: &str, expected: Expected, value: &Value<'_>) {
        let found = match value {
            Value::StringLit(_) => "a string",
            Value::NumberLit(_) => "a number",
            Value::BooleanLit(b) if b.value => "true",
            Value::BooleanLit(_) => "false",
            Value::Object(_) => "an object",
            Value::Array(_) => "a list",
            Value::NullKeyword(_) => "null",
        };
        self.notes.add(Kind::WrongType { key: excerpt(key), expected, found }, self.span(value));
    }

    pub(super) fn wrong_value(&mut self, key: &str, expected: Expected, value: &Value<'_>) {
        self.notes.add(Kind::WrongValue { key: excerpt(key), expected }, self.span(value));
    }

    pub(super) fn span(&self, value: &impl Ranged) -> Range<usize> {
        value.start() + self.base..value.end() + self.base
    }
}
