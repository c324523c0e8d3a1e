//! The JSON Schema of files: `www/schema/v1/system.json`. The reader skips unknown keys with a warning; the schema
//! refuses them, so that editors mark them.

use super::default_of;
use expect_test::expect_file;
use lsystem::base::MAX_PALETTE;
use lsystem::read_json;
use lsystem::syntax::fields::Section;
use lsystem::syntax::{Expected, FIELDS, FieldSpec, Value as Held};
use serde_json::{Map, Value, json};

/// The names of colours that files may have.
const COLOURS: [&str; 16] = [
    "aqua", "black", "blue", "fuchsia", "gray", "green", "lime", "maroon", "navy", "olive", "purple", "red", "silver",
    "teal", "white", "yellow",
];

/// A number without a fraction where there is none.
fn bound(value: f64) -> Value {
    if value == value.trunc() && value.abs() < 1e15 { json!(value as i64) } else { json!(value) }
}

fn values(expected: Expected) -> Value {
    match expected {
        Expected::Number => json!({"type": "number"}),
        Expected::Between(low, high) => json!({"type": "number", "minimum": bound(low), "maximum": bound(high)}),
        Expected::Whole(low, high) => json!({"type": "integer", "minimum": low, "maximum": high}),
        Expected::Boolean => json!({"type": "boolean"}),
        Expected::Text(most) => json!({"type": "string", "maxLength": most}),
        Expected::Word(words) => json!({"enum": words}),
        Expected::Colour => {
            assert!(COLOURS.iter().all(|name| Expected::Colour.admits_value(&Held::Text((*name).to_owned()))));
            let hex = json!({"pattern": "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$"});
            json!({"type": "string", "anyOf": [hex, {"enum": COLOURS}]})
        }
        Expected::Palette => {
            json!({"type": "array", "items": values(Expected::Colour), "minItems": 1, "maxItems": MAX_PALETTE})
        }
        Expected::Each(count, each) => {
            json!({"type": "array", "items": values(*each), "minItems": count, "maxItems": count})
        }
        other => panic!("no field expects {other:?}"),
    }
}

/// The forms of fields that a file writes in several ways.
fn forms(spec: &FieldSpec) -> Value {
    let most = json!({"type": "string", "maxLength": if let Expected::Text(most) = spec.expected { most } else { 0 }});
    let lines = json!({"type": "array", "items": {"type": "string"}});
    let symbol = json!({"minLength": 1, "maxLength": 1});
    let by_symbol = |value| json!({"type": "object", "propertyNames": symbol, "additionalProperties": value});
    match spec.name {
        "axiom" => most,
        "rules" => json!({"anyOf": [by_symbol(json!({"$ref": "#/definitions/successor"})), lines, most]}),
        "overrides" => json!({"anyOf": [by_symbol(json!({"type": "string"})), lines, most]}),
        _ => values(spec.expected),
    }
}

fn properties(section: Section) -> Map<String, Value> {
    let here =
        FIELDS.iter().filter_map(|spec| spec.file.filter(|(place, _)| *place == section).map(|file| (spec, file.1)));
    let property = |(spec, key): (&FieldSpec, &str)| {
        let mut schema = forms(spec);
        schema["title"] = json!(spec.label.replace('\u{a0}', " "));
        schema["description"] = json!(spec.help);
        // Defaults of the style depend on the dialect; optional fields have none.
        if section != Section::Style && !spec.optional && !matches!(spec.name, "dialect" | "name") {
            schema["default"] = serde_json::to_value(default_of(spec)).unwrap();
        }
        (key.to_owned(), schema)
    };
    here.map(property).collect()
}

/// An object with these keys. Keys of unused data are of any form, as for the reader.
fn object(properties: &Map<String, Value>) -> Value {
    json!({
        "type": "object",
        "properties": properties,
        "patternProperties": {"^\\$|_old$": {}},
        "additionalProperties": false,
    })
}

fn schema() -> Value {
    let mut file = properties(Section::File);
    file.insert("turtle".into(), object(&properties(Section::Turtle)));
    file.insert("style".into(), object(&properties(Section::Style)));
    file.insert("stochastic".into(), json!({"type": "boolean", "description": "without effect: the rules decide"}));
    let mut schema = object(&file);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("L-system");
    schema["description"] = json!("a system of the L-system playground; written by `cargo xtask tables`, not by hand");
    schema["anyOf"] = ["initial", "rules", "turtle", "style"].map(|key| json!({"required": [key]})).into();
    let outcome = json!({
        "type": "object",
        "properties": {
            "p": {"type": "number", "minimum": 0, "maximum": 1e100, "description": "probability, or weight"},
            "e": {"type": "string", "description": "successor, as plain characters"},
        },
        "required": ["p", "e"],
        "additionalProperties": false,
    });
    let outcomes = json!({"type": "array", "items": outcome, "minItems": 1});
    schema["definitions"] = json!({"successor": {"anyOf": [{"type": "string"}, outcomes]}});
    schema
}

/// The value with the keys of all objects in the order of the alphabet, whatever serde_json is compiled with.
fn sorted(value: Value) -> Value {
    match value {
        Value::Object(members) => {
            let mut members: Vec<_> = members.into_iter().map(|(key, value)| (key, sorted(value))).collect();
            members.sort_by(|a, b| a.0.cmp(&b.0));
            Value::Object(members.into_iter().collect())
        }
        Value::Array(list) => list.into_iter().map(sorted).collect(),
        other => other,
    }
}

#[test]
fn the_schema_of_files_is_that_of_the_fields() {
    let text = serde_json::to_string_pretty(&sorted(schema())).unwrap() + "\n";
    expect_file!["../../../../www/schema/v1/system.json"].assert_eq(&text);
}

/// The schema is tried on the same files by `www/test/unit/schema.test.mjs`.
#[test]
fn the_reader_takes_what_the_schema_accepts_and_tells_what_it_refuses() {
    let files: Value = serde_json::from_str(include_str!("../../../../www/test/unit/schema-files.json")).unwrap();
    let each = |kind: &str| files[kind].as_array().unwrap().clone();
    for right in each("right") {
        let (definition, diagnostics) = read_json(&right["file"].to_string());
        assert!(definition.is_some() && diagnostics.is_empty(), "{}: {diagnostics:?}", right["why"]);
    }
    for wrong in each("wrong") {
        assert!(!read_json(&wrong["file"].to_string()).1.is_empty(), "{}", wrong["why"]);
    }
}
