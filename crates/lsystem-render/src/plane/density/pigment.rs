//! What inks do to the paper's light, and the mean of a block's inks.

use super::deposit::{Deposit, part};
use super::sheet::Pigment;
use crate::plane::inks::{InkTable, Inks, Shade};
use crate::plane::mixer::Mixer;
use core::hash::BuildHasherDefault;
use lsystem_drawing::{Drawing, Item};
use lsystem_syntax::{Colour, Meter, Style};
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
    /// By block and the colour at its entry.
    means: HashMap<(u32, u32), Pigment, BuildHasherDefault<Mixer>>,
    mixtures: HashMap<u32, Vec<Portion>, BuildHasherDefault<Mixer>>,
    /// The blocks whose means are being found, each for the sake of the one before it.
    open: Vec<Open>,
    /// The mixture that is being found: its block, how many items are done, and where its portions are.
    making: Option<(u32, usize, Vec<Portion>)>,
    places: HashMap<(Shade, Option<u32>), usize, BuildHasherDefault<Mixer>>,
}

/// What part of a block's ink is drawn alike: after one change of the colour, and inside one block if it is not the block's
/// own. However long a block is, it has few of them.
#[derive(Clone, Copy, Debug)]
struct Portion {
    shade: Shade,
    inner: Option<u32>,
    share: f64,
}

/// A block and the colour at its entry; how many of its portions are in the sum.
#[derive(Clone, Copy, Debug)]
struct Open {
    block: u32,
    entry: u32,
    done: usize,
    sum: [f64; 3],
}

/// What is needed to find the mean of a block.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub drawing: &'a Drawing,
    pub table: &'a InkTable,
    pub deposits: &'a [Deposit],
}

/// The most means that are remembered from one to the next, and the most portions.
const REMEMBERED: usize = 1 << 18;

impl Pigments {
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Takes the inks of a style; whether anything changed.
    pub(super) fn prepare(&mut self, style: &Style, colours: u32) -> bool {
        let inks: Vec<Pigment> = (0..colours).map(|ink| pigment(style.ink(ink), style.background)).collect();
        if inks == self.inks {
            return false;
        }
        *self = Self { inks, ..Self::default() };
        true
    }

    /// Gives up the mean that is being found.
    pub(super) fn stop(&mut self) {
        (self.open, self.making) = (vec![], None);
    }

    pub(super) fn of(&self, shade: Shade) -> Pigment {
        self.inks.get(shade.number as usize).copied().unwrap_or_default()
    }

    /// The mean of a block's inks, each by how much there is of it, where the block is entered with a shade; `None` where it
    /// has not been found yet.
    pub(super) fn mean(&self, block: u32, entry: Shade) -> Option<Pigment> {
        self.means.get(&(block, entry.number)).copied()
    }

    /// Starts to find the mean of a block.
    pub(super) fn ask(&mut self, block: u32, entry: Shade) {
        if self.means.len() > REMEMBERED || self.mixtures.len() > REMEMBERED {
            (self.means, self.mixtures) = Default::default();
        }
        self.stop();
        self.open.push(Open::new(block, entry.number));
    }

    /// Whether there is a mean to be found.
    pub(super) fn is_asked(&self) -> bool {
        !self.open.is_empty()
    }

    /// Goes on until what was asked for has been found.
    pub(super) fn step(&mut self, source: Source<'_>, meter: &mut Meter) {
        let choice = source.table.choice;
        while !meter.is_spent()
            && let Some(open) = self.open.last_mut()
        {
            let entry = Shade { number: open.entry, fixed: true };
            let mean = if let Inks::One(shade) = source.table.of(open.block as usize) {
                let shade = choice.then(entry, shade);
                self.inks.get(shade.number as usize).copied().unwrap_or_default()
            } else {
                let Some(portions) = self.mixtures.get(&open.block) else {
                    let block = open.block;
                    self.mix(source, block, meter);
                    continue;
                };
                meter.charge(1);
                if let Some(portion) = portions.get(open.done) {
                    let shade = choice.then(entry, portion.shade);
                    let pigment = match portion.inner {
                        None => self.inks.get(shade.number as usize).copied().unwrap_or_default(),
                        Some(block) => match self.means.get(&(block, shade.number)) {
                            Some(&mean) => mean,
                            None => {
                                self.open.push(Open::new(block, shade.number));
                                continue;
                            }
                        },
                    };
                    for (sum, pigment) in open.sum.iter_mut().zip(pigment) {
                        *sum += portion.share * f64::from(pigment);
                    }
                    open.done += 1;
                    continue;
                }
                open.sum.map(|v| v as f32)
            };
            self.means.insert((open.block, open.entry), mean);
            self.open.pop();
        }
    }

    /// Goes on with the portions of a block.
    fn mix(&mut self, source: Source<'_>, block: u32, meter: &mut Meter) {
        let Source { drawing, table, deposits } = source;
        let (_, mut done, mut portions) = self.making.take().unwrap_or_else(|| {
            self.places.clear();
            (block, 0, vec![])
        });
        let (whole, items) = (&deposits[block as usize], drawing.contents(&drawing.blocks[block as usize]));
        while let Some(item) = items.get(done) {
            if meter.is_spent() {
                self.making = Some((block, done, portions));
                return;
            }
            done += 1;
            meter.charge(if let Item::Polygon(polygon) = item { 2 + u64::from(polygon.count) / 16 } else { 2 });
            let share = part(drawing, item, deposits).share_of(whole);
            if share == 0.0 {
                continue;
            }
            let (style, inner) = match item {
                Item::Stroke(stroke) => (stroke.style, None),
                Item::Polygon(polygon) => (polygon.style, None),
                Item::Block(placed) => (placed.style, Some(placed.block.0)),
            };
            let shade = table.choice.shade(&drawing.styles[style.0 as usize]);
            let place = *self.places.entry((shade, inner)).or_insert(portions.len());
            match portions.get_mut(place) {
                Some(portion) => portion.share += share,
                None => portions.push(Portion { shade, inner, share }),
            }
        }
        meter.charge(1);
        self.mixtures.insert(block, portions);
    }
}

impl Open {
    fn new(block: u32, entry: u32) -> Self {
        Self { block, entry, done: 0, sum: [0.0; 3] }
    }
}
