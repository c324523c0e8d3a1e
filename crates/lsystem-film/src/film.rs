//! A film, and the definition and view of each of its frames.

use crate::error::FilmError;
use crate::track::view_of;
use crate::{Script, Subject};
use core::ops::Range;
use lsystem_base::number::number as written;
use lsystem_base::sorted;
use lsystem_drawing::Origin;
use lsystem_render::{Camera, Vantage};
use lsystem_syntax::{Definition, classify};

/// A script with the system that it begins with.
#[derive(Clone, Debug)]
pub struct Film {
    script: Script,
    definition: Definition,
    vantage: Vantage,
    /// By constant of the rules that a track changes: the track, and the span of the constant's value in the rules.
    /// In the order of the text.
    constants: Vec<(usize, Range<usize>)>,
}

/// The content of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The system.
    pub definition: Definition,
    /// The place from which the drawing is seen.
    pub vantage: Vantage,
    /// As [`Script::segment`].
    pub segment: Option<Origin>,
    /// The part of the segments that is shown, 0 to 1.
    pub drawn: f64,
    /// The system whose drawing has the place and the size of the fitted picture, if not the frame's own: the system at
    /// the end of a film with a fixed camera, and the system without its sway in a film with wind.
    pub framed: Option<Definition>,
}

impl Film {
    /// A film of a system that is first seen from `vantage`.
    ///
    /// # Errors
    /// A track of a constant that the rules do not have.
    pub fn new(script: Script, definition: Definition, vantage: Vantage) -> Result<Self, FilmError> {
        let mut constants = Vec::new();
        for (at, track) in script.tracks.iter().enumerate() {
            let Subject::Constant(name) = &track.subject else { continue };
            let places = classify(&definition).constants;
            let place = places.into_iter().find(|place| place.name == *name);
            let place = place.ok_or_else(|| FilmError::NoConstant(name.clone()))?;
            if !place.is_number {
                return Err(FilmError::Computed(name.clone()));
            }
            constants.push((at, place.span));
        }
        sorted::sort_by_key(&mut constants, |(_, span)| span.start);
        Ok(Self { script, definition, vantage, constants })
    }

    /// A film of the same system with another script.
    ///
    /// # Errors
    /// As [`Film::new`].
    pub fn with(&self, script: Script) -> Result<Self, FilmError> {
        Self::new(script, self.definition.clone(), self.vantage)
    }

    /// The film's script.
    #[must_use]
    pub fn script(&self) -> &Script {
        &self.script
    }

    /// The number of frames.
    #[must_use]
    pub fn frames(&self) -> u32 {
        self.script.frames()
    }

    /// The frame `number` (0-based), or the last one if there are fewer.
    #[must_use]
    pub fn frame(&self, number: u32) -> Frame {
        self.frame_at(self.script.time_of(number))
    }

    /// The frame at a time in seconds.
    #[must_use]
    pub fn frame_at(&self, time: f64) -> Frame {
        let Script { seconds, fixed, .. } = self.script;
        let frame = self.fitted_at(time);
        let has_wind = self.script.tracks.iter().any(|track| track.subject.is_wind());
        let mut framed = match (fixed, has_wind) {
            (true, _) => Some(self.fitted_at(seconds).definition),
            (false, true) => Some(frame.definition.clone()),
            (false, false) => None,
        };
        // The picture must not move with the bounds of a plant in the wind.
        if let Some(framed) = framed.as_mut().filter(|_| has_wind) {
            framed.wind = [0.0; 2];
        }
        Frame { framed, ..frame }
    }

    /// The frame at a time in seconds, with a camera that follows the drawing.
    fn fitted_at(&self, time: f64) -> Frame {
        let Self { script, definition, vantage, .. } = self;
        let mut frame =
            Frame { definition: definition.clone(), vantage: *vantage, segment: None, drawn: 1.0, framed: None };
        frame.segment.clone_from(&script.segment);
        for track in &script.tracks {
            let value = track.at(time);
            match (&track.subject, &value[..]) {
                (Subject::Generation, &[grown]) => grow(&mut frame.definition, grown),
                (Subject::Drawn, &[drawn]) => frame.drawn = drawn,
                (Subject::View, value) => frame.vantage.view = view_of(value),
                (Subject::Camera, value) => set_camera(&mut frame.vantage.camera, value),
                (field @ Subject::Field(_), value) => field.set(&mut frame.definition, value),
                // Constants are replaced together, because each replacement moves the others.
                _ => {}
            }
        }
        if !self.constants.is_empty() {
            frame.definition.rules = self.rules_at(time);
        }
        frame
    }

