//! The way through the elements of a picture, in the order in which they are painted.

use crate::SvgError;
use crate::canvas::{Canvas, Polygons};
use crate::contour::Filled;
use crate::css::Sheet;
use crate::length::length;
use crate::outline::stroke;
use crate::shapes::{Line, Pencil};
use crate::style::{Style, note};
use crate::transform::Transform;
use crate::work::{Kind, Work};
use crate::xml::{Document, Element, MAX_DEPTH, too_deep};
use lsystem_base::word;
use std::rc::Rc;
use std::str::FromStr;
use svgtypes::{Align, AspectRatio, ViewBox};

/// The longer side of the drawn picture, in pixels.
const SIDE: usize = 1024;
/// The units of an element that waits.
const WAITING: u64 = 50;

/// What an element inherits.
struct Around {
    transform: Transform,
    style: Style,
    /// The size of the viewport in the user's coordinates.
    size: [f64; 2],
    depth: usize,
    /// The size that a reference gives to its target.
    given: [Option<f64>; 2],
    is_target: bool,
}

/// Draws the elements. Returns the names of what was left out, too.
pub(crate) fn drawn(
    document: &Document,
    sheet: &Sheet,
    work: &mut Work,
) -> Result<(Canvas, Vec<&'static str>), SvgError> {
    let (_, _, [width, height]) = page(document.element(0));
    let mut canvas = Canvas::new(width, height);
    let left_out = walk(document, sheet, work, &mut |element, around, work| draw(element, around, &mut canvas, work))?;
    Ok((canvas, left_out))
}

/// The polygons that are filled, in pixels with y downwards, and the names of what was left out. `None` if something has a
/// stroke only.
pub(crate) fn filled(document: &Document, sheet: &Sheet, work: &mut Work) -> Result<Option<Filled>, SvgError> {
    let (mut polygons, mut is_filled) = (Vec::new(), true);
    let left_out = walk(document, sheet, work, &mut |element, around, work| {
        let lines = lines_of(element, around, work)?;
        is_filled &= around.style.shades()[0].is_some() && element.name != "line" || lines.is_empty();
        polygons.extend(lines.iter().map(|line| line.points.iter().map(|&at| around.transform.of(at)).collect()));
        Ok(())
    })?;
    Ok(Some((polygons, left_out)).filter(|_| is_filled))
}

/// Calls `paint` with each shape. Returns the names of what was left out.
fn walk(
    document: &Document,
    sheet: &Sheet,
    work: &mut Work,
    paint: &mut dyn FnMut(&Element, &Around, &mut Work) -> Result<(), SvgError>,
) -> Result<Vec<&'static str>, SvgError> {
    let (first, size, _) = page(document.element(0));
    let mut left_out = Vec::new();
    let diagonal = libm::hypot(size[0], size[1]) / std::f64::consts::SQRT_2;
    let [x, y] = view_box(document.element(0)).map_or([0.0; 2], |view| [view.x, view.y]);
    let style = Style::new(diagonal, [x, y, size[0], size[1]]);
    let around = Around { transform: first, style, size, depth: 0, given: [None; 2], is_target: false };
    let mut waiting = vec![(0, Rc::new(around))];
    while let Some((at, around)) = waiting.pop() {
        let element = document.element(at);
        element.charge(work)?;
        if !is_drawn(element.name, around.is_target) {
            continue;
        }
        let style = around.style.of(element, (document, sheet), &mut left_out, work)?;
        if !style.is_displayed {
            continue;
        }
        let own = element.get("transform").and_then(Transform::read);
        let transform = own.map_or(around.transform, |own| around.transform.after(own));
        let mut inside =
            Around { transform, style, size: around.size, depth: around.depth + 1, given: [None; 2], is_target: false };
        if inside.depth > MAX_DEPTH {
            return Err(too_deep());
        }
        match element.name {
            "use" => {
                let name = element.get("href").unwrap_or_default().trim();
                let Some(target) = document.named(name) else {
                    if !name.is_empty() && !name.starts_with('#') {
                        note(&mut left_out, word!("other files"));
                    }
                    continue;
                };
                let [x, y] = corner(element, around.size);
                inside.transform = transform.after(Transform::moved(x, y));
                inside.given = sides(element, around.size);
                inside.is_target = true;
                inside.style.page = None;
                waiting.push((target, Rc::new(inside)));
            }
            "text" | "image" | "foreignObject" => {
                let names = [
                    ("text", word!("text")),
                    ("image", word!("images")),
                    ("foreignObject", word!("texts of web pages")),
                ];
                names.iter().filter(|(name, _)| *name == element.name).for_each(|(_, name)| note(&mut left_out, name));
            }
            "svg" | "symbol" | "g" | "a" | "switch" => {
                if at != 0 && matches!(element.name, "svg" | "symbol") {
                    enter(element, &around, &mut inside);
                }
                let inside = Rc::new(inside);
                let from = waiting.len();
                let mut children = document.children(at);
                let one = if element.name == "switch" {
                    children.by_ref().find(|&child| is_understood(document.element(child)))
                } else {
                    None
                };
                let all = children.take_while(|_| element.name != "switch");
                for child in one.into_iter().chain(all) {
                    work.charge(Kind::Elements, 1, WAITING)?;
                    waiting.push((child, inside.clone()));
                }
                waiting[from..].reverse();
            }
            _ => paint(element, &inside, work)?,
        }
    }
    Ok(left_out)
}

