//! Tracks for the usual films.

use crate::{Easing, Keyframe, Script, Subject, Track};
use lsystem_base::fixed::Fixed;
use lsystem_drawing::{Drawing, Figure, Origin};
use lsystem_render::{Camera, Closeup, Vantage, View, fitted_ends};
use lsystem_syntax::Definition;
use std::sync::Arc;

/// The part of the time after which growth, the turtle's way and a dive are over, so that the end can be seen.
const END: f64 = 0.9;
/// The part of the time before a dive begins, so that the whole drawing can be seen.
const REST: f64 = 0.05;
/// The farthest place of a view.
const MAX_PLACE: f64 = 1e6;
/// The part of the picture that the segment at the end of a dive takes.
const SHARE: f64 = 0.25;
/// The largest zoom of a view in the plane, and in space, as in links.
const MAX_ZOOM: [f64; 2] = [1e25, 1e4];
/// The strength of a sway where the definition has none, in degrees: a light wind. The page's wind has the same
/// (`www/js/motion/wind.js`).
const LIGHT_WIND: f64 = 3.0;

/// A usual film. Each takes the place of the others, so that each shows what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Preset {
    /// [`grow`] to this generation.
    Growth(u32),
    /// [`turtle`].
    Turtle,
    /// [`turntable`] from this camera.
    Turntable(Camera),
    /// [`wind`] with this strength, in degrees.
    Wind(f64),
    /// [`dive`] to this view.
    Dive(View),
    /// [`dive_in_space`] to this camera.
    DiveInSpace(Camera),
}

impl Preset {
    /// The preset's track.
    #[must_use]
    pub fn track(&self, script: &Script) -> Track {
        match self {
            Self::Growth(n) => grow(script, *n),
            Self::Turtle => turtle(script),
            Self::Turntable(camera) => turntable(script, camera),
            Self::Wind(strength) => wind(script, *strength),
            Self::Dive(view) => dive(script, *view),
            Self::DiveInSpace(camera) => dive_in_space(script, camera),
        }
    }
}

impl Script {
    /// The script with a preset in place of its growth, turtle's way, view, camera and sway. Other tracks stay. The camera of
    /// growth is fixed.
    #[must_use]
    pub fn with_preset(mut self, preset: &Preset) -> Self {
        self.clear_presets();
        let track = preset.track(&self);
        self.tracks.push(track);
        // A plant grows from the ground. A fitted one would begin as a stump that fills the frame.
        self.fixed = matches!(preset, Preset::Growth(_));
        self
    }

    /// The script with a dive in place of its presets: to a segment, the one in the middle if it is `None`, or to a view
    /// whose origin is the place on the segment. `None` as for [`dive_to`].
    #[must_use]
    pub fn with_dive(
        mut self,
        figure: &Figure,
        segment: Option<Origin>,
        view: Option<View>,
        from: &Vantage,
    ) -> Option<Self> {
        self.clear_presets();
        let segment = segment.unwrap_or_else(|| middle(figure).into());
        let track = match figure {
            Figure::Plane(whole) if view.is_some() => dive_about(&mut self, whole, &segment, view),
            _ => dive_to(&mut self, figure, &segment.segment, from),
        }?;
        self.tracks.push(track);
        Some(self)
    }

    fn clear_presets(&mut self) {
        let is_preset = |subject: &Subject| {
            matches!(subject, Subject::Generation | Subject::Drawn | Subject::View | Subject::Camera)
                || subject.is_wind()
        };
        self.tracks.retain(|track| !is_preset(&track.subject));
        (self.segment, self.fixed) = (None, false);
    }
}

/// The growth from the axiom to generation `n`.
#[must_use]
pub fn grow(script: &Script, n: u32) -> Track {
    let end = [(0.0, vec![0.0]), (END, vec![f64::from(n)])];
    track(script, Subject::Generation, &end, script.easing)
}

/// The turtle's way: the drawing is drawn segment by segment.
#[must_use]
pub fn turtle(script: &Script) -> Track {
    track(script, Subject::Drawn, &[(0.0, vec![0.0]), (END, vec![1.0])], script.easing)
}

/// One turn of the camera about a drawing in space.
#[must_use]
pub fn turntable(script: &Script, camera: &Camera) -> Track {
    let keys = [(0.0, vec![camera.azimuth]), (1.0, vec![camera.azimuth + 360.0])];
    track(script, Subject::Camera, &keys, script.easing)
}

/// The sway of branches in the wind: one wave, so that the film is a loop.
#[must_use]
pub fn wind(script: &Script, strength: f64) -> Track {
    let keys = [(0.0, vec![strength, 0.0]), (1.0, vec![strength, 360.0])];
    track(script, Subject::wind(), &keys, script.easing)
}

/// The strength of a sway, in degrees: that of the definition, or of a light wind.
#[must_use]
pub fn wind_strength(definition: &Definition) -> f64 {
    let [own, _] = definition.wind;
    if own == 0.0 { LIGHT_WIND } else { own }
}

