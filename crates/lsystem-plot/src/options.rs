//! The choices for a plot.

use lsystem_base::named;

/// Where the carriage of a plotter rests before and after a pen draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Corner {
    /// The usual corner of plotters with a carriage.
    #[default]
    TopLeft,
    /// Top right.
    TopRight,
    /// Bottom left.
    BottomLeft,
    /// Bottom right.
    BottomRight,
}

named!(Corner: TopLeft "top-left", TopRight "top-right", BottomLeft "bottom-left", BottomRight "bottom-right");

impl Corner {
    /// The corner of a sheet of this size, y down.
    pub(crate) fn of(self, [width, height]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::TopLeft => [0.0, 0.0],
            Self::TopRight => [width, 0.0],
            Self::BottomLeft => [0.0, height],
            Self::BottomRight => [width, height],
        }
    }
}

/// The choices for a plot. Lengths are in millimetres, speeds in millimetres a second.
///
/// A number out of its range is moved to the nearest end of the range, and a number that is not finite becomes the
/// default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotOptions {
    /// The width of the pen's line: 0.05 to 20. Parts of the drawing that are smaller become one stroke.
    pub pen: f64,
    /// Whether the sheet is turned by 90 degrees if the drawing is larger then.
    pub turns: bool,
    /// Whether polygons, and strokes broader than the pen, are filled with lines a pen's width apart.
    pub hatch: bool,
    /// Whether lines are left out where something nearer covers them. Then strokes broader than the pen are drawn as
    /// their outlines.
    pub hide: bool,
    /// Where each pen starts and ends.
    pub start: Corner,
    /// Polylines that are shorter are left out: 0 to 1,000.
    pub least: f64,
    /// The speed of the lowered pen, for the estimate of time: 0.1 to 10,000.
    pub speed: f64,
    /// The speed of the raised pen, for the estimate of time: 0.1 to 10,000.
    pub travel_speed: f64,
    /// The seconds to raise and lower the pen once: 0 to 60.
    pub lift: f64,
}

impl Default for PlotOptions {
    /// A fineliner of 0.3 mm, and the speeds at which AxiDraw plotters move by default, roughly.
    fn default() -> Self {
        Self {
            pen: 0.3,
            turns: true,
            hatch: false,
            hide: false,
            start: Corner::TopLeft,
            least: 0.0,
            speed: 50.0,
            travel_speed: 150.0,
            lift: 0.2,
        }
    }
}

impl PlotOptions {
    /// The options with every number in its range.
    #[must_use]
    pub fn bounded(self) -> Self {
        let usual = Self::default();
        Self {
            pen: within(self.pen, usual.pen, 0.05, 20.0),
            least: within(self.least, usual.least, 0.0, 1e3),
            speed: within(self.speed, usual.speed, 0.1, 1e4),
            travel_speed: within(self.travel_speed, usual.travel_speed, 0.1, 1e4),
            lift: within(self.lift, usual.lift, 0.0, 60.0),
            ..self
        }
    }
}

/// `value` in a range; `usual` if `value` is not finite.
pub(crate) fn within(value: f64, usual: f64, least: f64, most: f64) -> f64 {
    if value.is_finite() { value.clamp(least, most) } else { usual }
}
