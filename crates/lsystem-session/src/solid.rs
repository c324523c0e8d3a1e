//! The viewer of drawings in space. A coarse picture comes first, finer ones follow while the settings stay the same.

use crate::budget::{affordable, halved};
use crate::pace::{Deadline, HURRIED_EFFORT, MOVING_WORK, Pace, WORK, is_long};
use crate::sharing::{NextAction, Sharing};
use crate::surface::{Clock, Screen};
use crate::viewer::{CanvasPicture, Only, PictureSettings, Viewer};
use lsystem::render::{Effort, Pane, Pass, Quality, Spent};
use lsystem::syntax::Ink;
use lsystem::{Drawing, Progress, Solid, SolidRenderer, Viewport};
use std::sync::Arc;

/// The quality of the picture between the first and the finest: two steps below [`Quality::MOVING`], half its effort.
const MIDDLE: Quality = Quality(12);
/// The cost of a drawing is unknown if it has at least about this many times the segments of the previous one. An edit that
/// adds a generation rarely does more, and the pace then follows in two or three pictures.
const LIKE: u128 = 8;
/// A picture that takes longer than this, in milliseconds, would profit from mates: with two frames or less, nobody sees
/// the finest picture come.
const SLOW: f64 = 30.0;

/// A drawing in space and its picture.
pub(crate) struct SolidView {
    drawing: Option<Arc<Drawing<Solid>>>,
    renderer: SolidRenderer,
    settings: Option<PictureSettings>,
    /// The quality of the picture in the making.
    quality: Quality,
    /// The size of the picture in the making.
    viewport: Viewport,
    /// Whether the picture in the making is a moving picture: the first one of a new view, which must be fast.
    moving: bool,
    /// The quality at which moving pictures are in time.
    pace: Pace,
    /// The milliseconds spent on the picture in the making.
    spent: f64,
    /// The value of `spent` at which the effort of a moving picture is reduced next.
    deadline: Deadline,
    /// Whether mates help with the picture in the making.
    shared: bool,
    /// The panes of the shared picture.
    sharing: Sharing,
    /// The effort of the shared picture.
    effort: Effort,
    /// Whether the finest picture is shown.
    done: bool,
}

impl Default for SolidView {
    fn default() -> Self {
        Self {
            drawing: None,
            renderer: SolidRenderer::new(),
            settings: None,
            quality: MIDDLE,
            viewport: Viewport { width: 0, height: 0, ratio: 1.0 },
            moving: false,
            pace: Pace::default(),
            spent: 0.0,
            deadline: Deadline::new(),
            shared: false,
            sharing: Sharing::default(),
            effort: Effort::default(),
            done: true,
        }
    }
}

impl<S: Screen> Viewer<S> for SolidView {
    fn begin(&mut self, settings: PictureSettings) {
        self.renderer.play(settings.upto);
        self.settings = Some(self.within_room(settings));
        self.moving = true;
        self.refine(self.pace.quality);
    }

    /// After a picture is shown, the next finer one begins.
    fn paint(&mut self, clock: &Clock, surface: &mut S) -> Result<Option<CanvasPicture>, S::Error> {
        if self.shared {
            return self.paint_shared(clock, surface);
        }
        let (Some(drawing), Some(settings), false) = (&self.drawing, &self.settings, self.done) else {
            return Ok(None);
        };
        let began = clock();
        let progress = self.renderer.step(if self.moving { MOVING_WORK } else { WORK });
        self.spent += clock() - began;
        if progress == Progress::More {
            if self.moving && self.deadline.has_passed(self.spent) {
                self.renderer.hurry(HURRIED_EFFORT);
            }
            // The tone of additive ink depends on the whole picture.
            let is_long = settings.style.ink != Ink::Density && self.quality == Quality::FINEST && is_long(self.spent);
            if is_long && settings.mates > 0 && drawing.is_memoised() {
                self.shared = true;
                self.effort = Effort::new(self.quality, self.viewport);
                self.sharing.start(SolidRenderer::panes(self.viewport));
            }
            return Ok(None);
        }
        let finished = clock();
        surface.show(self.renderer.pixels(), self.viewport)?;
        let scale = settings.scale;
        let complete = self.quality == Quality::FINEST;
        let only = if complete { Only::of(self.renderer.pixels(), &settings.style) } else { None };
        let slow = complete && self.spent > SLOW && drawing.is_memoised();
        let moving = core::mem::take(&mut self.moving);
        let sharp = self.viewport == settings.viewport;
        if moving {
            self.pace.learn(self.spent, clock() - finished);
        }
        self.done = complete;
        if !complete {
            self.refine(if sharp && self.quality >= MIDDLE { Quality::FINEST } else { MIDDLE });
        }
        Ok(Some(CanvasPicture { complete, scale, moving, slow, only, ..CanvasPicture::default() }))
    }