/// A dive from the whole drawing in the plane to a view.
#[must_use]
pub fn dive(script: &Script, to: View) -> Track {
    let end =
        if to.fine == [0.0; 2] { vec![to.x, to.y, to.zoom] } else { vec![to.x, to.y, to.zoom, to.fine[0], to.fine[1]] };
    track(script, Subject::View, &[(REST, vec![0.0, 0.0, 1.0]), (END, end)], Easing::Smooth)
}

/// A dive from the whole drawing to a segment (0-based), in space from the direction of the camera `from`. If the segment
/// lies deeper than usual views reach, it becomes the origin of the script's views. `None` if there are fewer segments.
pub fn dive_to(script: &mut Script, figure: &Figure, segment: &Fixed, from: &Vantage) -> Option<Track> {
    let near = segment.decimal().parse().ok().and_then(|number| vantage_of_segment(figure, number, from));
    let whole = match (figure, near) {
        (Figure::Space(_), near) => return near.map(|to| dive_in_space(script, &to.camera)),
        // At the largest zoom the segment may be smaller than its share of the picture.
        (_, Some(to)) if to.view.zoom < MAX_ZOOM[0] => return Some(dive(script, to.view)),
        (Figure::Plane(whole), _) => whole,
    };
    dive_about(script, whole, &segment.clone().into(), None)
}

/// A dive to a view whose origin is a place on a segment, or to the segment. The script's views are about it.
fn dive_about(script: &mut Script, whole: &Arc<Drawing>, origin: &Origin, view: Option<View>) -> Option<Track> {
    let (closeup, step) = Closeup::on_step(whole.clone(), origin.clone(), SHARE)?;
    let [x, y, ..] = closeup.place()?.map(|place| 0.0 - place);
    script.segment = Some(origin.clone());
    let mut track = dive(script, view.unwrap_or(step));
    track.keys[0].value = vec![x, y, 1.0];
    Some(track)
}

/// The segment (0-based) in the middle of a figure.
fn middle(figure: &Figure) -> Fixed {
    match figure {
        Figure::Plane(drawing) => drawing.exact_count().minus(&Fixed::units(1)).shifted(-1),
        Figure::Space(_) => Fixed::units(middle_segment(figure.segment_count())),
    }
}

/// A dive from the whole drawing in space to a camera.
#[must_use]
pub fn dive_in_space(script: &Script, to: &Camera) -> Track {
    let [x, y, z] = to.target;
    let from = vec![to.azimuth, to.elevation, 1.0, 0.0, 0.0, 0.0];
    let end = vec![to.azimuth, to.elevation, to.zoom, x, y, z];
    track(script, Subject::Camera, &[(REST, from), (END, end)], Easing::Smooth)
}

/// The number (0-based) of the segment in the middle of a drawing, where a dive leads if nothing else is wanted: of two in
/// the middle, the first one.
#[must_use]
pub(crate) fn middle_segment(segments: u128) -> u128 {
    segments.saturating_sub(1) / 2
}

/// The vantage before one segment of a figure (0-based), in space from the direction of the camera `from`; `None` if there
/// are fewer segments.
#[must_use]
pub fn vantage_of_segment(figure: &Figure, number: u128, from: &Vantage) -> Option<Vantage> {
    let [start, end] = fitted_ends(figure, number)?;
    let along: Vec<f64> = start.iter().zip(&end).map(|(start, end)| end - start).collect();
    let middle: Vec<f64> = start.iter().zip(&along).map(|(start, along)| start + along / 2.0).collect();
    // Beside an extent beyond all numbers, a segment may have no place that views reach.
    if !middle.iter().all(|place| place.abs() <= MAX_PLACE) {
        return None;
    }
    match (&along[..], &middle[..]) {
        (&[across, up, fine_across, fine_up], &[x, y, fine_x, fine_y]) => {
            let zoom = zoom_to(libm::hypot(across + fine_across, up + fine_up), MAX_ZOOM[0]);
            Some(Vantage { view: View { x, y, zoom, fine: [fine_x, fine_y] }, ..*from })
        }
        (_, &[x, y, z]) => {
            let length = libm::sqrt(along.iter().map(|part| part * part).sum());
            let camera = Camera { target: [x, y, z], zoom: zoom_to(length, MAX_ZOOM[1]), ..from.camera };
            Some(Vantage { camera, ..*from })
        }
        _ => None,
    }
}

/// The zoom at which a length in fitted extents takes its share of the picture.
fn zoom_to(length: f64, most: f64) -> f64 {
    let zoom = SHARE / length;
    // A segment without a length has no zoom.
    if zoom.is_finite() { zoom.clamp(1.0, most) } else { most }
}

