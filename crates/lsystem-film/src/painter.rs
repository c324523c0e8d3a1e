//! From frames to pixels.

use crate::Frame;
use lsystem_base::{Limits, Progress};
use lsystem_drawing::{Figure, FigureDrawer, System};
use lsystem_render::{Closeup, Detail, FigureRenderer, Framing, Painted, PictureOptions, Quality, Vantage, Viewport};
use lsystem_syntax::{Definition, Diagnostic};

/// The limits of the drawings of a film: those of the page. They decide which drawings are made, so that they are the
/// same wherever frames must be.
pub const LIMITS: Limits = Limits::PAGE;

/// The length of the longer side, in pixels, at which a stroke's least width is in pixels. Larger pictures scale it.
const USUAL: f64 = 1024.0;

/// A system that can be drawn, and its number of derivation steps.
type Subject = (System, u32);

/// Whether two systems have the same drawing.
fn is_same_drawing((a, steps): &Subject, (b, others): &Subject) -> bool {
    steps == others && a.seed == b.seed && a.rules == b.rules && a.turtle == b.turtle
}

/// The system of a definition.
///
/// # Errors
/// The first error of the definition.
fn subject(definition: &Definition) -> Result<Option<Subject>, Diagnostic> {
    match System::new(definition) {
        Ok(system) => Ok(Some((system, definition.iterations))),
        Err(problems) => problems.first_error().map_or(Ok(None), Err),
    }
}

/// The present work of the painter.
enum Task {
    /// The drawing that frames the film.
    Framing(FigureDrawer),
    /// The frame's drawing.
    Drawing(FigureDrawer),
    /// The frame's pixels.
    Pixels,
    Done,
}

/// Makes pixels of frames, one after the other, in the same memory. A frame's drawing is the drawing of the frame
/// before if only the view, the style or the drawn part differ.
///
/// The pixels do not depend on the frames before: each frame is painted by a renderer that remembers nothing.
pub struct Painter {
    limits: Limits,
    system: Option<Subject>,
    figure: Option<Figure>,
    /// Close views of the figure, if the film has them.
    closeup: Option<Closeup>,
    /// The system that frames the film, and its framing once it is drawn.
    framed: Option<(Subject, Option<Framing>)>,
    task: Task,
    frame: Option<Frame>,
    viewport: Viewport,
    detail: Detail,
    renderer: FigureRenderer,
    spent: u64,
}

impl Painter {
    /// A painter of drawings within `limits`: [`LIMITS`], unless frames need not be the same everywhere.
    #[must_use]
    pub fn new(limits: Limits) -> Self {
        Self {
            limits,
            system: None,
            figure: None,
            closeup: None,
            framed: None,
            task: Task::Done,
            frame: None,
            viewport: Viewport { width: 0, height: 0, ratio: 1.0 },
            detail: Detail::Fine,
            renderer: FigureRenderer::new(),
            spent: 0,
        }
    }

    /// The limits of drawings.
    #[must_use]
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// The units of work of all steps so far, as [`Meter`](lsystem_base::Meter) counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// The bytes of a drawing in the making, as [`FigureDrawer::bytes`].
    #[must_use]
    pub fn drawing_bytes(&self) -> u64 {
        if let Task::Framing(drawer) | Task::Drawing(drawer) = &self.task { drawer.bytes() } else { 0 }
    }

    /// Starts a frame of `size` pixels. An unfinished frame is given up.
    ///
    /// # Errors
    /// The first error of the frame's system.
    pub fn begin(&mut self, frame: &Frame, size: [u32; 2], detail: Detail) -> Result<(), Diagnostic> {
        let [width, height] = size;
        self.viewport = Viewport { width, height, ratio: (f64::from(width.max(height)) / USUAL).max(1.0) };
        self.detail = detail;
        self.frame = Some(frame.clone());
        self.task = Task::Done;
        let framed = frame.framed.as_ref().map_or(Ok(None), subject)?;
        let is_framed = match (&self.framed, &framed) {
            (Some((former, framing)), Some(framed)) => framing.is_some() && is_same_drawing(former, framed),
            (_, framed) => framed.is_none(),
        };
        let Some(system) = subject(&frame.definition)? else { return Ok(()) };
        let is_shown = self.figure.is_some() && self.system.as_ref().is_some_and(|old| is_same_drawing(old, &system));
        self.system = Some(system);
        if is_shown && is_framed {
            self.start();
            return Ok(());
        }
        // The former drawing is dropped first, so that one drawing is in memory at a time.
        (self.figure, self.closeup) = (None, None);
        self.renderer = FigureRenderer::new();
        match framed {
            Some(framed) if !is_framed => {
                self.task = Task::Framing(Figure::drawer(&framed.0, framed.1, self.limits));
                self.framed = Some((framed, None));
            }
            _ => self.draw(),
        }
        Ok(())
    }

