//! Plants in the plane: an apex X that makes stem and branches, and segments F that double.

use super::paint;
use crate::dice::Dice;
use crate::palette;
use crate::title::title;
use lsystem_syntax::{ColourBy, Definition};

pub(super) fn make(dice: &mut Dice, by_chance: bool) -> Definition {
    let mut rules = vec![];
    let has_leaves = dice.chance(0.6);
    // ABOP figures 1.24a to c replace segments, d to f apices.
    let axiom = if !by_chance && !has_leaves && dice.chance(0.35) {
        rules.push(format!("F -> {}", branching(dice, 'F')));
        "F"
    } else {
        let count = if by_chance { dice.whole(2, 3) } else { 1 };
        for _ in 0..count {
            let chance = if by_chance { format!(" : {}", dice.one([1, 1, 2])) } else { String::new() };
            rules.push(format!("X -> {}{chance}", branching(dice, 'X')));
        }
        if by_chance {
            rules.push("F -> FF : 4".to_owned());
            rules.push("F -> F : 1".to_owned());
        } else {
            rules.push("F -> FF".to_owned());
        }
        "X"
    };
    let mut made = Definition {
        axiom: axiom.to_owned(),
        rules: rules.join("\n"),
        angle: dice.between(14.0, 36.0).round(),
        seed: dice.whole(1, 999) as u32,
        ..Definition::default()
    };
    if by_chance {
        made.angle_variation = dice.one([10.0, 20.0, 30.0]);
        made.length_variation = dice.one([0.0, 15.0]);
    }
    let leaf = dice.one(["lance", "heart", "needle", "petal"]);
    let leaves = dice.whole(1, 2);
    let colours = palette::plant(dice, if has_leaves { leaves } else { 4 });
    if has_leaves {
        let size = dice.rounded(1.2, 2.4);
        made.overrides = if dice.chance(0.25) {
            format!("X: colour 1, disc {}", dice.rounded(1.0, 2.0))
        } else {
            format!("X: colour 1, leaf {leaf} {size}")
        };
    } else {
        made.style.colour_by = ColourBy::Level;
        made.style.palette_holds = true;
    }
    let kinds: &[&str] =
        if by_chance { &["shrub", "sapling", "thicket"] } else { &["weed", "fern", "bush", "twig", "plume"] };
    made.title = title(dice, colours.hue, kinds);
    made.style.width = dice.rounded(2.0, 3.5);
    made.style.width_factor = if axiom == "F" { 0.62 } else { 0.85 };
    made.style.min_width = 0.6;
    made.style.max_width = dice.rounded(1.0, 1.8);
    paint(&mut made, colours);
    made
}

/// The successor of an apex, or of a segment: a stem with branches to both sides.
fn branching(dice: &mut Dice, apex: char) -> String {
    // Every step of an apex makes its branch thinner, so that stems taper upwards.
    let mut text = String::from(if apex == 'X' { "F!" } else { "F" });
    let nodes = dice.one([1, 2, 2, 3, 3]);
    let mut side = dice.one(['+', '-']);
    for node in 0..nodes {
        let turn = |dice: &mut Dice, side: char| side.to_string().repeat(if dice.chance(0.2) { 2 } else { 1 });
        let inside = match dice.whole(0, 4) {
            0 => format!("F{apex}"),
            1 => format!("{apex}{}", if apex == 'F' { "F" } else { "" }),
            _ => apex.to_string(),
        };
        text += &format!("[{}{inside}]", turn(dice, side));
        let other = if side == '+' { '-' } else { '+' };
        if nodes == 1 || dice.chance(0.35) {
            text += &format!("[{}{apex}]", turn(dice, other));
        }
        side = other;
        if node + 1 < nodes {
            text.push('F');
        }
    }
    match dice.whole(0, 3) {
        0 => text += &format!("{side}{apex}"),
        1 => text += &format!("F{apex}"),
        _ => text.push(apex),
    }
    text
}
