//! New values in the bytes of a JSON file. All other bytes stay: comments, keys of others, order, layout and encoding.
//!
//! A new value takes the place of the old one. A new key gets the layout of the keys beside it. Where a key stands twice,
//! the one that is read is edited. In a list of lines, only those lines are edited that differ.

mod diff;
mod layout;
mod rules;

use crate::json::{PARSING, last_property};
use crate::json_write::{string, written};
use crate::read_file;
use diff::{Fate, Plan};
use jsonc_parser::ast::{Object, ObjectProp, Value as Json};
use jsonc_parser::common::Ranged;
use jsonc_parser::tokens::Token;
use jsonc_parser::{CollectOptions, CommentCollectionStrategy, ParseResult, parse_to_ast};
use layout::{Edit, LINE_ENDS, Layout, place};
use lsystem_syntax::fields::{FieldSpec, Section};
use lsystem_syntax::{Definition, Dialect, FIELDS, Style, Value};

/// The bytes of a JSON file with the system `definition` in place of the one in `bytes`.
///
/// `None` if the file has no system, or if a comment or a key of others would have to go.
#[must_use]
pub fn edit_file(bytes: &[u8], definition: &Definition) -> Option<Vec<u8>> {
    let former = read_file(bytes).definition?;
    if former == *definition {
        return Some(bytes.to_vec());
    }
    let file = Encoded::new(bytes)?;
    let others = not_ours(&file.text)?;
    // Rules of the course's form that cannot hold the system become lines.
    [false, true].into_iter().find_map(|as_lines| {
        let edits = edits(&file.text, &former, definition, as_lines)?;
        let edited = file.edited(bytes, edits)?;
        let is_right = read_file(&edited).definition.as_ref() == Some(definition);
        let stays = || Some(not_ours(&Encoded::new(&edited)?.text)? == others);
        (is_right && stays() == Some(true)).then_some(edited)
    })
}

/// A text and how it is encoded in its file.
struct Encoded {
    text: String,
    /// The bytes before the text.
    mark: usize,
    /// A code unit in bytes, if the encoding is UTF-16.
    unit: Option<fn(u16) -> [u8; 2]>,
}

impl Encoded {
    fn new(bytes: &[u8]) -> Option<Self> {
        type Units = (fn([u8; 2]) -> u16, fn(u16) -> [u8; 2]);
        let (read, write): Units = match bytes {
            [0xff, 0xfe, ..] => (u16::from_le_bytes, u16::to_le_bytes),
            [0xfe, 0xff, ..] => (u16::from_be_bytes, u16::to_be_bytes),
            _ => {
                let text = str::from_utf8(bytes).ok()?;
                let plain = text.trim_start_matches('\u{feff}');
                return Some(Self { text: plain.to_owned(), mark: text.len() - plain.len(), unit: None });
            }
        };
        let units: Vec<u16> = bytes.chunks_exact(2).map(|pair| read([pair[0], pair[1]])).collect();
        // A unit without its partner becomes one unit, so that places stay right.
        let text = String::from_utf16_lossy(&units);
        let plain = text.trim_start_matches('\u{feff}');
        let mark = 2 * (text.chars().count() - plain.chars().count());
        Some(Self { text: plain.to_owned(), mark, unit: Some(write) })
    }

    /// `bytes` with edits of the text.
    fn edited(&self, bytes: &[u8], mut edits: Vec<Edit>) -> Option<Vec<u8>> {
        edits.sort_by_key(|(range, _)| (range.start, range.end));
        let (mut edited, mut place, mut done) = (bytes[..self.mark].to_vec(), self.mark, 0);
        for (range, new) in edits {
            // Two elements that go may share blanks.
            let start = range.start.max(done);
            let end = range.end.max(start);
            let kept = self.length(self.text.get(done..start)?);
            edited.extend_from_slice(&bytes[place..place + kept]);
            place += kept + self.length(self.text.get(start..end)?);
            done = end;
            match self.unit {
                Some(write) => edited.extend(new.encode_utf16().flat_map(write)),
                None => edited.extend(new.bytes()),
            }
        }
        edited.extend_from_slice(&bytes[place..]);
        Some(edited)
    }

