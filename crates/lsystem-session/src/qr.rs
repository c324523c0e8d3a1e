//! QR codes of links.

use qrcodegen::{QrCode, QrCodeEcc, QrSegment, Version};

/// The highest version, with 137 modules a side. Higher versions are too fine for a phone that reads a screen or a
/// slide.
const FINEST: u8 = 30;

/// The modules of a text's QR code (ISO/IEC 18004), row by row from the top left, 1 for dark. The caller adds the quiet
/// zone of four modules. `None` if the text is too long.
#[must_use]
pub fn qr_code(text: &str) -> Option<Vec<u8>> {
    // Links have too few runs of digits and capitals for the denser modes to help.
    let segments = [QrSegment::make_bytes(text.as_bytes())];
    // The code has as few modules as possible; spare room goes to better error correction.
    let low = QrCodeEcc::Low;
    let code = QrCode::encode_segments_advanced(&segments, low, Version::MIN, Version::new(FINEST), None, true).ok()?;
    let side = 0..code.size();
    Some(
        side.clone()
            .flat_map(|y| side.clone().map(move |x| (x, y)))
            .map(|(x, y)| code.get_module(x, y).into())
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn qr_codes_grow_with_the_text_to_a_limit() {
        let side = |text: &str| qr_code(text).map(|modules| modules.len().isqrt());
        let code = qr_code("https://example.org/#v=1&axiom=F").unwrap();
        // Version 2 has room, with 25 modules a side. The first two rows show the finder pattern's ring and its gap.
        assert_eq!(code.len(), 25 * 25);
        assert_eq!(code[..9], [1, 1, 1, 1, 1, 1, 1, 0, code[8]]);
        assert_eq!(code[25..33], [1, 0, 0, 0, 0, 0, 1, 0]);
        assert!(code.iter().all(|&module| module <= 1));
        assert_eq!(side(&"x".repeat(1732)), Some(137));
        assert_eq!(side(&"x".repeat(1733)), None);
        assert_eq!(side(&"x".repeat(1_000_000)), None);
    }
}
