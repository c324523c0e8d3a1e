//! The command line: commands, options and help texts.

mod options;
mod values;

pub(crate) use options::{
    Changes, ExhibitOptions, FilmFormat, FilmOptions, GrowthFormat, Known, Look, ScormOptions, TileOptions, ViewOptions,
};
pub(crate) use values::{Dive, Scheme};

use crate::language;
use clap::builder::PossibleValuesParser;
use clap::{Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use lsystem::import::write::Notation;
use std::path::PathBuf;
use values::{notations, whole};

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

#[derive(Debug, PartialEq, Subcommand)]
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
        #[command(flatten)]
        options: ViewOptions,
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
        #[command(flatten)]
        known: Known,
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

impl Verb {
    /// Whether the output is for programs: JSON or a table.
    pub(crate) fn is_for_programs(&self) -> bool {
        match self {
            Self::Info { json: true, .. }
            | Self::Find { json: true, .. }
            | Self::Mark { csv: true, html: None, .. } => true,
            Self::Info { growth: Some(format), .. } => !matches!(format, GrowthFormat::Text),
            _ => false,
        }
    }
}
