//! Visible lines, without specks that lie in the ink of others.
//!
//! Between crossing strokes, many parts of outlines shorter than a pen are visible. A line whose cells all have ink of
//! its colour is nowhere farther than half a pen from the middle of that ink: it would be drawn over ink.

use super::grid::cells_along;
use crate::merge::Piece;
use crate::page::{Point, distance};
use crate::pens::Pens;
use core::hash::BuildHasherDefault;
use lsystem_base::Mixer;
use lsystem_syntax::{Halt, Work};
use std::collections::HashMap;

/// The side of a cell, in pens: its diagonal is half a pen.
const SIDE: f64 = 0.5 * core::f64::consts::FRAC_1_SQRT_2;

/// Lines in drawing order.
#[derive(Debug, Default)]
pub(super) struct Lines {
    pieces: Vec<Piece>,
    /// By line: the end of its pieces, and whether it is a speck.
    list: Vec<(usize, bool)>,
}

/// Whether there is ink, by layer and cell.
type Cells = HashMap<(u32, i64, i64), bool, BuildHasherDefault<Mixer>>;

impl Lines {
    /// Adds a line.
    pub(super) fn add(&mut self, layer: u32, parts: &[[Point; 2]], is_speck: bool) {
        if !parts.is_empty() {
            self.pieces.extend(parts.iter().map(|&ends| Piece { layer, ends }));
            self.list.push((self.pieces.len(), is_speck));
        }
    }

    /// The number of pieces.
    pub(super) fn count(&self) -> u64 {
        self.pieces.len() as u64
    }

    /// Draws the lines, but for specks in ink.
    pub(super) fn draw(self, pen: f64, pens: &mut Pens, work: &mut dyn Work) -> Result<(), Halt> {
        let side = SIDE * pen;
        let mut ink = Cells::default();
        self.each(true, |piece| {
            ink.extend(cells(piece, side).map(|cell| (cell, false)));
            work.charge(4)
        })?;
        if !ink.is_empty() {
            self.each(false, |piece| mark(piece, side, &mut ink, work))?;
        }
        let mut start = 0;
        for &(end, is_speck) in &self.list {
            let pieces = &self.pieces[start..end];
            start = end;
            work.charge(2 * pieces.len() as u64)?;
            if is_speck && pieces.iter().all(|piece| cells(piece, side).all(|cell| ink.get(&cell) == Some(&true))) {
                pens.spare += pieces.iter().map(|piece| distance(piece.ends[0], piece.ends[1])).sum::<f64>();
                continue;
            }
            for piece in pieces {
                pens.stroke(piece.layer, piece.ends);
                if is_speck {
                    mark(piece, side, &mut ink, work)?;
                }
            }
        }
        Ok(())
    }

    /// Goes through the pieces of specks, or of other lines.
    fn each(&self, of_specks: bool, mut each: impl FnMut(&Piece) -> Result<(), Halt>) -> Result<(), Halt> {
        let mut start = 0;
        for &(end, is_speck) in &self.list {
            if is_speck == of_specks {
                self.pieces[start..end].iter().try_for_each(&mut each)?;
            }
            start = end;
        }
        Ok(())
    }
}

/// Notes the ink of a piece in cells where specks are.
fn mark(piece: &Piece, side: f64, ink: &mut Cells, work: &mut dyn Work) -> Result<(), Halt> {
    for cell in cells(piece, side) {
        work.charge(1)?;
        if let Some(has_ink) = ink.get_mut(&cell) {
            *has_ink = true;
        }
    }
    Ok(())
}

/// The layer and the cells of a piece.
fn cells(&Piece { layer, ends }: &Piece, side: f64) -> impl Iterator<Item = (u32, i64, i64)> {
    let cells = ends.map(|point| point.map(|part| libm::floor(part / side) as i64));
    cells_along([0.0; 2], side, ends, cells).map(move |([column, row], ..)| (layer, column, row))
}

#[cfg(test)]
mod tests {
    use super::super::tests::Chance;
    use super::super::tests::touch::away;
    use super::*;
    use crate::options::PlotOptions;
    use crate::page::Page;
    use crate::sheet::Sheet;
    use lsystem_base::{Limits, Meter};
    use lsystem_drawing::{System, draw};
    use lsystem_syntax::Definition;

    /// The pieces of ink of some lines, drawn with a pen of 1 mm.
    fn drawn(lines: Lines) -> Vec<Piece> {
        let system = System::new(&Definition { axiom: "F".into(), ..Definition::default() }).unwrap();
        let options = PlotOptions { pen: 1.0, ..PlotOptions::default() };
        let page = Page::new(&draw(&system, 0, &Limits::default()).unwrap(), &Sheet::default(), &options);
        let mut pens = Pens::new(&page, &options);
        assert_eq!([0, 1].map(|layer| pens.layer([layer; 3])), [0, 1]);
        lines.draw(1.0, &mut pens, &mut Meter::new(0)).unwrap();
        pens.strokes.finish(&mut Meter::new(0)).unwrap().0
    }

    #[test]
    fn what_is_left_out_lies_in_ink_of_its_colour() {
        let mut chance = Chance(5);
        let (mut left_out, mut kept) = (0, 0);
        for _ in 0..40 {
            let (mut lines, mut all) = (Lines::default(), vec![]);
            for number in 0..120 {
                let (is_speck, layer) = (number % 4 > 0, chance.below(2));
                let reach = if is_speck { 0.45 } else { 6.0 };
                let from = [0, 1].map(|_| chance.number(20.0, 30.0));
                let ends = [from, from.map(|part| part + chance.number(-reach, reach))];
                lines.add(layer, &[ends], is_speck);
                all.push((layer, ends, is_speck));
            }
            let pieces = drawn(lines);
            for (layer, ends, is_speck) in all {
                let far = (0..=20).map(|part| {
                    let part = f64::from(part) / 20.0;
                    away(&pieces, layer, [0, 1].map(|axis| ends[0][axis] + part * (ends[1][axis] - ends[0][axis])))
                });
                let far = far.fold(0.0, f64::max);
                assert!(far <= if is_speck { 0.5 } else { 1e-3 }, "{far}");
                if far > 1e-3 { left_out += 1 } else { kept += 1 }
            }
        }
        assert!(left_out > 300 && kept > 1500, "{left_out} {kept}");
    }

    #[test]
    fn specks_without_ink_around_stay() {
        let mut lines = Lines::default();
        lines.add(0, &[[[10.0, 10.0], [10.2, 10.0]]], true);
        lines.add(1, &[[[5.0, 10.0], [15.0, 10.0]]], false);
        lines.add(0, &[[[10.01, 10.0], [10.19, 10.0]], [[10.19, 10.0], [10.19, 10.01]]], true);
        let pieces = drawn(lines);
        assert_eq!(pieces.iter().filter(|piece| piece.layer == 0).count(), 1);
    }
}