/// A track with keys at parts of the script's time.
fn track(script: &Script, subject: Subject, keys: &[(f64, Vec<f64>)], easing: Easing) -> Track {
    // A thousandth of a second is enough, and makes short texts.
    let time = |part: f64| libm::round(part * script.seconds * 1e3) / 1e3;
    let key = |(part, value): &(f64, Vec<f64>)| Keyframe { time: time(*part), value: value.clone(), easing };
    Track { subject, keys: keys.iter().map(key).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_base::Limits;
    use lsystem_drawing::System;

    #[test]
    fn presets_are_scripts() {
        let usual = Script { seconds: 7.0, ..Script::default() };
        let dived = dive(&usual, View { x: 0.25, y: -0.5, zoom: 1e19, fine: [1e-18, 0.0] });
        let tracks = [grow(&usual, 40), turtle(&usual), turntable(&usual, &Camera::default()), dived];
        let script = Script { tracks: tracks.into(), ..usual };
        let text = "1;7s;25fps;1280x720;repeat;n=0:0,6.3:40;drawn=0:0,6.3:1;camera=0:25,7:385;\
                    view=0.35:0/0/1~smooth,6.3:0.25/-0.5/1e19/1e-18/0~smooth";
        assert_eq!(script.to_string().replace("10000000000000000000", "1e19"), text);
        assert_eq!(text.parse::<Script>().unwrap(), script);
    }

    #[test]
    fn a_preset_takes_the_place_of_the_others() {
        let script: Script = "1;10s;angle=0:20,10:30;n=0:0,9:7;camera=0:0".parse().unwrap();
        let text = script.clone().with_preset(&Preset::Turtle).to_string();
        assert_eq!(text, "1;10s;25fps;1280x720;repeat;angle=0:20,10:30;drawn=0:0,9:1");
        let windy = script.clone().with_preset(&Preset::Wind(3.0)).to_string();
        assert_eq!(windy, "1;10s;25fps;1280x720;repeat;angle=0:20,10:30;sway=0:3/0,10:3/360");
        assert_eq!(windy.parse::<Script>().unwrap().with_preset(&Preset::Turtle).to_string(), text);
        let growth = Script::default().with_preset(&Preset::Growth(7));
        assert_eq!(growth.to_string(), "1;10s;25fps;1280x720;repeat;fixed;n=0:0,9:7");
        assert!(!growth.with_preset(&Preset::Turtle).fixed);
        assert_eq!([0, 1, 2, 3, 4].map(middle_segment), [0, 0, 0, 1, 1]);
    }

    #[test]
    fn dives_reach_segments_and_views_about_them() {
        let curve =
            Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), angle: 60.0, ..Definition::default() };
        let figure = Figure::draw(&System::new(&curve).unwrap(), 600, &Limits::default()).unwrap();
        let usual: Script = "1;10s;fixed;n=0:0,9:7".parse().unwrap();
        let from = Vantage::default();
        let middle = usual.clone().with_dive(&figure, None, None, &from).unwrap();
        // The last segment of the first half.
        assert_eq!(middle.segment, Some(Fixed::units(1).shifted(1199).minus(&Fixed::units(1)).into()));
        assert!(middle.tracks.len() == 1 && !middle.fixed);
        let [start, end] = &middle.tracks[0].keys[..] else { panic!("two keys") };
        assert!(start.value[2] == 1.0 && end.value[2] > 1e280);
        let to = View { x: 1e-41, y: -2e-41, zoom: 1e40, fine: [0.0; 2] };
        let about = usual.clone().with_dive(&figure, Some(Fixed::units(4).into()), Some(to), &from).unwrap();
        let [start, end] = &about.tracks[0].keys[..] else { panic!("two keys") };
        // The curve starts at its lower end, half an extent from the middle.
        assert!((start.value[1] - 0.5).abs() < 1e-9 && start.value[2] == 1.0, "{start:?}");
        assert_eq!((&about.segment, &end.value[..]), (&Some(Fixed::units(4).into()), &[1e-41, -2e-41, 1e40][..]));
        assert_eq!(about.to_string().parse::<Script>().unwrap(), about);
        assert_eq!(about.with_preset(&Preset::Turtle).segment, None);
        assert!(usual.with_dive(&figure, Some(Fixed::units(1).shifted(1200).into()), Some(to), &from).is_none());
    }

    #[test]
    fn a_segment_fills_its_share() {
        let curve =
            Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), angle: 60.0, ..Definition::default() };
        let figure = Figure::draw(&System::new(&curve).unwrap(), 30, &Limits::default()).unwrap();
        let from = Vantage::default();
        let Vantage { view, .. } = vantage_of_segment(&figure, figure.segment_count() / 3, &from).unwrap();
        // A segment is a 3^30th of the width.
        assert!((view.zoom / (SHARE * libm::pow(3.0, 30.0)) - 1.0).abs() < 1e-6, "{}", view.zoom);
        assert!(vantage_of_segment(&figure, u128::MAX, &from).is_none());
    }
}
