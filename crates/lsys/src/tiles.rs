//! `lsys tiles`: a pyramid of tiles in a folder, with a page that shows it.
//!
//! Any number of processes may work on the same folder. A tile has the same bytes whoever makes it, so nobody waits for
//! others, and work that was stopped is done again.

mod folder;
mod layout;

use crate::cli::{Changes, TileOptions};
use crate::progress::DelayedBar;
use crate::{CommandFailure, cores, input, memory, print, say};
use folder::Folder;
use layout::Layout;
use lsystem::base::word;
use lsystem::drawing::{Outlook, why_empty};
use lsystem::render::{BAND_PIXEL, Pyramid, TilePlace, TileRenderer};
use lsystem::syntax::visible;
use lsystem::{Progress, write_json};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Units of work between two steps of a tile.
const WORK: usize = 1_000_000;
/// The bytes of a renderer beside its pixels.
const RENDERER_BYTES: u64 = 20 << 20;

/// Makes the tiles that are missing.
pub(crate) fn tiles(file: &Path, to: &Path, options: &TileOptions, changes: &Changes) -> Result<(), CommandFailure> {
    let input = input::read(file, changes, &mut say)?;
    if let Some(reason) = why_empty(&input.system, input.iterations) {
        let warning = say!("warning: {}", reason);
        say(&format!("{warning}\n --> {}\n", visible(&input.file.display().to_string())));
    }
    let wrong = |limit| input.limit(&limit);
    // The direction of view is the page's first one.
    let drawing = input.draw(1).and_then(|figure| figure.seen_from(&Outlook::default(), input.limits(1).segments));
    let drawing = drawing.map_err(wrong)?;
    let style = input.system.style.clone();
    let layout = Layout { options: *options, background: style.background.rgb, name: input.definition.label() };
    let failed = |error: io::Error| CommandFailure::io(to.display(), &error);
    let index = layout.index(&write_json(&input.definition));
    let folder = Folder::open(to, &index, &layout.names()).map_err(failed)?;
    for (path, text) in layout.descriptions() {
        folder.write(&path, text.as_bytes()).map_err(failed)?;
    }
    let pyramid = Arc::new(Pyramid::new(drawing, style, options.size));
    let tally = Maker { layout: &layout, folder: &folder, pyramid: &pyramid, to }.make()?;
    print(|out| writeln!(out, "{tally}"))
}

/// The counts of tiles made, kept and left out.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    made: u64,
    bytes: u64,
    /// Tiles that were there before.
    kept: u64,
    /// Tiles without ink.
    blank: u64,
    /// Tiles that took too long in full detail.
    rough: u64,
}

impl std::fmt::Display for Tally {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { made, bytes, kept, blank, rough } = self;
        out.write_str(&say!("{} tiles made ({} bytes), {} kept, {} without ink", made, bytes, kept, blank))?;
        if *rough > 0 { write!(out, ", {}", say!("{} without their finest detail", rough)) } else { Ok(()) }
    }
}

/// A picture to make, and its file.
enum Work {
    Tile(TilePlace),
    /// The whole drawing with fewer pixels than a tile.
    Small(u32),
}

struct Maker<'a> {
    layout: &'a Layout<'a>,
    folder: &'a Folder,
    pyramid: &'a Arc<Pyramid>,
    /// The folder, for messages.
    to: &'a Path,
}

