//! The readers of other notations.

use crate::to_js;
use lsystem_import::Remark;
use lsystem_syntax::Definition;
use serde::Serialize;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// Systems in the notation of another program or of a paper.
#[derive(Serialize, TS)]
pub(crate) struct ImportReport {
    notation: &'static str,
    entries: Vec<ImportEntry>,
}

/// One of these systems.
#[derive(Serialize, TS)]
pub(crate) struct ImportEntry {
    name: String,
    /// Null if the system cannot be opened.
    definition: Option<Definition>,
    remarks: Vec<ImportRemark>,
}

/// What was not carried over, by line of the text, 1-based.
#[derive(Serialize, TS)]
pub(crate) struct ImportRemark {
    line: usize,
    text: String,
    message: String,
}

/// Reads systems in the notation of another program or of a paper: `{notation, entries: [{name, definition, remarks:
/// [{line, text, message}]}]}`; null if no notation is recognised.
///
/// # Errors
/// Throws only if the result cannot be translated.
#[wasm_bindgen(js_name = importSystems)]
pub fn import_systems(text: &str) -> Result<JsValue, JsValue> {
    let report = lsystem_import::import(text).map(|imported| ImportReport {
        notation: imported.notation,
        entries: (imported.entries.into_iter())
            .map(|entry| ImportEntry {
                name: entry.name,
                definition: entry.definition,
                remarks: (entry.remarks.into_iter())
                    .map(|Remark { line, text, message, .. }| ImportRemark { line, text, message })
                    .collect(),
            })
            .collect(),
    });
    to_js(&report)
}
