//! What inks do to the paper's light, and the mean of a block's inks.

use super::ink::{Ink, parts};
use super::sheet::Pigment;
use crate::render::inks::{InkTable, Inks, Shade};
use crate::render::mixer::Mixer;
use crate::{Colour, Drawing, Item, Style};
use core::hash::BuildHasherDefault;
use std::collections::HashMap;

/// The least part of light that a channel is taken to reflect: colours have 256 levels.
const LEAST: f64 = 1.0 / 512.0;

/// How much one layer of ink darkens each channel, as the logarithm of a part (Beer's law): what is left of the paper's
/// light is the ink's. Where the ink is lighter than the paper the same holds of the light that the paper lacks, and
/// the number is negative.
pub(super) fn pigment(ink: Colour, paper: Colour) -> Pigment {
    [0, 1, 2].map(|channel| {
        let [ink, paper] = [ink, paper].map(|colour| f64::from(colour.rgb[channel]) / 255.0);
        let part = |ink: f64, paper: f64| libm::log(paper.max(LEAST) / ink.max(LEAST));
        (if ink <= paper { part(ink, paper) } else { -part(1.0 - ink, 1.0 - paper) }) as f32
    })
}

/// What is left of the paper's channel, as part of full light, under so much of a pigment.
pub(super) fn light(paper: u8, pigment: f64) -> f64 {
    let paper = f64::from(paper) / 255.0;
    if pigment >= 0.0 { paper * libm::exp(-pigment) } else { 1.0 - (1.0 - paper) * libm::exp(pigment) }
}

/// The pigments of a picture's inks and, found when asked for, of blocks that have several.
#[derive(Default)]
pub(super) struct Pigments {
    inks: Vec<Pigment>,
    means: HashMap<(u32, u32), Pigment, BuildHasherDefault<Mixer>>,
    open: Vec<(u32, u32)>,
}

impl Pigments {
    pub(super) fn clear(&mut self) {
        self.inks.clear();
        self.means.clear();
    }

    /// Takes the inks of a style; whether anything changed.
    pub(super) fn prepare(&mut self, style: &Style, colours: u32) -> bool {
        let inks: Vec<Pigment> = (0..colours).map(|ink| pigment(style.ink(ink), style.background)).collect();
        if inks == self.inks {
            return false;
        }
        self.inks = inks;
        self.means.clear();
        true
    }

    pub(super) fn of(&self, shade: Shade) -> Pigment {
        self.inks.get(shade.number as usize).copied().unwrap_or_default()
    }

    /// The mean of a block's inks, each by how much there is of it, where the block is entered with a shade.
    pub(super) fn mean(
        &mut self,
        drawing: &Drawing,
        table: &InkTable,
        inks: &[Ink],
        block: u32,
        entry: Shade,
    ) -> Pigment {
        self.open.clear();
        self.open.push((block, entry.number));
        while let Some(&(block, entry)) = self.open.last() {
            let number = block as usize;
            if let Inks::One(shade) = table.of(number) {
                let shade = table.choice.then(Shade { number: entry, fixed: true }, shade);
                self.means.insert((block, entry), self.of(shade));
            } else if let Some(mean) = self.sum(drawing, table, inks, number, entry) {
                self.means.insert((block, entry), mean);
            } else {
                continue;
            }
            self.open.pop();
        }
        self.means.get(&(block, entry.number)).copied().unwrap_or_default()
    }

    /// The mean over a block's items; `None` where there are blocks among them whose mean has to be found first, which
    /// are left to be done.
    fn sum(&mut self, drawing: &Drawing, table: &InkTable, inks: &[Ink], block: usize, entry: u32) -> Option<Pigment> {
        let (whole, block) = (&inks[block], &drawing.blocks[block]);
        let mut sum = [0.0; 3];
        let before = self.open.len();
        let items = drawing.contents(block);
        for (item, part) in items.iter().zip(parts(drawing, block, inks)) {
            let share = part.share_of(whole);
            if share == 0.0 {
                continue;
            }
            let (style, inner) = match item {
                Item::Stroke(stroke) => (stroke.style, None),
                Item::Polygon(polygon) => (polygon.style, None),
                Item::Block(placed) => (placed.style, Some(placed.block.0)),
            };
            let entry = Shade { number: entry, fixed: true };
            let shade = table.choice.then(entry, table.choice.shade(&drawing.styles[style.0 as usize]));
            let pigment = match inner {
                None => self.of(shade),
                Some(block) => match self.means.get(&(block, shade.number)) {
                    Some(&mean) => mean,
                    None => {
                        self.open.push((block, shade.number));
                        continue;
                    }
                },
            };
            for (sum, pigment) in sum.iter_mut().zip(pigment) {
                *sum += share * f64::from(pigment);
            }
        }
        (self.open.len() == before).then(|| sum.map(|v| v as f32))
    }
}
