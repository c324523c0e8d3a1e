//! Systems in the metadata of pictures, and reading a system from any file of this library.

use super::{png, read_json, xml};
use lsystem_base::{LimitName, MAX_FILE, MAX_TEXT, say};
use lsystem_syntax::{Definition, Diagnostic, Field};
use std::borrow::Cow;

/// The result of [`read_file`].
#[derive(Clone, Debug, PartialEq)]
pub struct FileContent {
    /// The system; `None` if a diagnostic is an error.
    pub definition: Option<Definition>,
    /// Errors and warnings about the file.
    pub diagnostics: Vec<Diagnostic>,
    /// The JSON text that the diagnostics' spans refer to; empty if there is none.
    pub json: String,
}

/// Reads a system from a file's bytes: JSON ([`read_json`]), or a PNG, SVG or PDF picture with a system in it. The
/// picture may be cut off after the system.
#[must_use]
pub fn read_file(bytes: &[u8]) -> FileContent {
    let plain = without_byte_order_mark(bytes);
    let bytes = &*plain;
    let too_long = || Diagnostic::limit(LimitName::Text, MAX_FILE as u64, None);
    let no_system = |picture: &str| {
        Diagnostic::error(say!("This {} holds no L-system", picture))
            .hint(say!("Only {} files that were saved here carry the system they show.", picture))
    };
    let found = if png::is_png(bytes) {
        png::system_in(bytes).ok_or_else(|| no_system("PNG"))
    } else if is_pdf(bytes) {
        attachment_in(bytes).ok_or_else(|| no_system("PDF"))
    } else if is_xml(bytes) {
        metadata_in(bytes).ok_or_else(|| no_system("SVG"))
    } else if bytes.len() > MAX_FILE {
        Err(too_long())
    } else {
        str::from_utf8(bytes).map(Cow::Borrowed).map_err(|error| {
            let lines = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
            Diagnostic::error(say!("Line {} is not UTF-8 text", lines + 1))
        })
    };
    match found {
        // A text that is too long is neither read nor kept.
        Ok(json) if json.len() > MAX_FILE => refused(too_long()),
        Ok(json) => {
            let (definition, diagnostics) = read_json(&json);
            FileContent { definition, diagnostics, json: json.into_owned() }
        }
        Err(error) => refused(error),
    }
}

/// The text of a file. Characters that are not UTF-8, as in old comments, are replaced. `None` for pictures and for texts
/// longer than [`MAX_TEXT`] bytes.
#[must_use]
pub fn text_of(bytes: &[u8]) -> Option<String> {
    let plain = without_byte_order_mark(bytes);
    if png::is_png(&plain) || is_pdf(&plain) || is_xml(&plain) || plain.len() > MAX_TEXT {
        return None;
    }
    Some(String::from_utf8_lossy(&plain).into_owned())
}

/// The result for a file that is not read.
fn refused(error: Diagnostic) -> FileContent {
    let diagnostics = vec![error.at(Field::File, 0..0)];
    FileContent { definition: None, diagnostics, json: String::new() }
}

/// Whether a file begins with `<`. JSON never does.
fn is_xml(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"<")
}

/// The file's bytes without a byte order mark. UTF-16 with a mark, as Windows programs write it, becomes UTF-8.
fn without_byte_order_mark(bytes: &[u8]) -> Cow<'_, [u8]> {
    // Larger UTF-16 files are not converted, to bound the memory.
    const LONGEST: usize = 32 * MAX_FILE;
    let read: fn([u8; 2]) -> u16 = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => return rest.into(),
        [0xff, 0xfe, ..] if bytes.len() <= LONGEST => u16::from_le_bytes,
        [0xfe, 0xff, ..] if bytes.len() <= LONGEST => u16::from_be_bytes,
        _ => return bytes.into(),
    };
    let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| read([pair[0], pair[1]])).collect();
    String::from_utf16_lossy(&units).into_bytes().into()
}

/// The start tag and the end tag of the element that holds the system.
const OPEN: &str = "<metadata id=\"L-system\">";
const CLOSE: &str = "</metadata>";

/// Writes a system as an element of an SVG file, unless `system` is empty.
pub(super) fn write_metadata(text: &mut String, system: &str) {
    if system.is_empty() {
        return;
    }
    // In JSON, characters that XML cannot hold stand only in strings, where escapes by number are valid.
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
    // An escaped character takes at most ten bytes, so a longer content exceeds `MAX_FILE` anyway.
    let content = &content[..content.len().min(10 * MAX_FILE + 10)];
    Some(xml::unescape(&String::from_utf8_lossy(content)).into())
}

fn is_pdf(bytes: &[u8]) -> bool {
    bytes.starts_with(b"%PDF-")
}

/// The system in a PDF file of this library: the first attached file, which is not compressed.
fn attachment_in(pdf: &[u8]) -> Option<Cow<'_, str>> {
    let rest = &pdf[find(pdf, "/EmbeddedFile")?..];
    let content = &rest[find(rest, "stream\n")? + "stream\n".len()..];
    // No line of a system's JSON begins with this word.
    let content = &content[..find(content, "\nendstream")?];
    Some(String::from_utf8_lossy(content))
}

fn find(bytes: &[u8], text: &str) -> Option<usize> {
    // Compares only at the first byte of `text`, because a file may have hundreds of megabytes.
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
