//! The command line: commands, options and help texts.

use crate::file_flags::FileFlags;
use crate::{language, memory};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use lsystem::base::fixed::Fixed;
use lsystem::base::words::said;
use lsystem::base::{MAX_ITERATIONS, MAX_PICTURE_SIDE, decimal, say};
use lsystem::course::ScormStandard;
use lsystem::drawing::Origin;
use lsystem::files::{FORMATS, FileView, Format};
use lsystem::film::{Easing, Ending};
use lsystem::import::write::{NOTATIONS, Notation};
use lsystem::render::{MAX_ZOOM, Share, TilePlace, View};
use std::num::NonZero;
use std::path::PathBuf;
use std::str::FromStr;

const FILE: &str = "System as JSON, in the notation of another program, or in an SVG or PNG; - for standard input";

const VIEWED: &str = "System as JSON, in the notation of another program, or in an SVG or PNG";

const NOTES: &str = "\
`lsys FILE` is short for `lsys view FILE`, and `lsys FILE OUT_BASE` for `lsys draw FILE OUT_BASE`.
`lsys COMMAND --help` explains the options of a command.

Exit code 0: done. 1: a file is wrong, or a limit was passed. 2: wrong usage.";

const DRAW_USAGE: &str = "\
lsys draw [OPTIONS] FILE [OUT_BASE]
       lsys draw [OPTIONS] FILE... --out-dir DIR";

const DRAW_NOTES: &str = "\
Without --format, two files are written: OUT_BASE.txt (the string) and OUT_BASE.svg (the picture).
Without OUT_BASE, the files are named after FILE, or the format asked for is printed.";

const ANIMATE_NOTES: &str = "\
Examples:
  lsys animate fern.json --to fern.gif -n 7
  lsys animate fern.json --to - --dive -n 40 --size 1920x1080 | ffmpeg -i - fern.mp4
  lsys animate fern.json --to frames --track angle=0:20,5:30~smooth --track hue=0:0,10:90";

/// Derives, draws and inspects L-systems
#[derive(Parser)]
#[command(name = "lsys", version, propagate_version = true, after_help = NOTES)]
#[command(subcommand_required = true, arg_required_else_help = true, args_override_self = true)]
pub(crate) struct Cli {
    /// Language of messages and help: en, or a language that the program has [default: as LANG says]
    #[arg(long, global = true, value_name = "LANG", value_parser = PossibleValuesParser::new(language::known()))]
    pub(crate) language: Option<String>,
    #[command(subcommand)]
    pub(crate) verb: Verb,
}

