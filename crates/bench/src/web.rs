//! The same measurements for a browser's script to time.

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
    /// The work at `index`, or nothing after the last; a `shorter` one is for comparing results.
    #[must_use]
    pub fn at(index: usize, shorter: bool) -> Option<Self> {
        let work = *WORKS.get(index)?;
        let work = if shorter { work.shorter() } else { work };
        Some(Self { work, system: work.system(), buffers: Buffers::default() })
    }

    /// As JSON: name, axiom, rules, angle, n.
    #[must_use]
    pub fn work(&self) -> String {
        let Work { name, axiom, rules, angle, n } = self.work;
        serde_json::json!({"name": name, "axiom": axiom, "rules": rules, "angle": angle, "n": n}).to_string()
    }

    /// Derives into memory that is used again; how many symbols.
    pub fn expand(&mut self) -> f64 {
        self.buffers.expand(&self.system, self.work.n) as f64
    }

    /// Copies the string; how many bytes.
    #[wasm_bindgen(js_name = copyText)]
    pub fn copy_text(&mut self) -> f64 {
        self.buffers.copy_text() as f64
    }

    /// Draws and writes all segments to memory that is used again; how many.
    pub fn draw(&mut self) -> f64 {
        self.buffers.draw(&self.system, self.work.n) as f64
    }

    /// Draws and goes through all segments; how many.
    #[wasm_bindgen(js_name = drawInChunks)]
    pub fn draw_in_chunks(&mut self) -> f64 {
        self.buffers.draw_in_chunks(&self.system, self.work.n) as f64
    }

    /// Copies the segments' ends; how many segments.
    #[wasm_bindgen(js_name = copySegments)]
    pub fn copy_segments(&mut self) -> f64 {
        self.buffers.copy_segments() as f64
    }

    /// The last string derived.
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
    /// The derivation at `index`, or nothing after the last.
    #[must_use]
    pub fn at(index: usize) -> Option<Self> {
        let growth = *GROWTHS.get(index)?;
        Some(Self { growth, rules: growth.compile() })
    }

    /// As JSON: what it measures, name, axiom, n, modules of that generation.
    #[must_use]
    pub fn work(&self) -> String {
        let Growth { name, what, axiom, n, modules, .. } = self.growth;
        serde_json::json!({"what": what, "name": name, "axiom": axiom, "n": n, "modules": modules}).to_string()
    }

    /// Derives; how many modules were read on the way.
    #[must_use]
    pub fn derive(&self) -> f64 {
        self.growth.derive(&self.rules) as f64
    }
}
