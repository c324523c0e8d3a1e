//! Other files that stand in one text with a file of cpfg, each below a line with its name, as `tail` and `head` print
//! several files:
//!
//! ```text
//! ==> plant.v <==
//! surface: l leaf.s 2
//! ==> leaf.s <==
//! ...
//! ```

use super::Places;
use super::function_file::read_functions;
use super::surface_file::read_surface;
use crate::draft::Draft;
use lsystem_base::{MAX_SURFACES, MAX_SURFACES_TEXT, say};
use lsystem_syntax::{Curve, Surface, print_surfaces};

/// The most functions of a text.
const MAX_FUNCTIONS: usize = 100;

/// A file in a text.
#[derive(Clone, Copy)]
pub(super) struct Part<'c> {
    /// The name; empty if no line has it.
    pub(super) name: &'c str,
    pub(super) text: &'c str,
}

/// The files of a text, in order.
pub(super) fn parts(text: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let (mut name, mut start, mut at) = ("", 0, 0);
    for line in text.split_inclusive('\n') {
        let inside = line.trim().strip_prefix("==>").and_then(|rest| rest.strip_suffix("<=="));
        if let Some(next) = inside {
            parts.push(Part { name, text: &text[start..at] });
            (name, start) = (next.trim(), at + line.len());
        }
        at += line.len();
    }
    parts.push(Part { name, text: &text[start..] });
    parts
}

/// Reads the surfaces that lines such as `surface: l leaf.s 2` name, into the definition. Returns the names that cpfg
/// has for them, with those that the definition has.
pub(super) fn read_surfaces(text: &str, places: &Places<'_>, draft: &mut Draft<'_>) -> Vec<(char, char)> {
    let parts = parts(text);
    let (mut names, mut surfaces): (Vec<(char, char)>, Vec<Surface>) = (Vec::new(), Vec::new());
    let lines = text.lines().map(str::trim).filter_map(|line| Some((line, value(line, "surface")?)));
    // More lines are not looked at, so that the work stays in proportion to the text.
    for (tried, (line, words)) in lines.enumerate() {
        let place = places.of(line);
        draft.covers(place.clone());
        if tried >= MAX_SURFACES {
            draft.note_at(place, say!("At most {} surfaces are read", MAX_SURFACES));
            break;
        }
        let mut words = words.split_whitespace();
        let (symbol, file, scale) = (words.next().unwrap_or_default(), words.next(), words.next().unwrap_or("1"));
        let (Some(symbol), Some(file), Ok(scale)) = (symbol.chars().next(), file, scale.parse::<f64>()) else {
            draft.note_at(place, say!("This surface is not read: a symbol, a file and a scale are expected"));
            continue;
        };
        let Some(part) = parts.iter().find(|part| is_same_file(part.name, file)) else {
            draft.note_at(place, say!("The file `{}` is missing; give it together with this one", file));
            continue;
        };
        let Some(patches) = read_surface(part.text, scale) else {
            draft.note_at(place, say!("The file `{}` is no surface that can be read", file));
            continue;
        };
        if names.iter().any(|(known, _)| *known == symbol) {
            draft.note_at(place, say!("The symbol of this surface stands twice; the first is taken"));
            continue;
        }
        let is_free = |c: &char| surfaces.iter().all(|surface| surface.name != *c);
        let name = Some(symbol).filter(|c| c.is_alphabetic()).filter(is_free);
        let Some(name) = name.or_else(|| ('a'..='z').chain('A'..='Z').find(is_free)) else { continue };
        surfaces.push(Surface { name, patches });
        if print_surfaces(&surfaces).len() > MAX_SURFACES_TEXT {
            surfaces.pop();
            draft.note_at(place, say!("The surfaces have too many patches; this one is left out"));
            continue;
        }
        names.push((symbol, name));
        draft.read(place, say!("the surface {}", name));
        let place = places.of(part.text);
        draft.covers(place.clone());
        draft.read(place, say!("the surface {}", name));
    }
    draft.definition.surfaces = print_surfaces(&surfaces);
    names
}

/// A function of one variable that the files name.
pub(super) struct NamedFunction<'c> {
    /// The name of the file or in a set, without its ending.
    pub(super) name: &'c str,
    /// The curve; `None` if it is missing or cannot be read.
    pub(super) curve: Option<Curve>,
}

/// The functions of lines such as `function: taper.func 100`, in their order; without such lines, those of a set.
pub(super) fn read_curves<'c>(text: &'c str, places: &Places<'c>, draft: &mut Draft<'_>) -> Vec<NamedFunction<'c>> {
    let parts = parts(text);
    let mut functions: Vec<NamedFunction<'_>> = Vec::new();
    for (line, words) in text.lines().map(str::trim).filter_map(|line| Some((line, value(line, "function")?))) {
        let place = places.of(line);
        draft.covers(place.clone());
        let file = words.split_whitespace().next().unwrap_or_default();
        let name = file.rsplit(['/', '\\']).next().unwrap_or_default().trim_end_matches(".func");
        let part = parts.iter().find(|part| is_same_file(part.name, file)).filter(|_| functions.len() < MAX_FUNCTIONS);
        let curve = part.and_then(|part| read_functions(part.text).into_iter().next()?.1);
        match (part, &curve) {
            (None, _) => draft.note_at(place, say!("The file `{}` is missing; give it together with this one", file)),
            (_, None) => draft.note_at(place, say!("The file `{}` is no function that can be read", file)),
            (Some(part), Some(_)) => {
                for place in [place, places.of(part.text)] {
                    draft.covers(place.clone());
                    draft.read(place, say!("the curve {}", name));
                }
            }
        }
        functions.push(NamedFunction { name, curve });
    }
    let set = parts.iter().find(|part| part.text.trim_start().starts_with("funcgalleryver"));
    if let Some(set) = set.filter(|_| functions.is_empty()) {
        let place = places.of(set.text);
        draft.covers(place.clone());
        draft.read(place, say!("a set of curves"));
        let read = read_functions(set.text).into_iter().take(MAX_FUNCTIONS);
        functions.extend(read.map(|(name, curve)| NamedFunction { name, curve }));
    }
    functions
}

/// The angle of turns, in degrees, by the line `angle increment` of a view file, or `angle factor`, a part of a circle.
pub(super) fn read_angle(text: &str, places: &Places<'_>, draft: &mut Draft<'_>) -> Option<f64> {
    let degrees = |line| {
        let number =
            |words: &str| words.trim().parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0);
        let factor = value(line, "angle factor").and_then(number).map(|factor| 360.0 / factor);
        Some((line, factor.or_else(|| value(line, "angle increment").and_then(number))?))
    };
    let (line, degrees) = text.lines().map(str::trim).find_map(degrees)?;
    let place = places.of(line);
    draft.covers(place.clone());
    draft.read(place, say!("angle {}", degrees));
    Some(degrees)
}

/// The text behind a keyword and its colon.
fn value<'c>(line: &'c str, keyword: &str) -> Option<&'c str> {
    let (word, rest) = line.split_once(':')?;
    word.trim().eq_ignore_ascii_case(keyword).then_some(rest)
}

/// Whether a path names a file: by the name behind its folders.
fn is_same_file(path: &str, file: &str) -> bool {
    let last = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
    !path.is_empty() && last(path) == last(file)
}
