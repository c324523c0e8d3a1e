//! Films.

mod player;
pub(crate) mod preset;
pub(crate) mod script;

pub use player::FilmPlayer;
pub use preset::with_preset;
pub use script::{read_film, subjects};

use wasm_bindgen::JsValue;

/// An error as its words.
fn words(error: impl core::fmt::Display) -> JsValue {
    error.to_string().into()
}
