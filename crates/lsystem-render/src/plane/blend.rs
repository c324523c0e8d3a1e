//! Pictures in the style's ink: opaque, additive, or opaque and shaded by the amount of ink.
//!
//! A shaded picture has the colours of the opaque one. Where strokes pile up, a colour becomes paler or deeper with the
//! amount of ink there. The shading fades out continuously where strokes become larger and where they do not pile up, so
//! that there is no seam while the view or n changes.

use super::density::Density;
use super::fineness::{Fineness, Shading};
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
    /// The plan until the parts of the picture are known, and then until there is room for the pixels.
    plan: Option<Plan>,
    /// The parts of the picture in the making, once they are known.
    parts: Option<Parts>,
}

/// The pictures that a picture is made from.
#[derive(Clone, Copy, Default)]
struct Parts {
    has_opaque: bool,
    has_density: bool,
    /// Whether the pixels are those of the opaque picture.
    is_opaque: bool,
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
        (self.plan, self.parts) = (Some(plan), None);
    }

    /// Goes on with the picture of a drawing, or with a blank one.
    pub(super) fn step(&mut self, drawing: Option<&Drawing>, meter: &mut Meter) -> Progress {
        let Some(drawing) = drawing else { return self.blank(meter) };
        if self.shapes.step(drawing, meter) == Progress::More {
            return Progress::More;
        }
        let shapes = &self.shapes.list;
        if self.parts.is_none()
            && let Some(plan) = &self.plan
        {
            let shading = match plan.style.ink {
                Ink::Auto if self.fineness.step(drawing, shapes, meter) == Progress::More => return Progress::More,
                Ink::Auto => self.fineness.shading(drawing, plan),
                Ink::Solid | Ink::Density => Shading::default(),
            };
            let is_opaque = plan.style.ink != Ink::Density;
            // A light renderer has one way only to make an opaque picture, which needs no survey.
            let is_idle = plan.pass == Pass::Count || plan.pass == Pass::Survey && self.opaque.picture.is_light;
            let parts =
                Parts { has_opaque: is_opaque && !is_idle, has_density: !is_opaque || shading.piled > 0.0, is_opaque };
            if parts.has_opaque {
                self.opaque.begin(drawing, plan);
            }
            if parts.has_density {
                self.density.get_or_insert_default().begin(drawing, plan, is_opaque.then_some(shading));
            }
            self.parts = Some(parts);
        }
        let Parts { has_opaque, has_density, .. } = self.parts.unwrap_or_default();
        let opaque = &mut self.opaque;
        let mut density = self.density.as_mut().filter(|_| has_density);
        if has_opaque && opaque.prepare(drawing, shapes, meter) == Progress::More {
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
            if has_opaque {
                meter.charge(opaque.open(&plan));
            }
            if let Some(density) = &mut density {
                meter.charge(density.open(&plan));
            }
        }
        if has_opaque
            && (opaque.paint(drawing, shapes, meter) == Progress::More || opaque.resolve(meter) == Progress::More)
        {
            return Progress::More;
        }
        let Some(density) = density else { return Progress::Done };
        if density.paint(drawing, shapes, meter) == Progress::More {
            return Progress::More;
        }
        density.resolve(has_opaque.then(|| opaque.pixels_mut()), meter)
    }

    /// Goes on with a picture without a drawing.
    fn blank(&mut self, meter: &mut Meter) -> Progress {
        self.parts = Some(Parts { is_opaque: true, ..Parts::default() });
        if let Some(plan) = self.plan.take() {
            meter.charge(self.opaque.open(&plan));
        }
        self.opaque.resolve(meter)
    }

    pub(super) fn pixels(&self) -> &[u8] {
        match (&self.density, self.parts) {
            (Some(density), Some(Parts { is_opaque: false, .. })) => density.pixels(),
            _ => self.opaque.pixels(),
        }
    }

    /// The work of all parts.
    pub(super) fn stats(&self) -> RenderStats {
        let Parts { has_opaque, has_density, .. } = self.parts.unwrap_or_default();
        let opaque = if has_opaque { self.opaque.stats() } else { RenderStats::default() };
        match &self.density {
            Some(density) if has_density => opaque.plus(density.stats()),
            _ => opaque,
        }
    }
}
