//! The strokes of each pen, and the way of the pens through them in drawing order.

use crate::merge::{LEAST, Merge};
use crate::options::PlotOptions;
use crate::page::{Page, Point, distance};
use lsystem_base::LimitName;
use lsystem_syntax::{Diagnostic, Halt};
use std::collections::HashMap;

/// The strokes so far, a layer for each colour.
pub(crate) struct Pens {
    /// Where each pen starts and ends.
    home: Point,
    /// The most strokes, and their number.
    pub(crate) most: u64,
    pub(crate) count: u64,
    pub(crate) strokes: Merge,
    /// The layers' colours, in the order of their first strokes.
    pub(crate) colours: Vec<[u8; 3]>,
    layers: HashMap<[u8; 3], u32>,
    /// The end of the last stroke of each layer, and the travel so far in drawing order.
    last: Vec<Point>,
    travel: f64,
    /// The length of ink left out since other ink covers it, in millimetres.
    pub(crate) spare: f64,
}

impl Pens {
    /// No strokes, and no limit.
    pub(crate) fn new(page: &Page, options: &PlotOptions) -> Self {
        Self {
            home: options.start.of(page.size),
            most: u64::MAX,
            count: 0,
            strokes: Merge::new(page.size),
            colours: Vec::new(),
            layers: HashMap::new(),
            last: Vec::new(),
            travel: 0.0,
            spare: 0.0,
        }
    }

    /// The layer of a colour.
    pub(crate) fn layer(&mut self, rgb: [u8; 3]) -> u32 {
        *self.layers.entry(rgb).or_insert_with(|| {
            self.colours.push(rgb);
            self.last.push(self.home);
            self.colours.len() as u32 - 1
        })
    }

    /// Adds a stroke.
    pub(crate) fn stroke(&mut self, layer: u32, ends: [Point; 2]) {
        let last = &mut self.last[layer as usize];
        let travel = distance(*last, ends[0]);
        // Numbers beyond all range have no place.
        if !(travel + distance(ends[0], ends[1])).is_finite() {
            return;
        }
        self.travel += travel;
        *last = ends[1];
        // After many iterations, the strokes between blocks are points.
        if distance(ends[0], ends[1]) > LEAST {
            self.count += 1;
            self.strokes.add(layer, ends);
        }
    }

    /// The travel of all strokes in drawing order, from the pens' start and back to it.
    pub(crate) fn travel_home(&self) -> f64 {
        self.travel + self.last.iter().map(|&end| distance(end, self.home)).sum::<f64>()
    }

    /// The error for too many strokes.
    pub(crate) fn too_many(&self) -> Halt {
        Diagnostic::limit(LimitName::PlotStrokes, self.most, None).into()
    }
}
