//! The choices for a file. Each format reads those that it needs.

use crate::print::{FOOT, THINNEST};
use lsystem_plot::{PlotOptions, Sheet};
use lsystem_sound::SoundOptions;

/// The content of a file beside the drawing, and the layout of the drawing.
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
    /// The most bytes of a mesh.
    pub memory: u64,
    /// The size under which parts of a mesh become one tube, in parts of the longest side; 0 for none.
    pub finest: f64,
    /// The height of a mesh, in the format's unit; 0 for the height that the format has by default.
    pub height: f64,
    /// The least thickness of tubes and slabs of a print, in millimetres.
    pub thinnest: f64,
    /// The distance by which a print's foot reaches beyond it, in millimetres; 0 for no foot.
    pub foot: f64,
    /// The sheet of formats for paper.
    pub sheet: Sheet,
    /// The width and the height of formats of pixels; `None` for the size that suits the drawing.
    pub size: Option<[u32; 2]>,
    /// Pixels of an inch on paper, written into the file; `None` for a file without resolution.
    pub dpi: Option<f64>,
    /// Whether the background is left out.
    pub transparent: bool,
    /// Whether the system is left out of the file: then the caller leaves `system` empty.
    pub bare: bool,
    /// Whether a page ends at the picture's edge instead of the sheet's.
    pub is_cropped: bool,
    /// The choices for plots.
    pub plot: PlotOptions,
    /// The choices for tunes.
    pub sound: SoundOptions,
}

impl Default for FileOptions {
    fn default() -> Self {
        let (title, description, system) = <(String, String, String)>::default();
        Self {
            title,
            description,
            system,
            most: 2_000_000,
            memory: u64::MAX,
            finest: 0.0,
            height: 0.0,
            thinnest: THINNEST,
            foot: FOOT,
            sheet: Sheet::default(),
            is_cropped: true,
            plot: PlotOptions::default(),
            sound: SoundOptions::default(),
            size: None,
            dpi: None,
            transparent: false,
            bare: false,
        }
    }
}
