//! Bytes as short texts for links: compressed with zlib (RFC 1950) and written in base64url (RFC 4648) without padding.
//! The checksum of zlib detects damaged texts.

use base64::engine::general_purpose::{self, GeneralPurpose};
use base64::{Engine as _, alphabet};
use lsystem_base::word;
use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};

/// Trailing bits may have any value, as in browsers.
const BASE64URL: GeneralPurpose =
    GeneralPurpose::new(&alphabet::URL_SAFE, general_purpose::NO_PAD.with_decode_allow_trailing_bits(true));

/// The highest level that all implementations share; the page's browsers choose their own.
const LEVEL: u8 = 9;

/// Compresses bytes and writes them as a text.
#[must_use]
pub fn pack(bytes: &[u8]) -> String {
    BASE64URL.encode(compress_to_vec_zlib(bytes, LEVEL))
}

/// Reads what [`pack`] writes, at most `most` bytes.
///
/// # Errors
/// A sentence's end that says what is wrong with the text.
pub fn unpack(text: &str, most: usize) -> Result<Vec<u8>, &'static str> {
    let bytes = BASE64URL.decode(text).map_err(|_| word!("is damaged or cut off"))?;
    decompress_to_vec_zlib_with_limit(&bytes, most).map_err(|error| match error.status {
        TINFLStatus::HasMoreOutput => word!("is larger than anything that is needed"),
        _ => word!("is damaged or cut off"),
    })
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
            assert_eq!(BASE64URL.encode(bytes), text);
            assert_eq!(BASE64URL.decode(text).as_deref(), Ok(bytes.as_bytes()));
        }
        for wrong in ["A", "AAAAA", "Zg==", "Zm9+", "Zm9/", "Zm 9", "Zé"] {
            assert!(BASE64URL.decode(wrong).is_err(), "{wrong}");
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
