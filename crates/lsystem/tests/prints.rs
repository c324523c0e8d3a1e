//! PNG files that are painted while they are written: the same pixels as the renderers make at once.

use lsystem::files::{Owner, PngOptions, Sink, collect, read_file, write_png};
use lsystem::render::Quality;
use lsystem::syntax::{ColourBy, Halt, Ink};
use lsystem::{Camera, Definition, Drawing, Figure, Limits, Progress, Renderer, Solid, SolidRenderer, Style, System};
use lsystem::{Plane, Vantage, View, Viewport, draw, write_json};
use std::sync::Arc;

const VIEWPORT: Viewport = Viewport { width: 300, height: 200, ratio: 1.0 };

fn plant(ink: Ink, colour_by: ColourBy) -> Definition {
    let style = Style { ink, colour_by, ..Style::default() };
    let rules = "X -> F-[[X]+X]+F[+FX]-X\nF -> FF".into();
    Definition { axiom: "X".into(), rules, angle: 22.5, style, ..Definition::default() }
}

/// A drawing in which most strokes cover each other.
fn crowd() -> Definition {
    let rules = "F -> FF-[-F+F+F]+[+F-F-F]".into();
    let style = Style { ink: Ink::Solid, ..Style::default() };
    Definition { axiom: "F".into(), rules, angle: 25.7, style, ..Definition::default() }
}

fn drawing(definition: &Definition, n: u32) -> Arc<Drawing> {
    Arc::new(draw::<Plane>(&System::new(definition).unwrap(), n, &Limits::default()).unwrap())
}

fn solid() -> (Style, Arc<Drawing<Solid>>) {
    let rules = "A -> F[&FA]/[&FA]".into();
    let definition = Definition { axiom: "A".into(), rules, angle: 40.0, ..Definition::default() };
    let drawing = draw::<Solid>(&System::new(&definition).unwrap(), 7, &Limits::default()).unwrap();
    (definition.style, Arc::new(drawing))
}

/// The pixels that a renderer makes at once.
fn whole(drawing: &Arc<Drawing>, style: &Style, viewport: Viewport) -> Vec<u8> {
    let mut renderer = Renderer::new();
    renderer.load(drawing.clone());
    renderer.begin(style, viewport, View::default());
    while renderer.step(100_000) == Progress::More {}
    renderer.pixels().to_vec()
}

fn png(figure: &Figure, style: &Style, options: &PngOptions) -> Vec<u8> {
    collect(|sink| write_png(figure, style, Vantage::default(), options, sink)).unwrap().0
}

/// The file's bytes and its pixels, without the channels that the file does not have.
fn read(file: &[u8]) -> (png::Info<'static>, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    (reader.info().clone(), pixels)
}

fn opaque(pixels: &[u8]) -> Vec<u8> {
    pixels.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
}

/// The levels of transparent pixels over a background.
fn over(pixels: &[u8], background: [u8; 3]) -> Vec<u8> {
    let mix = |colour: u8, under: u8, opacity: u8| {
        ((u32::from(colour) * u32::from(opacity) + u32::from(under) * u32::from(255 - opacity) + 127) / 255) as u8
    };
    let pixel =
        |&[r, g, b, a]: &[u8; 4]| [mix(r, background[0], a), mix(g, background[1], a), mix(b, background[2], a)];
    pixels.as_chunks::<4>().0.iter().flat_map(pixel).collect()
}

fn most_difference(a: &[u8], b: &[u8]) -> u8 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap()
}

/// A file with the number of its rows and the bytes of its largest piece.
#[derive(Default)]
struct Rows {
    file: Vec<u8>,
    done: u32,
    largest: usize,
}

impl Owner for Rows {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.file.extend(bytes);
        self.largest = self.largest.max(bytes.len());
        Ok(())
    }

    fn rows(&mut self, done: u32, all: u32) {
        assert!(self.done <= done && done <= all && all == VIEWPORT.height);
        self.done = done;
    }
}

