//! `lsys`: derives, draws, compares and inspects L-systems from JSON files and from files of other programs. The library
//! `lsystem` does the work; this program reads arguments and files and writes results and messages.

mod account;
mod animate;
mod answers;
mod args;
mod check;
mod cli;
mod cores;
mod draw;
mod exhibit;
mod export;
mod file_flags;
mod find;
mod growth;
mod help;
mod import;
mod info;
mod input;
mod invent;
mod language;
mod link;
mod mark;
mod memory;
mod output;
mod pages;
mod pending;
mod progress;
mod scorm;
mod settings;
mod shape;
mod tiles;
mod usage;
mod view;

use args::Stop;
use cli::{Changes, Verb};
use lsystem::base::{say, word};
use lsystem::derive::Word;
use lsystem::syntax::visible;
use output::visible_lines;
use progress::DelayedBar;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

/// The reason why a command stops.
enum CommandFailure {
    /// An error whose message is already printed.
    Said,
    /// An error with a message, which may quote any characters of a file.
    Words(String),
    /// An exceeded limit, with the complete message.
    Limit(String),
    /// The reader of the output has closed the pipe. This is no error.
    ReaderGone,
}

impl CommandFailure {
    /// An error of the file system or a stream, about `what`.
    fn io(what: impl std::fmt::Display, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ReaderGone,
            _ => Self::Words(format!("{what}: {error}")),
        }
    }

    /// Prints the message, so that other work can continue. Returns [`Self::ReaderGone`] as an error, because nobody
    /// reads further results.
    fn tell(self) -> Result<(), Self> {
        match self {
            Self::Words(words) => {
                say(&format!("{}\n", say!("error: {}", visible(&words))));
                Ok(())
            }
            Self::Limit(message) => {
                say(&message);
                Ok(())
            }
            Self::Said => Ok(()),
            Self::ReaderGone => Err(self),
        }
    }
}

fn main() -> ExitCode {
    pending::fail_on_large_files();
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    language::choose(&arguments);
    let done = match args::parse(arguments) {
        Ok(verb) => run(verb),
        Err(Stop::Print(text)) => print(|out| out.write_all(text.as_bytes())),
        Err(Stop::Wrong(words)) => {
            say(&visible_lines(&words));
            return ExitCode::from(2);
        }
    };
    pending::remove_all();
    match done.map_err(CommandFailure::tell) {
        // The reader has closed the pipe, which is no failure.
        Ok(()) | Err(Err(_)) => ExitCode::SUCCESS,
        Err(Ok(())) => ExitCode::FAILURE,
    }
}

fn run(verb: Verb) -> Result<(), CommandFailure> {
    if verb.is_for_programs() {
        language::stay_english();
    }
    match verb {
        Verb::View { file, options, entry } => view::view(&file, &options, &Changes { entry, ..Changes::default() }),
        Verb::Link { file, page, changes } => link::link(&file, page.as_deref(), &changes),
        Verb::Shape { file } => shape::shape(&file),
        Verb::Expand { file, changes } => expand(&file, &changes),
        Verb::Draw { files, out_dir, look, changes } => {
            let jobs = args::jobs(&files, out_dir.as_deref(), &look).map_err(CommandFailure::Words)?;
            draw::draw(&jobs, out_dir.as_deref(), &look, &changes)
        }
        Verb::Tiles { file, dir, options, changes } => tiles::tiles(&file, &dir, &options, &changes),
        Verb::Animate { file, to, film, changes } => animate::animate(&file, &to, &film, &changes),
        Verb::Import { files, to: Some(to), .. } => import::import(&files, &to),
        Verb::Import { files, .. } => account::account(&files),
        Verb::Export { file: Some(file), notation: Some(notation), list: false, changes } => {
            export::export(&file, notation, &changes)
        }
        Verb::Export { .. } => export::list(),
        Verb::Check { file, output, changes } => check::check(&file, &output, &changes),
        Verb::Find { text, known, json } => find::find(&text, &known, json),
        Verb::Surprise { seed } => invent::print_surprise(seed),
        Verb::Breed { files, to, seed, count } => invent::breed_into(&files, seed, count, &to),
        Verb::Mark { exercise, answers, csv, html } => mark::mark(&exercise, &answers, csv, html.as_deref()),
        Verb::Exhibit { files, to, options } => exhibit::exhibit(&files, &to, &options),
        Verb::Scorm { exercises, to, options } => scorm::package(&exercises, &to, &options),
        Verb::Info { files, growth: Some(format), changes, .. } => growth::print_growth(&files, format, &changes),
        Verb::Info { files, json, growth: None, changes } => info::info(&files, json, &changes),
        Verb::Completions { shell } => {
            // The generator panics where it cannot write.
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut help::command(), "lsys", &mut script);
            print(|out| out.write_all(&script))
        }
    }
}

/// The number of symbols in a piece of a long string.
const PIECE: usize = 1 << 16;
/// The most symbols of a string that is derived as a whole, which is faster.
const WHOLE: u128 = 1 << 24;

fn expand(file: &Path, changes: &Changes) -> Result<(), CommandFailure> {
    let input = input::read(file, changes, &mut say)?;
    match input.system.word(input.iterations).filter(|word| word.symbols() > WHOLE) {
        Some(word) => print(|out| write_pieces(out, &word)),
        None => {
            let text = input.expand(1)?;
            print(|out| write_line(out, &text))
        }
    }
}

/// Writes a long string piece by piece, and a newline.
fn write_pieces(out: &mut dyn Write, word: &Word<'_>) -> io::Result<()> {
    // On a terminal the string itself shows the progress.
    let mut progress =
        (!io::stdout().is_terminal()).then(|| DelayedBar::new(word!("symbols"), word.symbols().try_into().ok()));
    let mut start = 0_u128;
    loop {
        let piece = word.slice(start, PIECE);
        if piece.is_empty() {
            return out.write_all(b"\n");
        }
        out.write_all(piece.as_bytes())?;
        start += PIECE as u128;
        progress.iter_mut().for_each(|progress| progress.at(u64::try_from(start).unwrap_or(u64::MAX)));
    }
}

/// Writes a derived string and a newline.
fn write_line(out: &mut dyn Write, text: &str) -> io::Result<()> {
    out.write_all(text.as_bytes())?;
    out.write_all(b"\n")
}

/// Writes to standard output.
fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), CommandFailure> {
    output::print(write).map_err(|error| CommandFailure::io(say!("standard output"), &error))
}

/// Writes to standard error. A failure to write is ignored, because no other stream is left for messages.
fn say(text: &str) {
    let _ = progress::beside_bars(|| io::stderr().write_all(text.as_bytes()));
}
