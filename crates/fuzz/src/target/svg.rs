//! SVG pictures of other programs: right ones, and damaged ones.

use crate::pieces::pieces;
use crate::{Gauge, Source, make};
use lsystem::svg::draw_svg;

/// The most units of a picture.
const MAX_WORK: u64 = 500_000_000;

/// Each file is drawn within the bound of its work, equally each time, or refused in words.
pub(super) fn drawn(source: &mut Source<'_>, gauge: &mut Gauge) {
    let mut text = source.pick(pieces("whole svg")).to_owned();
    make::damage(source, &mut text, pieces("svg"), 8);
    let found = gauge.call("draw_svg", || draw_svg(text.as_bytes()));
    match found {
        Ok(svg) => {
            gauge.reach("drawn");
            assert!(svg.work <= MAX_WORK, "{} units", svg.work);
            assert_eq!(svg.grey.len(), svg.width * svg.height);
            assert_eq!(svg.width.max(svg.height), 1024);
            assert!(svg.grey.iter().any(|level| *level != svg.grey[0]), "one shade of grey");
        }
        Err(why) => assert!(!why.message.is_empty()),
    }
}
