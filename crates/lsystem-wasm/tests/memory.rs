//! The memory limit of one instance, under the largest load. This file runs in an instance of its own.
#![cfg(target_family = "wasm")]

use js_sys::{JSON, Reflect};
use lsystem_wasm::Playground;
use wasm_bindgen::JsValue;
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};
use web_sys::OffscreenCanvas;

wasm_bindgen_test_configure!(run_in_dedicated_worker);

/// The most bytes of an instance, as ARCHITECTURE.md states.
const MAX: usize = 256 << 20;

fn is(value: &JsValue, key: &str) -> bool {
    Reflect::get(value, &key.into()).unwrap().is_truthy()
}

/// Works until the playground is idle.
fn settle(playground: &mut Playground) {
    while !is(&playground.step().unwrap(), "idle") {}
}

fn playground(make: fn(OffscreenCanvas) -> Result<Playground, JsValue>, width: u32, height: u32) -> Playground {
    let mut playground = make(OffscreenCanvas::new(1, 1).unwrap()).unwrap();
    let view = r#""view": {"x": 0, "y": 0, "zoom": 1}, "camera": null"#;
    let vantage = format!(r#"{{"width": {width}, "height": {height}, "ratio": 1, {view}}}"#);
    playground.look(JSON::parse(&vantage).unwrap()).unwrap();
    playground
}

/// Draws the largest system that is within the limits, with an axiom of at most `refused` letters. Returns the number
/// of letters.
fn largest(playground: &mut Playground, turn: char, refused: usize) -> usize {
    for count in (1..=refused).rev() {
        let (axiom, first, second) = ("F".repeat(count), format!("F{turn}F"), format!("F[{turn}F]"));
        let definition = format!(
            r#"{{"axiom": "{axiom}", "rules": "F -> {first} : 1\nF -> {second} : 1", "angle": 20, "iterations": 16}}"#
        );
        playground.define(JSON::parse(&definition).unwrap()).unwrap();
        let mut drawn = false;
        loop {
            let step = playground.step().unwrap();
            let report = Reflect::get(&step, &"report".into()).unwrap();
            drawn |= !report.is_null() && !Reflect::get(&report, &"memoised".into()).unwrap().is_null();
            if is(&step, "idle") {
                break;
            }
        }
        if drawn {
            return count;
        }
    }
    0
}

/// Checks the memory taken so far.
fn within(what: &str) {
    let bytes = core::arch::wasm32::memory_size(0) << 16;
    wasm_bindgen_test::console_log!("{what}: {} MiB", bytes >> 20);
    assert!(bytes <= MAX, "{what}: {} MiB", bytes >> 20);
}

#[wasm_bindgen_test]
fn the_largest_drawings_stay_within_the_limit() {
    for (turn, refused, place) in [('+', 24, "in the plane"), ('&', 6, "in space")] {
        let mut shown = playground(Playground::new, 1920, 1080);
        let count = largest(&mut shown, turn, refused);
        assert!(0 < count && count < refused, "{count}");
        within(&format!("{count} x 2^16 segments {place}"));
        shown.play(Some(400_000));
        settle(&mut shown);
        within("a part of them");
        while !shown.remember(Some(8)) {}
        within("read");
        shown.forget();
        let mut small = playground(Playground::small, 336, 336);
        let few = largest(&mut small, turn, refused / 2 + 1);
        assert!(0 < few && few <= refused / 2, "{few}");
        within("with a small picture");
        drop(small);
        largest(&mut shown, turn, count + 1);
        within("drawn anew");
    }
}
