//! The cost of writing files: the work and the bytes of steps.

use super::drawing::{LIMITS, Largest, finished};
use super::systems::cases;
use lsystem::drawing::{MeshMaker, MeshOptions, Outlook, Projection};
use lsystem::files::{CsvWriter, GlbWriter, ObjWriter, SvgForm, SvgWriter};
use lsystem::syntax::Meter;
use lsystem::{Definition, Drawer, Drawing, Plane, Progress, Solid, SvgOptions, System, draw};

/// The units of work of a step.
const SHARE: u64 = 1 << 14;
/// The most bytes of a unit of work: a number has at most 25 bytes, and a mark of 8 units has at most eight numbers and
/// some words of XML.
const BYTES: u64 = 32;
/// The most segments of a file in these tests.
const MOST: u64 = 100_000;

/// Runs all steps, and checks the bytes of each step against its work.
fn see(largest: &mut Largest, name: &str, mut step: impl FnMut(&mut String) -> (Progress, u64)) {
    let (mut before, mut progress) = (0, Progress::More);
    while progress == Progress::More {
        let mut text = String::new();
        let spent;
        (progress, spent) = step(&mut text);
        largest.see(spent - before, || name.to_owned());
        assert!(text.len() as u64 <= 4096 + BYTES * (spent - before), "{name}");
        before = spent;
    }
}

fn see_svg(largest: &mut Largest, name: &str, drawing: &Drawing, definition: &Definition, form: SvgForm) {
    let (style, options) = (&definition.style, SvgOptions { most: MOST, form, ..SvgOptions::default() });
    let Ok(mut writer) = SvgWriter::new(drawing, style, &options) else { return };
    see(largest, name, |text| {
        let progress = writer.step(drawing, style, text, SHARE);
        (progress.unwrap_or(Progress::Done), writer.spent())
    });
}

/// The projected drawing; `None` if it is too large.
fn see_projection(largest: &mut Largest, name: &str, drawing: &Drawing<Solid>) -> Option<Drawing> {
    let mut projection = Projection::new(drawing, &Outlook::default(), MOST).ok()?;
    see(largest, name, |_| (projection.step(drawing, SHARE), projection.spent()));
    Some(projection.finish(drawing))
}

fn print(all: &[(&str, &Largest)]) {
    for (name, largest) in all {
        println!(
            "{name}: {} units beyond a share of {SHARE} at most ({})",
            largest.most.saturating_sub(SHARE),
            largest.name
        );
        assert!(largest.most <= SHARE + Meter::PIECE, "{name}: {} {}", largest.most, largest.name);
    }
}

#[test]
fn no_step_of_a_writer_takes_more_than_its_share_and_a_piece() {
    let (mut csv, mut svg, mut compact) = (Largest::default(), Largest::default(), Largest::default());
    for length in [1, 100, 10_000] {
        for case in cases(length) {
            let system = case.system();
            for n in [0, 1, 12, 40] {
                if system.is_solid() {
                    continue;
                }
                let Some(drawing) = finished(Drawer::<Plane>::new(&system, n, LIMITS)) else { continue };
                let name = format!("{}, n = {n}", case.name);
                if let Ok(mut writer) = CsvWriter::new(&drawing, MOST) {
                    see(&mut csv, &name, |text| (writer.step(&drawing, text, SHARE), writer.spent()));
                }
                see_svg(&mut svg, &name, &drawing, &case.definition, SvgForm::Flat);
                see_svg(&mut compact, &name, &drawing, &case.definition, SvgForm::Compact);
            }
        }
    }
    print(&[("csv", &csv), ("svg", &svg), ("compact svg", &compact)]);
}

