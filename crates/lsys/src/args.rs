//! The command line as a value.

use crate::memory;
use lexopt::prelude::{Long, Short, Value};
use lsystem::Viewport;
use lsystem::files::SvgForm;
use lsystem::syntax::{MAX_ITERATIONS, MAX_PICTURE_PIXELS, MAX_PICTURE_SIDE};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// What `lsys --help` prints.
pub(crate) const HELP: &str = "\
Derives, draws and inspects L-systems.

usage: lsys expand FILE [-n N] [--seed S] [--set NAME=VALUE]...
       lsys draw FILE [OUT_BASE] [-n N] [--seed S] [--format svg|png|csv|txt|obj|glb] [--size WxH] [--compact]
       lsys draw FILE... --out-dir DIR [the same options]
       lsys info FILE... [-n N] [--seed S] [--json]
       lsys FILE OUT_BASE

  expand   prints the derived string
  draw     writes OUT_BASE.txt (the string) and OUT_BASE.svg (the picture), or only the format asked for;
           with a format and without OUT_BASE it prints that to standard output
  info     prints exact counts, bounds and growth, without deriving the string where it can
  lsys FILE OUT_BASE is short for lsys draw FILE OUT_BASE

  FILE                 a system as JSON, or an SVG or PNG picture saved by this program or the page, which
                       carries its system; - for standard input
  -n, --iterations N   derivation steps, 0 to 1000, in place of the file's
  --seed S             which random choices to make, 0 to 4294967295, in place of the file's
  --set NAME=VALUE     any other value of the file, by its name there: angle_deg=22.5, colour_by=path,
                       length_factor=0.8, angle_variation=10, palette='[\"gold\",\"teal\"]'; may be repeated
  --format FORMAT      svg, png, csv (columns x0,y0,x1,y1,level,colour; in space
                       x0,y0,z0,x1,y1,z1,level,colour), txt (the string), or a mesh of coloured tubes
                       as obj or glb (binary glTF)
  --size WxH           a png's size in pixels, such as 4000x3000; else 1024 along the longer side
  --compact            an svg whose size hardly depends on N: each block of the drawing once, and then placed
  --memory SIZE        the most memory that a drawing may take, such as 512M or 2G; else 1G
  --out-dir DIR        writes every FILE's output into DIR, named after the file
  --json               one JSON object for a file, an array for several
  -h, --help           prints this
  -V, --version        prints the version

Exit code 0: done. 1: something is wrong with a file, or a limit was passed. 2: wrong usage.
";

/// What to do.
#[derive(Debug, PartialEq)]
pub(crate) enum Command {
    /// Print the help text.
    Help,
    /// Print the version.
    Version,
    /// Print the string.
    Expand { file: PathBuf, changes: Changes },
    /// Write or print pictures.
    Draw { jobs: Vec<Job>, changes: Changes },
    /// Print facts.
    Info { files: Vec<PathBuf>, json: bool, changes: Changes },
}

/// What the command line changes in a file's system, and in what may be spent on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Changes {
    /// Derivation steps.
    pub(crate) iterations: Option<u32>,
    /// The seed.
    pub(crate) seed: Option<u32>,
    /// Other fields and their values, as they are written.
    pub(crate) settings: Vec<(String, String)>,
    /// Bytes that a drawing may take, in place of the usual limit.
    pub(crate) memory: Option<u64>,
}

/// One file to draw.
#[derive(Debug, PartialEq)]
pub(crate) struct Job {
    /// The file to read.
    pub(crate) file: PathBuf,
    /// Where the result goes.
    pub(crate) target: Target,
}

/// Where a drawing goes.
#[derive(Debug, PartialEq)]
pub(crate) enum Target {
    /// To standard output.
    Print(Format),
    /// To files: the base name without extension, and the formats.
    Write(PathBuf, Vec<Format>),
}

