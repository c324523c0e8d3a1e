//! Drawings and files of unusual systems that once took without end or gave wrong pictures.

use lsystem::base::{LimitName, MAX_FILE, Meter};
use lsystem::drawing::{Outlook, expand_symbol};
use lsystem::files::SvgForm;
use lsystem::render::{Detail, Effort, Pass, Pointer, Quality, Spent};
use lsystem::syntax::{ColourBy, Expected, Ink, Kind};
use lsystem::{
    Camera, Definition, Drawer, Figure, Limits, Mesh, Plane, Progress, Renderer, Solid, SolidRenderer, Style,
    SvgOptions, System, Vantage, View, Viewport, draw, pick, read_file, read_json, write_csv, write_json, write_svg,
};
use std::sync::Arc;

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|diagnostics| panic!("{diagnostics:?}"))
}

fn turning(count: usize, angle: f64) -> Definition {
    Definition { axiom: "F".into(), rules: format!("F -> {}", "F+".repeat(count)), angle, ..Definition::default() }
}

#[test]
fn crowded_hulls_end() {
    for (count, angle, n) in
        [(8192, 89.999_999, 1), (8192, 30.000_000_246, 1), (12_000, 60.000_000_083, 1), (2000, 180.000_001_189, 2)]
    {
        let drawing = draw::<Plane>(&system(&turning(count, angle)), n, &Limits::default()).unwrap();
        assert_eq!(drawing.segment_count(), (count as u128).pow(n));
        let bounds = drawing.bounds().unwrap();
        let ends = drawing.segments().take(100_000).flat_map(|segment| [segment.from, segment.to]);
        for [x, y] in ends {
            assert!(bounds[0] - 1e-6 <= x && x <= bounds[2] + 1e-6 && bounds[1] - 1e-6 <= y && y <= bounds[3] + 1e-6);
        }
    }
}

/// The extent does not depend on the size of steps, and takes a bounded number of units.
#[test]
fn extents_take_a_bounded_effort() {
    let definition = Definition { growth: 0.999_999, angle: -90.0, ..turning(2048, 90.0) };
    let system = system(&definition);
    let mut all = vec![];
    for share in [10_000, 1 << 20] {
        let mut drawer = Drawer::<Plane>::new(&system, 8, Limits::default());
        let mut before = 0;
        while drawer.step(share) == Progress::More {
            assert!(drawer.spent() - before <= share + Meter::PIECE);
            before = drawer.spent();
        }
        assert!(drawer.spent() < 20_000_000, "{}", drawer.spent());
        all.push(drawer.finish().unwrap().bounds().unwrap().map(f64::to_bits));
    }
    assert_eq!(all[0], all[1]);
}

#[test]
fn long_words_of_modules_are_drawn_in_steps() {
    let definition = Definition {
        axiom: "FF[A(2)FFF]FF".into(),
        rules: format!("r = 0.75\nF -> FF-{}\nA -> FFFFFFFFFFF", "FA".repeat(2000)),
        angle: 36.0,
        ..Definition::default()
    };
    let system = system(&definition);
    let mut all = vec![];
    for share in [1, 16_384, 1 << 40] {
        let mut drawer = Drawer::<Plane>::new(&system, 8, Limits::default());
        let mut before = 0;
        while drawer.step(share) == Progress::More {
            assert!(drawer.spent() - before <= share + Meter::PIECE, "{} of {share}", drawer.spent() - before);
            before = drawer.spent();
        }
        let drawing = drawer.finish().unwrap();
        all.push((drawing.segment_count(), drawing.block_count(), drawing.bounds().unwrap().map(f64::to_bits)));
    }
    assert!(all.iter().all(|one| *one == all[0]), "{all:?}");
}

