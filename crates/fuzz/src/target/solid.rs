//! Pictures in space.
use super::drawing::random_drawing;
use crate::gauge::WORK;
use crate::{Gauge, Source, make};
use lsystem::render::{Effort, Pane, Pass, Quality, Spent, camera_axes, fitted_scale};
use lsystem::syntax::Ink;
use lsystem::{Figure, Progress, Solid, SolidRenderer, Style};

/// Pictures in space: at all qualities, in a hurry, and in panes.
pub(super) fn solid(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((_, system, drawing)) = random_drawing::<Solid>(source, gauge) else { return };
    let style: Style = if source.once_in(3) { make::style(source) } else { system.style.clone() };
    let (viewport, camera) = (make::viewport(source).within_limits(), make::camera(source));
    let quality = if source.once_in(2) { Quality::FINEST } else { Quality(source.between(0, 17) as u8) };
    let upto = make::upto(source);
    source.show(format_args!("{viewport:?} {camera:?} {quality:?} upto {upto:?}\n{style:?}"));
    gauge.allow(64 * viewport.width as usize * viewport.height as usize);
    let _ = (camera_axes(&camera), fitted_scale(&Figure::Space(drawing.clone()), viewport, &camera.into()));
    let mut renderer = SolidRenderer::new();
    gauge.call("load", || renderer.load(drawing.clone()));
    gauge.call("play", || renderer.play(upto));
    gauge.call("begin", || renderer.begin(&style, viewport, &camera, quality));
    if source.once_in(6) {
        renderer.hurry(source.part() as f32);
    }
    gauge.steps("picture", WORK, &mut renderer, SolidRenderer::step, SolidRenderer::spent);
    assert_eq!(renderer.pixels().len(), 4 * (viewport.width * viewport.height) as usize);
    gauge.reach("picture");
    // Panes of additive ink have the tone of all panes, which are counted before.
    if quality != Quality::FINEST || style.ink == Ink::Density || source.once_in(2) {
        return;
    }
    let mut whole = SolidRenderer::new();
    whole.load(drawing.clone());
    whole.play(upto);
    whole.begin(&style, viewport, &camera, quality);
    while whole.step(1_000_000) == Progress::More {}
    let whole = whole.pixels();
    let mut effort = Effort::new(quality, viewport);
    loop {
        let (mut spent, mut same) = (Spent::default(), true);
        for pane in SolidRenderer::panes(viewport) {
            gauge.call("begin pane", || {
                renderer.begin_pane(&style, viewport, &camera, (pane, Pass::Show), effort.budget());
            });
            gauge.steps("pane", WORK, &mut renderer, SolidRenderer::step, SolidRenderer::spent);
            spent.add(renderer.effort_spent());
            same &= is_part(renderer.pixels(), whole, pane, viewport.width);
        }
        if !effort.is_too_small(spent) {
            gauge.reach("panes");
            assert!(same, "the picture in panes differs from the whole");
            return;
        }
    }
}

/// Whether a pane's pixels equal those of the whole picture.
fn is_part(own: &[u8], whole: &[u8], pane: Pane, width: u32) -> bool {
    own.chunks_exact((4 * pane.width).max(1) as usize).enumerate().all(|(y, row)| {
        let at = 4 * ((pane.y as usize + y) * width as usize + pane.x as usize);
        &whole[at..at + row.len()] == row
    })
}