/// A form of a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Format {
    /// The string.
    Txt,
    /// The picture.
    Svg(SvgForm),
    /// The segments.
    Csv,
    /// Tubes of all segments, as text.
    Obj,
    /// The same as binary glTF.
    Glb,
    /// The picture in pixels; without a size, as large as usual.
    Png(Option<Size>),
}

/// Pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl Format {
    /// The file name's extension.
    pub(crate) fn extension(self) -> &'static str {
        match self {
            Self::Txt => "txt",
            Self::Svg(_) => "svg",
            Self::Csv => "csv",
            Self::Obj => "obj",
            Self::Glb => "glb",
            Self::Png(_) => "png",
        }
    }
}

/// The options as they stand, before they are matched with a command.
#[derive(Default)]
struct Options {
    changes: Changes,
    format: Option<Format>,
    size: Option<Size>,
    compact: bool,
    out_dir: Option<PathBuf>,
    json: bool,
}

/// Reads a command line, without the program's name.
///
/// # Errors
/// In words, when it is wrong.
pub(crate) fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Command, String> {
    let mut parser = lexopt::Parser::from_args(arguments);
    let mut options = Options::default();
    let mut words: Vec<OsString> = Vec::new();
    let explain = |error: lexopt::Error| error.to_string();
    while let Some(argument) = parser.next().map_err(explain)? {
        match argument {
            Short('h') | Long("help") => return Ok(Command::Help),
            Short('V') | Long("version") => return Ok(Command::Version),
            Short('n') | Long("iterations") => {
                let text = parser.value().map_err(explain)?;
                options.changes.iterations = Some(whole(&text, "-n", MAX_ITERATIONS)?);
            }
            Long("seed") => options.changes.seed = Some(whole(&parser.value().map_err(explain)?, "--seed", u32::MAX)?),
            Long("set") => {
                let text = parser.value().map_err(explain)?.to_string_lossy().into_owned();
                let Some((name, value)) = text.split_once('=') else {
                    return Err(format!("--set takes a name and a value such as angle_deg=30, not `{text}`"));
                };
                options.changes.settings.push((name.to_owned(), value.to_owned()));
            }
            Long("memory") => {
                let text = parser.value().map_err(explain)?;
                options.changes.memory = Some(memory::parse(&text.to_string_lossy())?);
            }
            Long("format") => options.format = Some(format(&parser.value().map_err(explain)?)?),
            Long("size") => options.size = Some(size(&parser.value().map_err(explain)?)?),
            Long("compact") => options.compact = true,
            Long("out-dir") => options.out_dir = Some(parser.value().map_err(explain)?.into()),
            Long("json") => options.json = true,
            Value(word) => words.push(word),
            other => return Err(explain(other.unexpected())),
        }
    }
    command(words, options)
}

