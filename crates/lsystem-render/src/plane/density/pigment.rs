//! The mean of a block's inks.

use super::deposit::{Deposit, part};
use crate::ink::{Choice, InkTable, Inks, Shade};
use crate::ink::{Pigment, pigment};
use core::hash::BuildHasherDefault;
use lsystem_base::Meter;
use lsystem_base::Mixer;
use lsystem_drawing::{Drawing, Item};
use lsystem_syntax::Style;
use std::collections::HashMap;

/// The pigments of a picture's inks, and the mean pigments of blocks with several inks, found on demand.
#[derive(Default)]
pub(super) struct Pigments {
    inks: Vec<Pigment>,
    /// By block and the number of the colour at its entry.
    means: HashMap<(u32, u32), Pigment, BuildHasherDefault<Mixer>>,
    /// By block: the portions of its ink.
    mixtures: HashMap<u32, Vec<Portion>, BuildHasherDefault<Mixer>>,
    /// The blocks whose means are being found. Each is needed for the block before.
    open: Vec<OpenMean>,
    /// The mixture that is being found: its block, the number of items done, and its portions.
    making: Option<(u32, usize, Vec<Portion>)>,
    /// The index of each portion of that mixture, by shade and inner block.
    places: HashMap<(Shade, Option<u32>), usize, BuildHasherDefault<Mixer>>,
}

/// The share of a block's ink with the same change of colour and, if the ink is inside a block, in the same inner
/// block. Even a long block has few portions.
#[derive(Clone, Copy, Debug)]
struct Portion {
    shade: Shade,
    inner: Option<u32>,
    share: f64,
}

/// The mean of a block that is being found.
#[derive(Clone, Copy, Debug)]
struct OpenMean {
    block: u32,
    /// The number of the colour at the block's entry.
    entry: u32,
    /// The number of portions in the sum.
    done: usize,
    sum: [f64; 3],
}

/// The facts that means are found from.
#[derive(Clone, Copy)]
pub(super) struct MeanSource<'a> {
    pub drawing: &'a Drawing,
    pub table: &'a InkTable,
    pub deposits: &'a [Deposit],
}

/// The most means, and the most mixtures, that are remembered, to bound the memory.
const MAX_REMEMBERED: usize = 1 << 18;

impl Pigments {
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Takes the inks of a style. Returns whether anything changed.
    pub(super) fn prepare(&mut self, style: &Style, choice: Choice) -> bool {
        let inks: Vec<Pigment> =
            (0..choice.inks()).map(|number| pigment(style.ink(choice.ink(number)), style.background)).collect();
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

    /// The mean of a block's inks, weighted by their amounts, for a shade at the block's entry; `None` if it is not
    /// known yet.
    pub(super) fn mean(&self, block: u32, entry: Shade) -> Option<Pigment> {
        self.means.get(&(block, entry.number)).copied()
    }

    /// Starts to find the mean of a block.
    pub(super) fn ask(&mut self, block: u32, entry: Shade) {
        if self.means.len() > MAX_REMEMBERED || self.mixtures.len() > MAX_REMEMBERED {
            (self.means, self.mixtures) = Default::default();
        }
        self.stop();
        self.open.push(OpenMean::new(block, entry.number));
    }

    /// Whether a mean is being found.
    pub(super) fn is_asked(&self) -> bool {
        !self.open.is_empty()
    }

    /// Goes on until the mean that was asked for is known.
    pub(super) fn step(&mut self, source: MeanSource<'_>, meter: &mut Meter) {
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
                                self.open.push(OpenMean::new(block, shade.number));
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

    /// Goes on with the mixture of a block.
    fn mix(&mut self, source: MeanSource<'_>, block: u32, meter: &mut Meter) {
        let MeanSource { drawing, table, deposits } = source;
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

impl OpenMean {
    fn new(block: u32, entry: u32) -> Self {
        Self { block, entry, done: 0, sum: [0.0; 3] }
    }
}
