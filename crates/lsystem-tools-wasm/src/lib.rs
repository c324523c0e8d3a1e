//! The boundary to JavaScript of the tools that few visits need. The page loads this wasm with the first of their
//! calls.

#[cfg(feature = "course")]
mod course;
#[cfg(feature = "export")]
mod export;
#[cfg(feature = "film")]
mod film;
#[cfg(feature = "find")]
mod find;
#[cfg(feature = "import")]
mod import;
#[cfg(feature = "invent")]
mod invent;
#[cfg(feature = "sound")]
mod sound;
#[cfg(test)]
mod tables;
/// As in the wasm of the page.
#[path = "../../lsystem-wasm/src/words.rs"]
mod words;

#[cfg(feature = "class")]
pub use course::{ClassMarking, variants_of, write_exercise};
#[cfg(feature = "course")]
pub use course::{OpenExercise, check_output, growth, one_by_one, step_rows, turtle_trace, variant_of};
#[cfg(feature = "export")]
pub use export::{make_file, make_package};
#[cfg(feature = "film")]
pub use film::{FilmPlayer, read_film, subjects, with_preset};
#[cfg(feature = "find")]
pub use find::{GreyPicture, RuleFinder, outline_of_svg};
#[cfg(feature = "import")]
pub use import::{import_systems, write_system};
#[cfg(feature = "invent")]
pub use invent::{DescentFilm, breed, surprise};
#[cfg(feature = "sound")]
pub use sound::Listener;

pub use words::set_reader;

use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::JsValue;

fn from_js<T: DeserializeOwned>(value: JsValue) -> Result<T, JsValue> {
    Ok(serde_wasm_bindgen::from_value(value)?)
}

/// Translates a value to plain objects and arrays; `None` becomes null.
fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    let plain = serde_wasm_bindgen::Serializer::json_compatible();
    value.serialize(&plain).map_err(JsValue::from)
}
