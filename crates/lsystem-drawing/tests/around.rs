//! Neighbourhoods of segments, against places computed with exact integers in a ring of directions.

use lsystem_base::Limits;
use lsystem_base::fixed::Fixed;
use lsystem_drawing::{Around, Drawing, Item, Plane, System, draw};
use lsystem_syntax::Definition;
use num_bigint::BigInt;
use std::collections::HashMap;

/// A system whose turns are multiples of a full turn divided by 8 or 12.
struct Ring {
    name: &'static str,
    axiom: &'static str,
    rules: &'static [(char, &'static str)],
    /// The directions of a full turn, and of one turn.
    directions: usize,
    turn: usize,
}

const RINGS: [Ring; 10] = [
    Ring { name: "Hilbert", axiom: "A", rules: &[('A', "-BF+AFA+FB-"), ('B', "+AF-BFB-FA+")], directions: 12, turn: 3 },
    Ring { name: "dragon", axiom: "FX", rules: &[('X', "X+YF+"), ('Y', "-FX-Y")], directions: 12, turn: 3 },
    Ring { name: "Koch", axiom: "F--F--F", rules: &[('F', "F+F--F+F")], directions: 12, turn: 2 },
    Ring {
        name: "Gosper",
        axiom: "F",
        rules: &[('F', "F-G--G+F++FF+G-"), ('G', "+F-GG--G-F++F+G")],
        directions: 12,
        turn: 2,
    },
    Ring { name: "arrowhead", axiom: "F", rules: &[('F', "G-F-G"), ('G', "F+G+F")], directions: 12, turn: 2 },
    Ring { name: "Lévy", axiom: "F", rules: &[('F', "+F--F+")], directions: 8, turn: 1 },
    Ring { name: "terdragon", axiom: "F", rules: &[('F', "F+F-F")], directions: 12, turn: 4 },
    Ring { name: "square Koch", axiom: "F", rules: &[('F', "F+F-F-FFF+F+F-F")], directions: 12, turn: 3 },
    Ring { name: "plant", axiom: "X", rules: &[('X', "F[+X][-X]FX"), ('F', "FF")], directions: 12, turn: 1 },
    Ring { name: "bush", axiom: "F", rules: &[('F', "FF-[-F+F+F]+[+F-F-F]")], directions: 8, turn: 1 },
];

/// A sum of directions, by direction.
type Sum = Vec<BigInt>;

/// What a letter does in some steps.
#[derive(Clone)]
struct Effect {
    at: Sum,
    heading: usize,
    segments: BigInt,
}

struct Naive<'a> {
    ring: &'a Ring,
    effects: HashMap<(char, u32), Effect>,
}

