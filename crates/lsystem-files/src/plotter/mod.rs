//! Files for pen plotters.
//!
//! The drawing becomes strokes on a sheet, in millimetres: every stroke, except that a part smaller than the pen's line
//! becomes one stroke ([`gather`]) if that takes less ink ([`ink`]). Ink on the same line is drawn once ([`merge`]).
//! Pieces that meet become polylines ([`join`]), in an order with little travel between them ([`order`], [`improve`]).
//! The file is an SVG with a layer for each colour ([`write`]).

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
mod spots;
mod write;

use super::{FileOptions, Sink};
pub use estimate::PlotSummary;
use join::{Polylines, join};
use lsystem_drawing::Drawing;
use lsystem_syntax::{Halt, Style, Work};
pub use options::{Corner, PlotOptions};
use order::{best_start, order};
use page::{Page, Point, distance};
use std::sync::Arc;
use write::{Layer, write_layers};

/// Writes a drawing for a pen plotter, on [`FileOptions::sheet`] with [`FileOptions::plot`]. There are at most
/// [`FileOptions::most`] strokes. The drawing is dropped when its strokes are known.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the plot has too many strokes, before the first byte.
pub fn write_plot(
    drawing: Arc<Drawing>,
    style: &Style,
    file: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<PlotSummary, Halt> {
    let options = file.plot.bounded();
    let page = Page::new(&drawing, &file.sheet, &options);
    let home = options.start.of(page.size);
    let mut ink = ink::ink(&drawing, style, &page, options, file.most, sink)?;
    drop(drawing);
    let mut summary = PlotSummary { sheet: page.size, travel_before: ink.travel, ..PlotSummary::default() };
    let colours = core::mem::take(&mut ink.colours);
    let polylines = join(ink, &options, page.size, sink)?;
    summary.polylines = polylines.list.len();
    let mut numbers = vec![Vec::new(); colours.len()];
    for number in 0..summary.polylines {
        let points = polylines.points_of(number);
        sink.charge(1 + points.len() as u64 / 8)?;
        summary.down += points.windows(2).map(|pair| distance(pair[0], pair[1])).sum::<f64>();
        numbers[polylines.layer(number) as usize].push(number as u32);
    }
    let mut layers = vec![];
    for (rgb, numbers) in colours.into_iter().zip(numbers).filter(|(_, numbers)| !numbers.is_empty()) {
        let tour = order(&polylines, &numbers, page.size, home, sink)?;
        let mut layer = Layer { rgb, starts: vec![0; tour.len()], tour };
        choose_starts(&mut layer, &polylines, home, &mut summary.travel, sink)?;
        layers.push(layer);
    }
    summary.pens = layers.len();
    write_layers(page.size, options.pen, &layers, &polylines, file, sink)?;
    Ok(summary.timed(&options))
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
