//! Strokes for pen plotters: from a [`Drawing`] and a [`Sheet`] of paper to polylines in millimetres, a [`Layer`] for
//! each pen.
//!
//! Every stroke of the drawing is drawn, except that a part smaller than the pen's line becomes one stroke (`gather`)
//! if that takes less ink (`ink`). Or only what nothing in front covers is drawn (`hide`). Ink on the same line is drawn once (`merge`). Pieces that meet become polylines
//! (`join`), in an order with little travel between them (`order`, `improve`). The [`PlotSummary`] estimates lengths
//! and time.
//!
//! ```
//! use lsystem_base::{Limits, Meter};
//! use lsystem_drawing::{System, draw};
//! use lsystem_plot::{Plot, PlotOptions, Sheet};
//! use lsystem_syntax::{Definition, Style};
//! use std::sync::Arc;
//!
//! let square = Definition { axiom: "F+F+F+F".into(), angle: 90.0, ..Definition::default() };
//! let system = System::new(&square).expect("the system has no errors");
//! let drawing = Arc::new(draw(&system, 0, &Limits::default()).unwrap());
//! let (style, sheet, options) = (Style::default(), Sheet::default(), PlotOptions::default());
//! let plot = Plot::new(drawing, &style, &sheet, options, 1_000, &mut Meter::new(1 << 20)).unwrap();
//! // One closed polyline, four times as long as the sheet is wide between its margins: 190 mm.
//! assert_eq!(plot.summary.polylines, 1);
//! assert_eq!(plot.summary.down.round(), 760.0);
//! ```

mod cells;
mod estimate;
mod facts;
mod gather;
mod hatch;
mod hide;
mod improve;
mod ink;
mod join;
mod layer;
mod merge;
mod near;
mod options;
mod order;
mod page;
mod pair;
mod pens;
mod sheet;
mod spots;

pub use estimate::PlotSummary;
pub use layer::Layer;
pub use options::{Corner, PlotOptions};
pub use page::Point;
pub use sheet::{INCH, SHEETS, Sheet};

use join::{Polylines, join};
use lsystem_drawing::Drawing;
use lsystem_syntax::{Halt, Style, Work};
use order::{best_start, order};
use page::{Page, distance};
use std::sync::Arc;

/// A plot, ready to be written.
pub struct Plot {
    /// The layers, each with a pen of its own.
    pub layers: Vec<Layer>,
    /// The plot's lengths, pens and time.
    pub summary: PlotSummary,
    polylines: Polylines,
}

impl Plot {
    /// Plots a drawing on a sheet, with at most `most` strokes. The drawing is dropped when its strokes are known.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the plot has too many strokes.
    pub fn new(
        drawing: Arc<Drawing>,
        style: &Style,
        sheet: &Sheet,
        options: PlotOptions,
        most: u64,
        work: &mut dyn Work,
    ) -> Result<Self, Halt> {
        let options = options.bounded();
        let page = Page::new(&drawing, sheet, &options);
        let home = options.start.of(page.size);
        let mut ink = ink::ink(&drawing, style, &page, options, most, work)?;
        drop(drawing);
        let mut summary = PlotSummary { sheet: page.size, travel_before: ink.travel, ..PlotSummary::default() };
        let colours = core::mem::take(&mut ink.colours);
        let polylines = join(ink, &options, work)?;
        summary.polylines = polylines.list.len();
        let mut numbers = vec![Vec::new(); colours.len()];
        for number in 0..summary.polylines {
            let points = polylines.points_of(number);
            work.charge(1 + points.len() as u64 / 8)?;
            summary.down += points.windows(2).map(|pair| distance(pair[0], pair[1])).sum::<f64>();
            numbers[polylines.layer(number) as usize].push(number as u32);
        }
        let mut layers = vec![];
        for (rgb, numbers) in colours.into_iter().zip(numbers).filter(|(_, numbers)| !numbers.is_empty()) {
            let tour = order(&polylines, &numbers, home, work)?;
            let mut layer = Layer { rgb, starts: vec![0; tour.len()], tour };
            choose_starts(&mut layer, &polylines, home, &mut summary.travel, work)?;
            layers.push(layer);
        }
        summary.pens = layers.len();
        Ok(Self { layers, summary: summary.timed(&options), polylines })
    }

    /// The polylines of a layer, in the order and the direction in which they are drawn.
    pub fn polylines_of<'a>(&'a self, layer: &'a Layer) -> impl Iterator<Item = impl Iterator<Item = Point> + 'a> + 'a {
        (0..layer.tour.len()).map(move |place| {
            let (polyline, _) = layer.tour[place];
            let count = self.polylines.points_of(polyline as usize).len();
            (0..count).map(move |number| layer.point(&self.polylines, place, number))
        })
    }
}

impl core::fmt::Debug for Plot {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.debug_struct("Plot").field("summary", &self.summary).finish_non_exhaustive()
    }
}

/// Chooses the starts of the closed polylines of a layer, and adds its travel.
fn choose_starts(
    layer: &mut Layer,
    polylines: &Polylines,
    home: Point,
    travel: &mut f64,
    work: &mut dyn Work,
) -> Result<(), Halt> {
    let mut before = home;
    for place in 0..layer.tour.len() {
        let (number, is_flipped) = layer.tour[place];
        let points = polylines.points_of(number as usize);
        work.charge(2)?;
        if polylines.is_closed(number as usize) {
            work.charge(points.len() as u64 / 4)?;
            let after = if place + 1 < layer.tour.len() { layer.point(polylines, place + 1, 0) } else { home };
            let (best, last) = (best_start(points, before, after), points.len() - 1);
            layer.starts[place] = if is_flipped { (last - best) % last } else { best } as u32;
        }
        *travel += distance(before, layer.point(polylines, place, 0));
        before = layer.point(polylines, place, points.len() - 1);
    }
    *travel += distance(before, home);
    Ok(())
}