impl Naive<'_> {
    fn rotated(&self, sum: &Sum, by: usize) -> Sum {
        let all = self.ring.directions;
        (0..all).map(|at| sum[(at + all - by % all) % all].clone()).collect()
    }

    fn add(a: &Sum, b: &Sum) -> Sum {
        a.iter().zip(b).map(|(a, b)| a + b).collect()
    }

    fn zero(&self) -> Sum {
        vec![BigInt::ZERO; self.ring.directions]
    }

    fn rule(&self, letter: char) -> Option<&'static str> {
        self.ring.rules.iter().find(|(from, _)| *from == letter).map(|(_, to)| *to)
    }

    /// Makes the effects of all letters up to a depth, from 0 on.
    fn prepare(&mut self, n: u32) {
        for depth in 0..=n {
            for letter in "FGXYAB".chars() {
                let effect = match self.rule(letter).filter(|_| depth > 0) {
                    Some(word) => self.walk(word, depth - 1, 0, None).0,
                    None => {
                        let drawn = i32::from(letter == 'F' || letter == 'G');
                        let mut at = self.zero();
                        at[0] += drawn;
                        Effect { at, heading: 0, segments: BigInt::from(drawn) }
                    }
                };
                self.effects.insert((letter, depth), effect);
            }
        }
    }

    /// Walks a word whose letters are derived `depth` more steps, or up to the letter with the segment `number`. Returns
    /// the effect, and that letter.
    fn walk(&self, word: &str, depth: u32, heading: usize, number: Option<&BigInt>) -> (Effect, Option<char>) {
        let mut now = Effect { at: self.zero(), heading, segments: BigInt::ZERO };
        let mut saved = vec![];
        for letter in word.chars() {
            let all = self.ring.directions;
            match letter {
                '+' => now.heading = (now.heading + self.ring.turn) % all,
                '-' => now.heading = (now.heading + all - self.ring.turn) % all,
                '[' => saved.push((now.at.clone(), now.heading)),
                ']' => (now.at, now.heading) = saved.pop().unwrap(),
                _ => {
                    let effect = &self.effects[&(letter, depth)];
                    let after = &now.segments + &effect.segments;
                    if number.is_some_and(|number| after > *number) {
                        return (now, Some(letter));
                    }
                    now.at = Self::add(&now.at, &self.rotated(&effect.at, now.heading));
                    now.heading = (now.heading + effect.heading) % all;
                    now.segments = after;
                }
            }
        }
        (now, None)
    }

    /// The ends of a segment.
    fn ends(&self, n: u32, number: &BigInt) -> [Sum; 2] {
        let (mut left, mut word, mut depth) = (number.clone(), self.ring.axiom, n);
        let (mut at, mut heading) = (self.zero(), self.ring.directions / 4);
        loop {
            let (before, letter) = self.walk(word, depth, heading, Some(&left));
            let letter = letter.unwrap();
            left -= before.segments;
            at = Self::add(&at, &before.at);
            heading = before.heading % self.ring.directions;
            match self.rule(letter).filter(|_| depth > 0) {
                Some(inner) => (word, depth) = (inner, depth - 1),
                None => {
                    let to = Self::add(&at, &self.rotated(&self.effects[&(letter, 0)].at, heading));
                    return [at, to];
                }
            }
        }
    }

    /// The difference of two sums as a vector.
    fn vector(&self, to: &Sum, from: &Sum) -> [f64; 2] {
        let d: Vec<BigInt> = to.iter().zip(from).map(|(a, b)| a - b).collect();
        // Twice the coordinates are a + b * sqrt(root).
        let (root, twice) = if self.ring.directions == 8 {
            let x = (BigInt::from(2) * (&d[0] - &d[4]), &d[1] - &d[3] - &d[5] + &d[7]);
            (2, [x, (BigInt::from(2) * (&d[2] - &d[6]), &d[1] + &d[3] - &d[5] - &d[7])])
        } else {
            let x =
                (BigInt::from(2) * (&d[0] - &d[6]) + &d[2] - &d[4] - &d[8] + &d[10], &d[1] - &d[5] - &d[7] + &d[11]);
            let y =
                (BigInt::from(2) * (&d[3] - &d[9]) + &d[1] + &d[5] - &d[7] - &d[11], &d[2] + &d[4] - &d[8] - &d[10]);
            (3, [x, y])
        };
        let unit = BigInt::from(10).pow(30);
        twice.map(|(a, b)| {
            let size = (BigInt::from(root) * &b * &b * &unit * &unit).sqrt();
            let all = a * &unit + if b < BigInt::ZERO { -size } else { size };
            all.to_string().parse::<f64>().unwrap() / 2e30
        })
    }
}

fn drawing(ring: &Ring, n: u32) -> Drawing {
    let rules: Vec<String> = ring.rules.iter().map(|(from, to)| format!("{from} -> {to}")).collect();
    let angle = 360.0 / ring.directions as f64 * ring.turn as f64;
    let definition = Definition { axiom: ring.axiom.into(), rules: rules.join("\n"), angle, ..Definition::default() };
    draw::<Plane>(&System::new(&definition).unwrap(), n, &Limits::default()).unwrap()
}

/// A number below `below`, from digits that look like chance.
fn some(below: &Fixed, seed: u64) -> Fixed {
    let digits = below.decimal();
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let text: String = (1..digits.len().max(2))
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            char::from(b'0' + ((state >> 33) % 10) as u8)
        })
        .collect();
    Fixed::read(&text, 1000).unwrap()
}

/// More segments than a block has whose size is within the reach.
const WHOLE: u128 = 1 << 40;

/// The ends of a segment of an item, in the frame around the item.
fn ends_in(drawing: &Drawing, item: &Item, number: u128) -> [[f64; 2]; 2] {
    match item {
        Item::Stroke(stroke) => [stroke.from, stroke.to],
        Item::Polygon(_) => panic!("a polygon has no segments"),
        Item::Block(placed) => {
            let items = drawing.items_of(placed.block);
            let (at, number) = drawing.before(items, number);
            let (c, s) = placed.heading.cos_sin();
            ends_in(drawing, &items[at], number).map(|[x, y]| {
                let [x, y] = [x, y].map(|v| v * placed.scale);
                [placed.at[0] + c * x - s * y, placed.at[1] + s * x + c * y]
            })
        }
    }
}

/// Segments of a neighbourhood, about `most` at even distances: numbers in the whole drawing, and ends.
fn segments(around: &Around, most: u128) -> Vec<(Fixed, [[f64; 2]; 2])> {
    let drawing = &around.drawing;
    let items = drawing.items_of(drawing.root.unwrap());
    assert_eq!(items.len(), around.firsts.len());
    // Where very many blocks overlap, some are taken whole.
    let counts = items.iter().map(|item| drawing.segments_in(item));
    let step = (counts.filter(|count| *count < WHOLE).sum::<u128>() / most).max(1);
    let mut found = vec![];
    for (item, first) in items.iter().zip(&around.firsts) {
        let count = drawing.segments_in(item);
        for local in (0..if count < WHOLE { count } else { 0 }).step_by(step as usize) {
            let ends = ends_in(drawing, item, local).map(|end| end.map(|v| v * drawing.unit()));
            found.push((first.plus(&Fixed::units(local)), ends));
        }
    }
    found
}

