//! Films: random scripts and the usual tracks over random systems.

use crate::gauge::WORK;
use crate::{Gauge, Source, make};
use lsystem::film::{
    Easing, Ending, Film, Frame, GifWriter, Painter, PaletteMaker, Script, Subject, Track, dive, dive_in_space, grow,
    turntable, turtle, vantage_of_segment, wind,
};
use lsystem::render::Detail;
use lsystem::{Camera, Definition, Vantage};

/// The most frames of a GIF in this target.
const GIF: u32 = 4;

/// Scripts, their frames, and the pixels of some frames.
pub(super) fn films(source: &mut Source<'_>, gauge: &mut Gauge) {
    let definition = make::definition(source);
    let Some(script) = script(source, gauge) else { return };
    read_back(&script);
    frames_are_told(&script);
    let vantage = if source.once_in(3) {
        Vantage { view: make::view(source), camera: make::camera(source) }
    } else {
        Vantage::default()
    };
    let Ok(film) = gauge.call("film", || Film::new(script, definition.clone(), vantage)) else { return };
    gauge.reach("film");
    let detail = source.pick(&[Detail::Fine, Detail::Coarse]);
    let size = [source.between(16, 64) as u32, source.between(16, 64) as u32];
    let mut painter = Painter::new(make::limits(source));
    let last = film.frames() - 1;
    let middle = source.below(film.frames() as usize) as u32;
    let painted = [0, middle, last].map(|number| {
        let frame = gauge.call("frame", || film.frame(number));
        let problems = frame.definition.out_of_range();
        let known = definition.out_of_range();
        assert!(problems.iter().all(|problem| known.contains(problem)), "values of frame {number}: {problems:?}");
        paint(&mut painter, &frame, size, detail, gauge)
    });
    let again = paint(&mut painter, &film.frame(middle), size, detail, gauge);
    assert!(again == painted[1], "frame {middle} differs after frame {last}");
    let mut fresh = Painter::new(painter.limits());
    let fresh = paint(&mut fresh, &film.frame(middle), size, detail, gauge);
    assert!(fresh == painted[1], "frame {middle} differs for another painter");
    if film.frames() <= GIF {
        gif(&film, &mut painter, size, gauge);
    }
    presets(source, &film, &painter, gauge);
}

/// A script: of parts that are mostly right.
fn script(source: &mut Source<'_>, gauge: &mut Gauge) -> Option<Script> {
    let mut parts = vec!["1".to_owned()];
    if source.once_in(2) {
        parts.push(format!("{}s", source.pick(&["0.04", "1", "2.5", "10", "3600", "0.1", "-1", "1e3"])));
        parts.push(format!("{}fps", source.pick(&["1", "25", "60", "7", "0"])));
    }
    if source.once_in(4) {
        parts.push(source.pick(&["640x360", "16x16", "4096x2048", "4096x4096", "1x1"]).to_owned());
    }
    parts.push(source.pick(&Ending::NAMES).to_owned());
    if source.once_in(4) {
        parts.push(format!("ease={}", source.pick(&Easing::NAMES)));
    }
    for _ in 0..source.pick(&[1, 1, 2, 3, 6]) {
        parts.push(track(source));
    }
    let mut text = parts.join(";");
    if source.once_in(12) {
        let at = source.below(text.len());
        text.replace_range(at..=at, source.pick(&["", "/", ":", ";", "~", ",", "1e999", "ä"]));
    }
    source.show(format_args!("{text}"));
    match gauge.call("script", || text.parse::<Script>()) {
        Ok(script) => Some(script),
        Err(error) => {
            assert!(text.get(error.span.clone()).is_some() && !error.to_string().is_empty(), "{error:?}");
            None
        }
    }
}

/// A track as text.
fn track(source: &mut Source<'_>) -> String {
    let names: Vec<&str> = Subject::names().collect();
    let name = match source.below(8) {
        0 | 1 => "n",
        2 => "drawn",
        3 => "view",
        4 => "camera",
        5 => source.pick(&["rules.r", "angle", "seed", "growth"]),
        _ => source.pick(&names),
    };
    let mut time = 0.0;
    let keys: Vec<String> = (0..source.pick(&[1, 2, 2, 3, 10]))
        .map(|_| {
            let count = match name {
                "view" => source.pick(&[3, 3, 5]),
                "camera" => source.between(1, 7),
                "tropism" => 3,
                "start" | "sway" => 2,
                _ => 1,
            };
            let value: Vec<String> = (0..count).map(|_| number(source, name)).collect();
            let easing = if source.once_in(4) { format!("~{}", source.pick(&Easing::NAMES)) } else { String::new() };
            let key = format!("{time}:{}{easing}", value.join("/"));
            time += source.pick(&[0.5, 1.0, 0.001, 3.0]);
            key
        })
        .collect();
    format!("{name}={}", keys.join(","))
}