/// Finds out which command the words mean.
fn command(words: Vec<OsString>, options: Options) -> Result<Command, String> {
    let mut words = words.into_iter().peekable();
    let name = words.peek().and_then(|word| word.to_str()).unwrap_or_default().to_owned();
    let named = matches!(name.as_str(), "expand" | "draw" | "info");
    if named {
        words.next();
    }
    let mut files: Vec<PathBuf> = words.map(PathBuf::from).collect();
    let [first, ..] = files.as_slice() else {
        let needs = if named { format!("lsys {name} needs a FILE") } else { "nothing to do".to_owned() };
        return Err(needs);
    };
    let first = first.clone();

    let Options { changes, mut format, size, compact, out_dir, json } = options;
    let drawing = !matches!(name.as_str(), "expand" | "info");
    if !drawing && (format.is_some() || out_dir.is_some()) {
        return Err("--format and --out-dir go with draw only".to_owned());
    }
    if size.is_some() {
        if !matches!(format, Some(Format::Png(_))) {
            return Err("--size goes with --format png only".to_owned());
        }
        format = Some(Format::Png(size));
    }
    let form = if compact { SvgForm::Compact } else { SvgForm::Flat };
    if compact {
        match &mut format {
            Some(Format::Svg(flat)) => *flat = form,
            None if drawing => {}
            _ => return Err("--compact goes with draw and --format svg only".to_owned()),
        }
    }
    if json && name != "info" {
        return Err("--json goes with info only".to_owned());
    }
    match name.as_str() {
        "expand" => match files.len() {
            1 => Ok(Command::Expand { file: first, changes }),
            _ => Err("lsys expand takes one FILE".to_owned()),
        },
        "info" => Ok(Command::Info { files, json, changes }),
        _ => {
            let formats = format.map_or_else(|| vec![Format::Txt, Format::Svg(form)], |format| vec![format]);
            if let Some(folder) = out_dir {
                return Ok(Command::Draw { jobs: into_folder(files, &folder, &formats)?, changes });
            }
            if !named && files.len() == 1 {
                return Err(format!("what about {}? Try lsys draw FILE or lsys info FILE", first.display()));
            }
            if files.len() > 2 {
                return Err("draw takes one FILE and one OUT_BASE; use --out-dir for many files".to_owned());
            }
            let base = files.drain(1..).next();
            let target = match (base, format) {
                (Some(base), _) if base.extension().is_some_and(|e| e == "json") => {
                    return Err(format!("OUT_BASE {} looks like a system; use --out-dir for many", base.display()));
                }
                (Some(base), _) if !names_a_file(&base) => {
                    return Err(format!(
                        "OUT_BASE `{}` must end in the name that the files shall have",
                        base.display()
                    ));
                }
                (Some(base), _) => Target::Write(base, formats),
                (None, Some(format)) => Target::Print(format),
                (None, None) => Target::Write(stem(&first)?, formats),
            };
            Ok(Command::Draw { jobs: vec![Job { file: first, target }], changes })
        }
    }
}

/// Whether `base` ends in a name, and not in a folder.
fn names_a_file(base: &Path) -> bool {
    // `x/` and `x/.` have the file name `x`, but that is not how the text ends.
    let ends = |name: &std::ffi::OsStr| base.as_os_str().as_encoded_bytes().ends_with(name.as_encoded_bytes());
    base.file_name().is_some_and(ends)
}

/// A job for each file, named after it; files of one name are told apart by their folders.
fn into_folder(files: Vec<PathBuf>, folder: &Path, formats: &[Format]) -> Result<Vec<Job>, String> {
    let stems = files.iter().map(|file| stem(file)).collect::<Result<Vec<_>, _>>()?;
    let mut bases: Vec<PathBuf> = Vec::new();
    for (file, stem) in files.iter().zip(&stems) {
        let mut base = stem.clone();
        if stems.iter().filter(|other| *other == stem).count() > 1
            && let Some(parent) = file.parent().and_then(Path::file_name)
        {
            let mut name = parent.to_owned();
            name.push("-");
            name.push(stem);
            base = name.into();
        }
        if let Some(other) = bases.iter().position(|other| *other == base) {
            let [one, two] = [&files[other], file].map(|path| path.display());
            return Err(format!("{one} and {two} would both be written to {}", folder.join(&base).display()));
        }
        bases.push(base);
    }
    let target = |base: &PathBuf| Target::Write(folder.join(base), formats.to_vec());
    Ok(files.into_iter().zip(&bases).map(|(file, base)| Job { file, target: target(base) }).collect())
}

/// The name of an output for `file`, in the working folder.
fn stem(file: &Path) -> Result<PathBuf, String> {
    let name = file.file_name().filter(|name| *name != "-").ok_or("name an OUT_BASE or a --format")?;
    let text = Path::new(name);
    // Only these are extensions here: the stem of `1.24d` is all of it.
    let known = text.extension().is_some_and(|e| ["json", "svg", "png"].iter().any(|known| e == *known));
    Ok(if known { text.with_extension("") } else { text.to_owned() })
}

fn whole(text: &OsString, option: &str, most: u32) -> Result<u32, String> {
    let text = text.to_string_lossy();
    let number = text.parse().ok().filter(|&number| number <= most);
    number.ok_or_else(|| format!("{option} takes a whole number from 0 to {most}, not `{text}`"))
}

