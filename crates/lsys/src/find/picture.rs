//! The rules of a picture, searched with all cores.

use super::pixels::grey;
use super::{Answer, MAX_LISTED, gallery, is_over, short};
use crate::cli::Known;
use crate::{CommandFailure, cores, print, say};
use lsystem::base::counted;
use lsystem::base::words;
use lsystem::files::{SegmentForm, read_segments};
use lsystem::find::{Drawn, FOUND, Finder, Photograph, Picture, Question, Searched, Share, merged};
use lsystem::svg::draw_svg;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// The systems that are tried in one step.
const SHARE: u64 = 4096;
/// The most segments of a file.
const MAX_SEGMENTS: usize = 1_000_000;
/// Parts of an SVG that segments do not tell.
const OTHER: [&str; 11] = [
    "<use",
    "<symbol",
    "<style",
    "<clipPath",
    "<pattern",
    "<text",
    "<circle",
    "<ellipse",
    "<switch",
    "display:",
    "visibility",
];
/// The systems that all cores together have tried after the first round. Each further round tries as many systems as
/// all rounds before it.
const FIRST: u64 = 1 << 16;
/// The systems after which a search without a time ends: 2 to 20 s with two cores.
const MAX: u64 = 1 << 22;
/// The rounds after the one in which a system that is the same was found, for shorter ones; and after the one in which
/// a system that is nearly the same was found, for one that is the same.
const AFTER_SAME: u32 = 1;
const AFTER_NEAR: u32 = 3;
/// Systems whose ink agrees less are not listed.
const LEAST: f64 = 0.5;

#[derive(Serialize)]
struct Candidate {
    /// The name of a system of the gallery.
    #[serde(skip_serializing_if = "Option::is_none")]
    gallery: Option<String>,
    axiom: String,
    n: u32,
    angle: f64,
    heading: f64,
    rules: Vec<String>,
    draws: String,
    symbols: usize,
    agreement: f64,
    same: bool,
}

/// Finds the rules that draw a picture.
///
/// # Errors
/// [`CommandFailure::Said`] if none are found; [`CommandFailure::Words`] if the picture cannot be searched.
pub(super) fn find(name: &str, bytes: &[u8], known: &Known, json: bool) -> Result<(), CommandFailure> {
    let said = |why: &str| CommandFailure::Words(format!("{name}: {why}"));
    let (grey, width, height) = grey(bytes).map_err(|why| said(&why))?;
    // A photograph is made straight and even first.
    let picture = match Photograph::straightened(&grey, width, height) {
        Some(straight) => straight.picture(),
        None => Picture::new(&grey, width, height),
    };
    find_rules(name, picture.map_err(said)?, known, json)
}

/// Finds the rules that draw an SVG picture: by its exact segments, if it has nothing else, or by its pixels.
///
/// # Errors
/// As [`find`].
pub(super) fn find_svg(name: &str, bytes: &[u8], known: &Known, json: bool) -> Result<(), CommandFailure> {
    let text = str::from_utf8(bytes).unwrap_or_default();
    if !OTHER.iter().any(|other| text.contains(other))
        && let Ok(Some(segments)) = segments(name, text)
        && !segments.is_empty()
    {
        return find_segments(name, &segments, known, json);
    }
    let said = |why: &str| CommandFailure::Words(format!("{name}: {why}"));
    let drawn = draw_svg(bytes).map_err(|why| said(&why.message))?;
    if !drawn.left_out.is_empty() {
        say(&format!("{}\n", say!("note: {}: left out: {}", name, drawn.left_out.join(", "))));
    }
    let picture = Picture::new(&drawn.grey, drawn.width, drawn.height).map_err(said)?;
    find_rules(name, picture, known, json)
}

/// The segments of an SVG picture or a table, with the y axis upwards, if the text is one.
///
/// # Errors
/// [`CommandFailure::Words`] if a segment cannot be read.
pub(super) fn segments(name: &str, text: &str) -> Result<Option<Vec<[f64; 4]>>, CommandFailure> {
    let Some(read) = read_segments(text, MAX_SEGMENTS) else { return Ok(None) };
    let read = read.map_err(|error| {
        CommandFailure::Words(format!("{name}: {}", say!("line {}: {}", error.line, error.message)))
    })?;
    let up = if read.form == SegmentForm::Svg { -1.0 } else { 1.0 };
    Ok(Some(read.segments.iter().map(|[from, to]| [from[0], up * from[1], to[0], up * to[1]]).collect()))
}

/// Finds the rules that draw segments.
///
/// # Errors
/// As [`find`].
pub(super) fn find_segments(
    name: &str,
    segments: &[[f64; 4]],
    known: &Known,
    json: bool,
) -> Result<(), CommandFailure> {
    let picture = Picture::of_segments(segments).map_err(|why| CommandFailure::Words(format!("{name}: {why}")))?;
    find_rules(name, picture, known, json)
}

