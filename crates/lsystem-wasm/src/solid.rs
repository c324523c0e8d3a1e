//! Drawings in space: built in steps, shown coarse at once and finer while nothing changes.

use crate::budget::{LIMITS, affordable, halved};
use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::Report;
use crate::sharing::{Sharing, Turn};
use crate::surface::Surface;
use crate::viewer::{Drawn, NOTHING, Scene, Snapshot, Viewer, WORK, describe_drawing, go_on};
use lsystem::derive::Counter;
use lsystem::render::{Effort, Pane, Quality, Spent, solid_scale};
use lsystem::{Camera, Diagnostic, Drawer, Drawing, Limits, Progress, Solid, SolidRenderer, System, Viewport};
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// What a picture is to take while things move, in milliseconds.
const TARGET: f64 = 7.5;
/// One that takes longer than this is finished with less effort.
const HURRY: f64 = 9.0;
/// With two pictures in a row that take longer than this until they are shown, those that follow have half the pixels
/// in each direction: then they show more in the time.
const HALVE: f64 = 10.5;
/// By how many steps they are finer otherwise.
const FINER: i32 = 3;
/// A picture of half the pixels, with all there is to see, that takes no longer than this will come in time whole.
const WHOLE: f64 = 0.25 * TARGET;
/// Between the first picture and the finest there is one that comes soon.
const MIDDLE: Quality = Quality(12);
/// The first picture of a drawing of which nothing is known.
const UNKNOWN: Quality = Quality(4);
/// Of a drawing with more than so many times the segments of the former nothing is known.
const LIKE: u128 = 8;
/// A picture that takes longer than so many milliseconds is one that mates would help with.
const SLOW: f64 = 30.0;
/// Work units between two looks at the clock while things move.
const MOVING_WORK: usize = WORK / 4;

/// A drawing in space and its picture.
pub(crate) struct SolidView {
    pub(crate) drawing: Option<Arc<Drawing<Solid>>>,
    /// The drawing that is being built.
    drawer: Option<Box<Drawer<Solid>>>,
    renderer: SolidRenderer,
    pub(crate) camera: Camera,
    scene: Option<Scene>,
    /// Of the picture that is being made.
    quality: Quality,
    viewport: Viewport,
    /// Whether that is one of those that are shown while things move.
    moving: bool,
    /// Of pictures that come in time while things move.
    pace: Quality,
    /// Whether those have half the pixels, and how many before have come late.
    half: bool,
    late: u8,
    /// What the picture has taken, in milliseconds, and when it is told to hurry.
    spent: f64,
    hurried: f64,
    /// Whether it is made together with mates, which panes, and how much they may show.
    shared: bool,
    sharing: Sharing,
    effort: Effort,
    /// Whether the finest picture is shown.
    done: bool,
}

impl Default for SolidView {
    fn default() -> Self {
        Self {
            drawing: None,
            drawer: None,
            renderer: SolidRenderer::new(),
            camera: Camera::default(),
            scene: None,
            quality: MIDDLE,
            viewport: Viewport { width: 0, height: 0, ratio: 1.0 },
            moving: false,
            pace: UNKNOWN,
            half: false,
            late: 0,
            hurried: 0.0,
            spent: 0.0,
            shared: false,
            sharing: Sharing::default(),
            effort: Effort::default(),
            done: true,
        }
    }
}

impl Viewer for SolidView {
    fn start(&mut self, system: &System, n: u32, limits: Limits) {
        self.drawer = Some(Box::new(Drawer::solid(system, n, limits)));
    }

    fn stop(&mut self) {
        self.drawer = None;
    }

    fn build(&mut self) -> Option<Result<(), Diagnostic>> {
        Some(go_on(&mut self.drawer)?.map(|drawing| {
            self.renderer.load(drawing.clone());
            // What grows, or has another angle, takes about as long as before.
            let known = self.drawing.as_ref().map_or(0, |former| former.segment_count());
            if drawing.segment_count() / LIKE > known {
                self.pace = self.pace.min(UNKNOWN);
            }
            self.drawing = Some(drawing);
        }))
    }

    fn forget(&mut self) {
        self.drawing = None;
        self.renderer = SolidRenderer::new();
    }

    fn describe(&self, report: &mut Report, system: &System, n: u32, counted: Option<&Counter>) {
        if let Some(drawing) = &self.drawing {
            let bounds = drawing.bounds().map(|[low, high]| [low[0], low[1], high[0], high[1]]);
            describe_drawing(report, system, n, drawing, bounds, counted);
        }
    }

    fn begin(&mut self, scene: Scene) {
        self.renderer.play(scene.upto);
        self.scene = Some(self.within_room(scene));
        self.moving = true;
        self.refine(self.pace);
    }

