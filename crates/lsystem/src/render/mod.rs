//! From a drawing's graph to pixels.
//!
//! The picture is what stroking every segment in drawing order would show: round caps, 4x4 subsamples a pixel, each
//! keeping the colour drawn last, no stroke thinner than a pixel. It is made in the opposite order, last drawn
//! first, so that what is covered already need not be looked at again.

mod canvas;
mod pen;
mod resolve;
mod shape;
mod stroke;
mod view;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

pub use view::{Rect, View, Viewport, fit, fitted_scale, to_model};

use crate::{BlockId, ColourBy, Drawing, Heading, Item, Progress, Style};
use canvas::Canvas;
use pen::Pen;
use shape::Shape;
use std::sync::Arc;
use stroke::Capsule;
use view::{Camera, SAMPLES};

/// What a picture took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// Blocks looked into.
    pub blocks: u64,
    /// Strokes painted one by one.
    pub strokes: u64,
    /// Tiles painted.
    pub stamps: u64,
    /// Tiles made.
    pub tiles: u64,
}

/// Makes pictures of a drawing, one after the other, in the same memory.
#[derive(Default)]
pub struct Renderer {
    drawing: Option<Arc<Drawing>>,
    shapes: Vec<Shape>,
    frame: Canvas,
    stack: Vec<Node>,
    look: Look,
    output: resolve::Output,
    stats: RenderStats,
}

/// What holds for a whole picture.
#[derive(Clone, Copy, Debug, Default)]
struct Look {
    colour_by: ColourBy,
    colours: u32,
    /// Half the smallest stroke width, in subsamples.
    hairline: f64,
    /// Subsamples in one step length.
    step: f64,
}

/// A block being painted, from its last item to its first.
#[derive(Clone, Copy, Debug)]
struct Node {
    block: BlockId,
    /// The items from here on are done.
    cursor: u32,
    place: Place,
    pen: Pen,
}

/// Where a block is on the canvas.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Its origin, in subsamples, y down.
    x: f64,
    y: f64,
    /// Subsamples in one of its units.
    scale: f64,
    heading: Heading,
    /// The heading's cosine and sine, times the scale.
    cos: f64,
    sin: f64,
}

impl Place {
    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x + self.cos * x - self.sin * y, self.y - self.sin * x - self.cos * y]
    }
}

/// The largest extent, in subsamples, at which a block is painted as a line.
const TINY: f64 = 1.5;
/// A straight block longer than this is taken apart, so that rounding stays far below a subsample.
const LONG: f64 = 1e6;

