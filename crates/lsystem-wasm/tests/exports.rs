//! The exports, called the way a page calls them, in a real browser.
#![cfg(target_family = "wasm")]

use js_sys::{Array, Float32Array, JSON, Reflect};
use lsystem_wasm::{draw, expand, fresh_seed, read};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_dedicated_worker);

fn object(json: &str) -> JsValue {
    JSON::parse(json).unwrap()
}

fn get(value: &JsValue, key: &str) -> JsValue {
    Reflect::get(value, &key.into()).unwrap()
}

fn text(value: &JsValue, key: &str) -> String {
    get(value, key).as_string().unwrap()
}

const PLANT: &str = r#"{"axiom": "X", "rules": "X -> F[+X][-X]FX\nF -> FF", "angle": 25.7}"#;

#[wasm_bindgen_test]
fn expands_as_published() {
    assert_eq!(expand(object(PLANT), 0).unwrap(), "X");
    assert_eq!(expand(object(PLANT), 1).unwrap(), "F[+X][-X]FX");
    assert_eq!(expand(object(PLANT), 2).unwrap(), "FF[+F[+X][-X]FX][-F[+X][-X]FX]FFF[+X][-X]FX");
    assert_eq!(expand(object(PLANT), 7).unwrap().len(), 12_863);
}

#[wasm_bindgen_test]
fn draws_segments_with_colour_and_level() {
    let drawn = draw(object(r#"{"axiom": "f+[f]-f", "dialect": "lowercase", "angle": 90}"#), 0).unwrap();
    let points: Float32Array = drawn.segments;
    // Up; then left, in a branch, in red; then, after `-`, up again in green.
    let expected = [0.0, 0.0, 0.0, 1.0, 0.0, 1.0, -1.0, 1.0, 0.0, 1.0, 0.0, 2.0];
    assert_eq!(points.to_vec(), expected);
    assert_eq!(drawn.colours.to_vec(), [0, 1, 2]);
    assert_eq!(drawn.levels.to_vec(), [0, 1, 0]);
    assert_eq!(draw(object(PLANT), 5).unwrap().segments.length(), 4 * 422);
}

#[wasm_bindgen_test]
fn errors_are_values_with_utf16_spans() {
    // The emoji is two UTF-16 units and four bytes.
    let thrown = expand(object(r#"{"axiom": "F", "rules": "// 🌿\nF = FF"}"#), 1).unwrap_err();
    let diagnostics: Array = get(&thrown, "diagnostics").unchecked_into();
    let error = diagnostics.get(0);
    assert_eq!(text(&error, "field"), "rules");
    assert_eq!(text(&error, "severity"), "error");
    assert!(text(&error, "hint").contains("->"));
    let (start, end) = (get(&error, "start").as_f64().unwrap(), get(&error, "end").as_f64().unwrap());
    assert!((6.0..=12.0).contains(&start) && (6.0..=12.0).contains(&end) && start < end, "{start}..{end}");

    let too_long = expand(object(PLANT), 1000).unwrap_err();
    let diagnostics: Array = get(&too_long, "diagnostics").unchecked_into();
    assert!(text(&diagnostics.get(0), "message").contains("67,108,864"));
    assert!(expand(JsValue::from_f64(3.0), 1).is_err());
}

#[wasm_bindgen_test]
fn a_seed_decides_a_stochastic_system() {
    let system = |seed: u32| {
        object(&format!(r#"{{"axiom": "F", "rules": "F -> F[+F]F : 0.5\nF -> F[-F] : 0.5", "seed": {seed}}}"#))
    };
    let one = expand(system(1), 6).unwrap();
    assert_eq!(one, expand(system(1), 6).unwrap());
    assert_ne!(one, expand(system(2), 6).unwrap());
    assert_ne!((fresh_seed().unwrap(), fresh_seed().unwrap()), (fresh_seed().unwrap(), fresh_seed().unwrap()));
}

#[wasm_bindgen_test]
fn course_files_are_read() {
    let file =
        read(r#"{"name": "left", "initial": "F", "angle_deg": 60, "rules": {"F": "F[+F]F",}, /* old */ }"#).unwrap();
    let definition = get(&file, "definition");
    assert_eq!(text(&definition, "dialect"), "every-letter");
    assert_eq!(expand(definition, 1).unwrap(), "F[+F]F");
    assert!(get(&read("{").unwrap(), "definition").is_null());
}
