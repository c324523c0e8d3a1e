//! Pictures in the plane: at any view they do not depend on the size of steps or on panes.

use super::drawing::random_drawing;
use crate::gauge::WORK;
use crate::{Gauge, Source, make};
use lsystem::render::{Detail, Pane, Pass, RenderStats, fitted_scale};
use lsystem::syntax::Ink;
use lsystem::{Definition, Dialect, Drawing, Figure, Renderer, Style, System, View, Viewport, fit};
use std::sync::Arc;

/// The settings of a picture.
struct PictureSettings {
    style: Style,
    viewport: Viewport,
    view: View,
    upto: Option<u128>,
}

impl PictureSettings {
    fn make(source: &mut Source<'_>, system: &System) -> Self {
        let style = if source.once_in(3) { make::style(source) } else { system.style.clone() };
        let upto = make::upto(source);
        let settings = Self { style, viewport: make::viewport(source).within_limits(), view: make::view(source), upto };
        source.show(format_args!(
            "{:?} {:?} upto {:?}\n{:?}",
            settings.viewport, settings.view, settings.upto, settings.style
        ));
        settings
    }

    /// The bytes for all pixels: subsamples, sums of ink and the picture itself.
    fn memory(&self) -> usize {
        64 * self.viewport.width as usize * self.viewport.height as usize
    }

    fn picture(&self, renderer: &mut Renderer, detail: Detail, work: usize, gauge: &mut Gauge) {
        let Self { style, viewport, view, upto } = self;
        gauge.call("begin", || renderer.begin_with(style, *viewport, *view, detail, *upto));
        gauge.steps("picture", work, renderer, Renderer::step, Renderer::spent);
        assert_eq!(renderer.pixels().len(), 4 * (viewport.width * viewport.height) as usize);
    }

    /// The picture, made in steps of another size.
    fn in_other_steps(&self, source: &mut Source<'_>, drawing: &Arc<Drawing>, detail: Detail) -> Renderer {
        let mut renderer = Renderer::new();
        renderer.load(drawing.clone());
        self.picture(&mut renderer, detail, source.pick(&[1_000_000, 100, 3]), &mut Gauge::new());
        renderer
    }

    /// Checks that the picture in panes is the whole, but for some pixels, unless a pane is rough.
    fn check_panes(
        &self,
        drawing: &Arc<Drawing>,
        whole: &[u8],
        panes: impl IntoIterator<Item = (Pane, Pass)>,
        (most, is_rough): (usize, impl Fn(&RenderStats) -> bool),
        gauge: &mut Gauge,
    ) {
        let Self { style, viewport, view, upto } = self;
        let mut renderer = Renderer::new();
        renderer.load(drawing.clone());
        let (mut apart, mut rough) = (0, false);
        for (pane, pass) in panes {
            gauge.call("begin pane", || renderer.begin_pane(style, *viewport, *view, *upto, (pane, pass)));
            gauge.steps("pane", WORK, &mut renderer, Renderer::step, Renderer::spent);
            rough |= is_rough(&renderer.stats());
            apart += if pass.shows() { differing(renderer.pixels(), whole, pane, viewport.width) } else { 0 };
        }
        if !rough {
            gauge.reach("panes");
            let all = whole.len() / 4;
            assert!(apart <= most, "{apart} of {all} pixels differ when made in panes");
        }
    }
}

/// A random drawing and the settings of its picture.
fn random_picture(source: &mut Source<'_>, ink: Ink, gauge: &mut Gauge) -> Option<(Arc<Drawing>, PictureSettings)> {
    let (_, system, drawing) = random_drawing(source, gauge)?;
    let mut settings = PictureSettings::make(source, &system);
    settings.style.ink = ink;
    gauge.allow(settings.memory());
    Some((drawing, settings))
}

/// Pictures in opaque ink.
pub(super) fn render(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((drawing, settings)) = random_picture(source, Ink::Solid, gauge) else { return };
    check_opaque(source, &drawing, &settings, gauge);
}

/// Pictures of well-known systems in opaque ink, at random views.
pub(super) fn views(source: &mut Source<'_>, gauge: &mut Gauge) {
    const GOOD: [(&str, &str, f64); 6] = [
        ("F", "F -> F+F--F+F", 60.0),
        ("X", "X -> X+YF+\nY -> -FX-Y", 90.0),
        ("X", "X -> F-[[X]+X]+F[+FX]-X\nF -> FF", 22.5),
        ("F", "F -> FF-[-F+F+F]+[+F-F-F]", 22.5),
        ("X", "X -> F[+X]F[-X]+X\nF -> FF", 20.0),
        ("L", "L -> [{.-f.+f.+f.}]FL[+L]!-L", 40.0),
    ];
    let (axiom, rules, angle) = source.pick(&GOOD);
    let n = source.pick(&[0, 1, 4, 8, 20, 40, 100, 1000]);
    let (axiom, rules, dialect) = (axiom.into(), rules.into(), Dialect::Abop);
    source.given = Some(Definition { axiom, rules, angle, iterations: n, dialect, ..Definition::default() });
    let Some((drawing, settings)) = random_picture(source, Ink::Solid, gauge) else { return };
    let _ = (fit(&drawing), fitted_scale(&Figure::Plane(drawing.clone()), settings.viewport, &settings.view.into()));
    check_opaque(source, &drawing, &settings, gauge);
}

