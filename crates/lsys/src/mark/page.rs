//! Marks as a page of HTML that needs no other file.

use super::title_of;
use crate::language;
use base64::prelude::*;
use lsystem::base::words::said;
use lsystem::base::{say, word};
use lsystem::course::{Exercise, Marked, SMALL, mistakes};

/// The mistakes that are listed.
const MAX_MISTAKES: usize = 8;
/// White, agreeing ink, missing ink, ink that is too much: colours that the colour-blind can distinguish.
const PALETTE: [u8; 12] = [255, 255, 255, 190, 190, 190, 0, 90, 181, 220, 80, 0];
const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:70rem;padding:0 1rem;color:#222;\
background:#fff}table{border-collapse:collapse;width:100%}th,td{text-align:left;vertical-align:top;padding:.5rem;\
border-bottom:1px solid #ddd}td.number{text-align:right}img{width:96px;height:96px;border:1px solid #eee}\
pre{margin:0;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.85rem}.yes{color:#0a6b2d;font-weight:600}\
i.both,i.missing,i.much{display:inline-block;width:.8em;height:.8em;margin:0 .3em 0 1em}i.both{background:#bebebe}\
i.missing{background:#005ab5}i.much{background:#dc5000}";

/// A page with all marks.
pub(super) fn page(exercise: &Exercise, marked: &[Marked], pictures: &[Vec<u8>]) -> String {
    let title = escaped(&title_of(exercise));
    let solved = marked.iter().filter(|one| one.is_solved()).count();
    let rows: String = marked.iter().zip(pictures).map(|(one, picture)| row(one, picture)).collect();
    let heads = [
        word!("Name"),
        word!("By"),
        word!("Solved"),
        word!("Agrees"),
        word!("Symbols"),
        word!("Picture"),
        word!("Rules"),
        word!("Remark"),
    ];
    let heads: String = heads.iter().map(|head| format!("<th>{}", escaped(&said(head)))).collect();
    format!(
        "<!doctype html>\n<html lang=\"{}\">\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n<style>{STYLE}</style>\n\
         <h1>{title}</h1>\n<p>{}</p>\n<p>{} {}\
         <i class=\"both\"></i>{}<i class=\"missing\"></i>{}<i class=\"much\"></i>{}</p>\n\
         {}<table>\n<tr>{heads}</tr>\n{rows}</table>\n</html>\n",
        language::code(),
        escaped(&exercise.task),
        escaped(&say!("{} of {} solved.", solved, marked.len())),
        escaped(&say!("In the pictures:")),
        escaped(&say!("agrees")),
        escaped(&say!("is missing")),
        escaped(&say!("is too much")),
        frequent(marked),
    )
}

/// The most frequent mistakes, if any mistake was made twice.
fn frequent(marked: &[Marked]) -> String {
    let frequent = mistakes(marked).into_iter().filter(|mistake| mistake.answers.len() > 1).take(MAX_MISTAKES);
    let row = |mistake: lsystem::course::Mistake| {
        let example = mistake.answers.first().and_then(|number| marked.get(*number)).map_or("", |one| &one.answer.name);
        let (count, words) = (mistake.answers.len(), escaped(&mistake.words));
        let count = escaped(&say!("{} of {}", count, marked.len()));
        format!("<li>{count}: {words} <small>({}, …)</small>\n", escaped(example))
    };
    let rows: String = frequent.map(row).collect();
    if rows.is_empty() {
        rows
    } else {
        format!("<h2>{}</h2>\n<ul>\n{rows}</ul>\n", escaped(&say!("Frequent mistakes")))
    }
}

fn row(one: &Marked, picture: &[u8]) -> String {
    let name = escaped(&one.answer.name);
    let is_web = |link: &&str| link.starts_with("https:") || link.starts_with("http:");
    let name = match one.answer.link().filter(is_web) {
        Some(link) => format!("<a href=\"{}\" rel=\"noreferrer\">{name}</a>", escaped(link)),
        None => name,
    };
    let solved = match one.is_solved() {
        true => format!("<td class=\"yes\">{}", escaped(&say!("yes"))),
        false => format!("<td>{}", escaped(&say!("no"))),
    };
    let percent = one.percent();
    let picture = match picture.is_empty() {
        true => String::new(),
        false => format!("<img alt=\"\" src=\"data:image/png;base64,{}\">", BASE64_STANDARD.encode(picture)),
    };
    format!(
        "<tr><td>{name}<td>{}{solved}<td class=\"number\">{percent}<td class=\"number\">{}<td>{picture}<td><pre>{}</pre><td>{}</tr>\n",
        escaped(&one.answer.by),
        one.symbols(),
        escaped(&one.rules),
        escaped(&one.words()),
    )
}

/// A text for HTML.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Differences from [`ClassMarker::picture`](lsystem::course::ClassMarker::picture) as a PNG.
pub(super) fn picture(pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SMALL as u32, SMALL as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(PALETTE.as_slice());
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(pixels));
    if written.is_ok() { bytes } else { Vec::new() }
}
