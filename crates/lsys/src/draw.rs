//! `lsys draw`: pictures, tables of segments and strings, to files or to standard output.

use crate::args::{Destination, Job};
use crate::cli::{Changes, Look};
use crate::cores::{Say, SharedLimits};
use crate::input::{self, InputSystem};
use crate::output::within;
use crate::pending::{Pending, with_extension};
use crate::progress::DelayedBar;
use crate::{CommandFailure, cores, memory, print};
use lsystem::base::{say, word};
use lsystem::drawing::why_empty;
use lsystem::files::{FileLimits, FileOptions, FileTask, FileView, Format, Owner, PngOptions, Sink, make};
use lsystem::render::BAND_PIXEL;
use lsystem::syntax::{Halt, visible};
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// Does all `jobs`; their `folder` is made if it is missing. A failed job is reported, and the others are still done.
pub(crate) fn draw(jobs: &[Job], folder: Option<&Path>, look: &Look, changes: &Changes) -> Result<(), CommandFailure> {
    if let Some(folder) = folder {
        std::fs::create_dir_all(folder).map_err(|error| CommandFailure::io(folder.display(), &error))?;
    }
    // No output of a job replaces the file of a later one.
    jobs.iter().for_each(|job| input::keep(&job.file));
    match cores::in_order(jobs, |job, limits, say| draw_one(job, look, changes, limits, say))? {
        (_, true) => Ok(()),
        (_, false) => Err(CommandFailure::Said),
    }
}

/// Does one job.
fn draw_one(
    job: &Job,
    look: &Look,
    changes: &Changes,
    limits: &SharedLimits,
    say: Say<'_>,
) -> Result<(), CommandFailure> {
    let input = input::read(&job.file, changes, say)?;
    let formats = match &job.target {
        Destination::Print(format) => core::slice::from_ref(format),
        Destination::Write(_, formats) => formats,
    };
    if formats.iter().any(|format| format.shows_drawing())
        && let Some(reason) = why_empty(&input.system, input.iterations)
    {
        let warning = say!("warning: {}", reason);
        say(&format!("{warning}\n --> {}\n", visible(&input.file.display().to_string())));
    }
    match &job.target {
        Destination::Print(format) if format.is_binary && io::stdout().is_terminal() => {
            Err(CommandFailure::Words(say!("a terminal cannot show this format: give an OUT_BASE")))
        }
        Destination::Print(format) => {
            let wrong = |error: io::Error| CommandFailure::io(say!("standard output"), &error);
            limits.make(|shares| {
                let write = |out: &mut dyn Write| {
                    write_file(&input, format, (&look.flags.options(), look.view()), shares, say, out, &wrong)
                };
                within(|write| print(|out| write(out)), write)
            })
        }
        Destination::Write(base, formats) => {
            // All files are complete before the first one gets its name.
            let mut pending = Vec::new();
            for &format in formats {
                let path = with_extension(base, format.ending);
                let wrong = |error: io::Error| CommandFailure::io(path.display(), &error);
                let file = limits.make(|shares| {
                    let write = |out: &mut dyn Write| {
                        write_file(&input, format, (&look.flags.options(), look.view()), shares, say, out, &wrong)
                    };
                    within(|write| Pending::write(&path, |out| write(out)).map_err(wrong), write)
                })?;
                pending.push(file);
            }
            (pending.into_iter())
                .try_for_each(|file| file.commit().map_err(|error| CommandFailure::io(base.display(), &error)))
        }
    }
}

/// A picture of pixels, within one of `shares` equal shares of the limits.
///
/// # Errors
/// The limit that the drawing exceeds.
pub(crate) fn picture(
    input: &InputSystem,
    size: [u32; 2],
    shares: u64,
    say: Say<'_>,
) -> Result<Vec<u8>, CommandFailure> {
    let Some(png) = Format::named("png") else { return Ok(Vec::new()) };
    let (options, mut bytes) = (FileOptions { size: Some(size), ..FileOptions::default() }, Vec::new());
    let wrong = |error: io::Error| CommandFailure::io("memory", &error);
    write_file(input, png, (&options, FileView::default()), shares, say, &mut bytes, &wrong)?;
    Ok(bytes)
}

/// The most segments of a mesh: some hundred megabytes, and more than most programs open.
const MESH_SEGMENTS: u64 = 500_000;

/// The size of a picture that suits its drawing, at most.
const USUAL_SIZE: [u32; 2] = [2048; 2];
/// The bytes of memory for painting, beside the pixels.
const PAINTING: u64 = 4 << 20;

/// The owner of a file: the stream to which it is written.
struct Stream<'a> {
    out: &'a mut dyn Write,
    /// The error of the stream.
    error: Option<io::Error>,
    /// The progress of a picture of pixels.
    bar: Option<DelayedBar>,
}

impl Owner for Stream<'_> {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.out.write_all(bytes).map_err(|error| {
            self.error = Some(error);
            Halt::Stopped
        })
    }

    fn rows(&mut self, done: u32, all: u32) {
        self.bar.get_or_insert_with(|| DelayedBar::new(word!("picture"), Some(all.into()))).at(done.into());
    }
}

/// Writes a file of the system to a stream, within one of `shares` equal shares of the limits. `wrong` is the failure for
/// an error of the stream.
fn write_file(
    input: &InputSystem,
    format: &'static Format,
    (options, view): (&FileOptions, FileView),
    shares: u64,
    say: Say<'_>,
    out: &mut dyn Write,
    wrong: &dyn Fn(io::Error) -> CommandFailure,
) -> Result<(), CommandFailure> {
    if format.name == "png" {
        let pixels = options.size.unwrap_or(USUAL_SIZE).map(u64::from).iter().product::<u64>();
        memory::check(PAINTING + pixels.min(PngOptions::default().band.into()) * BAND_PIXEL)?;
    }
    let mut stream = Stream { out, error: None, bar: None };
    let limits = input.limits(shares);
    let task = FileTask {
        definition: &input.definition,
        system: &input.system,
        format,
        options,
        view,
        limits: FileLimits {
            drawing: input.drawing_limits(),
            drawing_bytes: limits.memory,
            string: limits,
            remembers: false,
            segments: limits.segments,
            held: limits.segments,
            mesh: [MESH_SEGMENTS / shares, limits.memory],
            band: PngOptions::default().band,
        },
    };
    let notes = Sink::to(&mut stream, |sink| make(&task, sink)).map_err(|halt| match halt {
        Halt::Limit(limit) => input.limit(&limit),
        Halt::Stopped => wrong(stream.error.take().unwrap_or_else(|| io::ErrorKind::Other.into())),
    })?;
    notes.remark.iter().for_each(|remark| say(&input.message(remark)));
    let name = || visible(&input.file.display().to_string());
    notes.summary.iter().for_each(|summary| say(&format!("{}: {summary}\n", name())));
    Ok(())
}
