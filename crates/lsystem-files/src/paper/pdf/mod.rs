//! Drawings as PDF: one page with vectors.

mod canvas;
mod packed;

use super::figure::Figure;
use crate::compact::{Compact, SymbolFile, is_shareable};
use crate::strokes::write_marks;
use crate::svg::warning;
use crate::{FileOptions, Notes, Sink};
use canvas::{About, Canvas, PageLayout};
use lsystem_drawing::Drawing;
use lsystem_plot::INCH;
use lsystem_syntax::{Halt, Style};

/// The pixels along the longer side of the picture.
const PICTURE: f64 = 1024.0;
/// The most segments and vertices of polygons that are written out where blocks can be shared.
const FLAT: u64 = 100_000;
/// The most strokes, vertices and placed blocks of a picture of shared blocks. All are in memory at once.
const SHARED: u64 = 200_000;
/// The points of a millimetre.
const MILLIMETRE: f64 = 72.0 / INCH;

/// Writes a PDF. A drawing of more than 100,000 segments has each of its shared blocks as one form, which the page and
/// other forms place; a drawing without shared blocks is always written out. The compressed file is in memory until it
/// is complete.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the drawing has more segments and vertices than the options allow.
pub(crate) fn write_pdf(
    drawing: &Drawing,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    let about = About { title: &options.title, system: options.system.trim_end() };
    let is_large = || drawing.check_size(options.most.min(FLAT)).is_err();
    let painted;
    if let Some(root) = drawing.root.filter(|_| is_shareable(drawing, style) && is_large()) {
        let picture = Compact::new(drawing, root, style, PICTURE, options.most.min(SHARED), sink)?;
        let mut canvas = Canvas::new(about, layout(options, style, picture.size, true), sink);
        picture.write(&mut canvas)?;
        canvas.finish()?;
        painted = picture.painted();
    } else {
        drawing.check_size(options.most)?;
        let figure = Figure::new(drawing, [PICTURE; 2]);
        let mut canvas = Canvas::new(about, layout(options, style, figure.size, false), sink);
        canvas.begin_picture(0);
        let look = |tint, width| figure.look(style, tint, width);
        write_marks(drawing, style, |point| figure.place(point), look, &mut canvas)?;
        canvas.finish()?;
        painted = drawing.segment_count();
    }
    Ok(Notes { remark: warning(painted, style.ink), ..Notes::default() })
}

