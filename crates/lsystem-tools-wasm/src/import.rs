//! The readers of other notations.

use crate::to_js;
use lsystem_import::{Fate, Part, Remark};
use lsystem_syntax::Definition;
use serde::Serialize;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// Systems in the notation of another program or of a paper.
#[derive(Serialize, TS)]
pub(crate) struct ImportReport {
    notation: &'static str,
    entries: Vec<ImportEntry>,
    /// The parts of the text in order, without gaps.
    account: Vec<ImportPart>,
}

/// A part of the text, and what became of it.
#[derive(Serialize, TS)]
pub(crate) struct ImportPart {
    /// In UTF-16 units.
    length: usize,
    /// `passed`, `read`, `noted` or `refused`.
    fate: &'static str,
    /// The index of its system; null outside of all systems.
    entry: Option<usize>,
    /// What it became, or why it did not.
    words: String,
}

/// One of these systems.
#[derive(Serialize, TS)]
pub(crate) struct ImportEntry {
    name: String,
    /// Null if the system cannot be opened.
    definition: Option<Definition>,
    remarks: Vec<ImportRemark>,
}

/// A remark on a part that was not carried over, with its line of the text, 1-based.
#[derive(Serialize, TS)]
pub(crate) struct ImportRemark {
    line: usize,
    text: String,
    message: String,
}

/// Reads systems in the notation of another program or of a paper: `{notation, entries: [{name, definition, remarks:
/// [{line, text, message}]}], account: [{length, fate, entry, words}]}`; null if no notation is recognised.
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
        account: imported.account.into_iter().map(|part| import_part(text, part)).collect(),
    });
    to_js(&report)
}

fn import_part(text: &str, Part { span, fate, entry, words }: Part) -> ImportPart {
    let fate = match fate {
        Fate::Passed => "passed",
        Fate::Read => "read",
        Fate::Noted => "noted",
        Fate::Refused => "refused",
    };
    // The parts follow each other, so their lengths say their places.
    let length = text.get(span).unwrap_or_default().encode_utf16().count();
    ImportPart { length, fate, entry, words }
}
