//! The options that commands share.

use super::values::{
    Dive, Levels, PictureSize, Scheme, easing, ending, formats, magnification, segment, setting, share, standards,
    tile, tile_size, whole,
};
use crate::file_flags::FileFlags;
use crate::memory;
use clap::{Args, ValueHint};
use lsystem::base::MAX_ITERATIONS;
use lsystem::course::ScormStandard;
use lsystem::drawing::Origin;
use lsystem::files::{FileView, Format};
use lsystem::film::{Easing, Ending};
use lsystem::render::{TilePlace, TileShare, View};
use std::num::NonZero;
use std::path::PathBuf;

/// The options of a page that is served.
#[derive(Args, Clone, Debug, PartialEq)]
pub(crate) struct ViewOptions {
    /// Port of the address [default: any free one]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) port: Option<u16>,
    /// Only print the address
    #[arg(long)]
    pub(crate) no_browser: bool,
    /// Playground in a single file, in place of the one in this program
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) page: Option<PathBuf>,
}

/// The formats of `lsys info --growth`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum GrowthFormat {
    Text,
    Csv,
    Latex,
    Json,
}

/// The options that change a file's system or the memory limit.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub(crate) struct Changes {
    /// Derivation steps, 0 to 1000, in place of the file's
    #[arg(short = 'n', long, value_name = "N", allow_hyphen_values = true)]
    #[arg(value_parser = |text: &str| whole(text, MAX_ITERATIONS))]
    pub(crate) iterations: Option<u32>,
    /// Seed of random choices, 0 to 4294967295, in place of the file's
    #[arg(long, allow_hyphen_values = true, value_parser = |text: &str| whole(text, u32::MAX))]
    pub(crate) seed: Option<u32>,
    /// Set any other value of the file by its name; may be repeated
    ///
    /// Examples: --set angle_deg=22.5 --set colour_by=path --set 'palette=["gold","teal"]'
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true, value_parser = setting)]
    pub(crate) settings: Vec<(String, String)>,
    /// Name of the system in a file with several, or its number
    #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
    pub(crate) entry: Option<String>,
    /// Memory limit for drawings, such as 512M or 2G [default: 1G]
    ///
    /// Files that are drawn at the same time share the limit, and so the limits of strings and segments.
    /// A file that needs more than its share is drawn once more, alone, with the whole limit.
    /// Writing takes memory beside the drawing: some hundred megabytes for texts and meshes, and about
    /// 150 MB per core for PNG of any size.
    #[arg(long, value_name = "SIZE", value_parser = memory::parse, verbatim_doc_comment)]
    pub(crate) memory: Option<u64>,
}

/// The options for the output of a drawing.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub(crate) struct Look {
    /// Output format
    #[arg(long, value_parser = formats())]
    pub(crate) format: Option<&'static Format>,
    /// Write a small SVG that defines each block once and places copies
    #[arg(long)]
    pub(crate) compact: bool,
    /// Magnify a picture of pixels in the plane: 1 shows the whole drawing
    #[arg(long, value_name = "TIMES", value_parser = magnification)]
    pub(crate) zoom: Option<f64>,
    /// Put the start of segment N (from 1) into the middle of the picture: then TIMES may be 1e301
    #[arg(long, value_name = "N", value_parser = segment)]
    pub(crate) segment: Option<Origin>,
    #[command(flatten)]
    pub(crate) flags: FileFlags,
}

impl Look {
    /// The view of pictures of pixels.
    pub(crate) fn view(&self) -> FileView {
        FileView {
            view: View { zoom: self.zoom.unwrap_or(1.0), ..View::default() },
            segment: self.segment.clone(),
            ..FileView::default()
        }
    }
}

/// The options of an exhibition.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub(crate) struct ExhibitOptions {
    /// Heading of the page
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true)]
    pub(crate) title: String,
    /// Show the titles of the systems, not numbers
    #[arg(long)]
    pub(crate) names: bool,
    /// Order by votes: a file with lines such as koch,12 [default: order of the files]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) votes: Option<PathBuf>,
    /// Order by chance, 0 to 4294967295: the same for the same seed
    #[arg(long, conflicts_with = "votes", value_parser = |text: &str| whole(text, u32::MAX))]
    pub(crate) seed: Option<u32>,
    /// Address of the playground, to which the drawings are linked
    #[arg(long, value_name = "ADDRESS")]
    pub(crate) page: Option<String>,
}

/// The options of a package for learning systems.
#[derive(Args, Clone, Debug, PartialEq)]
pub(crate) struct ScormOptions {
    /// Package the lesson in twelve steps
    #[arg(long)]
    pub(crate) lesson: bool,
    /// SCORM 1.2 or 2004 (3rd edition)
    #[arg(long, value_name = "VERSION", default_value = "1.2", value_parser = standards())]
    pub(crate) standard: ScormStandard,
    /// Title in the learning system [default: that of the exercise or of the lesson]
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true)]
    pub(crate) title: String,
    /// Folder of the built site, for its exercise.html and package.html [default: those in this program]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) pages: Option<PathBuf>,
}

