//! Drawings and a brute-force picture for the tests of this module.

use super::pen::{Pen, SAME, compose};
use super::view::{Camera, SAMPLES};
use super::{View, Viewport};
use crate::{
    Action, Block, BlockId, ColourChange, Dialect, Drawing, Heading, Item, Placed, Stroke, Style, StyleChange, StyleId,
    WidthChange,
};
use std::collections::HashMap;

/// A deterministic system with balanced productions.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub axiom: &'static str,
    pub rules: &'static [(char, &'static str)],
    pub dialect: Dialect,
    pub angle: f64,
    pub start: f64,
    pub width: f64,
}

impl Sample {
    pub(super) fn abop(axiom: &'static str, rules: &'static [(char, &'static str)], angle: f64) -> Self {
        Self { axiom, rules, dialect: Dialect::Abop, angle, start: 90.0, width: 0.0 }
    }

    pub(super) fn draw(&self, n: u32) -> Drawing {
        let mut builder =
            Builder { sample: self, drawing: empty(self.width), styles: vec![SAME], memo: HashMap::new() };
        let root = builder.block(self.axiom, n, Heading::from_degrees(self.start));
        builder.drawing.root = Some(root.id);
        builder.drawing.styles = builder.styles;
        builder.drawing
    }
}

fn empty(width: f64) -> Drawing {
    Drawing {
        pieces: vec![],
        blocks: vec![],
        items: vec![],
        corners: vec![],
        styles: vec![],
        root: None,
        start: [0.0; 2],
        step: 1.0,
        width,
        memoised: true,
    }
}

struct Builder<'a> {
    sample: &'a Sample,
    drawing: Drawing,
    styles: Vec<StyleChange>,
    memo: HashMap<(char, u32), Built>,
}

/// A block and what it does to the turtle; `end` is in block units.
#[derive(Clone, Copy)]
struct Built {
    id: BlockId,
    end: [f64; 2],
    heading: Heading,
    style: StyleChange,
}

impl Builder<'_> {
    fn style(&mut self, style: StyleChange) -> StyleId {
        let at = self.styles.iter().position(|s| *s == style).unwrap_or_else(|| {
            self.styles.push(style);
            self.styles.len() - 1
        });
        StyleId(at as u32)
    }

