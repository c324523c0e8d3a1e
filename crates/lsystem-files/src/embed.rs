//! Pictures that carry the system they show, and reading it from any of our files.

use super::{png, read_json, xml};
use lsystem_syntax::{Definition, Diagnostic, Field, Kind, LimitName, MAX_TEXT};
use std::borrow::Cow;

/// What a system is called in a picture's metadata.
pub(super) const KEYWORD: &str = "L-system";

/// What [`read_file`] finds.
#[derive(Clone, Debug, PartialEq)]
pub struct FileContent {
    /// The system; `None` where a diagnostic is an error.
    pub definition: Option<Definition>,
    /// What there is to say about the file.
    pub diagnostics: Vec<Diagnostic>,
    /// The JSON text that the diagnostics' spans point into; empty where none was found.
    pub json: String,
}

/// Reads a system from a file's bytes: JSON ([`read_json`]), or a PNG or SVG picture that carries one. A picture that
/// is cut off after the system is no worse for it.
#[must_use]
pub fn read_file(bytes: &[u8]) -> FileContent {
    let plain = unmarked(bytes);
    let bytes = &*plain;
    let too_long = || Kind::Limit { limit: LimitName::Text, value: MAX_TEXT as u64, largest: None };
    let found = if png::is_png(bytes) {
        png::system_in(bytes).ok_or(Kind::NoSystem { picture: "PNG" })
    } else if is_xml(bytes) {
        metadata_in(bytes).ok_or(Kind::NoSystem { picture: "SVG" })
    } else if bytes.len() > MAX_TEXT {
        Err(too_long())
    } else {
        str::from_utf8(bytes).map(Cow::Borrowed).map_err(|error| {
            let lines = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
            Kind::NotText { line: lines + 1 }
        })
    };
    match found {
        // Nothing of a long text is read or kept.
        Ok(json) if json.len() > MAX_TEXT => refused(too_long()),
        Ok(json) => {
            let (definition, diagnostics) = read_json(&json);
            FileContent { definition, diagnostics, json: json.into_owned() }
        }
        Err(kind) => refused(kind),
    }
}

/// What is said of a file that is not read.
fn refused(kind: Kind) -> FileContent {
    let diagnostics = vec![Diagnostic { kind, field: Field::File, span: 0..0 }];
    FileContent { definition: None, diagnostics, json: String::new() }
}

/// JSON never begins like this.
fn is_xml(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"<")
}

/// Without a byte order mark, and in UTF-8 where that tells of UTF-16, as programs of Windows write it.
fn unmarked(bytes: &[u8]) -> Cow<'_, [u8]> {
    // Nobody keeps pictures larger than this in UTF-16.
    const LONGEST: usize = 32 * MAX_TEXT;
    let read: fn([u8; 2]) -> u16 = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => return rest.into(),
        [0xff, 0xfe, ..] if bytes.len() <= LONGEST => u16::from_le_bytes,
        [0xfe, 0xff, ..] if bytes.len() <= LONGEST => u16::from_be_bytes,
        _ => return bytes.into(),
    };
    let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| read([pair[0], pair[1]])).collect();
    String::from_utf16_lossy(&units).into_bytes().into()
}

/// How the element begins that holds the system.
const OPEN: &str = "<metadata id=\"L-system\">";
const CLOSE: &str = "</metadata>";

/// Writes a system as an element of an SVG file; nothing where `system` is empty.
pub(super) fn write_metadata(text: &mut String, system: &str) {
    if system.is_empty() {
        return;
    }
    // In JSON, characters that XML cannot hold stand in strings only, where they can be written by number.
    let mut held = String::with_capacity(system.len());
    for c in system.trim_end().chars() {
        if xml::is_character(c) {
            held.push(c);
        } else {
            held.push_str(&format!("\\u{:04x}", u32::from(c)));
        }
    }
    for part in [OPEN, &xml::escape(&held), CLOSE, "\n"] {
        text.push_str(part);
    }
}

fn metadata_in(svg: &[u8]) -> Option<Cow<'_, str>> {
    let start = find(svg, OPEN)? + OPEN.len();
    let content = &svg[start..];
    let content = &content[..find(content, CLOSE)?];
    // A character takes ten bytes at most in XML; more of them than a text may have need not be translated.
    let content = &content[..content.len().min(10 * MAX_TEXT + 10)];
    Some(xml::unescape(&String::from_utf8_lossy(content)).into())
}

fn find(bytes: &[u8], text: &str) -> Option<usize> {
    // Looks only where the first byte stands: a file may have hundreds of megabytes.
    let first = *text.as_bytes().first()?;
    let mut from = 0;
    while let Some(at) = bytes[from..].iter().position(|&byte| byte == first) {
        if bytes[from + at..].starts_with(text.as_bytes()) {
            return Some(from + at);
        }
        from += at + 1;
    }
    None
}
