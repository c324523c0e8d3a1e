//! The command line as a value.

use crate::cli::{Changes, Cli, ExhibitOptions, FilmOptions, GrowthFormat, Look, ScormOptions, TileOptions, Verb};
use crate::find::Known;
use crate::help;
use crate::usage;
use crate::view::ViewOptions;
use clap::FromArgMatches;
use clap::error::ErrorKind;
use lsystem::base::say;
use lsystem::base::words::said;
use lsystem::files::Format;
use lsystem::import::write::{NOTATIONS, Notation};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// A checked command.
#[derive(Debug, PartialEq)]
pub(crate) enum Command {
    /// Print a text: help, the version or a completion script.
    Print(String),
    /// Show a system in the browser.
    View { file: PathBuf, options: ViewOptions, changes: Changes },
    /// Print the link of a system.
    Link { file: PathBuf, page: Option<String>, changes: Changes },
    /// Print a shape.
    Shape { file: PathBuf },
    /// Print the derived string.
    Expand { file: PathBuf, changes: Changes },
    /// Write or print pictures and other files.
    Draw {
        jobs: Vec<Job>,
        /// The folder for the output of every file, made if it is missing.
        folder: Option<PathBuf>,
        look: Look,
        changes: Changes,
    },
    /// Write a pyramid of tiles.
    Tiles { file: PathBuf, dir: PathBuf, options: TileOptions, changes: Changes },
    /// Make a film.
    Animate { file: PathBuf, to: PathBuf, film: Box<FilmOptions>, changes: Changes },
    /// Convert files of other programs to JSON files in a folder.
    Import { files: Vec<PathBuf>, to: PathBuf },
    /// Print what is read from a file, part by part.
    Account { files: Vec<PathBuf> },
    /// Print a system in another notation.
    Export { file: PathBuf, notation: &'static Notation, changes: Changes },
    /// Compare the output of a program with a system.
    Check { file: PathBuf, output: PathBuf, changes: Changes },
    /// Find the rules of a string or a picture.
    Find { text: String, known: Known, json: bool },
    /// Print a new system.
    Surprise { seed: Option<u32> },
    /// Write children of one or two systems.
    Breed { files: Vec<PathBuf>, to: PathBuf, seed: Option<u32>, count: u32 },
    /// Write a page with drawings.
    Exhibit { files: Vec<PathBuf>, to: PathBuf, options: ExhibitOptions },
    /// Mark answers to an exercise.
    Mark { exercise: String, answers: Vec<String>, csv: bool, html: Option<PathBuf> },
    /// Write a package for learning systems.
    Scorm { exercises: Vec<String>, to: PathBuf, options: ScormOptions },
    /// Print facts.
    Info { files: Vec<PathBuf>, json: bool, growth: Option<GrowthFormat>, changes: Changes },
}

/// One file to draw.
#[derive(Debug, PartialEq)]
pub(crate) struct Job {
    /// The file to read.
    pub(crate) file: PathBuf,
    /// The destination.
    pub(crate) target: Destination,
}

/// The destination and the formats of a drawing.
#[derive(Debug, PartialEq)]
pub(crate) enum Destination {
    /// Standard output, in this format.
    Print(&'static Format),
    /// Files: the base name without extension, and the formats.
    Write(PathBuf, Vec<&'static Format>),
}

/// Reads a command line, without the program's name.
///
/// # Errors
/// A message about wrong usage.
pub(crate) fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Command, String> {
    let mut cli = help::command();
    let words = command_first(arguments.into_iter().collect(), &cli);
    let program = OsString::from("lsys");
    let verb = match cli
        .try_get_matches_from_mut([program].into_iter().chain(words))
        .and_then(|matches| Cli::from_arg_matches(&matches))
    {
        Ok(Cli { verb, .. }) => verb,
        Err(error) => match error.kind() {
            ErrorKind::DisplayHelp => return Ok(Command::Print(error.to_string())),
            ErrorKind::DisplayVersion => return Ok(Command::Print(cli.render_version())),
            _ => return Err(usage::report(&error)),
        },
    };
    let mut explain = |name: &str, words: String| {
        let usage = cli.find_subcommand_mut(name).map(|command| command.render_usage().to_string());
        usage::written(&words, &[], usage.as_deref())
    };
    match verb {
        Verb::View { file, port, no_browser, page, entry } => Ok(Command::View {
            file,
            options: ViewOptions { port, page, opens: !no_browser },
            changes: Changes { entry, ..Changes::default() },
        }),
        Verb::Link { file, page, changes } => Ok(Command::Link { file, page, changes }),
        Verb::Shape { file } => Ok(Command::Shape { file }),
        Verb::Expand { file, changes } => Ok(Command::Expand { file, changes }),
        Verb::Draw { files, out_dir, look, changes } => match jobs(files, out_dir.as_deref(), &look) {
            Ok(jobs) => Ok(Command::Draw { jobs, folder: out_dir, look, changes }),
            Err(words) => Err(explain("draw", words)),
        },
        Verb::Info { files, json, growth, changes } => {
            match files.iter().filter(|file| file.as_os_str() == "-").count() {
                0 | 1 => Ok(Command::Info { files, json, growth, changes }),
                _ => Err(explain("info", say!("standard input (-) can be read only once"))),
            }
        }
        Verb::Tiles { file, dir, options, changes } => Ok(Command::Tiles { file, dir, options, changes }),
        Verb::Animate { file, to, film, changes } => Ok(Command::Animate { file, to, film: Box::new(film), changes }),
        Verb::Import { files, to: Some(to), .. } => Ok(Command::Import { files, to }),
        Verb::Import { files, .. } => Ok(Command::Account { files }),
        Verb::Export { file: Some(file), notation: Some(notation), list: false, changes } => {
            Ok(Command::Export { file, notation, changes })
        }
        Verb::Export { .. } => {
            let width = NOTATIONS.iter().map(|notation| notation.name.len()).max().unwrap_or_default();
            let line = |notation: &Notation| format!("{:width$}  {}\n", notation.name, said(notation.help));
            Ok(Command::Print(NOTATIONS.iter().map(line).collect()))
        }
        Verb::Check { file, output, changes } => match file == output && file.as_os_str() == "-" {
            false => Ok(Command::Check { file, output, changes }),
            true => Err(explain("check", say!("standard input (-) can be read only once"))),
        },
        Verb::Find { text, axiom, iterations: n, constants, angle, heading, draws, seconds, json } => {
            Ok(Command::Find { text, known: Known { axiom, n, constants, angle, heading, draws, seconds }, json })
        }
        Verb::Surprise { seed } => Ok(Command::Surprise { seed }),
        Verb::Breed { files, to, seed, count } => match files.iter().filter(|file| file.as_os_str() == "-").count() {
            0 | 1 => Ok(Command::Breed { files, to, seed, count }),
            _ => Err(explain("breed", say!("standard input (-) can be read only once"))),
        },
        Verb::Mark { exercise, answers, csv, html } => Ok(Command::Mark { exercise, answers, csv, html }),
        Verb::Exhibit { files, to, options } => Ok(Command::Exhibit { files, to, options }),
        Verb::Scorm { exercises, to, options } => Ok(Command::Scorm { exercises, to, options }),
        Verb::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut cli, "lsys", &mut script);
            Ok(Command::Print(String::from_utf8_lossy(&script).into_owned()))
        }
    }
}

impl Command {
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

/// Moves the command to the front: options may stand before it. Without a command, `FILE` means `view`, and
/// `FILE OUT_BASE` means `draw`.
fn command_first(mut words: Vec<OsString>, cli: &clap::Command) -> Vec<OsString> {
    let takes_value = |word: &str| {
        let mut options = cli.get_subcommands().flat_map(clap::Command::get_opts);
        options.any(|option| {
            let short = option.get_short().map(|short| format!("-{short}"));
            let aliases = option.get_all_aliases().unwrap_or_default();
            let longs = option.get_long().into_iter().chain(aliases).map(|long| format!("--{long}"));
            short.into_iter().chain(longs).any(|name| name == word)
        })
    };
    let (mut at, mut names) = (0, 0);
    while let Some(word) = words.get(at).map(|word| word.to_string_lossy()) {
        match &*word {
            "-h" | "--help" | "-V" | "--version" if names == 0 => return words,
            "--" => {
                names += words.len() - at - 1;
                break;
            }
            option if option.starts_with('-') && option != "-" => at += if takes_value(option) { 2 } else { 1 },
            name if names == 0 && cli.find_subcommand(name).is_some() => {
                let command = words.remove(at);
                words.insert(0, command);
                return words;
            }
            _ => {
                names += 1;
                at += 1;
            }
        }
    }
    match names {
        0 => {}
        1 => words.insert(0, "view".into()),
        _ => words.insert(0, "draw".into()),
    }
    words
}

/// The jobs of `draw`.
///
/// # Errors
/// A message if options or files contradict each other.
fn jobs(files: Vec<PathBuf>, out_dir: Option<&Path>, look: &Look) -> Result<Vec<Job>, String> {
    let &Look { format, compact, zoom, ref segment, ref flags } = look;
    let is = |name| format.is_some_and(|format: &Format| format.name == name);
    if compact && format.is_some() && !is("svg") {
        return Err(say!("--compact needs --format svg or no --format"));
    }
    if (zoom.is_some() || segment.is_some()) && !is("png") {
        return Err(say!("--zoom and --segment need --format png"));
    }
    let picture = if compact { "svg-compact" } else { "svg" };
    let names = match format {
        None => vec!["txt", picture],
        Some(_) if compact => vec![picture],
        Some(format) => vec![format.name],
    };
    let formats: Vec<_> = names.into_iter().filter_map(Format::named).collect();
    flags.check(&formats)?;
    if let Some(folder) = out_dir {
        return into_folder(files, folder, &formats);
    }
    let (file, base) = match <[PathBuf; 2]>::try_from(files) {
        Ok([file, base]) => (file, Some(base)),
        Err(files) if files.len() > 2 => {
            return Err(say!("draw takes one FILE and one OUT_BASE; use --out-dir for many files"));
        }
        Err(mut files) => (files.pop().unwrap_or_default(), None),
    };
    let target = match (base, format) {
        (Some(base), _) if base.extension().is_some_and(|e| e == "json") => {
            return Err(say!("OUT_BASE {} looks like a system; use --out-dir for many files", base.display()));
        }
        (Some(base), _) if !names_a_file(&base) => {
            return Err(say!("OUT_BASE `{}` must end in a file name", base.display()));
        }
        (Some(base), _) => Destination::Write(base, formats),
        (None, Some(_)) => Destination::Print(formats[0]),
        (None, None) => Destination::Write(stem(&file)?, formats),
    };
    Ok(vec![Job { file, target }])
}

/// Whether `base` ends in a file's name, not in a folder.
fn names_a_file(base: &Path) -> bool {
    // `x/` and `x/.` have the file name `x`, but do not end in it.
    let ends = |name: &OsStr| base.as_os_str().as_encoded_bytes().ends_with(name.as_encoded_bytes());
    base.file_name().is_some_and(ends)
}

/// A job for each file, named after the file. Files with the same name get their folder's name in front.
fn into_folder(files: Vec<PathBuf>, folder: &Path, formats: &[&'static Format]) -> Result<Vec<Job>, String> {
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
            return Err(say!("{} and {} would both be written to {}", one, two, folder.join(&base).display()));
        }
        bases.push(base);
    }
    let target = |base: &PathBuf| Destination::Write(folder.join(base), formats.to_vec());
    Ok(files.into_iter().zip(&bases).map(|(file, base)| Job { file, target: target(base) }).collect())
}

/// The base name of the output for `file`, in the working folder.
fn stem(file: &Path) -> Result<PathBuf, String> {
    let name = file.file_name().filter(|name| *name != "-").ok_or_else(|| say!("give an OUT_BASE or a --format"))?;
    let text = Path::new(name);
    // Other endings are part of the name, such as in `1.24d`.
    let known = text.extension().is_some_and(|e| ["json", "svg", "png", "pdf"].iter().any(|known| e == *known));
    Ok(if known { text.with_extension("") } else { text.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

    fn check(line: &str, expected: &Expect) {
        let with = |Changes { iterations, seed, settings, memory, entry }| {
            let set = if settings.is_empty() { String::new() } else { format!(" set {settings:?}") };
            let memory = memory.map_or_else(String::new, |bytes| format!(" memory {bytes}"));
            let entry = entry.map_or_else(String::new, |name| format!(" entry {name}"));
            format!("n {iterations:?} seed {seed:?}{set}{memory}{entry}")
        };
        let text = match parse(line.split_whitespace().map(OsString::from)) {
            Ok(Command::Expand { file, changes }) => format!("expand {file:?} {}", with(changes)),
            Ok(Command::Info { files, json, changes, .. }) => format!("info {files:?} json {json} {}", with(changes)),
            Ok(Command::Draw { jobs, look: Look { flags, compact, .. }, changes, .. }) => {
                let jobs: Vec<String> = jobs.iter().map(|job| format!("{:?} to {:?}", job.file, job.target)).collect();
                let size =
                    flags.options().size.map_or_else(String::new, |[width, height]| format!(" {width} by {height}"));
                let compact = if compact { " compact" } else { "" };
                format!("draw {}{size}{compact} {}", jobs.join(", "), with(changes))
            }
            Ok(Command::Tiles { file, dir, options, changes }) => {
                let TileOptions { levels, scheme, size, part, under, .. } = options;
                format!("tiles {file:?} to {dir:?} {levels:?} {scheme:?} {size} {part:?} {under:?} {}", with(changes))
            }
            Ok(Command::Animate { file, to, film, .. }) => {
                format!("animate {file:?} to {to:?} dive {:?} track {:?}", film.dive, film.track)
            }
            Ok(Command::Import { files, to }) => format!("import {files:?} to {to:?}"),
            Ok(Command::Account { files }) => format!("account of {files:?}"),
            Ok(Command::Export { file, notation, changes }) => {
                format!("export {file:?} as {} {}", notation.name, with(changes))
            }
            Ok(Command::Check { file, output, changes }) => format!("check {file:?} {output:?} {}", with(changes)),
            Ok(Command::Print(text)) => format!("print {}", text.lines().next().unwrap_or_default()),
            Ok(Command::Find { text, known, json }) => format!("find {text} {known:?} json {json}"),
            Ok(Command::Mark { exercise, answers, csv, html }) => {
                format!("mark {exercise} {answers:?} csv {csv} {html:?}")
            }
            Ok(Command::View { file, options, changes }) => format!("view {file:?} {options:?} {}", with(changes)),
            Ok(Command::Link { file, page, changes }) => format!("link {file:?} {page:?} {}", with(changes)),
            Ok(
                command @ (Command::Shape { .. }
                | Command::Surprise { .. }
                | Command::Breed { .. }
                | Command::Exhibit { .. }
                | Command::Scorm { .. }),
            ) => {
                format!("{command:?}")
            }
            Err(error) => error.split("\n\n").next().unwrap_or_default().to_owned(),
        };
        expected.assert_eq(&text);
    }

    #[test]
    fn commands() {
        check(
            "a.json",
            &expect![[r#"view "a.json" ViewOptions { port: None, page: None, opens: true } n None seed None"#]],
        );
        for same in ["view a.json", "-- a.json"] {
            assert_eq!(parse(same.split(' ').map(OsString::from)), parse(["a.json".into()]));
        }
        check(
            "--port 8080 a.l --entry Bush --no-browser --page p.html",
            &expect![[
                r#"view "a.l" ViewOptions { port: Some(8080), page: Some("p.html"), opens: false } n None seed None entry Bush"#
            ]],
        );
        check(
            "link a.json -n 3 --page https://example.org/",
            &expect![[r#"link "a.json" Some("https://example.org/") n Some(3) seed None"#]],
        );
        check("surprise --seed 7", &expect![["Surprise { seed: Some(7) }"]]);
        check(
            "breed a.json - --to out --count 4",
            &expect![[r#"Breed { files: ["a.json", "-"], to: "out", seed: None, count: 4 }"#]],
        );
        check("breed - - --to out", &expect![["error: standard input (-) can be read only once"]]);
        check("expand a.json -n 3", &expect![[r#"expand "a.json" n Some(3) seed None"#]]);
        check(
            "animate --dive a.json --to a.gif --track angle=0:-20,5:30",
            &expect![[r#"animate "a.json" to "a.gif" dive Some(Dive(None)) track ["angle=0:-20,5:30"]"#]],
        );
        check("a.json out", &expect![[r#"draw "a.json" to Write("out", [txt, svg]) n None seed None"#]]);
        check("draw a.json", &expect![[r#"draw "a.json" to Write("a", [txt, svg]) n None seed None"#]]);
        check(
            "draw some/1.24d.json --seed=7",
            &expect![[r#"draw "some/1.24d.json" to Write("1.24d", [txt, svg]) n None seed Some(7)"#]],
        );
        check("draw --format csv a.json", &expect![[r#"draw "a.json" to Print(csv) n None seed None"#]]);
        check("draw a.json out --format csv", &expect![[r#"draw "a.json" to Write("out", [csv]) n None seed None"#]]);
        check(
            "draw a.json b.json --out-dir pictures",
            &expect![[
                r#"draw "a.json" to Write("pictures/a", [txt, svg]), "b.json" to Write("pictures/b", [txt, svg]) n None seed None"#
            ]],
        );
        check(
            "--to d draw x/a.json y/a.json",
            &expect![[
                r#"draw "x/a.json" to Write("d/x-a", [txt, svg]), "y/a.json" to Write("d/y-a", [txt, svg]) n None seed None"#
            ]],
        );
        check("mark #x=a b.csv c --csv", &expect![[r##"mark #x=a ["b.csv", "c"] csv true None"##]]);
        check("info a.json b.json --json", &expect![[r#"info ["a.json", "b.json"] json true n None seed None"#]]);
        check("info -- -n", &expect![[r#"info ["-n"] json false n None seed None"#]]);
        check("draw - --format svg", &expect![[r#"draw "-" to Print(svg) n None seed None"#]]);
        check("draw a --size 40x30 --format png", &expect![[r#"draw "a" to Print(png) 40 by 30 n None seed None"#]]);
        check(
            "draw a --set x=1 --set y=a=b",
            &expect![[r#"draw "a" to Write("a", [txt, svg]) n None seed None set [("x", "1"), ("y", "a=b")]"#]],
        );
        check(
            "info a --set x",
            &expect![
                "error: invalid value 'x' for '--set <NAME=VALUE>': expected a name and a value such as angle_deg=30"
            ],
        );
        check("info a --memory 2M", &expect![[r#"info ["a"] json false n None seed None memory 2097152"#]]);
        check("draw a --compact", &expect![[r#"draw "a" to Write("a", [txt, svg-compact]) compact n None seed None"#]]);
        check(
            "draw a --compact --format svg",
            &expect![[r#"draw "a" to Print(svg-compact) compact n None seed None"#]],
        );
        check("-n 3 --json info a", &expect![[r#"info ["a"] json true n Some(3) seed None"#]]);
        check(
            "--seed=4 a.json -n3 out",
            &expect![[r#"draw "a.json" to Write("out", [txt, svg]) n Some(3) seed Some(4)"#]],
        );
        check("-- draw out", &expect![[r#"draw "draw" to Write("out", [txt, svg]) n None seed None"#]]);
        check(
            "tiles a.json d --levels 2..9 --scheme xyz --size 512 --part 1/3 --under 4/15/0",
            &expect![[
                r#"tiles "a.json" to "d" Levels(2, 9) Xyz 512 Part(Share { part: 1, of: 3, level: 4 }) Under(TilePlace { level: 4, x: 15, y: 0 }) n None seed None"#
            ]],
        );
        for (option, words) in [
            ("--levels 3..2", "expected levels such as 0..8, at most 60"),
            ("--levels 0..61", "expected levels such as 0..8, at most 60"),
            ("--part 3/3", "expected a part such as 0/4, the first of four"),
            ("--under 2/4/0", "expected a tile such as 3/0/7: the level, at most 60, the column and the row"),
            ("--size 100", "expected 256 or 512"),
        ] {
            let line = format!("tiles a d {option}");
            let told = parse(line.split_whitespace().map(OsString::from)).unwrap_err();
            assert!(told.contains(words), "{told}");
        }
        check("draw a --dpi 300", &expect!["error: --dpi needs --format png"]);
        check("expand a -n 3 -n 4", &expect![[r#"expand "a" n Some(4) seed None"#]]);
        check(
            "expand a --set tropism=-1 --set -x",
            &expect![
                "error: invalid value '-x' for '--set <NAME=VALUE>': expected a name and a value such as angle_deg=30"
            ],
        );
        check("draw a --format csv out", &expect![[r#"draw "a" to Write("out", [csv]) n None seed None"#]]);
        check("--help nonsense", &expect!["print Derives, draws and inspects L-systems"]);
        check("a out -h", &expect!["print Write or print pictures, meshes, segments and strings"]);
        check("info a -V", &expect!["print lsys 0.1.0"]);
        check(
            "draw old.l out --entry Bush",
            &expect![[r#"draw "old.l" to Write("out", [txt, svg]) n None seed None entry Bush"#]],
        );
        check("import a.l --account", &expect![[r#"account of ["a.l"]"#]]);
        check("export --as cpfg a.l", &expect![[r#"export "a.l" as cpfg n None seed None"#]]);
        check(
            "export --list",
            &expect!["print text      Labelled lines, as in papers, where our reader makes the same system of them"],
        );
        check("import a.l folder --to out", &expect![[r#"import ["a.l", "folder"] to "out""#]]);
        check("check a.json out.txt -n 3", &expect![[r#"check "a.json" "out.txt" n Some(3) seed None"#]]);
        check("help draw", &expect!["print Write or print pictures, meshes, segments and strings"]);
    }

    #[test]
    fn wrong_usage() {
        check("", &expect!["Derives, draws and inspects L-systems"]);
        check("a.json --port 0", &expect!["error: invalid value '0' for '--port <N>': 0 is not in 1..=65535"]);
        check("a.json --format csv", &expect!["error: unexpected argument '--format' found"]);
        check(
            "expand",
            &expect![[r#"
            error: the following required arguments were not provided:
              <FILE>"#]],
        );
        check("expand a b", &expect!["error: unexpected argument 'b' found"]);
        check(
            "expand a -n -1",
            &expect!["error: invalid value '-1' for '--iterations <N>': expected a whole number from 0 to 1000"],
        );
        check(
            "expand a -n 1001",
            &expect!["error: invalid value '1001' for '--iterations <N>': expected a whole number from 0 to 1000"],
        );
        check("expand a -n", &expect!["error: a value is required for '--iterations <N>' but none was supplied"]);
        check(
            "expand a --seed x",
            &expect!["error: invalid value 'x' for '--seed <SEED>': expected a whole number from 0 to 4294967295"],
        );
        check(
            "info a --memory 2",
            &expect![
                "error: invalid value '2' for '--memory <SIZE>': expected a whole number with K, M, G or T, such as 512M or 2G"
            ],
        );
        check("expand a --json", &expect!["error: unexpected argument '--json' found"]);
        check("expand a --format svg", &expect!["error: unexpected argument '--format' found"]);
        check(
            "draw a --format gif",
            &expect![[r#"
                error: invalid value 'gif' for '--format <FORMAT>'
                  [possible values: svg, svg-compact, plotter, png, pdf, tikz, tikz-library, latex, markdown, bibtex, midi, json, txt, csv, obj, glb, stl]"#]],
        );
        check("draw a --size 10x10", &expect!["error: --size needs --format png"]);
        check("draw a --pen 0.5", &expect!["error: --pen needs --format plotter"]);
        check(
            "draw a --format plotter --sheet b9",
            &expect![
                "error: invalid value 'b9' for '--sheet <SIZE>': expected `a5`, `a4`, `a3`, `a2`, `a1`, `letter`, `legal`, `tabloid`, or a width and a height such as 300x400, with 10 to 10,000 mm each way"
            ],
        );
        check("draw a --compact --format csv", &expect!["error: --compact needs --format svg or no --format"]);
        check("info a --compact", &expect!["error: unexpected argument '--compact' found"]);
        check(
            "draw a --format png --size 10",
            &expect![
                "error: invalid value '10' for '--size <WxH>': expected a width and a height such as 1600x1200, with 1 to 32,768 pixels each way"
            ],
        );
        check(
            "draw a --format png --size 0x10",
            &expect![
                "error: invalid value '0x10' for '--size <WxH>': expected a width and a height such as 1600x1200, with 1 to 32,768 pixels each way"
            ],
        );
        check(
            "draw a --format png --size 4000000000x4000000000",
            &expect![
                "error: invalid value '4000000000x4000000000' for '--size <WxH>': expected a width and a height such as 1600x1200, with 1 to 32,768 pixels each way"
            ],
        );
        check(
            "draw a.json b.json",
            &expect!["error: OUT_BASE b.json looks like a system; use --out-dir for many files"],
        );
        check("draw a b c", &expect!["error: draw takes one FILE and one OUT_BASE; use --out-dir for many files"]);
        check("draw a /", &expect!["error: OUT_BASE `/` must end in a file name"]);
        check("draw a pictures/", &expect!["error: OUT_BASE `pictures/` must end in a file name"]);
        check("draw a ..", &expect!["error: OUT_BASE `..` must end in a file name"]);
        check("draw -", &expect!["error: give an OUT_BASE or a --format"]);
        check("draw a.json a.json --out-dir d", &expect!["error: a.json and a.json would both be written to d/a"]);
        check("info - -", &expect!["error: standard input (-) can be read only once"]);
        check(
            "completions tcsh",
            &expect![[r#"
            error: invalid value 'tcsh' for '<SHELL>'
              [possible values: bash, elvish, fish, powershell, zsh]"#]],
        );
        check("info a --loud", &expect!["error: unexpected argument '--loud' found"]);
    }
}
