//! Every segment, in drawing order.

use super::paths::{Ink, Paths};
use super::{Decimals, Sheet, Svg, SvgOptions};
use crate::{Diagnostic, Drawing, Mark, Style};

pub(super) fn write(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<Svg, Diagnostic> {
    drawing.check_segments(options.most)?;
    let [x, y] = drawing.start;
    let [x0, y0, x1, y1] = drawing.bounds().unwrap_or([x, y, x, y]).map(within);
    let margin = drawing.step.abs();
    let (width, height) = (x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin);
    let longer = width.max(height);
    let pixel = longer / options.size;
    let mut text = Sheet { x: x0 - margin, y: -y1 - margin, width, height, pixel }.open(style, options, "");

    let mut paths = Paths::new(&mut text, Decimals::for_size(longer), None);
    let down = |[x, y]: [f64; 2]| [within(x), within(-y)];
    for mark in drawing.marks() {
        match mark {
            Mark::Segment(segment, tint) => {
                let ink = Ink::new(style, tint, segment.width, pixel);
                paths.stroke(down(segment.from), down(segment.to), ink);
            }
            Mark::Polygon(vertices, tint) => paths.fill(vertices.into_iter().map(down), style.colour_of(tint).rgb),
        }
    }
    paths.close();
    text.push_str("</g>\n</svg>\n");
    Ok(Svg { text, instances: 0, ink: style.ink })
}

/// Keeps what is beyond any picture within the numbers, sums of two included.
fn within(coordinate: f64) -> f64 {
    coordinate.clamp(-1e300, 1e300)
}
