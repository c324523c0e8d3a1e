//! Systems in the metadata of SVG pictures, as they were written here or by a program that has saved the picture again.

use super::{find, is_system};
use crate::xml;
use lsystem_base::MAX_FILE;

/// The identifier of the element that holds the system. Programs that put a picture into another one add to it, and those
/// that make files small leave it out.
const ID: &str = "L-system";
/// The name of the element. Programs may put a prefix before it.
const NAME: &str = "metadata";
/// The start of text that has no escapes.
const RAW: &str = "<![CDATA[";

/// Writes a system as an element of an SVG file, unless `system` is empty.
pub(crate) fn write_metadata(text: &mut String, system: &str) {
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
    for part in ["<metadata id=\"", ID, "\">", &xml::escape(&held), "</metadata>\n"] {
        text.push_str(part);
    }
}

/// The system in an SVG file.
pub(super) fn system_in(svg: &[u8]) -> Option<String> {
    let mut rest = svg;
    while let Some(at) = find(rest, NAME) {
        let before = &rest[..at];
        rest = &rest[at + NAME.len()..];
        let prefix = before.rsplit(|&byte| byte == b'<').next().filter(|prefix| prefix.len() < before.len());
        let is_tag = prefix.is_some_and(|prefix| match prefix.split_last() {
            Some((end, name)) => *end == b':' && name.iter().all(u8::is_ascii_alphanumeric),
            None => true,
        });
        let is_whole = rest.first().is_some_and(|byte| byte.is_ascii_whitespace() || b"/>".contains(byte));
        if is_tag && is_whole {
            let end = tag_end(rest)?;
            let is_named = has_id(&String::from_utf8_lossy(&rest[..end]));
            rest = &rest[end + 1..];
            let text = text_at(rest)?;
            if is_named && !text.trim().is_empty() || is_system(&text) {
                return Some(text);
            }
        }
    }
    None
}

/// The place of the `>` that ends a tag.
fn tag_end(bytes: &[u8]) -> Option<usize> {
    let mut quote = None;
    bytes.iter().position(|&byte| {
        match quote {
            None if matches!(byte, b'"' | b'\'') => quote = Some(byte),
            Some(open) if open == byte => quote = None,
            _ => {}
        }
        quote.is_none() && byte == b'>'
    })
}

/// Whether the attributes of an element have the identifier of the system.
fn has_id(attributes: &str) -> bool {
    let mut rest = attributes;
    while let Some((name, after)) = rest.split_once('=') {
        let after = after.trim_start();
        let Some((value, more)) = after.get(1..).and_then(|text| text.split_once(&after[..1])) else { return false };
        if name.trim() == "id" {
            return value.starts_with(ID);
        }
        rest = more;
    }
    false
}

/// The text up to the next tag.
fn text_at(bytes: &[u8]) -> Option<String> {
    let mut text = String::new();
    let mut rest = bytes;
    while let Some(at) = find(rest, "<") {
        // An escaped character takes at most ten bytes, so a longer text exceeds `MAX_FILE` anyway.
        text += &xml::unescape(&String::from_utf8_lossy(&rest[..at.min(10 * MAX_FILE + 10)]));
        let Some(raw) = rest[at..].strip_prefix(RAW.as_bytes()) else { return Some(text) };
        let end = find(raw, "]]>")?;
        text += &String::from_utf8_lossy(&raw[..end.min(MAX_FILE + 1)]);
        rest = &raw[end + 3..];
        if text.len() > MAX_FILE {
            return Some(text);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use crate::read_file;

    #[test]
    fn any_way_to_write_the_metadata() {
        let check = |tag: &str, title: Option<&str>| {
            let svg = format!("<?xml version=\"1.0\"?>\n<svg xmlns:s=\"a\">{tag}<g/></svg>");
            let found = read_file(svg.as_bytes());
            assert_eq!(found.definition.as_ref().map(|found| &*found.title), title, "{tag}");
            if title.is_none() {
                assert_eq!(found.diagnostics[0].message, "This SVG holds no L-system", "{tag}");
            }
        };
        let text = "{\"initial\": \"F\", \"title\": \"F>\"}";
        let escaped = "\n {&quot;initial&quot;: 'F', &quot;title&quot;: &#x22;F&gt;&#34;}\n".replace('\'', "&quot;");
        for tag in [
            "<metadata id=\"L-system\">",
            "<metadata\n   id = 'L-system-3' >",
            "<metadata\ta=\"id='b'>\" id='L-system'>",
        ] {
            check(&format!("{tag}{escaped}</metadata>"), Some("F>"));
            check(&format!("{tag}<![CDATA[{text}]]></metadata >"), Some("F>"));
            check(&format!("{tag}{{\"initial\": \"F\", \"title\": <![CDATA[\"F>\"]]>}}</metadata>"), Some("F>"));
            // Programs may add what they know about the picture.
            check(&format!("{tag}{escaped}<r:RDF>a</r:RDF></metadata>"), Some("F>"));
        }
        check(&format!("<s:metadata id='L-system'>{escaped}</s:metadata>"), Some("F>"));
        check(&format!("<metadata id='a'><b/></metadata><metadata id='L-system'>{escaped}</metadata>"), Some("F>"));
        check(&format!("<metadata id='L-system'/><metadata>{escaped}</metadata>"), Some("F>"));
        // Metadata of others, and what only looks like metadata.
        check("<metadata>{\"a\": 1}</metadata><desc id=\"L-system\">{}</desc>", None);
        check(&format!("<metadatas id='L-system'>{escaped}</metadatas>"), None);
        check(&format!("<desc>metadata id='L-system'>{escaped}</desc>"), None);
    }
}
