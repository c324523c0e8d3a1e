//! The exports, called the way a page calls them, in a real browser.
#![cfg(target_family = "wasm")]

use js_sys::{Array, JSON, Reflect};
use lsystem::{Definition, write_json};
use lsystem_wasm::{Playground, fresh_seed, notation, qr_code, read_file};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};
use web_sys::OffscreenCanvas;

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

#[wasm_bindgen_test]
fn texts_are_classed_by_utf16_unit() {
    let definition = object(r#"{"axiom": "[F", "rules": "// 🌿\nr = 0.9\nF = ", "overrides": "G: move"}"#);
    let notation = notation(definition).unwrap();
    assert_eq!(text(&notation, "axiom"), "b_");
    assert_eq!(text(&notation, "rules"), "ccccc_k_m_nnn_k_m_");
    assert_eq!(text(&notation, "overrides"), "pm_____");
    let constant = get(&notation, "constants").unchecked_into::<Array>().get(0);
    assert_eq!(text(&constant, "name"), "r");
    assert_eq!(get(&constant, "value").as_f64(), Some(0.9));
    assert_eq!([get(&constant, "start").as_f64(), get(&constant, "end").as_f64()], [Some(10.0), Some(13.0)]);
    assert_eq!(get(&constant, "number").as_bool(), Some(true));
}

#[wasm_bindgen_test]
fn seeds_are_random() {
    assert_ne!((fresh_seed().unwrap(), fresh_seed().unwrap()), (fresh_seed().unwrap(), fresh_seed().unwrap()));
}

#[wasm_bindgen_test]
fn course_files_are_read() {
    let file =
        read_file(br#"{"name": "left", "initial": "F", "angle_deg": 60, "rules": {"F": "F[+F]F",}, /* old */ }"#)
            .unwrap();
    let definition = get(&file, "definition");
    assert_eq!(text(&definition, "dialect"), "every-letter");
    assert_eq!(text(&definition, "rules"), "F -> F[+F]F");
    assert!(get(&read_file(b"{").unwrap(), "definition").is_null());
}

/// The fitted view of a canvas.
fn fitted(width: u32, height: u32) -> JsValue {
    let view = r#""view": {"x": 0, "y": 0, "zoom": 1}, "camera": null"#;
    object(&format!(r#"{{"width": {width}, "height": {height}, "ratio": 1, {view}}}"#))
}

/// The symbols of a page of a generation's string.
fn slice(playground: &Playground, generation: u32, start: u128, count: usize) -> String {
    text(&playground.string(generation, start, count).unwrap(), "text")
}

/// Works until the playground is idle. Returns the last report.
fn settled(playground: &mut Playground) -> JsValue {
    let mut last = JsValue::NULL;
    for _ in 0..2000 {
        let step = playground.step().unwrap();
        let report = get(&step, "report");
        if !report.is_null() {
            last = report;
        }
        if get(&step, "idle").is_truthy() {
            return last;
        }
    }
    panic!("the playground is not idle after 2000 steps");
}

#[wasm_bindgen_test]
fn a_playground_draws_and_reads_in_place() {
    let canvas = OffscreenCanvas::new(64, 64).unwrap();
    let mut playground = Playground::new(canvas.clone()).unwrap();
    let report =
        playground.define(object(r#"{"axiom": "F", "rules": "F -> F[+F]F[-F]F", "angle": 25.7, "iterations": 40}"#));
    assert_eq!(text(&report.unwrap(), "segments"), 5_u128.pow(40).to_string());
    playground.look(fitted(64, 64)).unwrap();
    settled(&mut playground);

    let context: web_sys::OffscreenCanvasRenderingContext2d =
        canvas.get_context("2d").unwrap().unwrap().unchecked_into();
    let pixels = context.get_image_data(0.0, 0.0, 64.0, 64.0).unwrap().data();
    let background = &pixels[..4];
    let drawn = pixels.chunks(4).filter(|pixel| *pixel != background).count();
    assert!((100..4000).contains(&drawn), "{drawn} pixels are drawn on");

    assert_eq!(slice(&playground, 1, 0, 99), "F[+F]F[-F]F");
    assert_eq!(slice(&playground, 40, 0, 4), "F[+F");
    let symbol = playground.symbol(1, 10).unwrap();
    let chain: Array = get(&symbol, "ancestry").unchecked_into();
    assert_eq!(chain.length(), 2);
    assert_eq!([text(&chain.get(1), "symbol"), text(&chain.get(1), "index")], ["F", "10"]);
    let part = get(&symbol, "part");
    assert_eq!(text(&get(&part, "segments"), "1"), 5_u128.pow(40).to_string());
    assert!(get(&part, "outline").unchecked_into::<Array>().length() > 2);
    let first: Array = get(&get(&symbol, "stroke"), "fittedFrom").unchecked_into();
    assert_eq!(first.length(), 4);
    assert_eq!(playground.descendant(1, 10, 1).unwrap(), "10");
    // The stem goes up the picture. To its right, below the first leaves, the picture is empty.
    let picked = playground.pick(32.0, 60.0, 6.0).unwrap();
    assert!(get(&get(&picked, "stroke"), "heading").as_f64().is_some());
    assert!(get(&playground.pick(1.0, 63.0, 2.0).unwrap(), "segment").is_null());

    // A mistake keeps the last good drawing.
    let wrong = playground.define(object(r#"{"axiom": "F", "rules": "F = FF"}"#)).unwrap();
    assert!(!get(&wrong, "ok").is_truthy());
    settled(&mut playground);
    assert_eq!(slice(&playground, 1, 0, 99), "F[+F]F[-F]F");
}

#[wasm_bindgen_test]
fn chance_and_limits_are_reported_when_they_are_known() {
    let mut playground = Playground::new(OffscreenCanvas::new(8, 8).unwrap()).unwrap();
    let random = r#"{"axiom": "F", "rules": "F -> FF : 0.5\nF -> F[+F] : 0.5", "angle": 20, "iterations": 6}"#;
    let early = playground.define(object(random)).unwrap();
    assert_eq!(text(&early, "segments"), "64");
    playground.look(fitted(8, 8)).unwrap();
    let report = settled(&mut playground);
    assert!(get(&playground.string(6, 0, 9).unwrap(), "length").is_null());
    while !playground.remember(None) {}
    let page = playground.string(6, 0, 1 << 20).unwrap();
    let length: usize = text(&page, "length").parse().unwrap();
    assert_eq!(text(&page, "text").len(), length);
    assert_eq!(text(&report, "symbols"), length.to_string());
    let last = playground.symbol(6, length as u128 - 1).unwrap();
    assert_eq!(get(&last, "ancestry").unchecked_into::<Array>().length(), 7);
    let axiom = playground.symbol(0, 0).unwrap();
    assert_eq!(text(&get(&get(&axiom, "part"), "segments"), "1"), "64");

    playground.define(object(&random.replace("\"iterations\": 6", "\"iterations\": 60"))).unwrap();
    let report = settled(&mut playground);
    assert_eq!(get(&report, "largest").as_f64(), Some(20.0));
}

#[wasm_bindgen_test]
fn modules_are_read_with_their_arguments() {
    let mut playground = Playground::new(OffscreenCanvas::new(8, 8).unwrap()).unwrap();
    let tree = r#"{"axiom": "A(1)", "rules": "A(l) : l > 0.3 -> F(l)[+A(l*0.5)]A(l*0.5)", "iterations": 3}"#;
    playground.define(object(tree)).unwrap();
    settled(&mut playground);
    while !playground.remember(Some(3)) {}
    let page = playground.string(2, 0, 5).unwrap();
    assert_eq!(get(&page, "apart").as_bool(), Some(true));
    assert_eq!(text(&page, "text"), "F(1)\n[\n+\nF(0.5)\n[\n");
    assert_eq!(text(&playground.string(1, 0, 0).unwrap(), "length"), "6");
    let chain: Array = get(&playground.symbol(2, 3).unwrap(), "ancestry").unchecked_into();
    assert_eq!(text(&chain.get(1), "symbol"), "A(0.5)");
}

#[wasm_bindgen_test]
fn pictures_carry_their_system() {
    const PNG: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\0\0\0\0\x3a\x7e\x9b\x55";
    let definition = Definition { rules: "X -> F[+X][-X]FX\nF -> FF".into(), ..Definition::default() };
    let words = ["L-system\0\0\0\0\0", &write_json(&definition)].concat();
    // Checksums are not verified.
    let chunk = [&(words.len() as u32).to_be_bytes(), &b"iTXt"[..], words.as_bytes(), &[0; 4]].concat();
    let file = read_file(&[PNG, &chunk].concat()).unwrap();
    assert_eq!(text(&get(&file, "definition"), "rules"), "X -> F[+X][-X]FX\nF -> FF");
    assert_eq!(get(&file, "diagnostics").unchecked_into::<Array>().length(), 0);
    let none = read_file(PNG).unwrap();
    assert!(get(&none, "definition").is_null());
    assert_eq!(get(&none, "diagnostics").unchecked_into::<Array>().length(), 1);
}

#[wasm_bindgen_test]
fn qr_codes_are_bytes() {
    assert_eq!(qr_code("https://example.org/#v=1&axiom=F").map(|modules| modules.len()), Some(25 * 25));
    assert_eq!(qr_code(&"x".repeat(1733)), None);
}

/// Two playgrounds with the same state: one shows the picture, the other makes the panes that it is handed.
#[wasm_bindgen_test]
fn a_mate_makes_panes_of_the_picture() {
    let tree = r#"{"axiom": "T", "rules": "T -> TF\nF -> F[+F][-FF][<F][>FF][&F]", "dialect": "practical", "angle": 40, "iterations": 8}"#;
    let canvas = OffscreenCanvas::new(1, 1).unwrap();
    let mut own = Playground::new(canvas.clone()).unwrap();
    let mut mate = Playground::new(OffscreenCanvas::new(1, 1).unwrap()).unwrap();
    for playground in [&mut own, &mut mate] {
        playground.define(object(tree)).unwrap();
        playground.look(fitted(600, 300)).unwrap();
    }
    assert!(own.round() == 0 && own.hand_out(0).unwrap().is_null());
    own.set_mates(1);
    let (mut made, mut complete) = (0, false);
    while !complete {
        let drawn = get(&own.step().unwrap(), "drawn");
        complete = !drawn.is_null() && get(&drawn, "complete").as_bool().unwrap();
        let round = own.round();
        loop {
            let pane = own.hand_out(0).unwrap();
            if pane.is_null() {
                break;
            }
            let [number, x, y, width, height, budget] =
                ["number", "x", "y", "width", "height", "budget"].map(|key| get(&pane, key).as_f64().unwrap());
            mate.begin_pane(x as u32, y as u32, width as u32, height as u32, budget as f32);
            let outcome = outcome(&mut mate);
            let (work, poor) = (get(&outcome, "work").as_f64().unwrap(), get(&outcome, "poor").is_truthy());
            assert_eq!(f64::from(mate.pane_pixels().length()), 4.0 * width * height);
            assert!(!own.take_in(round + 1, number as usize, work, poor), "another round");
            assert!(own.take_in(round, number as usize, work, poor));
            made += 1;
        }
    }
    assert!(made > 0 && own.round() == 0);
    // A definition that cannot be drawn has no panes.
    mate.define(object(r#"{"axiom": "F", "rules": "F -> FF : 1\nF -> F : 1", "iterations": 1000}"#)).unwrap();
    mate.begin_pane(0, 0, 16, 16, 0.0);
    assert!(outcome(&mut mate).is_null());
}

/// Works on the pane until it is complete, or cannot be made.
fn outcome(mate: &mut Playground) -> JsValue {
    loop {
        let outcome = mate.step_pane().unwrap();
        if !outcome.is_undefined() {
            return outcome;
        }
    }
}
