//! The files of a pyramid: their paths, and the files that describe it.

use crate::cli::{Scheme, TileOptions};
use crate::language;
use lsystem::base::say;
use lsystem::render::TilePlace;
use serde_json::{Value, json};
use std::path::PathBuf;

/// The page that shows a pyramid, with its configuration left out.
const VIEWER: &str = include_str!("viewer.html");
/// The place of the configuration in the page.
const CONFIGURATION: &str = "{\"here\":0}";
/// The deepest level that the page shows: its places are `f64`, which resolve 2^-53 of the picture.
const VIEWER_LEVELS: u32 = 42;

pub(super) struct Layout<'a> {
    pub(super) options: TileOptions,
    pub(super) background: [u8; 3],
    pub(super) name: &'a str,
}

impl Layout<'_> {
    /// The path of a tile.
    pub(super) fn path(&self, TilePlace { level, x, y }: TilePlace) -> PathBuf {
        match self.options.scheme {
            Scheme::Deepzoom => format!("tiles_files/{}/{x}_{y}.png", level + self.options.size.ilog2()).into(),
            Scheme::Xyz => format!("{level}/{x}/{y}.png").into(),
        }
    }

    /// The sides of the pictures of levels that Deep Zoom has above the single tile, in pixels.
    pub(super) fn small(&self) -> impl Iterator<Item = u32> + Send + use<> {
        let is_wanted = self.options.scheme == Scheme::Deepzoom && self.options.levels.0 == 0;
        let levels = if is_wanted { self.options.size.ilog2() } else { 0 };
        (0..levels).map(|level| 1 << level)
    }

    /// The path of such a picture.
    pub(super) fn small_path(&self, side: u32) -> PathBuf {
        format!("tiles_files/{}/0_0.png", side.ilog2()).into()
    }

    /// The description of the pyramid: equal for all processes that may write into the same folder.
    pub(super) fn index(&self, system: &str) -> String {
        let TileOptions { scheme, size, transparent, .. } = self.options;
        let system: Value = serde_json::from_str(system).unwrap_or_default();
        let index = json!({
            "scheme": scheme.name(), "size": size, "transparent": transparent,
            "version": env!("CARGO_PKG_VERSION"), "system": system,
        });
        format!("{index}\n")
    }

    /// The names of all files and folders of the pyramid.
    pub(super) fn names(&self) -> Vec<String> {
        match self.options.scheme {
            Scheme::Deepzoom => ["index.html", "tiles.dzi", "tiles_files"].map(str::to_owned).to_vec(),
            Scheme::Xyz => {
                let levels = (0..=TilePlace::MAX_LEVEL).map(|level| level.to_string());
                core::iter::once("index.html".to_owned()).chain(levels).collect()
            }
        }
    }

    /// The files that describe the pyramid, with their paths.
    pub(super) fn descriptions(&self) -> Vec<(PathBuf, String)> {
        let TileOptions { scheme, size, levels, under, .. } = self.options;
        let [r, g, b] = self.background;
        let width = 1.0 / (1_u64 << under.level) as f64;
        let configuration = json!({
            "name": self.name, "scheme": scheme.name(), "size": size, "first": levels.0, "last": levels.1.min(VIEWER_LEVELS),
            "background": format!("#{r:02x}{g:02x}{b:02x}"),
            // The part of the picture that is shown first: its left and upper side and its width.
            "start": [under.x as f64 * width, under.y as f64 * width, width],
            "language": language::code(),
            "words": {
                "canvas": say!("{}. Arrow keys move, plus and minus zoom, 0 shows all.", self.name),
                "level": say!("Level {} of {}", "{}", "{}"),
                "out": { "ariaLabel": say!("Zoom out"), "title": say!("Zoom out (-)") },
                "in": { "ariaLabel": say!("Zoom in"), "title": say!("Zoom in (+)") },
                "fit": { "textContent": say!("Fit"), "title": say!("Show all (0)") },
            },
        });
        // `<` cannot end the script.
        let configuration = configuration.to_string().replace('<', "\\u003c");
        let viewer = VIEWER.replacen(CONFIGURATION, &configuration, 1);
        let mut files = vec![(PathBuf::from("index.html"), viewer)];
        if scheme == Scheme::Deepzoom {
            let side = u128::from(size) << levels.1;
            let xmlns = "http://schemas.microsoft.com/deepzoom/2008";
            let image = format!(
                "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Image xmlns=\"{xmlns}\" Format=\"png\" Overlap=\"0\" \
                 TileSize=\"{size}\">\n  <Size Width=\"{side}\" Height=\"{side}\"/>\n</Image>\n"
            );
            files.push((PathBuf::from("tiles.dzi"), image));
        }
        files
    }
}
