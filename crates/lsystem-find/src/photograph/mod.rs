//! Photographs of drawings, made into drawings: the page seen from above, in even light, with nothing but its lines.

mod directions;
mod light;
mod page;

use crate::brush::PIXELS;
use crate::parts::drawing;
use crate::picture::{Picture, threshold};
use crate::projection::Projection;
use light::Grey;
use lsystem_base::sorted;

/// The longer side of a photograph that is looked at; larger ones are made smaller.
const SIDE: usize = 2048;
/// Ink keeps its soft edge of this many pixels.
const EDGE: usize = 2;
/// Straightening looks at each pixel of what it gives this often: work that a search counts.
const PASSES: u64 = 32;
/// The paper around the ink, as a part of its longer side: more paper than ink.
const MARGIN: usize = 4;

/// A drawing that was seen in a photograph, dark on white.
#[derive(Clone, Debug)]
pub struct Photograph {
    /// The levels of grey, row by row from above.
    pub grey: Vec<u8>,
    /// In pixels.
    pub width: usize,
    /// In pixels.
    pub height: usize,
}

impl Photograph {
    /// The picture of the drawing. Strokes are laid on it by a small projection, since straightening leaves a small error.
    ///
    /// # Errors
    /// Why no lines are seen.
    pub fn picture(&self) -> Result<Picture, &'static str> {
        Ok(Picture::new(&self.grey, self.width, self.height)?.straightened(self.grey.len() as u64 * PASSES / PIXELS))
    }

    /// Straightens a photograph of `width` times `height` levels of grey: the page is found, or the tilt is told by the
    /// lines themselves. `None` if it is a picture without grain and shadow, or if no lines are seen.
    #[must_use]
    pub fn straightened(grey: &[u8], width: usize, height: usize) -> Option<Self> {
        if width == 0 || height == 0 || grey.len() != width * height || is_drawn(grey) {
            return None;
        }
        let whole = Grey { levels: grey.to_vec(), width, height };
        let by = width.max(height).div_ceil(SIDE);
        let whole = if by > 1 { whole.smaller(by) } else { whole };
        let page = page::straightened(&whole);
        let ink = inked(page.as_ref().unwrap_or(&whole))?;
        // A page lies straight by its own sides, more exactly than by the lines on it.
        let view = if page.is_some() { None } else { directions::view(&ink) };
        let drawn = framed(&ink, view.unwrap_or(Projection::NONE).inverse())?;
        Some(Self { grey: drawn.levels, width: drawn.width, height: drawn.height })
    }
}

/// Whether two levels, of the paper and of the ink, are those of half of the pixels. A photograph has grain.
fn is_drawn(grey: &[u8]) -> bool {
    let mut counts = [0_usize; 256];
    grey.iter().for_each(|&level| counts[usize::from(level)] += 1);
    sorted::sort(&mut counts);
    (counts[254] + counts[255]) * 2 >= grey.len()
}

/// The ink of a photograph in even light, dark on white, without what is no part of the drawing.
fn inked(grey: &Grey) -> Option<Grey> {
    let grey = if light::is_light_on_dark(grey) { grey.clone().inverted() } else { grey.clone() };
    let mut even = light::evened(&grey);
    let level = threshold(&even.levels);
    let runs = drawing(even.width, even.height, true, |x, y| even.levels[y * even.width + x] <= level)?;
    let mut kept = vec![false; even.levels.len()];
    for run in runs {
        let (left, right) = ((run.left as usize).saturating_sub(EDGE), (run.right as usize + EDGE).min(even.width));
        let y = run.y as usize;
        for y in y.saturating_sub(EDGE)..(y + EDGE + 1).min(even.height) {
            kept[y * even.width + left..y * even.width + right].fill(true);
        }
    }
    // Where the threshold divides them, ink and paper are as far apart everywhere.
    let stretched =
        |value: u8| (f64::from(value) - f64::from(level)) * 128.0 / (255.0 - f64::from(level)).max(1.0) + 127.0;
    let full =
        |(value, kept): (&mut u8, bool)| *value = if kept { stretched(*value).clamp(0.0, 255.0) as u8 } else { 255 };
    even.levels.iter_mut().zip(kept).for_each(full);
    even.levels.iter().any(|&value| value < 128).then_some(even)
}

/// The ink in another view, with paper around it.
fn framed(ink: &Grey, from: Projection) -> Option<Grey> {
    let to = from.inverse();
    let places = (0..ink.levels.len()).filter(|&at| ink.levels[at] < 128);
    let [mut left, mut top, mut right, mut bottom] =
        [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for at in places {
        let [x, y] = to.place([(at % ink.width) as f64 + 0.5, (at / ink.width) as f64 + 0.5]);
        (left, right) = (left.min(x), right.max(x));
        (top, bottom) = (top.min(y), bottom.max(y));
    }
    let longer = (right - left).max(bottom - top);
    if !(longer > 1.0 && longer < 4.0 * SIDE as f64) {
        return None;
    }
    let scale = (SIDE as f64 / longer).min(1.0);
    let margin = longer / MARGIN as f64;
    let side = |low: f64, high: f64| ((high - low + 2.0 * margin) * scale) as usize + 1;
    let corner = Projection::moved(left - margin, top - margin).after(Projection::scaled(1.0 / scale, 1.0 / scale));
    Some(page::seen(ink, from.after(corner), [side(left, right), side(top, bottom)]))
}