#[test]
fn long_words_are_drawn_in_parts() {
    let rules = format!("A -> {}", "F+".repeat(24_000));
    let plain = Definition { axiom: "AAAA".into(), rules, angle: 0.01, ..Definition::default() };
    let drawing = draw::<Plane>(&system(&plain), 1, &Limits::default()).unwrap();
    assert_eq!(drawing.segment_count(), 96_000);
    // The unfolded drawing has the same strokes.
    let apart = Definition { rules: plain.rules.clone() + "\nF -> F : 1\nF -> F : 1", ..plain };
    let expected = draw::<Plane>(&system(&apart), 1, &Limits::default()).unwrap();
    for (a, b) in drawing.segments().zip(expected.segments()) {
        for (a, b) in a.from.iter().chain(&a.to).zip(b.from.iter().chain(&b.to)) {
            assert!((a - b).abs() < 1e-6, "{a} {b}");
        }
    }
    // The drawing does not depend on the size of steps.
    let parametric = Definition {
        axiom: "A(1)".into(),
        rules: format!("A(x) -> {}", "F(x)[+A(x/2)]-".repeat(3000)),
        angle: 7.0,
        ..Definition::default()
    };
    let system = system(&parametric);
    let whole = draw::<Plane>(&system, 2, &Limits::default()).unwrap();
    let mut drawer = Drawer::<Plane>::new(&system, 2, Limits::default());
    while drawer.step(100) == Progress::More {}
    let slow = drawer.finish().unwrap();
    assert_eq!(whole.bounds().map(|b| b.map(f64::to_bits)), slow.bounds().map(|b| b.map(f64::to_bits)));
    assert_eq!((whole.segment_count(), whole.block_count()), (slow.segment_count(), slow.block_count()));
    assert!(whole.segments().take(100_000).eq(slow.segments().take(100_000)));
}

#[test]
fn drawings_stay_within_their_memory() {
    let rules = "F -> F[+F]F[-F]F : 0.33\nF -> F[+F]F : 0.33\nF -> F[-F]F : 0.34";
    let random = Definition { axiom: "F".into(), rules: rules.into(), angle: 25.7, ..Definition::default() };
    let long = turning(24_000, 0.01);
    let open = Definition { axiom: "[".repeat(20_000), ..Definition::default() };
    for (definition, n, memory) in [(random, 12, 4 << 20), (long, 2, 1 << 20), (open, 0, 1 << 18)] {
        let limits = Limits { memory, ..Limits::default() };
        let mut drawer = Drawer::<Plane>::new(&system(&definition), n, limits);
        while drawer.step(50_000) == Progress::More {
            assert!(drawer.bytes() <= limits.memory);
        }
        let kind = drawer.finish().unwrap_err().kind;
        assert!(matches!(kind, Kind::Limit { limit: LimitName::Memory, .. }), "{kind:?}");
    }
}

#[test]
fn polygons_count_where_everything_is_written() {
    let rules = "A -> AA{G.+G.+G.}";
    let leaves = Definition {
        axiom: "A".into(),
        rules: rules.into(),
        overrides: "G: move unmarked".into(),
        angle: 60.0,
        ..Definition::default()
    };
    let system = system(&leaves);
    let drawing = draw::<Plane>(&system, 100, &Limits::default()).unwrap();
    assert_eq!((drawing.segment_count(), drawing.polygon_count()), (0, (1 << 100) - 1));
    let refused = |kind: Kind| matches!(kind, Kind::Limit { limit: LimitName::Segments, .. });
    assert!(refused(write_csv(&drawing, 1000).unwrap_err().kind));
    let options = SvgOptions { most: 1000, ..SvgOptions::default() };
    assert!(refused(write_svg(&drawing, &leaves.style, &options).unwrap_err().kind));
    let solid = draw::<Solid>(&system, 100, &Limits::default()).unwrap();
    let mesh = Mesh::new(&solid, &leaves.style, 1000).unwrap_err().kind;
    assert!(matches!(mesh, Kind::Limit { limit: LimitName::Mesh, .. }), "{mesh:?}");
    assert!(refused(solid.seen_from(&Outlook::default(), 1000).unwrap_err().kind));
}

#[test]
fn pictures_hold_numbers() {
    for axiom in ["F(1e-300)", "F(1e300)", "F(1e-300)+F(1e300)", "F(0)", "F(1e-300)F(1)"] {
        for step in [1e-9, 1.0, 1e9] {
            for min_width in [0.0, 1.0, 10_000.0] {
                let style = Style { min_width, width: 1.0, ..Style::default() };
                let definition = Definition { axiom: axiom.into(), step, style, angle: 90.0, ..Definition::default() };
                let drawing = draw::<Plane>(&system(&definition), 0, &Limits::default()).unwrap();
                for form in [SvgForm::Flat, SvgForm::Compact] {
                    let options = SvgOptions { form, ..SvgOptions::default() };
                    let text = write_svg(&drawing, &definition.style, &options).unwrap().text;
                    let wrong = text.contains("NaN") || text.contains("inf");
                    assert!(!wrong, "{axiom} step {step} min_width {min_width} {form:?}\n{text}");
                }
            }
        }
    }
}

