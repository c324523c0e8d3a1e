//! The table of fields.

use super::{Access, Affects, FieldSpec, Section, Slider};
use crate::value::FieldType;
use crate::{ColourBy, Dialect, Expected, Ink};
use lsystem_base::{MAX_ITERATIONS, MAX_SEGMENT_DIGITS, MAX_SURFACES_TEXT, MAX_TEXT, word};

/// Access to a member of a definition.
macro_rules! at {
    ($($member:ident).+) => {
        Access {
            get: |definition| definition.$($member).+.to_value(),
            set: |definition, value| FieldType::from_value(value).map(|field| definition.$($member).+ = field).is_some(),
        }
    };
}

/// The defaults of a row.
const FIELD: FieldSpec = FieldSpec {
    name: "",
    link: "",
    file: None,
    expected: Expected::Number,
    optional: false,
    slider: None,
    unit: "",
    affects: Affects::Drawing,
    label: word!(""),
    help: "",
    access: None,
};

const fn text(most: usize) -> Expected {
    Expected::Text(most)
}

const FACTOR: Expected = Expected::Between(0.0, 10.0);
const PERCENT: Expected = Expected::Between(0.0, 100.0);
const PULL: Expected = Expected::Between(-1e3, 1e3);
const HALF_TURN: Slider = Slider { from: 0.0, parts: &[(180.0, 0.5)], arrow: 1.0 };
const TIMES: Slider = Slider { from: 0.0, parts: &[(2.0, 0.05)], arrow: 0.05 };
const PERCENTS: Slider = Slider { from: 0.0, parts: &[(30.0, 1.0), (100.0, 5.0)], arrow: 1.0 };

/// Strength and phase of a sway: ten waves in one film.
const WIND: Expected = Expected::Between(-3600.0, 3600.0);

/// The smallest magnification.
const MIN_ZOOM: f64 = 1e-2;

/// A view of the plane. Up to a zoom of 10^25, two numbers are enough for a place; beyond, its origin is the start of the
/// segment with the number `at`.
const VIEW: &[(&str, Expected)] = &[
    ("x", Expected::Between(-1e6, 1e6)),
    ("y", Expected::Between(-1e6, 1e6)),
    ("zoom", Expected::Between(MIN_ZOOM, 1e301)),
    ("fx", Expected::Between(-1.0, 1.0)),
    ("fy", Expected::Between(-1.0, 1.0)),
    ("at", Expected::Text(MAX_SEGMENT_DIGITS)),
];

/// A view of space. Single precision is enough up to the largest zoom.
const CAMERA: &[(&str, Expected)] = &[
    ("azimuth", Expected::Between(-360.0, 360.0)),
    ("elevation", Expected::Between(-90.0, 90.0)),
    ("zoom", Expected::Between(MIN_ZOOM, 1e4)),
    ("x", Expected::Between(-100.0, 100.0)),
    ("y", Expected::Between(-100.0, 100.0)),
    ("z", Expected::Between(-100.0, 100.0)),
    ("perspective", Expected::Boolean),
    ("fade", Expected::Between(0.0, 1.0)),
];

