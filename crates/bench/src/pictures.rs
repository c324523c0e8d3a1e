//! Pictures that a script in the browser times: each system at several depths and magnifications.

use lsystem::render::Pane;
use lsystem::syntax::{Ink, Style};
use lsystem::{Definition, Drawing, Limits, Plane, Progress, Renderer, System, View, Viewport, draw, fit, read_json};
use lsystem_session::{Screen, Session};
use serde_json::{Value, json};
use std::convert::Infallible;
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// The size of the pictures, in device pixels.
const VIEWPORT: Viewport = Viewport { width: 1600, height: 1000, ratio: 1.0 };
/// The units of work of a step, as in the page.
const WORK: usize = 16_384;

/// Systems that are hard to draw, in addition to those of the gallery: name, axiom, rules, angle.
const HARD: [(&str, &str, &str, f64); 7] = [
    ("hard: Koch", "F", "F -> F+F--F+F", 60.0),
    ("hard: dragon", "F", "F -> F+G\nG -> F-G", 90.0),
    ("hard: plant 1.24f", "X", "X -> F-[[X]+X]+F[+FX]-X\nF -> FF", 22.5),
    ("hard: plant 1.24d", "X", "X -> F[+X]F[-X]+X\nF -> FF", 20.0),
    ("hard: bush 1.24c", "F", "F -> FF-[-F+F+F]+[+F-F-F]", 22.5),
    ("hard: Sierpinski", "F-G-G", "F -> F-G+F+G-F\nG -> GG", 120.0),
    ("hard: Gosper", "F", "F -> F-G--G+F++FF+G-\nG -> +F-GG--G-F++F+G", 60.0),
];

/// The successor of the system with the heaviest overlap, which is allowed more time. In some files its letter is `g`.
const BUSH: &str = "FF-[-F+F+F]+[+F-F-F]";

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// A canvas that drops all pixels.
struct Nowhere;

impl Screen for Nowhere {
    type Error = Infallible;

    fn put(&mut self, _: &[u8], _: Viewport, _: Pane) -> Result<(), Infallible> {
        Ok(())
    }
}

/// The systems, and the picture in the making.
#[wasm_bindgen]
pub struct Pictures {
    /// The name, whether the successor is [`BUSH`], the definition, and the system.
    systems: Vec<(String, bool, Definition, System)>,
    /// The engine of the page's worker.
    session: Session<Nowhere>,
    current: usize,
    n: u32,
    drawing: Option<Arc<Drawing>>,
    renderer: Renderer,
}

