//! Equal input gives equal bits natively and in the browser. `cargo xtask test wasm` runs this file natively, where it
//! writes digests into the file that `LSYSTEM_SAME_BITS_FILE` names, and then compiles it for the browser with these
//! digests in `LSYSTEM_SAME_BITS`. The browser computes its own and compares. No digest is committed: a digest cannot
//! tell whether a picture is right, only whether two pictures are the same.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_dedicated_worker);

use lsystem::derive::Key;
use lsystem::drawing::Outlook;
use lsystem::files::SvgForm;
use lsystem::render::{Detail, Quality};
use lsystem::syntax::Ink;
use lsystem::{
    Camera, Definition, Limits, Mesh, Plane, Progress, Renderer, SegmentArrays, Solid, SolidRenderer, Style,
    SvgOptions, System, View, Viewport, draw, expand, read_json, write_csv, write_glb, write_obj, write_svg,
};
use std::fmt::Write as _;
use std::sync::Arc;

/// Files of the gallery that together use every kind of arithmetic, with the generation to draw.
const CORPUS: [(&str, &str, u32); 14] = [
    ("abop/1.24b", include_str!("../../../data_in/abop/1.24b.json"), 6),
    ("abop/1.24c", include_str!("../../../data_in/abop/1.24c.json"), 5),
    ("abop/1.24d", include_str!("../../../data_in/abop/1.24d.json"), 9),
    ("abop/1.24f", include_str!("../../../data_in/abop/1.24f.json"), 7),
    ("abop/1.27", include_str!("../../../data_in/abop/1.27.json"), 7),
    ("assignment-8/stochastic_02", include_str!("../../../data_in/assignment-8/stochastic_02.json"), 6),
    ("curves/gosper", include_str!("../../../data_in/curves/gosper.json"), 5),
    ("curves/penrose", include_str!("../../../data_in/curves/penrose.json"), 5),
    ("garden/elbow-room", include_str!("../../../data_in/garden/elbow-room.json"), 34),
    ("garden/meadow", include_str!("../../../data_in/garden/meadow.json"), 6),
    ("garden/vine-letter", include_str!("../../../data_in/garden/vine-letter.json"), 70),
    ("practical-1/tree1", include_str!("../../../data_in/practical-1/tree1.json"), 5),
    ("practical-1/tree5", include_str!("../../../data_in/practical-1/tree5.json"), 5),
    ("turtle-blog/1.24e", include_str!("../../../data_in/turtle-blog/1.24e.json"), 7),
];

/// Files that leave the plane: with shared blocks, with `$`, with a tropism, with additive ink, with queries, shapes and light.
const SOLID: [(&str, &str, u32); 10] = [
    ("abop/1.19", include_str!("../../../data_in/abop/1.19.json"), 3),
    ("abop/1.25", include_str!("../../../data_in/abop/1.25.json"), 6),
    ("abop/2.6a", include_str!("../../../data_in/abop/2.6a.json"), 9),
    ("abop/2.8c", include_str!("../../../data_in/abop/2.8c.json"), 6),
    ("practical-1/tree3d1", include_str!("../../../data_in/practical-1/tree3d1.json"), 3),
    ("garden/ivy-trellis", include_str!("../../../data_in/garden/ivy-trellis.json"), 74),
    ("garden/jellyfish", include_str!("../../../data_in/garden/jellyfish.json"), 9),
    ("garden/topiary-ball", include_str!("../../../data_in/garden/topiary-ball.json"), 8),
    ("garden/two-trees", include_str!("../../../data_in/garden/two-trees.json"), 20),
    (
        "trees-and-turtles/of-trees-and-turtles",
        include_str!("../../../data_in/trees-and-turtles/of-trees-and-turtles.json"),
        9,
    ),
];

