//! The pictures of a pyramid's tiles.

use super::{Pyramid, TilePlace};
use crate::pane::{Pane, Pass};
use crate::plane::{RenderStats, Renderer, View};
use crate::viewport::Viewport;
use lsystem_base::Progress;
use lsystem_syntax::Ink;
use std::collections::VecDeque;
use std::sync::Arc;

/// Makes tiles of a pyramid, one after the other.
pub struct TileRenderer {
    pyramid: Arc<Pyramid>,
    renderer: Renderer,
    /// The pictures still to be made: those that the level's tone depends on, and the tile.
    passes: VecDeque<(View, Viewport, Pass)>,
    /// The level whose tone is known.
    toned: Option<Level>,
    blank: [u8; 4],
}

/// The part of a tile that a tone serves.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    Tiles(u32),
    Small(u32),
}

impl TileRenderer {
    /// A renderer of tiles, with or without the background.
    #[must_use]
    pub fn new(pyramid: Arc<Pyramid>, is_transparent: bool) -> Self {
        let mut renderer = Renderer::light();
        if is_transparent {
            renderer = renderer.transparent();
        }
        renderer.load(pyramid.drawing.clone());
        let [r, g, b] = pyramid.style.background.rgb;
        let blank = if is_transparent { [0; 4] } else { [r, g, b, u8::MAX] };
        Self { pyramid, renderer, passes: VecDeque::new(), toned: None, blank }
    }

    /// Starts a tile. An unfinished tile is given up.
    pub fn begin(&mut self, tile: TilePlace) {
        let pyramid = self.pyramid.clone();
        let viewport = pyramid.viewport();
        let sample = || pyramid.sample(tile.level).into_iter().map(|tile| pyramid.view(tile)).collect();
        self.start(Level::Tiles(tile.level), sample, (pyramid.view(tile), viewport));
    }

    /// Starts a picture of the whole drawing of `side` x `side` pixels, for the levels of Deep Zoom with less than a
    /// tile.
    pub fn begin_small(&mut self, side: u32) {
        let viewport = Viewport { width: side, height: side, ratio: 1.0 };
        self.start(Level::Small(side), || vec![View::default()], (View::default(), viewport));
    }

    fn start(&mut self, level: Level, sample: impl FnOnce() -> Vec<View>, (view, viewport): (View, Viewport)) {
        self.passes.clear();
        if self.pyramid.style.ink != Ink::Solid {
            if self.toned != Some(level) {
                self.passes.push_back((View::default(), viewport, Pass::Survey));
                self.passes.extend(sample().into_iter().map(|view| (view, viewport, Pass::Count)));
                self.toned = Some(level);
            }
            self.passes.push_back((view, viewport, Pass::Show));
        } else {
            self.passes.push_back((view, viewport, Pass::Only));
        }
        self.next_pass();
    }

    fn next_pass(&mut self) {
        if let Some(&(view, viewport, pass)) = self.passes.front() {
            // Memory kept from one tile for the next would depend on the order of tiles.
            self.renderer.forget();
            let pane = Pane::whole(viewport);
            self.renderer.begin_pane(&self.pyramid.style, viewport, view, None, (pane, pass));
        }
    }

    /// Goes on for about `work` units, as [`Renderer::step`].
    pub fn step(&mut self, work: usize) -> Progress {
        if !self.passes.is_empty() && self.renderer.step(work) == Progress::Done {
            self.passes.pop_front();
            self.next_pass();
        }
        if self.passes.is_empty() { Progress::Done } else { Progress::More }
    }

    /// The finished tile: RGBA, as [`Renderer::pixels`].
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.renderer.pixels()
    }

    /// Whether the finished tile shows no ink.
    #[must_use]
    pub fn is_blank(&self) -> bool {
        self.pixels().as_chunks::<4>().0.iter().all(|pixel| *pixel == self.blank)
    }

    /// The work and the memory of the tile.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.renderer.stats()
    }
}
