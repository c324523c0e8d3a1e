//! Derivations and turtles step by step.

use lsystem_base::words::said;
use lsystem_course::steps::{Order, Why, one_by_one as singles, rows, trace};
use lsystem_drawing::System;
use lsystem_js::{from_js, to_js};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// Symbols of generation `n`, from `start` (decimal digits) on, with what each becomes:
/// `{families: [{parent, children, more, first}], start, lengths}`.
///
/// # Errors
/// Throws a sentence if they cannot be read.
#[wasm_bindgen(js_name = stepRows)]
pub fn step_rows(definition: JsValue, n: u32, start: &str, count: usize) -> Result<JsValue, JsValue> {
    let start = start.parse().unwrap_or(u128::MAX);
    with_system(definition, |system| rows(system, n, start, count))
}

/// The strings of `steps` steps that replace one symbol each, the first or the last one: `[{text, length, made}]`.
///
/// # Errors
/// Throws a sentence if symbols cannot be replaced alone.
#[wasm_bindgen(js_name = oneByOne)]
pub fn one_by_one(definition: JsValue, steps: u32, is_rightmost: bool) -> Result<JsValue, JsValue> {
    let order = if is_rightmost { Order::Rightmost } else { Order::Leftmost };
    with_system(definition, |system| singles(system, steps, order))
}

/// The turtle at each of the first symbols of generation `n`:
/// `{states: [{symbol, at, axes, depth, stored, segment}], length, isSolid}`.
///
/// # Errors
/// Throws a sentence if its way is not shown.
#[wasm_bindgen(js_name = turtleTrace)]
pub fn turtle_trace(definition: JsValue, n: u32, count: usize) -> Result<JsValue, JsValue> {
    with_system(definition, |system| trace(system, n, count))
}

fn with_system<T: Serialize>(
    definition: JsValue,
    read: impl FnOnce(&System) -> Result<T, Why>,
) -> Result<JsValue, JsValue> {
    let system = System::new(&from_js(definition)?).map_err(|problems| JsValue::from(problems.to_string()))?;
    to_js(&read(&system).map_err(said)?)
}
