//! A PDF document with one page, and forms (form `XObjects`) that the page and other forms place.

use super::packed::PackedContent;
use crate::Sink;
use crate::compact::{SymbolFile, SymbolForm};
use crate::strokes::{PATH, StrokeFile, StrokeLook, VERTEX_WORK};
use lsystem_syntax::{Halt, Heading, Work};
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::writers::Resources;
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use std::collections::BTreeSet;

/// The program's name in the document.
const PROGRAM: &str = "L-system playground";
/// The name of the attached system.
const ATTACHMENT: &[u8] = b"l-system.json";

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
const FILE: Ref = Ref::new(6);
const FILE_SPECIFICATION: Ref = Ref::new(7);
/// The object of the first form; the others follow.
const FORMS: i32 = 8;

/// The page: its size, and the place of the picture on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct PageLayout {
    /// The width and the height, in points (1/72 inch).
    pub(super) size: [f64; 2],
    /// The points of one CSS pixel of the picture.
    pub(super) scale: f64,
    /// The origin of the picture's pixels, in points.
    pub(super) origin: [f64; 2],
    /// The colour of the whole page.
    pub(super) background: [u8; 3],
}

/// The title and the system in a document.
pub(super) struct About<'a> {
    pub(super) title: &'a str,
    pub(super) system: &'a str,
}

/// Writes a document. Points are in CSS pixels of the picture, y up.
pub(super) struct Canvas<'a, 'o> {
    sink: &'a mut Sink<'o>,
    /// The objects written so far.
    pdf: Pdf,
    about: About<'a>,
    layout: PageLayout,
    stream: PackedContent,
    /// The colour and width of strokes in the open stream, if set.
    stroke_look: Option<StrokeLook>,
    /// The colour of polygons in the open stream, if set.
    fill_colour: Option<[u8; 3]>,
    open: Option<OpenPath>,
    /// The extent of the open symbol, with stroke widths: min x, min y, max x, max y.
    extent: [f64; 4],
    /// The extents of the symbols so far.
    extents: Vec<[f64; 4]>,
    /// The symbols that the open stream places, by number.
    placed: BTreeSet<usize>,
    /// The bytes compressed since the last charge.
    packed: u64,
}

/// The open path.
#[derive(Clone, Copy)]
struct OpenPath {
    look: StrokeLook,
    /// The end of the path so far.
    at: [f32; 2],
    segments: usize,
}

/// The extent of nothing.
const EMPTY: [f64; 4] = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

impl<'a, 'o> Canvas<'a, 'o> {
    pub(super) fn new(about: About<'a>, layout: PageLayout, sink: &'a mut Sink<'o>) -> Self {
        let mut pdf = Pdf::new();
        // First, so that the beginning of a file is enough to open the system.
        if !about.system.is_empty() {
            pdf.embedded_file(FILE, about.system.as_bytes()).subtype(Name(b"application/json"));
        }
        Self {
            sink,
            pdf,
            about,
            layout,
            stream: PackedContent::new(),
            stroke_look: None,
            fill_colour: None,
            open: None,
            extent: EMPTY,
            extents: vec![],
            placed: BTreeSet::new(),
            packed: 0,
        }
    }

    fn begin_stream(&mut self) {
        (self.stroke_look, self.fill_colour, self.extent) = (None, None, EMPTY);
        self.placed.clear();
    }

    fn see(&mut self, [x, y]: [f64; 2], around: f64) {
        let [x0, y0, x1, y1] = self.extent;
        self.extent = [x0.min(x - around), y0.min(y - around), x1.max(x + around), y1.max(y + around)];
    }

    /// Ends the picture and the file.
    pub(super) fn finish(mut self) -> Result<(), Halt> {
        let pdf = &mut self.pdf;
        let packed = self.stream.end();
        pdf.stream(CONTENT, &packed).filter(Filter::FlateDecode);
        let mut page = pdf.page(PAGE);
        page.parent(PAGES).contents(CONTENT);
        page.media_box(Rect::new(0.0, 0.0, short(self.layout.size[0]), short(self.layout.size[1])));
        write_resources(page.resources(), &self.placed);
        page.finish();
        pdf.pages(PAGES).kids([PAGE]).count(1);
        let mut info = pdf.document_info(INFO);
        if !self.about.title.is_empty() {
            info.title(TextStr(self.about.title));
        }
        info.creator(TextStr(PROGRAM));
        info.finish();
        let has_system = !self.about.system.is_empty();
        if has_system {
            let mut specification = pdf.file_spec(FILE_SPECIFICATION);
            specification.path(Str(ATTACHMENT)).description(TextStr("The L-system of the picture"));
            specification.embedded_file(FILE);
        }
        let mut catalog = pdf.catalog(CATALOG);
        catalog.pages(PAGES);
        if has_system {
            catalog.names().embedded_files().names().insert(Str(ATTACHMENT), FILE_SPECIFICATION);
        }
        catalog.finish();
        self.sink.bytes(&self.pdf.finish())
    }
}

/// A unit of work for each compressed byte.
impl Work for Canvas<'_, '_> {
    fn charge(&mut self, units: u64) -> Result<(), Halt> {
        self.sink.charge(units + core::mem::take(&mut self.packed))
    }
}

