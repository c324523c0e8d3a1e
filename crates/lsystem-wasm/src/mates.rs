//! What workers tell each other who make a picture in space together: one shows it and hands out panes, its mates make
//! them. Numbers travel as arrays, which ports take as they are.

use crate::playground::Playground;
use crate::sharing::Sharing;
use crate::viewer::Realm;
use lsystem::render::{Pane, Spent};
use wasm_bindgen::prelude::*;

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

    /// A pane for a mate, if there are more than `kept` left: `[number, x, y, width, height, budget]`, in pixels; the
    /// budget is what the picture may show.
    #[wasm_bindgen(js_name = handOut)]
    pub fn hand_out(&mut self, kept: usize) -> Option<Vec<f64>> {
        let (sharing, budget) = self.shared()?;
        let (number, Pane { x, y, width, height }) = sharing.hand_out(kept)?;
        let [x, y, width, height] = [x, y, width, height].map(f64::from);
        Some(vec![number as f64, x, y, width, height, f64::from(budget)])
    }

    /// Whether nothing is to be done but to wait: for mates, or with a new drawing for a file.
    #[wasm_bindgen(getter)]
    pub fn waits(&mut self) -> bool {
        !self.built() && self.is_saving() || self.shared().is_some_and(|(sharing, _)| sharing.is_waiting())
    }

    /// A mate has made a pane; what it took is as [`Playground::step_pane`] tells. Whether its pixels are wanted on the
    /// canvas.
    #[wasm_bindgen(js_name = takeIn)]
    pub fn take_in(&mut self, round: u32, number: usize, work: f64, poor: bool) -> bool {
        self.shared()
            .is_some_and(|(sharing, _)| sharing.round == round && sharing.take_in(number, Spent { work, poor }))
    }

    /// As a mate: begins a pane of the picture that was defined and viewed last.
    #[wasm_bindgen(js_name = beginPane)]
    pub fn begin_pane(&mut self, x: u32, y: u32, width: u32, height: u32, budget: f32) {
        self.pane = Some((Pane { x, y, width, height }, budget));
    }

    /// As a mate: works at the pane for about `budget` milliseconds; when it is there, `[work, poor]`, what it took, and 1
    /// where something had to go without. Nothing before, and an empty array where it cannot be made.
    #[wasm_bindgen(js_name = stepPane)]
    pub fn step_pane(&mut self, budget: f64) -> Option<Vec<f64>> {
        let end = self.clock.now() + budget;
        loop {
            let outcome = self.go_on_with_pane();
            if outcome.is_some() || self.clock.now() >= end {
                return outcome;
            }
        }
    }

    /// As a mate: the pixels of the pane, RGBA.
    #[wasm_bindgen(js_name = panePixels)]
    pub fn pane_pixels(&self) -> js_sys::Uint8Array {
        self.views.solid.pane_pixels().into()
    }
}

impl Playground {
    /// The panes that mates may help with, and the picture's budget, while one is made that is still wanted.
    fn shared(&mut self) -> Option<(&mut Sharing, f32)> {
        if self.stale || !self.built() || self.shown != Some(Realm::Space) {
            return None;
        }
        self.views.solid.sharing()
    }

    fn go_on_with_pane(&mut self) -> Option<Vec<f64>> {
        if self.go_on_building() {
            return None;
        }
        let (Some(scene), Some(Realm::Space), false) = (self.scene(), self.shown, self.refused) else {
            return Some(vec![]);
        };
        let view = &mut self.views.solid;
        if let Some((pane, budget)) = self.pane.take() {
            view.begin_pane(scene, pane, budget);
            return None;
        }
        let Spent { work, poor } = view.step_pane()?;
        Some(vec![work, f64::from(poor)])
    }
}
