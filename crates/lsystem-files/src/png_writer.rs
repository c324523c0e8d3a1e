//! PNG pictures of any size, painted band by band while the file is written, so that memory does not grow with the picture.

use super::Sink;
use super::embed::KEYWORD;
use super::sheet::INCH;
use core::cell::RefCell;
use lsystem_drawing::{Drawing, Solid};
use lsystem_render::{Camera, Effort, Pane, Pass, Quality, Renderer, SolidRenderer, Spent, View, Viewport};
use lsystem_syntax::{Diagnostic, Halt, LimitName, Progress, Style, Work};
use std::io;
use std::io::Write;
use std::rc::Rc;
use std::sync::Arc;

/// The side of a cell, in pixels. Panes that begin at multiples of this have the same subsamples as the whole picture.
const CELL: u32 = 16;
/// Pixels that are encoded in a unit of work.
const PIXELS_PER_UNIT: u64 = 4;
/// The units of work of a step of a painter.
const WORK: u64 = 1 << 14;

/// The size and the content of a PNG file.
#[derive(Clone, Debug, PartialEq)]
pub struct PngOptions {
    /// The size: at most [`MAX_PICTURE_SIDE`](lsystem_syntax::MAX_PICTURE_SIDE) pixels each way.
    pub viewport: Viewport,
    /// Pixels of an inch on paper; none if the file tells no resolution.
    pub dpi: Option<f64>,
    /// Whether the background is left out, as by [`Renderer::transparent`].
    pub is_transparent: bool,
    /// The system as a text of [`write_json`](crate::write_json), stored in the file for [`read_file`](crate::read_file);
    /// empty for none.
    pub system: String,
    /// The most pixels that are painted at a time. A pixel takes up to 28 bytes. The choice changes some pixels by one
    /// subsample where a larger picture is painted in several bands.
    pub band: u32,
}

impl Default for PngOptions {
    /// 1024 x 1024 pixels, opaque, in bands of 4 Mi pixels (120 MB).
    fn default() -> Self {
        Self {
            viewport: Viewport { width: 1024, height: 1024, ratio: 1.0 },
            dpi: None,
            is_transparent: false,
            system: String::new(),
            band: 1 << 22,
        }
    }
}

/// Writes a picture of a drawing in the plane as PNG.
///
/// # Errors
/// [`LimitName::Memory`] if the machine cannot count the picture's bytes: on 32 bits, 32,768 x 32,768 transparent
/// pixels.
pub fn write_png(
    drawing: Arc<Drawing>,
    style: &Style,
    view: View,
    options: &PngOptions,
    sink: &mut Sink<'_>,
) -> Result<(), Halt> {
    let viewport = size_of(options);
    let size = [viewport.width, band_rows(viewport, options.band)];
    let mut renderer = Renderer::new();
    if options.is_transparent {
        renderer = renderer.transparent();
    }
    renderer.load(drawing);
    let panes = Pass::all(style.ink, viewport, size).into_iter();
    let plane = Plane { renderer: Box::new(renderer), style: style.clone(), viewport, view, panes, pass: None };
    write(Painter::Plane(plane), viewport, options, sink)
}

/// Writes a picture of a drawing in space as PNG.
///
/// # Errors
/// As [`write_png`].
pub fn write_solid_png(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    camera: Camera,
    options: &PngOptions,
    sink: &mut Sink<'_>,
) -> Result<(), Halt> {
    let viewport = size_of(options);
    let mut renderer = SolidRenderer::new();
    if options.is_transparent {
        renderer = renderer.transparent();
    }
    renderer.load(drawing);
    let is_whole = u64::from(viewport.width) * u64::from(viewport.height) <= u64::from(options.band);
    let space = Space {
        renderer: Box::new(renderer),
        style: style.clone(),
        viewport,
        camera,
        effort: Effort::new(Quality::BEST, viewport),
        spent: Spent::default(),
        panes: if is_whole { vec![Pane::whole(viewport)] } else { SolidRenderer::panes(viewport) },
        next: 0,
        is_begun: false,
        is_trial: !is_whole,
        rows: Vec::new(),
    };
    write(Painter::Space(space), viewport, options, sink)
}

