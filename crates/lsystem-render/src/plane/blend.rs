//! Pictures in the style's ink: opaque, additive, or opaque and shaded by the amount of ink.
//!
//! A shaded picture has the colours of the opaque one. Where strokes pile up, a colour becomes paler or deeper with the
//! amount of ink there. The shading fades out continuously where strokes become larger and where they do not pile up, so
//! that there is no seam while the view or n changes.

use super::RenderStats;
use super::density::Density;
use super::fineness::Fineness;
use super::opaque::Opaque;
use super::opaque_picture::Plan;
use super::shape::Shapes;
use crate::ink::Shading;
use crate::pane::Pass;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use lsystem_syntax::Ink;

/// The least shading: with less, no channel changes by more than one of its 256 levels.
const LEAST_SHADING: f64 = 1.0 / 256.0;

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
            let parts = Parts {
                has_opaque: is_opaque && !is_idle,
                has_density: !is_opaque || shading.piled > LEAST_SHADING,
                is_opaque,
            };
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

#[cfg(test)]
mod tests {
    use crate::pane::Pass;
    use crate::plane::sample::Sample;
    use crate::plane::tests::{close_up, difference, hard, picture, put};
    use crate::plane::{Renderer, View};
    use crate::viewport::Viewport;
    use lsystem_base::Progress;
    use lsystem_drawing::Drawing;
    use lsystem_syntax::{Ink, Style};
    use std::sync::Arc;

    const VIEWPORT: Viewport = Viewport { width: 160, height: 160, ratio: 1.0 };

    fn light(frame: &[u8]) -> f64 {
        frame.iter().map(|&level| f64::from(level)).sum::<f64>() / frame.len() as f64
    }

    /// By pair of neighbouring frames: the mean change of a pixel, and the change of the mean light, in levels.
    fn changes(frames: &[Vec<u8>]) -> Vec<[f64; 2]> {
        let change = |a: &[u8], b: &[u8]| [difference(a, b, 160).0, (light(a) - light(b)).abs()];
        frames.windows(2).map(|pair| change(&pair[0], &pair[1])).collect()
    }

    /// The changes of a film in the default ink, beyond those of the same film in opaque ink.
    fn excess(frames: &(impl Iterator<Item = (Arc<Drawing>, View)> + Clone)) -> Vec<[f64; 2]> {
        let mut renderer = Renderer::new();
        let [own, opaque] = [Ink::Auto, Ink::Solid].map(|ink| {
            let style = Style { ink, ..Style::default() };
            let film = frames.clone().map(|(drawing, view)| {
                renderer.load(drawing);
                picture(&mut renderer, &style, VIEWPORT, view);
                renderer.pixels().to_vec()
            });
            changes(&film.collect::<Vec<_>>())
        });
        own.iter().zip(opaque).map(|(own, opaque)| [0, 1].map(|i| own[i] - opaque[i])).collect()
    }

    /// Wherever the opaque panes are pieces of the opaque picture.
    #[test]
    fn panes_have_the_shades_of_the_whole() {
        let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
        for (name, sample) in hard() {
            let drawing = Arc::new(sample.draw(24));
            let [mut whole, mut renderer] = [Renderer::new(), Renderer::new()];
            whole.load(drawing.clone());
            renderer.load(drawing.clone());
            for (zoom, size) in [(1.0, [320, 48]), (7.0, [133, 71])] {
                let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
                let [own, opaque] = [Ink::Auto, Ink::Solid].map(|ink| {
                    let style = Style { ink, ..sample.0.style.clone() };
                    picture(&mut whole, &style, viewport, view);
                    let mut pixels = vec![0; whole.pixels().len()];
                    for (pane, pass) in Pass::all(ink, viewport, size) {
                        renderer.begin_pane(&style, viewport, view, None, (pane, pass));
                        while renderer.step(10_000) == Progress::More {}
                        if pass.shows() {
                            put(&mut pixels, 320, pane, renderer.pixels());
                        }
                    }
                    [pixels, whole.pixels().to_vec()]
                });
                let pixels = own.iter().map(|pixels| pixels.as_chunks::<4>().0).collect::<Vec<_>>();
                let flat = opaque.iter().map(|pixels| pixels.as_chunks::<4>().0).collect::<Vec<_>>();
                let alike = || (0..320 * 200).filter(|&at| flat[0][at] == flat[1][at]);
                let shaded = alike().filter(|&at| pixels[1][at] != flat[1][at]).count();
                assert!(shaded > 500, "{name} {zoom}: {shaded}");
                assert_eq!(alike().filter(|&at| pixels[0][at] != pixels[1][at]).count(), 0, "{name} {zoom}");
            }
        }
    }

