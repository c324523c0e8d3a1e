//! The cost of writing files: the work and the bytes between two calls of their owner.

use super::drawing::{LIMITS, Largest, finished};
use super::systems::cases;
use lsystem::base::Meter;
use lsystem::drawing::{Outlook, Projection};
use lsystem::files::{Content, FileOptions, Format, Owner, Sink};
use lsystem::syntax::Halt;
use lsystem::{Definition, Drawer, Drawing, Plane, Progress, Solid, System, draw};
use std::sync::Arc;
use test_effort::sampled;

/// The units of work between two calls.
const SHARE: u64 = 1 << 14;
/// The most bytes of a unit of work: a number has at most 25 bytes, and a mark of 8 units has at most eight numbers and
/// some words of XML.
const BYTES: u64 = 32;
/// The most segments of a file in these tests.
const MAX: u64 = 100_000;

/// An owner that checks the bytes of each piece against its work.
struct Checked<'a> {
    largest: &'a mut Largest,
    name: &'a str,
    bytes: u64,
}

impl Owner for Checked<'_> {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.bytes += bytes.len() as u64;
        Ok(())
    }

    fn spent(&mut self, units: u64) -> Result<(), Halt> {
        self.largest.see(units, || self.name.to_owned());
        assert!(self.bytes <= 4096 + BYTES * units, "{}: {} bytes of {units} units", self.name, self.bytes);
        self.bytes = 0;
        Ok(())
    }
}

fn options() -> FileOptions {
    FileOptions { most: MAX, memory: 64 << 20, ..FileOptions::default() }
}

fn see(largest: &mut Largest, name: &str, write: impl FnOnce(&mut Sink<'_>) -> Result<(), Halt>) {
    let halt = Sink::to(&mut Checked { largest, name, bytes: 0 }, write);
    assert_ne!(halt, Err(Halt::Stopped));
}

fn see_paper(largest: &mut Largest, format: &str, name: &str, drawing: &Arc<Drawing>, definition: &Definition) {
    let Content::Paper(write) = Format::named(format).unwrap().content else { panic!("{format}") };
    see(largest, name, |sink| write(drawing.clone(), &definition.style, &options(), sink).map(drop));
}

fn see_table(largest: &mut Largest, name: &str, drawing: &Drawing) {
    let Content::Segments { plane, .. } = Format::named("csv").unwrap().content else { panic!("csv") };
    see(largest, name, |sink| plane(drawing, MAX, sink));
}

/// The projected drawing; `None` if it is too large.
fn see_projection(largest: &mut Largest, name: &str, drawing: &Drawing<Solid>) -> Option<Arc<Drawing>> {
    let mut projection = Projection::new(drawing, &Outlook::default(), MAX).ok()?;
    let (mut before, mut progress) = (0, Progress::More);
    while progress == Progress::More {
        progress = projection.step(drawing, SHARE);
        largest.see(projection.spent() - before, || name.to_owned());
        before = projection.spent();
    }
    Some(projection.finish(drawing).into())
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
fn no_part_of_a_file_takes_more_than_its_share_and_a_piece() {
    let (mut csv, mut svg, mut compact) = (Largest::default(), Largest::default(), Largest::default());
    for (number, length) in [1, 100, 10_000].into_iter().enumerate() {
        for case in sampled(cases(length), 3, number) {
            let system = case.system();
            for n in [0, 1, 12, 40] {
                if system.is_solid() {
                    continue;
                }
                let Some(drawing) = finished(Drawer::<Plane>::new(&system, n, LIMITS)) else { continue };
                let name = format!("{}, n = {n}", case.name);
                let drawing = Arc::new(drawing);
                see_table(&mut csv, &name, &drawing);
                see_paper(&mut svg, "svg", &name, &drawing, &case.definition);
                see_paper(&mut compact, "svg-compact", &name, &drawing, &case.definition);
            }
        }
    }
    print(&[("csv", &csv), ("svg", &svg), ("compact svg", &compact)]);
}

#[test]
fn no_step_of_a_projection_takes_more_than_its_share_and_a_piece() {
    let (mut projection, mut svg) = (Largest::default(), Largest::default());
    for (number, length) in [1, 100, 10_000].into_iter().enumerate() {
        for case in sampled(cases(length), 3, number) {
            let system = case.system();
            for n in [0, 3, 12] {
                let Some(drawing) = finished(Drawer::<Solid>::new(&system, n, LIMITS)) else { continue };
                let name = format!("{}, n = {n}", case.name);
                let Some(seen) = see_projection(&mut projection, &name, &drawing) else { continue };
                see_paper(&mut svg, "svg", &name, &seen, &case.definition);
            }
        }
    }
    print(&[("projection", &projection), ("svg of a projection", &svg)]);
}

#[test]
fn polygons_of_many_vertices_are_counted() {
    let rules = format!("G -> {{{}}}", "F+".repeat(24_990));
    let definition = Definition { axiom: "G".into(), rules, angle: 0.01, ..Definition::default() };
    let system = System::new(&definition).unwrap();
    let plane = Arc::new(draw::<Plane>(&system, 1, &LIMITS).unwrap());
    let solid = draw::<Solid>(&system, 1, &LIMITS).unwrap();
    assert!(plane.is_memoised() && plane.polygon_count() == 1);
    let (mut svg, mut projection) = (Largest::default(), Largest::default());
    for format in ["svg", "svg-compact"] {
        see_paper(&mut svg, format, "a polygon", &plane, &definition);
    }
    let seen = see_projection(&mut projection, "a polygon", &solid).unwrap();
    see_paper(&mut svg, "svg", "a polygon on paper", &seen, &definition);
    print(&[("svg of a polygon", &svg), ("projection of a polygon", &projection)]);
}

#[test]
fn no_part_of_a_mesh_takes_more_than_its_share_and_a_piece() {
    let mut meshes = ["obj", "glb", "stl", "scad"].map(|format| (format, Largest::default()));
    for (number, length) in [1, 100, 10_000].into_iter().enumerate() {
        for case in sampled(cases(length), 3, number) {
            let Some(drawing) = finished(Drawer::<Solid>::new(&case.system(), 3, LIMITS)) else { continue };
            let drawing = Arc::new(drawing);
            for (format, largest) in &mut meshes {
                let Content::Mesh(write) = Format::named(format).unwrap().content else { panic!("{format}") };
                let style = &case.definition.style;
                see(largest, &case.name, |sink| write(drawing.clone(), style, &options(), sink).map(drop));
            }
        }
    }
    print(&meshes.each_ref().map(|(name, largest)| (*name, largest)));
}