#[derive(Subcommand)]
pub(crate) enum Verb {
    /// Show a system in the browser: change it there, or in an editor, and save it
    ///
    /// The page follows FILE while it is edited elsewhere, and Ctrl+S in the page saves into it. In the drawing,
    /// arrow keys change angle and iterations. The address is printed, and works on this machine only, until
    /// Ctrl+C ends the program.
    #[command(verbatim_doc_comment)]
    View {
        #[arg(help = VIEWED, value_hint = ValueHint::FilePath)]
        file: PathBuf,
        /// Port of the address [default: any free one]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
        port: Option<u16>,
        /// Only print the address
        #[arg(long)]
        no_browser: bool,
        /// Playground in a single file, in place of the one in this program
        #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
        page: Option<PathBuf>,
        /// Name of the system in a file with several, or its number
        #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
        entry: Option<String>,
    },
    /// Print the link of a system: the address of the page that shows it
    Link {
        #[arg(help = FILE, value_hint = ValueHint::FilePath)]
        file: PathBuf,
        /// Address of the page; without it, only what follows the address is printed
        #[arg(long, value_name = "ADDRESS", value_hint = ValueHint::Url)]
        page: Option<String>,
        #[command(flatten)]
        changes: Changes,
    },
    /// Print the outline in an SVG, or a mesh, as a shape for rules
    ///
    /// The line begins with `shape NAME =`, after the name of the file. The longest side is 20 units; the shape stands on
    /// y = 0, in the middle of x and z. A mesh must be closed, and has at most 2,000 triangles.
    #[command(verbatim_doc_comment)]
    Shape {
        /// SVG whose shapes are filled, or a closed mesh as OBJ or GLB
        #[arg(value_hint = ValueHint::FilePath)]
        file: PathBuf,
    },
    /// Print the derived string
    Expand {
        #[arg(help = FILE, value_hint = ValueHint::FilePath)]
        file: PathBuf,
        #[command(flatten)]
        changes: Changes,
    },
    /// Write or print pictures, meshes, segments and strings
    #[command(override_usage = DRAW_USAGE, after_help = DRAW_NOTES)]
    Draw {
        #[arg(help = FILE, value_name = "FILE", value_hint = ValueHint::FilePath, required = true)]
        files: Vec<PathBuf>,
        /// Write the output of every FILE into DIR, named after the file; DIR is made if it is missing
        #[arg(long, visible_alias = "to", value_name = "DIR", value_hint = ValueHint::DirPath, allow_hyphen_values = true)]
        out_dir: Option<PathBuf>,
        #[command(flatten)]
        look: Look,
        #[command(flatten)]
        changes: Changes,
    },
    /// Write a pyramid of tiles, with a page that shows it
    ///
    /// Every level is twice as large as the one before, so a pyramid shows what no file holds. Tiles that are there
    /// already are kept: a run that was stopped goes on. Several processes may write into the same DIR.
    /// Open DIR/index.html, or DIR/tiles.dzi in a viewer of Deep Zoom.
    #[command(verbatim_doc_comment)]
    Tiles {
        #[arg(help = FILE, value_hint = ValueHint::FilePath)]
        file: PathBuf,
        /// Folder of the pyramid; made if it is missing
        #[arg(value_hint = ValueHint::DirPath)]
        dir: PathBuf,
        #[command(flatten)]
        options: TileOptions,
        #[command(flatten)]
        changes: Changes,
    },
    /// Make films: animated GIF, numbered PNG pictures, or frames for another program
    ///
    /// Without a film, a preset or a track, the film shows growth from the axiom to the last generation.
    #[command(after_help = ANIMATE_NOTES)]
    Animate {
        #[arg(help = FILE, value_hint = ValueHint::FilePath)]
        file: PathBuf,
        /// A file such as out.gif, a folder for numbered PNG pictures, or - for standard output
        #[arg(long, value_name = "OUT", value_hint = ValueHint::AnyPath, allow_hyphen_values = true)]
        to: PathBuf,
        #[command(flatten)]
        film: FilmOptions,
        #[command(flatten)]
        changes: Changes,
    },
    /// Print exact counts, bounds and growth, if possible without deriving the string
    Info {
        #[arg(help = FILE, value_name = "FILE", value_hint = ValueHint::FilePath, required = true)]
        files: Vec<PathBuf>,
        /// Print JSON: an object for one FILE, an array for several
        #[arg(long, conflicts_with = "growth")]
        json: bool,
        /// Print how the generations grow: counts, recurrence, growth factor, dimension [default: text]
        #[arg(long, value_name = "FORMAT", num_args = 0..=1, require_equals = true, default_missing_value = "text")]
        growth: Option<GrowthFormat>,
        #[command(flatten)]
        changes: Changes,
    },
    /// Convert files in the notations of other programs to JSON
    ///
    /// Reads Fractint, cpfg, L-Py, TikZ, Racket, Houdini, programs and data of any language, settings, and
    /// texts as in papers. Every system becomes a file of its own in DIR. What is not carried over is a
    /// remark with its line.
    #[command(verbatim_doc_comment)]
    Import {
        #[arg(help = "File, or folder with files", value_name = "FILE", value_hint = ValueHint::AnyPath, required = true)]
        files: Vec<PathBuf>,
        /// Folder for the JSON files; made if it is missing
        #[arg(
            long, value_name = "DIR", value_hint = ValueHint::DirPath, allow_hyphen_values = true,
            required_unless_present = "account"
        )]
        to: Option<PathBuf>,
        /// Print instead what became of every part of the text: read, noted, or the reason of a refusal
        #[arg(long, conflicts_with = "to")]
        account: bool,
    },
    /// Print a system in the notation of another program
    ///
    /// What the notation cannot express is an error with the reason; no other picture is written in its
    /// place. What changes only looks is left out with a warning.
    #[command(verbatim_doc_comment)]
    Export {
        #[arg(help = FILE, value_hint = ValueHint::FilePath, required_unless_present = "list")]
        file: Option<PathBuf>,
        /// Notation of the text
        #[arg(long = "as", value_name = "NAME", required_unless_present = "list", value_parser = notations())]
        notation: Option<&'static Notation>,
        /// List the notations
        #[arg(long)]
        list: bool,
        #[command(flatten)]
        changes: Changes,
    },
    /// Compare what a program printed with a system
    ///
    /// OUTPUT is the string, an SVG of lines, or a table of segments (x0,y0,x1,y1 on each line) that
    /// the program made for FILE. Prints the first difference. Place and size of a picture do not count.
    #[command(verbatim_doc_comment)]
    Check {
        #[arg(help = FILE, value_hint = ValueHint::FilePath)]
        file: PathBuf,
        /// What the program printed; - for standard input
        #[arg(value_hint = ValueHint::FilePath)]
        output: PathBuf,
        #[command(flatten)]
        changes: Changes,
    },
    /// Find the shortest rules that derive a string or draw a picture
    ///
    /// The rules are deterministic and without neighbours or parameters. Without -n, 1 to 8 steps are tried.
    /// Pictures are PNG files of lines. Axiom, angle and heading may be left out: the usual ones are tried.
    Find {
        /// The string, or a file with it, or a picture; - for standard input
        #[arg(allow_hyphen_values = true, value_hint = ValueHint::FilePath)]
        text: String,
        #[arg(long, allow_hyphen_values = true, help = "What the derivation begins with")]
        axiom: Option<String>,
        /// Derivation steps, 1 to 30
        #[arg(short = 'n', long, value_name = "N", value_parser = |text: &str| whole(text, 30))]
        iterations: Option<u32>,
        /// Symbols without rules, for strings
        #[arg(long, default_value = "+-[]", allow_hyphen_values = true)]
        constants: String,
        /// Degrees of a turn, for pictures
        #[arg(long, value_name = "DEGREES")]
        angle: Option<f64>,
        /// First heading in degrees, counter-clockwise from the right, for pictures
        #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
        heading: Option<f64>,
        /// Letters that draw, for pictures
        #[arg(long, value_name = "LETTERS")]
        draws: Option<String>,
        /// Seconds to search [default: counted work, equal on every machine]
        #[arg(long, value_name = "S")]
        seconds: Option<u32>,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Print a new system that is worth looking at, as JSON
    ///
    /// Systems of several families are made by chance and judged by their drawings. The same SEED always
    /// makes the same system. Example: lsys surprise --seed 7 | lsys draw - picture
    #[command(verbatim_doc_comment)]
    Surprise {
        /// 0 to 4294967295 [default: another one each time; the system's name tells it]
        #[arg(long, value_parser = |text: &str| whole(text, u32::MAX))]
        seed: Option<u32>,
    },
    /// Write children of one system, or of two: rules, angles and colours changed a little, or crossed
    Breed {
        #[arg(help = FILE, value_name = "FILE", value_hint = ValueHint::FilePath, required = true, num_args = 1..=2)]
        files: Vec<PathBuf>,
        /// Folder for the children; made if it is missing
        #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, allow_hyphen_values = true)]
        to: PathBuf,
        /// 0 to 4294967295; the same seed makes the same children [default: another one each time]
        #[arg(long, value_parser = |text: &str| whole(text, u32::MAX))]
        seed: Option<u32>,
        /// How many children, 1 to 100
        #[arg(long, value_name = "N", default_value = "9", value_parser = |text: &str| whole(text, 100))]
        count: u32,
    },
    /// Mark answers to an exercise
    ///
    /// EXERCISE is the link of an exercise, or a file with the link. Each of ANSWERS is the link of an
    /// answer, a file with a system, or a table (CSV) with a link in each row.
    #[command(verbatim_doc_comment)]
    Mark {
        exercise: String,
        #[arg(required = true, value_hint = ValueHint::AnyPath)]
        answers: Vec<String>,
        /// Print the table as CSV
        #[arg(long)]
        csv: bool,
        /// Write the marks as a page with pictures, too
        #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
        html: Option<PathBuf>,
    },
    /// Write a page that shows the drawings of a class
    ///
    /// Each FILE is a system, or a folder with systems. The page is one file of HTML, without names unless
    /// they are asked for.
    #[command(verbatim_doc_comment)]
    Exhibit {
        #[arg(help = "File, or folder with files", value_name = "FILE", value_hint = ValueHint::AnyPath, required = true)]
        files: Vec<PathBuf>,
        /// Page to write, with the ending .html
        #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, allow_hyphen_values = true)]
        to: PathBuf,
        #[command(flatten)]
        options: ExhibitOptions,
    },
    /// Write a package for Moodle, ILIAS, OLAT, Canvas and other learning systems (SCORM)
    ///
    /// Each EXERCISE is the link of an exercise, or a file with the link. The learning system gets the
    /// score, the status, the time and the answers. The marks are made in the student's browser, so
    /// they can be forged: `lsys mark` marks the answers again.
    #[command(verbatim_doc_comment)]
    Scorm {
        #[arg(required_unless_present = "lesson", conflicts_with = "lesson", value_name = "EXERCISE")]
        exercises: Vec<String>,
        /// Package to write, with the ending .zip
        #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, allow_hyphen_values = true)]
        to: PathBuf,
        #[command(flatten)]
        options: ScormOptions,
    },
    /// Print the script that completes commands and options in a shell
    Completions {
        /// Shell that will read the script
        shell: Shell,
    },
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

/// A magnification as `--zoom` reads it.
fn magnification(text: &str) -> Result<f64, String> {
    let zoom = decimal::read(text).filter(|zoom| (1e-2..=MAX_ZOOM).contains(zoom));
    zoom.ok_or_else(|| say!("a number from 0.01 to 1e301 is expected"))
}

/// A place on a segment, from the segment's number from 1.
fn segment(text: &str) -> Result<Origin, String> {
    Origin::read(text).ok_or_else(|| say!("expected a number of a segment, from 1"))
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
    #[arg(long, value_name = "K/N", default_value = "0/1")]
    pub(crate) part: Part,
    /// Make only the tiles above and below this one, for levels too deep to make all of them
    #[arg(long, value_name = "LEVEL/X/Y", default_value = "0/0/0")]
    pub(crate) under: Under,
    /// Threads, at most one for each core [default: one for each core]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZero<u16>>,
    /// Leave out the background
    #[arg(long)]
    pub(crate) transparent: bool,
}

/// The first and the last level of a pyramid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Levels(pub(crate) u32, pub(crate) u32);

impl FromStr for Levels {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let levels = text.split_once("..").and_then(|(from, to)| Some(Self(from.parse().ok()?, to.parse().ok()?)));
        let is_possible = |levels: &Self| levels.0 <= levels.1 && levels.1 <= TilePlace::MAX_LEVEL;
        levels.filter(is_possible).ok_or_else(|| say!("expected levels such as 0..8, at most {}", TilePlace::MAX_LEVEL))
    }
}

