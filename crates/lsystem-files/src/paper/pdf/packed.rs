//! Page content, compressed while it is written.

use miniz_oxide::deflate::core::{CompressorOxide, TDEFLFlush, compress_to_output, create_comp_flags_from_zip_params};
use pdf_writer::Content;

/// The bytes of content that are compressed at a time.
const PIECE: usize = 1 << 14;
/// The level of compression, from 0 to 10: a higher level takes more time and gains little.
const LEVEL: i32 = 6;

/// A content stream. It holds the content that is not compressed yet.
pub(super) struct PackedContent {
    pub(super) content: Content,
    compressor: Box<CompressorOxide>,
    packed: Vec<u8>,
}

impl PackedContent {
    pub(super) fn new() -> Self {
        // A positive window size asks for a zlib header, as PDF needs it.
        let flags = create_comp_flags_from_zip_params(LEVEL, 1, 0);
        Self { content: Content::new(), compressor: Box::new(CompressorOxide::new(flags)), packed: vec![] }
    }

    /// Compresses the content if it has grown to a piece. Returns the number of bytes that were compressed.
    pub(super) fn pack(&mut self) -> u64 {
        if self.content.len() < PIECE { 0 } else { self.compress(TDEFLFlush::None) }
    }

    /// The whole stream, compressed. The next stream begins empty.
    pub(super) fn end(&mut self) -> Vec<u8> {
        self.compress(TDEFLFlush::Finish);
        self.compressor.reset();
        core::mem::take(&mut self.packed)
    }

    fn compress(&mut self, flush: TDEFLFlush) -> u64 {
        let mut piece = core::mem::replace(&mut self.content, Content::new()).finish().into_vec();
        // Operators need white space between them.
        piece.push(b'\n');
        let packed = &mut self.packed;
        // The closure always takes all bytes, so that compressing cannot fail.
        compress_to_output(&mut self.compressor, &piece, flush, |bytes| {
            packed.extend(bytes);
            true
        });
        piece.len() as u64
    }
}
