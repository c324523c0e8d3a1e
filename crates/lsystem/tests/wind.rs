//! The sway of branches. The tests of drawings compare it with the naive turtle.

use lsystem::{Definition, Figure, Limits, Style, System};

fn figure(definition: &Definition, n: u32) -> Figure {
    Figure::draw(&System::new(definition).expect("no errors"), n, &Limits::default()).expect("within the limits")
}

fn bush() -> Definition {
    let rules = "X -> F-[[X]+X]+F[+FX]-X\nF -> FF";
    Definition { axiom: "X".into(), rules: rules.into(), angle: 22.5, ..Definition::default() }
}

/// A plant in space with numbers, whose boughs level their leaves (`$`).
fn tree() -> Definition {
    let rules = "A(l,w) -> !(w)F(l)[&(45)B(l*0.6,w*0.7)]/(137.5)A(l*0.9,w*0.7)\n\
                 B(l,w) -> !(w)F(l)[-(45)$C(l*0.6,w*0.7)]C(l*0.9,w*0.7)\n\
                 C(l,w) -> !(w)F(l)[+(45)$B(l*0.6,w*0.7)]B(l*0.9,w*0.7)";
    Definition { axiom: "A(1,0.1)".into(), rules: rules.into(), ..Definition::default() }
}

#[test]
fn blocks_stay_shared() {
    let spatial = Definition { rules: "X -> F[&X]////[&X]////&X\nF -> FF".into(), ..bush() };
    // A still plant with `$` is not shared at 40 steps.
    for (definition, n) in [(bush(), 40), (spatial, 40), (tree(), 8)] {
        let blocks = |wind: [f64; 2]| {
            let figure = figure(&Definition { wind, ..definition.clone() }, n);
            assert!(figure.is_memoised());
            figure.block_count()
        };
        let still = blocks([0.0, 0.0]);
        // At phase 0 and at any other: some blocks may be equal by chance.
        for phase in [0.0, 77.0] {
            let in_wind = blocks([3.0, phase]);
            assert!(in_wind.abs_diff(still) <= still / 20 + 2, "{n}: {still} {in_wind}");
        }
    }
}

fn ends(figure: &Figure) -> Vec<f64> {
    match figure {
        Figure::Plane(drawing) => drawing.segments().flat_map(|segment| segment.to).collect(),
        Figure::Space(drawing) => drawing.segments().flat_map(|segment| segment.to).collect(),
    }
}

#[test]
fn a_phase_is_a_place_on_a_loop() {
    for definition in [bush(), tree()] {
        let at =
            |strength: f64, phase: f64| ends(&figure(&Definition { wind: [strength, phase], ..definition.clone() }, 4));
        assert_eq!(at(3.0, 0.0), at(3.0, 360.0));
        assert_eq!(at(3.0, 100.0), at(3.0, 820.0));
        assert_ne!(at(3.0, 0.0), at(3.0, 180.0));
        assert_eq!(at(0.0, 90.0), at(0.0, 0.0));
    }
}

#[test]
fn a_drawing_without_branches_stands_still() {
    let koch = Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), angle: 60.0, ..Definition::default() };
    let system = |wind| System::new(&Definition { wind, ..koch.clone() }).expect("no errors");
    assert_eq!(system([5.0, 90.0]), system([0.0, 0.0]));
}

/// A wave goes through the plant: a wind that blows to one side moves the tips, and swapped turns do not change the side.
#[test]
fn the_sway_of_branches_goes_to_one_side_of_the_model() {
    let twigs = |axiom: &str| {
        let definition = Definition {
            axiom: axiom.into(),
            overrides: "S: swap turns".into(),
            angle: 50.0,
            wind: [9.0, 90.0],
            style: Style::default(),
            ..Definition::default()
        };
        ends(&figure(&definition, 0))
    };
    // The trunk leans left by 3 degrees, the branch by 9 more.
    let [left, swapped] = ["F[F]", "SF[F]"].map(twigs);
    assert_eq!(left, swapped);
    let [trunk, tip] = [[left[0], left[1]], [left[2] - left[0], left[3] - left[1]]];
    let heading = |[x, y]: [f64; 2]| libm::atan2(-x, y).to_degrees();
    assert!((heading(trunk) - 3.0).abs() < 1e-9 && (heading(tip) - 12.0).abs() < 1e-9, "{left:?}");
}
