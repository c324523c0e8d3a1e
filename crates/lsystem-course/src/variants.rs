//! Variants of an exercise: targets of equal difficulty, one for each student by name or number.

use crate::actions::Actions;
use crate::exercise::{Exercise, MAX_VARIANTS};
use crate::mark::Marker;
use lsystem_base::sorted;
use lsystem_base::word;
use lsystem_drawing::System;
use lsystem_syntax::{Definition, Seen, parse, print_axiom, print_rules};
use serde::{Deserialize, Serialize};

/// Angles of plants, in degrees.
const ANGLES: [f64; 9] = [18.0, 20.0, 22.5, 25.0, 27.5, 30.0, 33.0, 36.0, 40.0];
/// The seeds of chance besides the target's.
const SEEDS: u32 = 9;
/// Factors of a length factor's distance from 1.
const FACTORS: [f64; 3] = [0.8, 1.2, 0.9];

/// A property in which variants differ from the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "lowercase")]
pub enum Varied {
    /// Left and right turns exchanged.
    Mirrored,
    /// Other angles of a plant.
    Angle,
    /// Other names of letters that draw nothing.
    Letters,
    /// Other length factors.
    Lengths,
    /// Other seeds of chance.
    Seed,
}

impl Varied {
    /// All properties, in the order in which they are offered.
    pub const ALL: [Self; 5] = [Self::Mirrored, Self::Angle, Self::Letters, Self::Lengths, Self::Seed];

    /// Its name for teachers.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Mirrored => word!("mirrored"),
            Self::Angle => word!("other angles"),
            Self::Letters => word!("other letters"),
            Self::Lengths => word!("other lengths"),
            Self::Seed => word!("other seeds"),
        }
    }

    /// The systems that differ from a target in this property alone.
    fn of(self, target: &Definition) -> Vec<Definition> {
        match self {
            Self::Mirrored => mirrored(target).into_iter().collect(),
            Self::Angle if !(15.0..=42.0).contains(&target.angle) => Vec::new(),
            Self::Angle => ANGLES
                .into_iter()
                .filter(|angle| (angle - target.angle).abs() > 1.0)
                .map(|angle| Definition { angle, ..target.clone() })
                .collect(),
            Self::Letters => renamed(target).into_iter().collect(),
            Self::Lengths if target.length_factor == 1.0 => Vec::new(),
            Self::Lengths => FACTORS
                .into_iter()
                .map(|factor| Definition {
                    length_factor: 1.0 + (target.length_factor - 1.0) * factor,
                    ..target.clone()
                })
                .collect(),
            Self::Seed => {
                let is_random = System::new(target).is_ok_and(|system| system.is_stochastic());
                (1..=if is_random { SEEDS } else { 0 })
                    .map(|more| Definition { seed: target.seed.wrapping_add(more), ..target.clone() })
                    .collect()
            }
        }
    }
}

impl Exercise {
    /// The exercise with the variants that differ from the target in these properties, each alone and together. Those
    /// that equal another one in what is asked for, or that cannot be drawn, are left out.
    #[must_use]
    pub fn with_variants(self, varied: &[Varied]) -> Self {
        let mut all = vec![self.target.clone()];
        for property in Varied::ALL.into_iter().filter(|property| varied.contains(property)) {
            let more = all.iter().flat_map(|target| property.of(target)).collect::<Vec<_>>();
            all.extend(more);
            all.truncate(4 * MAX_VARIANTS);
        }
        let only = |target: Definition| Self { target, variants: Vec::new(), ..self.clone() };
        let mut markers: Vec<Marker> = Marker::new(only(self.target.clone())).into_iter().collect();
        let mut variants = Vec::new();
        for target in all.into_iter().skip(1) {
            if variants.len() >= MAX_VARIANTS {
                break;
            }
            let Ok(marker) = Marker::new(only(target.clone())) else { continue };
            if !markers.iter_mut().any(|other| other.is_solved_by(&target)) {
                markers.push(marker);
                variants.push(target);
            }
        }
        Self { variants, ..self }
    }

    /// The number of a student's variant, from 0 for the target itself: the same for the same name, whatever its case
    /// and its spaces.
    #[must_use]
    pub fn variant_of(&self, student: &str) -> usize {
        // FNV-1a, with its bits mixed: names differ in few.
        let words = student.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
        let hash = words
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
        let mixed = (hash ^ hash >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        (mixed % (1 + self.variants.len() as u64)) as usize
    }

    /// The exercise with one target alone: 0 for the target itself.
    #[must_use]
    pub fn variant(&self, number: usize) -> Self {
        let target = number.checked_sub(1).and_then(|number| self.variants.get(number)).unwrap_or(&self.target);
        Self { target: target.clone(), variants: Vec::new(), ..self.clone() }
    }
}

/// The system with left and right turns exchanged; `None` if that is not possible symbol by symbol.
fn mirrored(target: &Definition) -> Option<Definition> {
    relettered(target, |symbol| match symbol {
        '+' => '-',
        '-' => '+',
        other => other,
    })
}

/// The system with other names for the letters that have rules and draw nothing; `None` if there are none.
fn renamed(target: &Definition) -> Option<Definition> {
    let (grammar, _) = parse(&target.axiom, &target.rules);
    let actions = Actions::new(target);
    let is_used = |symbol: char| target.axiom.contains(symbol) || target.rules.contains(symbol);
    let free = ('A'..='Z').filter(|letter| actions.of(*letter).is_empty() && !is_used(*letter));
    let mut own: Vec<char> = grammar.productions.iter().map(|rule| rule.predecessor.symbol).collect();
    own.retain(|symbol| symbol.is_ascii_uppercase() && actions.of(*symbol).is_empty());
    sorted::sort(&mut own);
    own.dedup();
    let names: Vec<(char, char)> = own.into_iter().zip(free).collect();
    let renamed = |symbol| names.iter().find(|(from, _)| *from == symbol).map_or(symbol, |(_, to)| *to);
    if names.is_empty() { None } else { relettered(target, renamed) }
}

/// The system with every symbol exchanged; `None` if its lines would not stay where they are.
fn relettered(target: &Definition, of: impl Fn(char) -> char) -> Option<Definition> {
    let (mut grammar, _) = parse(&target.axiom, &target.rules);
    let lines = target.rules.lines().count();
    grammar.axiom.iter_mut().for_each(|module| module.symbol = of(module.symbol));
    if let Seen::Except(list) | Seen::Only(list) = &mut grammar.seen {
        list.iter_mut().for_each(|symbol| *symbol = of(*symbol));
    }
    for rule in grammar.productions.iter_mut().chain(&mut grammar.images) {
        rule.predecessor.symbol = of(rule.predecessor.symbol);
        rule.left.iter_mut().chain(&mut rule.right).for_each(|pattern| pattern.symbol = of(pattern.symbol));
        rule.successor.iter_mut().for_each(|module| module.symbol = of(module.symbol));
    }
    let (axiom, rules) = (print_axiom(&grammar), print_rules(&grammar));
    (rules.lines().count() == lines).then(|| Definition { axiom, rules, ..target.clone() })
}
