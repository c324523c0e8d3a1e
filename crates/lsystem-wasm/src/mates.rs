//! What workers tell each other who make a picture together: one shows it and hands out panes, its mates make them.

use crate::playground::Playground;
use crate::to_js;
use lsystem::{Pane, Spent};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A pane for a mate, in pixels.
#[derive(Serialize)]
struct Task {
    round: u32,
    number: usize,
    x: u32,
    y: u32,
    width: u32,
    height: u32,
    /// In space: what the picture may show.
    budget: f32,
}

/// What a mate has done with it.
#[derive(Default, Serialize)]
struct Outcome {
    /// Whether there are pixels.
    made: bool,
    work: f64,
    poor: bool,
    rough: bool,
}

#[wasm_bindgen]
impl Playground {
    /// Says how many mates there are, who have the same definition and view when they are handed a pane.
    #[wasm_bindgen(setter)]
    pub fn set_mates(&mut self, count: u32) {
        self.mates = count;
    }

    /// The number of the round of panes that is being made for the picture; 0 without any.
    #[wasm_bindgen(getter)]
    pub fn round(&mut self) -> u32 {
        self.shared().map_or(0, |(sharing, _)| sharing.round)
    }

    /// A pane for a mate: `{round, number, x, y, width, height, budget}`, or null.
    ///
    /// # Errors
    /// Never, on the whole.
    pub fn hand_out(&mut self) -> Result<JsValue, JsValue> {
        let task = self.shared().and_then(|(sharing, budget)| {
            let (number, Pane { x, y, width, height }) = sharing.hand_out()?;
            Some(Task { round: sharing.round, number, x, y, width, height, budget })
        });
        to_js(&task)
    }

    /// A mate has made a pane. Whether its pixels are wanted on the canvas.
    pub fn take_in(&mut self, round: u32, number: usize, work: f64, poor: bool, rough: bool) -> bool {
        self.shared()
            .is_some_and(|(sharing, _)| sharing.round == round && sharing.take_in(number, Spent { work, poor }, rough))
    }

    /// As a mate: begins a pane of the picture that was defined and viewed last.
    pub fn begin_pane(&mut self, x: u32, y: u32, width: u32, height: u32, budget: f32) {
        self.pane = Some((Pane { x, y, width, height }, budget));
    }

    /// As a mate: works at the pane for about `budget` milliseconds; `{made, work, poor, rough}` when it is there, or
    /// cannot be made, null before.
    ///
    /// # Errors
    /// Never, on the whole.
    pub fn step_pane(&mut self, budget: f64) -> Result<JsValue, JsValue> {
        let end = self.clock.now() + budget;
        let mut outcome = None;
        while outcome.is_none() {
            outcome = self.go_on_with_pane();
            if self.clock.now() >= end {
                break;
            }
        }
        to_js(&outcome)
    }

    /// As a mate: the pixels of the pane, RGBA.
    pub fn pane_pixels(&self) -> js_sys::Uint8Array {
        self.shown
            .map_or_else(|| js_sys::Uint8Array::new_with_length(0), |realm| self.views.get(realm).pane_pixels().into())
    }
}

impl Playground {
    fn go_on_with_pane(&mut self) -> Option<Outcome> {
        if self.go_on_building() {
            return None;
        }
        let (Some(scene), Some(realm), false) = (self.scene(), self.shown, self.refused) else {
            return Some(Outcome::default());
        };
        let view = self.views.at(realm);
        match self.pane.take() {
            Some((pane, budget)) => {
                view.begin_pane(scene, pane, budget);
                None
            }
            None => {
                let (Spent { work, poor }, rough) = view.step_pane()?;
                Some(Outcome { made: true, work, poor, rough })
            }
        }
    }
}
