//! Random systems, with every field of a definition.

use super::field::{change_field, style};
use super::text::{SystemFeatures, overrides, random_pieces, rules, surfaces, word};
use crate::Source;
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
    let system = System::new(&definition).ok()?;
    Some((definition, system))
}

/// The given definition, or a random one, which seldom has errors.
pub(crate) fn definition(source: &mut Source<'_>) -> Definition {
    let definition = source.given.clone().unwrap_or_else(|| random_definition(source));
    source.show(format_args!("{}", lsystem::write_json(&definition)));
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
        if source.once_in(2) {
            definition.surfaces = surfaces(source);
        }
    }
    if source.once_in(4) {
        definition.dialect = source.pick(&Dialect::ALL);
    }
    if source.once_in(3) {
        definition.style = style(source);
    }
    for _ in 0..source.pick(&[0, 0, 1, 2, 4]) {
        change_field(source, &mut definition);
    }
    if source.once_in(2000) {
        let letters = (0..source.pick(&[300, 5_000, 60_000])).filter_map(|at| char::from_u32(0x4e00 + at));
        definition.axiom = letters.collect();
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
