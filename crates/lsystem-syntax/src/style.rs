//! The look of a drawing: colours, widths, background.

use crate::Dialect;
use crate::notes::excerpt;
use lsystem_base::{named, say};

/// An opaque sRGB colour with 8 bits per channel. Its text form is `#rrggbb`; `#rgb` and the sixteen basic CSS colour
/// names are read too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red, green and blue, each 0 to 255.
    pub rgb: [u8; 3],
}

/// The property that decides a stroke's colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourBy {
    /// The colour symbols: the palette's entry that the turtle's colour index selects.
    #[default]
    Symbol,
    /// One colour for all strokes: the first of the palette.
    Single,
    /// The branch level: the palette's entry at the level.
    Level,
    /// The last turn: the palette's entry that [`Style::turn_colours`] names for it. A branch's end restores the
    /// colour.
    Turn,
    /// The derivation step that made the drawing module (`Colouring::Generations`).
    Generation,
    /// The place along the path: the palette as a gradient from the first segment to the last.
    Path,
    /// The amount of ink at a pixel, where ink adds up: the palette as a gradient from the least ink to the most. With
    /// opaque ink, the first of the palette.
    Density,
}

named!(ColourBy: Symbol "symbol", Single "single", Level "level", Turn "turn", Generation "generation", Path "path",
    Density "density");

impl ColourBy {
    /// All values, in the order of the page's list.
    pub const LISTED: [Self; 7] =
        [Self::Symbol, Self::Level, Self::Generation, Self::Path, Self::Turn, Self::Density, Self::Single];

    /// What the page calls it, and a note for readers, in English.
    #[must_use]
    pub const fn words(self) -> [&'static str; 2] {
        match self {
            Self::Symbol => ["colour symbols", ""],
            Self::Level => ["branch level", "First colour for the stem, next colour for its branches, and so on."],
            Self::Generation => [
                "generation",
                "Colour by the iteration that made a symbol. A symbol that a rule copies keeps its generation.",
            ],
            Self::Path => ["distance along path", "A gradient of all colours, from the first segment to the last."],
            Self::Turn => [
                "turns",
                "First colour at the start, other colours after turns. Each branch restores the colour before it.",
            ],
            Self::Density => {
                ["amount of ink", "Where ink adds up: a gradient of all colours, from the least ink to the most."]
            }
            Self::Single => ["one colour", ""],
        }
    }

    /// The number that chooses a stroke's colour.
    #[must_use]
    pub fn source(self) -> ColourSource {
        match self {
            Self::Symbol | Self::Turn | Self::Generation => ColourSource::Index,
            Self::Single => ColourSource::Constant,
            Self::Level => ColourSource::Level,
            Self::Path => ColourSource::Along,
            Self::Density => ColourSource::Ink,
        }
    }
}

/// The number that chooses a stroke's colour. Code matches it without a wildcard: a new one leads to every place that
/// must know it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourSource {
    /// None: all strokes have the palette's first colour.
    Constant,
    /// The turtle's colour index.
    Index,
    /// The branch level.
    Level,
    /// The place along the path.
    Along,
    /// The amount of ink at a pixel; strokes have the palette's first colour.
    Ink,
}

impl ColourSource {
    /// Whether a block has the same colours wherever it stands on the path, but for what its surroundings add to index
    /// and level. Only then can its copies share a picture.
    #[must_use]
    pub fn is_shared(self) -> bool {
        match self {
            Self::Constant | Self::Index | Self::Level | Self::Ink => true,
            Self::Along => false,
        }
    }
}

/// The blending of overlapping strokes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ink {
    /// Opaque where strokes are as large as pixels. Where finer strokes pile up, the picture shows their amount. Vector
    /// files and pictures of drawings in space are opaque.
    #[default]
    Auto,
    /// Opaque: later strokes cover earlier ones.
    Solid,
    /// Additive: ink adds up, and the picture shows its amount. Vector files do not support this.
    Density,
}

named!(Ink: Auto "auto", Solid "solid", Density "density");

/// The look of a drawing. A stroke's width is the turtle's width, but at least `min_width`.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// The stroke colours by palette index, never empty. Indices beyond the end wrap around.
    pub palette: Vec<Colour>,
    /// Whether levels and generations beyond the palette take its last colour instead of wrapping around.
    pub palette_holds: bool,
    /// The palette indices after a left turn and after a right turn.
    pub turn_colours: [i32; 2],
    /// The property that decides a stroke's colour.
    pub colour_by: ColourBy,
    /// The colour behind the drawing.
    pub background: Colour,
    /// The turtle's stroke width at the start, in multiples of the step length.
    pub width: f64,
    /// The factor of the width for each branch level.
    pub width_factor: f64,
    /// Whether a stroke tapers to the width with which its branch goes on.
    pub tapers: bool,
    /// The smallest width of a stroke, in CSS pixels of the picture.
    pub min_width: f64,
    /// The greatest width of a stroke, in percent of the drawing's longer side: if the widest stroke exceeds it, all
    /// strokes are thinner by the same factor. 0 for no limit.
    pub max_width: f64,
    /// The blending of overlapping strokes.
    pub ink: Ink,
    /// The rotation of the palette's hues, in degrees.
    pub hue: f64,
    /// The exposure of additive ink, in stops: each stop doubles the ink's strength.
    pub exposure: f64,
    /// Whether a drawing in space has soft shadows, also on the ground, and is darker inside, in pictures at rest.
    pub shadows: bool,
    /// Whether the wireframes of the system's shapes are part of the drawing, in a faint colour.
    pub shapes: bool,
    /// Whether widths and the property that decides colours follow from the system (`Look` of `lsystem-drawing`) in place
    /// of `colour_by`, `palette_holds`, `width`, `width_factor`, `min_width` and `max_width`.
    pub auto: bool,
}

