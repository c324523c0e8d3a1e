//! `lsys tiles`: a pyramid of tiles in a folder, with a page that shows it.
//!
//! Any number of processes may work on the same folder. A tile has the same bytes whoever makes it, so nobody waits for
//! others, and work that was stopped is done again.

mod folder;
mod layout;

use crate::cli::{Changes, TileOptions};
use crate::progress::DelayedBar;
use crate::{CommandFailure, input, print, say};
use folder::Folder;
use layout::Layout;
use lsystem::drawing::{Outlook, why_empty};
use lsystem::render::{Pyramid, TileRenderer};
use lsystem::syntax::visible;
use lsystem::{Progress, write_json};
use std::collections::BTreeSet;
use std::io;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// Units of work between two steps of a tile.
const WORK: usize = 1_000_000;

/// Makes the tiles that are missing.
pub(crate) fn tiles(file: &Path, to: &Path, options: &TileOptions, changes: &Changes) -> Result<(), CommandFailure> {
    let input = input::read(file, changes, &mut say)?;
    if let Some(reason) = why_empty(&input.system, input.iterations) {
        say(&format!("warning: {reason}\n --> {}\n", visible(&input.file.display().to_string())));
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
    let tally = Maker { layout: &layout, folder: &folder, pyramid: &pyramid }.make().map_err(failed)?;
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
        write!(out, "{made} tiles made ({bytes} bytes), {kept} kept, {blank} without ink")?;
        if *rough > 0 { write!(out, ", {rough} without their finest detail") } else { Ok(()) }
    }
}

/// A picture to make, and its file.
enum Work {
    Tile(lsystem::render::TilePlace),
    /// The whole drawing with fewer pixels than a tile.
    Small(u32),
}

struct Maker<'a> {
    layout: &'a Layout<'a>,
    folder: &'a Folder,
    pyramid: &'a Arc<Pyramid>,
}

impl Maker<'_> {
    /// Makes all tiles level by level, on all cores or as many as asked for.
    fn make(&self) -> io::Result<Tally> {
        let options = self.layout.options;
        let threads = options
            .threads
            .map_or_else(|| thread::available_parallelism().map_or(1, NonZero::get), |threads| threads.get() as usize);
        let share = options.part.0;
        let mut renderers: Vec<_> =
            (0..threads).map(|_| TileRenderer::new(self.pyramid.clone(), options.transparent)).collect();
        let tally = Mutex::new(Tally::default());
        let bar = Mutex::new(DelayedBar::new("tiles", None));
        let small = self.layout.small().filter(|_| share.has(lsystem::render::TilePlace::WHOLE)).map(Work::Small);
        self.all(&mut renderers, small.into_iter(), &tally, &bar)?;
        for level in options.levels.0..=options.levels.1 {
            let tiles = self.pyramid.tiles(level, options.under.0, |tile| share.leads_on(tile));
            let tiles = tiles.filter(|tile| share.has(*tile)).map(Work::Tile);
            self.all(&mut renderers, tiles, &tally, &bar)?;
        }
        let tally = *tally.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(tally)
    }

    /// Makes pictures, one at a time with each renderer. Stops at the first error.
    fn all<I: Iterator<Item = Work> + Send>(
        &self,
        renderers: &mut [TileRenderer],
        queue: I,
        tally: &Mutex<Tally>,
        bar: &Mutex<DelayedBar>,
    ) -> io::Result<()> {
        let (queue, failure) = (Mutex::new(queue), Mutex::new(None));
        let lock_failure = || failure.lock().unwrap_or_else(PoisonError::into_inner);
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        let work = |renderer: &mut TileRenderer| {
            while lock_failure().is_none()
                && let Some(work) = next()
            {
                match self.one(renderer, &work) {
                    Ok(add) => {
                        let mut tally = tally.lock().unwrap_or_else(PoisonError::into_inner);
                        add(&mut tally);
                        let done = tally.made + tally.kept + tally.blank;
                        bar.lock().unwrap_or_else(PoisonError::into_inner).at(done);
                    }
                    Err(error) => *lock_failure() = Some(error),
                }
            }
        };
        thread::scope(|scope| {
            for renderer in renderers {
                scope.spawn(|| work(renderer));
            }
        });
        failure.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
    }

    /// Makes a picture, unless it is there. Returns what to count.
    fn one(&self, renderer: &mut TileRenderer, work: &Work) -> io::Result<impl FnOnce(&mut Tally) + use<>> {
        let (path, side): (PathBuf, u32) = match work {
            Work::Tile(tile) => (self.layout.path(*tile), self.layout.options.size),
            Work::Small(side) => (self.layout.small_path(*side), *side),
        };
        let (mut is_kept, mut is_blank, mut is_rough, mut bytes) = (false, false, false, 0);
        if self.folder.has(&path) {
            is_kept = true;
        } else {
            match work {
                Work::Tile(tile) => renderer.begin(*tile),
                Work::Small(side) => renderer.begin_small(*side),
            }
            while renderer.step(WORK) == Progress::More {}
            is_blank = renderer.is_blank();
            is_rough = renderer.stats().is_rough();
            if !is_blank {
                let file = encode(renderer.pixels(), side).map_err(io::Error::other)?;
                self.folder.write(&path, &file)?;
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
