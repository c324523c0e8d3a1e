//! Timings of derivation and drawing, printed: `cargo bench -p bench --bench speed`.

use lsystem::derive::Rewriter;
use lsystem::drawing::{Outlook, expand_into};
use lsystem::{Definition, Dialect, Limits, Plane, SegmentArrays, Solid, System, draw};
use std::hint::black_box;
use std::time::Instant;

fn main() {
    deriving_at_random();
    building();
    building_in_space();
    materialising();
    emitting();
    deriving();
}

fn system(axiom: &str, rules: &str, angle: f64) -> System {
    let definition = Definition { axiom: axiom.into(), rules: rules.into(), angle, ..Definition::default() };
    System::new(&definition).unwrap()
}

fn samples() -> Vec<(&'static str, System, u32)> {
    vec![
        ("koch", system("F", "F -> F+F-F-F+F", 90.0), 10),
        ("plant", system("X", "X -> F+[[X]-X]-F[-FX]+X\nF -> FF", 22.5), 10),
        ("dragon", system("FX", "X -> X+YF+\nY -> -FX-Y", 90.0), 22),
        ("sierpinski", system("F-G-G", "F -> F-G+F+G-F\nG -> GG", 120.0), 14),
        ("bush", system("F", "F -> FF-[-F+F+F]+[+F-F-F]", 22.5), 8),
        ("plant 25.7", system("X", "X -> F[+X][-X]FX\nF -> FF", 25.7), 10),
        ("gosper", system("F", "F -> F-G--G+F++FF+G-\nG -> +F-GG--G-F++F+G", 60.0), 8),
        ("circles", system("F", "F -> F+F+F", 17.3), 8),
        ("spiral", system("A", "A -> F[+FA]+A", 7.3), 12),
    ]
}

fn deriving_at_random() {
    for (name, axiom, rules, n) in [
        ("all random", "F", "F -> F[+F]F[-F]F : 0.33\nF -> F[+F]F : 0.33\nF -> F[-F]F : 0.34", 11),
        ("half random", "X", "X -> F[+X]F[-X]X : 1\nX -> F[-X]X : 1\nF -> FF", 13),
    ] {
        let system = system(axiom, rules, 25.7);
        let mut text = String::new();
        let times = (0..7).map(|_| {
            let began = Instant::now();
            expand_into(&system, n, &Limits::default(), &mut text).unwrap();
            began.elapsed().as_secs_f64()
        });
        let best = times.fold(f64::INFINITY, f64::min);
        println!("{name:12} n = {n}: {} symbols, {:.1} M/s", text.len(), text.len() as f64 / best / 1e6);
    }
}

fn building() {
    for (name, system, _) in samples() {
        for n in [8, 40, 1000] {
            let began = Instant::now();
            let drawing = draw::<Plane>(&system, n, &Limits::default()).unwrap();
            let time = began.elapsed().as_secs_f64() * 1e3;
            let began = Instant::now();
            black_box(drawing.bounds());
            let bounds = began.elapsed().as_secs_f64() * 1e3;
            println!("{name:12} n = {n:4}: {time:8.3} ms, bounds {bounds:.3} ms, {} blocks", drawing.block_count());
        }
    }
}

fn building_in_space() {
    let bush = "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^-F+F+F-|-F+F+F]";
    let tree = Definition {
        axiom: "T".into(),
        rules: "T -> TF\nF -> F[+F][-FF][<F][>FF][&F]".into(),
        angle: 45.0,
        dialect: Dialect::Practical,
        ..Definition::default()
    };
    let honda = "A(l) -> F(l)[&(45)B(l*0.6)]/(137.5)A(l*0.9)\nB(l) -> F(l)[-(45)$C(l*0.6)]C(l*0.9)\n\
                 C(l) -> F(l)[+(45)$B(l*0.6)]B(l*0.9)";
    let random = "F -> F[&+F]/F[^F]F : 1\nF -> F[&F]\\F[-F] : 1";
    for (name, system, generations) in [
        ("tree3d0", System::new(&tree).unwrap(), vec![8, 12, 20, 30, 1000]),
        ("bush", system("A", bush, 22.5), vec![8, 12, 20, 30, 1000]),
        ("honda", system("A(1)", honda, 45.0), vec![14, 18]),
        ("random", system("F", random, 22.5), vec![9]),
    ] {
        for n in generations {
            let limits = Limits { segments: 3_000_000, ..Limits::default() };
            let began = Instant::now();
            let drawing = draw::<Solid>(&system, n, &limits).unwrap();
            let time = began.elapsed().as_secs_f64() * 1e3;
            let began = Instant::now();
            black_box(drawing.bounds());
            let bounds = began.elapsed().as_secs_f64() * 1e3;
            let began = Instant::now();
            let seen = drawing.seen_from(&Outlook::default(), 3_000_000).is_ok();
            let paper = began.elapsed().as_secs_f64() * 1e3;
            let (blocks, segments) = (drawing.block_count(), drawing.segment_count());
            println!("{name:8} n = {n:4}: {time:8.3} ms, bounds {bounds:.3} ms, {blocks} blocks, {segments} segments");
            if seen {
                println!("                    on paper in {paper:.1} ms");
            }
        }
    }
}