/// The largest magnification at which rounding does not move the edges of strokes.
const MAX_EXACT: f64 = 1e12;

/// Checks that the picture is the same in other steps and in panes.
fn check_opaque(source: &mut Source<'_>, drawing: &Arc<Drawing>, settings: &PictureSettings, gauge: &mut Gauge) {
    let mut renderer = if source.once_in(6) { Renderer::light() } else { Renderer::new() };
    gauge.call("load", || renderer.load(drawing.clone()));
    if source.once_in(3) {
        settings.picture(&mut renderer, Detail::Coarse, WORK, gauge);
        gauge.reach("coarse");
    }
    settings.picture(&mut renderer, Detail::Fine, WORK, gauge);
    gauge.reach("fine");
    let (pixels, is_rough) = (renderer.pixels(), has_sketches(&renderer.stats()));
    if source.once_in(2) {
        let other = settings.in_other_steps(source, drawing, Detail::Fine);
        if !is_rough && !has_sketches(&other.stats()) {
            gauge.reach("other steps");
            assert!(other.pixels() == pixels, "the picture depends on the size of steps");
        }
    }
    // A light renderer, tiles and outlines differ between panes by design.
    let is_drawn_apart = |stats: &RenderStats| stats.tiles > 0 || has_sketches(stats);
    let is_exact = settings.view.zoom.abs() < MAX_EXACT && !is_drawn_apart(&renderer.stats());
    if is_exact && source.once_in(2) {
        let size = [source.pick(&[64, 16, 144, 48]), source.pick(&[16, 48, 64])];
        let panes = Pass::all(Ink::Solid, settings.viewport, size).into_iter().take(64);
        // If the edge of a stroke meets a subsample, rounding decides.
        let most = 1 + pixels.len() / 4 / 500;
        settings.check_panes(drawing, pixels, panes, (most, is_drawn_apart), gauge);
    }
}

/// Whether outlines or dots stand for blocks.
fn has_sketches(stats: &RenderStats) -> bool {
    stats.outlines + stats.parts > 0
}

/// The number of pixels of a pane that differ from the whole picture by more than one subsample.
pub(super) fn differing(own: &[u8], whole: &[u8], pane: Pane, width: u32) -> usize {
    assert_eq!(own.len(), 4 * (pane.width * pane.height) as usize);
    let mut apart = 0;
    for (y, row) in own.chunks_exact((4 * pane.width).max(1) as usize).enumerate() {
        let at = 4 * ((pane.y as usize + y) * width as usize + pane.x as usize);
        let pairs = row.chunks_exact(4).zip(whole[at..at + row.len()].chunks_exact(4));
        apart += pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 20)).count();
    }
    apart
}

/// Pictures in additive ink, or shaded by the amount of ink.
pub(super) fn density(source: &mut Source<'_>, gauge: &mut Gauge) {
    let ink = source.pick(&[Ink::Density, Ink::Auto]);
    let Some((drawing, settings)) = random_picture(source, ink, gauge) else { return };
    let mut renderer = Renderer::new();
    gauge.call("load", || renderer.load(drawing.clone()));
    let detail = if source.once_in(3) { Detail::Coarse } else { Detail::Fine };
    settings.picture(&mut renderer, detail, WORK, gauge);
    gauge.reach("picture");
    if source.once_in(2) {
        let other = settings.in_other_steps(source, &drawing, detail);
        assert!(other.pixels() == renderer.pixels(), "the picture depends on the size of steps");
    }
    let RenderStats { blocks, strokes, stamps, tiles, outlines, parts } = renderer.stats();
    // With more work than this, larger blocks become dots, in the whole picture sooner than in its panes.
    let is_exact =
        settings.view.zoom.abs() < MAX_EXACT && tiles + outlines + parts == 0 && blocks + strokes + stamps < 40_000;
    if is_exact && detail == Detail::Fine && source.once_in(2) {
        let size = [source.pick(&[64, 16, 144]), source.pick(&[16, 48, 64])];
        let panes = Pass::all(ink, settings.viewport, size);
        // A pane samples a cut stroke at other points, so that an eighth of a pixel's ink may go to the next pixel.
        let most = 4 + renderer.pixels().len() / 4 / 100;
        if panes.len() <= 128 {
            settings.check_panes(&drawing, renderer.pixels(), panes, (most, |stats| stats.outlines > 0), gauge);
        }
    }
}
