//! `lsys draw`: pictures, tables of segments and strings, to files or to standard output.

use crate::args::{Job, Target};
use crate::cli::{Changes, Format, Look};
use crate::cores::{Room, Say};
use crate::input::{self, Input};
use crate::pending::{Pending, with_extension};
use crate::{Failure, cores, picture, print};
use lsystem::drawing::Outlook;
use lsystem::files::SvgForm;
use lsystem::{Drawing, Mesh, Solid, SvgOptions, write_csv, write_glb, write_json, write_obj, write_svg};
use std::io::IsTerminal;

/// Does all `jobs`. One that fails is reported, and the others are still done.
pub(crate) fn draw(jobs: &[Job], look: Look, changes: &Changes) -> Result<(), Failure> {
    match cores::in_order(jobs, |job, room, say| one(job, look, changes, room, say))? {
        (_, true) => Ok(()),
        (_, false) => Err(Failure::Said),
    }
}

fn one(job: &Job, look: Look, changes: &Changes, room: &Room, say: Say<'_>) -> Result<(), Failure> {
    let input = input::read(&job.file, changes, say)?;
    match &job.target {
        Target::Print(Format::Png | Format::Glb) if std::io::stdout().is_terminal() => {
            Err(Failure::Words("a terminal cannot show this: name an OUT_BASE".to_owned()))
        }
        Target::Print(format) => room.make(|shares| {
            let bytes = form(&input, *format, look, shares, say)?;
            print(|out| out.write_all(&bytes))
        }),
        Target::Write(base, formats) => {
            // All files are complete before the first gets its name.
            let mut pending = Vec::new();
            for &format in formats {
                let path = with_extension(base, format.extension());
                let file = room.make(|shares| {
                    let bytes = form(&input, format, look, shares, say)?;
                    Pending::write(&path, |out| out.write_all(&bytes))
                        .map_err(|error| Failure::io(path.display(), &error))
                })?;
                pending.push(file);
            }
            (pending.into_iter())
                .try_for_each(|file| file.commit().map_err(|error| Failure::io(base.display(), &error)))
        }
    }
}

/// Tubes in a mesh at most: some hundred megabytes, and more than most programs open.
const MESH_SEGMENTS: u64 = 500_000;

/// The system in a format, as a file's bytes, made within one of so many `shares` of the limits.
fn form(input: &Input, format: Format, look: Look, shares: u64, say: Say<'_>) -> Result<Vec<u8>, Failure> {
    let Look { size, compact, .. } = look;
    let system = &input.system;
    let style = &system.style;
    let wrong = |limit| input.limit(&limit);
    let limits = input.limits(shares);
    let solid = || input.draw_solid(shares).map_err(wrong);
    // What is in space is seen from where the page would look at it first.
    let drawing = || match system.is_solid() {
        true => solid()?.seen_from(&Outlook::default(), limits.segments).map_err(wrong),
        false => input.draw(shares).map_err(wrong),
    };
    let mesh = |drawing: &Drawing<Solid>| Mesh::new(drawing, style, MESH_SEGMENTS / shares).map_err(wrong);
    let name = input.definition.label();
    match format {
        // All pixels of a picture in space are in memory at once.
        Format::Png if shares > 1 && system.is_solid() && size.is_some_and(picture::is_large) => {
            Err(Failure::Limit(String::new()))
        }
        Format::Png => {
            let definition = write_json(&input.definition);
            let picture = match system.is_solid() {
                true => picture::solid_png(solid()?, style, size, &definition),
                false => picture::png(drawing()?, style, size, &definition),
            };
            picture.map_err(|error| Failure::Words(format!("PNG: {error}")))
        }
        Format::Obj => Ok(write_obj(&mesh(&solid()?)?, name).into_bytes()),
        Format::Glb => Ok(write_glb(&mesh(&solid()?)?, name)),
        Format::Csv => {
            let table = match system.is_solid() {
                true => write_csv(&solid()?, limits.segments),
                false => write_csv(&drawing()?, limits.segments),
            };
            table.map(String::into_bytes).map_err(wrong)
        }
        Format::Svg => {
            let options = SvgOptions {
                title: name.to_owned(),
                system: write_json(&input.definition),
                form: if compact { SvgForm::Compact } else { SvgForm::Flat },
                most: limits.segments,
                ..SvgOptions::default()
            };
            let svg = write_svg(&drawing()?, style, &options).map_err(wrong)?;
            svg.warning().iter().for_each(|warning| say(&input.message(warning)));
            Ok(svg.text.into_bytes())
        }
        Format::Txt => Ok((input.expand(shares)? + "\n").into_bytes()),
    }
}
