//! The elements of an SVG file, of which only what is drawn is kept.

use crate::SvgError;
use crate::work::{Kind, Work};
use lsystem_base::say;
use quick_xml::Reader;
use quick_xml::escape::{resolve_xml_entity, unescape_with};
use quick_xml::events::{BytesStart, Event};
use std::collections::BTreeMap;

/// The most levels of elements, also of those that are drawn by reference.
pub(crate) const MAX_DEPTH: usize = 500;
/// The units of an element and of a byte of its attributes.
const ELEMENT: u64 = 300;
const BYTE: u64 = 4;

/// The elements that are drawn or named. All others are left out with what is inside.
const NAMES: [&str; 26] = [
    "svg",
    "g",
    "a",
    "use",
    "symbol",
    "switch",
    "defs",
    "path",
    "line",
    "polyline",
    "polygon",
    "rect",
    "circle",
    "ellipse",
    "linearGradient",
    "radialGradient",
    "stop",
    "style",
    "text",
    "image",
    "foreignObject",
    "clipPath",
    "mask",
    "pattern",
    "marker",
    "filter",
];
/// The attributes that are read.
const ATTRIBUTES: [&str; 48] = [
    "id",
    "class",
    "style",
    "transform",
    "viewBox",
    "preserveAspectRatio",
    "x",
    "y",
    "width",
    "height",
    "x1",
    "y1",
    "x2",
    "y2",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
    "d",
    "points",
    "href",
    "requiredExtensions",
    "systemLanguage",
    "color",
    "fill",
    "fill-opacity",
    "fill-rule",
    "stroke",
    "stroke-opacity",
    "stroke-width",
    "stroke-linecap",
    "stroke-linejoin",
    "stroke-miterlimit",
    "stroke-dasharray",
    "stroke-dashoffset",
    "opacity",
    "display",
    "visibility",
    "stop-color",
    "stop-opacity",
    "clip-path",
    "mask",
    "filter",
    "marker",
    "marker-start",
    "marker-mid",
    "marker-end",
];

pub(crate) struct Element {
    /// Empty for an element that is left out.
    pub(crate) name: &'static str,
    attributes: Vec<(&'static str, Box<str>)>,
    /// The index after the last element inside.
    pub(crate) end: usize,
    /// The byte of the text where the tag begins.
    pub(crate) at: usize,
}

/// All elements in the order of the file; the first one is `svg`.
pub(crate) struct Document {
    elements: Vec<Element>,
    ids: BTreeMap<Box<str>, usize>,
    /// The texts of all `style` elements.
    pub(crate) sheet: String,
}

impl Element {
    pub(crate) fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| *key == name).map(|(_, value)| &**value)
    }

    pub(crate) fn attributes(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.attributes.iter().map(|(name, value)| (*name, &**value))
    }

    /// Charges the work of reading this element once.
    pub(crate) fn charge(&self, work: &mut Work) -> Result<(), SvgError> {
        let bytes = self.attributes.iter().map(|(_, value)| value.len()).sum();
        work.charge(Kind::Elements, 1, ELEMENT)?;
        work.charge(Kind::Elements, bytes, BYTE)
    }
}

impl Document {
    /// # Errors
    /// Why this is no SVG that can be drawn.
    pub(crate) fn read(text: &str, work: &mut Work) -> Result<Self, SvgError> {
        let mut reader = Reader::from_str(text);
        let read = Self::of_events(&mut reader, work);
        read.map_err(|error| error.or_at(reader.error_position().max(reader.buffer_position()) as usize))
    }

    fn of_events(reader: &mut Reader<&[u8]>, work: &mut Work) -> Result<Self, SvgError> {
        let mut document = Self { elements: Vec::new(), ids: BTreeMap::new(), sheet: String::new() };
        let (mut open, mut entities): (Vec<usize>, _) = (Vec::new(), BTreeMap::new());
        // The namespace of SVG is that of the first element.
        let mut prefix = None;
        loop {
            let place = reader.buffer_position();
            let event = reader.read_event().map_err(|_| damaged())?;
            match event {
                Event::DocType(declared) => entities = entities_of(&declared),
                Event::Start(ref tag) | Event::Empty(ref tag) => {
                    let own = tag.name().prefix().map(|prefix| prefix.into_inner().to_owned());
                    let is_known = own == *prefix.get_or_insert_with(|| own.clone());
                    let element = Element::read(tag, is_known, (place as usize, &entities), work)?;
                    let at = document.elements.len();
                    if open.is_empty() != (at == 0) || (at == 0 && element.name != "svg") {
                        return Err(damaged());
                    }
                    if open.len() >= MAX_DEPTH {
                        return Err(too_deep());
                    }
                    if let Some(id) = element.get("id") {
                        document.ids.entry(id.into()).or_insert(at);
                    }
                    document.elements.push(element);
                    match event {
                        Event::Start(_) => open.push(at),
                        _ => document.elements[at].end = at + 1,
                    }
                }
                Event::End(_) => {
                    let at = open.pop().ok_or_else(damaged)?;
                    document.elements[at].end = document.elements.len();
                }
                Event::Text(text) => document.add_style(&open, &text),
                Event::CData(text) => document.add_style(&open, &text),
                Event::Eof if open.is_empty() && !document.elements.is_empty() => return Ok(document),
                Event::Eof => return Err(damaged()),
                _ => {}
            }
        }
    }