impl Colour {
    /// The colour with its hue rotated by `degrees` (the matrix of SVG's `hueRotate`).
    fn turned(self, degrees: f64) -> Self {
        if degrees == 0.0 {
            return self;
        }
        let (sin, cos) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        let [r, g, b] = self.rgb.map(f64::from);
        let grey = 0.213 * r + 0.715 * g + 0.072 * b;
        let turn = |own: f64, by: f64| libm::round(grey + cos * (own - grey) + sin * by).clamp(0.0, 255.0) as u8;
        let by =
            [-0.213 * r - 0.715 * g + 0.928 * b, 0.143 * r + 0.14 * g - 0.283 * b, -0.787 * r + 0.715 * g + 0.072 * b];
        Self { rgb: [turn(r, by[0]), turn(g, by[1]), turn(b, by[2])] }
    }
}

impl Default for Style {
    fn default() -> Self {
        let colour = |r, g, b| Colour { rgb: [r, g, b] };
        Self {
            palette: vec![
                colour(0x1f, 0x5c, 0x3a),
                colour(0x5f, 0x8f, 0x2f),
                colour(0xb5, 0x8b, 0x1e),
                colour(0xb4, 0x53, 0x2a),
                colour(0x8c, 0x2f, 0x4b),
            ],
            palette_holds: false,
            turn_colours: [1, 2],
            colour_by: ColourBy::Symbol,
            background: colour(0xfb, 0xfa, 0xf5),
            width: 0.0,
            width_factor: 1.0,
            min_width: 1.0,
            max_width: 2.0,
            tapers: true,
            ink: Ink::Auto,
            hue: 0.0,
            exposure: 0.0,
            shadows: true,
            shapes: true,
            auto: false,
        }
    }
}

impl Style {
    /// The style of the course's files: green strokes 0.04 wide on white.
    #[must_use]
    pub fn course() -> Self {
        Self {
            palette: vec![Colour { rgb: [0, 0x80, 0] }],
            background: Colour { rgb: [0xff; 3] },
            width: 0.04,
            min_width: 0.0,
            max_width: 0.0,
            tapers: false,
            ink: Ink::Solid,
            ..Self::default()
        }
    }

    /// The colour index of wireframes of shapes: no palette has so many entries.
    pub const FAINT: i32 = i32::MIN;

    /// The ink of wireframes of shapes, after those of the palette.
    pub const FAINT_INK: u32 = u32::MAX;

    /// The colour of wireframes of shapes: between the background and black or white, whichever is farther from it.
    #[must_use]
    pub fn faint(&self) -> Colour {
        let [r, g, b] = self.background.rgb.map(u32::from);
        let end = if 2 * r + 5 * g + b < 8 * 128 { 255 } else { 0 };
        Colour { rgb: [r, g, b].map(|channel| ((3 * channel + end) / 4) as u8) }
    }

    /// Whether a stroke has the faint colour, if it has this colour index.
    pub fn is_faint(&self, index: i32) -> bool {
        index == Self::FAINT
            && match self.colour_by.source() {
                ColourSource::Constant | ColourSource::Index | ColourSource::Level => true,
                ColourSource::Along | ColourSource::Ink => false,
            }
    }

    /// The colour of a stroke.
    #[must_use]
    pub fn colour_of(&self, tint: Tint) -> Colour {
        if self.is_faint(tint.index) {
            return self.faint();
        }
        let wrapped = |index: i64| index.rem_euclid(self.palette.len().max(1) as i64) as u32;
        let held = |index: i64| if self.holds() { index.clamp(0, i64::from(u32::MAX)) as u32 } else { wrapped(index) };
        self.ink(match self.colour_by.source() {
            ColourSource::Constant | ColourSource::Ink => 0,
            ColourSource::Index => held(i64::from(tint.index)),
            ColourSource::Level => held(i64::from(tint.level)),
            ColourSource::Along => gradient_step(tint.place),
        })
    }

    /// Whether indices beyond the palette take its last colour.
    pub fn holds(&self) -> bool {
        self.palette_holds
            && match self.colour_by {
                ColourBy::Level | ColourBy::Generation => true,
                ColourBy::Symbol | ColourBy::Single | ColourBy::Turn | ColourBy::Path | ColourBy::Density => false,
            }
    }