#[test]
fn no_step_of_a_projection_takes_more_than_its_share_and_a_piece() {
    let (mut projection, mut svg) = (Largest::default(), Largest::default());
    for length in [1, 100, 10_000] {
        for case in cases(length) {
            let system = case.system();
            for n in [0, 3, 12] {
                let Some(drawing) = finished(Drawer::<Solid>::new(&system, n, LIMITS)) else { continue };
                let name = format!("{}, n = {n}", case.name);
                let Some(seen) = see_projection(&mut projection, &name, &drawing) else { continue };
                see_svg(&mut svg, &name, &seen, &case.definition, SvgForm::Flat);
            }
        }
    }
    print(&[("projection", &projection), ("svg of a projection", &svg)]);
}

#[test]
fn polygons_of_many_vertices_are_written_in_steps() {
    let rules = format!("G -> {{{}}}", "F+".repeat(24_990));
    let definition = Definition { axiom: "G".into(), rules, angle: 0.01, ..Definition::default() };
    let system = System::new(&definition).0.unwrap();
    let plane = draw::<Plane>(&system, 1, &LIMITS).unwrap();
    let solid = draw::<Solid>(&system, 1, &LIMITS).unwrap();
    assert!(plane.is_memoised() && plane.polygon_count() == 1);
    let (mut svg, mut projection) = (Largest::default(), Largest::default());
    for form in [SvgForm::Flat, SvgForm::Compact] {
        see_svg(&mut svg, "a polygon", &plane, &definition, form);
    }
    let seen = see_projection(&mut projection, "a polygon", &solid).unwrap();
    see_svg(&mut svg, "a polygon on paper", &seen, &definition, SvgForm::Flat);
    print(&[("svg of a polygon", &svg), ("projection of a polygon", &projection)]);
}

#[test]
fn no_step_of_a_mesh_takes_more_than_its_share_and_a_piece() {
    let (mut tubes, mut obj, mut glb) = (Largest::default(), Largest::default(), Largest::default());
    for length in [1, 100, 10_000] {
        for case in cases(length) {
            let system = case.system();
            let Some(drawing) = finished(Drawer::<Solid>::new(&system, 3, LIMITS)) else { continue };
            let name = || case.name.clone();
            let style = &case.definition.style;
            let options = MeshOptions { most: MOST, memory: 64 << 20, ..MeshOptions::default() };
            let Ok(mut maker) = MeshMaker::new(&drawing, style, &options) else { continue };
            let mut before = 0;
            let made = loop {
                let progress = maker.step(&drawing, style, SHARE);
                tubes.see(maker.spent() - before, name);
                before = maker.spent();
                match progress {
                    Ok(Progress::More) => {}
                    Ok(Progress::Done) => break true,
                    Err(_) => break false,
                }
            };
            let mesh = maker.finish();
            assert!(made || mesh.bytes() == 0, "{}", case.name);
            let mut text = ObjWriter::new(&mesh, "");
            let file = GlbWriter::new(&drawing, style, MOST, 64 << 20, "");
            let steps = |largest: &mut Largest, step: &mut dyn FnMut() -> (Progress, u64, usize)| {
                let mut before = 0;
                loop {
                    let (progress, spent, bytes) = step();
                    largest.see(spent - before, name);
                    assert!(bytes as u64 <= 4096 + BYTES * (spent - before), "{}", case.name);
                    before = spent;
                    if progress == Progress::Done {
                        break;
                    }
                }
            };
            steps(&mut obj, &mut || {
                let mut piece = String::new();
                (text.step(&mesh, &mut piece, SHARE), text.spent(), piece.len())
            });
            let Ok(mut file) = file else { continue };
            let mut before = 0;
            loop {
                let mut piece = Vec::new();
                let progress = file.step(&drawing, style, &mut piece, SHARE);
                glb.see(file.spent() - before, name);
                assert!(piece.len() as u64 <= 4096 + BYTES * (file.spent() - before), "{}", case.name);
                before = file.spent();
                if progress != Ok(Progress::More) {
                    break;
                }
            }
        }
    }
    for (name, largest) in [("mesh", tubes), ("obj", obj), ("glb", glb)] {
        println!("{name}: {} units at most ({})", largest.most, largest.name);
        assert!(largest.most <= SHARE + Meter::PIECE, "{name}: {} {}", largest.most, largest.name);
    }
}
