//! Curves and islands: every segment is replaced by the same way, turned round or mirrored where the word says so.

use super::paint;
use crate::dice::Dice;
use crate::palette;
use crate::title::title;
use lsystem_syntax::{ColourBy, Definition};

/// The meaning of a second letter, R beside L.
#[derive(Clone, Copy, PartialEq)]
enum Twist {
    /// There is no second letter.
    None,
    /// The way from its end to its beginning, as in Gosper's curve.
    Back,
    /// The way's mirror image, as in Sierpiński's arrowhead.
    Mirror,
}

/// A way of segments: the turns before each segment and after the last, in parts of the whole circle; and for each
/// segment whether it is the second letter.
struct Way {
    turns: Vec<i32>,
    seconds: Vec<bool>,
}

pub(super) fn make(dice: &mut Dice, is_island: bool) -> Definition {
    let parts = dice.one([4, 4, 6, 6, 6, 8, 5, 10, 12]);
    let twist = dice.one([Twist::None, Twist::Back, Twist::Back, Twist::Mirror]);
    let way = loop {
        let way = random_way(dice, parts, twist);
        if is_good(&way, parts, if is_island { 1.35 } else { 1.55 }) {
            break way;
        }
    };
    let twist = if way.seconds.contains(&true) { twist } else { Twist::None };
    let letter = |second: bool| {
        if twist == Twist::None {
            'F'
        } else if second {
            'G'
        } else {
            'F'
        }
    };
    let mut rules = format!("F -> {}", word(&way, letter));
    let other = match twist {
        Twist::None => None,
        Twist::Back => Some(Way {
            turns: way.turns.iter().rev().map(|turn| -turn).collect(),
            seconds: way.seconds.iter().rev().map(|second| !second).collect(),
        }),
        Twist::Mirror => Some(Way {
            turns: way.turns.iter().map(|turn| -turn).collect(),
            seconds: way.seconds.iter().map(|second| !second).collect(),
        }),
    };
    if let Some(other) = other {
        rules += &format!("\nG -> {}", word(&other, letter));
    }
    let axiom = if is_island {
        let corners = dice.one([3, 4, 6, 5]);
        let corners = if parts % corners == 0 { corners } else { parts };
        let turn = (parts / corners) as usize;
        let side = dice.one(["+", "-"]).repeat(turn);
        vec!["F"; corners as usize].join(&side)
    } else {
        "F".to_owned()
    };
    let mut made = Definition { axiom, rules, angle: 360.0 / f64::from(parts), heading: 0.0, ..Definition::default() };
    let [colours, by] = if dice.chance(0.25) { [1, 0] } else { [dice.whole(4, 6), 1] };
    let colours = if by == 0 { palette::single(dice) } else { palette::gradient(dice, colours) };
    let kinds: &[&str] =
        if is_island { &["island", "coast", "wreath", "snowflake"] } else { &["curve", "meander", "braid", "ribbon"] };
    made.title = title(dice, colours.hue, kinds);
    made.style.colour_by = if by == 0 { ColourBy::Single } else { ColourBy::Path };
    made.style.width = dice.rounded(0.3, 0.5);
    made.style.min_width = 1.5;
    made.style.max_width = 1.2;
    paint(&mut made, colours);
    made
}

/// A random way of 3 to 8 segments.
fn random_way(dice: &mut Dice, parts: i32, twist: Twist) -> Way {
    let count = dice.whole(3, 8);
    let most = (parts - 1) / 2;
    let mut turns: Vec<i32> = vec![0];
    // A way that answers each turn with its opposite looks made, not shaken.
    let is_odd = dice.chance(0.5);
    let half: Vec<i32> = (1..count).map(|_| turn(dice, most)).collect();
    turns.extend((0..count - 1).map(|at| {
        let back = count - 2 - at;
        if is_odd && at > back {
            -half[back]
        } else if !is_odd && at > back {
            half[back]
        } else {
            half[at]
        }
    }));
    turns.push(0);
    let seconds = (0..count).map(|_| twist != Twist::None && dice.chance(0.5)).collect();
    let mut way = Way { turns, seconds };
    // The direction from the beginning to the end, if it is one of the directions of segments, becomes that of the first.
    let [x, y] = end(&way, parts);
    let towards = libm::atan2(y, x) / core::f64::consts::TAU * f64::from(parts);
    let nearest = libm::round(towards);
    if (towards - nearest).abs() < 1e-6 {
        way.turns[0] = -(nearest as i32);
    }
    // The last turn leads back to the direction of the whole.
    let sum: i32 = way.turns.iter().sum();
    let rest = (-sum).rem_euclid(parts);
    if let Some(last) = way.turns.last_mut() {
        *last = if rest > parts / 2 { rest - parts } else { rest };
    }
    way
}

fn turn(dice: &mut Dice, most: i32) -> i32 {
    let size = if dice.chance(0.7) { 1 } else { dice.whole(0, most as usize) as i32 };
    if dice.chance(0.5) { size } else { -size }
}

/// Where a way from the origin ends, in lengths of its segments.
fn end(way: &Way, parts: i32) -> [f64; 2] {
    let mut heading = 0;
    way.turns[..way.seconds.len()].iter().fold([0.0, 0.0], |[x, y], turn| {
        heading += turn;
        let angle = core::f64::consts::TAU * f64::from(heading) / f64::from(parts);
        [x + libm::cos(angle), y + libm::sin(angle)]
    })
}

/// Whether a way leads away from its beginning, and so slowly that a curve of it fills a good part of the plane: its
/// dimension is from `least` to 2.
fn is_good(way: &Way, parts: i32, least: f64) -> bool {
    let [x, y] = end(way, parts);
    let reach = libm::hypot(x, y);
    if reach < 1.3 {
        return false;
    }
    let dimension = libm::log(way.seconds.len() as f64) / libm::log(reach);
    (least..2.000_001).contains(&dimension)
}

/// The word of a way.
fn word(way: &Way, letter: impl Fn(bool) -> char) -> String {
    let mut text = String::new();
    for (at, turn) in way.turns.iter().enumerate() {
        let sign = if *turn < 0 { '-' } else { '+' };
        text.extend(core::iter::repeat_n(sign, turn.unsigned_abs() as usize));
        text.extend(way.seconds.get(at).map(|&second| letter(second)));
    }
    text
}