/// The length of a step in the largest picture, in pixels: views that show less of it show one straight line.
const STEP: f64 = 4096.0;

/// Ten random places of each system at each size, with an error in pixels far below a tenth.
#[test]
fn places_at_any_depth_agree_with_exact_integers() {
    for ring in &RINGS {
        let mut naive = Naive { ring, effects: HashMap::new() };
        naive.prepare(1000);
        for digits in [20, 100, 301] {
            let size = f64::from(digits) * core::f64::consts::LOG2_10;
            let wide = |n: &u32| {
                let drawing = drawing(ring, *n);
                f64::from(drawing.blocks[drawing.root.unwrap().0 as usize].exponent) >= size
            };
            let n = (10..1000).step_by(30).find(wide).unwrap_or(1000);
            let drawing = drawing(ring, n);
            let all = drawing.exact_count();
            for seed in 1..=10 {
                let number = some(&all, seed + u64::from(n));
                let around = drawing.around(&number.clone().into(), [0.0; 2], 4).unwrap();
                let big = |number: &Fixed| number.decimal().parse::<BigInt>().unwrap();
                let [anchor, _] = naive.ends(n, &big(&number));
                let found = segments(&around, 12);
                let mut worst = 0.0_f64;
                for (number, ends) in found.iter().step_by(found.len() / 12 + 1) {
                    let exact = naive.ends(n, &big(number)).map(|end| naive.vector(&end, &anchor));
                    for (end, exact) in ends.iter().zip(exact) {
                        worst = worst.max((end[0] - exact[0]).abs()).max((end[1] - exact[1]).abs());
                    }
                }
                assert!(worst * STEP < 1e-5, "{} n = {n}: {worst}", ring.name);
                let items = around.drawing.items_of(around.drawing.root.unwrap());
                // In a crowd, the segment may lie below equal ones.
                assert!(
                    ring.name == "bush"
                        || items.iter().zip(&around.firsts).any(|(item, first)| {
                            let after = first.plus(&Fixed::units(around.drawing.segments_in(item)));
                            !number.compared(first).is_lt() && number.compared(&after).is_lt()
                        })
                );
            }
        }
    }
}

/// All segments in reach are in the neighbourhood.
#[test]
fn no_near_segment_is_missing() {
    for ring in &RINGS {
        let n = match ring.name {
            "dragon" | "Lévy" => 14,
            "terdragon" | "arrowhead" => 9,
            "Gosper" | "bush" | "square Koch" => 4,
            _ => 6,
        };
        let drawing = drawing(ring, n);
        let all: Vec<_> = drawing.segments().map(|segment| [segment.from, segment.to]).collect();
        for seed in 1..=20 {
            let number = seed * 7919 % all.len();
            let around = drawing.around(&Fixed::units(number as u128).into(), [0.0; 2], 2).unwrap();
            let found = segments(&around, u128::MAX);
            let numbers: HashMap<String, [[f64; 2]; 2]> =
                found.iter().map(|(number, ends)| (number.decimal(), *ends)).collect();
            let [ax, ay] = all[number][0];
            let mut near = 0;
            for (at, [from, to]) in all.iter().enumerate() {
                let middle = [0, 1].map(|axis| (from[axis] + to[axis]) / 2.0);
                if (middle[0] - ax).abs().max((middle[1] - ay).abs()) > 3.5 {
                    continue;
                }
                near += 1;
                let ends = numbers.get(&at.to_string()).unwrap_or_else(|| panic!("{} {number} {at}", ring.name));
                assert!((ends[0][0] - (from[0] - ax)).abs() + (ends[0][1] - (from[1] - ay)).abs() < 1e-9);
            }
            assert!(near > 2);
        }
    }
}

#[test]
fn polygons_without_number_are_not_read_for_the_next_segment() {
    let rules = "A -> AA{f+f+f}".to_owned();
    let definition = Definition { axiom: "FA".into(), rules, angle: 90.0, ..Definition::default() };
    let system = System::new(&definition).expect("a system");
    let drawing: Drawing = draw(&system, 60, &Limits::default()).expect("a drawing");
    assert_eq!((drawing.segments().count(), drawing.polygon_count()), (1, (1 << 60) - 1));
    assert_eq!((drawing.heading_at(0), drawing.heading_at(1)), (Some(90.0), None));
}