#[test]
fn streamed_is_whole() {
    for (definition, n) in [
        (plant(Ink::Solid, ColourBy::Single), 5),
        (plant(Ink::Solid, ColourBy::Level), 5),
        (plant(Ink::Density, ColourBy::Single), 5),
        (plant(Ink::Auto, ColourBy::Single), 7),
        (crowd(), 20),
    ] {
        let drawing = drawing(&definition, n);
        let expected = opaque(&whole(&drawing, &definition.style, VIEWPORT));
        let figure = Figure::Plane(drawing);
        for band in [1 << 22, 300 * 48] {
            let options = PngOptions { viewport: VIEWPORT, band, ..PngOptions::default() };
            let mut rows = Rows::default();
            let write = |sink: &mut Sink<'_>| write_png(&figure, &definition.style, Vantage::default(), &options, sink);
            Sink::to(&mut rows, write).unwrap();
            assert_eq!((rows.done, rows.largest < 20_000), (VIEWPORT.height, true), "{}", rows.largest);
            let file = rows.file;
            let (_, pixels) = read(&file);
            let differ = pixels.iter().zip(&expected).filter(|(a, b)| a != b).count();
            // Bands round the places of strokes in another way: some strokes are off by a subsample.
            // Sums of ink are rounded in more pixels.
            let most = if definition.style.ink == Ink::Solid { 500 } else { 200 };
            let allowed = if band < 1 << 20 { pixels.len() / most } else { 0 };
            assert!(pixels.len() == expected.len() && differ <= allowed, "{} {band}: {differ}", definition.axiom);
        }
    }
}

#[test]
fn transparent_over_the_background_is_opaque() {
    for (ink, colour_by) in [
        (Ink::Solid, ColourBy::Single),
        (Ink::Solid, ColourBy::Level),
        (Ink::Density, ColourBy::Single),
        (Ink::Density, ColourBy::Level),
        (Ink::Density, ColourBy::Density),
        (Ink::Auto, ColourBy::Single),
        (Ink::Auto, ColourBy::Level),
        (Ink::Auto, ColourBy::Density),
    ] {
        let definition = plant(ink, colour_by);
        let drawing = drawing(&definition, 6);
        let opaque = opaque(&whole(&drawing, &definition.style, VIEWPORT));
        let options = PngOptions { viewport: VIEWPORT, is_transparent: true, ..PngOptions::default() };
        let file = png(&Figure::Plane(drawing), &definition.style, &options);
        let (info, pixels) = read(&file);
        assert_eq!(info.color_type, png::ColorType::Rgba);
        assert_eq!((pixels[3], pixels[0]), (0, 0), "the corner is empty");
        assert!(pixels.as_chunks::<4>().0.iter().any(|pixel| (1..255).contains(&pixel[3])));
        let difference = most_difference(&over(&pixels, definition.style.background.rgb), &opaque);
        // Half a level of the opacity, and half a level of the colour; so much again, and deepened, in a shaded pixel.
        let allowed = if ink == Ink::Auto { 3 } else { 1 };
        assert!(difference <= allowed, "{ink:?} {colour_by:?}: {difference}");
    }
}

#[test]
fn drawings_in_space_are_streamed_in_panes() {
    let (style, drawing) = solid();
    let viewport = Viewport { width: 600, height: 300, ratio: 1.0 };
    let mut renderer = SolidRenderer::new();
    renderer.load(drawing.clone());
    renderer.begin(&style, viewport, &Camera::default(), Quality::BEST);
    while renderer.step(100_000) == Progress::More {}
    let expected = opaque(renderer.pixels());
    let figure = Figure::Space(drawing);
    for band in [1 << 22, 1] {
        let options = PngOptions { viewport, band, ..PngOptions::default() };
        assert_eq!(read(&png(&figure, &style, &options)).1, expected, "{band}");
        let options = PngOptions { is_transparent: true, ..options };
        let (_, pixels) = read(&png(&figure, &style, &options));
        assert!(most_difference(&over(&pixels, style.background.rgb), &expected) <= 1);
    }
}

#[test]
fn files_tell_resolution_and_system() {
    let definition = plant(Ink::Solid, ColourBy::Single);
    let options = PngOptions {
        viewport: Viewport { width: 20, height: 10, ratio: 1.0 },
        dpi: Some(300.0),
        system: write_json(&definition),
        ..PngOptions::default()
    };
    let file = png(&Figure::Plane(drawing(&definition, 2)), &definition.style, &options);
    let (info, _) = read(&file);
    assert_eq!((info.width, info.height, info.color_type), (20, 10, png::ColorType::Rgb));
    let dims = info.pixel_dims.unwrap();
    // 300 pixels of 25.4 mm are 11,811 of a metre.
    assert_eq!((dims.xppu, dims.yppu, dims.unit), (11_811, 11_811, png::Unit::Meter));
    assert_eq!(read_file(&file).definition.unwrap(), definition);
}
