//! A small picture as bits, laid out like a canvas.

/// Bit planes of a tile, each laid out as on a canvas: by strip, then row.
pub(in crate::plane) struct Planes<'a> {
    /// The words. At least one group of other words lies before the planes, and one behind.
    pub words: &'a [u64],
    /// The index of the first word of the first plane.
    pub first: usize,
    /// The number of words in a plane.
    pub size: usize,
    pub count: usize,
}

/// The bits of a tile.
pub(in crate::plane) struct Bits<'a> {
    pub rows: usize,
    /// By strip: the first row that has bits, plus 2^32 times the row after the last.
    pub extents: &'a [u64],
    pub covered: Planes<'a>,
    pub colours: Planes<'a>,
    /// The digits of the dyed colours, if there is a copy.
    pub dyed: Option<Planes<'a>>,
}