    /// The number of bytes of a text in the file.
    fn length(&self, text: &str) -> usize {
        if self.unit.is_some() { 2 * text.encode_utf16().count() } else { text.len() }
    }
}

/// The comments of a JSON text, and the keys of others.
fn not_ours(text: &str) -> Option<Vec<String>> {
    let tokens = parsed(text)?.tokens?;
    let is_ours = |key: &str| {
        let is_symbol = key.chars().count() < 2;
        is_symbol || ["turtle", "style", "stochastic"].contains(&key) || FIELDS.iter().any(|spec| spec.key() == key)
    };
    let (mut found, mut is_key) = (Vec::new(), false);
    for token in tokens.iter().rev() {
        let is_comment = layout::is_comment(&token.token);
        if is_comment || (is_key && !is_ours(token.token.as_str())) {
            found.push(token.token.as_str().to_owned());
        }
        is_key = token.token == Token::Colon || (is_key && is_comment);
    }
    found.reverse();
    Some(found)
}

const COLLECTED: CollectOptions = CollectOptions { comments: CommentCollectionStrategy::AsTokens, tokens: true };

/// The most signs before values and in comments of a file that is edited: each may take 200 bytes of memory.
const MAX_SIGNS: usize = 500_000;

/// Reads a JSON text, unless it would take too much memory.
fn parsed(text: &str) -> Option<ParseResult<'_>> {
    let is_small = text.bytes().filter(|byte| b",:[{/".contains(byte)).count() <= MAX_SIGNS;
    is_small.then(|| parse_to_ast(text, &COLLECTED, &PARSING).ok()).flatten()
}

/// The edits that make the system `new` from `former`. With `as_lines`, rules in an object become lines.
fn edits(text: &str, former: &Definition, new: &Definition, as_lines: bool) -> Option<Vec<Edit>> {
    let parsed = parsed(text)?;
    let Some(Json::Object(file)) = &parsed.value else { return None };
    let is_tight = |property: &ObjectProp<'_>| property.value.start() == property.name.end() + 1;
    let layout =
        Layout { text, tokens: parsed.tokens.as_deref()?, is_tight: file.properties.first().is_some_and(is_tight) };
    let gap = file.properties.first().map_or_else(String::new, |first| layout.gap(first.range.start));
    let indent = gap.trim_start_matches(LINE_ENDS);
    let indent = if indent.len() == gap.len() || indent.is_empty() { "  " } else { indent };
    let editor = Editor { layout, indent, former, new, as_lines };
    editor.file(file)
}

struct Editor<'a> {
    layout: Layout<'a>,
    /// The indentation of one level.
    indent: &'a str,
    former: &'a Definition,
    new: &'a Definition,
    as_lines: bool,
}

