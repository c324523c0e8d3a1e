//! Pictures in the plane: at any view they do not depend on the size of steps or on panes.

use super::drawing::drawn;
use crate::gauge::WORK;
use crate::{Gauge, Source, make};
use lsystem::render::{Detail, Pane, Pass, RenderStats, fitted_scale};
use lsystem::syntax::Ink;
use lsystem::{Definition, Dialect, Drawing, Figure, Progress, Renderer, Style, System, View, Viewport, fit};
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
        if source.is_shown {
            println!("{:?} {:?} upto {:?}\n{:?}", settings.viewport, settings.view, settings.upto, settings.style);
        }
        settings
    }

    /// The bytes for all pixels: subsamples, sums of ink and the picture itself.
    fn memory(&self) -> usize {
        64 * self.viewport.width as usize * self.viewport.height as usize
    }

    fn picture(&self, renderer: &mut Renderer, detail: Detail, work: usize, gauge: &mut Gauge) {
        let Self { style, viewport, view, upto } = self;
        gauge.call("begin", || renderer.begin_with(style, *viewport, *view, detail, *upto));
        gauge.steps("picture", work, || {
            let before = renderer.spent();
            (renderer.step(work), renderer.spent() - before)
        });
        assert_eq!(renderer.pixels().len(), 4 * (viewport.width * viewport.height) as usize);
    }
}

/// A random drawing and the settings of its picture.
fn random_picture(source: &mut Source<'_>, ink: Ink, gauge: &mut Gauge) -> Option<(Arc<Drawing>, PictureSettings)> {
    let (definition, system) = make::system(source)?;
    let limits = make::limits(source);
    let drawing = drawn(&system, definition.iterations, &limits, gauge)?;
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
    let definition = Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        angle,
        iterations: n,
        dialect: Dialect::Abop,
        ..Definition::default()
    };
    if source.is_shown {
        println!("{axiom} {rules} {angle} {n}");
    }
    let Ok(system) = System::new(&definition) else { return };
    let Some(drawing) = drawn(&system, n, &make::limits(source), gauge) else { return };
    let mut settings = PictureSettings::make(source, &system);
    settings.style.ink = Ink::Solid;
    gauge.allow(settings.memory());
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
    let (pixels, stats) = (renderer.pixels().to_vec(), renderer.stats());
    if source.once_in(2) {
        let mut other = Renderer::new();
        other.load(drawing.clone());
        settings.picture(&mut other, Detail::Fine, source.pick(&[1_000_000, 100, 3]), &mut Gauge::new());
        if stats.outlines + stats.parts == 0 && other.stats().outlines + other.stats().parts == 0 {
            gauge.reach("other steps");
            assert!(other.pixels() == pixels, "the picture depends on the size of steps");
        }
    }
    // A light renderer, tiles and outlines differ between panes by design.
    let is_exact = settings.view.zoom.abs() < MAX_EXACT && stats.tiles + stats.outlines + stats.parts == 0;
    if is_exact && source.once_in(2) {
        panes(source, drawing, settings, &pixels, gauge);
    }
}

/// Checks that the picture in panes equals the whole picture.
fn panes(source: &mut Source<'_>, drawing: &Arc<Drawing>, settings: &PictureSettings, whole: &[u8], gauge: &mut Gauge) {
    let PictureSettings { style, viewport, view, upto } = settings;
    let size = [source.pick(&[64, 16, 144, 48]), source.pick(&[16, 48, 64])];
    let mut renderer = Renderer::new();
    renderer.load(drawing.clone());
    let (mut apart, mut rough) = (0, false);
    for (pane, pass) in Pass::all(Ink::Solid, *viewport, size).into_iter().take(64) {
        gauge.call("begin pane", || renderer.begin_pane(style, *viewport, *view, *upto, (pane, pass)));
        gauge.steps("pane", WORK, || {
            let before = renderer.spent();
            (renderer.step(WORK), renderer.spent() - before)
        });
        let stats = renderer.stats();
        rough |= stats.tiles + stats.outlines + stats.parts > 0;
        apart += if pass.shows() { differing(renderer.pixels(), whole, pane, viewport.width) } else { 0 };
    }
    if !rough {
        gauge.reach("panes");
        // If the edge of a stroke meets a subsample, rounding decides.
        let most = 1 + whole.len() / 4 / 500;
        assert!(apart <= most, "{apart} of {} pixels differ when made in panes of {size:?}", whole.len() / 4);
    }
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
        let mut other = Renderer::new();
        other.load(drawing.clone());
        let work = source.pick(&[1_000_000, 100, 3]);
        let PictureSettings { style, viewport, view, upto } = &settings;
        other.begin_with(style, *viewport, *view, detail, *upto);
        while other.step(work) == Progress::More {}
        assert!(other.pixels() == renderer.pixels(), "the picture depends on the size of steps");
    }
    let RenderStats { blocks, strokes, stamps, tiles, outlines, parts } = renderer.stats();
    // With more work than this, larger blocks become dots, in the whole picture sooner than in its panes.
    let is_exact =
        settings.view.zoom.abs() < MAX_EXACT && tiles + outlines + parts == 0 && blocks + strokes + stamps < 40_000;
    if is_exact && detail == Detail::Fine && source.once_in(2) {
        let PictureSettings { style, viewport, view, upto } = &settings;
        let size = [source.pick(&[64, 16, 144]), source.pick(&[16, 48, 64])];
        let mut other = Renderer::new();
        other.load(drawing);
        let (mut apart, mut rough) = (0, false);
        let all = Pass::all(ink, *viewport, size);
        if all.len() > 128 {
            return;
        }
        for (pane, pass) in all {
            gauge.call("begin pane", || other.begin_pane(style, *viewport, *view, *upto, (pane, pass)));
            gauge.steps("pane", WORK, || {
                let before = other.spent();
                (other.step(WORK), other.spent() - before)
            });
            rough |= other.stats().outlines > 0;
            apart += if pass.shows() { differing(other.pixels(), renderer.pixels(), pane, viewport.width) } else { 0 };
        }
        if rough {
            return;
        }
        gauge.reach("panes");
        let whole = renderer.pixels().len() / 4;
        // A pane samples a cut stroke at other points, so that an eighth of a pixel's ink may go to the next pixel.
        assert!(apart <= 4 + whole / 100, "{apart} of {whole} pixels differ when made in panes of {size:?}");
    }
}
