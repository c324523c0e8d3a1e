//! QR codes of links.

use qrcodegen::{QrCode, QrCodeEcc, QrSegment, Version};
use wasm_bindgen::prelude::*;

/// The highest version, with 137 modules a side. Higher versions are too fine for a phone that reads a screen or a
/// slide.
const FINEST: u8 = 30;

/// The modules of a text's QR code (ISO/IEC 18004), row by row from the top left, 1 for dark. The caller adds the quiet
/// zone of four modules. `undefined` if the text is too long.
#[wasm_bindgen]
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