    /// Starts the frame's drawing.
    fn draw(&mut self) {
        if let Some((system, n)) = &self.system {
            self.task = Task::Drawing(Figure::drawer(system, *n, self.limits));
        }
    }

    /// Goes on with the frame for about `work` units of work.
    ///
    /// # Errors
    /// The limit that the frame's drawing exceeds.
    pub fn step(&mut self, work: u64) -> Result<Progress, Diagnostic> {
        match &mut self.task {
            Task::Framing(drawer) | Task::Drawing(drawer) => {
                let before = drawer.spent();
                let progress = drawer.step(work);
                self.spent += drawer.spent() - before;
                if progress == Progress::Done {
                    match core::mem::replace(&mut self.task, Task::Done) {
                        Task::Framing(drawer) => self.frame_by(&drawer.finish()?),
                        Task::Drawing(drawer) => {
                            self.figure = Some(drawer.finish()?);
                            self.start();
                        }
                        _ => {}
                    }
                }
            }
            Task::Pixels => {
                let before = self.renderer.spent();
                let painted = self.renderer.step(work);
                self.spent += self.renderer.spent() - before;
                if painted != Painted::Nothing {
                    self.task = Task::Done;
                }
            }
            Task::Done => {}
        }
        Ok(if matches!(self.task, Task::Done) { Progress::Done } else { Progress::More })
    }

    /// Frames the film by a drawing, and starts the frame's own one.
    fn frame_by(&mut self, figure: &Figure) {
        if let Some((_, framing)) = &mut self.framed {
            *framing = Some(Framing::of(figure));
        }
        self.draw();
    }

    /// Starts the pixels of the frame.
    fn start(&mut self) {
        let (Some(frame), Some(figure), Some((system, _))) = (&self.frame, &self.figure, &self.system) else { return };
        let framing = self.framed.as_ref().filter(|_| frame.framed.is_some()).and_then(|(_, framing)| framing.as_ref());
        let vantage = framing.map_or(frame.vantage, |framing| framing.hold(figure, self.viewport, &frame.vantage));
        let mut shown = (figure.clone(), vantage);
        if let (Some(segment), Figure::Plane(whole)) = (&frame.segment, figure) {
            let known = self.closeup.take().filter(|known| known.origin == *segment);
            let closeup = self.closeup.insert(known.unwrap_or_else(|| Closeup::new(whole.clone(), segment.clone())));
            if let Some((near, view)) = closeup.show(self.viewport, vantage.view) {
                shown = (Figure::Plane(near.drawing.clone()), Vantage { view, ..vantage });
            }
        }
        let (figure, vantage) = shown;
        self.renderer.load(&figure);
        self.renderer.begin(PictureOptions {
            style: system.style.clone(),
            viewport: self.viewport,
            vantage,
            upto: first_part(figure.segment_count(), frame.drawn),
            quality: if self.detail == Detail::Fine { Quality::FINEST } else { Quality::MOVING },
            band: u32::MAX,
        });
        self.task = Task::Pixels;
    }

    /// The pixels of the finished frame: RGBA, 8 bits each, opaque, from the upper left corner row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.renderer.pixels()
    }

    /// The drawing of the last frame.
    #[must_use]
    pub fn figure(&self) -> Option<&Figure> {
        self.figure.as_ref()
    }
}

