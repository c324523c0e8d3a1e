//! Trees in space: each branch ends in two to four shorter and thinner ones, and the last ones in leaves.

use super::paint;
use crate::dice::Dice;
use crate::palette;
use crate::title::title;
use lsystem_syntax::Definition;

pub(super) fn make(dice: &mut Dice) -> Definition {
    let children = dice.whole(2, 4);
    let mut successor = String::from("!(w)F(l)");
    let has_leader = dice.chance(0.5);
    let divergence = if dice.chance(0.4) { 137.5 } else { (360.0 / children as f64).round() };
    for child in 0..children {
        let pitch = if child == 0 && has_leader { dice.between(0.0, 14.0) } else { dice.between(22.0, 52.0) };
        let shorter = if child == 0 && has_leader { dice.rounded(0.74, 0.86) } else { dice.rounded(0.6, 0.78) };
        let roll = dice.between(20.0, 130.0);
        let roll = roll.round();
        successor += &format!("[&({})/({roll})A(l*{shorter},w*{})]", pitch.round(), dice.rounded(0.58, 0.76));
        if child + 1 < children {
            successor += &format!("/({divergence})");
        }
    }
    let mut rules = format!("w = {}\nA(l,w) -> {successor}", dice.rounded(3.0, 5.5));
    let size = dice.rounded(1.2, 2.2);
    rules +=
        &format!("\ndraw:\nA(l,w) -> !(w)F(l*0.6)'[&(38)L(l*{size})]/(120)'[&(62)L(l*{size})]/(120)[&(50)L(l*{size})]");
    let trunk = dice.between(4.0, 18.0).round();
    let first = dice.between(26.0, 36.0).round();
    let mut made = Definition {
        axiom: format!("!(w)F({trunk})/({})A({first},w*0.85)", dice.whole(0, 36) * 10),
        rules,
        angle: 30.0,
        ..Definition::default()
    };
    let colours = palette::plant(dice, 2);
    made.overrides = format!("L: leaf {} 1", dice.one(["lance", "heart", "oak", "petal"]));
    if dice.chance(0.3) {
        made.tropism = [0.0, -1.0, 0.0];
        made.elasticity = dice.one([-1.0, 1.0]) * dice.rounded(0.05, 0.16);
    }
    made.title = title(dice, colours.hue, &["tree", "oak", "lime", "acacia", "maple"]);
    made.style.width = 1.0;
    made.style.min_width = 0.6;
    made.style.max_width = 4.0;
    paint(&mut made, colours);
    made
}
