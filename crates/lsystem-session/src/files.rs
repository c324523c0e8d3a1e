//! Reading files.

use crate::report::Problem;
use lsystem::Definition;
use lsystem::files::FileContent;
use lsystem::syntax::problems;
use serde::Serialize;
use ts_rs::TS;

/// The contents of a file.
#[derive(Debug, Serialize, TS)]
pub struct FileRead {
    /// Null if the file cannot be used.
    pub definition: Option<Definition>,
    /// The problems of the file and of its definition.
    pub diagnostics: Vec<Problem>,
}

/// Reads a JSON file, or a PNG or SVG picture that carries its system.
#[must_use]
pub fn read_file(bytes: &[u8]) -> FileRead {
    let FileContent { definition, diagnostics, json } = lsystem::read_file(bytes);
    let texts = definition.clone().unwrap_or_default();
    FileRead { definition, diagnostics: problems(&diagnostics, &texts, &json) }
}
