//! Opaque ink, additive ink, and the blend of both.
//!
//! In a blend the opaque picture is made first, then the additive one over it. The opaque one shows where strokes do not
//! pile up, and everywhere if strokes are long. The shares of both change continuously with the magnification, so that
//! there is no seam while the view or n changes.

use super::density::Density;
use super::fineness::{Fineness, Shares};
use super::opaque::Opaque;
use super::picture::Plan;
use super::shape::Shapes;
use super::{Pass, RenderStats};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use lsystem_syntax::Ink;

/// Makes pictures in the style's ink.
#[derive(Default)]
pub(super) struct Blend {
    shapes: Shapes,
    fineness: Fineness,
    pub opaque: Box<Opaque>,
    /// Made with the first picture that has additive ink.
    pub density: Option<Box<Density>>,
    /// The plan until the shares are known, and then until there is room for the pixels.
    plan: Option<Plan>,
    /// The shares of the picture in the making.
    shares: Option<Shares>,
    /// Whether the pass makes or surveys an opaque picture.
    has_opaque: bool,
}

impl Blend {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        self.shapes.clear();
        self.fineness.clear();
        self.opaque.clear();
        if let Some(density) = &mut self.density {
            density.clear();
        }
    }

    /// Forgets what pictures have left for later pictures.
    pub(super) fn forget(&mut self) {
        self.opaque.forget();
        if let Some(density) = &mut self.density {
            density.forget();
        }
    }

    /// Starts a picture. An unfinished picture is given up.
    pub(super) fn begin(&mut self, plan: Plan) {
        match plan.style.ink {
            Ink::Auto => {}
            Ink::Solid => self.density = None,
            Ink::Density => self.opaque.free(),
        }
        (self.plan, self.shares) = (Some(plan), None);
    }

    /// Goes on with the picture of a drawing, or with a blank one.
    pub(super) fn step(&mut self, drawing: Option<&Drawing>, meter: &mut Meter) -> Progress {
        let Some(drawing) = drawing else { return self.blank(meter) };
        if self.shapes.step(drawing, meter) == Progress::More {
            return Progress::More;
        }
        let shapes = &self.shapes.list;
        if self.shares.is_none()
            && let Some(plan) = &self.plan
        {
            let shares = match plan.style.ink {
                Ink::Solid => Shares::OPAQUE,
                Ink::Density => Shares::ADDITIVE,
                Ink::Auto => {
                    if self.fineness.step(drawing, shapes, meter) == Progress::More {
                        return Progress::More;
                    }
                    self.fineness.shares(drawing, plan)
                }
            };
            self.shares = Some(shares);
            // A light renderer has one way only to make an opaque picture, which needs no survey.
            let is_idle = plan.pass == Pass::Count || plan.pass == Pass::Survey && self.opaque.picture.is_light;
            self.has_opaque = shares.single < 1.0 && !is_idle;
            if self.has_opaque {
                self.opaque.begin(drawing, plan);
            }
            if shares.piled > 0.0 {
                self.density.get_or_insert_default().begin(drawing, plan, shares);
            }
        }
        let mut density = self.density.as_mut().filter(|_| self.shares.is_some_and(|shares| shares.piled > 0.0));
        let opaque = &mut self.opaque;
        if self.has_opaque && opaque.prepare(drawing, shapes, meter) == Progress::More {
            return Progress::More;
        }
        if let Some(density) = &mut density
            && density.prepare(drawing, shapes, meter) == Progress::More
        {
            return Progress::More;
        }
        if meter.is_spent() {
            return Progress::More;
        }
        if let Some(plan) = self.plan.take() {
            if self.has_opaque {
                meter.charge(opaque.open(&plan));
            }
            if let Some(density) = &mut density {
                meter.charge(density.open(&plan));
            }
        }
        if self.has_opaque
            && (opaque.paint(drawing, shapes, meter) == Progress::More || opaque.resolve(meter) == Progress::More)
        {
            return Progress::More;
        }
        let Some(density) = density else { return Progress::Done };
        if density.paint(drawing, shapes, meter) == Progress::More {
            return Progress::More;
        }
        density.resolve(if self.has_opaque { opaque.pixels() } else { &[] }, meter)
    }

    /// Goes on with a picture without a drawing.
    fn blank(&mut self, meter: &mut Meter) -> Progress {
        self.shares = Some(Shares::OPAQUE);
        if let Some(plan) = self.plan.take() {
            meter.charge(self.opaque.open(&plan));
        }
        self.opaque.resolve(meter)
    }

    pub(super) fn pixels(&self) -> &[u8] {
        match &self.density {
            Some(density) if self.is_additive() => density.pixels(),
            _ => self.opaque.pixels(),
        }
    }

    /// The work of both pictures.
    pub(super) fn stats(&self) -> RenderStats {
        let opaque = if self.has_opaque { self.opaque.stats() } else { RenderStats::default() };
        match &self.density {
            Some(density) if self.is_additive() => opaque.plus(density.stats()),
            _ => opaque,
        }
    }

    fn is_additive(&self) -> bool {
        self.shares.is_some_and(|shares| shares.piled > 0.0)
    }
}
