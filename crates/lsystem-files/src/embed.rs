//! Systems in the metadata of pictures, and reading a system from any file of this library.

mod attachment;
mod metadata;

use super::{png, read_json};
use lsystem_base::{LimitName, MAX_FILE, MAX_TEXT, say};
use lsystem_syntax::{Definition, Diagnostic, Field};
pub(super) use metadata::write_metadata;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
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
    let plain = plain(bytes);
    let bytes = &*plain;
    let too_long = || Diagnostic::limit(LimitName::Text, MAX_FILE as u64, None);
    let no_system = |picture: &str| {
        Diagnostic::error(say!("This {} holds no L-system", picture))
            .hint(say!("Only {} files that were saved here carry the system they show.", picture))
    };
    let found = if png::is_png(bytes) {
        png::system_in(bytes).ok_or_else(|| no_system("PNG"))
    } else if is_pdf(bytes) {
        attachment::system_in(bytes).map(Cow::Owned).ok_or_else(|| {
            let lost = no_system("PDF");
            // Encrypted and damaged files, and ways to pack that are not read.
            lost.hint(say!(
                "If another program has saved this PDF, `pdfdetach -saveall FILE` may take the L-system out of it."
            ))
        })
    } else if is_xml(bytes) {
        metadata::system_in(bytes).map(Cow::Owned).ok_or_else(|| no_system("SVG"))
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
    let plain = plain(bytes);
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

fn is_pdf(bytes: &[u8]) -> bool {
    bytes.starts_with(b"%PDF-")
}

/// The file's bytes without compression (`.svgz`) and without a byte order mark. UTF-16 with a mark, as Windows programs
/// write it, becomes UTF-8.
fn plain(bytes: &[u8]) -> Cow<'_, [u8]> {
    // Larger files are not converted or unpacked to their end, to bound the memory.
    const LONGEST: usize = 32 * MAX_FILE;
    let read: fn([u8; 2]) -> u16 = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => return rest.into(),
        [0x1f, 0x8b, 8, flags, _, _, _, _, _, _, rest @ ..] if flags & !8 == 0 => {
            return gunzipped(rest, *flags).into();
        }
        [0xff, 0xfe, ..] if bytes.len() <= LONGEST => u16::from_le_bytes,
        [0xfe, 0xff, ..] if bytes.len() <= LONGEST => u16::from_be_bytes,
        _ => return bytes.into(),
    };
    let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| read([pair[0], pair[1]])).collect();
    String::from_utf16_lossy(&units).into_bytes().into()
}

/// What follows the first ten bytes of a file of gzip (RFC 1952), which may have a name.
fn gunzipped(rest: &[u8], flags: u8) -> Vec<u8> {
    let packed = if flags == 0 { rest } else { rest.splitn(2, |&byte| byte == 0).nth(1).unwrap_or_default() };
    decompress_to_vec_with_limit(packed, 4 * MAX_FILE).unwrap_or_else(|error| error.output)
}

/// Whether a text of others is a system: an object with the key that every system has.
fn is_system(text: &str) -> bool {
    text.trim_start().starts_with('{') && text.contains("\"initial\"")
}

/// The place of a text in a file.
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