/// The options of a pyramid.
#[derive(Args, Clone, Copy, Debug, PartialEq)]
pub(crate) struct TileOptions {
    /// First and last level, 0 to 60: level L has up to 4^L tiles
    #[arg(long, value_name = "A..B", default_value = "0..5")]
    pub(crate) levels: Levels,
    /// Names of the tiles: NAME_files/LEVEL/X_Y.png for Deep Zoom, LEVEL/X/Y.png for maps
    #[arg(long, default_value = "deepzoom")]
    pub(crate) scheme: Scheme,
    /// Pixels along the side of a tile: 256 or 512
    #[arg(long, value_name = "N", default_value = "256", value_parser = tile_size)]
    pub(crate) size: u32,
    /// Make only part K (0-based) of N equal parts
    #[arg(long, value_name = "K/N", default_value = "0/1", value_parser = share)]
    pub(crate) part: TileShare,
    /// Make only the tiles above and below this one, for levels too deep to make all of them
    #[arg(long, value_name = "LEVEL/X/Y", default_value = "0/0/0", value_parser = tile)]
    pub(crate) under: TilePlace,
    /// Threads, at most one for each core [default: one for each core]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZero<u16>>,
    /// Leave out the background
    #[arg(long)]
    pub(crate) transparent: bool,
}

/// The options of a film.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub(crate) struct FilmOptions {
    /// The film as text, as in links of the page, or a file with the text
    #[arg(long, value_name = "TEXT")]
    pub(crate) film: Option<String>,
    /// Growth from the axiom to the last generation
    #[arg(long)]
    pub(crate) growth: bool,
    /// Fit each frame of growth anew; otherwise the plant grows from the ground in the frame of the last generation
    #[arg(long)]
    pub(crate) follow: bool,
    /// The turtle's way, segment by segment
    #[arg(long)]
    pub(crate) turtle: bool,
    /// One turn of the camera about a drawing in space
    #[arg(long)]
    pub(crate) turntable: bool,
    /// Branches that sway in the wind, as a loop: by the system's `sway`, or else by 3 degrees
    #[arg(long)]
    pub(crate) sway: bool,
    /// A dive from the whole drawing to a segment, by its number from 1 [default: the one in the middle]
    #[arg(long, value_name = "SEGMENT", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    pub(crate) dive: Option<Dive>,
    /// A number that changes: its values at times in seconds, such as angle=0:20,5:30; may be repeated
    ///
    /// NAME is n, drawn, view, camera, a key of links such as angle, seed or hue, or a constant such as
    /// rules.r. A value may be followed by the pace to the next one: 0:20~smooth.
    #[arg(long, value_name = "NAME=KEYS", verbatim_doc_comment)]
    pub(crate) track: Vec<String>,
    /// Length in seconds [default: 10]
    #[arg(long, value_name = "S")]
    pub(crate) seconds: Option<f64>,
    /// Frames a second, 1 to 60 [default: 25]
    #[arg(long, value_name = "N")]
    pub(crate) fps: Option<u32>,
    /// Size in pixels [default: 1280x720]
    #[arg(long, value_name = "WxH")]
    pub(crate) size: Option<PictureSize>,
    /// What follows the end: once, repeat or bounce [default: repeat]
    #[arg(long = "loop", value_name = "LOOP", value_parser = ending)]
    pub(crate) ending: Option<Ending>,
    /// Pace between the keys: linear, smooth, in, out or hold [default: linear]
    #[arg(long, value_name = "PACE", value_parser = easing)]
    pub(crate) easing: Option<Easing>,
    /// Format [default: gif for OUT.gif, y4m for -, png for a folder]
    #[arg(long)]
    pub(crate) format: Option<FilmFormat>,
}

/// The formats of films.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum FilmFormat {
    /// Animated GIF
    Gif,
    /// Numbered pictures in a folder, or one after the other on standard output
    Png,
    /// YUV4MPEG2 with full colour, on standard output
    Y4m,
    /// Raw pixels, four bytes each, on standard output
    Rgba,
}

/// The known properties of a system whose rules are searched.
#[derive(Args, Clone, Debug, PartialEq)]
pub(crate) struct Known {
    #[arg(long, allow_hyphen_values = true, help = "What the derivation begins with")]
    pub(crate) axiom: Option<String>,
    /// Derivation steps, 1 to 30
    #[arg(short = 'n', long, value_name = "N", value_parser = |text: &str| whole(text, 30))]
    pub(crate) iterations: Option<u32>,
    /// Symbols without rules, for strings
    #[arg(long, default_value = "+-[]", allow_hyphen_values = true)]
    pub(crate) constants: String,
    /// Degrees of a turn, for pictures
    #[arg(long, value_name = "DEGREES")]
    pub(crate) angle: Option<f64>,
    /// First heading in degrees, counter-clockwise from the right, for pictures
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    pub(crate) heading: Option<f64>,
    /// Letters that draw, for pictures
    #[arg(long, value_name = "LETTERS")]
    pub(crate) draws: Option<String>,
    /// Seconds to search [default: counted work, equal on every machine]
    #[arg(long, value_name = "S")]
    pub(crate) seconds: Option<u32>,
}
