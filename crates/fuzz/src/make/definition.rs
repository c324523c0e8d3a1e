//! Random systems, with every field of a definition.

use super::text::{SystemFeatures, overrides, random_pieces, rules, word};
use super::view::style;
use crate::Source;
use lsystem::syntax::{ColourBy, Ink};
use lsystem::{Definition, Dialect, Limits, System};

/// The limits of most executions; small, so that there are many executions.
const SMALL: Limits = Limits { symbols: 100_000, modules: 20_000, segments: 5_000, work: 200_000, memory: 70 << 20 };

/// Random limits, mostly [`SMALL`].
pub(crate) fn limits(source: &mut Source<'_>) -> Limits {
    match source.below(100) {
        99 => Limits::PAGE,
        90..99 => Limits { symbols: 1 << 20, modules: 200_000, segments: 50_000, work: 2_000_000, ..Limits::PAGE },
        89 => Limits { symbols: 10, modules: 10, segments: 10, work: 10, ..Limits::PAGE },
        _ => SMALL,
    }
}

/// A definition and its system; `None` if the definition has errors.
pub(crate) fn system(source: &mut Source<'_>) -> Option<(Definition, System)> {
    let definition = definition(source);
    let system = System::new(&definition).0?;
    Some((definition, system))
}

/// The given definition, or a random one, which seldom has errors.
pub(crate) fn definition(source: &mut Source<'_>) -> Definition {
    let definition = source.given.clone().unwrap_or_else(|| random_definition(source));
    if source.is_shown {
        println!("{}", lsystem::write_json(&definition));
    }
    definition
}

fn random_definition(source: &mut Source<'_>) -> Definition {
    let features = SystemFeatures::make(source);
    let mut definition = Definition {
        axiom: word(source, SystemFeatures { long: false, ..features }, &[], 1),
        rules: rules(source, features),
        angle: angle(source),
        iterations: match source.below(16) {
            0..9 => source.between(0, 5) as u32,
            9..13 => source.between(6, 12) as u32,
            13 => 40,
            14 => source.between(13, 300) as u32,
            _ => 1000,
        },
        seed: source.pick(&[0, 1, 7, u32::MAX]),
        ..Definition::default()
    };
    if source.once_in(4) {
        definition.overrides = overrides(source);
    }
    if source.once_in(4) {
        definition.dialect = source.pick(Dialect::ALL);
    }
    if source.once_in(3) {
        definition.style = style(source);
    }
    for _ in 0..source.pick(&[0, 0, 1, 2, 4]) {
        change_field(source, &mut definition);
    }
    if source.once_in(200) {
        definition.rules = random_pieces(source);
    }
    definition
}

/// An angle in degrees: round, or so near to a round one that a circle does not close.
fn angle(source: &mut Source<'_>) -> f64 {
    match source.below(8) {
        0..5 => source.pick(&[90.0, 60.0, 25.7, 45.0, 22.5, 36.0, 120.0, 180.0, 0.0, 72.0, 30.0]),
        5 => source.pick(&[89.999_999, 30.000_000_246, 60.000_000_083, 180.000_001_189, 1e-7, 359.999_999]),
        6 => source.part() * 360.0,
        _ => -90.0,
    }
}

/// A number for a field: mostly one of `usual`.
fn near(source: &mut Source<'_>, usual: &[f64]) -> f64 {
    if source.once_in(6) { source.number() } else { source.pick(usual) }
}

/// Changes one field.
fn change_field(source: &mut Source<'_>, definition: &mut Definition) {
    const DEGREES: [f64; 6] = [0.0, 90.0, 17.3, -45.0, 180.0, 89.999_999];
    const FACTORS: [f64; 8] = [0.5, 0.9, 0.999_999, 1.0, 1.2, 2.0, 0.01, 1e-3];
    match source.below(19) {
        0 => definition.right_angle = Some(near(source, &DEGREES)),
        1 => definition.pitch_down = Some(near(source, &DEGREES)),
        2 => definition.pitch_up = Some(near(source, &DEGREES)),
        3 => definition.roll_left = Some(near(source, &DEGREES)),
        4 => definition.roll_right = Some(near(source, &DEGREES)),
        5 => definition.heading = near(source, &DEGREES),
        6 => definition.step = near(source, &[1.0, 0.1, 10.0, 0.0, -1.0, 1e9, 1e-9]),
        7 => definition.start = [0, 1].map(|_| near(source, &[0.0, 1.0, -1e6, 1e9])),
        8 => definition.tropism = [0, 1, 2].map(|_| near(source, &[0.0, 1.0, -1.0, 0.3])),
        9 => {
            definition.elasticity = near(source, &[0.1, 0.5, 0.01, -0.2, 10.0]);
        }
        10 => definition.length_factor = near(source, &FACTORS),
        11 => definition.angle_variation = near(source, &[5.0, 20.0, 100.0]),
        12 => definition.length_variation = near(source, &[5.0, 20.0, 100.0]),
        13 => definition.growth = near(source, &[0.0, 0.5, 0.999_999, 1e-9]),
        14 => definition.style.width = near(source, &[0.0, 0.5, 5.0, 100.0, 1e6]),
        15 => definition.style.width_factor = near(source, &FACTORS),
        16 => definition.style.colour_by = source.pick(&ColourBy::ALL),
        17 => definition.style.ink = Ink::Density,
        _ => definition.angle = near(source, &DEGREES),
    }
}
