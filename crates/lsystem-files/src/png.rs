//! Texts in PNG files (PNG specification, third edition, sections 5 and 11.3.3.4).

use super::embed::KEYWORD;
use std::borrow::Cow;

const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Whether a file starts with the PNG signature.
pub(super) fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(&SIGNATURE)
}

/// Stores a system, a text of [`write_json`](crate::write_json), in a PNG file for [`read_file`](crate::read_file). A
/// system already in the file is replaced. `None` if `png` is not a PNG file.
#[must_use]
pub fn tag_png(png: &[u8], system: &str) -> Option<Vec<u8>> {
    let mut chunks = PngChunks::new(png)?;
    let header = chunks.next().filter(|chunk| chunk.kind == *b"IHDR")?;
    // No compression, no language, no translated keyword.
    let data = [KEYWORD.as_bytes(), &[0; 5], system.as_bytes()].concat();
    let mut tagged = Vec::with_capacity(png.len() + data.len() + 12);
    tagged.extend(SIGNATURE);
    tagged.extend(header.whole);
    tagged.extend(u32::try_from(data.len()).ok()?.to_be_bytes());
    let start = tagged.len();
    tagged.extend(b"iTXt");
    tagged.extend(data);
    tagged.extend(crc32(&tagged[start..]).to_be_bytes());
    let mut rest = chunks.rest;
    while let Some(chunk) = chunks.next() {
        if chunk.system().is_none() {
            tagged.extend(chunk.whole);
        }
        rest = chunks.rest;
    }
    tagged.extend(rest);
    Some(tagged)
}

/// The system in a PNG file.
pub(super) fn system_in(png: &[u8]) -> Option<Cow<'_, str>> {
    PngChunks::new(png)?.find_map(|chunk| chunk.system())
}

struct Chunk<'a> {
    kind: [u8; 4],
    data: &'a [u8],
    /// The chunk with its length and checksum.
    whole: &'a [u8],
}

impl<'a> Chunk<'a> {
    /// The text under [`KEYWORD`]. The checksum is not verified, because the text of a damaged file may still be whole.
    fn system(&self) -> Option<Cow<'a, str>> {
        let text = self.data.strip_prefix(KEYWORD.as_bytes())?.strip_prefix(b"\0")?;
        match &self.kind {
            b"iTXt" => {
                let mut parts = text.strip_prefix(b"\0\0")?.splitn(3, |&byte| byte == 0);
                let text = parts.nth(2)?;
                Some(String::from_utf8_lossy(text))
            }
            // Programs that save a picture again may write this type of chunk, which is Latin-1.
            b"tEXt" => Some(text.iter().map(|&byte| char::from(byte)).collect()),
            _ => None,
        }
    }
}

/// The chunks of a file, up to the first incomplete chunk.
struct PngChunks<'a> {
    rest: &'a [u8],
}

impl<'a> PngChunks<'a> {
    fn new(png: &'a [u8]) -> Option<Self> {
        png.strip_prefix(&SIGNATURE).map(|rest| Self { rest })
    }
}

impl<'a> Iterator for PngChunks<'a> {
    type Item = Chunk<'a>;

    fn next(&mut self) -> Option<Chunk<'a>> {
        let (length, _) = self.rest.split_first_chunk::<4>()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        let (whole, rest) = self.rest.split_at_checked(length.checked_add(12)?)?;
        let (kind, _) = whole[4..].split_first_chunk::<4>()?;
        self.rest = rest;
        Some(Chunk { kind: *kind, data: &whole[8..8 + length], whole })
    }
}

/// The checksum of a chunk's kind and data (PNG specification, annex D).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc: u32, _| if crc & 1 == 0 { crc >> 1 } else { 0xedb8_8320 ^ crc >> 1 })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums() {
        assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
        assert_eq!(crc32(b"IEND"), 0xae42_6082);
    }

    /// A chunk with a wrong checksum, which is never verified.
    fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
        [&(data.len() as u32).to_be_bytes(), kind.as_slice(), data, &[0; 4]].concat()
    }

    #[test]
    fn one_text_in_front() {
        let header = [SIGNATURE.as_slice(), &chunk(b"IHDR", &[0; 13])].concat();
        let rest = [chunk(b"tEXt", b"Software\0x"), chunk(b"IDAT", b"123"), chunk(b"IEND", b"")].concat();
        let plain = [header.clone(), rest.clone()].concat();
        assert_eq!(system_in(&plain), None);
        let tagged = tag_png(&plain, "{é}").unwrap();
        assert_eq!(system_in(&tagged).as_deref(), Some("{é}"));
        assert!(tagged.starts_with(&header) && tagged.ends_with(&rest));
        let again = tag_png(&tagged, "{}").unwrap();
        assert_eq!(again.len(), tagged.len() - "é".len());
        assert_eq!(system_in(&again).as_deref(), Some("{}"));
        // Bytes after the last whole chunk stay.
        assert!(tag_png(&plain[..plain.len() - 1], "").unwrap().ends_with(&rest[..rest.len() - 1]));

        let latin = [header, chunk(b"tEXt", b"L-system\0{\xe9}")].concat();
        assert_eq!(system_in(&latin).as_deref(), Some("{é}"));
        for end in 0..tagged.len() {
            // A file cut anywhere must not panic.
            let _ = (system_in(&tagged[..end]), tag_png(&tagged[..end], ""));
        }
        assert_eq!(tag_png(b"GIF89a", ""), None);
    }
}
