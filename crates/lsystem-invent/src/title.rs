//! Titles for new systems: the colour and the kind.

use crate::dice::Dice;

/// The title of a system whose strongest colour has this hue, in degrees.
pub(crate) fn title(dice: &mut Dice, hue: f64, kinds: &[&str]) -> String {
    let hues: [[&str; 3]; 12] = [
        ["Rose", "Crimson", "Berry"],
        ["Scarlet", "Brick", "Rust"],
        ["Copper", "Amber", "Ember"],
        ["Honey", "Golden", "Ochre"],
        ["Olive", "Lemon", "Reed"],
        ["Moss", "Lime", "Fern"],
        ["Leaf", "Jade", "Mint"],
        ["Sea", "Teal", "Lagoon"],
        ["Ice", "Sky", "Glacier"],
        ["Blue", "Cobalt", "River"],
        ["Violet", "Iris", "Dusk"],
        ["Plum", "Orchid", "Heather"],
    ];
    // Hues of OKLCH begin with pink at 0 degrees.
    let word = hues[(hue.rem_euclid(360.0) / 30.0) as usize % 12];
    let word = dice.one(word);
    let kind = kinds.get(dice.whole(0, kinds.len().max(1) - 1)).copied().unwrap_or("system");
    format!("{word} {kind}")
}
