//! The bottom-up strategy, for crowds: the picture of each part is made once, from the pictures of the parts inside it.
//! The innermost part comes first and the whole drawing last.
//!
//! A part is put into the nearest cell of a lattice, so it is off by at most half a cell. The errors of many parts
//! inside each other add up to some cells.

use crate::ink::{Dye, InkTable, Shade};
use crate::plane::RenderStats;
use crate::plane::canvas::Canvas;
use crate::plane::canvas::bits::{Bits, Planes};
use crate::plane::descent::{Descent, Node};
use layout::{Layout, Trials, is_empty, size};
mod layout;
mod parts;

use crate::plane::canvas::bit_words::{GROUP, GroupBits};
use crate::plane::canvas::cone::Cone;
use crate::plane::canvas::polygon::Filling;
use crate::plane::pen::Pen;
use crate::plane::top_down::tile;
use crate::plane::view::Measure;
pub(in crate::plane) use layout::PART_WORDS;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Item, StyleId};
use parts::Parts;
pub(in crate::plane) use parts::{Part, PartSource};

/// The finished picture of a part.
#[derive(Debug, Default)]
struct PartPicture {
    /// A group of nothing, the extents and the planes of [`Bits`], a group of nothing.
    words: Vec<u64>,
    strips: usize,
    rows: usize,
    planes: usize,
}

impl PartPicture {
    fn new(canvas: &Canvas) -> Self {
        let mut picture = Self { words: vec![], strips: canvas.strips, rows: canvas.height, planes: canvas.planes };
        picture.words.reserve_exact(picture.plane(1 + picture.planes) + GROUP);
        picture.words.resize(GROUP, 0);
        tile::append_bits(canvas, &mut picture.words);
        picture.words.resize(picture.words.len() + GROUP, 0);
        picture
    }

    /// The first word of a plane; plane 0 is the coverage.
    fn plane(&self, number: usize) -> usize {
        GROUP + self.strips * (1 + number * self.rows)
    }

    fn bits(&self, dye: &Dye) -> Bits<'_> {
        let planes = |first, count| Planes { words: &self.words, first, size: self.strips * self.rows, count };
        let colours = |count| planes(self.plane(1), count);
        Bits {
            rows: self.rows,
            extents: &self.words[GROUP..GROUP + self.strips],
            covered: planes(self.plane(0), 1),
            colours: colours(self.planes),
            dyed: (dye.entry.number == 0 && !dye.is_even(self.planes)).then(|| colours(dye.digits)),
        }
    }

    /// 64 bits of a row of a plane, from a column on; bits outside the picture are 0.
    fn word(&self, plane: usize, [column, row]: [i64; 2]) -> u64 {
        let strip = column.div_euclid(u64::BITS.into());
        let word = |strip: i64| match (usize::try_from(strip), usize::try_from(row)) {
            (Ok(strip), Ok(row)) if strip < self.strips && row < self.rows => {
                self.words[self.plane(plane) + strip * self.rows + row]
            }
            _ => 0,
        };
        match column.rem_euclid(u64::BITS.into()) as u32 {
            0 => word(strip),
            shift => word(strip) >> shift | word(strip + 1) << (u64::BITS - shift),
        }
    }
}

/// A bottom-up picture in the making.
pub(in crate::plane) struct BottomUp {
    measure: Measure,
    root: Node,
    /// The upper left and the lower right corner of the whole picture, in subsamples.
    seen: [[f64; 2]; 2],
    parts: Parts,
    layout: Layout,
    trials: Trials,
    /// By part, as long as the picture is needed.
    pictures: Vec<Option<PartPicture>>,
    canvas: Canvas,
    /// The polygon that is being filled.
    filling: Filling,
    /// The number of parts begun, from the last in order on.
    begun: usize,
    /// The part on the canvas, and the number of its joints that are done.
    making: Option<(Node, usize)>,
    /// The number of strips of the whole picture that are done.
    strips: usize,
}

impl BottomUp {
    /// Starts a picture of the drawing `root` that shows the rectangle `seen`, given by its upper left and lower right
    /// corners in subsamples; `None` if the drawing is too large.
    pub(in crate::plane) fn new(
        source: PartSource<'_>,
        measure: Measure,
        root: Node,
        seen: [[f64; 2]; 2],
    ) -> Option<Self> {
        Some(Self {
            measure,
            root,
            seen,
            parts: Parts::new(source.drawing, source.shapes, measure, root)?,
            layout: Layout::default(),
            trials: Trials::default(),
            pictures: vec![],
            canvas: Canvas::default(),
            filling: Filling::default(),
            begun: 0,
            making: None,
            strips: 0,
        })
    }

