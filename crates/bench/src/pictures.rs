//! Pictures for a browser's script to time: one system after the other, at several depths and magnifications.

use lsystem::syntax::Ink;
use lsystem::{Definition, Drawing, Limits, Progress, Renderer, System, View, Viewport, draw, fit, read_json};
use serde_json::{Value, json};
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// The picture's size, in device pixels.
const VIEWPORT: Viewport = Viewport { width: 1600, height: 1000, ratio: 1.0 };
/// Work between two looks at anything else, as in the page.
const WORK: usize = 16_384;

/// Systems that are hard to draw, beside those of the gallery: name, axiom, rules, angle.
const HARD: [(&str, &str, &str, f64); 7] = [
    ("hard: Koch", "F", "F -> F+F--F+F", 60.0),
    ("hard: dragon", "F", "F -> F+G\nG -> F-G", 90.0),
    ("hard: plant 1.24f", "X", "X -> F-[[X]+X]+F[+FX]-X\nF -> FF", 22.5),
    ("hard: plant 1.24d", "X", "X -> F[+X]F[-X]+X\nF -> FF", 20.0),
    ("hard: bush 1.24c", "F", "F -> FF-[-F+F+F]+[+F-F-F]", 22.5),
    ("hard: Sierpinski", "F-G-G", "F -> F-G+F+G-F\nG -> GG", 120.0),
    ("hard: Gosper", "F", "F -> F-G--G+F++FF+G-\nG -> +F-GG--G-F++F+G", 60.0),
];

/// The heaviest overlap among them, for which more time is allowed, whatever its letter is.
const BUSH: &str = "FF-[-F+F+F]+[+F-F-F]";

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// The systems to be pictured, and the picture in the making.
#[wasm_bindgen]
#[derive(Default)]
pub struct Pictures {
    systems: Vec<(String, bool, System)>,
    current: usize,
    drawing: Option<Arc<Drawing>>,
    renderer: Renderer,
}

#[wasm_bindgen]
impl Pictures {
    /// The hard systems, and those among `files` (a JSON object of names and contents of system files) that
    /// memoise and are drawn in the plane.
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
            definition.style.ink = Ink::Solid;
            let system = System::new(&definition).0?;
            let drawing = draw(&system, 2, &Limits::default());
            let memoises = !system.is_solid() && drawing.is_ok_and(|drawing| drawing.is_memoised());
            let bush = definition.rules.replace('g', "F").contains(BUSH);
            memoises.then_some((name, bush, system))
        });
        Self { systems: systems.collect(), ..Self::default() }
    }

    /// Makes the graph of generation `n` of a system; its name, whether it is the bush, and how many segments it draws. Nothing after the last.
    pub fn build(&mut self, index: usize, n: u32) -> Option<String> {
        let (name, bush, system) = self.systems.get(index)?;
        let drawing = draw(system, n, &Limits::default()).ok()?;
        let (segments, blocks) = (drawing.segment_count().to_string(), drawing.block_count());
        self.current = index;
        self.drawing = Some(Arc::new(drawing));
        Some(json!({"name": name, "bush": bush, "segments": segments, "blocks": blocks}).to_string())
    }

    /// Forgets every tile, as a change of the system does.
    pub fn load(&mut self) {
        if let Some(drawing) = &self.drawing {
            self.renderer.load(drawing.clone());
        }
    }

    /// Makes a whole picture: fitted at `zoom` 1, else of a place near a segment in the midst, `shift` pixels beside.
    /// Whether that ended within `limit` milliseconds; it is cut off if not.
    pub fn picture(&mut self, zoom: f64, shift: f64, limit: f64) -> bool {
        let Some(drawing) = &self.drawing else { return true };
        let rect = fit(drawing);
        let side = rect.width.max(rect.height);
        let [x, y] = match drawing.segments_from(drawing.segment_count() / 8 * 3).next() {
            Some(segment) if zoom > 1.0 => [
                (segment.from[0] - rect.x - rect.width / 2.0) / side,
                (segment.from[1] - rect.y - rect.height / 2.0) / side,
            ],
            _ => [0.0; 2],
        };
        let view = View { x: x + shift / (1000.0 * zoom), y, zoom, ..View::default() };
        self.renderer.begin(&self.systems[self.current].2.style, VIEWPORT, view);
        let end = now() + limit;
        while self.renderer.step(WORK) == Progress::More {
            if now() > end {
                return false;
            }
        }
        true
    }

    /// What the last picture took: blocks looked into, strokes, tiles made, tiles stamped.
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

    /// The ends of all segments, for those who draw them one by one; nothing where there are more than `most`.
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
