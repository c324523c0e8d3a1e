//! `lsys find`: the rules of a string or a picture.

mod gallery;
mod picture;
mod pixels;

use crate::cli::Known;
use crate::{CommandFailure, input, print};
use lsystem::base::counted;
use lsystem::base::say;
use lsystem::base::words::said;
use lsystem::course::MAX_OUTPUT;
use lsystem::find::{Found, Search, Searched};
use lsystem::svg::is_svg;
use serde::Serialize;
use std::path::Path;
use std::time::{Duration, Instant};

/// The most symbols of all successors.
const MAX: usize = 60;
/// The symbols of work of all searches: 10 to 20 s on a laptop, as on the page.
const WORK: usize = 1 << 28;
/// The symbols of work before the first look at the clock, and between two.
const PIECE: usize = 1 << 16;
/// The steps that are tried where their number is not known.
const STEPS: [u32; 8] = [1, 2, 3, 4, 5, 6, 7, 8];
/// The most letters of a string that are tried as axioms where none is given.
const MAX_AXIOMS: usize = 8;
/// The most systems that are listed.
const MAX_LISTED: usize = 10;
/// The most words about what was searched.
const MAX_WORDS: usize = 36;

/// The result as JSON.
#[derive(Serialize)]
struct Answer<C> {
    candidates: Vec<C>,
    searched: String,
}

#[derive(Serialize)]
struct Candidate {
    axiom: String,
    n: u32,
    rules: Vec<String>,
    symbols: usize,
}

/// The beginning of a long text, and where the rest is.
fn short(searched: &str) -> String {
    let words: Vec<&str> = searched.split(' ').take(MAX_WORDS + 1).collect();
    match words.get(..MAX_WORDS) {
        Some(first) if words.len() > MAX_WORDS => say!("{} … (all of it: --json)", first.join(" ")),
        _ => searched.to_owned(),
    }
}

impl Known {
    /// The end of a search that begins now, by the clock.
    fn end(&self) -> Option<Instant> {
        self.seconds.map(|seconds| Instant::now() + Duration::from_secs(seconds.into()))
    }
}

/// Finds rules that derive the string in a file, or the string itself, or that draw the picture or the segments
/// in a file.
///
/// # Errors
/// [`CommandFailure::Said`] if none are found; [`CommandFailure::Words`] if the string cannot be searched.
pub(crate) fn find(wanted: &str, known: &Known, json: bool) -> Result<(), CommandFailure> {
    let path = Path::new(wanted);
    // Pipes are files, too.
    if wanted != "-" && (!path.exists() || path.is_dir()) {
        return find_string(wanted.trim(), known, json);
    }
    let bytes = input::output_of(path).map_err(|error| CommandFailure::io(wanted, &error))?;
    if pixels::is_picture(&bytes) {
        return picture::find(wanted, &bytes, known, json);
    }
    if let Some(kind) = pixels::other_kind(&bytes) {
        let words = say!("{}: {} pictures are not read: save this one as a PNG, a JPEG or an SVG", wanted, kind);
        return Err(CommandFailure::Words(words));
    }
    if is_svg(&bytes) {
        return picture::find_svg(wanted, &bytes, known, json);
    }
    let text = String::from_utf8(bytes);
    let text = text.map_err(|_| CommandFailure::Words(say!("{}: this is no text", wanted)))?;
    if text.len() > MAX_OUTPUT {
        let words = say!("{}: longer than {} MiB, which is not read", wanted, MAX_OUTPUT >> 20);
        return Err(CommandFailure::Words(words));
    }
    if let Some(segments) = picture::segments(wanted, &text)? {
        return picture::find_segments(wanted, &segments, known, json);
    }
    find_string(text.trim(), known, json)
}

/// Finds rules that derive a string.
fn find_string(text: &str, known: &Known, json: bool) -> Result<(), CommandFailure> {
    let axioms = known.axiom.clone().map_or_else(|| axioms(text, &known.constants), |axiom| vec![axiom]);
    if axioms.is_empty() {
        return Err(CommandFailure::Words(say!("a string with letters is expected, or --axiom")));
    }
    let steps = known.iterations.map_or(STEPS.to_vec(), |n| vec![n]);
    let (end, mut work, mut searches) = (known.end(), WORK, axioms.len() * steps.len());
    let (mut found, mut searched): (Vec<(&str, Found)>, Vec<String>) = (Vec::new(), Vec::new());
    for (axiom, &n) in axioms.iter().flat_map(|axiom| steps.iter().map(move |n| (axiom, n))) {
        let search = Search::new(axiom, text, n, &known.constants, MAX);
        let mut search = search.map_err(|why| CommandFailure::Words(said(why)))?;
        // All searches that are left share the work and the time that are left.
        let end = end.map(|end| {
            let now = Instant::now();
            now + end.saturating_duration_since(now) / searches as u32
        });
        let most = if end.is_some() { usize::MAX } else { work / searches };
        let mut spent = PIECE;
        while search.step(PIECE) == Searched::More
            && search.found().is_empty()
            && spent < most
            && !end.is_some_and(is_over)
        {
            spent += PIECE;
        }
        work = work.saturating_sub(spent);
        searches -= 1;
        found.extend(search.found().iter().map(|found| (axiom.as_str(), found.clone())));
        let from = if axioms.len() > 1 { format!("{axiom}, ") } else { String::new() };
        searched.push(format!("{from}{}", searched_words(n, &search.searched())));
    }
    found.sort_by_key(|(_, found)| found.symbols());
    found.truncate(MAX_LISTED);
    let searched = searched.join("; ");
    print(|out| match json {
        true => {
            let candidates = found.iter().map(|(axiom, one)| Candidate {
                axiom: (*axiom).to_owned(),
                n: one.n,
                rules: one.text().lines().map(str::to_owned).collect(),
                symbols: one.symbols(),
            });
            let answer = Answer { candidates: candidates.collect(), searched: searched.clone() };
            writeln!(out, "{}", serde_json::to_string_pretty(&answer)?)
        }
        false => {
            for (axiom, one) in &found {
                let told = counted!(
                    one.n,
                    "after {} step from {}; {} symbols",
                    "after {} steps from {}; {} symbols",
                    axiom,
                    one.symbols()
                );
                writeln!(out, "{}\n  {told}\n", one.text())?;
            }
            let none = if found.is_empty() { format!("{} ", say!("Nothing found.")) } else { String::new() };
            writeln!(out, "{none}{}", say!("Searched: {}.", short(&searched)))
        }
    })?;
    if found.is_empty() { Err(CommandFailure::Said) } else { Ok(()) }
}

/// Whether the time is over that a search may take.
fn is_over(end: Instant) -> bool {
    Instant::now() >= end
}

/// The letters of a string, each as an axiom.
fn axioms(text: &str, constants: &str) -> Vec<String> {
    let mut letters: Vec<char> = text.chars().filter(|at| at.is_alphabetic() && !constants.contains(*at)).collect();
    letters.sort_unstable();
    letters.dedup();
    letters.truncate(MAX_AXIOMS);
    letters.into_iter().map(String::from).collect()
}

/// Up to how many symbols everything was searched.
fn searched_words(n: u32, searched: &[usize]) -> String {
    let parts = searched.iter().zip(1..).map(|(most, letters)| match letters {
        1 => say!("one rule with up to {} symbols", most),
        _ => say!("{} rules with up to {} symbols", letters, most),
    });
    let parts: Vec<String> = parts.collect();
    format!("n = {n}: {}", if parts.is_empty() { say!("nothing") } else { parts.join(", ") })
}