fn format(text: &OsString) -> Result<Format, String> {
    match text.to_str() {
        Some("svg") => Ok(Format::Svg(SvgForm::Flat)),
        Some("csv") => Ok(Format::Csv),
        Some("obj") => Ok(Format::Obj),
        Some("glb") => Ok(Format::Glb),
        Some("txt") => Ok(Format::Txt),
        Some("png") => Ok(Format::Png(None)),
        _ => Err(format!("--format takes svg, png, csv, txt, obj or glb, not `{}`", text.to_string_lossy())),
    }
}

fn is_possible(width: u32, height: u32) -> bool {
    let viewport = Viewport { width, height, ratio: 1.0 };
    width > 0 && height > 0 && viewport.within_limits() == viewport
}

fn size(text: &OsString) -> Result<Size, String> {
    let text = text.to_string_lossy();
    let sides = text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match sides {
        Some((width, height)) if is_possible(width, height) => Ok(Size { width, height }),
        Some(_) => Err(format!(
            "--size takes 1 to {MAX_PICTURE_SIDE} pixels each way and {MAX_PICTURE_PIXELS} in all, not `{text}`"
        )),
        None => Err(format!("--size takes a width and a height such as 1600x1200, not `{text}`")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

    fn check(line: &str, expected: &Expect) {
        let with = |Changes { iterations, seed, settings, memory }| {
            let set = if settings.is_empty() { String::new() } else { format!(" set {settings:?}") };
            let memory = memory.map_or_else(String::new, |bytes| format!(" memory {bytes}"));
            format!("n {iterations:?} seed {seed:?}{set}{memory}")
        };
        let text = match parse(line.split_whitespace().map(OsString::from)) {
            Ok(Command::Expand { file, changes }) => format!("expand {file:?} {}", with(changes)),
            Ok(Command::Info { files, json, changes }) => format!("info {files:?} json {json} {}", with(changes)),
            Ok(Command::Draw { jobs, changes }) => {
                let jobs: Vec<String> = jobs.iter().map(|job| format!("{:?} to {:?}", job.file, job.target)).collect();
                format!("draw {} {}", jobs.join(", "), with(changes))
            }
            Ok(other) => format!("{other:?}"),
            Err(error) => format!("error: {error}"),
        };
        expected.assert_eq(&text);
    }

    #[test]
    fn commands() {
        check("expand a.json -n 3", &expect![[r#"expand "a.json" n Some(3) seed None"#]]);
        check("a.json out", &expect![[r#"draw "a.json" to Write("out", [Txt, Svg(Flat)]) n None seed None"#]]);
        check("draw a.json", &expect![[r#"draw "a.json" to Write("a", [Txt, Svg(Flat)]) n None seed None"#]]);
        check(
            "draw some/1.24d.json --seed=7",
            &expect![[r#"draw "some/1.24d.json" to Write("1.24d", [Txt, Svg(Flat)]) n None seed Some(7)"#]],
        );
        check("draw --format csv a.json", &expect![[r#"draw "a.json" to Print(Csv) n None seed None"#]]);
        check("draw a.json out --format csv", &expect![[r#"draw "a.json" to Write("out", [Csv]) n None seed None"#]]);
        check(
            "draw a.json b.json --out-dir pictures",
            &expect![[
                r#"draw "a.json" to Write("pictures/a", [Txt, Svg(Flat)]), "b.json" to Write("pictures/b", [Txt, Svg(Flat)]) n None seed None"#
            ]],
        );
        check(
            "draw x/a.json y/a.json --out-dir d",
            &expect![[
                r#"draw "x/a.json" to Write("d/x-a", [Txt, Svg(Flat)]), "y/a.json" to Write("d/y-a", [Txt, Svg(Flat)]) n None seed None"#
            ]],
        );
        check("info a.json b.json --json", &expect![[r#"info ["a.json", "b.json"] json true n None seed None"#]]);
        check("info -- -n", &expect![[r#"info ["-n"] json false n None seed None"#]]);
        check("draw - --format svg", &expect![[r#"draw "-" to Print(Svg(Flat)) n None seed None"#]]);
        check(
            "draw a --size 40x30 --format png",
            &expect![[r#"draw "a" to Print(Png(Some(Size { width: 40, height: 30 }))) n None seed None"#]],
        );
        check(
            "draw a --set x=1 --set y=a=b",
            &expect![[r#"draw "a" to Write("a", [Txt, Svg(Flat)]) n None seed None set [("x", "1"), ("y", "a=b")]"#]],
        );
        check("info a --set x", &expect!["error: --set takes a name and a value such as angle_deg=30, not `x`"]);
        check("info a --memory 2M", &expect![[r#"info ["a"] json false n None seed None memory 2097152"#]]);
        check("draw a --compact", &expect![[r#"draw "a" to Write("a", [Txt, Svg(Compact)]) n None seed None"#]]);
        check("draw a --compact --format svg", &expect![[r#"draw "a" to Print(Svg(Compact)) n None seed None"#]]);
        check("--help nonsense", &expect!["Help"]);
    }

    #[test]
    fn wrong_usage() {
        check("", &expect!["error: nothing to do"]);
        check("a.json", &expect!["error: what about a.json? Try lsys draw FILE or lsys info FILE"]);
        check("expand", &expect!["error: lsys expand needs a FILE"]);
        check("expand a b", &expect!["error: lsys expand takes one FILE"]);
        check("expand a -n -1", &expect!["error: -n takes a whole number from 0 to 1000, not `-1`"]);
        check("expand a -n 1001", &expect!["error: -n takes a whole number from 0 to 1000, not `1001`"]);
        check("expand a -n", &expect!["error: missing argument for option '-n'"]);
        check("expand a --seed x", &expect!["error: --seed takes a whole number from 0 to 4294967295, not `x`"]);
        check(
            "info a --memory 2",
            &expect!["error: --memory takes a whole number with K, M, G or T, such as 512M or 2G, not `2`"],
        );
        check("expand a --json", &expect!["error: --json goes with info only"]);
        check("expand a --format svg", &expect!["error: --format and --out-dir go with draw only"]);
        check("draw a --format gif", &expect!["error: --format takes svg, png, csv, txt, obj or glb, not `gif`"]);
        check("draw a --size 10x10", &expect!["error: --size goes with --format png only"]);
        check("draw a --compact --format csv", &expect!["error: --compact goes with draw and --format svg only"]);
        check("info a --compact", &expect!["error: --compact goes with draw and --format svg only"]);
        check(
            "draw a --format png --size 10",
            &expect!["error: --size takes a width and a height such as 1600x1200, not `10`"],
        );
        check(
            "draw a --format png --size 0x10",
            &expect!["error: --size takes 1 to 32768 pixels each way and 100000000 in all, not `0x10`"],
        );
        check(
            "draw a --format png --size 4000000000x4000000000",
            &expect![
                "error: --size takes 1 to 32768 pixels each way and 100000000 in all, not `4000000000x4000000000`"
            ],
        );
        check("draw a.json b.json", &expect!["error: OUT_BASE b.json looks like a system; use --out-dir for many"]);
        check("draw a b c", &expect!["error: draw takes one FILE and one OUT_BASE; use --out-dir for many files"]);
        check("draw a /", &expect!["error: OUT_BASE `/` must end in the name that the files shall have"]);
        check(
            "draw a pictures/",
            &expect!["error: OUT_BASE `pictures/` must end in the name that the files shall have"],
        );
        check("draw a ..", &expect!["error: OUT_BASE `..` must end in the name that the files shall have"]);
        check("draw -", &expect!["error: name an OUT_BASE or a --format"]);
        check("draw a.json a.json --out-dir d", &expect!["error: a.json and a.json would both be written to d/a"]);
        check("info a --loud", &expect!["error: invalid option '--loud'"]);
    }
}
