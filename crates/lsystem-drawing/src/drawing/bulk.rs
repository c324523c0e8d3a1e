//! Fast reading of millions of segments: each small block is written out once, then copied, rotated and moved.
use super::Drawing;
use super::segments::{BlockFrame, Strokes};
use crate::drawing::block::{BlockId, Item};
use crate::plane::Directions;
use crate::style::{ColourChange, StyleChange};
use lsystem_base::LimitName;
use lsystem_syntax::{Diagnostic, Heading};

/// The most segments of a block that is copied as a whole: enough to make the preparation of a copy cheap, few enough
/// to keep the copy's source in the processor's L1 cache.
const COPIED: u128 = 2048;
/// The most segments handed to a visitor at a time: the buffers stay in the L2 cache.
const CHUNK: usize = 8192;

/// Segments as arrays of plain numbers, in drawing order. A reused value keeps its memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SegmentArrays {
    /// From x, from y, to x, to y of each segment, in model units.
    pub ends: Vec<f32>,
    /// The colour index of each segment, not yet wrapped to a palette.
    pub colours: Vec<i32>,
    /// The branch level of each segment; 65,535 stands for that level or deeper.
    pub levels: Vec<u16>,
}

/// Consecutive segments; the fields as in [`SegmentArrays`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "documented at SegmentArrays")]
pub struct SegmentChunk<'a> {
    pub ends: &'a [f32],
    pub colours: &'a [i32],
    pub levels: &'a [u16],
}

impl SegmentArrays {
    fn resize(&mut self, segments: usize) {
        self.ends.resize(4 * segments, 0.0);
        self.colours.resize(segments, 0);
        self.levels.resize(segments, 0);
    }

    /// The slices for `len` segments from number `first` on.
    fn slices(&mut self, first: usize, len: usize) -> SegmentSlices<'_> {
        SegmentSlices {
            ends: &mut self.ends[4 * first..4 * (first + len)],
            colours: &mut self.colours[first..first + len],
            levels: &mut self.levels[first..first + len],
        }
    }

    /// The first `len` segments.
    fn first(&self, len: usize) -> SegmentChunk<'_> {
        SegmentChunk { ends: &self.ends[..4 * len], colours: &self.colours[..len], levels: &self.levels[..len] }
    }
}

impl Drawing {
    /// Replaces `arrays` by all segments. Coordinates are exact to 1e-6 of the drawing's size, unless the start is far
    /// from the origin compared with that size.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if there are more than `most` segments; `arrays` is then empty.
    pub fn write_segments(&self, most: u64, arrays: &mut SegmentArrays) -> Result<(), Diagnostic> {
        let count = usize::try_from(self.segment_count()).ok().filter(|&count| count as u64 <= most);
        arrays.resize(count.unwrap_or(0));
        if count.is_none() {
            return Err(Diagnostic::limit(LimitName::Segments, most, None));
        }
        let mut done = 0;
        Emitter::new(self).run(&mut |len, write| {
            write(arrays.slices(done, len));
            done += len;
        });
        Ok(())
    }

    /// Hands all segments to `visit` in drawing order, up to 8,192 at a time. Every call reuses one small buffer, which
    /// is faster than writing all segments to memory. Precision as in [`Drawing::write_segments`].
    pub fn for_each_chunk(&self, mut visit: impl FnMut(SegmentChunk<'_>)) {
        let mut chunk = SegmentArrays::default();
        chunk.resize(CHUNK);
        let mut done = 0;
        Emitter::new(self).run(&mut |len, write| {
            if done + len > CHUNK {
                visit(chunk.first(done));
                done = 0;
            }
            write(chunk.slices(done, len));
            done += len;
        });
        if done > 0 {
            visit(chunk.first(done));
        }
    }
}

/// The slices that receive the next segments.
struct SegmentSlices<'a> {
    ends: &'a mut [f32],
    colours: &'a mut [i32],
    levels: &'a mut [u16],
}