    fn block(&mut self, word: &str, depth: u32, start: Heading) -> Built {
        for symbol in word.chars() {
            if let Some((_, successor)) = self.sample.rules.iter().find(|(s, _)| *s == symbol)
                && depth > 0
                && !self.memo.contains_key(&(symbol, depth))
            {
                let built = self.block(successor, depth - 1, Heading::EAST);
                self.memo.insert((symbol, depth), built);
            }
        }
        // In units of the largest child.
        let ready: Vec<(char, Option<Built>)> =
            word.chars().map(|s| (s, self.memo.get(&(s, depth)).copied())).collect();
        let exponent = ready
            .iter()
            .filter_map(|(_, b)| b.map(|b| self.drawing.blocks[b.id.0 as usize].exponent))
            .max()
            .unwrap_or(0)
            .max(0);
        let (mut at, mut heading, mut style) = ([0.0, 0.0], start, SAME);
        let (mut open, mut items, mut corners, mut segments) = (vec![], vec![], vec![], 0_u128);
        let mut widest = WidthChange { factor: 1.0, offset: 0.0 };
        let unit = libm::scalbn(1.0, -exponent);
        let turn = Heading::from_degrees(self.sample.angle);
        for (symbol, built) in ready {
            if let Some(built) = built {
                let child = self.drawing.blocks[built.id.0 as usize].clone();
                let scale = libm::scalbn(1.0, child.exponent - exponent);
                let (c, s) = heading.cos_sin();
                let place = |[x, y]: [f64; 2]| [at[0] + scale * (c * x - s * y), at[1] + scale * (s * x + c * y)];
                corners.extend(
                    self.drawing.corners[child.hull.start as usize..child.hull.end as usize].iter().map(|&p| place(p)),
                );
                let end = place(built.end);
                let id = self.style(style);
                items.push(Item::Block(Placed { block: built.id, style: id, at, heading, scale }));
                segments = segments.saturating_add(child.segments);
                widest.factor = widest.factor.max(child.widest.factor * style.width.factor);
                widest.offset = widest.offset.max(child.widest.offset);
                (at, heading, style) = (end, heading + built.heading, compose(&style, &built.style));
                continue;
            }
            for action in self.sample.dialect.actions(symbol) {
                let (c, s) = heading.cos_sin();
                match *action {
                    Action::Draw(_) => {
                        let to = [at[0] + unit * c, at[1] + unit * s];
                        corners.extend([at, to]);
                        let id = self.style(style);
                        items.push(Item::Stroke(Stroke { from: at, to, style: id }));
                        widest.factor = widest.factor.max(style.width.factor);
                        segments += 1;
                        at = to;
                    }
                    Action::Move(_) => at = [at[0] + unit * c, at[1] + unit * s],
                    Action::TurnLeft(_) => heading += turn,
                    Action::TurnRight(_) => heading += -turn,
                    Action::TurnRound => heading += Heading::HALF,
                    Action::Push => {
                        open.push((at, heading, style));
                        style.level += 1;
                    }
                    Action::Pop => (at, heading, style) = open.pop().unwrap_or((at, heading, style)),
                    Action::SetColour(k) => style.colour = ColourChange::Set(k),
                    Action::AddColour(k) => {
                        style = compose(&style, &StyleChange { colour: ColourChange::Add(k), ..SAME });
                    }
                    Action::ScaleWidth(k) => style.width.factor *= k,
                    Action::SetWidth(_) => {}
                }
            }
        }
        // Normalise to an extent of about 1.
        let extent = corners.iter().fold(0.0_f64, |m, p: &[f64; 2]| m.max(p[0].abs()).max(p[1].abs()));
        let shift = if extent > 0.0 { libm::ilogb(extent) } else { 0 };
        let k = libm::scalbn(1.0, -shift);
        let small = |p: [f64; 2]| p.map(|v| v * k);
        for item in &mut items {
            match item {
                Item::Stroke(s) => (s.from, s.to) = (small(s.from), small(s.to)),
                Item::Block(p) => (p.at, p.scale) = (small(p.at), p.scale * k),
            }
        }
        let drawing = &mut self.drawing;
        let (i, c) = (drawing.items.len() as u32, drawing.corners.len() as u32);
        drawing.items.extend(items);
        drawing.corners.extend(hull(corners.into_iter().map(small).collect()));
        drawing.blocks.push(Block {
            items: i..drawing.items.len() as u32,
            exponent: exponent + shift,
            segments,
            hull: c..drawing.corners.len() as u32,
            widest,
        });
        let id = BlockId(drawing.blocks.len() as u32 - 1);
        Built { id, end: small(at), heading: heading - start, style }
    }
}

/// The convex hull (Andrew's monotone chain).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = vec![];
        for p in points {
            while let [.., a, b] = chain[..]
                && (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) <= 1e-12
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter().copied());
    lower.extend(half(&mut points.iter().rev().copied()));
    lower
}

/// The picture by definition: every segment in drawing order, every subsample by its distance.
pub(super) fn brute_force(drawing: &Drawing, style: &Style, viewport: Viewport, view: View) -> Vec<u8> {
    let camera = Camera::new(drawing, viewport, view);
    let (width, height) = (viewport.width as i64 * 4, viewport.height as i64 * 4);
    let mut inks = vec![None; (width * height) as usize];
    let hairline = (style.min_width * viewport.ratio).max(1.0) * SAMPLES / 2.0;
    let colours = style.palette.len() as u32;
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
    let start = ([camera.x, -camera.y], [camera.scale, 0.0]);
    visit(drawing, drawing.root.unwrap(), start, pen, &mut |a, b, pen| {
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
                    inks[(row * width + column) as usize] = Some(pen.ink(colours, style.colour_by));
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
                let colour = ink.map_or(style.background, |ink| style.palette[ink as usize]);
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