    /// The index of the part that was begun last.
    fn index(&self) -> usize {
        self.parts.order[self.parts.order.len() - self.begun]
    }

    /// Starts the next part.
    fn begin(&mut self, source: PartSource<'_>, descent: &mut Descent) {
        let index = self.index();
        let area = self.layout.areas[index];
        if is_empty(area) {
            return;
        }
        let part = &self.parts.list[index];
        let [width, height] = size(area).map(|side| side as usize);
        self.canvas.reset(width, height, source.planes(part));
        let phase = self.layout.phases[index];
        let origin = [0, 1].map(|axis| phase[axis] - area[0][axis] as f64);
        let node = descent.part(source.drawing, part, origin, 1.0 / f64::from(self.layout.grain));
        self.making = Some((node, 0));
    }

    /// Paints the next item of the part on the canvas. Returns the units of work.
    fn item(
        &mut self,
        source: PartSource<'_>,
        descent: &mut Descent,
        mut node: Node,
        joints: usize,
        stats: &mut RenderStats,
    ) -> u64 {
        let PartSource { drawing, shapes, inks } = source;
        let index = self.index();
        if node.cursor == drawing.blocks[node.block.0 as usize].items.start {
            self.canvas.settle();
            self.pictures[index] = Some(PartPicture::new(&self.canvas));
            self.making = None;
            stats.parts += 1;
            // Keeping the picture takes as much work as painting it.
            return 1 + 2 * self.canvas.take_work();
        }
        node.cursor -= 1;
        self.making = Some((node, joints));
        let style = |style: StyleId| node.pen.after(inks.choice, &drawing.styles[style.0 as usize]);
        match &drawing.items[node.cursor as usize] {
            Item::Stroke(stroke) => {
                stats.strokes += 1;
                let ends = [stroke.from, stroke.to].map(|end| node.place.point(end));
                self.stroke(inks, ends, style(stroke.style))
            }
            Item::Polygon(polygon) => {
                stats.strokes += 1;
                let vertices = drawing.vertices_of(polygon).iter().map(|&v| node.place.point(v));
                self.filling.begin(&self.canvas, vertices, inks.code(style(polygon.style).shade))
            }
            Item::Block(placed) => {
                let child = descent.child(drawing, inks.choice, &node, placed);
                let shape = &shapes[placed.block.0 as usize];
                let joint = self.parts.list[index].joints.start + joints;
                if joint < self.parts.list[index].joints.end && self.parts.joints[joint].item == node.cursor {
                    self.making = Some((node, joints + 1));
                    return self.stamp(inks, index, joint, child.pen.shade, stats);
                }
                if shape.strokes == 0 {
                    return 1;
                }
                stats.strokes += 1;
                let measure = self.measure;
                let mut stroke = |ends: [[f64; 2]; 2], pen| {
                    let ends = ends.map(|end| child.place.point(end));
                    self.stroke(inks, ends, pen)
                };
                if let Some(line) = &shape.line {
                    let pen = child.pen.after(inks.choice, &line.style);
                    return line
                        .parts(pen.widths)
                        .rev()
                        .map(|(ends, widths)| stroke(ends, Pen { widths, ..pen }))
                        .sum();
                }
                let pen = child.pen.after(inks.choice, &shape.last);
                let pens = measure.pens(&drawing.blocks[placed.block.0 as usize], child.pen, pen);
                pens.map(|pen| stroke(shape.axis(), pen)).sum()
            }
        }
    }

    fn stroke(&mut self, inks: &InkTable, ends: [[f64; 2]; 2], pen: Pen) -> u64 {
        // A stroke thinner than a cell would have gaps.
        let radius = |width: f64| (self.measure.radius(width) / f64::from(self.layout.grain)).max(0.5);
        let radii = pen.widths.ends().map(radius);
        Cone { ends, radii }.paint(&mut self.canvas, inks.code(pen.shade)) as u64 / 4 + 1
    }