fn materialising() {
    for (name, rules) in [
        ("stochastic", "F -> F[+F]F[-F]F : 0.33\nF -> F[+F]F : 0.33\nF -> F[-F]F : 0.34"),
        ("unbalanced", "F -> F]F+[F-F"),
    ] {
        let system = system("F", rules, 25.7);
        let limits = Limits::default();
        let largest = (0..100).take_while(|&n| draw::<Plane>(&system, n, &limits).is_ok()).last().unwrap();
        let began = Instant::now();
        let drawing = draw::<Plane>(&system, largest, &limits).unwrap();
        let seconds = began.elapsed().as_secs_f64();
        let count = drawing.segment_count();
        println!("{name:12} n = {largest}: {count} segments, {:.1} M/s", count as f64 / seconds / 1e6);
        let began = Instant::now();
        let error = draw::<Plane>(&system, 1000, &limits).unwrap_err();
        println!("{:12} n = 1000 refused in {:.1} ms: {:?}", "", began.elapsed().as_secs_f64() * 1e3, error.kind);
    }
}

fn emitting() {
    let (mut arrays, mut source) = (SegmentArrays::default(), vec![]);
    for (name, system, n) in samples().into_iter().take(4) {
        let drawing = draw::<Plane>(&system, n, &Limits::default()).unwrap();
        let count = drawing.segment_count() as f64;
        drawing.write_segments(1 << 26, &mut arrays).unwrap();
        let rate = |work: &mut dyn FnMut()| {
            let best = (0..7).map(|_| {
                let began = Instant::now();
                work();
                began.elapsed().as_secs_f64()
            });
            count / best.fold(f64::INFINITY, f64::min) / 1e9
        };
        source.resize(arrays.ends.len(), 1.0);
        let into_buffer = rate(&mut || drawing.write_segments(1 << 26, &mut arrays).unwrap());
        let memcpy = rate(&mut || {
            arrays.ends.copy_from_slice(&source);
            arrays.colours.fill(1);
            arrays.levels.fill(1);
        });
        let mut seen = 0;
        let chunks = rate(&mut || drawing.for_each_chunk(|chunk| seen += black_box(chunk).levels.len()));
        let one_by_one = rate(&mut || assert!(drawing.segments().map(|s| s.to[0]).sum::<f64>().is_finite()));
        println!(
            "{name:12} n = {n:2}: {count:9} segments; G/s: into a buffer {into_buffer:.3}, memcpy and fill {memcpy:.3}, \
             by chunks {chunks:.3}, one by one {one_by_one:.3}"
        );
    }
}

fn deriving() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in/abop");
    let signals = lsystem::read_json(&std::fs::read_to_string(folder.join("1.31a.json")).unwrap()).0.unwrap();
    let honda = Definition {
        axiom: "A(1,10)".into(),
        rules: "r1 = 0.9\nr2 = 0.6\nw0 = 0.707\n\
                A(l,w) -> !(w)F(l)[&(45)B(l*r2,w*w0)]/(137.5)A(l*r1,w*w0)\n\
                B(l,w) -> !(w)F(l)[-(45)$C(l*r2,w*w0)]C(l*r1,w*w0)\n\
                C(l,w) -> !(w)F(l)[+(45)$B(l*r2,w*w0)]B(l*r1,w*w0)"
            .into(),
        ..Definition::default()
    };
    for (name, definition, n) in [("1.31a", signals, 60), ("2.6 a", honda, 17)] {
        let rules = System::new(&definition).unwrap().rules;
        for _ in 0..8 {
            let mut rewriter = Rewriter::new(rules.clone(), 0, Limits::default()).unwrap();
            let (began, mut read) = (Instant::now(), 0);
            while rewriter.generation() < n {
                read += rewriter.word().letters.len();
                rewriter.step(usize::MAX).unwrap();
            }
            let (seconds, made) = (began.elapsed().as_secs_f64(), rewriter.word().letters.len());
            println!(
                "{name}: {made} at n = {n} in {:.0} ms, {:.0} M steps/s",
                seconds * 1e3,
                read as f64 / seconds / 1e6
            );
        }
    }
}