/// A number for a key of this subject.
fn number(source: &mut Source<'_>, name: &str) -> String {
    match (source.below(8), name) {
        (0, _) => format!("{}", source.number()),
        (_, "n") => source.pick(&["0", "1", "2.5", "4", "7", "0.01", "3.999"]).to_owned(),
        (_, "view" | "camera") => source.pick(&["0", "1", "0.5", "-0.2", "30", "1e19"]).to_owned(),
        _ => source.pick(&["0", "1", "0.5", "2", "90", "0.01", "7"]).to_owned(),
    }
}

/// Checks that a written script reads back as the same.
fn read_back(script: &Script) {
    let text = script.to_string();
    let read = text.parse::<Script>();
    assert_eq!(read.as_ref(), Ok(script), "{text}");
}

/// Checks that the frames fill the time of the script.
fn frames_are_told(script: &Script) {
    let frames = script.frames();
    let forward = (libm::round(script.seconds * f64::from(script.rate)) as u32).max(1);
    let told = if script.ending == Ending::Bounce { (2 * forward).saturating_sub(2).max(1) } else { forward };
    assert_eq!(frames, told);
    let times = [0, frames / 2, frames - 1, frames, u32::MAX].map(|frame| script.time_of(frame));
    assert!(times.iter().all(|time| (0.0..=script.seconds).contains(time)), "{times:?}");
    if frames <= 10_000 {
        let shown: u64 = (0..frames).map(|frame| u64::from(script.delay_of(frame))).sum();
        let exact = 100.0 * f64::from(frames) / f64::from(script.rate);
        assert!((shown as f64 - exact).abs() <= 1.0, "{shown} hundredths for {frames} frames");
    }
}

/// The pixels of a frame, or the words of its problem.
fn paint(
    painter: &mut Painter,
    frame: &Frame,
    size: [u32; 2],
    detail: Detail,
    gauge: &mut Gauge,
) -> Result<Vec<u8>, String> {
    let words = |problem: lsystem::Diagnostic| problem.message;
    gauge.call("begin", || painter.begin(frame, size, detail)).map_err(words)?;
    let mut problem = None;
    let step = |painter: &mut Painter, work: usize| {
        painter.step(work as u64).unwrap_or_else(|error| {
            problem = Some(words(error));
            lsystem::Progress::Done
        })
    };
    gauge.steps("frame", WORK, painter, step, Painter::spent);
    if let Some(problem) = problem {
        gauge.reach("refused");
        return Err(problem);
    }
    gauge.reach("painted");
    assert_eq!(painter.pixels().len(), 4 * (size[0] * size[1]) as usize);
    Ok(painter.pixels().to_vec())
}

/// Writes a short film as GIF, and checks that the file has all frames.
fn gif(film: &Film, painter: &mut Painter, size: [u32; 2], gauge: &mut Gauge) {
    let mut frames = vec![];
    let mut maker = PaletteMaker::default();
    for number in 0..film.frames() {
        let Ok(pixels) = paint(painter, &film.frame(number), size, Detail::Coarse, gauge) else { return };
        maker.add(&pixels);
        frames.push(pixels);
    }
    let palette = maker.finish();
    let mut writer = GifWriter::new(size, film.script().ending, palette.clone()).expect("a small size");
    let mut file = vec![];
    for (pixels, number) in frames.iter().zip(0..) {
        writer.add(&palette.index(pixels), film.script().delay_of(number)).expect("frames of the same size");
        file.append(&mut writer.take());
    }
    file.append(&mut writer.finish().expect("memory"));
    let mut decoder = gif::DecodeOptions::new().read_info(&file[..]).expect("a GIF");
    let mut count = 0;
    while decoder.read_next_frame().expect("a frame").is_some() {
        count += 1;
    }
    let shown = (0..film.frames()).filter(|&number| film.script().delay_of(number) > 0);
    assert_eq!(count, shown.count(), "the frames of the GIF");
    gauge.reach("gif");
}

/// The usual tracks of a film are tracks of a script.
fn presets(source: &mut Source<'_>, film: &Film, painter: &Painter, gauge: &mut Gauge) {
    let script = Script { tracks: vec![], ..film.script().clone() };
    let number = |source: &mut Source<'_>, count: u128| match source.below(3) {
        0 => count / 2,
        1 => count,
        _ => u128::from(source.word()),
    };
    let Definition { iterations, .. } = film.frame(0).definition;
    let mut tracks: Vec<Track> = vec![grow(&script, iterations), turtle(&script), wind(&script, 3.0)];
    if let Some(figure) = painter.figure() {
        let number = number(source, figure.segment_count());
        let to = gauge.call("vantage_of_segment", || vantage_of_segment(figure, number, &Vantage::default()));
        tracks.extend(match (to, figure.is_solid()) {
            (Some(to), false) => Some(dive(&script, to.view)),
            (None, false) => None,
            (Some(to), true) => Some(dive_in_space(&script, &to.camera)),
            (None, true) => Some(turntable(&script, &Camera::default())),
        });
    }
    // A film may be too short for the times of a preset.
    if script.seconds >= 1.0 {
        read_back(&Script { tracks, ..script });
        gauge.reach("presets");
    }
}
