//! The changes of `--set` to a file's system.

use lsystem::Definition;
use lsystem::base::say;
use lsystem::base::words::said;
use lsystem::syntax::{FIELDS, FieldSpec, Value};

/// The definition with fields set by name. A name is any of [`FieldSpec::called`]. A value is JSON, or else
/// a text.
///
/// # Errors
/// A message if there is no such field or the field does not take the value.
pub(crate) fn apply(definition: &Definition, settings: &[(String, String)]) -> Result<Definition, String> {
    let mut changed = definition.clone();
    for (name, text) in settings {
        let Some(spec) = FieldSpec::called(name) else {
            return Err(say!("--set: there is no field `{}`; the fields are {}", name, known().join(", ")));
        };
        let value = match serde_json::from_str(text) {
            // A text field takes a number as a text, for example in a name.
            Ok(value) if spec.expected.takes(&value) || (spec.optional && value == Value::Nothing) => value,
            _ => Value::Text(text.clone()),
        };
        if !spec.admits(&value) || !spec.set(&mut changed, &value) {
            return Err(say!("--set {}={}: {} must be {}", name, text, said(spec.label), spec.expected_words()));
        }
    }
    Ok(changed)
}

/// The keys of all fields in files, sorted.
fn known() -> Vec<&'static str> {
    let mut keys: Vec<_> = FIELDS.iter().filter(|spec| spec.is_defined()).map(FieldSpec::key).collect();
    keys.sort_unstable();
    keys
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(settings: &[(&str, &str)]) -> Result<Definition, String> {
        let settings: Vec<_> = settings.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect();
        apply(&Definition { name: "fern".into(), ..Definition::default() }, &settings)
    }

    #[test]
    fn fields_are_set_by_any_of_their_names() {
        let named = set(&[("angle_deg", "25.7"), ("colour_by", "path"), ("shorter", "0.8"), ("name", "7")]).unwrap();
        assert_eq!((named.angle, named.length_factor, named.style.colour_by.name()), (25.7, 0.8, "path"));
        assert_eq!(named.name, "7");
        let lists =
            set(&[("palette", r##"["#123456","red"]"##), ("tropism", "[1,0,0]"), ("paletteHolds", "true")]).unwrap();
        assert_eq!((lists.style.palette.len(), lists.tropism, lists.style.palette_holds), (2, [1.0, 0.0, 0.0], true));
        assert_eq!(set(&[("right_angle_deg", "30")]).unwrap().right_angle, Some(30.0));
        assert_eq!(set(&[("right", "30"), ("right", "null")]).unwrap().right_angle, None);
    }

    #[test]
    fn every_field_is_set_to_what_it_is() {
        let usual = Definition::default();
        for spec in FIELDS.iter().filter(|spec| spec.is_defined()) {
            let value = serde_json::to_string(&spec.get(&usual)).unwrap();
            assert_eq!(apply(&usual, &[(spec.name.to_owned(), value)]).as_ref(), Ok(&usual), "{}", spec.name);
        }
    }

    #[test]
    fn mistakes_are_told() {
        assert!(set(&[("colr", "1")]).unwrap_err().contains("no field `colr`"));
        assert_eq!(
            set(&[("width", "wide")]).unwrap_err(),
            "--set width=wide: Stroke width (steps) must be a number from 0 to 1,000,000,000"
        );
        assert_eq!(
            set(&[("num_iters", "2000")]).unwrap_err(),
            "--set num_iters=2000: Iterations must be a whole number from 0 to 1,000"
        );
        assert!(set(&[("colour_by", "moon")]).unwrap_err().contains("must be one of `symbol`"));
    }
}
