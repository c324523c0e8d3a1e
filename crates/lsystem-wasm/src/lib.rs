//! The boundary between the core and JavaScript. This crate only translates.
//!
//! Two plain functions, [`expand`](fn@expand) and [`draw`](fn@draw), turn a definition into a string and into typed
//! arrays. [`Playground`] is the page's handle: a [`Session`](lsystem_session::Session) that paints an `OffscreenCanvas`.
//! A definition is a plain object with the fields of [`lsystem::Definition`] in camel case; missing fields have their
//! defaults. Results are plain objects with the fields of Rust's types; `None` is null. Errors and warnings are structured
//! values ([`lsystem_session::Problem`]) with UTF-16 spans. The plain functions throw them as `{diagnostics: [..]}`. Programs
//! of others have a boundary of their own, `lsystem-library-wasm`.

mod canvas;
mod plain;
mod playground;
mod texts;
mod words;

pub use plain::{Segments, draw, expand, fresh_seed};
pub use playground::Playground;
pub use texts::{notation, qr_code, read_file, site_of};
pub use words::set_reader;

use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::*;

/// The types of arguments and results, for the generated declarations only.
#[wasm_bindgen(typescript_custom_section)]
const MESSAGES: &str = include_str!("../../../www/js/messages.d.ts");

fn from_js<T: DeserializeOwned>(value: JsValue) -> Result<T, JsValue> {
    Ok(serde_wasm_bindgen::from_value(value)?)
}

/// Translates a value to plain objects and arrays; `None` becomes null.
fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    let plain = serde_wasm_bindgen::Serializer::json_compatible();
    value.serialize(&plain).map_err(JsValue::from)
}