#[test]
fn files_hold_numbers_where_strokes_are_wider_than_any() {
    for min_width in [0.0, 10.0] {
        let style = Style { width: 1.0, min_width, ..Style::default() };
        let definition = Definition {
            axiom: format!("F{}[+F]FF", "W".repeat(40)),
            overrides: "W: width times 1e9".into(),
            angle: 30.0,
            style,
            ..Definition::default()
        };
        let system = system(&definition);
        let drawing = draw::<Plane>(&system, 0, &Limits::default()).unwrap();
        for form in [SvgForm::Flat, SvgForm::Compact] {
            let options = SvgOptions { form, ..SvgOptions::default() };
            let text = write_svg(&drawing, &definition.style, &options).unwrap().text;
            assert!(!text.contains("NaN") && !text.contains("inf"), "{min_width} {form:?}\n{text}");
        }
        let solid = draw::<Solid>(&system, 0, &Limits::default()).unwrap();
        let mesh = Mesh::new(&solid, &definition.style, 1000).unwrap();
        assert!(!mesh.positions.is_empty());
        assert!(mesh.positions.iter().chain(&mesh.normals).flatten().all(|c| c.is_finite()), "{min_width}");
    }
}

#[test]
fn meshes_of_drawings_as_large_as_numbers_hold_numbers() {
    for min_width in [0.0, 10.0, 10_000.0] {
        let style = Style { min_width, ..Style::default() };
        let definition = Definition { axiom: "F+Ff(1e308)F".into(), style, angle: 30.0, ..Definition::default() };
        let drawing = draw::<Solid>(&system(&definition), 0, &Limits::default()).unwrap();
        let mesh = Mesh::new(&drawing, &definition.style, 1000).unwrap();
        assert!(!mesh.positions.is_empty());
        assert!(mesh.positions.iter().chain(&mesh.normals).flatten().all(|c| c.is_finite()), "{min_width}");
    }
}

#[test]
fn long_files_are_refused_by_their_size() {
    for bytes in [vec![b'\n'; 50 << 20], [b"[".repeat(8 << 20), b"]".repeat(8 << 20)].concat()] {
        let content = read_file(&bytes);
        assert!(content.json.is_empty() && content.definition.is_none());
        assert!(matches!(content.diagnostics[0].kind, Kind::Limit { limit: LimitName::Text, .. }));
    }
    let svg = format!("<svg><metadata id=\"L-system\">{}</metadata></svg>", "&amp;".repeat(20 << 20));
    let content = read_file(svg.as_bytes());
    assert!(content.json.is_empty());
    assert!(matches!(content.diagnostics[0].kind, Kind::Limit { limit: LimitName::Text, .. }));
    // In files within the size, nesting is limited.
    let (definition, diagnostics) = read_json(&"[".repeat(MAX_FILE));
    assert!(definition.is_none() && diagnostics.len() == 1);
}

#[test]
fn colours_of_turns_read_back() {
    let style = Style { turn_colours: [-1, i32::MIN], ..Style::default() };
    let definition = Definition { axiom: "F".into(), style, ..Definition::default() };
    let _ = system(&definition);
    let (read, diagnostics) = read_json(&write_json(&definition));
    assert_eq!((read, diagnostics.as_slice()), (Some(definition), &[][..]));
    assert!(Expected::Whole(i64::from(i32::MIN), i64::from(i32::MAX)).admits(-1.0));
}

#[test]
fn a_symbol_alone_has_no_context() {
    let definition =
        Definition { axiom: "F".into(), rules: "F(x) < A > F(y) : x>0 -> F".into(), ..Definition::default() };
    assert_eq!(expand_symbol(&system(&definition), 'A', 0.5), "A");
}

#[test]
fn a_pointer_that_is_nowhere_finds_nothing() {
    let definition = Definition { axiom: "F{FFFFFF}FF".into(), angle: 90.0, ..Definition::default() };
    let figure = Figure::draw(&system(&definition), 0, &Limits::default()).unwrap();
    let viewport = Viewport { width: 64, height: 64, ratio: 1.0 };
    let found = |at| {
        let pointer = Pointer { at, tolerance: 1e3, upto: None, visits: 1000 };
        pick(&figure, viewport, &Vantage::default(), &pointer)
    };
    assert!(found([32.0, 32.0]).is_some());
    for at in [[32.0, f64::NAN], [f64::NAN, f64::INFINITY], [f64::INFINITY, 32.0]] {
        assert_eq!(found(at), None, "{at:?}");
    }
}

