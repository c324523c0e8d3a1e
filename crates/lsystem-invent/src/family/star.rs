//! Stars: plants in all directions from one point. The angle of their branches divides the circle as the star does.

use super::paint;
use crate::dice::Dice;
use crate::palette;
use crate::title::title;
use lsystem_syntax::{ColourBy, Definition};

pub(super) fn make(dice: &mut Dice) -> Definition {
    let arms = dice.one([5_usize, 6, 6, 6, 7, 8, 8, 9, 12]);
    let angle = dice.one([360.0 / arms as f64, 180.0 / arms as f64, 60.0, 45.0]);
    let step = dice.one([1, 1, 2]);
    // Both sides are alike, so the star has axes of symmetry.
    let mut successor = String::from("F");
    for node in 0..dice.whole(1, 2) {
        if node > 0 {
            successor.push('F');
        }
        let turns = |sign: &str| sign.repeat(step);
        let inside = dice.one(["X", "FX", "X"]);
        successor += &format!("[{}{inside}][{}{inside}]", turns("+"), turns("-"));
    }
    successor += dice.one(["X", "FX", "FFX"]);
    let longer = dice.one(["FF", "FF", "F"]);
    let mut rules = format!("X -> {successor}");
    if longer == "FF" {
        rules += "\nF -> FF";
    }
    let axiom = vec!["[X]"; arms].join(&format!("+({})", 360.0 / arms as f64));
    let mut made = Definition { axiom, rules, angle, ..Definition::default() };
    let colours = if dice.chance(0.3) { palette::single(dice) } else { palette::gradient(dice, 5) };
    made.title = title(dice, colours.hue, &["star", "flake", "rosette", "crystal"]);
    made.style.colour_by = if colours.colours.len() == 1 { ColourBy::Single } else { ColourBy::Level };
    made.style.palette_holds = true;
    made.style.width = dice.rounded(0.4, 1.2);
    made.style.width_factor = dice.rounded(0.65, 0.85);
    made.style.min_width = 0.7;
    made.style.max_width = 0.8;
    if dice.chance(0.35) {
        made.overrides = format!("X: disc {}", dice.rounded(0.8, 1.8));
    }
    paint(&mut made, colours);
    made
}
