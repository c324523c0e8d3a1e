//! The ink of a plot: every stretch of a line once, and cut at the pen's width where that is shorter.
//!
//! Lines from spot to spot may be longer than the strokes that they stand for. So a drawing with parts smaller than the
//! pen is read twice, first as it stands, and the shorter ink is drawn. What the cut saves may be spent on moves that are
//! drawn. So the length drawn is never more than the ink of the drawing, up to [`COMPARED`] strokes.

use super::facts::BlockFacts;
use super::gather::Gather;
use super::merge::{Merge, Piece};
use super::options::PlotOptions;
use super::page::Page;
use super::spots::Spots;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Diagnostic, MAX_PLOT_BLOCKS, Meter, Progress, Style};
use std::sync::Arc;

/// The most strokes, and the most open blocks, of a drawing that is read as it stands for the comparison. To read more
/// would take longer than the rest of a deep plot. With so many strokes shorter than the pen, the cut saves most of the
/// ink; the number is a guess.
const COMPARED: u64 = 200_000;

/// The ink of a plot.
#[derive(Clone, Debug)]
pub(super) struct Ink {
    pub(super) pieces: Vec<Piece>,
    pub(super) spots: Spots,
    /// The colours of the layers.
    pub(super) colours: Vec<[u8; 3]>,
    /// The travel of all strokes in drawing order, in millimetres.
    pub(super) travel: f64,
    /// The length of the pieces, in millimetres.
    length: f64,
    /// The length of the moves that may be drawn, in millimetres: what the cut saved. Infinite if it is unknown.
    pub(super) spare: f64,
}

/// Makes the ink of a drawing in steps.
#[derive(Clone, Debug)]
pub(super) struct InkMaker {
    drawing: Arc<Drawing>,
    facts: BlockFacts,
    page: Page,
    options: PlotOptions,
    most: u64,
    /// The ink without the cut, if the drawing is cut and has few enough strokes.
    plain: Option<Ink>,
    stage: Stage,
}

#[derive(Clone, Debug)]
enum Stage {
    /// Reading the strokes.
    Gather(Reading, Box<(Gather, Merge)>),
    Merge(Reading, Box<(Gather, Merge)>),
    Done(Ink),
    /// The ink is returned, or there are too many strokes.
    None,
}

/// How a drawing is read.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reading {
    /// As it stands: no part is smaller than the pen.
    Whole,
    /// As it stands, to compare it with the cut drawing.
    Compared,
    /// Cut at the pen's width.
    Cut,
}

impl InkMaker {
    /// Prepares the ink of at most `most` strokes.
    pub(super) fn new(drawing: Arc<Drawing>, facts: BlockFacts, page: Page, options: PlotOptions, most: u64) -> Self {
        let finest = drawing.root.map_or(f64::INFINITY, |root| facts.finest(root));
        let reading = if finest * page.frame.scale.abs() < options.pen { Reading::Compared } else { Reading::Whole };
        let mut maker = Self { drawing, facts, page, options, most, plain: None, stage: Stage::None };
        maker.stage = maker.read(reading);
        maker
    }

    /// Continues until the meter is spent. Returns the ink at the end.
    ///
    /// # Errors
    /// If there are too many strokes or blocks.
    pub(super) fn step(&mut self, style: &Style, meter: &mut Meter) -> Result<Option<Ink>, Diagnostic> {
        while !meter.is_spent() {
            self.stage = match core::mem::replace(&mut self.stage, Stage::None) {
                Stage::Gather(reading, mut both) => {
                    let (gather, merge) = &mut *both;
                    match gather.step((&self.drawing, style, &self.facts), merge, meter) {
                        Ok(Progress::More) => Stage::Gather(reading, both),
                        Ok(Progress::Done) => Stage::Merge(reading, both),
                        Err(_) if reading == Reading::Compared => self.read(Reading::Cut),
                        Err(error) => return Err(error),
                    }
                }
                Stage::Merge(reading, mut both) => match both.1.step(meter) {
                    Progress::More => Stage::Merge(reading, both),
                    Progress::Done => self.compare(reading, *both),
                },
                Stage::Done(ink) => return Ok(Some(ink)),
                Stage::None => return Ok(None),
            };
        }
        Ok(None)
    }

    fn read(&self, reading: Reading) -> Stage {
        let [most, blocks] = match reading {
            Reading::Compared => [self.most.min(COMPARED), COMPARED],
            _ => [self.most, MAX_PLOT_BLOCKS],
        };
        let gather =
            Gather::new(&self.drawing, self.page.clone(), self.options, [most, blocks], reading == Reading::Cut);
        Stage::Gather(reading, Box::new((gather, Merge::new(self.page.size))))
    }

    /// Reads the drawing once more if it is cut, or chooses the shorter ink.
    fn compare(&mut self, reading: Reading, (gather, merge): (Gather, Merge)) -> Stage {
        let (travel, length) = (gather.travel_home(), merge.length());
        let Gather { colours, spots, .. } = gather;
        let ink = Ink { pieces: merge.finish(), spots, colours, travel, length, spare: 0.0 };
        match (reading, self.plain.take()) {
            (Reading::Whole, _) => Stage::Done(ink),
            (Reading::Compared, _) => {
                self.plain = Some(ink);
                self.read(Reading::Cut)
            }
            (Reading::Cut, Some(plain)) if plain.length < ink.length => Stage::Done(plain),
            (Reading::Cut, plain) => {
                let spare = plain.map_or(f64::INFINITY, |plain| plain.length - ink.length);
                Stage::Done(Ink { spare, ..ink })
            }
        }
    }
}
