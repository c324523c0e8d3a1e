//! `lsys draw`: pictures, tables of segments and strings, to files or to standard output.

use crate::args::{Changes, Format, Job, Target};
use crate::input::{self, Input};
use crate::output::{Pending, with_extension};
use crate::progress::Progress;
use crate::{Failure, print};
use lsystem::{SvgOptions, write_csv, write_svg};

/// Does all `jobs`. One that fails is reported, and the others are still done.
pub(crate) fn draw(jobs: &[Job], changes: Changes) -> Result<(), Failure> {
    let mut progress = Progress::new("files", jobs.len() as u64);
    let mut failed = false;
    for (i, job) in jobs.iter().enumerate() {
        progress.at(i as u64);
        if let Err(failure) = one(job, changes) {
            failed = true;
            failure.tell()?;
        }
    }
    if failed { Err(Failure::Said) } else { Ok(()) }
}

fn one(job: &Job, changes: Changes) -> Result<(), Failure> {
    let input = input::read(&job.file, changes)?;
    match &job.target {
        Target::Print(format) => {
            let text = form(&input, *format)?;
            print(|out| out.write_all(text.as_bytes()))
        }
        Target::Write(base, formats) => {
            // All files are complete before the first gets its name.
            let mut pending = Vec::new();
            for &format in formats {
                let text = form(&input, format)?;
                let path = with_extension(base, format.extension());
                let file = Pending::write(&path, |out| out.write_all(text.as_bytes()));
                pending.push(file.map_err(|error| Failure::io(path.display(), &error))?);
            }
            (pending.into_iter())
                .try_for_each(|file| file.commit().map_err(|error| Failure::io(base.display(), &error)))
        }
    }
}

/// The text of a format.
fn form(input: &Input, format: Format) -> Result<String, Failure> {
    if format == Format::Txt {
        return Ok(input.expand()? + "\n");
    }
    let drawing = lsystem::draw(&input.system, input.iterations, &input.limits).map_err(|limit| input.limit(&limit))?;
    let text = match format {
        Format::Csv => write_csv(&drawing, input.limits.segments),
        _ => {
            let title = [&input.definition.title, &input.definition.name].into_iter().find(|title| !title.is_empty());
            let options = SvgOptions {
                title: title.cloned().unwrap_or_default(),
                most: input.limits.segments,
                ..SvgOptions::default()
            };
            write_svg(&drawing, &input.system.style, &options)
        }
    };
    text.map_err(|limit| input.limit(&limit))
}
