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

use args::Command;
use cli::Changes;
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
    let command = match args::parse(arguments) {
        Ok(command) => command,
        Err(words) => {
            say(&visible_lines(&words));
            return ExitCode::from(2);
        }
    };
    if command.is_for_programs() {
        language::stay_english();
    }
    let done = run(command);
    pending::remove_all();
    match done.map_err(CommandFailure::tell) {
        // The reader has closed the pipe, which is no failure.
        Ok(()) | Err(Err(_)) => ExitCode::SUCCESS,
        Err(Ok(())) => ExitCode::FAILURE,
    }
}

fn run(command: Command) -> Result<(), CommandFailure> {
    match command {
        Command::Print(text) => print(|out| out.write_all(text.as_bytes())),
        Command::View { file, options, changes } => view::view(&file, &options, &changes),
        Command::Link { file, page, changes } => link::link(&file, page.as_deref(), &changes),
        Command::Shape { file } => shape::shape(&file),
        Command::Expand { file, changes } => expand(&file, &changes),
        Command::Draw { jobs, folder, look, changes } => draw::draw(&jobs, folder.as_deref(), &look, &changes),
        Command::Tiles { file, dir, options, changes } => tiles::tiles(&file, &dir, &options, &changes),
        Command::Animate { file, to, film, changes } => animate::animate(&file, &to, &film, &changes),
        Command::Import { files, to } => import::import(&files, &to),
        Command::Account { files } => account::account(&files),
        Command::Export { file, notation, changes } => export::export(&file, notation, &changes),
        Command::Check { file, output, changes } => check::check(&file, &output, &changes),
        Command::Find { text, known, json } => find::find(&text, &known, json),
        Command::Surprise { seed } => invent::print_surprise(seed),
        Command::Breed { files, to, seed, count } => invent::breed_into(&files, seed, count, &to),
        Command::Mark { exercise, answers, csv, html } => mark::mark(&exercise, &answers, csv, html.as_deref()),
        Command::Exhibit { files, to, options } => exhibit::exhibit(&files, &to, &options),
        Command::Scorm { exercises, to, options } => scorm::package(&exercises, &to, &options),
        Command::Info { files, growth: Some(format), changes, .. } => growth::print_growth(&files, format, &changes),
        Command::Info { files, json, growth: None, changes } => info::info(&files, json, &changes),
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
