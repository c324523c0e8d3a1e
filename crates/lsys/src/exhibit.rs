//! `lsys exhibit`: drawings as one page of HTML that needs no other file.

use crate::cli::{Changes, ExhibitOptions};
use crate::language;
use crate::mark::escaped;
use crate::pending::Pending;
use crate::{CommandFailure, cores, draw, input, print};
use base64::prelude::*;
use lsystem::base::{counted, say};
use lsystem::files::write_link;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The size of a picture, in pixels.
const SIZE: [u32; 2] = [960, 960];
const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;margin:0;padding:2rem;color:#222;background:#f6f4ee}\
h1{font-weight:500;text-align:center}main{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(20rem,100%),1fr));\
gap:2rem;max-width:90rem;margin:auto}figure{margin:0;background:#fff;padding:1rem;box-shadow:0 1px 4px #0003}\
img{display:block;width:100%;aspect-ratio:1;object-fit:contain}figcaption{padding-top:.6rem;text-align:center}a{color:inherit}\
@media print{body{background:#fff;padding:0}figure{box-shadow:none;break-inside:avoid}}";

/// A drawing of the exhibition.
struct Exhibit {
    /// The file's name without its ending.
    stem: String,
    /// The title in the file, or else the file's name.
    title: String,
    link: String,
    picture: Vec<u8>,
}

/// Writes a page with the drawings of all `files`, or of the files in folders. A file that cannot be drawn is reported and
/// left out.
///
/// # Errors
/// [`CommandFailure::Words`] if a folder or the votes cannot be read, or the page cannot be written.
pub(crate) fn exhibit(files: &[PathBuf], to: &Path, options: &ExhibitOptions) -> Result<(), CommandFailure> {
    let votes = options.votes.as_deref().map(votes_in).transpose()?;
    let files = all_files(files, to)?;
    let draw_one = |file: &PathBuf, limits: &cores::SharedLimits, say: cores::Say<'_>| {
        let input = input::read(file, &Changes::default(), say)?;
        let picture = limits.make(|shares| draw::picture(&input, SIZE, shares, say))?;
        let stem = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let own = &input.definition;
        let title = [&own.title, &own.name, &stem].into_iter().find(|text| !text.is_empty()).cloned();
        Ok(Exhibit { title: title.unwrap_or_default(), stem, link: write_link(own), picture })
    };
    let (mut exhibits, is_whole) = cores::in_order(&files, draw_one)?;
    if exhibits.is_empty() {
        return Err(CommandFailure::Said);
    }
    if let Some(votes) = &votes {
        exhibits.sort_by_key(|exhibit| core::cmp::Reverse(votes.get(&exhibit.stem).copied().unwrap_or_default()));
    }
    if let Some(seed) = options.seed {
        exhibits.sort_by_cached_key(|exhibit| shuffled(seed, &exhibit.stem));
    }
    let page = page(&exhibits, options, votes.as_ref());
    let file = Pending::write(to, |out| out.write_all(page.as_bytes())).and_then(Pending::commit);
    file.map_err(|error| CommandFailure::io(to.display(), &error))?;
    print(|out| writeln!(out, "{}: {}", to.display(), say!("{} of {} drawings", exhibits.len(), files.len())))?;
    if is_whole { Ok(()) } else { Err(CommandFailure::Said) }
}

/// The files, with those in folders in the order of their names, but for the page of an earlier run.
fn all_files(words: &[PathBuf], page: &Path) -> Result<Vec<PathBuf>, CommandFailure> {
    let page = page.canonicalize().ok();
    let mut all = Vec::new();
    for word in words {
        if !word.is_dir() {
            all.push(word.clone());
            continue;
        }
        let failed = |error: std::io::Error| CommandFailure::io(word.display(), &error);
        let entries = std::fs::read_dir(word).map_err(failed)?;
        let mut inside = entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>, _>>().map_err(failed)?;
        inside.retain(|path| path.is_file() && (page.is_none() || path.canonicalize().ok() != page));
        inside.sort();
        all.extend(inside);
    }
    match all.is_empty() {
        true => Err(CommandFailure::Words(say!("there is no file to exhibit"))),
        false => Ok(all),
    }
}

/// The votes by file name without ending, from lines such as `koch,12`. Lines without a number are left out.
fn votes_in(file: &Path) -> Result<HashMap<String, u64>, CommandFailure> {
    let text = input::text_of(file)?;
    let vote = |line: &str| {
        let (name, count) = line.rsplit_once([',', ';', '\t'])?;
        let name = Path::new(name.trim().trim_matches('"')).file_stem()?.to_string_lossy().into_owned();
        Some((name, count.trim().parse().ok()?))
    };
    let votes: HashMap<String, u64> = text.lines().filter_map(vote).collect();
    if votes.is_empty() {
        let words = say!("{}: no votes: write lines such as koch,12", file.display());
        return Err(CommandFailure::Words(words));
    }
    Ok(votes)
}

/// A number that orders names by chance, the same for the same seed.
fn shuffled(seed: u32, name: &str) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325 ^ u64::from(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let hash = name.bytes().fold(start, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    (hash ^ hash >> 31).wrapping_mul(0x94d0_49bb_1331_11eb)
}

fn page(exhibits: &[Exhibit], options: &ExhibitOptions, votes: Option<&HashMap<String, u64>>) -> String {
    let exhibition = say!("Exhibition");
    let title = escaped(if options.title.is_empty() { &exhibition } else { &options.title });
    let figures: String = (1..)
        .zip(exhibits)
        .map(|(number, exhibit)| {
            let name = if options.names { exhibit.title.clone() } else { format!("{number}") };
            let count = votes.and_then(|votes| votes.get(&exhibit.stem)).map_or_else(String::new, |count| {
                format!(", {}", counted!(*count, "{} vote", "{} votes"))
            });
            let name = escaped(&name);
            let caption = match &options.page {
                Some(page) => format!("<a href=\"{}{}\">{name}</a>", escaped(page), escaped(&exhibit.link)),
                None => name.clone(),
            };
            format!(
                "<figure><img alt=\"{name}\" loading=\"lazy\" src=\"data:image/png;base64,{}\"><figcaption>{caption}{count}</figcaption></figure>\n",
                BASE64_STANDARD.encode(&exhibit.picture)
            )
        })
        .collect();
    format!(
        "<!doctype html>\n<html lang=\"{}\">\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n<style>{STYLE}</style>\n\
         <h1>{title}</h1>\n<main>\n{figures}</main>\n</html>\n",
        language::code()
    )
}
