//! The usual films for the page's buttons.

use super::words;
use lsystem_film::{Preset, Script};
use lsystem_js::from_js;
use lsystem_render::{Camera, View};
use serde::Deserialize;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// A preset, as the page asks for it.
#[derive(Deserialize, TS)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub(crate) enum PresetObject {
    /// Growth to generation `n`.
    Growth { n: u32 },
    /// The turtle's way.
    Turtle,
    /// One turn of the camera, in degrees from `azimuth` on.
    Turntable { azimuth: f64 },
    /// Wind of this strength, in degrees.
    #[serde(rename = "sway")]
    Wind { strength: f64 },
    /// A dive to the numbers of a view (x, y, zoom, fx, fy), or of a camera in space (azimuth, elevation, zoom, x, y, z).
    Dive { place: Vec<f64>, space: bool },
}

impl From<PresetObject> for Preset {
    fn from(object: PresetObject) -> Self {
        match object {
            PresetObject::Growth { n } => Self::Growth(n),
            PresetObject::Turtle => Self::Turtle,
            PresetObject::Turntable { azimuth } => Self::Turntable(Camera { azimuth, ..Camera::default() }),
            PresetObject::Wind { strength } => Self::Wind(strength),
            PresetObject::Dive { place, space } => {
                let number = |at: usize, usual: f64| place.get(at).copied().unwrap_or(usual);
                if space {
                    let target = [3, 4, 5].map(|at| number(at, 0.0));
                    let [azimuth, elevation, zoom] = [number(0, 0.0), number(1, 0.0), number(2, 1.0)];
                    return Self::DiveInSpace(Camera { azimuth, elevation, zoom, target, ..Camera::default() });
                }
                let fine = [number(3, 0.0), number(4, 0.0)];
                Self::Dive(View { x: number(0, 0.0), y: number(1, 0.0), zoom: number(2, 1.0), fine })
            }
        }
    }
}

/// The text of a film with a preset in place of its other presets: `{kind: 'growth', n}`, `{kind: 'turtle'}`,
/// `{kind: 'turntable', azimuth}`, `{kind: 'wind', strength}` or `{kind: 'dive', place, space}`.
///
/// # Errors
/// Throws the words of the first problem of the text.
#[wasm_bindgen(js_name = withPreset)]
pub fn with_preset(text: &str, preset: JsValue) -> Result<String, JsValue> {
    let script: Script = text.parse().map_err(words)?;
    let preset: PresetObject = from_js(preset)?;
    Ok(script.with_preset(&preset.into()).to_string())
}
