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

pub use plain::{PlainSegments, draw, expand, fresh_seed};
pub use playground::Playground;
pub use texts::{notation, qr_code, read_file, site_of};

use wasm_bindgen::prelude::*;

/// The types of arguments and results, for the generated declarations only.
#[wasm_bindgen(typescript_custom_section)]
const MESSAGES: &str = include_str!("../../../www/js/messages.d.ts");

/// Sets the function that finds translations, as [`lsystem_js::set_reader`].
#[wasm_bindgen(js_name = setReader)]
pub fn set_reader(reader: js_sys::Function) {
    lsystem_js::set_reader(reader);
}
