//! Files for pen plotters.
//!
//! The drawing becomes strokes on a sheet, in millimetres: every stroke, except that a part smaller than the pen's line
//! becomes one stroke ([`gather`]) if that takes less ink ([`ink`]). Ink on the same line is drawn once ([`merge`]). Pieces that meet become polylines
//! ([`join`]), in an order with little travel between them ([`order`], [`improve`]). The file is an SVG with a layer for
//! each colour ([`write`]).

mod cells;
mod estimate;
mod facts;
mod gather;
mod hatch;
mod improve;
mod ink;
mod join;
mod merge;
mod near;
mod options;
mod order;
mod page;
mod pair;
mod pen;
mod sort;
mod spots;
mod write;

use super::{FileOptions, Writer};
pub use estimate::PlotSummary;
use facts::BlockFacts;
use ink::InkMaker;
use join::{Join, Polylines};
use lsystem_drawing::Drawing;
use lsystem_syntax::{Diagnostic, Meter, Progress, Style};
pub use options::{Corner, PlotOptions};
use order::{Order, best_start};
use page::{Page, distance};
use std::sync::Arc;
use write::{Layer, Writing};

/// A writer of a file for pen plotters in steps.
#[derive(Debug)]
pub struct PlotWriter {
    style: Style,
    file: FileOptions,
    options: PlotOptions,
    page: Page,
    stage: Stage,
    polylines: Polylines,
    /// The colours of the layers.
    colours: Vec<[u8; 3]>,
    layers: Vec<Layer>,
    summary: PlotSummary,
    spent: u64,
}

/// The stage of a plot.
#[derive(Debug)]
enum Stage {
    /// Finding the facts about the blocks.
    Look(Arc<Drawing>, BlockFacts),
    Ink(Box<InkMaker>),
    Join(Box<Join>),
    /// Adding up the lengths, from this polyline on, and sorting the polylines by layers.
    Measure(usize, Vec<Vec<u32>>),
    /// Ordering the polylines of a layer, with those of the layers that follow.
    Order(Box<Order>, std::vec::IntoIter<Vec<u32>>),
    /// Choosing the starts of closed polylines, from this place of the last tour on.
    Start(usize, std::vec::IntoIter<Vec<u32>>),
    Write(Writing),
    Done,
}

impl PlotWriter {
    /// A writer for a drawing on [`FileOptions::sheet`] with [`FileOptions::plot`]. There are at most
    /// [`FileOptions::most`] strokes.
    #[must_use]
    pub fn new(drawing: Arc<Drawing>, style: Style, file: &FileOptions) -> Self {
        let options = file.plot.bounded();
        let page = Page::new(&drawing, &file.sheet, &options);
        Self {
            style,
            file: file.clone(),
            options,
            summary: PlotSummary { sheet: page.size, ..PlotSummary::default() },
            page,
            stage: Stage::Look(drawing, BlockFacts::default()),
            polylines: Polylines::default(),
            colours: Vec::new(),
            layers: Vec::new(),
            spent: 0,
        }
    }