#[test]
fn distances_at_any_magnification_are_numbers() {
    let definition = Definition { axiom: "F{FFF}+F{FFFF}&F".into(), angle: 60.0, ..Definition::default() };
    let system = system(&definition);
    let (flat, solid) = (draw::<Plane>(&system, 0, &Limits::default()), draw::<Solid>(&system, 0, &Limits::default()));
    let (flat, solid) = (Figure::Plane(Arc::new(flat.unwrap())), Figure::Space(Arc::new(solid.unwrap())));
    let viewport = Viewport { width: 64, height: 64, ratio: 1.0 };
    for zoom in [1.0, 1e25, 1e150, 1e160, 1e300, f64::MAX] {
        for at in [[0.0, 0.0], [32.0, 32.0], [1e9, 40.0]] {
            let pointer = Pointer { at, tolerance: 8.0, upto: None, visits: 1000 };
            let view = View { zoom, ..View::default() };
            let mut found = vec![pick(&flat, viewport, &view.into(), &pointer)];
            for perspective in [false, true] {
                let camera = Camera { zoom, perspective, ..Camera::default() };
                found.push(pick(&solid, viewport, &camera.into(), &pointer));
            }
            for pick in found.iter().flatten() {
                assert!(pick.distance >= 0.0 && pick.distance <= pointer.tolerance, "{zoom} {at:?} {pick:?}");
            }
        }
    }
}

/// Makes a picture. Returns the units of work.
fn spent_on(ink: Ink, definition: &Definition, [width, height]: [u32; 2], ratio: f64, upto: Option<u128>) -> u64 {
    let drawing = draw::<Plane>(&system(definition), definition.iterations, &Limits::default()).unwrap();
    let mut renderer = Renderer::new();
    renderer.load(Arc::new(drawing));
    let viewport = Viewport { width, height, ratio };
    let style = Style { ink, ..definition.style.clone() };
    renderer.begin_with(&style, viewport, View::default(), Detail::Fine, upto);
    while renderer.step(1 << 20) == Progress::More {}
    renderer.spent()
}

#[test]
fn ink_of_strokes_wider_than_the_picture_is_added_in_time() {
    let several = Definition {
        axiom: "F".into(),
        rules: "F -> A[FX-[F-AB-F]Fz]F\nF -> *".into(),
        angle: 36.0,
        iterations: 12,
        style: Style { width: 0.5, min_width: 10_000.0, ..Style::default() },
        ..Definition::default()
    };
    let crossing = Definition {
        axiom: "A".into(),
        rules: format!(
            "B -> AF-\nA -> [FAA]{}A-+B\nF -> {}{}AFF",
            "fBFB".repeat(5),
            "FB+A".repeat(31),
            "A-+FfF".repeat(5)
        ),
        angle: -90.0,
        iterations: 5,
        style: Style { width: 5.0, ..Style::default() },
        ..Definition::default()
    };
    let straight = Definition {
        axiom: "G+-f+f".into(),
        rules: "X -> FFFF+\nP -> -X--A\n+ -> AG[Pf+Y]FB\nQ -> FFF+\nG -> [F[FfF]A]F+GY\nX -> [F]".into(),
        angle: 180.0,
        iterations: 181,
        style: Style { width: 0.5, min_width: 10_000.0, colour_by: ColourBy::Level, ..Style::default() },
        ..Definition::default()
    };
    let turning = Definition {
        axiom: "FAAA".into(),
        rules: "A -> FF+[B[XBF+f]F]-\nX -> y[ABA[+]]P-F".into(),
        angle: 32.729_649_972_170_59,
        iterations: 153,
        style: Style { width: 2.0, min_width: 10_000.0, colour_by: ColourBy::Single, ..Style::default() },
        ..Definition::default()
    };
    for (definition, size, ratio, upto) in [
        (several, [160, 64], 2.0, None),
        (crossing, [320, 255], 836.0, Some(805_145_473)),
        (straight, [255, 64], 1.0, None),
        (turning, [160, 64], 0.5, Some(936_236_962)),
    ] {
        let spent = spent_on(Ink::Density, &definition, size, ratio, upto);
        // A step takes 16 units. Combining blocks into larger ones takes a few more.
        let steps = 200_000 + 16 * u64::from(size[0] * size[1]);
        assert!(spent < 4 * 16 * steps, "{} {size:?}: {spent}", definition.axiom);
    }
}

#[test]
fn long_strokes_that_turn_by_next_to_nothing_are_painted_in_time() {
    let definition = Definition {
        axiom: "`(`F!".into(),
        rules: "F -> F+F.A1".into(),
        angle: 89.999_999,
        iterations: 98,
        growth: 0.0,
        style: Style { width: 2.0, width_factor: 1.5, min_width: 0.0, colour_by: ColourBy::Turn, ..Style::default() },
        ..Definition::default()
    };
    let spent = spent_on(Ink::Solid, &definition, [1920, 1080], 2.0, Some(2_999_074_099));
    assert!(spent < 150_000_000, "{spent}");
}

