//! What the page is told of a definition.

use lsystem::base::words::said;
use lsystem::drawing::{kind, legend, why_empty};
pub use lsystem::syntax::Problem;
use lsystem::{Definition, Dialect, Figure, Style, System, fit};
use serde::Serialize;
use ts_rs::TS;

/// The properties of a definition and its problems. Counts are exact decimal strings, null while unknown.
#[derive(Clone, Debug, Default, Serialize, TS)]
pub struct Report {
    /// Whether the definition has no errors.
    pub ok: bool,
    /// All errors and warnings, also about limits.
    pub diagnostics: Vec<Problem>,
    /// As [`lsystem::drawing::kind`].
    pub kind: String,
    /// Whether the drawing depends on the seed.
    pub stochastic: bool,
    /// Whether the drawing leaves the plane.
    pub space: bool,
    /// Whether the drawing has branches, which can sway.
    pub branches: bool,
    /// Whether the drawing shares its blocks.
    pub memoised: Option<bool>,
    /// The number of symbols of the generation.
    pub symbols: Option<String>,
    /// The number of segments of the drawing.
    pub segments: Option<String>,
    /// The number of blocks of the drawing.
    pub blocks: Option<usize>,
    /// The width of a drawing in the plane over its height; null for a drawing without a height.
    pub aspect: Option<f64>,
    /// The azimuth, in degrees, from which a drawing in space is seen best.
    pub azimuth: Option<f64>,
    /// The largest number of iterations within the limits, if the drawing exceeds a limit.
    pub largest: Option<u32>,
    /// What an automatic look chose; null without one.
    pub look: Option<ChosenLook>,
    /// The symbols in use.
    pub legend: Vec<Legend>,
    /// The reason why nothing is drawn.
    pub empty: Option<String>,
    /// The change after which something is drawn, if nothing is.
    pub mend: Option<Mend>,
    /// The picture's text alternative.
    pub description: String,
}

/// A change of one field after which a system draws something.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub enum Mend {
    Iterations(u32),
    /// The name of a dialect.
    Dialect(&'static str),
}

impl Mend {
    /// The most iterations that are tried.
    const MOST: u32 = 9;

    fn of(system: &System, definition: &Definition) -> Option<Self> {
        let draws = |system: &System, n: u32| why_empty(system, n).is_none();
        let mut tried = (1..=Self::MOST).chain([0]);
        tried.find(|n| draws(system, *n)).map(Self::Iterations).or_else(|| {
            let dialect = Dialect::EveryLetter;
            let every_letter = System::new(&Definition { dialect, ..definition.clone() }).ok()?;
            draws(&every_letter, definition.iterations).then_some(Self::Dialect(dialect.name()))
        })
    }
}

/// The fields of a style that an automatic look chooses.
#[derive(Clone, Debug, Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub struct ChosenLook {
    /// The choice in words.
    pub words: String,
    pub colour_by: &'static str,
    pub palette_holds: bool,
    pub width: f64,
    pub width_factor: f64,
    pub min_width: f64,
    pub max_width: f64,
}

impl ChosenLook {
    fn of(system: &System) -> Option<Self> {
        let Style { colour_by, palette_holds, width, width_factor, min_width, max_width, auto, .. } = system.style;
        let (words, colour_by) = (said(system.look().words()), colour_by.name());
        auto.then_some(Self { words, colour_by, palette_holds, width, width_factor, min_width, max_width })
    }
}

/// A symbol in use and its actions.
#[derive(Clone, Debug, Serialize, TS)]
pub struct Legend {
    /// The symbol, with the names of its parameters.
    pub symbol: String,
    /// The turtle's actions, in words.
    pub actions: String,
    /// Whether the turtle does nothing at the symbol.
    pub idle: bool,
    /// Whether a production replaces the symbol.
    pub rewritten: bool,
}

impl Report {
    /// The report on a definition that cannot be used.
    pub(crate) fn wrong(diagnostics: Vec<Problem>) -> Self {
        Self { diagnostics, ..Self::default() }
    }

    /// What is known of a system before it is drawn.
    pub(crate) fn of(system: &System, definition: &Definition, diagnostics: Vec<Problem>) -> Self {
        let legend = legend(system).into_iter().map(|entry| Legend {
            symbol: entry.module,
            actions: entry.actions,
            idle: entry.idle,
            rewritten: entry.rewritten,
        });
        let empty = why_empty(system, definition.iterations);
        Self {
            ok: true,
            diagnostics,
            kind: kind(system).split(", ").map(said).collect::<Vec<_>>().join(", "),
            stochastic: system.is_stochastic(),
            space: system.is_solid(),
            branches: system.has_branches(),
            look: ChosenLook::of(system),
            legend: legend.collect(),
            mend: empty.as_ref().and_then(|_| Mend::of(system, definition)),
            empty,
            ..Self::default()
        }
    }

    /// Takes over what another report on the same drawing says about the drawing.
    pub(crate) fn keep_drawing(self, former: Self) -> Self {
        let Self { memoised, symbols, segments, blocks, aspect, azimuth, largest, description, .. } = former;
        Self { memoised, symbols, segments, blocks, aspect, azimuth, largest, description, ..self }
    }

    /// Makes the width that an automatic look chose the width that is drawn: a limit may have decided it alone.
    pub(crate) fn add_width(&mut self, figure: &Figure) {
        let Some(look) = &mut self.look else { return };
        look.width = three_digits(figure.width());
    }

    /// Adds what the finished drawing knows.
    pub(crate) fn add_drawing(&mut self, figure: &Figure) {
        self.add_width(figure);
        if let Some(symbols) = figure.symbol_count() {
            self.symbols = Some(symbols.to_string());
        }
        self.memoised = Some(figure.is_memoised());
        self.blocks = Some(figure.block_count());
        self.aspect = match figure {
            Figure::Plane(drawing) => {
                Some(fit(drawing)).map(|rect| rect.width / rect.height).filter(|it| it.is_finite())
            }
            Figure::Space(_) => None,
        };
    }
}

/// A number from 0 with at least three significant digits, if it is not below 1e-9.
// Without the printer and the reader of numbers, which would be 13 KB of the page.
fn three_digits(value: f64) -> f64 {
    let mut unit = 1.0;
    while value * unit < 99.5 && unit < 1e12 {
        unit *= 10.0;
    }
    (value * unit + 0.5) as u64 as f64 / unit
}