    /// Stamps the inner part of a joint, entered with a shade. Returns the units of work.
    fn stamp(&mut self, inks: &InkTable, index: usize, joint: usize, shade: Shade, stats: &mut RenderStats) -> u64 {
        if !self.layout.is_used(&self.parts, index, joint) {
            return 1;
        }
        stats.stamps += 1;
        let inner = self.parts.joints[joint].part;
        let Some(picture) = &self.pictures[inner] else { return 1 };
        let dye = inks.dye(inks.of(self.parts.list[inner].block.0 as usize), shade);
        let corners = [self.layout.areas[inner][0], self.layout.areas[index][0]];
        let at = [0, 1].map(|axis| corners[0][axis] + self.layout.shifts[joint][axis] - corners[1][axis]);
        self.canvas.stamp(&picture.bits(&dye), at, &dye);
        let took = picture.words.len() as u64 / 32 + 1;
        self.layout.uses[inner] -= 1;
        if self.layout.uses[inner] == 0 {
            self.pictures[inner] = None;
        }
        took
    }

    /// Copies a strip of the finished picture to the frame. Returns the units of work.
    fn copy_strip(&mut self, frame: &mut Canvas) -> u64 {
        let Some(root) = self.parts.order.first().copied() else { return 1 };
        let Some(picture) = &self.pictures[root] else { return 1 };
        let grain = i64::from(self.layout.grain);
        let corner = [0, 1].map(|axis| self.layout.origin[axis] + self.layout.areas[root][0][axis]);
        let column = (self.strips * u64::BITS as usize) as i64 / grain - corner[0];
        for group in 0..frame.rows / GROUP {
            let block = |plane: usize| -> GroupBits {
                core::array::from_fn(|row| {
                    let row = (group * GROUP + row) as i64 / grain - corner[1];
                    enlarged(picture.word(plane, [column, row]), self.layout.grain)
                })
            };
            frame.put(self.strips, group, block(0), |plane| block(1 + plane));
        }
        (frame.rows * (1 + picture.planes)) as u64 / 8
    }
}

impl BottomUp {
    /// Finds the parts and their layout; `None` if the parts are too many or take too much.
    pub(in crate::plane) fn plan(
        &mut self,
        source: PartSource<'_>,
        descent: &mut Descent,
        meter: &mut Meter,
    ) -> Option<Progress> {
        if self.parts.step(source, self.measure, descent, meter)? == Progress::More {
            return Some(Progress::More);
        }
        while !meter.is_spent() {
            let found = self.trials.step(&self.parts, self.root.place.origin, self.seen, |part| source.planes(part))?;
            meter.charge(1 + (self.parts.joints.len() + self.parts.list.len()) as u64 / 4);
            if let Some(layout) = found {
                self.layout = layout;
                self.pictures.resize_with(self.parts.list.len(), || None);
                return Some(Progress::Done);
            }
        }
        Some(Progress::More)
    }

    /// Whether the parts and their layout are known.
    pub(in crate::plane) fn is_planned(&self) -> bool {
        !self.pictures.is_empty()
    }

    /// Goes on with the planned picture.
    pub(in crate::plane) fn step(
        &mut self,
        source: PartSource<'_>,
        descent: &mut Descent,
        frame: &mut Canvas,
        stats: &mut RenderStats,
        meter: &mut Meter,
    ) -> Progress {
        while !meter.is_spent() {
            if !self.filling.is_done() {
                self.filling.step(&mut self.canvas, meter);
            } else if let Some((node, joints)) = self.making {
                meter.charge(self.item(source, descent, node, joints, stats));
                meter.charge(self.canvas.take_work());
            } else if self.begun < self.parts.order.len() {
                self.begun += 1;
                self.begin(source, descent);
                meter.charge(1);
            } else if self.strips < frame.strips {
                meter.charge(self.copy_strip(frame));
                self.strips += 1;
            } else {
                return Progress::Done;
            }
        }
        Progress::More
    }
}