/// All fields, in the order of links.
pub static FIELDS: [FieldSpec; 45] = [
    FieldSpec {
        name: "title",
        link: "title",
        file: Some((Section::File, "title")),
        expected: text(200),
        affects: Affects::Caption,
        label: word!("Title"),
        help: "a title for people",
        access: Some(at!(title)),
        ..FIELD
    },
    FieldSpec {
        name: "axiom",
        link: "axiom",
        file: Some((Section::File, "initial")),
        expected: text(MAX_TEXT),
        label: word!("Axiom"),
        help: "the axiom",
        access: Some(at!(axiom)),
        ..FIELD
    },
    FieldSpec {
        name: "rules",
        link: "rules",
        file: Some((Section::File, "rules")),
        expected: text(50_000),
        label: word!("Rules"),
        help: "productions and constants, one on each line",
        access: Some(at!(rules)),
        ..FIELD
    },
    FieldSpec {
        name: "iterations",
        link: "n",
        file: Some((Section::File, "num_iters")),
        expected: Expected::Whole(0, MAX_ITERATIONS as i64),
        slider: Some(Slider {
            from: 0.0,
            parts: &[
                (24.0, 1.0),
                (40.0, 2.0),
                (100.0, 5.0),
                (120.0, 20.0),
                (150.0, 30.0),
                (200.0, 50.0),
                (300.0, 100.0),
                (700.0, 200.0),
                (1000.0, 300.0),
            ],
            arrow: 1.0,
        }),
        unit: "iterations",
        label: word!("Iterations"),
        help: "derivation steps",
        access: Some(at!(iterations)),
        ..FIELD
    },
    FieldSpec {
        name: "angle",
        link: "angle",
        file: Some((Section::File, "angle_deg")),
        expected: Expected::Number,
        slider: Some(HALF_TURN),
        unit: "degrees",
        label: word!("Angle"),
        help: "degrees of a left turn, and of a right one unless it has an angle of its own",
        access: Some(at!(angle)),
        ..FIELD
    },
    FieldSpec {
        name: "rightAngle",
        link: "right",
        file: Some((Section::Turtle, "right_angle_deg")),
        expected: Expected::Number,
        optional: true,
        slider: Some(HALF_TURN),
        unit: "degrees",
        label: word!("Right turns"),
        help: "degrees of a right turn; as `angle` where it is missing",
        access: Some(at!(right_angle)),
        ..FIELD
    },
    FieldSpec {
        name: "seed",
        link: "seed",
        file: Some((Section::File, "seed")),
        expected: Expected::Whole(0, u32::MAX as i64),
        label: word!("Seed"),
        help: "the number that selects among random choices",
        access: Some(at!(seed)),
        ..FIELD
    },
    FieldSpec {
        name: "dialect",
        link: "turtle",
        file: Some((Section::Turtle, "dialect")),
        expected: Expected::Word(&Dialect::NAMES),
        label: word!("Dialect"),
        help: "the table of what symbols do",
        access: Some(at!(dialect)),
        ..FIELD
    },
    FieldSpec {
        name: "pitchDown",
        link: "down",
        file: Some((Section::Turtle, "pitch_down_deg")),
        expected: Expected::Number,
        optional: true,
        unit: "degrees",
        label: word!("Pitch down"),
        help: "degrees of pitching down; as `angle` where it is missing",
        access: Some(at!(pitch_down)),
        ..FIELD
    },
    FieldSpec {
        name: "pitchUp",
        link: "up",
        file: Some((Section::Turtle, "pitch_up_deg")),
        expected: Expected::Number,
        optional: true,
        unit: "degrees",
        label: word!("Pitch up"),
        help: "degrees of pitching up; as pitching down where it is missing",
        access: Some(at!(pitch_up)),
        ..FIELD
    },
    FieldSpec {
        name: "rollLeft",
        link: "roll",
        file: Some((Section::Turtle, "roll_left_deg")),
        expected: Expected::Number,
        optional: true,
        unit: "degrees",
        label: word!("Roll left"),
        help: "degrees of rolling left; as `angle` where it is missing",
        access: Some(at!(roll_left)),
        ..FIELD
    },
    FieldSpec {
        name: "rollRight",
        link: "rollright",
        file: Some((Section::Turtle, "roll_right_deg")),
        expected: Expected::Number,
        optional: true,
        unit: "degrees",
        label: word!("Roll right"),
        help: "degrees of rolling right; as rolling left where it is missing",
        access: Some(at!(roll_right)),
        ..FIELD
    },
    FieldSpec {
        name: "heading",
        link: "heading",
        file: Some((Section::Turtle, "heading_deg")),
        expected: Expected::Number,
        unit: "degrees",
        label: word!("Heading"),
        help: "the heading at the start, in degrees counter-clockwise from +x",
        access: Some(at!(heading)),
        ..FIELD
    },
    FieldSpec {
        name: "step",
        link: "step",
        file: Some((Section::Turtle, "step")),
        expected: Expected::Between(1e-9, 1e9),
        label: word!("Step"),
        help: "the step length, in model units",
        access: Some(at!(step)),
        ..FIELD
    },
    FieldSpec {
        name: "start",
        link: "start",
        file: Some((Section::Turtle, "start")),
        expected: Expected::Each(2, &Expected::Between(-1e9, 1e9)),
        label: word!("Start of the turtle"),
        help: "where the turtle starts, in model units, x right and y up",
        access: Some(at!(start)),
        ..FIELD
    },
    FieldSpec {
        name: "tropism",
        link: "tropism",
        file: Some((Section::Turtle, "tropism")),
        expected: Expected::Each(3, &PULL),
        label: word!("Tropism"),
        help: "the direction that branches bend towards: x, y, and z towards the viewer",
        access: Some(at!(tropism)),
        ..FIELD
    },
    FieldSpec {
        name: "elasticity",
        link: "elasticity",
        file: Some((Section::Turtle, "elasticity")),
        expected: PULL,
        label: word!("Elasticity"),
        help: "how easily branches bend, 0 for not at all",
        access: Some(at!(elasticity)),
        ..FIELD
    },
    FieldSpec {
        name: "sway",
        link: "sway",
        file: Some((Section::Turtle, "sway_deg")),
        expected: Expected::Each(2, &WIND),
        label: word!("Sway"),
        help: "the sway of branches in the wind: its strength, and its phase from 0 to 360, in degrees",
        access: Some(at!(wind)),
        ..FIELD
    },
    FieldSpec {
        name: "lengthFactor",
        link: "shorter",
        file: Some((Section::Turtle, "length_factor")),
        expected: FACTOR,
        slider: Some(TIMES),
        unit: "times",
        label: word!("Branch length\u{a0}×"),
        help: "what every branch multiplies lengths by",
        access: Some(at!(length_factor)),
        ..FIELD
    },
    FieldSpec {
        name: "angleVariation",
        link: "vary",
        file: Some((Section::Turtle, "angle_variation")),
        expected: PERCENT,
        slider: Some(PERCENTS),
        unit: "percent",
        label: word!("Angle variation"),
        help: "how much angles differ at random, at most, in percent",
        access: Some(at!(angle_variation)),
        ..FIELD
    },
    FieldSpec {
        name: "lengthVariation",
        link: "varylength",
        file: Some((Section::Turtle, "length_variation")),
        expected: PERCENT,
        slider: Some(PERCENTS),
        unit: "percent",
        label: word!("Length variation"),
        help: "how much lengths differ at random, at most, in percent",
        access: Some(at!(length_variation)),
        ..FIELD
    },
    FieldSpec {
        name: "growth",
        link: "growth",
        file: Some((Section::Turtle, "growth")),
        expected: Expected::Between(0.0, 1.0),
        label: word!("Growth"),
        help: "how far the last derivation step has grown",
        access: Some(at!(growth)),
        ..FIELD
    },
    FieldSpec {
        name: "overrides",
        link: "do",
        file: Some((Section::Turtle, "overrides")),
        expected: text(20_000),
        label: word!("Custom symbols"),
        help: "symbols that do something else than in the dialect, one on each line",
        access: Some(at!(overrides)),
        ..FIELD
    },
    FieldSpec {
        name: "surfaces",
        link: "surfaces",
        file: Some((Section::Turtle, "surfaces")),
        expected: text(MAX_SURFACES_TEXT),
        label: word!("Surfaces"),
        help: "surfaces that symbols draw, one on each line: a letter, a colon, and the 16 control points of each Bezier patch, each point as its distances ahead, left and up",
        access: Some(at!(surfaces)),
        ..FIELD
    },
    FieldSpec {
        name: "palette",
        link: "palette",
        file: Some((Section::Style, "palette")),
        expected: Expected::Palette,
        affects: Affects::Look,
        label: word!("Colours"),
        help: "the stroke colours",
        access: Some(at!(style.palette)),
        ..FIELD
    },
    FieldSpec {
        name: "colourBy",
        link: "colour",
        file: Some((Section::Style, "colour_by")),
        expected: Expected::Word(&ColourBy::NAMES),
        affects: Affects::Look,
        label: word!("Colour by"),
        help: "what the colour follows",
        access: Some(at!(style.colour_by)),
        ..FIELD
    },
    FieldSpec {
        name: "paletteHolds",
        link: "hold",
        file: Some((Section::Style, "palette_holds")),
        expected: Expected::Boolean,
        affects: Affects::Look,
        label: word!("Stay at the last colour"),
        help: "whether by level and by generation the last colour stays where the palette ends",
        access: Some(at!(style.palette_holds)),
        ..FIELD
    },
    FieldSpec {
        name: "turnColours",
        link: "turns",
        file: Some((Section::Style, "turn_colours")),
        expected: Expected::Each(2, &Expected::Whole(i32::MIN as i64, i32::MAX as i64)),
        affects: Affects::Look,
        label: word!("Colour number after a turn"),
        help: "by turn: the index in the palette, from 0, after a left and after a right turn",
        access: Some(at!(style.turn_colours)),
        ..FIELD
    },
    FieldSpec {
        name: "background",
        link: "bg",
        file: Some((Section::Style, "background")),
        expected: Expected::Colour,
        affects: Affects::Look,
        label: word!("Background"),
        help: "the colour behind the drawing",
        access: Some(at!(style.background)),
        ..FIELD
    },
    FieldSpec {
        name: "width",
        link: "width",
        file: Some((Section::Style, "width")),
        expected: Expected::Between(0.0, 1e9),
        slider: Some(Slider { from: 0.0, parts: &[(1.0, 0.05), (3.0, 0.1), (10.0, 0.25), (20.0, 0.5)], arrow: 0.1 }),
        unit: "steps",
        affects: Affects::Look,
        label: word!("Stroke width (steps)"),
        help: "the stroke width, in steps",
        access: Some(at!(style.width)),
        ..FIELD
    },
    FieldSpec {
        name: "widthFactor",
        link: "thinner",
        file: Some((Section::Style, "width_factor")),
        expected: FACTOR,
        slider: Some(TIMES),
        unit: "times",
        affects: Affects::Look,
        label: word!("Width per branch level\u{a0}×"),
        help: "what every branch multiplies the width by",
        access: Some(at!(style.width_factor)),
        ..FIELD
    },
    FieldSpec {
        name: "tapers",
        link: "taper",
        file: Some((Section::Style, "tapers")),
        expected: Expected::Boolean,
        affects: Affects::Look,
        label: word!("Tapered lines"),
        help: "whether each line runs from its own width to the width with which its branch goes on",
        access: Some(at!(style.tapers)),
        ..FIELD
    },
    FieldSpec {
        name: "minWidth",
        link: "thin",
        file: Some((Section::Style, "min_width")),
        expected: Expected::Between(0.0, 1e4),
        slider: Some(Slider { from: 0.0, parts: &[(8.0, 0.25)], arrow: 0.5 }),
        unit: "pixels",
        affects: Affects::Look,
        label: word!("Thinnest line"),
        help: "the width of the thinnest line, in pixels",
        access: Some(at!(style.min_width)),
        ..FIELD
    },
    FieldSpec {
        name: "maxWidth",
        link: "thick",
        file: Some((Section::Style, "max_width")),
        expected: PERCENT,
        slider: Some(Slider { from: 0.0, parts: &[(4.0, 0.25), (20.0, 1.0)], arrow: 0.5 }),
        unit: "percent",
        affects: Affects::Look,
        label: word!("Thickest line (%)"),
        help: "the width of the thickest line, in percent of the picture's longer side; 0 for no limit",
        access: Some(at!(style.max_width)),
        ..FIELD
    },
    FieldSpec {
        name: "ink",
        link: "ink",
        file: Some((Section::Style, "ink")),
        expected: Expected::Word(&Ink::NAMES),
        affects: Affects::Look,
        label: word!("Blending"),
        help: "blending of overlapping strokes: opaque (`solid`), additive (`density`), or opaque but additive where strokes are finer than pixels (`auto`)",
        access: Some(at!(style.ink)),
        ..FIELD
    },
    FieldSpec {
        name: "hue",
        link: "hue",
        file: Some((Section::Style, "hue")),
        expected: Expected::Between(-360.0, 360.0),
        slider: Some(Slider { from: 0.0, parts: &[(360.0, 5.0)], arrow: 5.0 }),
        unit: "degrees",
        affects: Affects::Look,
        label: word!("Hue"),
        help: "by how many degrees the palette's hues are turned",
        access: Some(at!(style.hue)),
        ..FIELD
    },
    FieldSpec {
        name: "exposure",
        link: "exposure",
        file: Some((Section::Style, "exposure")),
        expected: Expected::Between(-10.0, 10.0),
        slider: Some(Slider { from: -4.0, parts: &[(4.0, 0.25)], arrow: 0.25 }),
        unit: "stops",
        affects: Affects::Look,
        label: word!("Exposure (stops)"),
        help: "brightness of additive blending, in stops: each doubles it",
        access: Some(at!(style.exposure)),
        ..FIELD
    },
    FieldSpec {
        name: "shadows",
        link: "shadows",
        file: Some((Section::Style, "shadows")),
        expected: Expected::Boolean,
        affects: Affects::Look,
        label: word!("Shadows"),
        help: "whether a drawing in space has soft shadows",
        access: Some(at!(style.shadows)),
        ..FIELD
    },
    FieldSpec {
        name: "shapes",
        link: "shapes",
        file: Some((Section::Style, "shapes")),
        expected: Expected::Boolean,
        label: word!("Shapes"),
        help: "whether the drawing has the outlines of the shapes in the rules, in a faint colour",
        access: Some(at!(style.shapes)),
        ..FIELD
    },
    FieldSpec {
        name: "auto",
        link: "auto",
        file: Some((Section::Style, "auto")),
        expected: Expected::Boolean,
        affects: Affects::Look,
        label: word!("Automatic look"),
        help: "whether widths, and what the colour follows, are chosen after the system in place of the values given",
        access: Some(at!(style.auto)),
        ..FIELD
    },
    FieldSpec {
        name: "name",
        link: "name",
        file: Some((Section::File, "name")),
        expected: text(200),
        affects: Affects::Caption,
        label: word!("Name"),
        help: "a short name, unique within its folder",
        access: Some(at!(name)),
        ..FIELD
    },
    FieldSpec {
        name: "source",
        link: "source",
        file: Some((Section::File, "source")),
        expected: text(1_000),
        affects: Affects::Caption,
        label: word!("Source"),
        help: "where the system was published",
        access: Some(at!(source)),
        ..FIELD
    },
    FieldSpec {
        name: "notes",
        link: "notes",
        file: Some((Section::File, "notes")),
        expected: text(10_000),
        affects: Affects::Caption,
        label: word!("Notes"),
        help: "what a reader should know",
        access: Some(at!(notes)),
        ..FIELD
    },
    FieldSpec {
        name: "view",
        link: "view",
        expected: Expected::Record(VIEW),
        optional: true,
        affects: Affects::Look,
        label: word!("View"),
        help: "the part of the plane that is shown",
        ..FIELD
    },
    FieldSpec {
        name: "camera",
        link: "camera",
        expected: Expected::Record(CAMERA),
        optional: true,
        affects: Affects::Look,
        label: word!("Camera"),
        help: "from where a drawing in space is looked at",
        ..FIELD
    },
];
