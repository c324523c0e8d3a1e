//! A tolerant reader of values in JavaScript, JSON and Python texts: strings, numbers with arithmetic, lists, objects.
//!
//! Code is not run. A value that is code, such as a function, is [`Value::Other`].

/// A value and its place in the text, in bytes.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) value: Value,
    pub(super) start: usize,
    pub(super) end: usize,
}

/// A value.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Text(String),
    Number(f64, Unit),
    List(Vec<Node>),
    /// Keys and values in the order of the text.
    Object(Vec<(String, Node)>),
    /// Code, a name, and other values that are not read.
    Other,
}

/// The unit of a number, as far as the text shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    /// A plain number.
    Unknown,
    /// The expression contains π.
    Radians,
    /// The number stands in a call such as `radians(25)`.
    Degrees,
}

impl Node {
    /// The text of a string.
    pub(super) fn text(&self) -> Option<&str> {
        if let Value::Text(text) = &self.value { Some(text) } else { None }
    }

    /// The value of the first of these keys, in any case; of a repeated key the last.
    pub(super) fn get(&self, keys: &[&str]) -> Option<&Node> {
        let Value::Object(members) = &self.value else { return None };
        let find = |key: &&str| members.iter().rev().find(|(name, _)| name.eq_ignore_ascii_case(key));
        keys.iter().find_map(find).map(|(_, node)| node)
    }
}

/// The deepest nesting of a value.
const DEEPEST: usize = 24;

