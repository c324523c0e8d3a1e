//! The file: an SVG in millimetres with a layer for each pen.

use super::join::Polylines;
use super::order::Tour;
use super::page::Point;
use super::pen;
use crate::number::Decimals;
use crate::{FileOptions, Sink};
use core::fmt::Write;
use lsystem_syntax::{Halt, Work};

/// The lines of one pen.
pub(super) struct Layer {
    pub(super) rgb: [u8; 3],
    pub(super) tour: Tour,
    /// By place in the tour: the point at which a closed polyline starts; 0 for others.
    pub(super) starts: Vec<u32>,
}

impl Layer {
    /// Point `number` of the polyline at a place in the tour, as it is drawn.
    pub(super) fn point(&self, polylines: &Polylines, place: usize, number: usize) -> Point {
        let (polyline, is_flipped) = self.tour[place];
        let points = polylines.points_of(polyline as usize);
        let last = points.len() - 1;
        let at = match self.starts[place] as usize {
            0 => number,
            // The first point and the last one of a closed polyline are the same.
            start => (start + number) % last,
        };
        points[if is_flipped { last - at } else { at }]
    }
}

/// Writes the layers of a plot on a sheet of this size.
pub(super) fn write_layers(
    size: [f64; 2],
    pen: f64,
    layers: &[Layer],
    polylines: &Polylines,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<(), Halt> {
    let decimals = Decimals::for_size(1000.0);
    write_head(size, decimals, options, &mut sink.text);
    for (number, layer) in (1..).zip(layers) {
        let text = &mut sink.text;
        let [r, g, b] = layer.rgb;
        // Programs for plotters take the number of a layer from the start of its label. Writing to a `String` cannot fail.
        let _ = write!(
            text,
            "<g id=\"layer{number}\" inkscape:groupmode=\"layer\" inkscape:label=\"{number} {}\" fill=\"none\" \
             stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"",
            pen::name(layer.rgb)
        );
        decimals.write(text, pen);
        text.push_str("\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
        for (place, &(polyline, _)) in layer.tour.iter().enumerate() {
            for point in 0..polylines.points_of(polyline as usize).len() {
                sink.charge(4)?;
                let text = &mut sink.text;
                text.push_str(match point {
                    0 => "<path d=\"M",
                    1 => "L",
                    _ => " ",
                });
                let [x, y] = layer.point(polylines, place, point);
                decimals.write(text, x);
                text.push(' ');
                decimals.write(text, y);
            }
            sink.text.push_str("\"/>\n");
        }
        sink.text.push_str("</g>\n");
    }
    sink.text.push_str("</svg>\n");
    Ok(())
}

fn write_head(size: [f64; 2], decimals: Decimals, options: &FileOptions, text: &mut String) {
    text.push_str(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"",
    );
    for (name, side) in [("width", size[0]), ("height", size[1])] {
        // Writing to a `String` cannot fail.
        let _ = write!(text, " {name}=\"");
        decimals.write(text, side);
        text.push_str("mm\"");
    }
    text.push_str(" viewBox=\"0 0 ");
    decimals.write(text, size[0]);
    text.push(' ');
    decimals.write(text, size[1]);
    text.push_str("\">\n");
    for (tag, words) in [("title", &options.title), ("desc", &options.description)] {
        if !words.is_empty() {
            let _ = writeln!(text, "<{tag}>{}</{tag}>", crate::xml::escape(words));
        }
    }
    crate::embed::write_metadata(text, &options.system);
}
