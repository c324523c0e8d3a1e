//! Heads: floret after floret, each farther out and turned by the same angle (Vogel's formula, ABOP section 4.1).

use super::paint;
use crate::dice::Dice;
use crate::palette;
use crate::title::title;
use lsystem_syntax::{ColourBy, Definition};

pub(super) fn make(dice: &mut Dice) -> Definition {
    // The golden angle, its like from other sequences, and angles a little beside them, which open the spirals.
    let angle = dice.one([137.508, 137.508, 99.502, 77.955, 151.136, 137.3, 137.6]);
    let power = dice.one([0.5, 0.5, 0.6, 0.7]);
    let grows = dice.rounded(0.25, 0.6);
    let outline = dice.one(["disc 1", "disc 1", "leaf petal 1", "leaf lance 1", "leaf heart 1"]);
    let size = if outline.starts_with("disc") { dice.rounded(0.5, 0.95) } else { dice.rounded(1.2, 2.2) };
    let rules = format!("s = {size}\nA(k) -> [f(k^{power})L(s*(k/200)^{grows}+0.15)]+({angle})A(k+1)");
    let mut made = Definition {
        axiom: "A(1)".to_owned(),
        rules,
        iterations: dice.one([200, 300, 400]),
        overrides: format!("L: {outline}"),
        ..Definition::default()
    };
    // A Fibonacci number of colours makes the spirals visible.
    let count = dice.one([5_usize, 8, 3, 13, 34]);
    let colours = if count == 34 { palette::gradient(dice, 16) } else { palette::gradient(dice, count) };
    made.title = title(dice, colours.hue, &["sunflower", "daisy", "cone", "aster"]);
    made.style.colour_by = ColourBy::Generation;
    made.style.min_width = 0.6;
    paint(&mut made, colours);
    made
}
