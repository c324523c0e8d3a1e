//! A file of a system, made in steps and taken piece by piece.

use crate::budget::{BAND, FEW_SEGMENTS, MESH, TEXT_SEGMENTS, WORK};
use crate::stages::{Begun, FileWriter, described_file, plane_file, projected_file, solid_file, text_file};
use crate::string::string_file;
use lsystem_drawing::{Figure, Outlook, System};
use lsystem_files::{Content, FileOptions, Format, PngOptions, PngWriter, write_json};
use lsystem_render::{Camera, Vantage, View, Viewport};
use lsystem_syntax::{Definition, Problem, Progress, problems};

/// The side of a picture of pixels whose size is not given.
const USUAL: u32 = 1024;

/// What to make.
pub(crate) struct Order {
    pub(crate) definition: Definition,
    pub(crate) format: &'static Format,
    /// The choices of the reader. Title, description, system and limits are filled in.
    pub(crate) options: FileOptions,
    /// The place of pictures of pixels in the plane.
    pub(crate) view: View,
    /// The camera on drawings in space.
    pub(crate) camera: Camera,
    /// Device pixels in a CSS pixel, for pictures of pixels.
    pub(crate) ratio: f64,
    /// The number of segments that pictures of pixels show; `None` for all.
    pub(crate) upto: Option<u128>,
}

/// A file in the making.
pub(crate) struct FileMaker {
    definition: Definition,
    /// The writer; `None` at the end.
    writer: Option<FileWriter>,
    /// The bytes written and not yet taken.
    piece: Vec<u8>,
    /// Whether the whole file was written.
    pub(crate) complete: bool,
    /// The reasons why there is no file, or remarks about it.
    pub(crate) diagnostics: Vec<Problem>,
}

impl FileMaker {
    /// Begins a file. A definition with errors has none.
    pub(crate) fn new(order: Order) -> Self {
        let definition = order.definition.clone();
        let (system, diagnostics) = System::new(&definition);
        let mut maker = Self { definition, writer: None, piece: vec![], complete: false, diagnostics: vec![] };
        match system.map(|system| begin(order, system)) {
            Some(Ok(writer)) => maker.writer = Some(writer),
            Some(Err(limit)) => maker.diagnostics = problems(&[limit], &maker.definition, ""),
            None => maker.diagnostics = problems(&diagnostics, &maker.definition, ""),
        }
        maker
    }

    /// Works for about [`WORK`] units.
    pub(crate) fn step(&mut self) -> Progress {
        let Some(writer) = &mut self.writer else { return Progress::Done };
        match writer.step(&mut self.piece, WORK) {
            Ok(Progress::More) => return Progress::More,
            Ok(Progress::Done) => {
                self.complete = true;
                self.diagnostics = problems(writer.remark().as_slice(), &self.definition, "");
            }
            Err(limit) => self.diagnostics = problems(&[limit], &self.definition, ""),
        }
        self.writer = None;
        Progress::Done
    }

    /// The number of bytes written and not yet taken.
    pub(crate) fn waiting(&self) -> usize {
        self.piece.len()
    }

    /// Takes the bytes written since the last call.
    pub(crate) fn take(&mut self) -> Vec<u8> {
        core::mem::take(&mut self.piece)
    }
}

