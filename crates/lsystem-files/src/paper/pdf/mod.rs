//! Drawings as PDF: one page with vectors.

mod canvas;
mod packed;

use super::figure::Figure;
use super::tikz::covering;
use crate::compact::{Compact, MANY, SymbolFile, is_shareable};
use crate::{FileOptions, INCH, Writer};
use canvas::{About, Canvas, PageLayout};
use lsystem_drawing::{Drawing, Mark, MarkReader, Plane};
use lsystem_syntax::{Diagnostic, Field, Kind, Meter, Progress, Style};
use std::sync::Arc;

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
pub struct PdfWriter {
    drawing: Arc<Drawing>,
    style: Style,
    canvas: Canvas,
    parts: Parts,
}

/// What is left to write.
enum Parts {
    Flat(MarkReader<Plane>, Figure),
    Shared(Box<Compact>),
}

impl PdfWriter {
    /// A writer for a drawing.
    ///
    /// # Errors
    /// [`Kind::Limit`] if the drawing has more segments and vertices than the options allow.
    pub fn new(drawing: Arc<Drawing>, style: Style, options: &FileOptions) -> Result<Self, Diagnostic> {
        let is_large = || drawing.check_size(options.most.min(FLAT)).is_err();
        let shared = drawing.root.filter(|_| is_shareable(&drawing, &style) && is_large());
        let (parts, size) = match shared {
            Some(root) => {
                let compact = Compact::new(&drawing, root, &style, PICTURE, options.most.min(SHARED));
                let size = compact.size;
                (Parts::Shared(Box::new(compact)), size)
            }
            None => {
                drawing.check_size(options.most)?;
                let figure = Figure::new(&drawing, [PICTURE; 2]);
                (Parts::Flat(MarkReader::new(&drawing), figure), figure.size)
            }
        };
        let about = About { title: options.title.clone(), system: options.system.trim_end().to_owned() };
        let mut canvas = Canvas::new(about, layout(options, &style, size, shared.is_some()));
        if shared.is_none() {
            canvas.begin_picture(0);
        }
        Ok(Self { drawing, style, canvas, parts })
    }
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

impl Writer for PdfWriter {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        let mut meter = Meter::new(work);
        while !meter.is_spent() {
            if let Some(mut whole) = self.canvas.file.take() {
                file.append(&mut whole);
                return Ok(Progress::Done);
            }
            match &mut self.parts {
                Parts::Flat(reader, figure) => {
                    write_mark(&self.drawing, &self.style, reader, figure, &mut self.canvas, &mut meter);
                }
                Parts::Shared(compact) => {
                    // Small shares, so that the work of compressing counts soon.
                    let mut share = Meter::new(meter.left().min(1 << 10));
                    compact.step(&self.drawing, &self.style, &mut self.canvas, &mut share)?;
                    meter.charge(share.spent());
                }
            }
            meter.charge(self.canvas.work());
        }
        Ok(Progress::More)
    }

    fn remark(&self) -> Option<Diagnostic> {
        let count = if let Parts::Shared(compact) = &self.parts { compact.instances() } else { 0 };
        let many = Diagnostic { kind: Kind::Instances { count }, field: Field::Numbers, span: 0..0 };
        if count > MANY { Some(many) } else { covering(&self.style) }
    }
}

/// Writes the next mark, the next vertex of a polygon, or the end.
fn write_mark(
    drawing: &Drawing,
    style: &Style,
    reader: &mut MarkReader<Plane>,
    figure: &Figure,
    canvas: &mut Canvas,
    meter: &mut Meter,
) {
    if canvas.vertex() {
        meter.charge(4);
        return;
    }
    let mark = reader.next(drawing);
    meter.charge(mark.as_ref().map_or(8, Mark::work));
    match mark {
        Some(Mark::Segment(segment, tint)) => {
            let look = figure.look(style, tint, segment.width);
            canvas.stroke(figure.place(segment.from), figure.place(segment.to), look);
        }
        Some(Mark::Polygon(vertices, tint)) => {
            let vertices = vertices.into_iter().map(|vertex| figure.place(vertex)).collect();
            canvas.fill(vertices, style.colour_of(tint).rgb);
        }
        None => canvas.end(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{read_file, write_all, write_json};
    use expect_test::expect;
    use lsystem_drawing::{System, draw};
    use lsystem_syntax::{ColourBy, Definition, LimitName, Limits};
    use miniz_oxide::inflate::decompress_to_vec_zlib;

    fn writer(definition: &Definition, options: &FileOptions) -> Result<PdfWriter, Diagnostic> {
        let drawing =
            draw::<Plane>(&System::new(definition).0.unwrap(), definition.iterations, &Limits::default()).unwrap();
        PdfWriter::new(Arc::new(drawing), definition.style.clone(), options)
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

    fn in_small_steps(definition: &Definition, options: &FileOptions) -> Vec<u8> {
        let (mut writer, mut file) = (writer(definition, options).unwrap(), vec![]);
        while writer.step(&mut file, 1).unwrap() == Progress::More {}
        file
    }

    #[test]
    fn a_page() {
        let definition = leaf();
        let system = write_json(&definition);
        let options = FileOptions { title: "A leaf é".into(), system, ..FileOptions::default() };
        let file = write_all(&mut writer(&definition, &options).unwrap()).unwrap();
        let [page] = &streams_of(&file)[..] else { panic!("one stream") };
        expect![[r#"
            0.984 0.98 0.961 rg
            0 0 279.375 785.197 re
            f
            0.7667938 0 0 0.7667938 0 0 cm
            1 J
            1 j
            0.122 0.361 0.227 RG
            57.86776 w
            204.316 115.736 m
            204.316 231.471 l
            160.026 338.397 l
            S
            0.373 0.561 0.184 RG
            160.026 338.397 m
            115.736 445.322 l
            S
            0.122 0.361 0.227 RG
            204.316 347.207 m
            204.316 462.942 l
            S
            231.47104 w
            204.316 462.942 m
            204.316 578.678 l
            S
            0.122 0.361 0.227 rg
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
        assert!(in_small_steps(&definition, &options) == file);
        let sheet = FileOptions { is_cropped: false, ..options };
        let file = write_all(&mut writer(&definition, &sheet).unwrap()).unwrap();
        assert!(String::from_utf8_lossy(&file).contains("/MediaBox [0 0 595.276 841.89]"));
    }

    #[test]
    fn shared_blocks_are_forms() {
        let file = write_all(&mut writer(&bush(12), &FileOptions::default()).unwrap()).unwrap();
        let streams = streams_of(&file);
        assert!(streams.len() > 5 && file.len() < 10_000, "{} {}", streams.len(), file.len());
        assert!(streams.iter().any(|text| text.contains(" cm\n/x0 Do\nQ")));
        assert!(in_small_steps(&bush(12), &FileOptions::default()) == file);
    }

    #[test]
    fn numbers_are_in_range() {
        let definition = Definition {
            axiom: "f".repeat(60) + "F",
            overrides: "f: width times 1000".into(),
            style: Style { width: 1.0, ..Style::default() },
            ..Definition::default()
        };
        let file = write_all(&mut writer(&definition, &FileOptions::default()).unwrap()).unwrap();
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
        assert_eq!(writer(&coloured, &options).err().unwrap().kind, over);
        assert_eq!(write_all(&mut writer(&bush(12), &options).unwrap()).unwrap_err().kind, over);
    }
}
