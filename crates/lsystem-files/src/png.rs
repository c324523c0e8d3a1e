//! Texts in PNG files (PNG specification, third edition, sections 5 and 11.3.3.4).

use lsystem_base::MAX_FILE;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};
use std::borrow::Cow;

/// The keyword of a system among the texts.
pub(super) const KEYWORD: &str = "L-system";

const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Whether a file starts with the PNG signature.
pub(super) fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(&SIGNATURE)
}

/// The system in a PNG file.
pub(super) fn system_in(png: &[u8]) -> Option<Cow<'_, str>> {
    // One is enough; a few more bound the work.
    PngChunks::new(png)?
        .filter(|chunk| chunk.data.starts_with(KEYWORD.as_bytes()))
        .take(8)
        .find_map(|chunk| chunk.system())
}

/// A compressed text, no longer than one byte more than is read.
fn unpacked(text: &[u8]) -> Option<Vec<u8>> {
    decompress_to_vec_zlib_with_limit(text, MAX_FILE + 1)
        .map_or_else(|error| Some(error.output).filter(|_| error.status == TINFLStatus::HasMoreOutput), Some)
}

struct Chunk<'a> {
    kind: [u8; 4],
    data: &'a [u8],
}

impl<'a> Chunk<'a> {
    /// The text under [`KEYWORD`]. The checksum is not verified, because the text of a damaged file may still be whole.
    fn system(&self) -> Option<Cow<'a, str>> {
        let text = self.data.strip_prefix(KEYWORD.as_bytes())?.strip_prefix(b"\0")?;
        match &self.kind {
            b"iTXt" => {
                let ([is_packed, _], text) = text.split_first_chunk()?;
                let text = text.splitn(3, |&byte| byte == 0).nth(2)?;
                match is_packed {
                    0 => Some(String::from_utf8_lossy(text)),
                    _ => Some(String::from_utf8_lossy(&unpacked(text)?).into_owned().into()),
                }
            }
            // Programs that save a picture again may write these types of chunks, which are Latin-1.
            b"tEXt" => Some(text.iter().map(|&byte| char::from(byte)).collect()),
            b"zTXt" => Some(unpacked(text.get(1..)?)?.into_iter().map(char::from).collect()),
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
        Some(Chunk { kind: *kind, data: &whole[8..8 + length] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chunk with a wrong checksum, which is never verified.
    fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
        [&(data.len() as u32).to_be_bytes(), kind.as_slice(), data, &[0; 4]].concat()
    }

    #[test]
    fn the_text_under_the_keyword() {
        let header = [SIGNATURE.as_slice(), &chunk(b"IHDR", &[0; 13])].concat();
        let rest = [chunk(b"tEXt", b"Software\0x"), chunk(b"IDAT", b"123"), chunk(b"IEND", b"")].concat();
        assert_eq!(system_in(&[header.clone(), rest.clone()].concat()), None);
        let packed = |text| miniz_oxide::deflate::compress_to_vec_zlib(text, 6);
        let texts: [(&[u8; 4], &[u8], Option<&str>); 6] = [
            (b"iTXt", b"L-system\0\0\0\0\0{\xc3\xa9}", Some("{é}")),
            (b"iTXt", &[b"L-system\0\x01\0\0\0", &packed("{é}".as_bytes())[..]].concat(), Some("{é}")),
            (b"iTXt", b"L-system\0\x01\0\0\0{}", None),
            (b"tEXt", b"L-system\0{\xe9}", Some("{é}")),
            (b"zTXt", &[b"L-system\0\0", &packed(b"{\xe9}")[..]].concat(), Some("{é}")),
            (b"zTXt", b"L-system\0\0{}", None),
        ];
        for (kind, data, expected) in texts {
            let file = [header.clone(), chunk(kind, data), rest.clone()].concat();
            assert_eq!(system_in(&file).as_deref(), expected, "{data:?}");
            for end in 0..file.len() {
                // A file cut anywhere must not panic, and shows a text only if its chunk is whole.
                let is_whole = end >= file.len() - rest.len();
                assert_eq!(system_in(&file[..end]).as_deref(), expected.filter(|_| is_whole), "{end}");
            }
        }
        assert_eq!(system_in(b"GIF89a"), None);
    }
}
