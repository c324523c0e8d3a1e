//! SVG pictures of other programs: right ones, and damaged ones.

use crate::{Gauge, Source, make};
use lsystem::find::draw_svg;

/// The most units of a picture.
const MAX_WORK: u64 = 500_000_000;

const WHOLE: [&str; 10] = [
    "<svg viewBox='0 0 90 60'><path fill='none' stroke='#000' d='M10 50L20 10c5 5 9-9 20 0s9 9 20 0q5 9 9 0t9 9a9 5 30 1 0 3 3z'/></svg>",
    "<svg width='9cm' height='90pt'><g transform='rotate(30 5 5) scale(2)' stroke-width='3' stroke='red'><line x1='1' x2='90%' y2='40'/></g></svg>",
    "<svg><style>.a{fill:none;stroke:black} #b,rect.a{stroke-width:9px} *{stroke-linejoin:round}</style><rect class='a' width='90' height='9' rx='3'/></svg>",
    "<svg viewBox='0 0 9 9'><symbol id='s' viewBox='0 0 2 1'><circle r='1'/></symbol><use href='#s' x='3' width='5' height='4'/></svg>",
    "<!DOCTYPE svg [<!ENTITY e '#s'><!ENTITY f '&e;&e;'>]><svg><g id='s'><path d='M0 0h900'/></g><use href='&e;'/></svg>",
    "<svg><path d='M9 9h900v90' stroke='#000' stroke-width='20' stroke-dasharray='30 5 0' stroke-dashoffset='-7' stroke-linecap='round'/></svg>",
    "<svg><linearGradient id='g'><stop stop-color='#333'/></linearGradient><polygon points='1,2 900 9 30,700' fill='url(#g) red' opacity='40%'/></svg>",
    "<svg><switch><g requiredExtensions='x'/><svg x='9' width='90' height='400' viewBox='0 0 1 1' preserveAspectRatio='xMaxYMin slice'><ellipse cx='.5' cy='.5' rx='.4' ry='.2'/></svg></switch></svg>",
    "<svg viewBox='0 0 100 100'><text>F</text><polyline fill-rule='evenodd' points='5 5 95 95 5 95 95 5' stroke='currentColor' stroke-miterlimit='9'/></svg>",
    "<svg:svg xmlns:svg='http://www.w3.org/2000/svg'><svg:g style='stroke:rgb(10%,20%,3%);fill:none'><svg:path d='m1 1 900 900M5,5.5.5-1e3'/></svg:g></svg:svg>",
];

const PIECES: [&str; 40] = [
    "<g>",
    "</g>",
    "<use href='#s'/>",
    "<path d='M0 0H9V9z'/>",
    " id='s'",
    " href='#s'",
    "/>",
    ">",
    "<",
    "'",
    "\"",
    "&e;",
    "&#60;",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<!DOCTYPE svg [",
    "]>",
    "{",
    "}",
    "/*",
    "*",
    ".a",
    "1e9",
    "1e-9",
    "1e999",
    "-",
    "0",
    "%",
    "NaN",
    " stroke-dasharray='1e-5'",
    " stroke-width='1e9'",
    " transform='scale(1e6,1e-6)'",
    "A",
    "c",
    "z",
    "é",
    "\0",
    " stroke='#000'",
];

/// Each file is drawn within the bound of its work, equally each time, or refused in words.
pub(super) fn drawn(source: &mut Source<'_>, gauge: &mut Gauge) {
    let mut text = source.pick(&WHOLE).to_owned();
    make::damage(source, &mut text, &PIECES, 8);
    let found = gauge.call("draw_svg", || draw_svg(text.as_bytes()));
    match found {
        Ok(svg) => {
            gauge.reach("drawn");
            assert!(svg.work <= MAX_WORK, "{} units", svg.work);
            assert_eq!(svg.grey.len(), svg.width * svg.height);
            assert_eq!(svg.width.max(svg.height), 1024);
            assert!(svg.grey.iter().any(|level| *level != svg.grey[0]), "one shade of grey");
        }
        Err(why) => assert!(!why.is_empty()),
    }
}
