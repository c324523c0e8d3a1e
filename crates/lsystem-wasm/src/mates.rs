//! The messages of workers that make a picture in space together. One worker shows the picture and hands out panes; its
//! helpers, the mates, make panes. Numbers travel as arrays, which message ports copy unchanged.

use crate::playground::Playground;
use crate::sharing::Sharing;
use lsystem::Figure;
use lsystem::render::{Pane, Spent};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Playground {
    /// Sets the number of mates. A mate must have the same definition and view when it is handed a pane.
    #[wasm_bindgen(setter)]
    pub fn set_mates(&mut self, count: u32) {
        self.mates = count;
    }

    /// The number of the present round of panes; 0 if there is none.
    #[wasm_bindgen(getter)]
    pub fn round(&mut self) -> u32 {
        self.shared().map_or(0, |(sharing, _)| sharing.round)
    }

    /// A pane for a mate, if more than `kept` panes are left: `[number, x, y, width, height, budget]`. The place and
    /// size are in pixels; the budget is for [`Playground::begin_pane`].
    #[wasm_bindgen(js_name = handOut)]
    pub fn hand_out(&mut self, kept: usize) -> Option<Vec<f64>> {
        let (sharing, budget) = self.shared()?;
        let (number, Pane { x, y, width, height }) = sharing.hand_out(kept)?;
        let [x, y, width, height] = [x, y, width, height].map(f64::from);
        Some(vec![number as f64, x, y, width, height, f64::from(budget)])
    }

    /// Whether there is nothing to do but wait for mates.
    #[wasm_bindgen(getter)]
    pub fn waits(&mut self) -> bool {
        self.shared().is_some_and(|(sharing, _)| sharing.is_waiting())
    }

    /// Records that a mate has made a pane; `work` and `poor` as [`Playground::step_pane`]. Returns whether the canvas
    /// needs the pane's pixels.
    #[wasm_bindgen(js_name = takeIn)]
    pub fn take_in(&mut self, round: u32, number: usize, work: f64, poor: bool) -> bool {
        self.shared()
            .is_some_and(|(sharing, _)| sharing.round == round && sharing.take_in(number, Spent { work, poor }))
    }

    /// On a mate: begins a pane of the picture with the last definition and view.
    #[wasm_bindgen(js_name = beginPane)]
    pub fn begin_pane(&mut self, x: u32, y: u32, width: u32, height: u32, budget: f32) {
        self.pane = Some((Pane { x, y, width, height }, budget));
    }

    /// On a mate: works on the pane for about `budget` milliseconds. Returns `undefined` until the pane is done, then
    /// `[work, poor]`: the units of work, and 1 if the pane left out detail. Returns an empty array if the pane cannot
    /// be made.
    #[wasm_bindgen(js_name = stepPane)]
    pub fn step_pane(&mut self, budget: f64) -> Option<Vec<f64>> {
        let end = self.clock.now() + budget;
        loop {
            let outcome = self.continue_pane();
            if outcome.is_some() || self.clock.now() >= end {
                return outcome;
            }
        }
    }

    /// On a mate: the pixels of the pane, RGBA.
    #[wasm_bindgen(js_name = panePixels)]
    pub fn pane_pixels(&self) -> js_sys::Uint8Array {
        self.views.solid.pane_pixels().into()
    }
}

impl Playground {
    /// The panes of the shared picture and the picture's budget; `None` if no up-to-date picture is shared.
    fn shared(&mut self) -> Option<(&mut Sharing, f32)> {
        if self.stale || !self.built() || !self.is_in_space() {
            return None;
        }
        self.views.solid.sharing()
    }

    fn is_in_space(&self) -> bool {
        matches!(self.shown, Some(Figure::Space(_)))
    }

    /// Continues the pane; the result is as [`Playground::step_pane`].
    fn continue_pane(&mut self) -> Option<Vec<f64>> {
        if !self.built() {
            self.build();
            return None;
        }
        let (Some(settings), true, false) = (self.settings(), self.is_in_space(), self.refused) else {
            return Some(vec![]);
        };
        let view = &mut self.views.solid;
        if let Some((pane, budget)) = self.pane.take() {
            view.begin_pane(settings, pane, budget);
            return None;
        }
        let Spent { work, poor } = view.step_pane()?;
        Some(vec![work, f64::from(poor)])
    }
}
