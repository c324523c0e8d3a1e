//! The ink of a plot: every stretch of a line once, and cut at the pen's width where that is shorter.
//!
//! Lines from spot to spot may be longer than the strokes that they stand for. So a drawing with parts smaller than the
//! pen is read twice, first as it stands, and the shorter ink is drawn. What the cut saves may be spent on moves that are
//! drawn. So the length drawn is never more than the ink of the drawing, up to [`COMPARED`] strokes.

use crate::facts::BlockFacts;
use crate::gather::Gather;
use crate::hide::hidden;
use crate::merge::Piece;
use crate::options::PlotOptions;
use crate::page::Page;
use crate::pens::Pens;
use crate::spots::Spots;
use lsystem_base::MAX_PLOT_BLOCKS;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Halt, Style, Work};

/// The most strokes, and the most open blocks, of a drawing that is read as it stands for the comparison. To read more
/// would take longer than the rest of a deep plot. With so many strokes shorter than the pen, the cut saves most of the
/// ink; the number is a guess.
const COMPARED: u64 = 200_000;

/// The ink of a plot.
#[derive(Debug)]
pub(crate) struct Ink {
    pub(crate) pieces: Vec<Piece>,
    pub(crate) spots: Spots,
    /// The colours of the layers.
    pub(crate) colours: Vec<[u8; 3]>,
    /// The travel of all strokes in drawing order, in millimetres.
    pub(crate) travel: f64,
    /// The length of the pieces, in millimetres.
    length: f64,
    /// The length of the moves that may be drawn, in millimetres: what the cut saved, or specks in ink. Infinite if it is
    /// unknown.
    pub(crate) spare: f64,
}

impl Ink {
    /// The strokes, each stretch of a line once.
    fn new(pens: Pens, spots: Spots, work: &mut dyn Work) -> Result<Self, Halt> {
        let travel = pens.travel_home();
        let (pieces, length) = pens.strokes.finish(work)?;
        Ok(Self { pieces, spots, colours: pens.colours, travel, length, spare: pens.spare })
    }
}

/// The ink of a drawing with at most `most` strokes.
///
/// # Errors
/// If there are too many strokes or blocks.
pub(crate) fn ink(
    drawing: &Drawing,
    style: &Style,
    page: &Page,
    options: PlotOptions,
    most: u64,
    work: &mut dyn Work,
) -> Result<Ink, Halt> {
    if options.hide {
        let pens = hidden(drawing, style, page, &options, most, work)?;
        return Ink::new(pens, Spots::new(options.pen), work);
    }
    let facts = BlockFacts::new(drawing, work)?;
    let mut read = |limits: [u64; 2], is_cut: bool| {
        let mut gather = Gather::new(drawing, style, &facts, page, options);
        ([gather.pens.most, gather.most_blocks], gather.is_cut) = (limits, is_cut);
        gather.read(work)?;
        Ink::new(gather.pens, gather.spots, work)
    };
    let finest = drawing.root.map_or(f64::INFINITY, |root| facts.finest(root));
    if finest * page.frame.scale.abs() >= options.pen {
        return read([most, MAX_PLOT_BLOCKS], false);
    }
    let plain = match read([most.min(COMPARED), COMPARED], false) {
        Err(Halt::Limit(_)) => None,
        plain => Some(plain?),
    };
    let cut = read([most, MAX_PLOT_BLOCKS], true)?;
    Ok(match plain {
        Some(plain) if plain.length < cut.length => plain,
        plain => Ink { spare: plain.map_or(f64::INFINITY, |plain| plain.length - cut.length), ..cut },
    })
}