impl Maker<'_> {
    /// Makes all tiles, level after level, on all cores or as many as asked for. Stops at the first error.
    fn make(&self) -> Result<Tally, CommandFailure> {
        let options = self.layout.options;
        let share = options.part;
        let small = self.layout.small().filter(|_| share.has(TilePlace::WHOLE)).map(Work::Small);
        let level = |level| self.pyramid.tiles(level, options.under, |tile| share.leads_on(tile));
        let tiles = (options.levels.0..=options.levels.1).flat_map(level).filter(|tile| share.has(*tile));
        let queue = Mutex::new(small.chain(tiles.map(Work::Tile)));
        let progress = Mutex::new((Tally::default(), DelayedBar::new(word!("tiles"), None)));
        let failure = Mutex::new(None);
        let lock_failure = || failure.lock().unwrap_or_else(PoisonError::into_inner);
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        cores::side_by_side(options.threads.map_or(usize::MAX, |most| most.get().into()).min(cores::count()), || {
            let mut renderer = None;
            while lock_failure().is_none()
                && let Some(work) = next()
            {
                match self.one(&mut renderer, &work) {
                    Ok(add) => {
                        let (tally, bar) = &mut *progress.lock().unwrap_or_else(PoisonError::into_inner);
                        add(tally);
                        bar.at(tally.made + tally.kept + tally.blank);
                    }
                    Err(error) => *lock_failure() = Some(error),
                }
            }
        });
        let failure = failure.into_inner().unwrap_or_else(PoisonError::into_inner);
        failure.map_or_else(|| Ok(progress.into_inner().unwrap_or_else(PoisonError::into_inner).0), Err)
    }

    /// A renderer of tiles, if there is memory for it.
    fn renderer(&self) -> Result<TileRenderer, CommandFailure> {
        let side = u64::from(self.layout.options.size);
        memory::check(RENDERER_BYTES + side * side * BAND_PIXEL)?;
        Ok(TileRenderer::new(self.pyramid.clone(), self.layout.options.transparent))
    }

    /// Makes a picture, unless it is there. Returns what to count.
    fn one(
        &self,
        renderer: &mut Option<TileRenderer>,
        work: &Work,
    ) -> Result<impl FnOnce(&mut Tally) + use<>, CommandFailure> {
        let failed = |error: io::Error| CommandFailure::io(self.to.display(), &error);
        let (path, side): (PathBuf, u32) = match work {
            Work::Tile(tile) => (self.layout.path(*tile), self.layout.options.size),
            Work::Small(side) => (self.layout.small_path(*side), *side),
        };
        let (mut is_kept, mut is_blank, mut is_rough, mut bytes) = (false, false, false, 0);
        if self.folder.has(&path) {
            is_kept = true;
        } else {
            let renderer = match renderer {
                Some(renderer) => renderer,
                none => none.insert(self.renderer()?),
            };
            match work {
                Work::Tile(tile) => renderer.begin(*tile),
                Work::Small(side) => renderer.begin_small(*side),
            }
            while renderer.step(WORK) == Progress::More {}
            is_blank = renderer.is_blank();
            is_rough = renderer.stats().is_rough();
            if !is_blank {
                let file = encode(renderer.pixels(), side).map_err(|error| failed(io::Error::other(error)))?;
                self.folder.write(&path, &file).map_err(failed)?;
                bytes = file.len() as u64;
            }
        }
        Ok(move |tally: &mut Tally| {
            tally.kept += u64::from(is_kept);
            tally.blank += u64::from(is_blank);
            tally.rough += u64::from(is_rough);
            tally.made += u64::from(bytes > 0);
            tally.bytes += bytes;
        })
    }
}

/// A tile as PNG: with a palette where it has at most 256 colours, as tiles of one ink have.
fn encode(pixels: &[u8], side: u32) -> Result<Vec<u8>, png::EncodingError> {
    let (pixels, _) = pixels.as_chunks::<4>();
    let mut colours = BTreeSet::new();
    let has_few = pixels.iter().all(|pixel| colours.contains(pixel) || colours.len() < 256 && colours.insert(*pixel));
    let is_opaque = pixels.iter().all(|pixel| pixel[3] == u8::MAX);
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, side, side);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let data: Vec<u8> = if has_few {
        let palette: Vec<_> = colours.into_iter().collect();
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(palette.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect::<Vec<_>>());
        if !is_opaque {
            encoder.set_trns(palette.iter().map(|pixel| pixel[3]).collect::<Vec<_>>());
        }
        pixels.iter().map(|pixel| palette.binary_search(pixel).unwrap_or_default() as u8).collect()
    } else if is_opaque {
        encoder.set_color(png::ColorType::Rgb);
        pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
    } else {
        encoder.set_color(png::ColorType::Rgba);
        pixels.as_flattened().to_vec()
    };
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(file)
}