/// The first bits of a word, each repeated `times` times; `times` is a power of two.
fn enlarged(word: u64, times: u32) -> u64 {
    if times == 1 {
        return word;
    }
    let mut word = enlarged(word, times / 2) & u64::from(u32::MAX);
    for (shift, mask) in [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ] {
        word = (word | word << shift) & mask;
    }
    word | word << 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::sample::Sample;
    use crate::plane::shape::shapes;
    use crate::plane::view::{View, ViewTransform};
    use crate::viewport::Viewport;

    #[test]
    fn bits_are_enlarged() {
        for times in [1, 2, 4] {
            let word = 0x9e37_79b9_7f4a_7c15;
            let enlarged = enlarged(word, times);
            assert!((0..64).all(|bit| enlarged >> bit & 1 == word >> (bit / times) & 1), "{times}");
        }
    }

    #[test]
    fn pictures_of_parts_take_no_more_room_than_they_may() {
        let viewport = Viewport { width: 1600, height: 1000, ratio: 1.0 };
        for (sample, zoom) in [
            (Sample::lowercase("A", &[('A', "g[+A][-A]")], 20.0), 1.0),
            (Sample::lowercase("g", &[('g', "g[+g][-g]")], 20.0), 1.0),
            (Sample::abop("X", &[('X', "F[+X][-X]")], 20.0), 2.0),
        ] {
            let drawing = sample.draw(40);
            let (shapes, mut inks, mut descent) = (shapes(&drawing), InkTable::default(), Descent::default());
            inks.choose(&drawing, &sample.0.style);
            inks.prepare(&drawing, &mut Meter::new(u64::MAX));
            let source = PartSource { drawing: &drawing, shapes: &shapes, inks: &inks };
            let transform = ViewTransform::new(&drawing, viewport, View { zoom, ..View::default() }, 4.0);
            let measure = Measure { hairline: 2.0, step: transform.step, scale: transform.scale };
            let root = descent.root(&drawing, transform).unwrap();
            let mut bottom_up = BottomUp::new(source, measure, root, [[0.0; 2], [6400.0, 4000.0]]).unwrap();
            while bottom_up.plan(source, &mut descent, &mut Meter::new(1000)).unwrap() == Progress::More {}
            let mut frame = Canvas::default();
            frame.reset(6400, 4000, inks.picture_planes());
            let mut stats = RenderStats::default();
            let mut most = 0;
            while bottom_up.step(source, &mut descent, &mut frame, &mut stats, &mut Meter::new(1000)) == Progress::More
            {
                // The words of extents and of the groups around a picture are few, and left out.
                let kept: usize = bottom_up.pictures.iter().flatten().map(|p| p.strips * p.rows * (1 + p.planes)).sum();
                most = most.max(kept + bottom_up.canvas.covered.len() + bottom_up.canvas.colours.len());
            }
            assert!((PART_WORDS / 8..=PART_WORDS + PART_WORDS / 64).contains(&(most as u64)), "{most} of {PART_WORDS}");
            assert_eq!(bottom_up.pictures.iter().flatten().count(), 1, "the whole is left");
            assert_eq!(stats.parts as usize, bottom_up.pictures.len());
        }
    }

    #[test]
    fn strokes_thinner_than_a_cell_are_not_torn() {
        let viewport = Viewport { width: 64, height: 64, ratio: 1.0 };
        let sample = Sample::abop("X", &[('X', "F[+X][-X]")], 20.0);
        let drawing = sample.draw(20);
        let (shapes, mut inks, mut descent) = (shapes(&drawing), InkTable::default(), Descent::default());
        inks.choose(&drawing, &sample.0.style);
        inks.prepare(&drawing, &mut Meter::new(u64::MAX));
        let source = PartSource { drawing: &drawing, shapes: &shapes, inks: &inks };
        let transform = ViewTransform::new(&drawing, viewport, View::default(), 1.0);
        // With one subsample in a pixel and four pixels in a cell, a stroke is an eighth of a cell wide.
        let measure = Measure { hairline: 0.5, step: transform.step, scale: transform.scale };
        let root = descent.root(&drawing, transform).unwrap();
        let pen = root.pen;
        let mut bottom_up = BottomUp::new(source, measure, root, [[0.0; 2], [64.0; 2]]).unwrap();
        bottom_up.layout.grain = 4;
        bottom_up.canvas.reset(64, 64, inks.picture_planes());
        bottom_up.stroke(&inks, [[2.0, 20.3], [62.0, 31.7]], pen);
        let columns = bottom_up.canvas.covered.iter().fold(0, |all, row| all | row);
        assert_eq!(columns | 0b11 | 0b11 << 62, u64::MAX, "{columns:064b}");
    }
}
