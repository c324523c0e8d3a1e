//! Files: what steps of writers cost, in work and in bytes.

use super::drawing::{LIMITS, Largest, finished};
use super::systems::cases;
use lsystem::drawing::MeshMaker;
use lsystem::files::{CsvWriter, GlbWriter, ObjWriter, SvgWriter};
use lsystem::syntax::Meter;
use lsystem::{Drawer, Progress, SvgOptions};

/// Units that a step may do.
const SHARE: u64 = 1 << 14;
/// Bytes that a unit of work may write: a number has at most 25, and a mark of 8 units at most eight of them and some
/// words of XML.
const BYTES: u64 = 32;
/// Segments that are written in these tests.
const MOST: u64 = 100_000;

#[test]
fn no_step_of_a_writer_takes_more_than_its_share_and_a_piece() {
    let (mut csv, mut svg) = (Largest::default(), Largest::default());
    for length in [1, 100, 10_000] {
        for case in cases(length) {
            let system = case.system();
            for n in [0, 1, 12] {
                if system.is_solid() {
                    continue;
                }
                let Some(drawing) = finished(Drawer::new(&system, n, LIMITS)) else { continue };
                let name = || format!("{}, n = {n}", case.name);
                let see = |largest: &mut Largest, step: &mut dyn FnMut(&mut String) -> (Progress, u64)| {
                    let mut before = 0;
                    loop {
                        let mut text = String::new();
                        let (progress, spent) = step(&mut text);
                        largest.see(spent - before, name);
                        assert!(text.len() as u64 <= 4096 + BYTES * (spent - before), "{}", name());
                        before = spent;
                        if progress == Progress::Done {
                            break;
                        }
                    }
                };
                if let Ok(mut writer) = CsvWriter::new(&drawing, MOST) {
                    see(&mut csv, &mut |text| (writer.step(&drawing, text, SHARE), writer.spent()));
                }
                let (style, options) = (&case.definition.style, SvgOptions { most: MOST, ..SvgOptions::default() });
                if let Ok(mut writer) = SvgWriter::new(&drawing, style, &options) {
                    see(&mut svg, &mut |text| (writer.step(&drawing, style, text, SHARE), writer.spent()));
                }
            }
        }
    }
    for (name, largest) in [("csv", csv), ("svg", svg)] {
        println!(
            "{name}: {} units beyond a share of {SHARE} at most ({})",
            largest.most.saturating_sub(SHARE),
            largest.name
        );
        assert!(largest.most <= SHARE + Meter::PIECE, "{} {}", largest.most, largest.name);
    }
}

#[test]
fn no_step_of_a_mesh_takes_more_than_its_share_and_a_piece() {
    let (mut tubes, mut obj, mut glb) = (Largest::default(), Largest::default(), Largest::default());
    for length in [1, 100, 10_000] {
        for case in cases(length) {
            let system = case.system();
            let Some(drawing) = finished(Drawer::solid(&system, 3, LIMITS)) else { continue };
            let name = || case.name.clone();
            let style = &case.definition.style;
            let Ok(mut maker) = MeshMaker::new(&drawing, style, MOST, 64 << 20) else { continue };
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
            let (mut text, mut file) = (ObjWriter::new(&mesh, ""), GlbWriter::new(&mesh, ""));
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
            steps(&mut glb, &mut || {
                let mut piece = Vec::new();
                (file.step(&mesh, &mut piece, SHARE), file.spent(), piece.len())
            });
        }
    }
    for (name, largest) in [("mesh", tubes), ("obj", obj), ("glb", glb)] {
        println!("{name}: {} units at most ({})", largest.most, largest.name);
        assert!(largest.most <= SHARE + Meter::PIECE, "{name}: {} {}", largest.most, largest.name);
    }
}