/// Makes room for a number of segments, then calls the function that writes them.
type Sink<'s> = &'s mut dyn FnMut(usize, &mut dyn FnMut(SegmentSlices<'_>));

/// The segments of a block in its own frame.
struct BlockCopy {
    ends: Vec<f32>,
    colours: Colours,
    levels: Levels,
}

/// The colour changes of a copy's segments.
enum Colours {
    Same(ColourChange),
    /// By segment: a mask for the colour at entry (all bits or none), and the number added.
    Each(Vec<i32>, Vec<i32>),
}

/// The branch levels of a copy's segments, relative to the entry.
enum Levels {
    Same(u32),
    Each(Vec<u16>),
}

/// Writes the segments of a drawing.
struct Emitter<'a> {
    drawing: &'a Drawing,
    directions: Directions,
    /// By block: the copy, and the scale of its coordinates.
    copies: Vec<Option<(f64, BlockCopy)>>,
    /// Rotated copies, by a hash of block and heading. The first copy in a place stays. If there are more headings than
    /// places, most copies are rotated while they are written.
    turned: Vec<Option<TurnedCopy>>,
}

/// The ends of a block copy, rotated by a heading.
struct TurnedCopy {
    block: BlockId,
    heading: Heading,
    scale: f64,
    ends: Vec<f32>,
}

/// There are `2^TURNED` places for rotated copies: more would not stay in the processor's caches.
const TURNED: u32 = 7;

impl<'a> Emitter<'a> {
    fn new(drawing: &'a Drawing) -> Self {
        let copies = drawing.blocks.iter().map(|_| None).collect();
        let turned = (0..1 << TURNED).map(|_| None).collect();
        Self { drawing, directions: Directions::default(), copies, turned }
    }

    fn run(&mut self, sink: Sink<'_>) {
        let drawing = self.drawing;
        let Some(root) = drawing.root else { return };
        let mut base = BlockFrame::new(drawing.unit(), StyleChange::start(drawing.width));
        base.at = drawing.start;
        if self.is_copied(root) {
            return self.copy(root, &base, sink);
        }
        let mut open = vec![(drawing.items_of(root), base)];
        while let Some((items, frame)) = open.last_mut() {
            match items.split_first() {
                None => {
                    open.pop();
                }
                Some((item, rest)) => {
                    *items = rest;
                    match item {
                        Item::Stroke(stroke) => {
                            let style = frame.style.then(&drawing.styles[stroke.style.0 as usize]);
                            let ends = ends(frame.transform(stroke.from), frame.transform(stroke.to));
                            sink(1, &mut |slices| {
                                slices.ends.copy_from_slice(&ends);
                                slices.colours[0] = style.colour.of(0);
                                slices.levels[0] = level(style.level);
                            });
                        }
                        Item::Polygon(_) => {}
                        Item::Block(placed) => {
                            let inner = frame.place(placed, drawing, &mut self.directions);
                            if self.is_copied(placed.block) {
                                self.copy(placed.block, &inner, sink);
                            } else {
                                open.push((drawing.items_of(placed.block), inner));
                            }
                        }
                    }
                }
            }
        }
    }

    /// Whether a copy of the block pays off: the block is small and probably placed more than once.
    fn is_copied(&self, block: BlockId) -> bool {
        self.drawing.memoised && self.drawing.blocks[block.0 as usize].segments <= COPIED
    }

    fn copy(&mut self, block: BlockId, frame: &BlockFrame, sink: Sink<'_>) {
        let slot = &mut self.copies[block.0 as usize];
        if slot.as_ref().is_none_or(|(scale, _)| *scale != frame.scale) {
            *slot = Some((frame.scale, BlockCopy::new(self.drawing, block, frame.scale)));
        }
        let Some((_, copy)) = slot else { return };
        let (c, s) = self.directions.cos_sin(frame.heading);
        let (turn, at) = ((c as f32, s as f32), frame.at.map(|c| c as f32));

        let hash = (frame.heading.units() ^ u64::from(block.0) << 48).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let turned = self.turned[(hash >> (64 - TURNED)) as usize].get_or_insert_with(|| {
            let mut ends = vec![0.0; copy.ends.len()];
            place(&copy.ends, turn, [0.0; 2], &mut ends);
            TurnedCopy { block, heading: frame.heading, scale: frame.scale, ends }
        });
        let fits = turned.block == block && turned.heading == frame.heading && turned.scale == frame.scale;
        sink(copy.ends.len() / 4, &mut |slices| {
            if fits {
                shift(&turned.ends, at, slices.ends);
            } else {
                place(&copy.ends, turn, at, slices.ends);
            }
            copy.write_styles(&frame.style, slices.colours, slices.levels);
        });
    }
}

impl BlockCopy {
    fn new(drawing: &Drawing, block: BlockId, scale: f64) -> Self {
        let mut strokes = Strokes::new(drawing);
        strokes.enter(block, &BlockFrame::new(scale, StyleChange::NONE));
        let (mut all_ends, mut changes, mut deep) = (vec![], vec![], vec![]);
        for (from, to, style) in strokes {
            all_ends.extend(ends(from, to));
            changes.push(style.colour);
            deep.push(style.level);
        }
        let colours = match changes.first() {
            Some(&first) if changes.iter().all(|&change| change == first) => Colours::Same(first),
            _ => {
                let split = |change: ColourChange| match change {
                    ColourChange::Set(index) => (0, index),
                    ColourChange::Add(by) => (!0, by),
                };
                let (kept, added) = changes.into_iter().map(split).unzip();
                Colours::Each(kept, added)
            }
        };
        let levels = match deep.first() {
            Some(&first) if deep.iter().all(|&level| level == first) => Levels::Same(first),
            _ => Levels::Each(deep.into_iter().map(level).collect()),
        };
        Self { ends: all_ends, colours, levels }
    }

    /// Writes colours and levels for a block that is entered in `style`.
    fn write_styles(&self, style: &StyleChange, colours: &mut [i32], levels: &mut [u16]) {
        let colour = style.colour.of(0);
        match &self.colours {
            Colours::Same(change) => colours.fill(change.of(colour)),
            Colours::Each(kept, added) => {
                for ((out, kept), added) in colours.iter_mut().zip(kept).zip(added) {
                    *out = (colour & kept).wrapping_add(*added);
                }
            }
        }
        match &self.levels {
            Levels::Same(deeper) => levels.fill(level(style.level.saturating_add(*deeper))),
            Levels::Each(deeper) => {
                let base = level(style.level);
                for (out, deeper) in levels.iter_mut().zip(deeper) {
                    *out = base.saturating_add(*deeper);
                }
            }
        }
    }
}

/// Moves segments. Lanes with equal work let the compiler emit vector instructions.
fn shift(ends: &[f32], [x, y]: [f32; 2], out: &mut [f32]) {
    let at = [x, y, x, y, x, y, x, y];
    let ((pairs, odd), (out_pairs, out_odd)) = (ends.as_chunks::<8>(), out.as_chunks_mut::<8>());
    for (out, p) in out_pairs.iter_mut().zip(pairs) {
        for lane in 0..8 {
            out[lane] = p[lane] + at[lane];
        }
    }
    for ((out, p), at) in out_odd.iter_mut().zip(odd).zip(at) {
        *out = p + at;
    }
}

/// Rotates and moves segments.
fn place(ends: &[f32], (c, s): (f32, f32), [x, y]: [f32; 2], out: &mut [f32]) {
    for (out, p) in out.as_chunks_mut::<2>().0.iter_mut().zip(ends.as_chunks::<2>().0) {
        *out = [p[0] * c - p[1] * s + x, p[0] * s + p[1] * c + y];
    }
}

fn ends(from: [f64; 2], to: [f64; 2]) -> [f32; 4] {
    [from[0] as f32, from[1] as f32, to[0] as f32, to[1] as f32]
}

fn level(level: u32) -> u16 {
    u16::try_from(level).unwrap_or(u16::MAX)
}
