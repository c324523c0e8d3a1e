//! `lsys draw`: pictures, tables of segments and strings, to files or to standard output.

use crate::args::{Destination, Job};
use crate::cli::{Changes, Look};
use crate::cores::{Say, SharedLimits};
use crate::input::{self, InputSystem};
use crate::output::within;
use crate::pending::{Pending, with_extension};
use crate::progress::DelayedBar;
use crate::{CommandFailure, cores, picture, print};
use lsystem::drawing::{Outlook, why_empty};
use lsystem::files::{Content, FileOptions, Format, Notes, Owner, Sink, write_png, write_solid_png};
use lsystem::syntax::{Halt, visible};
use lsystem::{Camera, View, write_json};
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;

/// Does all `jobs`; their `folder` is made if it is missing. A failed job is reported, and the others are still done.
pub(crate) fn draw(jobs: &[Job], folder: Option<&Path>, look: &Look, changes: &Changes) -> Result<(), CommandFailure> {
    if let Some(folder) = folder {
        std::fs::create_dir_all(folder).map_err(|error| CommandFailure::io(folder.display(), &error))?;
    }
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
    if formats.iter().any(|format| !matches!(format.content, Content::System | Content::String | Content::Words(_)))
        && let Some(reason) = why_empty(&input.system, input.iterations)
    {
        say(&format!("warning: {reason}\n --> {}\n", visible(&input.file.display().to_string())));
    }
    match &job.target {
        Destination::Print(format)
            if matches!(format.name, "png" | "glb" | "pdf" | "stl") && io::stdout().is_terminal() =>
        {
            Err(CommandFailure::Words("a terminal cannot show this format: give an OUT_BASE".to_owned()))
        }
        Destination::Print(format) => {
            let wrong = |error: io::Error| CommandFailure::io("standard output", &error);
            limits.make(|shares| {
                let write = |out: &mut dyn Write| write_file(&input, format, look, shares, say, out, &wrong);
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
                    let write = |out: &mut dyn Write| write_file(&input, format, look, shares, say, out, &wrong);
                    within(|write| Pending::write(&path, |out| write(out)).map_err(wrong), write)
                })?;
                pending.push(file);
            }
            (pending.into_iter())
                .try_for_each(|file| file.commit().map_err(|error| CommandFailure::io(base.display(), &error)))
        }
    }
}

/// The most segments of a mesh: some hundred megabytes, and more than most programs open.
const MESH_SEGMENTS: u64 = 500_000;

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
        self.bar.get_or_insert_with(|| DelayedBar::new("picture", Some(all.into()))).at(done.into());
    }
}

/// Writes a file of the system to a stream, within one of `shares` equal shares of the limits. `wrong` is the failure for
/// an error of the stream.
fn write_file(
    input: &InputSystem,
    format: &Format,
    look: &Look,
    shares: u64,
    say: Say<'_>,
    out: &mut dyn Write,
    wrong: &dyn Fn(io::Error) -> CommandFailure,
) -> Result<(), CommandFailure> {
    let mut stream = Stream { out, error: None, bar: None };
    let notes = Sink::to(&mut stream, |sink| write(input, format, look, shares, sink)).map_err(|halt| match halt {
        Halt::Limit(limit) => input.limit(&limit),
        Halt::Stopped => wrong(stream.error.take().unwrap_or_else(|| io::ErrorKind::Other.into())),
    })?;
    notes.remark.iter().for_each(|remark| say(&input.message(remark)));
    let name = || visible(&input.file.display().to_string());
    notes.summary.iter().for_each(|summary| say(&format!("{}: {summary}\n", name())));
    Ok(())
}

fn write(input: &InputSystem, format: &Format, look: &Look, shares: u64, sink: &mut Sink<'_>) -> Result<Notes, Halt> {
    let (system, limits) = (&input.system, input.limits(shares));
    let style = &system.style;
    let choices = look.flags.options();
    let stored = if choices.bare { String::new() } else { write_json(&input.definition) };
    let title = input.definition.label().to_owned();
    let options = FileOptions { title, system: stored, most: limits.segments, ..choices };
    let none = |()| Notes::default();
    match format.content {
        Content::System => {
            sink.text.push_str(&write_json(&input.definition));
            Ok(Notes::default())
        }
        Content::String => {
            sink.bytes(lsystem::expand(system, input.iterations, &limits)?.as_bytes())?;
            sink.bytes(b"\n").map(none)
        }
        Content::Words(write) => write(&input.definition, system, &options, sink),
        Content::Pixels if system.is_solid() => {
            let drawing = Arc::new(input.draw_solid(shares)?);
            let options = picture::png_options(picture::SOLID_SIZE, options);
            write_solid_png(drawing, style, Camera::default(), &options, sink).map(none)
        }
        Content::Pixels => {
            let drawing = Arc::new(input.draw(shares)?);
            let options = picture::png_options(picture::usual_size(&drawing), options);
            write_png(drawing, style, View::default(), &options, sink).map(none)
        }
        Content::Mesh(write) => {
            let options = FileOptions { most: MESH_SEGMENTS / shares, memory: limits.memory, ..options };
            write(Arc::new(input.draw_solid(shares)?), style, &options, sink)
        }
        Content::Segments { space, .. } if system.is_solid() => {
            space(&input.draw_solid(shares)?, limits.segments, sink).map(none)
        }
        Content::Segments { plane, .. } => plane(&input.draw(shares)?, limits.segments, sink).map(none),
        Content::Paper(write) => {
            // The direction of view is the page's first one.
            let drawing = match system.is_solid() {
                true => input.draw_solid(shares)?.seen_from(&Outlook::default(), limits.segments)?,
                false => input.draw(shares)?,
            };
            write(Arc::new(drawing), style, &options, sink)
        }
    }
}
