//! What `--set` changes in a file's system.

use lsystem::Definition;
use serde_json::{Map, Value};

/// The system with these fields, by name, at these values. Names are those of files (`colour_by`, `angle_deg`) and of
/// the page (`colourBy`, `angle`); a value is JSON, or a text where it is none.
///
/// # Errors
/// In words, where there is no such field, or it takes no such value.
pub(crate) fn apply(definition: &Definition, settings: &[(String, String)]) -> Result<Definition, String> {
    let fields = || match serde_json::to_value(definition) {
        Ok(Value::Object(fields)) => fields,
        _ => Map::new(),
    };
    let mut all = fields();
    for (name, text) in settings {
        let field = field_name(name);
        let Some(value) = all.get_mut(&field) else {
            let mut known: Vec<String> = fields().keys().cloned().collect();
            known.sort();
            return Err(format!("--set: there is no `{name}`; there are {}", known.join(", ")));
        };
        *value = match serde_json::from_str(text) {
            Ok(json) if !value.is_string() => json,
            _ => Value::String(text.clone()),
        };
        read(&all).map_err(|error| format!("--set {name}={text}: {error}"))?;
    }
    read(&all).map_err(|error| error.to_string())
}

fn read(fields: &Map<String, Value>) -> serde_json::Result<Definition> {
    // The look is read as a value of its own.
    let style = serde_json::from_value(Value::Object(fields.clone()))?;
    Ok(Definition { style, ..serde_json::from_value(Value::Object(fields.clone()))? })
}

/// The name as the page has it.
fn field_name(name: &str) -> String {
    match name {
        "initial" => "axiom".to_owned(),
        "num_iters" => "iterations".to_owned(),
        _ => {
            let mut words = name.trim_end_matches("_deg").split('_');
            let first = words.next().unwrap_or_default().to_owned();
            words.fold(first, |name, word| {
                let mut letters = word.chars();
                let capital = letters.next().map(|letter| letter.to_ascii_uppercase());
                name + &capital.into_iter().chain(letters).collect::<String>()
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(settings: &[(&str, &str)]) -> Result<Definition, String> {
        let settings: Vec<_> = settings.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect();
        apply(&Definition { name: "fern".into(), ..Definition::default() }, &settings)
    }

    #[test]
    fn fields_are_set_by_either_name() {
        let named =
            set(&[("angle_deg", "25.7"), ("colour_by", "path"), ("length_factor", "0.8"), ("name", "7")]).unwrap();
        assert_eq!((named.angle, named.length_factor, named.style.colour_by.name()), (25.7, 0.8, "path"));
        assert_eq!(named.name, "7");
        let lists =
            set(&[("palette", r##"["#123456","red"]"##), ("tropism", "[1,0,0]"), ("paletteHolds", "true")]).unwrap();
        assert_eq!((lists.style.palette.len(), lists.tropism, lists.style.palette_holds), (2, [1.0, 0.0, 0.0], true));
        assert_eq!(set(&[("right_angle_deg", "30")]).unwrap().right_angle, Some(30.0));
    }

    #[test]
    fn mistakes_are_told() {
        assert!(set(&[("colr", "1")]).unwrap_err().contains("no `colr`"));
        assert!(set(&[("width", "wide")]).unwrap_err().starts_with("--set width=wide"));
        assert!(set(&[("colour_by", "moon")]).unwrap_err().contains("moon"));
    }
}