#[wasm_bindgen]
impl Pictures {
    /// The hard systems, and the systems in `files` whose drawings are in the plane and share blocks. `files` is a JSON
    /// object of names and contents of system files.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new(files: &str) -> Self {
        let mut definitions: Vec<(String, Definition)> = (HARD.iter())
            .map(|&(name, axiom, rules, angle)| {
                let definition =
                    Definition { axiom: axiom.into(), rules: rules.into(), angle, ..Definition::default() };
                (name.to_owned(), definition)
            })
            .collect();
        let files: Value = serde_json::from_str(files).unwrap_or_default();
        for (name, text) in files.as_object().into_iter().flatten() {
            definitions.extend(text.as_str().and_then(|text| read_json(text).0).map(|d| (name.clone(), d)));
        }
        let systems = definitions.into_iter().filter_map(|(name, mut definition)| {
            definition.style.ink = Ink::Auto;
            let system = System::new(&definition).ok()?;
            let drawing = draw::<Plane>(&system, 2, &Limits::default());
            let memoises = !system.is_solid() && drawing.is_ok_and(|drawing| drawing.is_memoised());
            let bush = definition.rules.replace('g', "F").contains(BUSH);
            memoises.then_some((name, bush, definition, system))
        });
        Self {
            systems: systems.collect(),
            session: Session::new(Nowhere, Box::new(now)),
            current: 0,
            n: 0,
            drawing: None,
            renderer: Renderer::default(),
        }
    }

    /// Makes the drawing of generation `n` of a system. Returns JSON: name, whether the system is the bush, numbers of
    /// segments and blocks. `undefined` after the last system or if a limit is exceeded.
    pub fn build(&mut self, index: usize, n: u32) -> Option<String> {
        let (name, bush, _, system) = self.systems.get(index)?;
        let drawing = draw::<Plane>(system, n, &Limits::default()).ok()?;
        let (segments, blocks) = (drawing.segment_count().to_string(), drawing.block_count());
        (self.current, self.n) = (index, n);
        self.drawing = Some(Arc::new(drawing));
        Some(json!({"name": name, "bush": bush, "segments": segments, "blocks": blocks}).to_string())
    }

    /// Drops all tiles, as a change of the system does.
    pub fn load(&mut self) {
        if let Some(drawing) = &self.drawing {
            self.renderer.load(drawing.clone());
        }
    }

    /// Makes a whole picture: fitted at `zoom` 1, otherwise around a segment in the middle of the drawing, moved by
    /// `shift` thousandths of the extent at `zoom`. In opaque ink, or shaded in the default ink. Stops after `limit`
    /// milliseconds. Returns whether the picture is complete.
    pub fn picture(&mut self, zoom: f64, shift: f64, limit: f64, shaded: bool) -> bool {
        let view = self.view(zoom, shift);
        let ink = if shaded { Ink::Auto } else { Ink::Solid };
        let style = Style { ink, ..self.systems[self.current].3.style.clone() };
        self.renderer.begin(&style, VIEWPORT, view);
        let end = now() + limit;
        while self.renderer.step(WORK) == Progress::More {
            if now() > end {
                return false;
            }
        }
        true
    }

    /// Lets the page's engine show generation 1, so that the next picture is that of a new drawing.
    pub fn rest(&mut self) {
        self.define(1);
        while self.session.step().is_ok_and(|answer| !answer.idle) {}
    }

    /// Gives the page's engine the definition, and lets it make the first picture that it shows, in the default ink.
    /// Returns whether the picture is the final one.
    pub fn first(&mut self, zoom: f64) -> bool {
        self.session.look(VIEWPORT, self.view(zoom, 0.0), None);
        self.define(self.n);
        loop {
            let Ok(answer) = self.session.step();
            if answer.idle || answer.drawn.is_some() {
                return answer.drawn.is_none_or(|drawn| drawn.complete);
            }
        }
    }

    fn define(&mut self, iterations: u32) {
        self.session.define(Definition { iterations, ..self.systems[self.current].2.clone() });
    }

    fn view(&self, zoom: f64, shift: f64) -> View {
        let Some(drawing) = &self.drawing else { return View::default() };
        let rect = fit(drawing);
        let side = rect.width.max(rect.height);
        let [x, y] = match drawing.segments_from(drawing.segment_count() / 8 * 3).next() {
            Some(segment) if zoom > 1.0 => [
                (segment.from[0] - rect.x - rect.width / 2.0) / side,
                (segment.from[1] - rect.y - rect.height / 2.0) / side,
            ],
            _ => [0.0; 2],
        };
        View { x: x + shift / (1000.0 * zoom), y, zoom, ..View::default() }
    }

    /// The work of the last picture: the numbers of blocks visited, strokes, tiles made and tiles stamped.
    #[must_use]
    pub fn stats(&self) -> Vec<f64> {
        let stats = self.renderer.stats();
        [stats.blocks, stats.strokes, stats.tiles, stats.stamps].map(|count| count as f64).to_vec()
    }

    /// The last picture, RGBA.
    #[must_use]
    pub fn pixels(&self) -> js_sys::Uint8ClampedArray {
        js_sys::Uint8ClampedArray::from(self.renderer.pixels())
    }

    /// The ends of all segments, for drawing them one by one; `undefined` if there are more than `most`.
    #[must_use]
    pub fn segments(&self, most: u32) -> Option<js_sys::Float32Array> {
        let mut arrays = lsystem::SegmentArrays::default();
        self.drawing.as_ref()?.write_segments(u64::from(most), &mut arrays).ok()?;
        Some(arrays.ends.as_slice().into())
    }
}

impl core::fmt::Debug for Pictures {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Pictures").field("current", &self.current).finish_non_exhaustive()
    }
}
