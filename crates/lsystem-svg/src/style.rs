//! How an element is painted: its style, with what it inherits.

use crate::SvgError;
use crate::canvas::Shade;
use crate::css::{Sheet, declarations};
use crate::length::length;
use crate::work::{Kind, Work};
use crate::xml::{Document, Element};
use lsystem_base::word;
use std::rc::Rc;
use std::str::FromStr;
use svgtypes::{Color, LengthListParser, Paint, PaintFallback};

/// The most gradients that refer to another one.
const MAX_GRADIENTS: usize = 8;

/// The units of a declaration.
const DECLARATION: u64 = 100;

/// What the inside or the outline is painted with.
#[derive(Clone, Copy, Debug)]
enum Ink {
    None,
    /// The colour of the element itself.
    Current,
    Shade(Shade),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cap {
    Butt,
    Round,
    Square,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Join {
    Miter,
    Round,
    Bevel,
}

/// The pen of an outline, with lengths of the user's coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Pen {
    pub(crate) width: f64,
    pub(crate) cap: Cap,
    pub(crate) join: Join,
    pub(crate) miter: f64,
    pub(crate) dashes: Rc<[f64]>,
    pub(crate) offset: f64,
}

#[derive(Clone, Debug)]
pub(crate) struct Style {
    fill: Ink,
    stroke: Ink,
    pub(crate) is_even_odd: bool,
    pub(crate) pen: Pen,
    /// That of all groups around, too.
    pub(crate) opacity: f64,
    pub(crate) is_visible: bool,
    pub(crate) is_displayed: bool,
    fill_opacity: f64,
    stroke_opacity: f64,
    colour: Shade,
    /// The diagonal of the viewport, to which lengths in percent refer.
    pub(crate) diagonal: f64,
    /// The page: x, y, width and height, where the user's coordinates are those of the page.
    pub(crate) page: Option<[f64; 4]>,
}

const BLACK: Shade = Shade { level: 0.0, alpha: 1.0 };

impl Style {
    pub(crate) fn new(diagonal: f64, page: [f64; 4]) -> Self {
        Self {
            fill: Ink::Shade(BLACK),
            stroke: Ink::None,
            is_even_odd: false,
            pen: Pen { width: 1.0, cap: Cap::Butt, join: Join::Miter, miter: 4.0, dashes: Rc::new([]), offset: 0.0 },
            opacity: 1.0,
            is_visible: true,
            is_displayed: true,
            fill_opacity: 1.0,
            stroke_opacity: 1.0,
            colour: BLACK,
            diagonal,
            page: Some(page),
        }
    }

    /// The style of an element inside of one with this style. Names of effects that are not drawn are added.
    pub(crate) fn of(
        &self,
        element: &Element,
        files: (&Document, &Sheet),
        left_out: &mut Vec<&'static str>,
        work: &mut Work,
    ) -> Result<Self, SvgError> {
        let mut style = self.clone();
        let mut own_opacity = 1.0;
        style.page = self.page.filter(|_| element.get("transform").is_none());
        for (name, value) in declared(element, files.1, work)? {
            match name {
                "opacity" => own_opacity = part(value).unwrap_or(own_opacity),
                "clip-path" | "mask" | "filter" | "marker" | "marker-start" | "marker-mid" | "marker-end" => {
                    if value != "none" && !(name == "clip-path" && style.clips_nothing(value, files.0)) {
                        let names = [word!("clip paths"), word!("masks"), word!("filters"), word!("markers")];
                        let known = names.into_iter().find(|known| known.starts_with(&name[..4]));
                        note(left_out, known.unwrap_or(word!("effects")));
                    }
                }
                _ => style.set(name, value, files, left_out, work)?,
            }
        }
        style.opacity *= own_opacity;
        Ok(style)
    }

    /// Whether a clip path is a rectangle around the whole page, as LibreOffice writes it.
    fn clips_nothing(&self, value: &str, document: &Document) -> bool {
        let Ok(Paint::FuncIRI(name, _)) = Paint::from_str(value) else { return false };
        let (Some(page), Some(clip)) = (self.page, document.named(&format!("#{name}"))) else { return false };
        let mut children = document.children(clip);
        let (Some(only), None) = (children.next(), children.next()) else { return false };
        let [clip, only] = [clip, only].map(|at| document.element(at));
        let is_plain = |element: &Element| element.get("transform").is_none() && element.get("clip-path").is_none();
        let [x, y, width, height] =
            ["x", "y", "width", "height"].map(|name| only.get(name).and_then(|text| length(text, 0.0)).unwrap_or(0.0));
        let [left, top, wide, high] = page;
        let is_around = x <= left && y <= top && x + width >= left + wide && y + height >= top + high;
        clip.name == "clipPath" && only.name == "rect" && is_plain(clip) && is_plain(only) && is_around
    }

    /// How opaque the inside and the outline are, with their levels.
    pub(crate) fn shades(&self) -> [Option<Shade>; 2] {
        [(self.fill, self.fill_opacity), (self.stroke, self.stroke_opacity)].map(|(ink, opacity)| {
            let shade = match ink {
                Ink::None => return None,
                Ink::Current => self.colour,
                Ink::Shade(shade) => shade,
            };
            let alpha = shade.alpha * opacity * self.opacity;
            Some(Shade { alpha, ..shade }).filter(|_| alpha > 0.0 && self.is_visible)
        })
    }

