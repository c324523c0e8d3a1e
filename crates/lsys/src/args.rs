//! The command line as a value.

use crate::cli::{Cli, Look, Verb};
use crate::help;
use crate::usage;
use clap::FromArgMatches;
use clap::error::ErrorKind;
use lsystem::base::say;
use lsystem::files::Format;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// The end of a run that has no command to do.
#[derive(Debug, PartialEq)]
pub(crate) enum Stop {
    /// Help or the version is wanted.
    Print(String),
    /// The usage is wrong.
    Wrong(String),
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
/// [`Stop`] if the line names no command, or is wrong.
pub(crate) fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Verb, Stop> {
    let mut cli = help::command();
    let words = command_first(arguments.into_iter().collect(), &cli);
    let program = OsString::from("lsys");
    let read = cli.try_get_matches_from_mut([program].into_iter().chain(words));
    let verb = match read.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(Cli { verb, .. }) => verb,
        Err(error) => match error.kind() {
            ErrorKind::DisplayHelp => return Err(Stop::Print(error.to_string())),
            ErrorKind::DisplayVersion => return Err(Stop::Print(cli.render_version())),
            _ => return Err(Stop::Wrong(usage::report(&error))),
        },
    };
    check(&verb).map_err(|(name, words)| {
        let usage = cli.find_subcommand_mut(name).map(|command| command.render_usage().to_string());
        Stop::Wrong(usage::written(&words, &[], usage.as_deref()))
    })?;
    Ok(verb)
}

/// Checks how the arguments of a command fit together.
///
/// # Errors
/// The name of the command, and a message.
fn check(verb: &Verb) -> Result<(), (&'static str, String)> {
    let once = |name, files: &[&PathBuf]| match files.iter().filter(|file| file.as_os_str() == "-").count() {
        0 | 1 => Ok(()),
        _ => Err((name, say!("standard input (-) can be read only once"))),
    };
    match verb {
        Verb::Draw { files, out_dir, look, .. } => {
            jobs(files, out_dir.as_deref(), look).map(drop).map_err(|words| ("draw", words))
        }
        Verb::Info { files, .. } => once("info", &files.iter().collect::<Vec<_>>()),
        Verb::Breed { files, .. } => once("breed", &files.iter().collect::<Vec<_>>()),
        Verb::Check { file, output, .. } => once("check", &[file, output]),
        _ => Ok(()),
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
pub(crate) fn jobs(files: &[PathBuf], out_dir: Option<&Path>, look: &Look) -> Result<Vec<Job>, String> {
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
    let (file, base) = match files {
        [file] => (file, None),
        [file, base] => (file, Some(base)),
        _ => return Err(say!("draw takes one FILE and one OUT_BASE; use --out-dir for many files")),
    };
    let target = match (base, format) {
        (Some(base), _) if base.extension().is_some_and(|e| e == "json") => {
            return Err(say!("OUT_BASE {} looks like a system; use --out-dir for many files", base.display()));
        }
        (Some(base), _) if !names_a_file(base) => {
            return Err(say!("OUT_BASE `{}` must end in a file name", base.display()));
        }
        (Some(base), _) => Destination::Write(base.clone(), formats),
        (None, Some(_)) => Destination::Print(formats[0]),
        (None, None) => Destination::Write(stem(file)?, formats),
    };
    Ok(vec![Job { file: file.clone(), target }])
}

/// Whether `base` ends in a file's name, not in a folder.
fn names_a_file(base: &Path) -> bool {
    // `x/` and `x/.` have the file name `x`, but do not end in it.
    let ends = |name: &OsStr| base.as_os_str().as_encoded_bytes().ends_with(name.as_encoded_bytes());
    base.file_name().is_some_and(ends)
}

/// A job for each file, named after the file. Files with the same name get their folder's name in front.
fn into_folder(files: &[PathBuf], folder: &Path, formats: &[&'static Format]) -> Result<Vec<Job>, String> {
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
    Ok(files.iter().zip(&bases).map(|(file, base)| Job { file: file.clone(), target: target(base) }).collect())
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
mod tests;
