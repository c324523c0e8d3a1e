//! A script: the length, the size and the tracks of a film.

use crate::{Easing, Track};
use lsystem_base::named;
use lsystem_drawing::Origin;

/// The longest text of a script, in bytes.
pub(crate) const MAX_SCRIPT: usize = 20_000;
/// The most tracks of a script.
pub(crate) const MAX_TRACKS: usize = 40;
/// The most keys of a script, in all tracks.
pub(crate) const MAX_KEYS: usize = 1_000;
/// The longest film, in seconds.
pub(crate) const MAX_SECONDS: f64 = 3_600.0;
/// The shortest film, in seconds: one frame of 25 a second.
pub(crate) const MIN_SECONDS: f64 = 0.04;
/// The most frames a second.
pub(crate) const MAX_RATE: u32 = 60;
/// The most frames a second of a GIF.
pub const MAX_GIF_RATE: u32 = 50;
/// The most pixels of a side of a frame.
pub(crate) const MAX_SIDE: u32 = 4_096;
/// The fewest pixels of a side of a frame.
pub(crate) const MIN_SIDE: u32 = 16;
/// The most pixels of a frame: those of 3840 x 2160, and a little more.
pub(crate) const MAX_FRAME_PIXELS: u32 = 1 << 23;

/// The continuation after the last key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ending {
    /// The film ends with the values at its end.
    Once,
    /// The film begins anew. Its last frame is the one before the first.
    #[default]
    Repeat,
    /// The film runs backwards to its start, and begins anew.
    Bounce,
}

named!(Ending: Once "once", Repeat "repeat", Bounce "bounce");

/// The length, the size and the tracks of a film. The text form is read by `FromStr` and written by `Display`.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// Seconds from the start to the end of the tracks.
    pub seconds: f64,
    /// Frames a second.
    pub rate: u32,
    /// The width and the height of a frame, in pixels.
    pub size: [u32; 2],
    /// The continuation after the end.
    pub ending: Ending,
    /// The pace of keys that have none of their own in the text form.
    pub easing: Easing,
    /// Whether all frames are framed as the drawing at the end of the tracks is. Otherwise each frame's drawing is
    /// fitted, so that the camera follows a growing drawing.
    pub fixed: bool,
    /// The place on a segment that is the origin of views in the plane; `None` for the fitted centre.
    pub segment: Option<Origin>,
    /// The tracks, each of another subject.
    pub tracks: Vec<Track>,
}

impl Default for Script {
    fn default() -> Self {
        Self {
            seconds: 10.0,
            rate: 25,
            size: [1280, 720],
            ending: Ending::default(),
            easing: Easing::default(),
            fixed: false,
            segment: None,
            tracks: Vec::new(),
        }
    }
}

impl Script {
    /// The number of frames from the start to the end of the tracks; at least 1.
    fn frames_forward(&self) -> u32 {
        // The limits keep the product below 2^18.
        (libm::round(self.seconds * f64::from(self.rate)) as u32).max(1)
    }

    /// The number of frames of the whole film.
    #[must_use]
    pub fn frames(&self) -> u32 {
        let forward = self.frames_forward();
        if self.ending == Ending::Bounce { (2 * forward).saturating_sub(2).max(1) } else { forward }
    }

    /// The time of a frame, in seconds.
    #[must_use]
    pub fn time_of(&self, frame: u32) -> f64 {
        let forward = self.frames_forward();
        let frame = frame.min(self.frames() - 1);
        let at = if frame < forward { frame } else { 2 * forward - 2 - frame };
        // A film that begins anew shows its first frame where its end would be.
        let steps = if self.ending == Ending::Repeat { forward } else { forward.saturating_sub(1).max(1) };
        self.seconds * f64::from(at) / f64::from(steps)
    }

    /// The hundredths of a second that a frame of a GIF is shown, rounded so that no rounding adds up; 0 for frames that
    /// are left out. Programs show a hundredth as ten, so that there are at most [`MAX_GIF_RATE`] frames a second.
    #[must_use]
    pub fn delay_of(&self, frame: u32) -> u16 {
        let (rate, unit) = (u64::from(self.rate.max(1)), if self.rate > MAX_GIF_RATE { 2 } else { 1 });
        let end = |frame: u32| unit * ((u64::from(frame) * (100 / unit) + rate / 2) / rate);
        (end(frame + 1) - end(frame)) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_fill_the_time() {
        let script = |ending| Script { seconds: 2.0, rate: 5, ending, ..Script::default() };
        let times = |ending| {
            let script = script(ending);
            (0..script.frames()).map(|frame| libm::round(script.time_of(frame) * 100.0) as u32).collect::<Vec<_>>()
        };
        assert_eq!(times(Ending::Repeat), [0, 20, 40, 60, 80, 100, 120, 140, 160, 180]);
        assert_eq!(times(Ending::Once).last(), Some(&200));
        let bounce = times(Ending::Bounce);
        assert_eq!((bounce.len(), bounce[9], bounce[1] == bounce[17]), (18, 200, true));
        for rate in 1..=MAX_RATE {
            let script = Script { seconds: 3.0, rate, ..Script::default() };
            let hundredths: u32 = (0..script.frames()).map(|frame| u32::from(script.delay_of(frame))).sum();
            assert_eq!(hundredths, 300, "{rate}");
            let shown = (0..script.frames()).filter(|&frame| script.delay_of(frame) > 0);
            assert_eq!(shown.clone().count(), 3 * rate.min(50) as usize, "{rate}");
            assert!(shown.map(|frame| script.delay_of(frame)).all(|delay| delay > 1) && script.delay_of(0) > 1);
        }
        let single = Script { seconds: 0.04, rate: 1, ending: Ending::Bounce, ..Script::default() };
        assert_eq!((single.frames(), single.time_of(0), single.time_of(9)), (1, 0.0, 0.0));
    }
}