    /// A finer picture is begun when one is shown.
    fn paint(&mut self, clock: &Clock, surface: &Surface) -> Result<Option<Drawn>, JsValue> {
        if self.shared {
            return self.paint_shared(clock, surface);
        }
        let (Some(drawing), Some(scene), false) = (&self.drawing, &self.scene, self.done) else { return Ok(None) };
        let began = clock.now();
        let progress = self.renderer.step(if self.moving { MOVING_WORK } else { WORK });
        self.spent += clock.now() - began;
        if progress == Progress::More {
            if self.moving && self.spent > self.hurried {
                self.renderer.hurry(0.3);
                self.hurried += 0.5 * HURRY;
            }
            if self.quality == Quality::FINEST && self.spent > HURRY && scene.mates > 0 && drawing.is_memoised() {
                self.shared = true;
                self.effort = Effort::new(self.quality, self.viewport);
                self.sharing.start(SolidRenderer::panes(self.viewport));
            }
            return Ok(None);
        }
        let finished = clock.now();
        surface.show(self.renderer.pixels(), self.viewport)?;
        let scale = solid_scale(drawing, scene.screen, &self.camera);
        let complete = self.quality == Quality::FINEST;
        let slow = complete && self.spent > SLOW && drawing.is_memoised();
        let moving = core::mem::take(&mut self.moving);
        let sharp = self.viewport == scene.viewport;
        if moving {
            self.keep_pace(clock.now() - finished);
        }
        self.done = complete;
        if !complete {
            self.refine(if sharp && self.quality >= MIDDLE { Quality::FINEST } else { MIDDLE });
        }
        Ok(Some(Drawn { complete, scale, moving, rough: false, slow }))
    }

    fn is_done(&self) -> bool {
        self.done
    }

    fn is_refining(&self) -> bool {
        !self.done && !self.moving
    }

    fn snapshot(&self, scene: Scene) -> Result<Box<dyn Snapshot>, &'static str> {
        let drawing = self.drawing.clone().ok_or(NOTHING)?;
        let scene = Scene { viewport: scene.viewport.within_limits(), ..scene };
        let panes = SolidRenderer::panes(scene.viewport);
        let pane = panes.first().map_or(0, |pane| {
            SolidRenderer::most_bytes(Viewport { width: pane.width, height: pane.height, ..scene.viewport })
        });
        if SolidRenderer::scene_bytes(&drawing) + part_bytes(&drawing, &scene) + pane > LIMITS.memory {
            return Err(
                "so large a drawing in space leaves too little memory for a picture beside the one that is shown",
            );
        }
        let mut renderer = SolidRenderer::new();
        renderer.load(drawing);
        renderer.play(scene.upto);
        let effort = Effort::new(Quality::BEST, scene.viewport);
        let spent = Spent::default();
        let mut snapshot = SolidSnapshot { renderer, scene, camera: self.camera, panes, at: 0, effort, spent };
        snapshot.begin();
        Ok(Box::new(snapshot))
    }
}

/// The bytes that a picture of the first segments alone takes, beside what all of them take.
fn part_bytes(drawing: &Drawing<Solid>, scene: &Scene) -> u64 {
    if scene.upto.is_some() { SolidRenderer::scene_bytes(drawing) } else { 0 }
}

/// A picture for a file, made pane by pane; once more, with a larger budget, where that was too small.
struct SolidSnapshot {
    renderer: SolidRenderer,
    scene: Scene,
    camera: Camera,
    panes: Vec<Pane>,
    /// The pane that is being made.
    at: usize,
    effort: Effort,
    spent: Spent,
}

impl SolidSnapshot {
    fn begin(&mut self) {
        if let Some(pane) = self.panes.get(self.at) {
            let Scene { style, viewport, .. } = &self.scene;
            self.renderer.begin_pane(style, *viewport, &self.camera, *pane, self.effort.budget());
        }
    }
}

impl Snapshot for SolidSnapshot {
    fn next(&mut self) -> bool {
        self.spent.add(self.renderer.effort_spent());
        self.at += 1;
        if self.at >= self.panes.len() {
            let spent = core::mem::take(&mut self.spent);
            if !self.effort.is_too_small(spent) {
                return false;
            }
            self.at = 0;
        }
        self.begin();
        true
    }

    fn step(&mut self) -> Progress {
        self.renderer.step(WORK)
    }

    fn band(&self) -> Option<(&[u8], Viewport, Pane)> {
        Some((self.renderer.pixels(), self.scene.viewport, *self.panes.get(self.at)?))
    }
}

