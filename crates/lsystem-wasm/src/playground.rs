//! The page's handle of a session.

use crate::canvas::{Canvas, clock};
use lsystem::Viewport;
use lsystem::render::{PageCamera, PageView, Pane};
use lsystem_js::{from_js, to_js};
use lsystem_session::{Outcome, PaneStep, Session};
use serde::Deserialize;
use wasm_bindgen::prelude::*;
use web_sys::OffscreenCanvas;

/// A [`Session`] that paints a canvas. Big integers are numbers of symbols and segments, counted from 0.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Playground(Session<Canvas>);

/// The canvas and the place to look from, with the members that [`Playground::look`] reads.
#[derive(Deserialize)]
struct PageVantage {
    width: u32,
    height: u32,
    ratio: f64,
    view: PageView,
    camera: Option<PageCamera>,
}

#[wasm_bindgen]
impl Playground {
    /// A playground that paints `canvas`.
    ///
    /// # Errors
    /// Throws if the canvas has no 2D context.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        Ok(Self(Session::new(Canvas::new(canvas)?, clock())))
    }

    /// A playground for small pictures, with little memory and without counts.
    ///
    /// # Errors
    /// Throws if the canvas has no 2D context.
    pub fn small(canvas: OffscreenCanvas) -> Result<Self, JsValue> {
        Ok(Self(Session::small(Canvas::new(canvas)?, clock())))
    }

    /// As [`Session::define`].
    ///
    /// # Errors
    /// Throws if the argument is not a definition.
    #[wasm_bindgen(unchecked_return_type = "Report")]
    pub fn define(&mut self, definition: JsValue) -> Result<JsValue, JsValue> {
        to_js(&self.0.define(from_js(definition)?))
    }

    /// Sets `{width, height, ratio, view, camera}`: the size of the canvas in device pixels, device pixels per CSS pixel,
    /// and the page's view and camera; null for the opening camera.
    ///
    /// # Errors
    /// Throws if the argument is something else.
    pub fn look(
        &mut self,
        #[wasm_bindgen(
            unchecked_param_type = "{width: number, height: number, ratio: number, view: object, camera: object | null}"
        )]
        vantage: JsValue,
    ) -> Result<(), JsValue> {
        let PageVantage { width, height, ratio, view, camera } = from_js(vantage)?;
        self.0.set_origin(view.origin());
        self.0.look(Viewport { width, height, ratio }, view.into(), camera.map(Into::into));
        Ok(())
    }

    /// As [`Session::hold`].
    pub fn hold(&mut self, is_held: bool) {
        self.0.hold(is_held);
    }

    /// As [`Session::play`].
    pub fn play(&mut self, upto: Option<u128>) {
        self.0.play(upto);
    }

    /// As [`Session::built`].
    #[wasm_bindgen(getter)]
    pub fn built(&self) -> bool {
        self.0.built()
    }

    /// As [`Session::step`].
    ///
    /// # Errors
    /// Throws if the canvas refuses the picture.
    #[wasm_bindgen(unchecked_return_type = "StepAnswer")]
    pub fn step(&mut self) -> Result<JsValue, JsValue> {
        to_js(&self.0.step()?)
    }

    /// As [`Session::forget`].
    pub fn forget(&mut self) {
        self.0.forget();
    }

    /// As [`Session::remember`].
    pub fn remember(&mut self, generation: Option<u32>) -> bool {
        self.0.remember(generation)
    }

    /// As [`Session::string`].
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    #[wasm_bindgen(unchecked_return_type = "StringPage")]
    pub fn string(&self, generation: u32, start: u128, count: usize) -> Result<JsValue, JsValue> {
        to_js(&self.0.string(generation, start, count))
    }

    /// As [`Session::symbol`].
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    #[wasm_bindgen(unchecked_return_type = "SymbolFacts")]
    pub fn symbol(&self, generation: u32, index: u128) -> Result<JsValue, JsValue> {
        to_js(&self.0.symbol(generation, index))
    }

    /// As [`Session::descendant`].
    pub fn descendant(&self, generation: u32, index: u128, later: u32) -> Option<String> {
        self.0.descendant(generation, index, later)
    }

    /// As [`Session::pick`].
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    #[wasm_bindgen(unchecked_return_type = "Picked")]
    pub fn pick(&self, x: f64, y: f64, tolerance: f64) -> Result<JsValue, JsValue> {
        to_js(&self.0.pick(x, y, tolerance))
    }

    /// As [`Session::anchor`]; null for none.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    #[wasm_bindgen(unchecked_return_type = "Anchor | null")]
    pub fn anchor(&self, x: f64, y: f64, reach: f64) -> Result<JsValue, JsValue> {
        to_js(&self.0.anchor(x, y, reach))
    }

    /// As [`Session::set_mates`].
    #[wasm_bindgen(setter)]
    pub fn set_mates(&mut self, count: u32) {
        self.0.set_mates(count);
    }

    /// As [`Session::round`].
    #[wasm_bindgen(getter)]
    pub fn round(&mut self) -> u32 {
        self.0.round()
    }

    /// As [`Session::waits`].
    #[wasm_bindgen(getter)]
    pub fn waits(&mut self) -> bool {
        self.0.waits()
    }

    /// As [`Session::hand_out`].
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    #[wasm_bindgen(js_name = handOut, unchecked_return_type = "SharedPane | null")]
    pub fn hand_out(&mut self, kept: usize) -> Result<JsValue, JsValue> {
        to_js(&self.0.hand_out(kept))
    }

    /// As [`Session::take_in`].
    /// `work` and `poor` are those of [`Playground::step_pane`].
    #[wasm_bindgen(js_name = takeIn)]
    pub fn take_in(&mut self, round: u32, number: usize, work: f64, poor: bool) -> bool {
        self.0.take_in(round, number, Outcome { work, poor })
    }

    /// As [`Session::begin_pane`].
    /// The numbers are those of [`Playground::hand_out`], which are not passed as an object, because its reader takes
    /// thousands of bytes.
    #[wasm_bindgen(js_name = beginPane)]
    pub fn begin_pane(&mut self, x: u32, y: u32, width: u32, height: u32, budget: f32) {
        self.0.begin_pane(Pane { x, y, width, height }, budget);
    }

    /// As [`Session::step_pane`]: `undefined` until the pane is complete, then its outcome; null if it cannot be made.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    #[wasm_bindgen(js_name = stepPane, unchecked_return_type = "Outcome | null | undefined")]
    pub fn step_pane(&mut self) -> Result<JsValue, JsValue> {
        match self.0.step_pane() {
            PaneStep::More => Ok(JsValue::UNDEFINED),
            PaneStep::Done(outcome) => to_js(&outcome),
            PaneStep::Refused => Ok(JsValue::NULL),
        }
    }

    /// As [`Session::pane_pixels`].
    #[wasm_bindgen(js_name = panePixels)]
    pub fn pane_pixels(&self) -> js_sys::Uint8Array {
        self.0.pane_pixels().into()
    }
}