    #[test]
    fn films_have_no_seam() {
        let all = [
            ("plant", Sample::abop("F", &[('F', "F[+F]F[-F][F]")], 22.0), 11),
            ("dragon", Sample::abop("F", &[('F', "F+G"), ('G', "F-G")], 90.0), 20),
            ("bush", Sample::abop("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5), 8),
        ];
        for (name, sample, n) in test_effort::sampled(all, 3, 0) {
            // From silhouettes to single strokes. What is shaded changes more than what is flat, but evenly: a seam would
            // be one frame that changes more than those around it.
            let drawing = Arc::new(sample.draw(n));
            let at = close_up(&drawing, 1024.0);
            let zooms = (0..160).map(|frame| libm::exp2(f64::from(frame) / 16.0));
            let zooming = excess(&zooms.map(|zoom| (drawing.clone(), View { zoom, ..at })));
            for (frame, pair) in zooming.windows(2).enumerate() {
                let jump = (pair[1][0] - pair[0][0]).abs();
                assert!(jump < 2.2 && pair[1][1] < 1.2, "{name} from zoom step {frame}: {jump} {pair:?}");
            }
            let drawings = (1..=2 * n).map(|n| (Arc::new(sample.draw(n)), View::default()));
            for (n, [pixels, light]) in (1..).zip(excess(&drawings)) {
                assert!(pixels < 1.5 && light < 1.2, "{name} from n = {n}: {pixels} {light}");
            }
        }
    }

    /// The exposure follows the part in view, without flicker.
    #[test]
    fn parts_of_a_crowd_have_contrast() {
        let sample = Sample::abop("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5);
        let drawing = Arc::new(sample.draw(40));
        let at = close_up(&drawing, 64.0);
        let mut renderer = Renderer::new();
        renderer.load(drawing);
        for ink in test_effort::sampled([Ink::Auto, Ink::Density], 2, 0) {
            let style = Style { ink, ..Style::default() };
            let mut film = |views: &mut dyn Iterator<Item = View>| -> Vec<_> {
                let mut frame = |view| {
                    picture(&mut renderer, &style, VIEWPORT, view);
                    renderer.pixels().to_vec()
                };
                views.map(&mut frame).collect()
            };
            let zooming = film(&mut (0..25).map(|frame| View { zoom: 4.0 * libm::exp2(f64::from(frame) / 6.0), ..at }));
            let panning = film(&mut (0..10).map(|frame| View { zoom: 16.0, x: at.x + f64::from(frame) * 5e-4, ..at }));
            for (name, film) in [("zooming", zooming), ("panning", panning)] {
                for (frame, pixels) in film.iter().enumerate() {
                    let levels = || pixels.iter().step_by(4);
                    let range = levels().max().unwrap() - levels().min().unwrap();
                    assert!(range > 60, "{ink:?} {name} {frame}: {range}");
                }
                for (frame, [_, light]) in changes(&film).into_iter().enumerate() {
                    // A step magnifies by an eighth, and so changes the share of the background.
                    assert!(light < 2.1, "{ink:?} {name} from {frame}: {light}");
                }
            }
        }
    }
}
