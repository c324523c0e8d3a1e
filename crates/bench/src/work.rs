//! The measured systems, and the measured work of this library.

use lsystem::{Definition, Limits, SegmentArrays, System};

/// A system to derive and draw.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// The name in the tables.
    pub name: &'static str,
    /// The axiom.
    pub axiom: &'static str,
    /// The productions.
    pub rules: &'static [(char, &'static str)],
    /// The angle of turns, in degrees.
    pub angle: f64,
    /// The number of derivation steps.
    pub n: u32,
}

/// Four well-known systems, each with ten to thirty million symbols, so that the strings do not fit into the
/// processor's caches.
pub const WORKS: [Work; 4] = [
    Work { name: "plant", axiom: "X", rules: &[('X', "F+[[X]-X]-F[-FX]+X"), ('F', "FF")], angle: 25.0, n: 10 },
    Work { name: "Koch", axiom: "F", rules: &[('F', "F+F-F-F+F")], angle: 90.0, n: 10 },
    Work { name: "dragon", axiom: "F", rules: &[('F', "F+G"), ('G', "F-G")], angle: 90.0, n: 22 },
    Work { name: "Sierpinski", axiom: "F-G-G", rules: &[('F', "F-G+F+G-F"), ('G', "GG")], angle: 120.0, n: 14 },
];

/// Limits far above the measured work.
fn limits() -> Limits {
    Limits { symbols: 1 << 30, segments: 1 << 30, ..Limits::default() }
}

impl Work {
    /// The same work with four steps fewer, to compare results before measuring.
    #[must_use]
    pub fn shorter(self) -> Self {
        Self { n: self.n - 4, ..self }
    }

    /// The system for this library.
    #[must_use]
    pub fn system(&self) -> System {
        System::new(&self.definition()).expect("the measured systems are right")
    }

    /// The system as text.
    #[must_use]
    pub fn definition(&self) -> Definition {
        let rules: Vec<String> = self.rules.iter().map(|(symbol, text)| format!("{symbol} -> {text}")).collect();
        Definition {
            axiom: self.axiom.into(),
            rules: rules.join("\n"),
            angle: self.angle,
            iterations: self.n,
            ..Definition::default()
        }
    }
}

/// Memory that all runs reuse, because the first write to fresh memory costs more than the measured work.
#[derive(Debug, Default)]
pub struct Buffers {
    /// The string derived last.
    pub text: String,
    /// The segments written last.
    pub segments: SegmentArrays,
    copy: Vec<u8>,
    ends: Vec<f32>,
}

impl Buffers {
    /// Derives the string. Returns the number of symbols.
    pub fn expand(&mut self, system: &System, n: u32) -> u64 {
        lsystem::drawing::expand_into(system, n, &limits(), &mut self.text).expect("within the limits");
        self.text.len() as u64
    }

    /// Copies the string derived last. Returns the number of bytes.
    pub fn copy_text(&mut self) -> u64 {
        copy(self.text.as_bytes(), &mut self.copy)
    }

    /// Draws and writes all segments to memory. Returns the number of segments.
    pub fn draw(&mut self, system: &System, n: u32) -> u64 {
        let drawing = lsystem::draw(system, n, &limits()).expect("within the limits");
        drawing.write_segments(limits().segments, &mut self.segments).expect("within the limits");
        self.segments.levels.len() as u64
    }

    /// Draws and reads all segments in chunks. Returns the number of segments.
    pub fn draw_in_chunks(&mut self, system: &System, n: u32) -> u64 {
        let drawing = lsystem::draw(system, n, &limits()).expect("within the limits");
        let mut count = 0;
        drawing.for_each_chunk(|chunk| {
            core::hint::black_box(&chunk.ends);
            count += chunk.levels.len() as u64;
        });
        count
    }

    /// Copies the ends of the segments written last. Returns the number of segments.
    pub fn copy_segments(&mut self) -> u64 {
        copy(&self.segments.ends, &mut self.ends) / 4
    }
}

fn copy<T: Copy + Default>(from: &[T], to: &mut Vec<T>) -> u64 {
    to.resize(to.len().max(from.len()), T::default());
    to[..from.len()].copy_from_slice(from);
    core::hint::black_box(&to);
    from.len() as u64
}