impl StrokeFile for Canvas<'_, '_> {
    fn stroke(&mut self, from: [f64; 2], to: [f64; 2], look: StrokeLook) {
        let [start, end] = [from, to].map(|point| point.map(short));
        let open = self.open.filter(|open| open.look == look && open.segments < PATH);
        if open.is_none() {
            self.close();
            let content = &mut self.stream.content;
            if self.stroke_look.is_none_or(|known| known.rgb != look.rgb) {
                let [r, g, b] = look.rgb.map(channel);
                content.set_stroke_rgb(r, g, b);
            }
            if self.stroke_look.is_none_or(|known| known.width != look.width) {
                content.set_line_width(real(look.width));
            }
            self.stroke_look = Some(look);
        }
        if open.is_none_or(|open| open.at != start) {
            self.stream.content.move_to(start[0], start[1]);
        }
        self.stream.content.line_to(end[0], end[1]);
        let segments = open.map_or(0, |open| open.segments) + 1;
        self.open = Some(OpenPath { look, at: end, segments });
        self.see(from, 0.5 * look.width);
        self.see(to, 0.5 * look.width);
        self.packed += self.stream.pack();
    }

    fn fill(&mut self, vertices: impl Iterator<Item = [f64; 2]>, rgb: [u8; 3]) -> Result<(), Halt> {
        self.close();
        if self.fill_colour != Some(rgb) {
            let [r, g, b] = rgb.map(channel);
            self.stream.content.set_fill_rgb(r, g, b);
            self.fill_colour = Some(rgb);
        }
        for (number, vertex) in vertices.enumerate() {
            self.charge(VERTEX_WORK)?;
            let [x, y] = vertex.map(short);
            if number == 0 {
                self.stream.content.move_to(x, y);
            } else {
                self.stream.content.line_to(x, y);
            }
            self.see(vertex, 0.0);
            self.packed += self.stream.pack();
        }
        self.stream.content.close_path().fill_nonzero();
        self.packed += self.stream.pack();
        Ok(())
    }

    fn close(&mut self) {
        if self.open.take().is_some() {
            self.stream.content.stroke();
        }
    }
}

impl SymbolFile for Canvas<'_, '_> {
    fn define(&mut self, _: usize, _: SymbolForm) {
        self.begin_stream();
    }

    fn end_symbol(&mut self, _: SymbolForm) {
        let packed = self.stream.end();
        let [x0, y0, x1, y1] = if self.extent[0] <= self.extent[2] { self.extent } else { [0.0; 4] };
        let number = self.extents.len();
        self.extents.push([x0, y0, x1, y1]);
        let mut form = self.pdf.form_xobject(form_ref(number), &packed);
        form.filter(Filter::FlateDecode);
        // Rounded outwards, because a form is cut at its box.
        let [x0, y0] = [x0, y0].map(|c| real(libm::floor(c)));
        let [x1, y1] = [x1, y1].map(|c| real(libm::ceil(c)));
        form.bbox(Rect::new(x0, y0, x1, y1));
        write_resources(form.resources(), &self.placed);
    }

    fn begin_picture(&mut self, _: usize) {
        self.begin_stream();
        let PageLayout { size: [width, height], scale, origin: [x, y], background } = self.layout;
        let [r, g, b] = background.map(channel);
        let content = &mut self.stream.content;
        content.set_fill_rgb(r, g, b).rect(0.0, 0.0, short(width), short(height)).fill_nonzero();
        content.transform([scale as f32, 0.0, 0.0, scale as f32, short(x), short(y)]);
        content.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
    }

    fn place(&mut self, number: usize, at: [f64; 2], heading: Heading) {
        let (c, s) = heading.cos_sin();
        let [x0, y0, x1, y1] = self.extents[number];
        for [u, v] in [[x0, y0], [x0, y1], [x1, y0], [x1, y1]] {
            self.see([at[0] + c * u - s * v, at[1] + s * u + c * v], 0.0);
        }
        self.placed.insert(number);
        let [x, y] = at.map(short);
        let content = &mut self.stream.content;
        content.save_state().transform([c as f32, s as f32, -s as f32, c as f32, x, y]);
        content.x_object(Name(form_name(number).as_bytes())).restore_state();
        self.packed += self.stream.pack();
    }
}

/// Writes the names of the forms that a stream places.
fn write_resources(mut resources: Resources<'_>, placed: &BTreeSet<usize>) {
    let mut forms = resources.x_objects();
    for &number in placed {
        forms.pair(Name(form_name(number).as_bytes()), form_ref(number));
    }
}

fn form_ref(number: usize) -> Ref {
    // A plan has some hundred thousand symbols at most, far below the limit.
    Ref::new(FORMS.saturating_add(i32::try_from(number).unwrap_or(i32::MAX)))
}

fn form_name(number: usize) -> String {
    format!("x{number}")
}

/// A coordinate, rounded to a thousandth so that it has few digits.
fn short(value: f64) -> f32 {
    real(libm::round(value * 1e3) / 1e3)
}

/// A number in the range of PDF (ISO 32000-1, annex C): very broad strokes are beyond it.
fn real(value: f64) -> f32 {
    value.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}

/// A channel of a colour from 0 to 1, with three decimals: enough for 8 bits.
fn channel(value: u8) -> f32 {
    short(f64::from(value) / 255.0)
}
