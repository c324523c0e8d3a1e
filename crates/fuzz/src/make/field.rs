//! Random values of fields, from the table of fields.

use super::text::random_pieces;
use crate::Source;
use lsystem::syntax::fields::Section;
use lsystem::syntax::{Expected, FIELDS, FieldSpec, Value};
use lsystem::{Definition, Style};

/// The numbers at which fields behave differently: lengths, factors, shares, and degrees, some of them so near to
/// round ones that a circle does not close.
const USUAL: [f64; 20] = [
    0.0, 0.0, 1.0, 1.0, 0.5, 0.9, 0.999_999, 0.01, 1e-9, -0.2, -1.0, 1.2, 2.0, 5.0, 17.3, -45.0, 90.0, 89.999_999,
    180.0, 100.0,
];

/// A style, each field of which is changed with a probability of a half.
pub(crate) fn style(source: &mut Source<'_>) -> Style {
    let mut definition = Definition::default();
    for field in FIELDS.iter().filter(|field| matches!(field.file, Some((Section::Style, _)))) {
        if source.once_in(2) {
            change(source, field, &mut definition);
        }
    }
    definition.style
}

/// Changes one field, but not the texts and the number of iterations, which decide how long the work takes.
pub(crate) fn change_field(source: &mut Source<'_>, definition: &mut Definition) {
    let is_changed = |field: &&&FieldSpec| !matches!(field.expected, Expected::Text(_)) && field.name != "iterations";
    let fields: Vec<&FieldSpec> = FIELDS.iter().filter(|field| field.is_defined()).filter(|f| is_changed(&f)).collect();
    let field = source.pick(&fields);
    change(source, field, definition);
}

fn change(source: &mut Source<'_>, field: &FieldSpec, definition: &mut Definition) {
    let value = value(source, field.expected);
    assert!(field.set(definition, &value), "{} = {value:?}", field.name);
}

/// A value of the expected type, seldom out of its range.
fn value(source: &mut Source<'_>, expected: Expected) -> Value {
    match expected {
        Expected::Number => number(source, f64::MIN, f64::MAX),
        Expected::Between(low, high) => number(source, low, high),
        Expected::PositiveUpTo(high) => number(source, f64::MIN_POSITIVE, high),
        Expected::Whole(low, high) => Value::Number(source.pick(&[low, high, 0, 1, 7, 1000]).clamp(low, high) as f64),
        Expected::Boolean => Value::Flag(source.once_in(2)),
        Expected::Word(words) => Value::Text(source.pick(words).to_owned()),
        Expected::Colour => colour(source),
        Expected::Palette => {
            let colours = source.pick(&[1, 1, 2, 3, 5, 17, 256]);
            Value::List((0..colours).map(|_| colour(source)).collect())
        }
        Expected::Each(count, each) => Value::List((0..count).map(|_| value(source, *each)).collect()),
        _ => Value::Text(random_pieces(source)),
    }
}

fn number(source: &mut Source<'_>, low: f64, high: f64) -> Value {
    if source.once_in(6) {
        return Value::Number(source.number());
    }
    let fitting: Vec<f64> = USUAL.into_iter().chain([low, high]).filter(|n| (low..=high).contains(n)).collect();
    Value::Number(source.pick(&fitting))
}

fn colour(source: &mut Source<'_>) -> Value {
    Value::Text(format!("#{:06x}", source.word() >> 8))
}