/// The names of a pyramid's files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Scheme {
    Deepzoom,
    Xyz,
}

impl Scheme {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Deepzoom => "deepzoom",
            Self::Xyz => "xyz",
        }
    }
}

/// A part of a pyramid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part(pub(crate) Share);

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let share = text.split_once('/').and_then(|(part, of)| Share::new(part.parse().ok()?, of.parse().ok()?));
        share.map(Self).ok_or_else(|| say!("expected a part such as 0/4, the first of four"))
    }
}

/// The tile that all tiles to make are above or below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Under(pub(crate) TilePlace);

impl FromStr for Under {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut parts = text.split('/').map(str::parse::<u64>);
        let mut next = || parts.next()?.ok();
        let tile = (|| TilePlace::new(next()?.try_into().ok()?, next()?, next()?))();
        tile.filter(|_| parts.next().is_none()).map(Self).ok_or_else(|| {
            say!("expected a tile such as 3/0/7: the level, at most {}, the column and the row", TilePlace::MAX_LEVEL)
        })
    }
}

fn tile_size(text: &str) -> Result<u32, String> {
    let size = text.parse().ok().filter(|size| matches!(size, 256 | 512));
    size.ok_or_else(|| say!("expected 256 or 512"))
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
    #[arg(long = "loop", value_name = "LOOP")]
    pub(crate) ending: Option<EndingName>,
    /// Pace between the keys: linear, smooth, in, out or hold [default: linear]
    #[arg(long, value_name = "PACE")]
    pub(crate) easing: Option<EasingName>,
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

/// The segment at the end of a dive, from 1; `None` for the one in the middle.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dive(pub(crate) Option<Fixed>);

impl FromStr for Dive {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.is_empty() {
            return Ok(Self(None));
        }
        segment(text).map(|origin| Self(Some(origin.segment)))
    }
}

