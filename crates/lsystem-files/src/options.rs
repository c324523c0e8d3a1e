//! The choices for a file. Each format reads those that it needs.

use crate::{PlotOptions, Sheet};

/// What a file holds beside the drawing, and how the drawing is laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct FileOptions {
    /// The title; empty for none.
    pub title: String,
    /// A description for screen readers; empty for none.
    pub description: String,
    /// The system as a text of [`write_json`](crate::write_json), stored in the file for
    /// [`read_file`](crate::read_file); empty for none.
    pub system: String,
    /// The most segments and vertices of polygons to write.
    pub most: u64,
    /// The sheet of formats for paper.
    pub sheet: Sheet,
    /// The choices for plots.
    pub plot: PlotOptions,
}

impl Default for FileOptions {
    fn default() -> Self {
        let (title, description, system) = <(String, String, String)>::default();
        Self { title, description, system, most: 2_000_000, sheet: Sheet::default(), plot: PlotOptions::default() }
    }
}