    /// The size of the plot, after all steps are done.
    #[must_use]
    pub fn summary(&self) -> PlotSummary {
        self.summary
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Appends to the file for about `work` units of work. Nothing is written before the whole plot is known.
    ///
    /// # Errors
    /// If the plot has too many strokes.
    pub fn step_text(&mut self, text: &mut String, work: u64) -> Result<Progress, Diagnostic> {
        let mut meter = Meter::new(work);
        while !meter.is_spent() && !matches!(self.stage, Stage::Done) {
            let stage = core::mem::replace(&mut self.stage, Stage::Done);
            self.stage = self.advance(stage, text, &mut meter)?;
        }
        self.spent = self.spent.saturating_add(meter.spent());
        Ok(if matches!(self.stage, Stage::Done) { Progress::Done } else { Progress::More })
    }

    /// Continues a stage until the meter is spent, and returns the stage that follows.
    fn advance(&mut self, stage: Stage, text: &mut String, meter: &mut Meter) -> Result<Stage, Diagnostic> {
        Ok(match stage {
            Stage::Look(drawing, mut facts) => match facts.step(&drawing, meter) {
                Progress::More => Stage::Look(drawing, facts),
                Progress::Done => {
                    let (page, most) = (self.page.clone(), self.file.most);
                    Stage::Ink(Box::new(InkMaker::new(drawing, facts, page, self.options, most)))
                }
            },
            Stage::Ink(mut maker) => match maker.step(&self.style, meter)? {
                None => Stage::Ink(maker),
                Some(mut ink) => {
                    self.summary.travel_before = ink.travel;
                    self.colours = core::mem::take(&mut ink.colours);
                    Stage::Join(Box::new(Join::new(ink, &self.options, self.page.size)))
                }
            },
            Stage::Join(mut join) => match join.step(meter) {
                Progress::More => Stage::Join(join),
                Progress::Done => {
                    self.polylines = join.finish();
                    Stage::Measure(0, vec![Vec::new(); self.colours.len()])
                }
            },
            Stage::Measure(at, layers) => self.measure(at, layers, meter),
            Stage::Order(mut order, rest) => match order.step(meter) {
                Progress::More => Stage::Order(order, rest),
                Progress::Done => {
                    let (tour, rgb) = (order.finish(), self.colours[self.layers.len()]);
                    self.layers.push(Layer { rgb, starts: vec![0; tour.len()], tour });
                    Stage::Start(0, rest)
                }
            },
            Stage::Start(place, rest) => self.start(place, rest, meter),
            Stage::Write(mut writing) => match writing.step(&self.polylines, text, meter) {
                Progress::More => Stage::Write(writing),
                Progress::Done => Stage::Done,
            },
            Stage::Done => Stage::Done,
        })
    }

    /// Adds the next polyline to its layer and to the sums.
    fn measure(&mut self, at: usize, mut layers: Vec<Vec<u32>>, meter: &mut Meter) -> Stage {
        if at == self.polylines.list.len() {
            self.summary.polylines = at;
            self.summary.pens = layers.iter().filter(|layer| !layer.is_empty()).count();
            return self.next_layer(layers.into_iter());
        }
        let points = self.polylines.points_of(at);
        meter.charge(1 + points.len() as u64 / 8);
        self.summary.down += points.windows(2).map(|pair| distance(pair[0], pair[1])).sum::<f64>();
        layers[self.polylines.layer(at) as usize].push(at as u32);
        Stage::Measure(at + 1, layers)
    }

    /// Begins the order of the next layer, or the file.
    fn next_layer(&mut self, mut layers: std::vec::IntoIter<Vec<u32>>) -> Stage {
        if let Some(numbers) = layers.next() {
            let start = self.options.start.of(self.page.size);
            return Stage::Order(Box::new(Order::new(&self.polylines, numbers, self.page.size, start)), layers);
        }
        self.summary = self.summary.timed(&self.options);
        let mut layers = core::mem::take(&mut self.layers);
        layers.retain(|layer| !layer.tour.is_empty());
        Stage::Write(Writing::new(self.page.size, self.options.pen, layers, &self.file))
    }

    /// Chooses the start of the polyline at a place of the last tour, if it is closed, and adds up the travel.
    fn start(&mut self, place: usize, rest: std::vec::IntoIter<Vec<u32>>, meter: &mut Meter) -> Stage {
        let home = self.options.start.of(self.page.size);
        let Some(layer) = self.layers.last_mut() else { return self.next_layer(rest) };
        let end_of = |layer: &Layer, place: usize| {
            let count = self.polylines.points_of(layer.tour[place].0 as usize).len();
            layer.point(&self.polylines, place, count - 1)
        };
        let before = if place == 0 { home } else { end_of(layer, place - 1) };
        let Some(&(number, is_flipped)) = layer.tour.get(place) else {
            self.summary.travel += if place == 0 { 0.0 } else { distance(before, home) };
            return self.next_layer(rest);
        };
        meter.charge(2);
        if self.polylines.is_closed(number as usize) {
            let after = if place + 1 < layer.tour.len() { layer.point(&self.polylines, place + 1, 0) } else { home };
            let points = self.polylines.points_of(number as usize);
            meter.charge(points.len() as u64 / 4);
            let (best, last) = (best_start(points, before, after), points.len() - 1);
            layer.starts[place] = if is_flipped { (last - best) % last } else { best } as u32;
        }
        self.summary.travel += distance(before, layer.point(&self.polylines, place, 0));
        Stage::Start(place + 1, rest)
    }
}

impl Writer for PlotWriter {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        crate::formats::append(file, |text| self.step_text(text, work))
    }

    fn summary(&self) -> Option<String> {
        Some(self.summary.words(&self.options))
    }
}