/// An [`Ending`] by its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EndingName(pub(crate) Ending);

impl FromStr for EndingName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ending::named(text).map(Self).ok_or_else(|| say!("expected one of {}", Ending::NAMES.join(", ")))
    }
}

/// An [`Easing`] by its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EasingName(pub(crate) Easing);

impl FromStr for EasingName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Easing::named(text).map(Self).ok_or_else(|| say!("expected one of {}", Easing::NAMES.join(", ")))
    }
}

/// A parser for the names of [`FORMATS`].
fn formats() -> impl TypedValueParser<Value = &'static Format> {
    let values = FORMATS.iter().map(|format| PossibleValue::new(format.name).help(said(format.help)));
    PossibleValuesParser::new(values).try_map(|name| Format::named(&name).ok_or("there is no such format"))
}

/// A parser for the names of [`ScormStandard::ALL`].
fn standards() -> impl TypedValueParser<Value = ScormStandard> {
    let names = PossibleValuesParser::new(ScormStandard::ALL.map(ScormStandard::name));
    names.try_map(|name| ScormStandard::named(&name).ok_or("there is no such standard"))
}

fn notations() -> impl TypedValueParser<Value = &'static Notation> {
    let values = NOTATIONS.iter().map(|notation| PossibleValue::new(notation.name).help(said(notation.help)));
    PossibleValuesParser::new(values).try_map(|name| Notation::named(&name).ok_or("there is no such notation"))
}

/// The size of a picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PictureSize {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl FromStr for PictureSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
        let (width, height) = sides.ok_or_else(|| say!("expected a width and a height such as 1600x1200"))?;
        let sides = 1..=MAX_PICTURE_SIDE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(say!("expected 1 to {} pixels each way", MAX_PICTURE_SIDE));
        }
        Ok(Self { width, height })
    }
}

fn whole(text: &str, most: u32) -> Result<u32, String> {
    let number = text.parse().ok().filter(|&number| number <= most);
    number.ok_or_else(|| say!("expected a whole number from 0 to {}", most))
}

fn setting(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or_else(|| say!("expected a name and a value such as angle_deg=30"))?;
    Ok((name.to_owned(), value.to_owned()))
}
