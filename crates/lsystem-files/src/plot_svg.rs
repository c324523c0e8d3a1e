//! Plots as SVG in millimetres, with a layer for each pen.

use crate::number::Decimals;
use crate::{FileOptions, Sink, pen};
use core::fmt::Write;
use lsystem_drawing::Drawing;
use lsystem_plot::{Plot, PlotSummary};
use lsystem_syntax::{Halt, Style, Work};
use std::sync::Arc;

/// Writes a drawing for a pen plotter, on [`FileOptions::sheet`] with [`FileOptions::plot`]. There are at most
/// [`FileOptions::most`] strokes. The drawing is dropped when its strokes are known.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the plot has too many strokes, before the first byte.
pub fn write_plot(
    drawing: Arc<Drawing>,
    style: &Style,
    file: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<PlotSummary, Halt> {
    let plot = Plot::new(drawing, style, &file.sheet, file.plot, file.most, sink)?;
    let decimals = Decimals::for_size(1000.0);
    // At each path, since some programs do not look at the layer for it.
    let mut path = "<path stroke-width=\"".to_owned();
    decimals.write(&mut path, file.plot.bounded().pen);
    path.push_str("\" d=\"M");
    write_head(plot.summary.sheet, decimals, file, &mut sink.text);
    for (number, layer) in (1..).zip(&plot.layers) {
        let text = &mut sink.text;
        let [r, g, b] = layer.rgb;
        // Programs for plotters take the number of a layer from the start of its label, or the pen from its end. Writing
        // to a `String` cannot fail.
        let _ = writeln!(
            text,
            "<g id=\"layer{number}\" inkscape:groupmode=\"layer\" inkscape:label=\"{number} {}, pen {number}\" \
             fill=\"none\" stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">",
            pen::name(layer.rgb)
        );
        for polyline in plot.polylines_of(layer) {
            for (place, [x, y]) in polyline.enumerate() {
                sink.charge(4)?;
                let text = &mut sink.text;
                text.push_str(match place {
                    0 => &path,
                    1 => "L",
                    _ => " ",
                });
                decimals.write(text, x);
                text.push(' ');
                decimals.write(text, y);
            }
            sink.text.push_str("\"/>\n");
        }
        sink.text.push_str("</g>\n");
    }
    sink.text.push_str("</svg>\n");
    Ok(plot.summary)
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