/// The number of segments in the first part of a drawing with `all` segments; `None` for all.
fn first_part(all: u128, part: f64) -> Option<u128> {
    /// Parts are counted in 2^-53, the resolution of `f64` below 1.
    const BITS: u32 = 53;
    if part >= 1.0 {
        return None;
    }
    let part = libm::round(part.max(0.0) * (1_u64 << BITS) as f64) as u128;
    let (high, low) = (all >> BITS, all & ((1 << BITS) - 1));
    Some((high * part).saturating_add((low * part) >> BITS))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ending, Film, Script, dive_to};
    use lsystem_base::fixed::Fixed;

    const SIZE: [u32; 2] = [160, 120];

    fn bush() -> Definition {
        let rules = "X -> F-[[X]+X]+F[+FX]-X\nF -> FF";
        Definition { axiom: "X".into(), rules: rules.into(), angle: 22.5, iterations: 5, ..Definition::default() }
    }

    fn film(script: &str, definition: Definition) -> Film {
        let script: Script = script.parse().unwrap();
        Film::new(script, definition, Vantage::default()).unwrap()
    }

    fn paint(painter: &mut Painter, film: &Film, number: u32) -> Vec<u8> {
        painter.begin(&film.frame(number), SIZE, Detail::Fine).unwrap();
        while painter.step(10_000).unwrap() == Progress::More {}
        painter.pixels().to_vec()
    }

    #[test]
    fn frames_do_not_depend_on_the_frames_before() {
        let solid = Definition { rules: "X -> F&[X]/[X]\nF -> FF".into(), iterations: 6, ..bush() };
        let films = [
            film("1;1s;8fps;n=0:0,1:5;angle=0:10,1:40;hue=0:0,1:90", bush()),
            film("1;1s;8fps;fixed;n=0:1,1:5;angle=0:10,1:40", bush()),
            film("1;1s;8fps;view=0:0/0/1,1:0.1/0.2/50", bush()),
            film("1;1s;8fps;view=0:0/0/3,1:0.1/0.2/3", Definition { iterations: 9, ..bush() }),
            film("1;1s;8fps;drawn=0:0,1:1", bush()),
            film("1;1s;8fps;camera=0:0,1:360;drawn=0:1,1:0.5", solid.clone()),
            film("1;1s;8fps;sway=0:5/0,1:5/360", bush()),
            film("1;1s;8fps;sway=0:5/0,1:5/360", solid.clone()),
            film("1;1s;8fps;fixed;n=0:2,1:6;camera=0:0,1:360", solid),
        ];
        for film in &films {
            let mut painter = Painter::new(LIMITS);
            let frames: Vec<Vec<u8>> = (0..8).map(|number| paint(&mut painter, film, number)).collect();
            assert!(frames.iter().all(|frame| frame.len() == 4 * 160 * 120));
            assert!(frames.windows(2).all(|pair| pair[0] != pair[1]), "{}", film.script());
            for number in [6, 1, 4, 4, 0] {
                assert_eq!(paint(&mut painter, film, number), frames[number as usize], "{} {number}", film.script());
                assert_eq!(paint(&mut Painter::new(LIMITS), film, number), frames[number as usize]);
            }
        }
    }

    #[test]
    fn a_dive_reaches_a_segment_at_any_depth() {
        let curve = Definition {
            axiom: "F".into(),
            rules: "F -> F+F--F+F".into(),
            angle: 60.0,
            iterations: 600,
            ..Definition::default()
        };
        let figure = Figure::draw(&System::new(&curve).unwrap(), 600, &Limits::default()).unwrap();
        let mut script = Script { seconds: 8.0, rate: 1, size: SIZE, ending: Ending::Once, ..Script::default() };
        let middle = Fixed::units(1).shifted(2 * 600 - 1);
        let track = dive_to(&mut script, &figure, &middle, &Vantage::default()).unwrap();
        script.tracks.push(track);
        let end = script.tracks[0].keys.last().unwrap().value[2];
        assert!(end > 1e280 && end < 1e301, "{end}");
        let film = film(&script.to_string(), curve);
        let frames: Vec<Vec<u8>> = (0..8).map(|number| paint(&mut Painter::new(LIMITS), &film, number)).collect();
        // The middle of the curve is its tip: it is in every picture's middle once the dive has begun.
        let is_ink = |frame: &[u8], x: usize, y: usize| frame[4 * (y * 160 + x)] != frame[0];
        for frame in &frames[1..] {
            let inked = (70..90).flat_map(|x| (50..70).map(move |y| (x, y))).filter(|&(x, y)| is_ink(frame, x, y));
            assert!(inked.count() > 10);
        }
        let mut painter = Painter::new(LIMITS);
        assert!([7, 2, 5].iter().all(|&number| paint(&mut painter, &film, number) == frames[number as usize]));
    }

    /// The part of the pixels that differ between two pictures by more than a tenth of the range.
    fn difference(a: &[u8], b: &[u8]) -> f64 {
        let differ = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 25);
        let count = a.chunks(4).zip(b.chunks(4)).filter(|&pair| differ(pair)).count();
        4.0 * count as f64 / a.len() as f64
    }

    #[test]
    fn generations_grow_into_each_other() {
        // At 0.001 of a generation before and after a whole one, the picture is that of the whole generation.
        let film = film("1;6s;1fps;once;n=0:0,6:6", bush());
        let mut painter = Painter::new(LIMITS);
        let mut at = |time: f64| {
            painter.begin(&film.frame_at(time), SIZE, Detail::Fine).unwrap();
            while painter.step(100_000).unwrap() == Progress::More {}
            painter.pixels().to_vec()
        };
        for generation in 1..=5 {
            let time = f64::from(generation);
            let whole = at(time);
            for near in [time - 1e-3, time + 1e-3] {
                let near = difference(&whole, &at(near));
                // A tenth of the pixels would be a large part of the plant.
                assert!(near < 0.02, "{generation}: {near}");
            }
            assert!(difference(&whole, &at(time + 0.5)) > 0.005, "{generation}");
        }
    }

    /// The rows of a frame that have ink, from the first to the last, and the columns.
    fn inked(pixels: &[u8]) -> [core::ops::Range<usize>; 2] {
        let is_ink = |at: usize| pixels[4 * at..4 * at + 3] != pixels[..3];
        let [width, height] = SIZE.map(|side| side as usize);
        let range = |mut lines: Vec<usize>| {
            lines.sort_unstable();
            lines.first().copied().unwrap_or(0)..lines.last().map_or(0, |last| last + 1)
        };
        let places = || (0..width * height).filter(|&at| is_ink(at));
        [range(places().map(|at| at / width).collect()), range(places().map(|at| at % width).collect())]
    }

    #[test]
    fn a_fixed_camera_shows_the_plant_grow_from_the_ground() {
        let solid = Definition { rules: "X -> F[&X]////[&X]////&X\nF -> FF".into(), ..bush() };
        for definition in [bush(), solid] {
            let mut painter = Painter::new(LIMITS);
            let mut at = |script: &str, number| inked(&paint(&mut painter, &film(script, definition.clone()), number));
            let [fixed, follow] = ["1;5s;1fps;once;fixed;n=0:1,5:5", "1;5s;1fps;once;n=0:1,5:5"];
            let last = at(fixed, 4);
            assert_eq!(last, at(follow, 4), "the last frame is the fitted picture");
            let heights: Vec<usize> = (0..5).map(|number| at(fixed, number)[0].len()).collect();
            assert!(heights.windows(2).all(|pair| pair[0] < pair[1]), "{heights:?}");
            for number in 0..4 {
                let [rows, columns] = at(fixed, number);
                // A thicker trunk has a larger round end.
                assert!(rows.end.abs_diff(last[0].end) <= 4, "{number}: the root moves, {rows:?} of {last:?}");
                assert!(columns.start >= last[1].start && columns.end <= last[1].end, "{number}: {columns:?}");
                assert!(at(follow, number)[0].len() > 100, "{number}: a followed drawing fills the frame");
            }
        }
    }

    #[test]
    fn wind_moves_the_tips_and_not_the_root() {
        let mut painter = Painter::new(LIMITS);
        let film = film("1;4s;1fps;sway=0:6/0,4:6/360", bush());
        let frames: Vec<Vec<u8>> = (0..4).map(|number| paint(&mut painter, &film, number)).collect();
        // The turns of the trunk, of the boughs and of the twigs are half a wave apart, and so are the tips.
        assert!(difference(&frames[1], &frames[3]) > 0.01);
        let rows: Vec<_> = frames.iter().map(|frame| inked(frame)[0].clone()).collect();
        assert!(rows.iter().all(|row| row.end.abs_diff(rows[0].end) <= 1), "{rows:?}");
        // A film over one wave is a loop.
        painter.begin(&film.frame_at(4.0), SIZE, Detail::Fine).unwrap();
        while painter.step(100_000).unwrap() == Progress::More {}
        assert_eq!(painter.pixels(), frames[0]);
    }

    #[test]
    fn parts_of_large_drawings_are_exact() {
        let system = System::new(&Definition { axiom: "F".into(), rules: "F -> FFFF".into(), ..Definition::default() });
        let system = system.unwrap();
        let count = |n, part| {
            let drawing = Figure::draw(&system, n, &Limits::default()).unwrap();
            first_part(drawing.segment_count(), part)
        };
        assert_eq!((count(3, 0.5), count(3, 0.0), count(3, 1.0)), (Some(32), Some(0), None));
        assert_eq!(count(60, 0.75), Some(3 << 118));
    }

    #[test]
    fn errors_are_told() {
        let mut painter = Painter::new(LIMITS);
        let broken = film("1;1s", Definition { axiom: "F(".into(), ..Definition::default() });
        assert!(painter.begin(&broken.frame(0), SIZE, Detail::Fine).is_err());
        let random = Definition { axiom: "F".into(), rules: "F -> FFF : 0.5\nF -> FFFF : 0.5".into(), ..bush() };
        let large = film("1;1s;n=0:40", random);
        painter.begin(&large.frame(0), SIZE, Detail::Fine).unwrap();
        let end = loop {
            match painter.step(1 << 20) {
                Ok(Progress::More) => {}
                end => break end,
            }
        };
        assert!(end.is_err());
    }
}
