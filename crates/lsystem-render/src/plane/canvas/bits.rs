//! A small picture as bits, laid out like a canvas.

/// Bit planes of a tile, each laid out as on a canvas: by strip, then row.
pub(in crate::plane) struct Planes<'a> {
    /// Before and behind the planes there is a group of words more at least.
    pub words: &'a [u64],
    /// Where the first plane begins.
    pub first: usize,
    /// Words of a plane.
    pub size: usize,
    pub count: usize,
}

/// The bits of a tile.
pub(in crate::plane) struct Bits<'a> {
    pub rows: usize,
    /// By strip: the first row that has bits, and 2^32 times the row after the last.
    pub extents: &'a [u64],
    pub covered: Planes<'a>,
    pub colours: Planes<'a>,
    /// The digits of colours that are dyed already.
    pub dyed: Option<Planes<'a>>,
}