/// Files with additive ink: in one colour, in several, and with haze in place of too much detail.
const DENSITY: [(&str, &str, f64); 4] = [
    ("garden/levy-lace", include_str!("../../../data_in/garden/levy-lace.json"), 1.0),
    ("garden/levy-tapestry", include_str!("../../../data_in/garden/levy-tapestry.json"), 7.3),
    ("garden/smoke-bush", include_str!("../../../data_in/garden/smoke-bush.json"), 1.0),
    ("garden/smoke-bush", include_str!("../../../data_in/garden/smoke-bush.json"), 3e5),
];

/// The digests of the browser are those of the native run that came before.
#[cfg(target_arch = "wasm32")]
mod compared {
    use super::*;
    use wasm_bindgen_test::wasm_bindgen_test;

    /// The digests of the native run.
    const NATIVE: Option<&str> = option_env!("LSYSTEM_SAME_BITS");

    /// Compares the lines that begin with the same word as those found.
    fn compare(found: &str) {
        let native = NATIVE.expect("not compared, because the native digests are missing: run `cargo xtask test wasm`");
        let corpus = found.split(' ').next().unwrap();
        let lines = native.lines().filter(|line| line.split(' ').next() == Some(corpus));
        assert_eq!(found.lines().collect::<Vec<_>>(), lines.collect::<Vec<_>>());
    }

    #[wasm_bindgen_test]
    fn the_corpus() {
        compare(&plane());
    }

    #[wasm_bindgen_test]
    fn the_corpus_in_space() {
        compare(&solid());
    }

    #[wasm_bindgen_test]
    fn the_corpus_where_ink_adds_up() {
        compare(&density());
    }
}