    fn set(
        &mut self,
        name: &str,
        value: &str,
        files: (&Document, &Sheet),
        left_out: &mut Vec<&'static str>,
        work: &mut Work,
    ) -> Result<(), SvgError> {
        let size = |value: &str| length(value, self.diagonal).filter(|size| *size >= 0.0);
        match name {
            "fill" => self.fill = Self::paint(value, self.fill, files, left_out, work)?,
            "stroke" => self.stroke = Self::paint(value, self.stroke, files, left_out, work)?,
            "color" => self.colour = Color::from_str(value).map_or(self.colour, shade),
            "fill-opacity" => self.fill_opacity = part(value).unwrap_or(self.fill_opacity),
            "stroke-opacity" => self.stroke_opacity = part(value).unwrap_or(self.stroke_opacity),
            "stroke-width" => self.pen.width = size(value).unwrap_or(self.pen.width),
            "stroke-miterlimit" => self.pen.miter = value.parse().unwrap_or(self.pen.miter),
            "stroke-dashoffset" => self.pen.offset = length(value, self.diagonal).unwrap_or(self.pen.offset),
            "stroke-dasharray" => {
                let lengths = LengthListParser::from(value).map_while(Result::ok);
                let lengths = lengths.map(|each| crate::length::pixels(each, self.diagonal));
                let all: Vec<f64> = lengths.collect();
                let is_solid = all.iter().any(|each| *each < 0.0) || all.iter().sum::<f64>() <= 0.0;
                let all = if all.len() % 2 == 1 { all.repeat(2) } else { all };
                self.pen.dashes = if is_solid { Rc::new([]) } else { all.into() };
            }
            "stroke-linecap" => {
                self.pen.cap = match value {
                    "round" => Cap::Round,
                    "square" => Cap::Square,
                    "butt" => Cap::Butt,
                    _ => self.pen.cap,
                }
            }
            "stroke-linejoin" => {
                self.pen.join = match value {
                    "round" => Join::Round,
                    "bevel" => Join::Bevel,
                    "miter" | "miter-clip" | "arcs" => Join::Miter,
                    _ => self.pen.join,
                }
            }
            "fill-rule" if value != "inherit" => self.is_even_odd = value == "evenodd",
            "visibility" if value != "inherit" => self.is_visible = value == "visible",
            "display" => self.is_displayed = value != "none",
            _ => {}
        }
        Ok(())
    }

    fn paint(
        value: &str,
        inherited: Ink,
        (document, sheet): (&Document, &Sheet),
        left_out: &mut Vec<&'static str>,
        work: &mut Work,
    ) -> Result<Ink, SvgError> {
        let Ok(paint) = Paint::from_str(value) else { return Ok(inherited) };
        Ok(match paint {
            Paint::None => Ink::None,
            Paint::Inherit | Paint::ContextFill | Paint::ContextStroke => inherited,
            Paint::CurrentColor => Ink::Current,
            Paint::Color(colour) => Ink::Shade(shade(colour)),
            Paint::FuncIRI(name, fallback) => {
                let target = document.named(&format!("#{name}"));
                if target.is_some_and(|at| document.element(at).name == "pattern") {
                    note(left_out, word!("patterns"));
                }
                let first = target.map_or(Ok(None), |at| first_stop(at, document, sheet, work))?;
                match (first, fallback) {
                    (Some(shade), _) => Ink::Shade(shade),
                    (None, Some(PaintFallback::Color(colour))) => Ink::Shade(shade(colour)),
                    (None, Some(PaintFallback::CurrentColor)) => Ink::Current,
                    (None, Some(PaintFallback::None) | None) => Ink::None,
                }
            }
        })
    }
}

/// The colour at the beginning of a gradient.
fn first_stop(
    mut gradient: usize,
    document: &Document,
    sheet: &Sheet,
    work: &mut Work,
) -> Result<Option<Shade>, SvgError> {
    for _ in 0..MAX_GRADIENTS {
        for stop in document.children(gradient) {
            let element = document.element(stop);
            element.charge(work)?;
            if element.name == "stop" {
                let (mut colour, mut opacity) = (BLACK, 1.0);
                for (name, value) in declared(element, sheet, work)? {
                    match name {
                        "stop-color" => colour = Color::from_str(value).map_or(colour, shade),
                        "stop-opacity" => opacity = part(value).unwrap_or(opacity),
                        _ => {}
                    }
                }
                return Ok(Some(Shade { alpha: colour.alpha * opacity, ..colour }));
            }
        }
        let Some(next) = document.element(gradient).get("href").and_then(|name| document.named(name)) else { break };
        gradient = next;
    }
    Ok(None)
}

/// The attributes, the rules of sheets and the own style of an element, in the order in which they apply.
fn declared<'a>(element: &'a Element, sheet: &'a Sheet, work: &mut Work) -> Result<Vec<(&'a str, &'a str)>, SvgError> {
    let mut all: Vec<(&str, &str)> = element.attributes().collect();
    sheet.bodies(element, work)?.into_iter().for_each(|body| all.extend(declarations(body)));
    all.extend(declarations(element.get("style").unwrap_or_default()));
    work.charge(Kind::Styles, all.len(), DECLARATION)?;
    Ok(all)
}

/// A number from 0 to 1, or a percentage.
fn part(value: &str) -> Option<f64> {
    let (number, scale) = value.strip_suffix('%').map_or((value, 1.0), |number| (number, 0.01));
    let value: f64 = number.trim().parse().ok()?;
    Some((value * scale).clamp(0.0, 1.0)).filter(|value| !value.is_nan())
}

fn shade(Color { red, green, blue, alpha }: Color) -> Shade {
    let level = 0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue);
    Shade { level, alpha: f64::from(alpha) / 255.0 }
}

pub(crate) fn note(left_out: &mut Vec<&'static str>, name: &'static str) {
    if !left_out.contains(&name) {
        left_out.push(name);
    }
}