/// A reader at a place of a text.
pub(super) struct Scanner<'a> {
    text: &'a str,
    pub(super) at: usize,
    /// The steps that are left, so that work stays in proportion to the text.
    fuel: usize,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, at: 0, fuel: 16 * text.len() + 1000 }
    }

    /// Whether all allowed work is done.
    pub(super) fn is_exhausted(&self) -> bool {
        self.fuel == 0
    }

    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn bump(&mut self) -> Option<char> {
        self.fuel = self.fuel.checked_sub(1)?;
        let ch = self.peek()?;
        self.at += ch.len_utf8();
        Some(ch)
    }

    fn eat(&mut self, ch: char) -> bool {
        // False without allowed work, so that no loop waits for the end of a list.
        self.peek() == Some(ch) && self.bump().is_some()
    }

    /// Skips white space and comments.
    pub(super) fn blank(&mut self) {
        loop {
            let rest = self.rest();
            let length = if rest.starts_with("//") || rest.starts_with('#') {
                rest.find('\n').unwrap_or(rest.len())
            } else if rest.starts_with("/*") {
                rest.find("*/").map_or(rest.len(), |end| end + 2)
            } else if let Some(ch) = rest.chars().next().filter(|c| c.is_whitespace()) {
                ch.len_utf8()
            } else {
                return;
            };
            self.at += length;
            self.fuel = self.fuel.saturating_sub(length);
        }
    }

    /// Reads a value; `None` if the text cannot be a value. `value` ends before the next `,` or closing bracket.
    pub(super) fn value(&mut self, depth: usize) -> Option<Node> {
        self.blank();
        let start = self.at;
        if depth > DEEPEST || self.is_exhausted() {
            return None;
        }
        let value = match self.peek()? {
            '{' => self.object(depth)?,
            '[' => self.list('[', ']', depth)?,
            '(' if self.is_tuple() => self.list('(', ')', depth)?,
            '\'' | '"' | '`' => self.strings()?,
            '0'..='9' | '.' | '-' | '+' | '(' => self.arithmetic(depth),
            c if c.is_alphabetic() || c == '_' => self.word(depth),
            _ => Value::Other,
        };
        let end = self.at;
        self.blank();
        if matches!(self.peek(), None | Some(',' | '}' | ']' | ')' | ';')) || self.text[end..self.at].contains('\n') {
            return Some(Node { value, start, end });
        }
        self.skip();
        Some(Node { value: Value::Other, start, end: self.at })
    }

    /// Whether the parentheses at the reader's place hold a string first, as a Python tuple does.
    fn is_tuple(&self) -> bool {
        self.rest()[1..].trim_start().starts_with(['\'', '"'])
    }

    /// Skips code up to the next `,` or closing bracket outside brackets.
    fn skip(&mut self) {
        let mut depth = 0_usize;
        while let Some(ch) = self.peek() {
            match ch {
                '\'' | '"' | '`' => {
                    if self.string().is_none() {
                        return;
                    }
                    continue;
                }
                '/' if self.rest().starts_with("//") || self.rest().starts_with("/*") => {
                    self.blank();
                    continue;
                }
                '{' | '[' | '(' => depth += 1,
                '}' | ']' | ')' | ',' | ';' if depth == 0 => return,
                '}' | ']' | ')' => depth -= 1,
                _ => {}
            }
            if self.bump().is_none() {
                return;
            }
        }
    }

    fn object(&mut self, depth: usize) -> Option<Value> {
        self.bump();
        let mut members = Vec::new();
        loop {
            self.blank();
            if self.eat('}') {
                return Some(Value::Object(members));
            }
            if self.eat(',') {
                continue;
            }
            let key = self.key()?;
            self.blank();
            let start = self.at;
            if self.eat(':') {
                let node = self.value(depth + 1)?;
                members.push((key, node));
            } else if matches!(self.peek(), Some(',' | '}')) {
                members.push((key, Node { value: Value::Other, start, end: start }));
            } else if self.peek() == Some('(') {
                // A method: its parameters and its body.
                self.skip();
                members.push((key, Node { value: Value::Other, start, end: self.at }));
            } else {
                return None;
            }
            self.blank();
            if !matches!(self.peek(), Some(',' | '}')) {
                return None;
            }
        }
    }

    fn key(&mut self) -> Option<String> {
        if let Some('\'' | '"' | '`') = self.peek() {
            return self.string();
        }
        let from = self.at;
        while self.peek().is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '$' | '-' | '.')) {
            self.bump()?;
        }
        (self.at > from).then(|| self.text[from..self.at].to_owned())
    }

    fn list(&mut self, open: char, close: char, depth: usize) -> Option<Value> {
        if !self.eat(open) {
            return None;
        }
        let mut elements = Vec::new();
        loop {
            self.blank();
            if self.eat(close) {
                return Some(Value::List(elements));
            }
            if self.eat(',') {
                continue;
            }
            elements.push(self.value(depth + 1)?);
            self.blank();
            if self.peek() != Some(',') && self.peek() != Some(close) {
                return None;
            }
        }
    }

    /// Reads strings that `+` joins.
    fn strings(&mut self) -> Option<Value> {
        let mut text = self.string()?;
        loop {
            let end = self.at;
            self.blank();
            let joined = self.eat('+');
            if joined {
                self.blank();
            }
            if joined && matches!(self.peek(), Some('\'' | '"' | '`')) {
                text.push_str(&self.string()?);
                continue;
            }
            self.at = end;
            return Some(Value::Text(text));
        }
    }

    fn string(&mut self) -> Option<String> {
        let quote = self.bump()?;
        let mut text = String::new();
        loop {
            match self.bump()? {
                '\\' => match self.bump()? {
                    'n' => text.push('\n'),
                    't' => text.push('\t'),
                    '\n' => {}
                    other => text.push(other),
                },
                '\n' if quote != '`' => return None,
                ch if ch == quote => return Some(text),
                ch => text.push(ch),
            }
        }
    }

    /// Reads a name, a call or arithmetic that begins with a name.
    fn word(&mut self, depth: usize) -> Value {
        let start = self.at;
        let name = self.name();
        if name == "new" || name == "dict" || name == "OrderedDict" {
            self.blank();
            if name == "new" {
                self.name();
                self.blank();
            }
            if self.eat('(')
                && let Some(inner) = self.value(depth + 1)
            {
                self.blank();
                if self.eat(')') {
                    return inner.value;
                }
            }
            self.skip();
            return Value::Other;
        }
        self.at = start;
        self.arithmetic(depth)
    }

    fn name(&mut self) -> &'a str {
        let from = self.at;
        while self.peek().is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '$' | '.')) {
            if self.bump().is_none() {
                break;
            }
        }
        &self.text[from..self.at]
    }

    fn arithmetic(&mut self, depth: usize) -> Value {
        let mut unit = Unit::Unknown;
        let start = self.at;
        match self.sum(depth, &mut unit) {
            Some(value) if value.is_finite() => Value::Number(value, unit),
            _ => {
                self.at = start;
                self.skip();
                Value::Other
            }
        }
    }

    fn sum(&mut self, depth: usize, unit: &mut Unit) -> Option<f64> {
        let mut value = self.product(depth, unit)?;
        loop {
            self.spaces();
            if self.eat('+') {
                value += self.product(depth, unit)?;
            } else if self.eat('-') {
                value -= self.product(depth, unit)?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self, depth: usize, unit: &mut Unit) -> Option<f64> {
        let mut value = self.factor(depth, unit)?;
        loop {
            self.spaces();
            if self.rest().starts_with("//") {
                return Some(value);
            }
            if self.eat('*') {
                value *= self.factor(depth, unit)?;
            } else if self.eat('/') {
                value /= self.factor(depth, unit)?;
            } else {
                return Some(value);
            }
        }
    }

    fn factor(&mut self, depth: usize, unit: &mut Unit) -> Option<f64> {
        self.spaces();
        if depth > DEEPEST {
            return None;
        }
        match self.peek()? {
            '-' => {
                self.bump()?;
                Some(-self.factor(depth + 1, unit)?)
            }
            '+' => {
                self.bump()?;
                self.factor(depth + 1, unit)
            }
            '(' => {
                self.bump()?;
                let value = self.sum(depth + 1, unit)?;
                self.spaces();
                self.eat(')').then_some(value)
            }
            '0'..='9' | '.' => {
                let from = self.at;
                while self.peek().is_some_and(|c| c.is_ascii_digit() || c == '.') {
                    self.bump()?;
                }
                lsystem_base::decimal::read(&self.text[from..self.at])
            }
            'π' => {
                self.bump()?;
                *unit = Unit::Radians;
                Some(core::f64::consts::PI)
            }
            _ => {
                let name = self.name().to_ascii_lowercase();
                if name == "pi" || name.ends_with(".pi") {
                    *unit = Unit::Radians;
                    return Some(core::f64::consts::PI);
                }
                self.spaces();
                if !name.contains("rad") || !self.eat('(') {
                    return None;
                }
                let value = self.sum(depth + 1, unit)?;
                *unit = Unit::Degrees;
                self.spaces();
                self.eat(')').then_some(value)
            }
        }
    }

    fn spaces(&mut self) {
        while let Some(' ' | '\t') = self.peek() {
            if self.bump().is_none() {
                return;
            }
        }
    }
}
