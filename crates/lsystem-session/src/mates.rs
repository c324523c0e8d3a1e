//! Several sessions make a picture in space together. One of them shows the picture and hands out panes; its helpers, the
//! mates, make panes.

use crate::pace::STEP;
use crate::session::Session;
use crate::sharing::Sharing;
use crate::surface::Screen;
use lsystem::Figure;
use lsystem::render::{Pane, Spent};
use serde::Serialize;
use ts_rs::TS;

/// A rectangle of the picture, in pixels of the canvas from the upper left corner, for a mate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
pub struct SharedPane {
    /// The number of the pane in its round.
    pub number: usize,
    /// The left side.
    pub x: u32,
    /// The upper side.
    pub y: u32,
    /// The width.
    pub width: u32,
    /// The height.
    pub height: u32,
    /// The most work that may be spent on the pane.
    pub budget: f32,
}

/// The work spent on a pane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
pub struct Outcome {
    /// The units of work.
    pub work: f64,
    /// Whether the pane left out detail, because its budget was too small.
    pub poor: bool,
}

/// The answer of [`Session::step_pane`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PaneStep {
    /// The pane is not complete.
    More,
    /// The pane is complete.
    Done(Outcome),
    /// The pane cannot be made: there is no drawing in space.
    Refused,
}

impl<S: Screen> Session<S> {
    /// Sets the number of mates. A mate must have the same definition and view when it is handed a pane.
    pub fn set_mates(&mut self, count: u32) {
        self.mates = count;
    }

    /// The number of the present round of panes; 0 if there is none.
    pub fn round(&mut self) -> u32 {
        self.shared().map_or(0, |(sharing, _)| sharing.round)
    }

    /// A pane for a mate, if more than `kept` panes are left.
    pub fn hand_out(&mut self, kept: usize) -> Option<SharedPane> {
        let (sharing, budget) = self.shared()?;
        let (number, Pane { x, y, width, height }) = sharing.hand_out(kept)?;
        Some(SharedPane { number, x, y, width, height, budget })
    }

    /// Whether there is nothing to do but wait for mates.
    pub fn waits(&mut self) -> bool {
        self.shared().is_some_and(|(sharing, _)| sharing.is_waiting())
    }

    /// Records that a mate has made a pane of a round. Returns whether the canvas needs the pane's pixels.
    pub fn take_in(&mut self, round: u32, number: usize, Outcome { work, poor }: Outcome) -> bool {
        self.shared()
            .is_some_and(|(sharing, _)| sharing.round == round && sharing.take_in(number, Spent { work, poor }))
    }

    /// On a mate: begins a pane of the picture with the last definition and view.
    pub fn begin_pane(&mut self, pane: Pane, budget: f32) {
        self.pane = Some((pane, budget));
    }

    /// On a mate: works on the pane for about [`STEP`] milliseconds.
    pub fn step_pane(&mut self) -> PaneStep {
        let end = (self.clock)() + STEP;
        loop {
            let step = self.continue_pane();
            if step != PaneStep::More || (self.clock)() >= end {
                return step;
            }
        }
    }

    /// On a mate: the pixels of the complete pane, RGBA.
    pub fn pane_pixels(&self) -> &[u8] {
        self.views.solid.pane_pixels()
    }

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

    fn continue_pane(&mut self) -> PaneStep {
        if !self.built() {
            self.build();
            return PaneStep::More;
        }
        let (Some(settings), true, false) = (self.settings(), self.is_in_space(), self.refused) else {
            return PaneStep::Refused;
        };
        let view = &mut self.views.solid;
        if let Some((pane, budget)) = self.pane.take() {
            view.begin_pane(settings, pane, budget);
            return PaneStep::More;
        }
        view.step_pane().map_or(PaneStep::More, |Spent { work, poor }| PaneStep::Done(Outcome { work, poor }))
    }
}
