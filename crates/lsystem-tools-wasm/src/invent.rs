//! New systems, and lines of descent.

use lsystem_base::Progress;
use lsystem_film::{Ending, Frame, GifWriter, LIMITS, Painter, PaletteMaker};
use lsystem_js::{from_js, to_js};
use lsystem_render::{Detail, Vantage};
use lsystem_syntax::Definition;
use wasm_bindgen::prelude::*;

/// The units of work of a step.
const STEP: u64 = 1 << 20;
/// The time for which each system of a line of descent is shown, in hundredths of a second.
const SHOWN: u16 = 90;

/// The new system with this seed: always the same.
///
/// # Errors
/// Throws only if the result cannot be translated.
#[wasm_bindgen]
pub fn surprise(seed: u32) -> Result<JsValue, JsValue> {
    to_js(&lsystem_invent::surprise(seed).0)
}

/// Up to `count` children of one or two systems.
///
/// # Errors
/// Throws if a parent is no definition.
#[wasm_bindgen]
pub fn breed(parents: JsValue, seed: u32, count: usize) -> Result<JsValue, JsValue> {
    let parents: Vec<Definition> = from_js(parents)?;
    to_js(&lsystem_invent::breed(&parents, seed, count))
}

/// A line of descent as an animated GIF: one picture for each system.
#[wasm_bindgen]
pub struct DescentFilm {
    side: u32,
    painter: Painter,
    colours: PaletteMaker,
    pictures: Vec<Vec<u8>>,
}

#[wasm_bindgen]
impl DescentFilm {
    /// A film of `side` by `side` pixels.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new(side: u32) -> Self {
        Self { side, painter: Painter::new(LIMITS), colours: PaletteMaker::default(), pictures: vec![] }
    }

    /// Adds a picture of a system.
    ///
    /// # Errors
    /// Throws the words of the first problem.
    pub fn add(&mut self, definition: JsValue) -> Result<(), JsValue> {
        let frame = Frame {
            definition: from_js(definition)?,
            vantage: Vantage::default(),
            segment: None,
            drawn: 1.0,
            framed: None,
        };
        let problem = |error: lsystem_syntax::Diagnostic| JsValue::from(error.message);
        self.painter.begin(&frame, [self.side; 2], Detail::Fine).map_err(problem)?;
        while self.painter.step(STEP).map_err(problem)? == Progress::More {}
        self.colours.add(self.painter.pixels());
        self.pictures.push(self.painter.pixels().to_vec());
        Ok(())
    }

    /// The file.
    ///
    /// # Errors
    /// Throws only if memory is full.
    pub fn finish(self) -> Result<Vec<u8>, JsValue> {
        let words = |error: &dyn core::fmt::Display| JsValue::from(error.to_string());
        let palette = self.colours.finish();
        let mut file =
            GifWriter::new([self.side; 2], Ending::Repeat, palette.clone()).map_err(|error| words(&error))?;
        for picture in &self.pictures {
            file.add(&palette.index(picture), SHOWN).map_err(|error| words(&error))?;
        }
        file.finish().map_err(|error| words(&error))
    }
}
