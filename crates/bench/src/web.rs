//! The measured work as functions that a script in the browser times.

use crate::{Buffers, GROWTHS, Growth, WORKS, Work};
use lsystem::System;
use lsystem::derive::Rules;
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// One work with its system and buffers.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Bench {
    work: Work,
    system: System,
    buffers: Buffers,
}

#[wasm_bindgen]
impl Bench {
    /// The work at `index`, or `undefined` after the last. `shorter` work is for comparing results.
    #[must_use]
    pub fn at(index: usize, shorter: bool) -> Option<Self> {
        let work = *WORKS.get(index)?;
        let work = if shorter { work.shorter() } else { work };
        Some(Self { work, system: work.system(), buffers: Buffers::default() })
    }

    /// The work as JSON: name, axiom, rules, angle, n.
    #[must_use]
    pub fn work(&self) -> String {
        let Work { name, axiom, rules, angle, n } = self.work;
        serde_json::json!({"name": name, "axiom": axiom, "rules": rules, "angle": angle, "n": n}).to_string()
    }

    /// Derives the string into reused memory. Returns the number of symbols.
    pub fn expand(&mut self) -> f64 {
        self.buffers.expand(&self.system, self.work.n) as f64
    }

    /// Copies the string. Returns the number of bytes.
    #[wasm_bindgen(js_name = copyText)]
    pub fn copy_text(&mut self) -> f64 {
        self.buffers.copy_text() as f64
    }

    /// Draws and writes all segments to reused memory. Returns the number of segments.
    pub fn draw(&mut self) -> f64 {
        self.buffers.draw(&self.system, self.work.n) as f64
    }

    /// Draws and reads all segments in chunks. Returns the number of segments.
    #[wasm_bindgen(js_name = drawInChunks)]
    pub fn draw_in_chunks(&mut self) -> f64 {
        self.buffers.draw_in_chunks(&self.system, self.work.n) as f64
    }

    /// Copies the segments' ends. Returns the number of segments.
    #[wasm_bindgen(js_name = copySegments)]
    pub fn copy_segments(&mut self) -> f64 {
        self.buffers.copy_segments() as f64
    }

    /// The string derived last.
    #[must_use]
    pub fn text(&self) -> String {
        self.buffers.text.clone()
    }
}

/// One derivation with its rules.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Derivation {
    growth: Growth,
    rules: Arc<Rules>,
}

#[wasm_bindgen]
impl Derivation {
    /// The derivation at `index`, or `undefined` after the last.
    #[must_use]
    pub fn at(index: usize) -> Option<Self> {
        let growth = GROWTHS.get(index)?.clone();
        Some(Self { growth, rules: growth.compile() })
    }

    /// The work as JSON: kind of work, name, axiom, n, number of modules in generation n.
    #[must_use]
    pub fn work(&self) -> String {
        let Growth { name, what, axiom, n, modules, .. } = &self.growth;
        serde_json::json!({"what": what, "name": name, "axiom": axiom, "n": n, "modules": modules}).to_string()
    }

    /// Derives generation n. Returns the number of modules read.
    #[must_use]
    pub fn derive(&self) -> f64 {
        self.growth.derive(&self.rules) as f64
    }
}
