//! Files of systems.

use crate::budget::{BAND, FEW_SEGMENTS, LIMITS, MESH, TEXT_SEGMENTS};
use crate::string::write_string;
use lsystem_drawing::{Drawer, Drawing, Outlook, Projection, Solid, Space, System, describe};
use lsystem_files::{
    Content, FileOptions, Format, Notes, Owner, PngOptions, Sink, write_json, write_png, write_solid_png,
};
use lsystem_render::{Camera, View, Viewport};
use lsystem_syntax::{Definition, Halt, Problem, Work, problems, run_steps};
use std::sync::Arc;

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
}

/// The report on a file.
#[derive(Debug)]
pub(crate) struct Report {
    /// Whether the whole file was written.
    pub(crate) complete: bool,
    /// The reasons why there is no file, or remarks about it.
    pub(crate) diagnostics: Vec<Problem>,
}

/// Makes a file. A definition with errors has none.
pub(crate) fn make(order: Order, owner: &mut dyn Owner) -> Report {
    let definition = order.definition.clone();
    let (system, diagnostics) = System::new(&definition);
    let Some(system) = system else {
        return Report { complete: false, diagnostics: problems(&diagnostics, &definition, "") };
    };
    let (complete, remarks) = match Sink::to(owner, |sink| write(order, &system, sink)) {
        Ok(notes) => (true, notes.remark),
        Err(halt) => (false, Some(halt.diagnostic())),
    };
    Report { complete, diagnostics: problems(remarks.as_slice(), &definition, "") }
}

/// Writes a file.
fn write(order: Order, system: &System, sink: &mut Sink<'_>) -> Result<Notes, Halt> {
    let Order { definition, format, options, view, camera, ratio } = order;
    let (n, style) = (definition.iterations, &system.style);
    let title = definition.label().to_owned();
    let stored = if options.bare { String::new() } else { write_json(&definition) };
    let options = FileOptions { title, system: stored, most: TEXT_SEGMENTS, ..options };
    let none = |()| Notes::default();
    match format.content {
        Content::System => {
            sink.text.push_str(&write_json(&definition));
            Ok(Notes::default())
        }
        Content::String => write_string(system, n, sink).map(none),
        Content::Words(write) => write(&definition, system, &options, sink),
        Content::Pixels => {
            let [width, height] = options.size.unwrap_or([USUAL; 2]);
            let viewport = Viewport { width, height, ratio };
            let FileOptions { dpi, transparent: is_transparent, system: stored, .. } = options;
            let png = PngOptions { viewport, dpi, is_transparent, system: stored, band: BAND };
            match system.is_solid() {
                true => write_solid_png(solid(system, n, sink)?, style, camera, &png, sink).map(none),
                false => write_png(plane(system, n, sink)?, style, view, &png, sink).map(none),
            }
        }
        Content::Segments { space, .. } if system.is_solid() => {
            space(&*solid(system, n, sink)?, TEXT_SEGMENTS, sink).map(none)
        }
        Content::Segments { plane: write, .. } => write(&*plane(system, n, sink)?, TEXT_SEGMENTS, sink).map(none),
        Content::Paper(write) if system.is_solid() => {
            let drawing = solid(system, n, sink)?;
            let bounds = drawing.bounds().map(|[low, high]| [low[0], low[1], high[0], high[1]]);
            let description = description(system, n, &*drawing, bounds, sink)?;
            let outlook = Outlook { azimuth: camera.azimuth, elevation: camera.elevation };
            let mut projection = Projection::new(&drawing, &outlook, FEW_SEGMENTS)?;
            run_steps(sink, |units| projection.step(&drawing, units))?;
            let projected = Arc::new(projection.finish(&drawing));
            // To save memory.
            drop(drawing);
            write(projected, style, &FileOptions { description, ..options }, sink)
        }
        Content::Paper(write) => {
            let drawing = plane(system, n, sink)?;
            let description = description(system, n, &*drawing, drawing.bounds(), sink)?;
            let most = if format.name == "svg-compact" { FEW_SEGMENTS } else { TEXT_SEGMENTS };
            write(drawing, style, &FileOptions { description, most, ..options }, sink)
        }
        Content::Mesh(write) => {
            let options = FileOptions { most: FEW_SEGMENTS, memory: MESH, ..options };
            write(solid(system, n, sink)?, style, &options, sink)
        }
    }
}

/// The drawing in the plane.
fn plane(system: &System, n: u32, work: &mut dyn Work) -> Result<Arc<Drawing>, Halt> {
    drawn(Drawer::new(system, n, LIMITS), work)
}

/// The drawing in space. Systems in the plane have one, too, for meshes.
fn solid(system: &System, n: u32, work: &mut dyn Work) -> Result<Arc<Drawing<Solid>>, Halt> {
    drawn(Drawer::solid(system, n, LIMITS), work)
}

fn drawn<S: Space>(mut drawer: Drawer<S>, work: &mut dyn Work) -> Result<Arc<Drawing<S>>, Halt> {
    run_steps(work, |units| drawer.step(units))?;
    Ok(Arc::new(drawer.finish()?))
}

/// The drawing in words. The number of segments is counted where the drawing does not tell.
fn description<S: Space>(
    system: &System,
    n: u32,
    drawing: &Drawing<S>,
    bounds: Option<[f64; 4]>,
    work: &mut dyn Work,
) -> Result<String, Halt> {
    let shared = drawing.is_memoised().then(|| drawing.block_count());
    let count = drawing.segment_count();
    if count < u128::MAX {
        return Ok(describe(system, n, &count.into(), shared, bounds));
    }
    let mut counter = system.segments(n);
    run_steps(work, |units| counter.step(units))?;
    Ok(counter.count().map(|count| describe(system, n, count, shared, bounds)).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_files::FORMATS;

    fn order(format: &str, definition: Definition) -> Order {
        let format = Format::named(format).unwrap();
        let (view, camera) = (View::default(), Camera::default());
        Order { definition, format, options: FileOptions::default(), view, camera, ratio: 1.0 }
    }

    /// The whole file, and its largest piece.
    #[derive(Default)]
    struct Pieces(Vec<u8>, usize);

    impl Owner for Pieces {
        fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
            self.0.extend(bytes);
            self.1 = self.1.max(bytes.len());
            Ok(())
        }
    }

    fn finish(order: Order) -> (Report, Vec<u8>, usize) {
        let mut pieces = Pieces::default();
        let report = make(order, &mut pieces);
        (report, pieces.0, pieces.1)
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
