//! SVG pictures of any program: drawn as levels of grey, as an outline, or as lines.
//!
//! Foreign files are hostile until the opposite is known: every loop charges the [`Work`] of the whole picture, no
//! function recurses, and a picture that takes too much work is refused. Libraries that draw all of SVG do not bound
//! their work, so only the reading of XML (`quick-xml`) and of attributes (`svgtypes`) is theirs.
//!
//! Shapes, groups, references, nested pictures, styles, strokes with dashes and opacity are drawn. A gradient is its
//! first colour, the opacity of a group is that of its shapes, and lines are at least one pixel wide. Text, images,
//! filters, masks, patterns, markers, clip paths and other files are left out, and named.
//!
//! [`draw_svg`] makes levels of grey, [`outline_of_svg`] a shape for rules, and [`lines`] reads straight lines exactly.
//!
//! ```
//! let svg = "<svg><line x2='4' y2='3' transform='scale(2)'/></svg>";
//! assert_eq!(lsystem_svg::lines(svg, 10), Ok(vec![[[0.0, 0.0], [8.0, 6.0]]]));
//! ```

mod canvas;
mod contour;
mod css;
mod length;
mod lines;
mod outline;
mod shapes;
mod style;
mod transform;
mod walk;
mod work;
mod xml;

pub use lines::lines;

use canvas::Canvas;
use css::Sheet;
use lsystem_base::say;
use lsystem_base::words::said;
use work::Work;
use xml::Document;

/// The most bytes of a file.
const MAX_BYTES: usize = 16 << 20;
/// Why an SVG is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SvgError {
    /// The problem, in words.
    pub message: String,
    /// The byte of the text, if the problem has a place.
    pub at: Option<usize>,
}

impl SvgError {
    fn new(message: String) -> Self {
        Self { message, at: None }
    }

    /// The error with a place, if it has none.
    fn or_at(self, at: usize) -> Self {
        Self { at: self.at.or(Some(at)), ..self }
    }
}

impl core::fmt::Display for SvgError {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str(&self.message)
    }
}

impl core::error::Error for SvgError {}

/// An SVG picture as levels of grey.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SvgPicture {
    /// The levels of grey, row by row from above; 0 is black. The paper is white, or black where nothing shows on white.
    pub grey: Vec<u8>,
    /// In pixels; the longer side has 1024.
    pub width: usize,
    /// In pixels.
    pub height: usize,
    /// The names of what was not drawn, in the plural, such as `clip paths`.
    pub left_out: Vec<&'static str>,
    /// The units of work, of 1 to 5 nanoseconds each.
    pub work: u64,
}

/// Whether a file looks like an SVG.
#[must_use]
pub fn is_svg(bytes: &[u8]) -> bool {
    let start = bytes.iter().find(|byte| !byte.is_ascii_whitespace() && !matches!(byte, 0 | 0x80..));
    start == Some(&b'<') && bytes.windows(5).any(|part| part.starts_with(b"svg") || part == b"s\0v\0g")
}

/// The filled outlines of an SVG file as a shape in the notation, such as `outline(0, 0, 8, 0, 4, 20)`. The longer side is
/// 20 units, the lower edge is at y = 0, and the middle at x = 0. Curves become polygons that are off by at most 0.02 units.
/// Outlines within others are cut out; an outline within these is joined again.
///
/// # Errors
/// A sentence: why the file is no outline.
pub fn outline_of_svg(bytes: &[u8]) -> Result<String, SvgError> {
    let (filled, mut work) = walked(bytes, walk::filled)?;
    contour::shape(filled, &mut work)
}

/// Draws an SVG file: UTF-8, or UTF-16 with a byte order mark.
///
/// # Errors
/// Why it is not drawn.
pub fn draw_svg(bytes: &[u8]) -> Result<SvgPicture, SvgError> {
    let ((canvas, left_out), work) = walked(bytes, walk::drawn)?;
    let Canvas { width, height, .. } = canvas;
    let mut papers = [255.0, 0.0].into_iter().map(|paper| canvas.on(paper));
    let shown = papers.find(|grey| grey.iter().any(|level| *level != grey[0]));
    let grey = shown.ok_or_else(|| {
        SvgError::new(match left_out.is_empty() {
            true => say!("this picture has one shade of grey only"),
            false => say!(
                "this SVG has nothing that is read. Left out: {}",
                left_out.iter().map(|name| said(name)).collect::<Vec<_>>().join(", ")
            ),
        })
    })?;
    Ok(SvgPicture { grey, width, height, left_out, work: work.done() })
}

/// What a way through the elements of a file gives, and the work so far.
fn walked<T>(
    bytes: &[u8],
    walk: impl FnOnce(&Document, &Sheet, &mut Work) -> Result<T, SvgError>,
) -> Result<(T, Work), SvgError> {
    if bytes.len() > MAX_BYTES {
        return Err(SvgError::new(say!("this SVG has more than 16 MB")));
    }
    let mut work = Work::default();
    let text = text_of(bytes);
    let document = Document::read(&text, &mut work)?;
    let sheet = Sheet::read(&document.sheet, &mut work)?;
    Ok((walk(&document, &sheet, &mut work)?, work))
}

fn text_of(bytes: &[u8]) -> String {
    let wide = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        char::decode_utf16(units).map(|symbol| symbol.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => wide(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => String::from_utf8_lossy(rest).into_owned(),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    }
}