    fn add_style(&mut self, open: &[usize], text: &str) {
        if open.last().is_some_and(|&at| self.elements[at].name == "style") {
            self.sheet.push_str(text);
            self.sheet.push('\n');
        }
    }

    pub(crate) fn elements(&self) -> &[Element] {
        &self.elements
    }

    pub(crate) fn element(&self, at: usize) -> &Element {
        &self.elements[at]
    }

    /// The element of a reference in the same file, such as `#name`.
    pub(crate) fn named(&self, reference: &str) -> Option<usize> {
        self.ids.get(reference.trim().strip_prefix('#')?).copied()
    }

    /// The indices of the elements directly inside.
    pub(crate) fn children(&self, of: usize) -> impl Iterator<Item = usize> {
        let last = self.elements[of].end;
        let first = Some(of + 1).filter(|&at| at < last);
        std::iter::successors(first, move |&at| Some(self.elements[at].end).filter(|&at| at < last))
    }
}

impl Element {
    fn read(
        tag: &BytesStart,
        is_known: bool,
        (at, entities): (usize, &BTreeMap<String, String>),
        work: &mut Work,
    ) -> Result<Self, SvgError> {
        work.charge(Kind::Elements, 1, ELEMENT)?;
        let known = |names: &'static [&str], name: &str| names.iter().find(|known| **known == name).copied();
        let name = if is_known { known(&NAMES, tag.local_name().into_inner()) } else { None };
        let mut attributes: Vec<(&'static str, Box<str>)> = Vec::new();
        for attribute in tag.attributes().with_checks(false) {
            let attribute = attribute.map_err(|_| damaged())?;
            work.charge(Kind::Elements, 1, ELEMENT / 4)?;
            // Of attributes with a namespace, only the reference of older files is read.
            let key = match attribute.key.prefix() {
                Some(_) => attribute.key.local_name().into_inner(),
                None => attribute.key.into_inner(),
            };
            let is_read = attribute.key.prefix().is_none() || key == "href";
            let Some(key) = known(&ATTRIBUTES, key).filter(|_| is_read && name.is_some()) else { continue };
            if attributes.iter().all(|(other, _)| *other != key) {
                attributes.push((key, value_of(&attribute.value, entities, work)?));
            }
        }
        Ok(Self { name: name.unwrap_or_default(), attributes, end: 0, at })
    }
}

fn damaged() -> SvgError {
    SvgError::new(say!("this SVG is damaged"))
}

pub(crate) fn too_deep() -> SvgError {
    SvgError::new(say!(
        "this SVG has more than {} levels of elements, or draws itself. Save it as a PNG first",
        MAX_DEPTH
    ))
}

/// The value of an attribute, with its entities. Entities inside entities stay as they are.
fn value_of(raw: &str, entities: &BTreeMap<String, String>, work: &mut Work) -> Result<Box<str>, SvgError> {
    let longest = entities.values().map(String::len).max().unwrap_or(0);
    let references = raw.bytes().filter(|&byte| byte == b'&').count();
    work.charge(Kind::Entities, references, longest as u64 * BYTE)?;
    let entity = |name: &str| entities.get(name).map(String::as_str).or_else(|| resolve_xml_entity(name));
    Ok(unescape_with(raw, entity).unwrap_or_default().into())
}

/// The entities that a document type declares.
fn entities_of(mut declared: &str) -> BTreeMap<String, String> {
    let mut entities = BTreeMap::new();
    while let Some((_, rest)) = declared.split_once("<!ENTITY") {
        declared = rest;
        let Some((name, rest)) = rest.trim_start().split_once(char::is_whitespace) else { break };
        let rest = rest.trim_start();
        let Some(quote) = rest.chars().next().filter(|quote| ['"', '\''].contains(quote)) else { continue };
        let Some((value, rest)) = rest[1..].split_once(quote) else { break };
        entities.entry(name.to_owned()).or_insert_with(|| value.to_owned());
        declared = rest;
    }
    entities
}
