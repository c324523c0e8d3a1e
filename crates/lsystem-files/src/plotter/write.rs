//! The file: an SVG in millimetres with a layer for each pen.

use super::join::Polylines;
use super::order::Tour;
use super::page::Point;
use super::pen;
use crate::FileOptions;
use crate::number::Decimals;
use core::fmt::Write;
use lsystem_syntax::{Meter, Progress};

/// Writes the layers of a plot in steps.
#[derive(Clone, Debug)]
pub(super) struct Writing {
    decimals: Decimals,
    pen: f64,
    layers: Vec<Layer>,
    /// The layer and the polyline that are written next, and its points written so far.
    layer: usize,
    polyline: usize,
    points: usize,
    head: String,
}

/// The lines of one pen.
#[derive(Clone, Debug)]
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

impl Writing {
    pub(super) fn new(size: [f64; 2], pen: f64, layers: Vec<Layer>, options: &FileOptions) -> Self {
        let decimals = Decimals::for_size(1000.0);
        let mut head = String::from(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"",
        );
        for (name, side) in [("width", size[0]), ("height", size[1])] {
            // Writing to a `String` cannot fail.
            let _ = write!(head, " {name}=\"");
            decimals.write(&mut head, side);
            head.push_str("mm\"");
        }
        head.push_str(" viewBox=\"0 0 ");
        decimals.write(&mut head, size[0]);
        head.push(' ');
        decimals.write(&mut head, size[1]);
        head.push_str("\">\n");
        for (tag, words) in [("title", &options.title), ("desc", &options.description)] {
            if !words.is_empty() {
                let _ = writeln!(head, "<{tag}>{}</{tag}>", crate::xml::escape(words));
            }
        }
        crate::embed::write_metadata(&mut head, &options.system);
        Self { decimals, pen, layers, layer: 0, polyline: 0, points: 0, head }
    }

    /// Appends to the file until the meter is spent.
    pub(super) fn step(&mut self, polylines: &Polylines, text: &mut String, meter: &mut Meter) -> Progress {
        text.push_str(&core::mem::take(&mut self.head));
        while !meter.is_spent() {
            meter.charge(4);
            let Some(layer) = self.layers.get(self.layer) else {
                text.push_str("</svg>\n");
                return Progress::Done;
            };
            if self.polyline == 0 && self.points == 0 {
                self.open(layer, text);
            }
            let Some(&(number, _)) = layer.tour.get(self.polyline) else {
                text.push_str("</g>\n");
                (self.layer, self.polyline) = (self.layer + 1, 0);
                continue;
            };
            let count = polylines.points_of(number as usize).len();
            if self.points == count {
                text.push_str("\"/>\n");
                (self.polyline, self.points) = (self.polyline + 1, 0);
                continue;
            }
            text.push_str(match self.points {
                0 => "<path d=\"M",
                1 => "L",
                _ => " ",
            });
            let [x, y] = layer.point(polylines, self.polyline, self.points);
            self.decimals.write(text, x);
            text.push(' ');
            self.decimals.write(text, y);
            self.points += 1;
        }
        Progress::More
    }

    /// Opens a layer. Programs for plotters take its number from the start of its label.
    fn open(&self, layer: &Layer, text: &mut String) {
        let number = self.layer + 1;
        let [r, g, b] = layer.rgb;
        // Writing to a `String` cannot fail.
        let _ = write!(
            text,
            "<g id=\"layer{number}\" inkscape:groupmode=\"layer\" inkscape:label=\"{number} {}\" fill=\"none\" \
             stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"",
            pen::name(layer.rgb)
        );
        self.decimals.write(text, self.pen);
        text.push_str("\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
    }
}