#[test]
fn wide_strokes_side_by_side_are_painted_in_time() {
    let definition = Definition {
        axiom: "`=`B".into(),
        rules: "F -> +XF-+F\nA -> +F\nB -> A[F]FA".into(),
        overrides: "+: turn right 90".into(),
        angle: 25.7,
        iterations: 267,
        style: Style { width: 0.5, min_width: 10_000.0, ..Style::default() },
        ..Definition::default()
    };
    let spent = spent_on(Ink::Solid, &definition, [32_768, 3], 0.5, None);
    assert!(spent < 120_000_000, "{spent}");
}

#[test]
fn wide_strokes_in_space_cover_the_picture_alone() {
    let definition = Definition {
        axiom: "YF+-!".into(),
        rules: "F -> -F".into(),
        overrides: "-: previous colour 7, turn right 17.3, draw 1".into(),
        angle: 1e-7,
        iterations: 1000,
        style: Style { width: 0.0, min_width: 10_000.0, ..Style::default() },
        ..Definition::default()
    };
    let drawing = draw::<Solid>(&system(&definition), 1000, &Limits::default()).unwrap();
    let mut renderer = SolidRenderer::new();
    renderer.load(Arc::new(drawing));
    let viewport = Viewport { width: 100, height: 2, ratio: 1.0 };
    let camera = Camera { azimuth: 0.0, perspective: false, ..Camera::default() };
    renderer.begin(&definition.style, viewport, &camera, Quality::FINEST);
    while renderer.step(1 << 20) == Progress::More {}
    // A thousand strokes on 100 x 8 x 16 samples; eight samples take a unit.
    assert!(renderer.spent() < 1000 * 100 * 8 * 16 / 8, "{}", renderer.spent());
}

#[test]
fn panes_of_wide_strokes_in_space_are_the_picture() {
    let definition = Definition {
        axiom: "-+".into(),
        rules: "F -> `é`X\n- -> G`é`B-A\ndraw:\nB -> F`🌱`A+".into(),
        angle: 30.0,
        iterations: 7,
        style: Style { width: 100.0, width_factor: 0.7, min_width: 10.0, max_width: 0.0, ..Style::default() },
        ..Definition::default()
    };
    let drawing = Arc::new(draw::<Solid>(&system(&definition), definition.iterations, &Limits::default()).unwrap());
    let (viewport, camera) = (Viewport { width: 1920, height: 1080, ratio: 1.0 }, Camera::default());
    let mut renderer = SolidRenderer::new();
    renderer.load(drawing);
    renderer.begin(&definition.style, viewport, &camera, Quality::FINEST);
    while renderer.step(1 << 20) == Progress::More {}
    let (whole, spent) = (renderer.pixels().to_vec(), renderer.effort_spent());
    // More work than four times that of all pixels.
    assert!(spent.work > 4.0 * 2.0 * 1920.0 * 1080.0, "{spent:?}");
    let mut pixels = vec![0; whole.len()];
    let mut effort = Effort::new(Quality::FINEST, viewport);
    loop {
        let mut spent = Spent::default();
        for pane in SolidRenderer::panes(viewport) {
            renderer.begin_pane(&definition.style, viewport, &camera, (pane, Pass::Show), effort.budget());
            while renderer.step(1 << 20) == Progress::More {}
            spent.add(renderer.effort_spent());
            for (y, row) in renderer.pixels().chunks(pane.width as usize * 4).enumerate() {
                let at = ((pane.y as usize + y) * 1920 + pane.x as usize) * 4;
                pixels[at..at + row.len()].copy_from_slice(row);
            }
        }
        if !effort.is_too_small(spent) {
            break;
        }
    }
    assert!(pixels == whole);
}

#[test]
fn what_compiles_can_be_written_and_read() {
    let mut definition = Definition { axiom: "F".into(), rules: "F".repeat(50_001), ..Definition::default() };
    assert!(System::new(&definition).is_err());
    let diagnostics = System::problems(&definition);
    let told = "Rules must be a text of at most 50,000 characters";
    assert!(diagnostics.iter().any(|diagnostic| diagnostic.message == told), "{diagnostics:?}");
    let (read, diagnostics) = read_json(&write_json(&definition));
    assert!(read.is_none());
    assert_eq!(diagnostics[0].message, "`rules` must be a text of at most 50,000 characters");
    definition.rules = format!("F -> {}", "F".repeat(49_995));
    assert!(System::new(&definition).is_ok());
    assert_eq!(read_json(&write_json(&definition)).0, Some(definition));
}
