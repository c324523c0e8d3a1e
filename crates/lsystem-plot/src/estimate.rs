//! Estimates of a plot: lengths, pens and time.

use crate::options::PlotOptions;
use lsystem_base::words::shown;
use lsystem_base::{counted, say};

/// The size of a plot. Lengths are in millimetres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlotSummary {
    /// The width and the height of the sheet, after it is turned.
    pub sheet: [f64; 2],
    /// The number of pens: one for each colour.
    pub pens: usize,
    /// The number of polylines: as often is the pen lowered.
    pub polylines: usize,
    /// The length of all lines.
    pub down: f64,
    /// The travel of the raised pens, from the start and back to it.
    pub travel: f64,
    /// The travel if every stroke were drawn in the order of the drawing.
    pub travel_before: f64,
    /// The seconds of drawing, at constant speeds and without the changes of pens.
    pub seconds: f64,
}

impl PlotSummary {
    /// The summary with the time that it takes.
    pub(crate) fn timed(self, options: &PlotOptions) -> Self {
        let moves = self.down / options.speed + self.travel / options.travel_speed;
        Self { seconds: moves + self.polylines as f64 * options.lift, ..self }
    }

    /// The summary as a line of text, with the speeds of `options`.
    #[must_use]
    pub fn words(&self, options: &PlotOptions) -> String {
        let options = options.bounded();
        let [width, height] = self.sheet;
        let figure = |value: f64| shown(&value.to_string());
        say!(
            "plot of {} x {} mm: {}, {}, {} drawn, {} travelled ({} in drawing order), about {} at {} and {} \
             mm/s with {} s a lift",
            figure(width),
            figure(height),
            counted!(self.pens, "{1} pen", "{1} pens", self.pens),
            counted!(self.polylines, "{1} polyline", "{1} polylines", self.polylines),
            metres(self.down),
            metres(self.travel),
            metres(self.travel_before),
            time(self.seconds),
            figure(options.speed),
            figure(options.travel_speed),
            figure(options.lift)
        )
    }
}

/// A length in metres.
fn metres(length: f64) -> String {
    shown(&format!("{:.2} m", length / 1000.0))
}

/// A time in hours, minutes or seconds.
fn time(seconds: f64) -> String {
    let minutes = libm::round(seconds / 60.0) as u64;
    match minutes {
        0..2 => format!("{seconds:.0} s"),
        2..120 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_times() {
        let options = PlotOptions::default();
        let summary = PlotSummary {
            sheet: [297.0, 210.0],
            pens: 1,
            polylines: 10,
            down: 5000.0,
            travel: 1500.0,
            travel_before: 3000.0,
            seconds: 0.0,
        };
        let timed = summary.timed(&options);
        assert!((timed.seconds - 112.0).abs() < 1e-9);
        assert_eq!(
            timed.words(&options),
            "plot of 297 x 210 mm: 1 pen, 10 polylines, 5.00 m drawn, 1.50 m travelled (3.00 m in drawing order), about 2 \
             min at 50 and 150 mm/s with 0.2 s a lift"
        );
        assert_eq!([time(59.6), time(119.9 * 60.0), time(7260.0)], ["60 s", "2 h 0 min", "2 h 1 min"]);
    }
}