    /// The number of inks: colours that strokes may have.
    pub fn inks(&self) -> u32 {
        let palette = u32::try_from(self.palette.len()).unwrap_or(u32::MAX / 2).max(1);
        match self.colour_by.source() {
            ColourSource::Constant | ColourSource::Ink => 1,
            ColourSource::Along => GRADIENT,
            ColourSource::Index | ColourSource::Level => palette,
        }
    }

    /// The colour of the ink `number`: a palette's entry or a step of the gradient.
    pub fn ink(&self, number: u32) -> Colour {
        if number == Self::FAINT_INK {
            return self.faint();
        }
        match self.colour_by.source() {
            ColourSource::Along => self.gradient((f64::from(number) + 0.5) / f64::from(GRADIENT)),
            ColourSource::Constant | ColourSource::Index | ColourSource::Level | ColourSource::Ink => {
                self.entry(number as usize)
            }
        }
    }

    /// The palette's entry at `index` with its hue rotated, or the last entry for a larger index. All stroke colours
    /// are made of these.
    pub fn entry(&self, index: usize) -> Colour {
        let entry = index.min(self.palette.len().saturating_sub(1));
        self.palette.get(entry).map_or(Colour { rgb: [0; 3] }, |colour| colour.turned(self.hue))
    }

    /// The gradient's colour at `place`, from 0 to 1: one of [`GRADIENT`] steps.
    #[must_use]
    pub fn gradient(&self, place: f64) -> Colour {
        let last = self.palette.len().saturating_sub(1);
        let along = f64::from(gradient_step(place)) / f64::from(GRADIENT - 1) * last as f64;
        let from = (along as usize).min(last.saturating_sub(1));
        let part = along - from as f64;
        let (a, b) = (self.entry(from).rgb, self.entry(from + 1).rgb);
        let mix = |i: usize| libm::round(f64::from(a[i]) * (1.0 - part) + f64::from(b[i]) * part) as u8;
        Colour { rgb: [0, 1, 2].map(mix) }
    }

    /// The default style for files in this dialect. In [`Dialect::Lowercase`] the pen starts blue, and turns choose red
    /// and green.
    #[must_use]
    pub fn for_dialect(dialect: Dialect) -> Self {
        let mut style = Self::default();
        if dialect == Dialect::Lowercase {
            style.palette = [[0, 0, 0xff], [0xff, 0, 0], [0, 0x80, 0]].map(|rgb| Colour { rgb }).to_vec();
        }
        style
    }
}

/// The properties of a stroke that may decide its colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tint {
    /// The turtle's colour index.
    pub index: i32,
    /// The branch level.
    pub level: u32,
    /// The fraction of all segments that come before, 0 to 1.
    pub place: f64,
}

/// The steps of the gradient along the path: few enough for a renderer, too many to be visible as steps.
pub const GRADIENT: u32 = 64;

/// The step of the gradient at `place` (0 to 1), 0-based.
pub fn gradient_step(place: f64) -> u32 {
    ((place * f64::from(GRADIENT)) as u32).min(GRADIENT - 1)
}

/// Whether `size`, a fraction of the path, is at most one step of the gradient. Such a part is drawn in one colour.
pub fn is_one_step(size: f64) -> bool {
    size * f64::from(GRADIENT) <= 1.0
}

impl From<Colour> for String {
    fn from(colour: Colour) -> Self {
        let [r, g, b] = colour.rgb;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

impl core::str::FromStr for Colour {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let name = text.trim();
        if let Some((_, rgb)) = NAMED.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
            return Ok(Self { rgb: *rgb });
        }
        let digits = name.strip_prefix('#').filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()));
        let value = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        match (digits.map(str::len), value) {
            (Some(6), Some(value)) => Ok(Self { rgb: [(value >> 16) as u8, (value >> 8) as u8, value as u8] }),
            (Some(3), Some(value)) => Ok(Self { rgb: [8, 4, 0].map(|shift| ((value >> shift & 15) * 17) as u8) }),
            _ => Err(say!("`{}` is not a colour: write it as #rrggbb", excerpt(text))),
        }
    }
}

/// The basic colour names of CSS 1.
const NAMED: [(&str, [u8; 3]); 16] = [
    ("black", [0, 0, 0]),
    ("silver", [0xc0, 0xc0, 0xc0]),
    ("gray", [0x80, 0x80, 0x80]),
    ("white", [0xff, 0xff, 0xff]),
    ("maroon", [0x80, 0, 0]),
    ("red", [0xff, 0, 0]),
    ("purple", [0x80, 0, 0x80]),
    ("fuchsia", [0xff, 0, 0xff]),
    ("green", [0, 0x80, 0]),
    ("lime", [0, 0xff, 0]),
    ("olive", [0x80, 0x80, 0]),
    ("yellow", [0xff, 0xff, 0]),
    ("navy", [0, 0, 0x80]),
    ("blue", [0, 0, 0xff]),
    ("teal", [0, 0x80, 0x80]),
    ("aqua", [0, 0xff, 0xff]),
];