/// Writes the digests for the browser, if the environment names a file for them.
#[cfg(not(target_arch = "wasm32"))]
#[test]
fn the_digests_for_the_browser_are_made() {
    let all = [plane(), solid(), density()].concat();
    assert_eq!(all.lines().count(), CORPUS.len() + SOLID.len() + DENSITY.len());
    if let Some(path) = std::env::var_os("LSYSTEM_SAME_BITS_FILE") {
        std::fs::write(&path, all).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}

/// The digests of [`DENSITY`].
fn density() -> String {
    let mut found = String::new();
    for (name, file, zoom) in DENSITY {
        let definition = read_json(file).0.unwrap_or_default();
        let system = compiled(&definition);
        let mut renderer = Renderer::new();
        renderer.load(Arc::new(draw::<Plane>(&system, definition.iterations, &Limits::default()).unwrap()));
        let mut pixels = Digest::new();
        let details = [Detail::Sketch, Detail::Coarse, Detail::Fine];
        for (ink, detail) in [Ink::Density, Ink::Auto].into_iter().flat_map(|ink| details.map(|detail| (ink, detail))) {
            let style = Style { ink, ..system.style.clone() };
            let view = View { x: 0.01, y: -0.02, zoom, ..View::default() };
            let viewport = Viewport { width: 240, height: 180, ratio: 1.0 };
            renderer.begin_with(&style, viewport, view, detail, None);
            while renderer.step(10_000) == Progress::More {}
            pixels.bytes(renderer.pixels());
        }
        writeln!(found, "density {name} {zoom} pixels {:016x}", pixels.0).unwrap();
    }
    found
}

/// The digests of [`SOLID`].
fn solid() -> String {
    let mut found = String::new();
    for (name, file, n) in SOLID {
        let system = compiled(&read_json(file).0.unwrap_or_default());
        let drawing = draw::<Solid>(&system, n, &Limits::default()).unwrap();
        let mut segments = Digest::new();
        for segment in drawing.segments() {
            segments.numbers(segment.from.iter().chain(&segment.to).chain(&[segment.width]).map(|v| v.to_bits()));
            segments.numbers([segment.colour as u64, u64::from(segment.level)]);
        }
        segments.numbers(drawing.bounds().unwrap_or_default().iter().flatten().map(|v| v.to_bits()));
        let mut files = Digest::new();
        let mesh = Mesh::new(&drawing, &system.style, u64::MAX).unwrap();
        files.bytes(&write_glb(&drawing, &system.style, u64::MAX, name).unwrap());
        files.bytes(write_obj(&mesh, name).as_bytes());
        let seen = drawing.seen_from(&Outlook::default(), u64::MAX).unwrap();
        files.bytes(write_svg(&seen, &system.style, &SvgOptions::default()).unwrap().text.as_bytes());
        files.bytes(write_csv(&drawing, u64::MAX).unwrap().as_bytes());
        let mut renderer = SolidRenderer::new();
        renderer.load(Arc::new(drawing));
        let mut pixels = Digest::new();
        for (quality, zoom) in [(Quality(3), 1.0), (Quality::FINEST, 1.0), (Quality::FINEST, 4.0)] {
            let camera = Camera { zoom, fade: 0.3, ..Camera::default() };
            renderer.begin(&system.style, Viewport { width: 240, height: 180, ratio: 1.0 }, &camera, quality);
            while renderer.step(100_000) == Progress::More {}
            pixels.bytes(renderer.pixels());
        }
        let [segments, pixels, files] = [segments, pixels, files].map(|digest| digest.0);
        writeln!(found, "space {name} n={n} segments {segments:016x} pixels {pixels:016x} files {files:016x}").unwrap();
    }
    found
}

/// The digests of [`CORPUS`].
fn plane() -> String {
    let mut found = String::new();
    for (name, file, n) in CORPUS {
        let system = compiled(&read_json(file).0.unwrap_or_default());
        let text = expand(&system, n, &Limits::default()).unwrap();
        let drawing = Arc::new(draw::<Plane>(&system, n, &Limits::default()).unwrap());
        let mut segments = Digest::new();
        for segment in drawing.segments() {
            segments.numbers(segment.from.iter().chain(&segment.to).chain(&[segment.width]).map(|v| v.to_bits()));
            segments.numbers([segment.colour as u64, u64::from(segment.level)]);
        }
        let mut arrays = SegmentArrays::default();
        drawing.write_segments(u64::MAX, &mut arrays).unwrap();
        segments.numbers(arrays.ends.iter().map(|v| u64::from(v.to_bits())));
        segments.numbers(drawing.bounds().unwrap_or_default().map(f64::to_bits));

        let mut renderer = Renderer::new();
        renderer.load(drawing.clone());
        let mut pixels = Digest::new();
        let style = Style { ink: Ink::Solid, ..system.style.clone() };
        for zoom in [1.0, 7.3] {
            let view = View { x: 0.01, y: -0.02, zoom, ..View::default() };
            renderer.begin(&style, Viewport { width: 240, height: 180, ratio: 1.0 }, view);
            while renderer.step(10_000) == Progress::More {}
            pixels.bytes(renderer.pixels());
        }
        let mut files = Digest::new();
        for form in [SvgForm::Flat, SvgForm::Compact] {
            let options = SvgOptions { form, ..SvgOptions::default() };
            files.bytes(write_svg(&drawing, &system.style, &options).unwrap().text.as_bytes());
        }
        files.bytes(write_csv(&drawing, u64::MAX).unwrap().as_bytes());
        let mut string = Digest::new();
        string.bytes(text.as_bytes());
        let [string, segments, pixels, files] = [string, segments, pixels, files].map(|digest| digest.0);
        writeln!(
            found,
            "plane {name} n={n} string {string:016x} segments {segments:016x} pixels {pixels:016x} files {files:016x}"
        )
        .unwrap();
    }
    found
}

fn compiled(definition: &Definition) -> System {
    System::new(definition).unwrap()
}

/// The hash FNV-1a (Fowler, Noll and Vo): different results collide only by intent.
struct Digest(u64);

impl Digest {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn numbers(&mut self, numbers: impl IntoIterator<Item = u64>) {
        for number in numbers {
            self.bytes(&number.to_le_bytes());
        }
    }
}

#[test]
fn random_choices() {
    let key = Key::root(3).child(1, 2).child(2, 70_000);
    assert_eq!(
        [key.choice(0, 3).to_bits(), key.choice(u32::MAX, 1_000).to_bits()],
        [4_581_066_371_364_772_960, 4_586_746_024_706_360_656]
    );
}
