//! Bytes as short texts for links: compressed with zlib (RFC 1950) and written in base64url (RFC 4648) without padding.
//! The checksum of zlib detects damaged texts.

use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// The highest level that all implementations share; the page's browsers choose their own.
const LEVEL: u8 = 9;

/// Compresses bytes and writes them as a text.
#[must_use]
pub fn pack(bytes: &[u8]) -> String {
    to_base64(&compress_to_vec_zlib(bytes, LEVEL))
}

/// Reads what [`pack`] writes, at most `most` bytes.
///
/// # Errors
/// A sentence's end that says what is wrong with the text.
pub fn unpack(text: &str, most: usize) -> Result<Vec<u8>, &'static str> {
    let bytes = from_base64(text).ok_or("is damaged or cut off")?;
    decompress_to_vec_zlib_with_limit(&bytes, most).map_err(|error| match error.status {
        TINFLStatus::HasMoreOutput => "is larger than anything that is needed",
        _ => "is damaged or cut off",
    })
}

/// Writes bytes in base64url without padding.
#[must_use]
pub fn to_base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let at = |index: usize| u32::from(part.get(index).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for digit in 0..=part.len() {
            text.push(char::from(DIGITS[(bits >> (18 - 6 * digit) & 63) as usize]));
        }
    }
    text
}

/// Reads base64url without padding; `None` if the text is something else.
#[must_use]
pub fn from_base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for part in text.as_bytes().chunks(4) {
        let mut bits = 0;
        for at in 0..4 {
            let digit = match part.get(at) {
                Some(byte) => DIGITS.iter().position(|digit| digit == byte)?,
                None => 0,
            };
            bits = bits << 6 | digit as u32;
        }
        let held = part.len() * 6 / 8;
        if held == 0 {
            return None;
        }
        bytes.extend_from_slice(&bits.to_be_bytes()[1..=held]);
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_as_in_the_standard() {
        // RFC 4648, section 10, and digits 62 and 63.
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg"),
            ("fo", "Zm8"),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg"),
            ("fooba", "Zm9vYmE"),
            ("foobar", "Zm9vYmFy"),
            ("~~?", "fn4_"),
            ("~>>", "fj4-"),
        ] {
            assert_eq!(to_base64(bytes.as_bytes()), text);
            assert_eq!(from_base64(text).as_deref(), Some(bytes.as_bytes()));
        }
        for wrong in ["A", "AAAAA", "Zg==", "Zm9+", "Zm9/", "Zm 9", "Zé"] {
            assert_eq!(from_base64(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn what_is_packed_is_unpacked_within_a_limit() {
        let bytes: Vec<u8> = (0..10_000_u32).map(|i| ((i * i) >> 7) as u8).collect();
        let text = pack(&bytes);
        assert_eq!(unpack(&text, bytes.len()).as_ref(), Ok(&bytes));
        assert!(unpack(&text, bytes.len() - 1).unwrap_err().contains("larger"));
        assert!(unpack(&text[..text.len() - 8], 1 << 20).is_err(), "cut off");
        let zeros = pack(&vec![0; 1 << 20]);
        assert!(zeros.len() < 2000 && unpack(&zeros, 1 << 19).is_err());
    }
}
