//! Drawings and a brute-force picture for the tests of this module.

use super::view::Camera;
use super::{View, Viewport};
use crate::{BlockId, ColourBy, Definition, Dialect, Drawing, Item, Limits, Style, StyleChange, System, draw};

/// Subsamples along one side of a pixel, by definition.
const SAMPLES: f64 = 4.0;

/// A system to be drawn at several n.
#[derive(Clone, Debug)]
pub(super) struct Sample(pub Definition);

impl Sample {
    pub(super) fn abop(axiom: &str, rules: &[(char, &str)], angle: f64) -> Self {
        let rules: Vec<String> = rules.iter().map(|(predecessor, word)| format!("{predecessor} -> {word}")).collect();
        Self(Definition { axiom: axiom.into(), rules: rules.join("\n"), angle, ..Definition::default() })
    }

    pub(super) fn lowercase(axiom: &str, rules: &[(char, &str)], angle: f64) -> Self {
        let Self(abop) = Self::abop(axiom, rules, angle);
        Self(Definition { dialect: Dialect::Lowercase, ..abop })
    }

    /// With this stroke width, in steps.
    pub(super) fn wide(mut self, width: f64) -> Self {
        self.0.style.width = width;
        self
    }

    pub(super) fn draw(&self, n: u32) -> Drawing {
        let (system, diagnostics) = System::new(&self.0);
        let system = system.unwrap_or_else(|| panic!("{diagnostics:?}"));
        draw(&system, n, &Limits::default()).unwrap_or_else(|d| panic!("{d:?}"))
    }
}

/// The turtle's colour index, branch level and width in steps.
#[derive(Clone, Copy)]
struct Pen {
    colour: i32,
    level: u32,
    width: f64,
}

impl Pen {
    fn after(self, change: &StyleChange) -> Self {
        Self {
            colour: change.colour.of(self.colour),
            level: self.level + change.level,
            width: change.width.of(self.width),
        }
    }

    fn ink(self, style: &Style) -> usize {
        match style.colour_by {
            ColourBy::Single => 0,
            ColourBy::Symbol => (self.colour as isize).rem_euclid(style.palette.len() as isize) as usize,
            ColourBy::Level => self.level as usize % style.palette.len(),
        }
    }
}

/// The picture by definition: every segment in drawing order, every subsample by its distance.
pub(super) fn brute_force(drawing: &Drawing, style: &Style, viewport: Viewport, view: View) -> Vec<u8> {
    brute_force_until(drawing, style, viewport, view, usize::MAX)
}

/// As [`brute_force`], of the first `upto` segments.
pub(super) fn brute_force_until(
    drawing: &Drawing,
    style: &Style,
    viewport: Viewport,
    view: View,
    upto: usize,
) -> Vec<u8> {
    let mut left = upto;
    let camera = Camera::new(drawing, viewport, view, SAMPLES);
    let (width, height) = (viewport.width as i64 * 4, viewport.height as i64 * 4);
    let mut inks = vec![None; (width * height) as usize];
    let hairline = (style.min_width * viewport.ratio).max(1.0) * SAMPLES / 2.0;
    // Complex numbers: multiply by the turn and scale, then add.
    type Place = ([f64; 2], [f64; 2]);
    fn at((origin, turn): Place, p: [f64; 2]) -> [f64; 2] {
        [origin[0] + turn[0] * p[0] - turn[1] * p[1], origin[1] + turn[1] * p[0] + turn[0] * p[1]]
    }
    fn visit(drawing: &Drawing, block: BlockId, place: Place, pen: Pen, out: &mut dyn FnMut([f64; 2], [f64; 2], Pen)) {
        let range = drawing.blocks[block.0 as usize].items.clone();
        for item in &drawing.items[range.start as usize..range.end as usize] {
            match item {
                Item::Stroke(s) => {
                    out(at(place, s.from), at(place, s.to), pen.after(&drawing.styles[s.style.0 as usize]));
                }
                Item::Block(p) => {
                    let (c, s) = p.heading.cos_sin();
                    let turn = [c * p.scale, s * p.scale];
                    let turned = at(([0.0; 2], place.1), turn);
                    visit(
                        drawing,
                        p.block,
                        (at(place, p.at), turned),
                        pen.after(&drawing.styles[p.style.0 as usize]),
                        out,
                    );
                }
            }
        }
    }
    let pen = Pen { colour: 0, width: drawing.width, level: 0 };
    let [x, y] = camera.place(Default::default());
    let start = ([x, -y], [camera.scale, 0.0]);
    visit(drawing, drawing.root.unwrap(), start, pen, &mut |a, b, pen| {
        let Some(rest) = left.checked_sub(1) else { return };
        left = rest;
        let r = (pen.width * camera.step / 2.0).max(hairline);
        let (a, b) = ([a[0], -a[1]], [b[0], -b[1]]);
        let range = |axis: usize, end: i64| {
            let low = (a[axis].min(b[axis]) - r - 1.0).clamp(0.0, end as f64) as i64;
            low..(a[axis].max(b[axis]) + r + 2.0).clamp(0.0, end as f64) as i64
        };
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let norm = dx * dx + dy * dy;
        for row in range(1, height) {
            for column in range(0, width) {
                let (px, py) = (column as f64 + 0.5 - a[0], row as f64 + 0.5 - a[1]);
                let t = if norm > 0.0 { ((px * dx + py * dy) / norm).clamp(0.0, 1.0) } else { 0.0 };
                let (qx, qy) = (px - t * dx, py - t * dy);
                if qx * qx + qy * qy <= r * r {
                    inks[(row * width + column) as usize] = Some(pen.ink(style));
                }
            }
        }
    });
    let mut pixels = vec![];
    for y in 0..viewport.height as i64 {
        for x in 0..viewport.width as i64 {
            let mut sum = [0.0; 3];
            for (sy, sx) in (0..4).flat_map(|sy| (0..4).map(move |sx| (sy, sx))) {
                let ink = inks[((y * 4 + sy) * width + x * 4 + sx) as usize];
                let colour = ink.map_or(style.background, |ink| style.palette[ink]);
                for (sum, value) in sum.iter_mut().zip(colour.rgb) {
                    *sum += f64::from(value) / 16.0;
                }
            }
            pixels.extend(sum.map(|v| libm::round(v) as u8));
            pixels.push(u8::MAX);
        }
    }
    pixels
}
