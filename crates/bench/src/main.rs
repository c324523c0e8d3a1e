//! `bench` measures natively and prints tables. `bench FILE` prints tables of results from a browser.

#[cfg(not(target_arch = "wasm32"))]
mod peers;

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    match std::env::args_os().nth(1) {
        None => print!("{}", bench::tables(&native::measure(), "native")),
        Some(file) => {
            let rows = std::fs::read(&file).expect("the file of results can be read");
            print!("{}", bench::tables(&serde_json::from_slice::<Vec<bench::Row>>(&rows).expect("results"), "browser"));
        }
    }
}

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
mod native {
    use crate::peers;
    use bench::{Buffers, GROWTHS, Growth, Row, WORKS, Work};
    use lsystem::Definition;
    use lsystem::course::{Exercise, Marker};
    use std::hint::black_box;
    use std::time::{Duration, Instant};

    const EXPANSION: &str = "expansion, symbols/s";
    const DRAWING: &str = "drawing, segments/s";
    const MARKING: &str = "marking, answers/s";
    /// The generation of the targets of exercises.
    const MARKED: u32 = 6;

    pub(crate) fn measure() -> Vec<Row> {
        let mut rows = vec![];
        let mut buffers = Buffers::default();
        for work in &WORKS {
            compare(&work.shorter(), &mut buffers);
            expansion(work, &mut buffers, &mut rows);
        }
        for work in &WORKS {
            drawing(work, &mut buffers, &mut rows);
        }
        for growth in GROWTHS.iter() {
            derivation(growth, &mut rows);
        }
        for work in &WORKS {
            marking(&Work { n: MARKED, ..*work }, &mut rows);
        }
        rows
    }

    /// Marks of answers: rules with turns that cancel give the same picture, rules with doubled turns another one.
    fn marking(work: &Work, rows: &mut Vec<Row>) {
        let target = work.definition();
        let mut marker = Marker::new(Exercise { target: target.clone(), ..Exercise::default() }).expect("a target");
        for (who, turn) in [("ours, the same picture", "+-+"), ("ours, another picture", "++")] {
            let answer = Definition { rules: target.rules.replace('+', turn), ..target.clone() };
            let mut mark = || u64::from(!marker.mark(&answer).words.is_empty());
            rows.push(best(MARKING, &name(work.name, work.n), who, &mut mark));
        }
    }

    /// Checks that peers give the same results.
    fn compare(work: &Work, buffers: &mut Buffers) {
        buffers.expand(&work.system(), work.n);
        assert_eq!(peers::lindenmayer(work).string(work.n as usize), buffers.text);
        let (mut system, _) = peers::dcc(work);
        system.step_by(work.n as usize);
        assert_eq!(system.render(), buffers.text);
        assert_eq!(peers::dcc_lines(work, &system), buffers.draw(&work.system(), work.n));
    }

    fn expansion(work: &Work, buffers: &mut Buffers, rows: &mut Vec<Row>) {
        let name = name(work.name, work.n);
        let mut add = |who: &str, run: &mut dyn FnMut() -> u64| rows.push(best(EXPANSION, &name, who, run));
        let system = work.system();
        add("ours", &mut || buffers.expand(&system, work.n));
        add("copy", &mut || buffers.copy_text());
        let peer = peers::lindenmayer(work);
        add("lindenmayer 0.3", &mut || black_box(peer.string(work.n as usize)).len() as u64);
        let (mut peer, _) = peers::dcc(work);
        add("dcc-lsystem 0.6", &mut || {
            peer.reset();
            peer.step_by(work.n as usize);
            peer.get_state().len() as u64
        });
    }

    /// Measures drawing. The peer derives before the measurement, so its time is only for drawing.
    fn drawing(work: &Work, buffers: &mut Buffers, rows: &mut Vec<Row>) {
        let name = name(work.name, work.n);
        let mut add = |who: &str, run: &mut dyn FnMut() -> u64| rows.push(best(DRAWING, &name, who, run));
        let system = work.system();
        add("ours", &mut || buffers.draw(&system, work.n));
        add("ours, in chunks", &mut || buffers.draw_in_chunks(&system, work.n));
        add("copy", &mut || buffers.copy_segments());
        let (mut peer, _) = peers::dcc(work);
        peer.step_by(work.n as usize);
        add("dcc-lsystem 0.6", &mut || peers::dcc_lines(work, &peer));
    }

    /// Measures derivation. Only one peer supports parameters, and none supports contexts in the same way.
    fn derivation(growth: &Growth, rows: &mut Vec<Row>) {
        let name = name(&growth.name, growth.n);
        let mut add = |who: &str, run: &mut dyn FnMut() -> u64| rows.push(best(&growth.what, &name, who, run));
        let rules = growth.compile();
        add("ours", &mut || growth.derive(&rules));
        if growth.name == "2.6a" {
            let tree = peers::tree();
            add("lindenmayer-system 0.3", &mut || peers::derive_tree(&tree, growth.n, growth.modules));
        }
    }

    fn name(work: &str, n: u32) -> String {
        format!("{work}, n = {n}")
    }

    /// The best of at least three batches and half a second, because disturbances only make a run slower. A batch takes
    /// at least 20 ms, as in the browser.
    fn best(what: &str, work: &str, who: &str, run: &mut dyn FnMut() -> u64) -> Row {
        let begin = Instant::now();
        let (mut batches, mut seconds, mut amount) = (0, f64::INFINITY, 0);
        while batches < 3 || begin.elapsed() < Duration::from_millis(500) {
            let start = Instant::now();
            let (mut runs, mut taken) = (0, 0.0);
            while taken < 0.02 {
                amount = run();
                runs += 1;
                taken = start.elapsed().as_secs_f64();
            }
            seconds = seconds.min(taken / f64::from(runs));
            batches += 1;
        }
        Row { what: what.into(), work: work.into(), who: who.into(), amount, seconds }
    }
}
