//! `lsys draw`: pictures, tables of segments and strings, to files or to standard output.

use crate::args::{Destination, Job};
use crate::cli::{Changes, Look};
use crate::cores::{Say, SharedLimits};
use crate::input::{self, InputSystem};
use crate::pending::{Pending, with_extension};
use crate::{CommandFailure, cores, picture, print};
use lsystem::drawing::{Outlook, why_empty};
use lsystem::files::{Content, FileOptions, Format, PngWriter, write_all};
use lsystem::syntax::visible;
use lsystem::{Figure, write_json};
use std::io::{self, IsTerminal, Write};
use std::path::Path;

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
        Destination::Print(format) => limits.make(|shares| {
            let contents = contents(&input, format, look, shares, say)?;
            print(|out| contents.write(out))
        }),
        Destination::Write(base, formats) => {
            // All files are complete before the first one gets its name.
            let mut pending = Vec::new();
            for &format in formats {
                let path = with_extension(base, format.ending);
                let file = limits.make(|shares| {
                    let contents = contents(&input, format, look, shares, say)?;
                    Pending::write(&path, |out| contents.write(out))
                        .map_err(|error| CommandFailure::io(path.display(), &error))
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

/// The contents of a file.
enum Contents {
    Bytes(Vec<u8>),
    /// A picture, which is painted while it is written.
    Picture(Box<PngWriter>),
}

impl Contents {
    fn write(self, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Bytes(bytes) => out.write_all(&bytes),
            Self::Picture(picture) => picture::write(*picture, out),
        }
    }
}

/// The contents of a file of the system, made within one of `shares` equal shares of the limits.
fn contents(
    input: &InputSystem,
    format: &Format,
    look: &Look,
    shares: u64,
    say: Say<'_>,
) -> Result<Contents, CommandFailure> {
    let system = &input.system;
    let style = &system.style;
    let wrong = |limit| input.limit(&limit);
    let limits = input.limits(shares);
    // The direction of view is the page's first one.
    let figure = || input.draw(shares).map_err(wrong);
    let paper = || figure()?.seen_from(&Outlook::default(), limits.segments).map_err(wrong);
    let name = input.definition.label();
    let choices = look.flags.options();
    let bare = choices.bare;
    let stored = || if bare { String::new() } else { write_json(&input.definition) };
    let options = || {
        let (title, system) = (name.to_owned(), stored());
        FileOptions { title, system, most: limits.segments, ..choices.clone() }
    };
    let mut writer = match format.content {
        Content::System => return Ok(Contents::Bytes(write_json(&input.definition).into_bytes())),
        Content::String => return Ok(Contents::Bytes((input.expand(shares)? + "\n").into_bytes())),
        Content::Pixels => {
            return picture::png(&figure()?, style, &choices, stored())
                .map(|picture| Contents::Picture(Box::new(picture)))
                .map_err(wrong);
        }
        Content::Mesh(write) => {
            let options = FileOptions { most: MESH_SEGMENTS / shares, memory: limits.memory, ..options() };
            let Figure::Space(drawing) = input.draw_in_space(shares).map_err(wrong)? else {
                return Ok(Contents::Bytes(Vec::new()));
            };
            write(drawing, style.clone(), &options).map_err(wrong)?
        }
        Content::Segments { plane, space } => match figure()? {
            Figure::Plane(drawing) => plane(drawing, limits.segments).map_err(wrong)?,
            Figure::Space(drawing) => space(drawing, limits.segments).map_err(wrong)?,
        },
        Content::Words(write) => write(&input.definition, system, &options()).map_err(wrong)?,
        Content::Paper(write) => write(paper()?, style.clone(), &options()).map_err(wrong)?,
    };
    let file = write_all(&mut *writer).map_err(wrong)?;
    writer.remark().iter().for_each(|remark| say(&input.message(remark)));
    let name = || visible(&input.file.display().to_string());
    writer.summary().iter().for_each(|summary| say(&format!("{}: {summary}\n", name())));
    Ok(Contents::Bytes(file))
}
