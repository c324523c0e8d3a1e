//! The readers and the writers of other notations.

use lsystem_base::say;
use lsystem_import::write::{Notation, Written, export};
use lsystem_import::{Fate, Part, Remark};
use lsystem_js::{from_js, to_js};
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

/// A system in another notation, or the reason why there is none.
#[derive(Serialize, TS)]
pub(crate) struct WriteReport {
    /// Null if the notation cannot express the system.
    text: Option<String>,
    /// Sentences: what is left out, or the reason.
    notes: Vec<String>,
}

/// Writes a definition in the notation with this name, of the table `NOTATIONS`: `{text, notes}`. `text` is null if the
/// notation cannot express the system, and `notes` then has the reason; otherwise `notes` has sentences about what is
/// left out.
///
/// # Errors
/// Throws if the definition is none, or if the result cannot be translated.
#[wasm_bindgen(js_name = writeSystem)]
pub fn write_system(definition: JsValue, notation: &str) -> Result<JsValue, JsValue> {
    let definition: Definition = from_js(definition)?;
    let report = match Notation::named(notation).map(|notation| export(&definition, notation)) {
        Some(Ok(Written { text, left_out })) => WriteReport { text: Some(text), notes: left_out },
        Some(Err(refusal)) => WriteReport { text: None, notes: vec![refusal.0] },
        None => WriteReport { text: None, notes: vec![say!("There is no such notation")] },
    };
    to_js(&report)
}