fn find_rules(name: &str, picture: Picture, known: &Known, json: bool) -> Result<(), CommandFailure> {
    let said = |why: &str| CommandFailure::Words(format!("{name}: {why}"));
    let picture = Arc::new(picture);
    let Known { axiom, angle, heading, iterations: n, draws, .. } = known;
    let question = Question { axiom: axiom.clone(), angle: *angle, heading: *heading, n: *n, draws: draws.clone() };
    let cores = cores::count() as u64;
    let parts = (0..cores).map(|part| Finder::new(&picture, &question, Share { index: part, count: cores }));
    let mut parts = parts.collect::<Result<Vec<_>, _>>().map_err(said)?;
    parts.iter_mut().for_each(|part| part.try_first(gallery::systems()));
    search(&mut parts, known.end());
    let (mut kept, searched) = merged(&parts.iter().collect::<Vec<_>>());
    let is_found = kept.first().is_some_and(|drawn| drawn.agreement >= FOUND);
    kept.retain(|one| one.agreement >= LEAST);
    kept.truncate(MAX_LISTED);
    print(|out| match json {
        true => {
            let candidates = kept.iter().map(|one| Candidate {
                gallery: one.named.as_ref().map(|named| named.name.clone()),
                axiom: one.axiom.clone(),
                n: one.found.n,
                angle: one.angle,
                heading: one.heading,
                rules: one.rules().lines().map(str::to_owned).collect(),
                draws: one.draws.clone(),
                symbols: one.symbols(),
                agreement: (one.agreement * 1e4).floor() / 1e4,
                same: one.is_same(),
            });
            let answer = Answer { candidates: candidates.collect(), searched: searched.clone() };
            writeln!(out, "{}", serde_json::to_string_pretty(&answer)?)
        }
        false => {
            match kept.iter().map(|one| one.agreement).reduce(f64::max) {
                None => {}
                Some(1.0..) => writeln!(out, "{}\n", say!("The same picture:"))?,
                Some(_) if is_found => writeln!(out, "{}\n", say!("Nearly the same picture:"))?,
                Some(_) => writeln!(out, "{}\n", say!("None draws this picture. The nearest:"))?,
            }
            for one in &kept {
                if let Some(named) = &one.named {
                    writeln!(out, "{}", say!("{}, in the gallery:", named.name))?;
                }
                let Drawn { axiom, found, draws, angle, heading, .. } = one;
                let (text, n, symbols) = (one.rules(), found.n, one.symbols());
                let how = counted!(
                    n,
                    "after {} step from {} with {}°, heading {}°; {} draws; {} symbols",
                    "after {} steps from {} with {}°, heading {}°; {} draws; {} symbols",
                    axiom,
                    angle,
                    heading,
                    draws,
                    symbols
                );
                let ink = words::shown(&format!("{:.1}", one.percent()));
                let ink = match one.agreement {
                    1.0.. => say!("{} % of the ink agrees", ink),
                    FOUND.. => say!("nearly the same: {} % of the ink agrees", ink),
                    _ => say!("not the same: {} % of the ink agrees", ink),
                };
                writeln!(out, "{text}\n  {how}; {ink}\n")?;
            }
            let none = if kept.is_empty() { format!("{} ", say!("Nothing found.")) } else { String::new() };
            writeln!(out, "{none}{}", say!("Searched: {}.", short(&searched)))
        }
    })?;
    if is_found { Ok(()) } else { Err(CommandFailure::Said) }
}

/// Searches until a system is found, and some rounds more for a better one. The finders have tried the same systems at
/// the end of a round, so that the result depends on the machine only if the reader's time runs out.
fn search(finders: &mut [Finder], end: Option<Instant>) {
    let (mut until, mut rounds) = (FIRST, None);
    loop {
        let (is_more, workers) = (AtomicBool::new(false), finders.len());
        let queue = Mutex::new(finders.iter_mut());
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        cores::side_by_side(workers, || {
            while let Some(finder) = next() {
                is_more.fetch_or(go_on(finder, until, end), Ordering::Relaxed);
            }
        });
        if !is_more.into_inner() || rounds == Some(0) || end.map_or(until >= MAX, is_over) {
            return;
        }
        let granted = match () {
            () if finders.iter().any(Finder::is_same) => Some(AFTER_SAME),
            () if finders.iter().any(Finder::is_found) => Some(AFTER_NEAR),
            () => None,
        };
        rounds = granted.map(|granted| rounds.map_or(granted, |left: u32| left.min(granted)) - 1);
        until *= 2;
    }
}

/// Searches to the end of a round, or to that of the time, but not before a family was begun. Returns whether there is
/// more to search.
fn go_on(finder: &mut Finder, until: u64, end: Option<Instant>) -> bool {
    loop {
        let is_begun = finder.tried() > 0;
        let is_over = || end.is_some_and(is_over);
        if finder.tried() >= until || is_begun && is_over() {
            return true;
        }
        if finder.step_until(SHARE, &|| is_begun && is_over()) == Searched::All {
            return false;
        }
    }
}
