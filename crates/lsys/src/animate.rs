//! `lsys animate`: films as animated GIF, as numbered PNG pictures, or as frames for another program.

mod pool;
mod sink;

use crate::CommandFailure;
use crate::cli::{Changes, Dive, FilmFormat, FilmOptions};
use crate::input::{self, InputSystem};
use lsystem::base::fixed::Fixed;
use lsystem::base::{MAX_SEGMENT_DIGITS, say};
use lsystem::film::{Film, LIMITS, MAX_GIF_RATE, Script, dive_to, grow, turntable, turtle, wind, wind_strength};
use lsystem::render::opening_camera;
use lsystem::{Camera, Figure, Limits, Vantage};
use pool::Pool;
use std::path::Path;

/// The units of work between two looks at other workers.
const WORK: u64 = 1 << 20;

/// Makes a film of the system in `file`.
///
/// # Errors
/// Problems of the file, of the film's text, and of the output.
pub(crate) fn animate(file: &Path, to: &Path, options: &FilmOptions, changes: &Changes) -> Result<(), CommandFailure> {
    let input = input::read(file, changes, &mut crate::say)?;
    let limits = Limits { memory: changes.memory.unwrap_or(LIMITS.memory), ..LIMITS };
    let film = film(&input, options, limits)?;
    let format = options.format.unwrap_or_else(|| match to.to_str() {
        Some("-") => FilmFormat::Y4m,
        Some(name) if name.to_ascii_lowercase().ends_with(".gif") => FilmFormat::Gif,
        _ => FilmFormat::Png,
    });
    if format == FilmFormat::Gif && film.script().rate > MAX_GIF_RATE {
        let told = say!("A GIF has at most {} frames a second: the film is as long, with fewer frames", MAX_GIF_RATE);
        crate::say(&format!("{told}\n"));
    }
    let pool = Pool::new(&film, limits)?;
    match (format, to.as_os_str() == "-") {
        (FilmFormat::Gif, true) => sink::gif_to_stdout(&pool),
        (_, true) => sink::frames_to_stdout(&pool, format),
        (FilmFormat::Gif, false) => sink::gif_to_file(&pool, to),
        (FilmFormat::Png, false) => sink::pngs_to_folder(&pool, to),
        (_, false) => Err(words(say!("y4m and rgba are for standard output: give --to -"))),
    }
}

fn words(text: impl std::fmt::Display) -> CommandFailure {
    CommandFailure::Words(text.to_string())
}

/// The film of the options: its text, then the presets and the tracks, each in place of a track of the same subject.
fn film(input: &InputSystem, options: &FilmOptions, limits: Limits) -> Result<Film, CommandFailure> {
    let mut script = match &options.film {
        Some(text) => text_of(text)?.parse::<Script>().map_err(words)?,
        None => Script::default(),
    };
    let size = options.size.map_or(script.size, |size| [size.width, size.height]);
    let (seconds, rate) = (options.seconds.unwrap_or(script.seconds), options.fps.unwrap_or(script.rate));
    script.set(seconds, rate, size).map_err(words)?;
    script.ending = options.ending.unwrap_or(script.ending);
    script.easing = options.easing.unwrap_or(script.easing);
    let is_solid = input.system.is_solid();
    let draw = || Figure::draw(&input.system, input.iterations, &limits).map_err(|limit| input.limit(&limit));
    let camera = if is_solid { opening_camera(&draw()?) } else { Camera::default() };
    let vantage = Vantage { camera, ..Vantage::default() };
    let has_preset = options.turtle || options.turntable || options.sway || options.dive.is_some();
    let shows_growth = options.film.is_none() && !has_preset && options.track.is_empty();
    let mut tracks = Vec::new();
    if options.growth || shows_growth {
        tracks.push(grow(&script, input.iterations));
        script.fixed = true;
    }
    script.fixed &= !options.follow;
    if options.turtle {
        tracks.push(turtle(&script));
    }
    if options.turntable {
        if !is_solid {
            return Err(words(say!("--turntable is for drawings in space, and this drawing is in the plane")));
        }
        tracks.push(turntable(&script, &vantage.camera));
    }
    if options.sway {
        if !input.system.has_branches() {
            return Err(words(say!("--sway is for drawings with branches, and this drawing has none")));
        }
        tracks.push(wind(&script, wind_strength(&input.definition)));
    }
    if let Some(Dive(number)) = &options.dive {
        let figure = draw()?;
        let segments = figure.segment_count();
        let count = match &figure {
            Figure::Plane(drawing) => drawing.exact_count(),
            Figure::Space(_) => Fixed::read(&segments.to_string(), MAX_SEGMENT_DIGITS).unwrap_or_default(),
        };
        let place = number.clone().unwrap_or_else(|| count.minus(&Fixed::units(1)).shifted(-1));
        tracks.push(dive_to(&mut script, &figure, &place, &vantage).ok_or_else(|| {
            let number = place.plus(&Fixed::units(1)).decimal();
            words(format!("--dive={number}: the drawing has {} segments", count.decimal()))
        })?);
    }
    for track in tracks {
        script.tracks.retain(|other| other.subject != track.subject);
        script.tracks.push(track);
    }
    for track in &options.track {
        script.add(track).map_err(words)?;
    }
    Film::new(script, input.definition.clone(), vantage).map_err(words)
}

/// The text of a script: the text itself, or the text of a file.
fn text_of(text: &str) -> Result<String, CommandFailure> {
    let is_file = !text.contains(';') && Path::new(text).exists();
    if is_file { input::text_of(Path::new(text)) } else { Ok(text.to_owned()) }
}