    /// The rules with the values of the constants at a time.
    fn rules_at(&self, time: f64) -> String {
        let rules = &self.definition.rules;
        let mut text = String::with_capacity(rules.len());
        let mut end = 0;
        for (track, span) in &self.constants {
            let number = self.script.tracks[*track].at(time).first().copied().unwrap_or_default();
            text += &rules[end..span.start];
            text += &written(number);
            end = span.end;
        }
        text + &rules[end..]
    }
}

/// Sets the generation to a continuous number: 2.25 is generation 3, whose youngest modules have grown to a quarter.
/// The page's growth has the same rule (`www/js/motion/growing.js`).
fn grow(definition: &mut Definition, grown: f64) {
    let generation = libm::ceil(grown);
    definition.iterations = generation as u32;
    definition.growth = if generation == 0.0 { 1.0 } else { 1.0 - (generation - grown) };
}

fn set_camera(camera: &mut Camera, value: &[f64]) {
    let [x, y, z] = &mut camera.target;
    let members = [&mut camera.azimuth, &mut camera.elevation, &mut camera.zoom, x, y, z, &mut camera.fade];
    members.into_iter().zip(value).for_each(|(member, &number)| *member = number);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(script: &str, definition: Definition) -> Film {
        Film::new(script.parse().unwrap(), definition, Vantage::default()).unwrap()
    }

    /// The page's tests have the same values.
    #[test]
    fn generations_are_a_continuous_value() {
        let film = film("1;4s;1fps;once;n=0:0,1:0.25,2:1,3:2.5,4:7", Definition::default());
        let at = |time: f64| {
            let Definition { iterations, growth, .. } = film.frame_at(time).definition;
            (iterations, growth)
        };
        assert_eq!([0.0, 1.0, 2.0, 3.0, 4.0].map(at), [(0, 1.0), (1, 0.25), (1, 1.0), (3, 0.5), (7, 1.0)]);
    }

    #[test]
    fn wind_has_the_frame_of_the_still_plant() {
        let still = Definition { angle: 20.0, ..Definition::default() };
        let film = film("1;4s;1fps;angle=0:20,4:24;sway=0:3/0,4:3/360", still);
        let Frame { definition, framed, .. } = film.frame_at(1.0);
        assert_eq!((definition.angle, definition.wind), (21.0, [3.0, 90.0]));
        assert_eq!(framed, Some(Definition { wind: [0.0; 2], ..definition }));
    }

    #[test]
    fn constants_are_written_into_the_rules() {
        let rules = "a = 2\nr = 0.5\nF(l) -> F(l*r)[+F(l*a)]\n";
        let script = "1;10s;10fps;rules.r=0:0.5,10:1;rules.a=0:2,10:-1.5";
        let film = film(script, Definition { rules: rules.into(), ..Definition::default() });
        assert_eq!(film.frame(0).definition.rules, rules);
        let end = film.frame_at(10.0).definition.rules;
        assert_eq!(end, "a = -1.5\nr = 1\nF(l) -> F(l*r)[+F(l*a)]\n");
        let new = |script: &str, rules: &str| {
            let definition = Definition { rules: rules.into(), ..Definition::default() };
            Film::new(script.parse().unwrap(), definition, Vantage::default()).unwrap_err()
        };
        assert_eq!(new("1;rules.b=0:1", rules), FilmError::NoConstant("b".into()));
        assert_eq!(new("1;rules.b=0:1", "a = 1\nb = 2*a\nF -> F"), FilmError::Computed("b".into()));
    }

    #[test]
    fn cameras_keep_what_their_keys_leave_out() {
        let film = film("1;camera=0:0,10:360;width=0:0,10:2", Definition::default());
        let frame = film.frame_at(5.0);
        assert_eq!(frame.vantage.camera, Camera { azimuth: 180.0, ..Camera::default() });
        assert_eq!(frame.definition.style.width, 1.0);
    }
}