/// The page for a picture of this size in pixels. The origin of its pixels is the upper left corner if `from_top`, or
/// else the lower left corner.
fn layout(options: &FileOptions, style: &Style, size: [f64; 2], from_top: bool) -> PageLayout {
    let sheet = &options.sheet;
    let (width, height) = sheet.inner();
    let scale = (width / size[0]).min(height / size[1]) * MILLIMETRE;
    let picture = size.map(|side| side * scale);
    let page = if options.is_cropped { picture } else { [sheet.width, sheet.height].map(|side| side * MILLIMETRE) };
    let corner = [0, 1].map(|axis| 0.5 * (page[axis] - picture[axis]));
    let origin = [corner[0], corner[1] + if from_top { picture[1] } else { 0.0 }];
    PageLayout { size: page, scale, origin, background: style.background.rgb }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{collect, read_file, write_json};
    use expect_test::expect;
    use lsystem_base::{LimitName, Limits};
    use lsystem_drawing::{Plane, System, draw};
    use lsystem_syntax::{ColourBy, Definition, Diagnostic, Kind};
    use miniz_oxide::inflate::decompress_to_vec_zlib;

    fn written(definition: &Definition, options: &FileOptions) -> Result<Vec<u8>, Diagnostic> {
        let drawing =
            draw::<Plane>(&System::new(definition).unwrap(), definition.iterations, &Limits::default()).unwrap();
        collect(|sink| write_pdf(&drawing, &definition.style, options, sink)).map(|(file, _)| file)
    }

    fn leaf() -> Definition {
        Definition {
            axiom: "F[+F'F]fF!(2)F{-f+f+f-|-f+f+f}".into(),
            angle: 22.5,
            style: Style { width: 0.5, ..Style::default() },
            ..Definition::default()
        }
    }

    fn bush(iterations: u32) -> Definition {
        let rules = "X -> F-[[X]+X]+F[-FX]-X\nF -> FF".into();
        Definition { axiom: "X".into(), rules, angle: 22.5, iterations, ..Definition::default() }
    }

    /// Checks that every entry of the cross-reference table points at its object. Returns the content streams.
    fn streams_of(file: &[u8]) -> Vec<String> {
        let last = |text: &str| file.windows(text.len()).rposition(|window| window == text.as_bytes()).unwrap();
        assert!(file.starts_with(b"%PDF-1.7") && file.trim_ascii_end().ends_with(b"%%EOF"));
        let start = last("startxref");
        let table: usize = str::from_utf8(&file[start + 9..last("%%EOF")]).unwrap().trim().parse().unwrap();
        let table = str::from_utf8(&file[table..last("trailer")]).unwrap();
        let mut streams = vec![];
        for (number, entry) in table.strip_prefix("xref\n").unwrap().lines().skip(1).enumerate() {
            if entry.trim_end().ends_with('n') {
                let object = &file[entry[..10].parse::<usize>().unwrap()..];
                assert!(object.starts_with(format!("{number} 0 obj").as_bytes()), "{number}");
                let data = object.windows(7).position(|window| window == b"stream\n").map_or(0, |at| at + 7);
                let head = String::from_utf8_lossy(&object[..data]);
                if !head.contains("endobj") && head.contains("FlateDecode") {
                    streams.push(String::from_utf8(decompress_to_vec_zlib(&object[data..]).unwrap()).unwrap());
                }
            }
        }
        streams
    }

    #[test]
    fn a_page() {
        let definition = leaf();
        let system = write_json(&definition);
        let options = FileOptions { title: "A leaf é".into(), system, ..FileOptions::default() };
        let file = written(&definition, &options).unwrap();
        let [page] = &streams_of(&file)[..] else { panic!("one stream") };
        expect![[r#"
            0.984 0.98 0.961 rg
            0 0 279.375 785.197 re
            f
            0.7667938 0 0 0.7667938 0 0 cm
            1 J
            1 j
            0.122 0.361 0.227 RG
            3.9626448 w
            204.316 115.736 m
            204.316 231.471 l
            160.026 338.397 l
            S
            0.373 0.561 0.184 RG
            160.026 338.397 m
            115.736 445.322 l
            S
            0.122 0.361 0.227 rg
            212.23 462.535 m
            211.749 465.691 l
            210.062 468.4 l
            207.442 470.225 l
            204.316 470.867 l
            201.189 470.225 l
            198.57 468.4 l
            196.882 465.691 l
            196.401 462.535 l
            202.337 347.105 l
            202.516 346.378 l
            202.951 345.77 l
            203.581 345.366 l
            204.316 345.225 l
            205.05 345.366 l
            205.68 345.77 l
            206.116 346.378 l
            206.294 347.105 l
            h
            f
            0.122 0.361 0.227 RG
            15.850579 w
            204.316 462.942 m
            204.316 578.678 l
            S
            204.316 578.678 m
            248.606 685.603 l
            248.606 801.339 l
            204.316 908.264 l
            160.026 801.339 l
            160.026 685.603 l
            204.316 578.678 l
            h
            f
        "#]]
        .assert_eq(page);
        assert_eq!(read_file(&file).definition, Some(definition.clone()));
        let sheet = FileOptions { is_cropped: false, ..options };
        let file = written(&definition, &sheet).unwrap();
        assert!(String::from_utf8_lossy(&file).contains("/MediaBox [0 0 595.276 841.89]"));
    }

    #[test]
    fn shared_blocks_are_forms() {
        let file = written(&bush(12), &FileOptions::default()).unwrap();
        let streams = streams_of(&file);
        assert!(streams.len() > 5 && file.len() < 10_000, "{} {}", streams.len(), file.len());
        assert!(streams.iter().any(|text| text.contains(" cm\n/x0 Do\nQ")));
    }

    #[test]
    fn numbers_are_in_range() {
        let definition = Definition {
            axiom: "f".repeat(60) + "F",
            overrides: "f: width times 1000".into(),
            style: Style { width: 1.0, max_width: 0.0, ..Style::default() },
            ..Definition::default()
        };
        let file = written(&definition, &FileOptions::default()).unwrap();
        let words = streams_of(&file).join(" ");
        let numbers = words.split_ascii_whitespace().filter_map(|word| word.parse::<f32>().ok());
        assert!(numbers.clone().all(f32::is_finite) && numbers.clone().any(|number| number > 1e30), "{words}");
    }

    #[test]
    fn limits() {
        let options = FileOptions { most: 9, ..FileOptions::default() };
        let over = Kind::Limit { limit: LimitName::Segments, value: 9, largest: None };
        let mut coloured = bush(6);
        coloured.style.colour_by = ColourBy::Path;
        assert_eq!(written(&coloured, &options).err().unwrap().kind, over);
        assert_eq!(written(&bush(12), &options).unwrap_err().kind, over);
    }
}