fn write(mut painter: Painter, viewport: Viewport, options: &PngOptions, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let Viewport { width, height, .. } = viewport;
    let channels = if options.is_transparent { 4 } else { 3 };
    // The encoder counts the bytes of the picture, and one more for each row.
    let bytes = (u64::from(width) * channels + 1) * u64::from(height);
    if usize::try_from(bytes).is_err() {
        return Err(Diagnostic::limit(LimitName::Memory, usize::MAX as u64, None).into());
    }
    let encoded = Encoded::default();
    let mut encoder = encoder(viewport, options, encoded.clone()).map_err(|_| too_large())?;
    let (mut rows, mut bytes) = (0, vec![]);
    loop {
        let mut left = WORK;
        let painted = painter.step(&mut left);
        sink.charge(WORK - left)?;
        sink.rows(rows, height);
        match painted {
            Painted::Nothing => {}
            Painted::Rows => {
                for row in painter.pixels().chunks_exact(4 * width as usize) {
                    sink.charge(1 + u64::from(width) / PIXELS_PER_UNIT)?;
                    let row = if options.is_transparent {
                        row
                    } else {
                        bytes.clear();
                        bytes.extend(row.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
                        &bytes
                    };
                    encoder.write_all(row).map_err(|_| too_large())?;
                    rows += 1;
                    sink.rows(rows, height);
                    encoded.hand_on(sink)?;
                }
            }
            Painted::All => {
                encoder.finish().map_err(|_| too_large())?;
                return encoded.hand_on(sink);
            }
        }
    }
}

/// The encoder of a picture, which writes to `encoded`.
fn encoder(
    Viewport { width, height, .. }: Viewport,
    options: &PngOptions,
    encoded: Encoded,
) -> Result<png::StreamWriter<'static, Encoded>, png::EncodingError> {
    let mut encoder = png::Encoder::new(encoded, width, height);
    encoder.set_color(if options.is_transparent { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_pixel_dims(options.dpi.map(resolution));
    if !options.system.is_empty() {
        encoder.add_itxt_chunk(KEYWORD.to_owned(), options.system.clone())?;
    }
    encoder.write_header()?.into_stream_writer()
}

/// The encoder fails only where numbers of the file do not fit its fields: a text of 2 GB.
fn too_large() -> Diagnostic {
    Diagnostic::limit(LimitName::Text, u64::from(u32::MAX / 2), None)
}

/// The size of the picture: at least one pixel.
fn size_of(options: &PngOptions) -> Viewport {
    let Viewport { width, height, ratio } = options.viewport.within_sides();
    Viewport { width: width.max(1), height: height.max(1), ratio }
}

/// The rows of a band of at most `most` pixels: all rows, or a multiple of [`CELL`].
fn band_rows(Viewport { width, height, .. }: Viewport, most: u32) -> u32 {
    if u64::from(width) * u64::from(height) <= u64::from(most) {
        return height;
    }
    (most / width.max(1) / CELL * CELL).max(CELL)
}

/// The resolution as the file tells it: pixels of a metre (PNG specification, section 11.3.4.3).
fn resolution(dpi: f64) -> png::PixelDimensions {
    let per_metre = libm::round(dpi * 1000.0 / INCH).clamp(1.0, f64::from(i32::MAX)) as u32;
    png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter }
}

/// The bytes that the encoder has written and nobody has taken yet.
#[derive(Clone, Default)]
struct Encoded(Rc<RefCell<Vec<u8>>>);

impl Encoded {
    fn hand_on(&self, sink: &mut Sink<'_>) -> Result<(), Halt> {
        let bytes = self.0.take();
        if bytes.is_empty() { Ok(()) } else { sink.bytes(&bytes) }
    }
}

impl Write for Encoded {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// What a step of a painter has made.
enum Painted {
    /// Nothing that can be encoded yet.
    Nothing,
    /// Whole rows, below those before.
    Rows,
    /// The whole picture.
    All,
}

enum Painter {
    Plane(Plane),
    Space(Space),
}

impl Painter {
    fn step(&mut self, left: &mut u64) -> Painted {
        match self {
            Self::Plane(plane) => plane.step(left),
            Self::Space(space) => space.step(left),
        }
    }

    /// The rows painted last.
    fn pixels(&self) -> &[u8] {
        match self {
            Self::Plane(plane) => plane.renderer.pixels(),
            Self::Space(space) if space.panes.len() == 1 => space.renderer.pixels(),
            Self::Space(space) => &space.rows,
        }
    }
}

/// Paints a drawing in the plane, in bands from top to bottom.
struct Plane {
    renderer: Box<Renderer>,
    style: Style,
    viewport: Viewport,
    view: View,
    panes: std::vec::IntoIter<(Pane, Pass)>,
    /// The pass being made.
    pass: Option<Pass>,
}

impl Plane {
    fn step(&mut self, left: &mut u64) -> Painted {
        let Some(pass) = self.pass else {
            let Some((pane, pass)) = self.panes.next() else { return Painted::All };
            self.renderer.begin_pane(&self.style, self.viewport, self.view, None, (pane, pass));
            self.pass = Some(pass);
            return Painted::Nothing;
        };
        let before = self.renderer.spent();
        let progress = self.renderer.step(usize::try_from(*left).unwrap_or(usize::MAX));
        *left = left.saturating_sub(self.renderer.spent() - before);
        if progress == Progress::More {
            return Painted::Nothing;
        }
        self.pass = None;
        if pass.shows() { Painted::Rows } else { Painted::Nothing }
    }
}

/// Paints a drawing in space: as a whole, or in panes that share a budget. The budget is known after a trial of all panes.
struct Space {
    renderer: Box<SolidRenderer>,
    style: Style,
    viewport: Viewport,
    camera: Camera,
    effort: Effort,
    /// What the panes of a trial took so far.
    spent: Spent,
    panes: Vec<Pane>,
    /// The pane being made.
    next: usize,
    is_begun: bool,
    /// Whether the panes are made to find their budget.
    is_trial: bool,
    /// The pixels of a row of panes.
    rows: Vec<u8>,
}

impl Space {
    fn step(&mut self, left: &mut u64) -> Painted {
        let Some(&pane) = self.panes.get(self.next) else { return self.end_round() };
        if !self.is_begun {
            self.is_begun = true;
            let (style, viewport) = (&self.style, self.viewport);
            if self.panes.len() == 1 {
                self.renderer.begin(style, viewport, &self.camera, Quality::BEST);
            } else {
                self.renderer.begin_pane(style, viewport, &self.camera, pane, self.effort.budget());
            }
        }
        let before = self.renderer.spent();
        let progress = self.renderer.step(usize::try_from(*left).unwrap_or(usize::MAX));
        *left = left.saturating_sub(self.renderer.spent() - before);
        if progress == Progress::More {
            return Painted::Nothing;
        }
        self.is_begun = false;
        self.next += 1;
        if self.is_trial {
            self.spent.add(self.renderer.effort_spent());
            return Painted::Nothing;
        }
        if self.panes.len() > 1 {
            self.put(pane);
        }
        if pane.x + pane.width == self.viewport.width { Painted::Rows } else { Painted::Nothing }
    }

    /// Ends a round of all panes: the picture is done, or the budget is found or grows.
    fn end_round(&mut self) -> Painted {
        if !self.is_trial {
            return Painted::All;
        }
        self.is_trial = self.effort.is_too_small(core::mem::take(&mut self.spent));
        self.next = 0;
        Painted::Nothing
    }

    /// Copies the pixels of a pane into its row of panes.
    fn put(&mut self, pane: Pane) {
        let [width, pane_width, x] = [self.viewport.width, pane.width, pane.x].map(|side| 4 * side as usize);
        self.rows.resize(width * pane.height as usize, 0);
        let rows = self.renderer.pixels().chunks_exact(pane_width.max(1));
        for (row, pixels) in self.rows.chunks_exact_mut(width.max(1)).zip(rows) {
            row[x..x + pane_width].copy_from_slice(pixels);
        }
    }
}