/// The writer of a file from its first stage on.
fn begin(Order { definition, format, options, view, camera, ratio, upto }: Order, system: System) -> Begun {
    let n = definition.iterations;
    let outlook = Outlook { azimuth: camera.azimuth, elevation: camera.elevation };
    let (style, name) = (system.style.clone(), definition.label().to_owned());
    let stored = if options.bare { String::new() } else { write_json(&definition) };
    let options = FileOptions { title: name.clone(), system: stored, most: TEXT_SEGMENTS, ..options };
    match format.content {
        Content::System => Ok(text_file(write_json(&definition))),
        Content::String => string_file(system, n),
        Content::Words(write) => write(&definition, &system, &options),
        Content::Pixels => {
            let [width, height] = options.size.unwrap_or([USUAL; 2]);
            let viewport = Viewport { width, height, ratio };
            let FileOptions { dpi, transparent: is_transparent, system: stored, .. } = options;
            let png = PngOptions { viewport, dpi, is_transparent, system: stored, upto, band: BAND };
            let vantage = Vantage { view, camera };
            Ok(match system.is_solid() {
                true => solid_file(&system, n, move |drawing| {
                    Ok(Box::new(PngWriter::new(&Figure::Space(drawing), style, vantage, &png)?))
                }),
                false => plane_file(&system, n, move |drawing| {
                    Ok(Box::new(PngWriter::new(&Figure::Plane(drawing), style, vantage, &png)?))
                }),
            })
        }
        Content::Segments { space, .. } if system.is_solid() => {
            Ok(solid_file(&system, n, move |drawing| space(drawing, TEXT_SEGMENTS)))
        }
        Content::Segments { plane, .. } => Ok(plane_file(&system, n, move |drawing| plane(drawing, TEXT_SEGMENTS))),
        Content::Paper(write) => {
            let most = if format.name == "svg-compact" && !system.is_solid() { FEW_SEGMENTS } else { TEXT_SEGMENTS };
            let with = move |description| FileOptions { description, most, ..options };
            if !system.is_solid() {
                return Ok(plane_file(&system.clone(), n, move |drawing| {
                    let bounds = drawing.bounds();
                    described_file(system, n, drawing, bounds, move |drawing, words| {
                        write(drawing, style, &with(words))
                    })
                }));
            }
            Ok(solid_file(&system.clone(), n, move |drawing| {
                let bounds = drawing.bounds().map(|[low, high]| [low[0], low[1], high[0], high[1]]);
                described_file(system, n, drawing, bounds, move |drawing, words| {
                    projected_file(drawing, outlook, move |drawing| write(drawing, style, &with(words)))
                })
            }))
        }
        Content::Mesh(write) => {
            let options = FileOptions { most: FEW_SEGMENTS, memory: MESH, ..options };
            Ok(solid_file(&system, n, move |drawing| write(drawing, style, &options)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_files::FORMATS;

    fn order(format: &str, definition: Definition) -> Order {
        let format = Format::named(format).unwrap();
        let (view, camera) = (View::default(), Camera::default());
        Order { definition, format, options: FileOptions::default(), view, camera, ratio: 1.0, upto: None }
    }

    /// Runs all steps, with the sizes of the pieces.
    fn finish(order: Order) -> (FileMaker, Vec<u8>, usize) {
        let mut maker = FileMaker::new(order);
        let (mut file, mut largest) = (vec![], 0);
        loop {
            let progress = maker.step();
            largest = largest.max(maker.waiting());
            file.append(&mut maker.take());
            if progress == Progress::Done {
                return (maker, file, largest);
            }
        }
    }

    fn weed(n: u32) -> Definition {
        Definition {
            axiom: "F".into(),
            rules: "F -> F[+F]F[-F]F".into(),
            angle: 25.7,
            iterations: n,
            ..Definition::default()
        }
    }

    #[test]
    fn every_format_is_made_of_systems_in_the_plane_and_in_space() {
        let bent = Definition { rules: "F -> F[&F]F[-F]F".into(), ..weed(3) };
        for definition in [weed(3), bent] {
            // TikZ's library has no symbols for space.
            let says_it = |format: &&Format| format.name != "tikz-library" || !definition.rules.contains('&');
            for format in FORMATS.iter().filter(says_it) {
                let (maker, file, _) = finish(order(format.name, definition.clone()));
                assert!(maker.complete && !file.is_empty(), "{} {:?}", format.name, maker.diagnostics);
            }
        }
    }

    #[test]
    fn large_files_are_taken_in_small_pieces() {
        for (format, n) in [("csv", 8), ("svg", 8), ("txt", 9), ("obj", 6)] {
            let (maker, file, largest) = finish(order(format, weed(n)));
            assert!(maker.complete && file.len() > 3_000_000, "{format}: {}", file.len());
            assert!(largest < 1 << 20, "{format}: {largest}");
        }
    }

    #[test]
    fn limits_and_errors_are_told_and_no_file_is_complete() {
        let large = Definition { rules: "F -> FF : 1\nF -> F[+F] : 1".into(), ..weed(40) };
        let wrong = Definition { rules: "F = FF".into(), ..weed(2) };
        for (format, definition) in
            [("svg", weed(20)), ("txt", weed(40)), ("glb", weed(20)), ("csv", large), ("json", wrong)]
        {
            let (maker, _, _) = finish(order(format, definition));
            assert!(!maker.complete && !maker.diagnostics.is_empty(), "{format}");
        }
    }

    #[test]
    fn pictures_have_a_description_and_their_system_unless_it_is_left_out() {
        for bare in [false, true] {
            // 5^60 segments exceed 128 bits.
            for (format, n) in [("svg", 2), ("svg-compact", 60)] {
                let (maker, file, _) =
                    finish(Order { options: FileOptions { bare, ..FileOptions::default() }, ..order(format, weed(n)) });
                let text = String::from_utf8(file).unwrap();
                assert!(maker.complete && text.contains("<desc"), "{format}");
                assert_eq!(text.contains("F[+F]F[-F]F"), !bare, "{format}");
            }
        }
    }
}