impl SolidView {
    /// The panes that mates may help with, if the picture is made together with them, and its budget.
    pub(crate) fn sharing(&mut self) -> Option<(&mut Sharing, f32)> {
        self.shared.then_some((&mut self.sharing, self.effort.budget()))
    }

    /// Starts a pane of the finest picture for others, with the budget that they tell.
    pub(crate) fn begin_pane(&mut self, scene: Scene, pane: Pane, budget: f32) {
        self.renderer.play(scene.upto);
        let scene = self.within_room(scene);
        self.renderer.begin_pane(&scene.style, scene.viewport, &self.camera, pane, budget);
    }

    /// Goes on with it; what it has taken, when it is there.
    pub(crate) fn step_pane(&mut self) -> Option<Spent> {
        (self.renderer.step(WORK) == Progress::Done).then(|| self.renderer.effort_spent())
    }

    /// Its pixels.
    pub(crate) fn pane_pixels(&self) -> &[u8] {
        self.renderer.pixels()
    }

    /// With as many pixels as there is room for.
    fn within_room(&self, scene: Scene) -> Scene {
        let drawing = self.drawing.as_ref().map_or(0, |drawing| drawing.bytes() + part_bytes(drawing, &scene));
        Scene { viewport: affordable(scene.viewport, drawing, SolidRenderer::most_bytes), ..scene }
    }

    fn refine(&mut self, quality: Quality) {
        let Some(scene) = &self.scene else { return };
        (self.done, self.shared) = (false, false);
        self.quality = quality;
        self.viewport = if self.moving && self.half { halved(scene.viewport) } else { scene.viewport };
        (self.spent, self.hurried) = (0.0, HURRY);
        self.renderer.begin(&scene.style, self.viewport, &self.camera, quality);
    }

    /// Goes on with a picture that is made together with mates.
    fn paint_shared(&mut self, clock: &Clock, surface: &Surface) -> Result<Option<Drawn>, JsValue> {
        let (Some(drawing), Some(scene)) = (&self.drawing, &self.scene) else { return Ok(None) };
        let viewport = self.viewport;
        match self.sharing.turn(clock.now()) {
            Turn::Begin(pane) => {
                self.renderer.begin_pane(&scene.style, viewport, &self.camera, pane, self.effort.budget());
            }
            Turn::GoOn => {
                if self.renderer.step(WORK) == Progress::Done
                    && let Some(pane) = self.sharing.finish(self.renderer.effort_spent())
                {
                    surface.put(self.renderer.pixels(), viewport, pane)?;
                }
            }
            Turn::Wait => {}
            Turn::Done if self.effort.is_too_small(self.sharing.spent()) => self.sharing.start_again(),
            Turn::Done => {
                (self.done, self.shared) = (true, false);
                let scale = solid_scale(drawing, scene.screen, &self.camera);
                return Ok(Some(Drawn { complete: true, scale, moving: false, rough: false, slow: true }));
            }
        }
        Ok(None)
    }

    /// Chooses how fine the next picture is while things move, after one that took so many milliseconds to show.
    fn keep_pace(&mut self, shown: f64) {
        let finest = self.pace == Quality::MOVING;
        self.pace = self.pace.paced(steps(self.spent));
        if self.half {
            self.half = !finest || self.spent > WHOLE;
            return;
        }
        self.late = if self.spent + shown > HALVE { self.late + 1 } else { 0 };
        if self.late > 1 {
            (self.half, self.late) = (true, 0);
            self.pace = self.pace.paced(FINER);
        }
    }
}

/// By how many steps the next picture is to be finer than one that took so many milliseconds. Two are twice the effort.
fn steps(spent: f64) -> i32 {
    let ratio = TARGET / spent.max(0.01);
    match ratio {
        ..0.25 => -4,
        ..0.5 => -2,
        ..0.85 => -1,
        ..1.5 => 0,
        ..2.5 => 1,
        _ => 3,
    }
}

#[wasm_bindgen]
impl Playground {
    /// Says from where a drawing in space is looked at: angles in degrees, the target in fitted extents from the fitted
    /// centre; as [`lsystem::Camera`].
    #[expect(clippy::too_many_arguments, reason = "an object would have to be read field by field")]
    pub fn camera(
        &mut self,
        azimuth: f64,
        elevation: f64,
        zoom: f64,
        x: f64,
        y: f64,
        z: f64,
        perspective: bool,
        fade: f64,
    ) {
        let camera = Camera { azimuth, elevation, zoom, target: [x, y, z], perspective, fade };
        if camera != self.views.solid.camera {
            self.views.solid.camera = camera;
            self.outdate();
        }
    }
}
