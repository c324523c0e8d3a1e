//! The memory limit of one instance, under the largest files. This file runs in an instance of its own.
#![cfg(target_family = "wasm")]

use js_sys::{JSON, Reflect};
use lsystem_tools_wasm::{make_file, make_picture};
use wasm_bindgen::prelude::*;
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_dedicated_worker);

/// The most bytes of an instance, as ARCHITECTURE.md states.
const MAX: usize = 256 << 20;

/// The size of pictures of pixels, which are made in several bands.
const SIZE: &str = "4096x2304";

/// Makes a file of a drawing without shared blocks, with 2^16 segments for each of `count` letters. Returns whether the
/// file is complete.
fn make(format: &str, turn: char, count: usize) -> bool {
    let (axiom, first, second) = ("F".repeat(count), format!("F{turn}F"), format!("F[{turn}F]"));
    let options = if format == "png" { format!(r#""size": "{SIZE}""#) } else { String::new() };
    let asked = format!(
        r#"{{"format": "{format}", "options": {{{options}}}, "definition": {{"axiom": "{axiom}", "rules": "F -> {first} : 1\nF -> {second} : 1", "angle": 20, "iterations": 16}}}}"#
    );
    let page = Closure::<dyn Fn(JsValue)>::new(drop::<JsValue>);
    let write = if format == "png" { make_picture } else { make_file };
    let report = write(JSON::parse(&asked).unwrap(), page.as_ref().unchecked_ref()).unwrap();
    let bytes = core::arch::wasm32::memory_size(0) << 16;
    wasm_bindgen_test::console_log!("{format} of {count} x 2^16 segments: {} MiB", bytes >> 20);
    assert!(bytes <= MAX, "{format} of {count} x 2^16 segments: {} MiB", bytes >> 20);
    Reflect::get(&report, &"complete".into()).unwrap().is_truthy()
}

#[wasm_bindgen_test]
fn the_largest_files_stay_within_the_limit() {
    for (turn, refused) in [('+', 24), ('&', 6)] {
        let count = (1..=refused).rev().find(|&count| make("csv", turn, count)).unwrap();
        assert!(count < refused, "{count}");
        for format in ["svg", "txt", "glb", "png"] {
            make(format, turn, count);
        }
        // The largest number of segments in a mesh or a projection.
        for format in ["svg", "obj"] {
            make(format, turn, 3);
        }
    }
}