impl Editor<'_> {
    fn file(&self, file: &Object<'_>) -> Option<Vec<Edit>> {
        let (mut edits, mut added) = (Vec::new(), Vec::new());
        let gap = self.gap(file);
        let course = Definition { dialect: Dialect::EveryLetter, style: Style::course(), ..Definition::default() };
        let has_turtle =
            last_property(file, "turtle").is_some() || !self.missing(None, Section::Turtle, &course, "").is_empty();
        let usual = match has_turtle {
            true => Definition { style: Style::for_dialect(self.new.dialect), ..Definition::default() },
            false => course,
        };
        for (section, name) in [(Section::Turtle, "turtle"), (Section::Style, "style")] {
            match last_property(file, name).map(|property| &property.value) {
                Some(Json::Object(object)) => edits.extend(self.section(object, section, &usual, Vec::new())),
                Some(_) => return None,
                None => {
                    let inner = format!("{gap}{}", if gap.contains(LINE_ENDS) { self.indent } else { "" });
                    let members = self.missing(None, section, &usual, &inner);
                    if !members.is_empty() || (section == Section::Turtle && has_turtle) {
                        added.push(self.member(name, &block('{', &members, '}', &gap, self.indent)));
                    }
                }
            }
        }
        edits.extend(self.section(file, Section::File, &usual, added));
        Some(edits)
    }

    /// The members that an object needs more, since a value is not the `usual` one.
    fn missing(&self, object: Option<&Object<'_>>, section: Section, usual: &Definition, gap: &str) -> Vec<String> {
        let here = FIELDS.iter().filter_map(|spec| Some((spec, spec.file.filter(|(place, _)| *place == section)?.1)));
        here.filter(|(_, key)| object.is_none_or(|object| last_property(object, key).is_none()))
            .filter_map(|(spec, key)| Some((spec, key, spec.get(self.new)?)))
            .filter(|(spec, _, value)| spec.get(usual).as_ref() != Some(value))
            .map(|(spec, key, value)| self.member(key, &self.fresh(spec, &value, gap)))
            .collect()
    }

    /// The edits in an object of the file, with more members after its last one.
    fn section(&self, object: &Object<'_>, section: Section, usual: &Definition, more: Vec<String>) -> Vec<Edit> {
        let mut plan = Plan::unchanged(object.properties.len());
        for (property, slot) in object.properties.iter().zip(&mut plan.slots) {
            let key = property.name.as_str();
            let Some(spec) = FIELDS.iter().find(|spec| spec.file == Some((section, key))) else { continue };
            let (old, new) = (spec.get(self.former), spec.get(self.new));
            let (Some(old), Some(new)) = (old, new) else { continue };
            let is_read = last_property(object, key) == Some(property);
            let changes = match spec.name {
                _ if old != new && new == Value::Nothing => {
                    slot.fate = Fate::Goes;
                    continue;
                }
                _ if !is_read => None,
                "axiom" => self.axiom(object, property),
                "rules" => self.rules(property),
                _ if old == new => None,
                "overrides" => Some(self.overrides(property)),
                _ => Some(self.value(property, &old, &new)),
            };
            slot.fate = changes.map_or(Fate::Stays, Fate::Changes);
        }
        let mut added = self.missing(Some(object), section, usual, &self.gap(object));
        added.extend(more);
        match plan.slots.iter_mut().rfind(|slot| !matches!(slot.fate, Fate::Goes)) {
            Some(last) => last.after = added,
            None => plan.first = added,
        }
        self.layout.edits(object, &object.properties, plan)
    }

    /// The edits that give a property a new value. Of a list, only those elements are edited that differ.
    fn value(&self, property: &ObjectProp<'_>, old: &Value, new: &Value) -> Vec<Edit> {
        match (&property.value, old, new) {
            (Json::Array(list), Value::List(old), Value::List(items)) if list.elements.len() == old.len() => {
                let old: Vec<_> = old.iter().map(|value| vec![written(value)]).collect();
                let items: Vec<_> = items.iter().map(written).collect();
                self.layout.edits(list, &list.elements, Plan::new(&old, &items))
            }
            _ => vec![(place(&property.value), written(new))],
        }
    }

    /// What stands before the last member of an object.
    fn gap(&self, object: &Object<'_>) -> String {
        object.properties.last().map_or_else(|| " ".to_owned(), |last| self.layout.gap(last.start()))
    }

    /// A new value as JSON, after a key that begins with this gap.
    fn fresh(&self, spec: &FieldSpec, value: &Value, gap: &str) -> String {
        match value {
            Value::Text(text) if matches!(spec.name, "rules" | "overrides") => self.lines(text, gap),
            value => written(value),
        }
    }

    /// A text as the list of its lines.
    fn lines(&self, text: &str, gap: &str) -> String {
        let lines: Vec<_> = text.split('\n').filter(|_| !text.is_empty()).map(string).collect();
        if lines.len() < 2 { format!("[{}]", lines.join("")) } else { block('[', &lines, ']', gap, self.indent) }
    }

    fn member(&self, key: &str, value: &str) -> String {
        format!("{}:{}{value}", string(key), if self.layout.is_tight { "" } else { " " })
    }
}

/// Elements in brackets, each on a line of its own if the gap before them is a line end.
fn block(open: char, elements: &[String], close: char, gap: &str, indent: &str) -> String {
    if elements.is_empty() || !gap.contains(LINE_ENDS) {
        return format!("{open}{}{close}", elements.join(if gap.is_empty() { "," } else { ", " }));
    }
    let inner = format!("{gap}{indent}");
    format!("{open}{inner}{}{gap}{close}", elements.join(&format!(",{inner}")))
}