    fn is_done(&self) -> bool {
        self.done
    }

    fn is_refining(&self) -> bool {
        !self.done && !self.moving
    }
}

/// The bytes of the second scene, for the first segments alone, if the picture does not show all segments.
fn part_bytes(drawing: &Drawing<Solid>, settings: &PictureSettings) -> u64 {
    if settings.upto.is_some() { SolidRenderer::scene_bytes(drawing) } else { 0 }
}

impl SolidView {
    /// Takes the drawing of the next pictures.
    pub(crate) fn load(&mut self, drawing: Arc<Drawing<Solid>>) {
        self.renderer.load(drawing.clone());
        // A drawing that grows or changes an angle takes about as long as the previous one.
        let known = self.drawing.as_ref().map_or(0, |former| former.segment_count());
        if drawing.segment_count() / LIKE > known {
            self.pace.be_careful();
        }
        self.drawing = Some(drawing);
    }

    pub(crate) fn forget(&mut self) {
        self.drawing = None;
        self.renderer = SolidRenderer::new();
    }

    /// The panes of the shared picture and its budget; `None` if the picture is not shared.
    pub(crate) fn sharing(&mut self) -> Option<(&mut Sharing, f32)> {
        self.shared.then_some((&mut self.sharing, self.effort.budget()))
    }

    /// On a mate: starts a pane of the finest picture, with this budget.
    pub(crate) fn begin_pane(&mut self, settings: PictureSettings, pane: Pane, budget: f32) {
        self.renderer.play(settings.upto);
        let settings = self.within_room(settings);
        self.renderer.begin_pane(
            &settings.style,
            settings.viewport,
            &settings.vantage.camera,
            (pane, Pass::Show),
            budget,
        );
    }

    /// On a mate: continues the pane. Returns the effort spent when the pane is complete.
    pub(crate) fn step_pane(&mut self) -> Option<Spent> {
        (self.renderer.step(WORK) == Progress::Done).then(|| self.renderer.effort_spent())
    }

    /// On a mate: the pixels of the pane, RGBA.
    pub(crate) fn pane_pixels(&self) -> &[u8] {
        self.renderer.pixels()
    }

    /// The settings with as many pixels as fit the memory budget.
    fn within_room(&self, settings: PictureSettings) -> PictureSettings {
        let drawing = self.drawing.as_ref().map_or(0, |drawing| drawing.bytes() + part_bytes(drawing, &settings));
        PictureSettings { viewport: affordable(settings.viewport, drawing, SolidRenderer::most_bytes), ..settings }
    }

    /// Starts a picture of this quality.
    fn refine(&mut self, quality: Quality) {
        let Some(settings) = &self.settings else { return };
        (self.done, self.shared) = (false, false);
        self.quality = quality;
        self.viewport = if self.moving && self.pace.is_half { halved(settings.viewport) } else { settings.viewport };
        (self.spent, self.deadline) = (0.0, Deadline::new());
        self.renderer.begin(&settings.style, self.viewport, &settings.vantage.camera, quality);
    }

    /// Continues a picture that is shared with mates.
    fn paint_shared<S: Screen>(&mut self, clock: &Clock, surface: &mut S) -> Result<Option<CanvasPicture>, S::Error> {
        let Some(settings) = &self.settings else { return Ok(None) };
        let viewport = self.viewport;
        match self.sharing.next_action(clock()) {
            NextAction::Begin(pane) => {
                self.renderer.begin_pane(
                    &settings.style,
                    viewport,
                    &settings.vantage.camera,
                    (pane, Pass::Show),
                    self.effort.budget(),
                );
            }
            NextAction::Continue => {
                if self.renderer.step(WORK) == Progress::Done
                    && let Some(pane) = self.sharing.finish(self.renderer.effort_spent())
                {
                    surface.put(self.renderer.pixels(), viewport, pane)?;
                }
            }
            NextAction::Wait => {}
            NextAction::Done if self.effort.is_too_small(self.sharing.spent()) => self.sharing.start_again(),
            NextAction::Done => {
                (self.done, self.shared) = (true, false);
                // A picture of a single colour is too quick to be shared, so nothing is the only thing in it.
                let scale = settings.scale;
                return Ok(Some(CanvasPicture { complete: true, scale, slow: true, ..CanvasPicture::default() }));
            }
        }
        Ok(None)
    }
}
