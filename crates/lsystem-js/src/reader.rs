//! Words that JavaScript gives: a worker hands over a function that knows the catalogue of the page.

use js_sys::Function;
use std::cell::RefCell;
use wasm_bindgen::JsValue;

thread_local! {
    static READER: RefCell<Option<Function>> = const { RefCell::new(None) };
}

/// Sets the function that finds translations. It gets an English text and a number or null, and returns the
/// translation, or null if there is none.
pub fn set_reader(reader: Function) {
    READER.set(Some(reader));
    lsystem_base::words::set_reader(read);
}

fn read(text: &str, number: Option<u64>) -> Option<String> {
    let number = number.map_or(JsValue::NULL, |number| JsValue::from_f64(number as f64));
    READER.with_borrow(|reader| reader.as_ref()?.call2(&JsValue::NULL, &text.into(), &number).ok()?.as_string())
}