fn is_drawn(name: &str, is_target: bool) -> bool {
    match name {
        "symbol" => is_target,
        "" | "defs" | "linearGradient" | "radialGradient" | "stop" | "style" | "clipPath" | "mask" | "pattern"
        | "marker" | "filter" => false,
        _ => true,
    }
}

/// Whether an element of a `switch` is for us.
fn is_understood(element: &Element) -> bool {
    let speaks = |languages: &str| languages.split(',').any(|language| language.trim().starts_with("en"));
    is_drawn(element.name, false)
        && element.name != "foreignObject"
        && element.get("requiredExtensions").is_none()
        && element.get("systemLanguage").is_none_or(speaks)
}

/// The lines of a shape; none if the shape is neither filled nor stroked.
fn lines_of(element: &Element, around: &Around, work: &mut Work) -> Result<Vec<Line>, SvgError> {
    let mut pencil = Pencil::new(around.transform, work);
    if around.style.shades() != [None; 2] {
        pencil.shape(element, around.size)?;
    }
    Ok(pencil.lines())
}

fn draw(element: &Element, around: &Around, canvas: &mut Canvas, work: &mut Work) -> Result<(), SvgError> {
    let (shades, lines) = (around.style.shades(), lines_of(element, around, work)?);
    if let Some(shade) = shades[0].filter(|_| element.name != "line") {
        let mut polygons = Polygons::on(canvas);
        for line in &lines {
            polygons.add(&line.points, false, around.transform, work)?;
        }
        canvas.fill(&mut polygons, around.style.is_even_odd, shade, work)?;
    }
    match shades[1] {
        Some(shade) => stroke(&lines, &around.style.pen, around.transform, shade, canvas, work),
        None => Ok(()),
    }
}

/// The transform to pixels, the size in the user's coordinates and that in pixels. Only the ratio of the given size
/// counts.
fn page(root: &Element) -> (Transform, [f64; 2], [usize; 2]) {
    let side = SIDE as f64;
    let is_size = |size: &[f64; 2]| {
        let [width, height] = *size;
        width > 0.0 && height > 0.0 && width.max(height) < 1e9 && (width / height).max(height / width) < side
    };
    let view = view_box(root).filter(|view| is_size(&[view.w, view.h]));
    let given = ["width", "height"].map(|name| root.get(name).filter(|text| !text.contains('%')));
    let given = given.map(|text| text.and_then(|text| length(text, 0.0)).unwrap_or(0.0));
    let box_ = view.unwrap_or_else(|| {
        let [w, h] = Some(given).filter(is_size).unwrap_or([side; 2]);
        ViewBox { x: 0.0, y: 0.0, w, h }
    });
    let scale = side / box_.w.max(box_.h);
    let pixels = [box_.w, box_.h].map(|each| ((each * scale).round() as usize).max(1));
    let transform = Transform::new(scale, 0.0, 0.0, scale, -box_.x * scale, -box_.y * scale);
    (transform, [box_.w, box_.h], pixels)
}

/// Enters a nested picture, or a symbol that is the target of a reference.
fn enter(element: &Element, around: &Around, inside: &mut Around) {
    let [x, y] = corner(element, around.size);
    let own = sides(element, around.size);
    let size = [0, 1].map(|axis| around.given[axis].or(own[axis]).unwrap_or(around.size[axis]));
    inside.transform = inside.transform.after(Transform::moved(x, y));
    inside.style.page = None;
    inside.size = size;
    let Some(view) = view_box(element) else { return };
    let ratio = element.get("preserveAspectRatio").and_then(|text| AspectRatio::from_str(text).ok());
    let ratio = ratio.unwrap_or(AspectRatio { defer: false, align: Align::XMidYMid, slice: false });
    let (wide, high) = (size[0] / view.w, size[1] / view.h);
    let same = if ratio.slice { wide.max(high) } else { wide.min(high) };
    let [wide, high] = if ratio.align == Align::None { [wide, high] } else { [same; 2] };
    let part = match ratio.align {
        Align::None | Align::XMinYMin => [0.0, 0.0],
        Align::XMidYMin => [0.5, 0.0],
        Align::XMaxYMin => [1.0, 0.0],
        Align::XMinYMid => [0.0, 0.5],
        Align::XMidYMid => [0.5, 0.5],
        Align::XMaxYMid => [1.0, 0.5],
        Align::XMinYMax => [0.0, 1.0],
        Align::XMidYMax => [0.5, 1.0],
        Align::XMaxYMax => [1.0, 1.0],
    };
    let left = (size[0] - wide * view.w) * part[0] - view.x * wide;
    let top = (size[1] - high * view.h) * part[1] - view.y * high;
    inside.transform = inside.transform.after(Transform::new(wide, 0.0, 0.0, high, left, top));
    inside.size = [view.w, view.h];
}

fn view_box(element: &Element) -> Option<ViewBox> {
    ViewBox::from_str(element.get("viewBox")?).ok()
}

fn corner(element: &Element, size: [f64; 2]) -> [f64; 2] {
    [("x", size[0]), ("y", size[1])]
        .map(|(name, whole)| element.get(name).and_then(|text| length(text, whole)).unwrap_or(0.0))
}

fn sides(element: &Element, size: [f64; 2]) -> [Option<f64>; 2] {
    [("width", size[0]), ("height", size[1])]
        .map(|(name, whole)| element.get(name).and_then(|text| length(text, whole)).filter(|side| *side >= 0.0))
}