impl Renderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes the drawing that the next pictures are of.
    pub fn load(&mut self, drawing: Arc<Drawing>) {
        self.shapes = shape::shapes(&drawing);
        self.drawing = Some(drawing);
        self.stack.clear();
    }

    /// Starts a picture of the loaded drawing; a picture that was being made is given up.
    pub fn begin(&mut self, style: &Style, viewport: Viewport, view: View) {
        self.stats = RenderStats::default();
        self.stack.clear();
        let colours = pen::colours(style);
        let digits = (u32::BITS - (colours - 1).leading_zeros()) as usize;
        let (width, height) = (viewport.width as usize, viewport.height as usize);
        self.frame.reset(width * SAMPLES as usize, height * SAMPLES as usize, digits);
        self.output.begin(style, width, height);
        let Some(drawing) = &self.drawing else { return };
        let camera = Camera::new(drawing, viewport, view);
        let min_width = (style.min_width * viewport.ratio).max(1.0);
        let hairline = if min_width.is_finite() { min_width * SAMPLES / 2.0 } else { SAMPLES / 2.0 };
        self.look = Look { colour_by: style.colour_by, colours, hairline, step: camera.step };
        let Some(root) = drawing.root else { return };
        let place = Place {
            x: camera.x,
            y: camera.y,
            scale: camera.scale,
            heading: Heading::EAST,
            cos: camera.scale,
            sin: 0.0,
        };
        let pen = Pen { colour: 0, width: drawing.width, level: 0 };
        let Some(block) = drawing.blocks.get(root.0 as usize) else { return };
        self.stack.push(Node { block: root, cursor: block.items.end, place, pen });
    }

    /// Goes on with the picture for about `work` units (one unit is in the order of 10 to 100 nanoseconds).
    pub fn step(&mut self, work: usize) -> Progress {
        let mut left = work.max(1) as i64;
        let Some(drawing) = self.drawing.clone() else {
            return self.output.step(&self.frame, &mut left);
        };
        while left > 0 {
            let Some(node) = self.stack.last_mut() else {
                return self.output.step(&self.frame, &mut left);
            };
            if node.cursor <= drawing.blocks[node.block.0 as usize].items.start {
                self.stack.pop();
                continue;
            }
            node.cursor -= 1;
            let node = *node;
            left -= 1;
            match &drawing.items[node.cursor as usize] {
                Item::Stroke(stroke) => {
                    let pen = node.pen.after(&drawing.styles[stroke.style.0 as usize]);
                    let (from, to) = (node.place.point(stroke.from), node.place.point(stroke.to));
                    left -= self.stroke(from, to, pen);
                }
                Item::Block(placed) => {
                    let [x, y] = node.place.point(placed.at);
                    let heading = node.place.heading + placed.heading;
                    let scale = node.place.scale * placed.scale;
                    let (c, s) = heading.cos_sin();
                    let place = Place { x, y, scale, heading, cos: scale * c, sin: scale * s };
                    let pen = node.pen.after(&drawing.styles[placed.style.0 as usize]);
                    left -= self.block(&drawing, placed.block, place, pen);
                }
            }
        }
        Progress::More
    }

    /// The picture so far: RGBA, 8 bits each, opaque, from the upper left corner row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.output.pixels()
    }

    /// What the picture took so far.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.stats
    }

    fn radius(&self, width: f64) -> f64 {
        (width * self.look.step / 2.0).max(self.look.hairline)
    }

    fn stroke(&mut self, from: [f64; 2], to: [f64; 2], pen: Pen) -> i64 {
        self.stats.strokes += 1;
        let ink = pen.ink(self.look.colours, self.look.colour_by);
        let capsule = Capsule { from, to, radius: self.radius(pen.width) };
        capsule.paint(&mut self.frame, ink) as i64 / 4
    }

    fn block(&mut self, drawing: &Drawing, id: BlockId, place: Place, pen: Pen) -> i64 {
        let block = &drawing.blocks[id.0 as usize];
        let shape = &self.shapes[id.0 as usize];
        if shape.strokes == 0 {
            return 0;
        }
        let radius = self.radius(block.widest.factor * pen.width + block.widest.offset);
        let [x, y] = place.point(shape.centre);
        let reach_x = place.cos.abs() * shape.half[0] + place.sin.abs() * shape.half[1] + radius;
        let reach_y = place.sin.abs() * shape.half[0] + place.cos.abs() * shape.half[1] + radius;
        let across = [(x - reach_x).floor() as i64, (x + reach_x).ceil() as i64];
        let down = [(y - reach_y).floor() as i64, (y + reach_y).ceil() as i64];
        if self.frame.is_full(across, down) {
            return 0;
        }
        let extent = 2.0 * place.scale * shape.half[0].max(shape.half[1]);
        if let Some(line) = &shape.line
            && extent < LONG
        {
            let (from, to, pen) = (place.point(line.from), place.point(line.to), pen.after(&line.style));
            return self.stroke(from, to, pen);
        }
        if extent <= TINY {
            let along = if shape.half[0] >= shape.half[1] { [shape.half[0], 0.0] } else { [0.0, shape.half[1]] };
            let ends = [-1.0, 1.0]
                .map(|sign| place.point([shape.centre[0] + sign * along[0], shape.centre[1] + sign * along[1]]));
            return self.stroke(ends[0], ends[1], pen);
        }
        self.stats.blocks += 1;
        self.stack.push(Node { block: id, cursor: block.items.end, place, pen });
        1
    }
}
