//! The picture of a system for pages elsewhere that show a link: chat programs, social networks, search engines.

use crate::gallery::Entry;
use anyhow::{Result, ensure};
use color_quant::NeuQuant;
use lsystem::render::{FigureRenderer, Painted, PictureOptions, Quality, Vantage, opening_camera};
use lsystem::{View, Viewport, write_json};

/// The size that such pages ask for, in pixels.
pub(crate) const SIZE: [u32; 2] = [1200, 630];
/// The numbers of colours to try until a picture is small enough.
const COLOURS: [usize; 3] = [64, 32, 16];
/// Some chat programs show no larger pictures, in bytes.
const MAX_BYTES: usize = 300_000;
/// The units of work of a step, and of all steps of a picture: some ten seconds.
const STEP: u64 = 1 << 18;
const MAX_WORK: u64 = 1 << 32;
/// One pixel in so many is read to choose the colours.
const SAMPLING: i32 = 10;

/// A PNG with a palette, which holds its system as saved pictures do.
pub(crate) fn picture(entry: &Entry) -> Result<Vec<u8>> {
    let pixels = paint(entry)?;
    for colours in COLOURS {
        let file = encode(entry, &pixels, colours)?;
        if file.len() <= MAX_BYTES {
            return Ok(file);
        }
    }
    anyhow::bail!("{} has too large a picture: more than {MAX_BYTES} bytes in {COLOURS:?} colours", entry.path)
}

/// The pixels, as red, green, blue and alpha.
fn paint(Entry { path, system, figure, .. }: &Entry) -> Result<Vec<u8>> {
    let [width, height] = SIZE;
    let vantage = Vantage { view: View::default(), camera: opening_camera(figure) };
    let viewport = Viewport { width, height, ratio: 1.0 };
    let mut painter = FigureRenderer::new();
    painter.load(figure);
    let style = system.style.clone();
    painter.begin(PictureOptions { style, viewport, vantage, upto: None, quality: Quality::BEST, band: u32::MAX });
    let mut pixels = vec![];
    loop {
        match painter.step(STEP) {
            Painted::Nothing => {}
            Painted::Rows => pixels.extend_from_slice(painter.pixels()),
            Painted::All => return Ok(pixels),
        }
        ensure!(painter.spent() < MAX_WORK, "{path} takes too long to draw");
    }
}

fn encode(entry: &Entry, pixels: &[u8], colours: usize) -> Result<Vec<u8>> {
    let network = NeuQuant::new(SAMPLING, colours, pixels);
    let mut file = vec![];
    let mut encoder = png::Encoder::new(&mut file, SIZE[0], SIZE[1]);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(network.color_map_rgb());
    encoder.set_compression(png::Compression::High);
    // Neighbours in a palette are no neighbours in colour.
    encoder.set_filter(png::Filter::NoFilter);
    encoder.add_itxt_chunk("L-system".to_owned(), write_json(&entry.definition))?;
    let indices: Vec<u8> = pixels.chunks_exact(4).map(|pixel| network.index_of(pixel) as u8).collect();
    encoder.write_header()?.write_image_data(&indices)?;
    Ok(file)
}
