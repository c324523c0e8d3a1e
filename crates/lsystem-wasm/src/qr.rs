//! QR codes of links.

use qrcodegen::{QrCode, QrCodeEcc, QrSegment, Version};
use wasm_bindgen::prelude::*;

/// Codes of a higher version are too fine for a phone that looks at a screen or a slide; this one has 137 modules a side.
const FINEST: u8 = 30;

/// The modules of a text's QR code (ISO/IEC 18004), row by row from the top left, 1 for dark; the quiet zone of four
/// modules is left to the reader. Nothing where the text is too long for a code that can be read.
#[wasm_bindgen]
pub fn qr_code(text: &str) -> Option<Vec<u8>> {
    // Links have too few runs of digits and capitals for the denser modes to gain anything.
    let segments = [QrSegment::make_bytes(text.as_bytes())];
    // As few modules as can be; correction is raised where that leaves room for it.
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
