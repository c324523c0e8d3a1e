//! An L-system as its author wrote it: one flat value that files, links, controls and undo share.

use crate::fields::{FIELDS, field};
use crate::{Diagnostic, Dialect, Field, Style};
use lsystem_base::say;
use serde::de::{self, Deserialize, Deserializer, IgnoredAny, MapAccess, Visitor};
use serde::ser::{Serialize, Serializer};

/// An L-system as text and plain numbers: everything that decides its picture. `System::new` compiles a definition and
/// reports its problems. In scripts a definition is an object with the names of [`FIELDS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// A short name, unique within its folder.
    pub name: String,
    /// A title for people.
    pub title: String,
    /// Where the system was published.
    pub source: String,
    /// Notes for readers.
    pub notes: String,
    /// The axiom, in the notation.
    pub axiom: String,
    /// Productions and constants, in the notation, one on each line.
    pub rules: String,
    /// Derivation steps, 0 to 1,000.
    pub iterations: u32,
    /// The angle of a left turn, in degrees, counter-clockwise; also of a right turn unless `right_angle` is given.
    pub angle: f64,
    /// The angle of a right turn, in degrees, clockwise.
    pub right_angle: Option<f64>,
    /// The angle of pitching down, in degrees; `angle` unless given.
    pub pitch_down: Option<f64>,
    /// The angle of pitching up; as `pitch_down` unless given.
    pub pitch_up: Option<f64>,
    /// The angle of rolling left, in degrees; `angle` unless given.
    pub roll_left: Option<f64>,
    /// The angle of rolling right; as `roll_left` unless given.
    pub roll_right: Option<f64>,
    /// The heading at the start: degrees counter-clockwise from +x.
    pub heading: f64,
    /// The step length, in model units.
    pub step: f64,
    /// Where the turtle starts, in model units, y up.
    pub start: [f64; 2],
    /// The vector that branches bend towards: x, y and z (towards the viewer), of any length (`Tropism`).
    pub tropism: [f64; 3],
    /// The bending of branches, in radians per segment for a `tropism` of length 1 across the heading; 0 for none.
    pub elasticity: f64,
    /// The sway of branches in the wind: its strength and its phase, in degrees (`Wind`).
    pub wind: [f64; 2],
    /// The table of the symbols' actions.
    pub dialect: Dialect,
    /// Custom symbols, one on each line: `G: move`, `B: turn left 90, draw 10`. They replace the dialect's actions.
    pub overrides: String,
    /// Surfaces that symbols draw, one on each line (`parse_surfaces`).
    pub surfaces: String,
    /// The factor of all lengths for each branch level.
    pub length_factor: f64,
    /// The largest random change of an angle, in percent of the angle, 0 to 100.
    pub angle_variation: f64,
    /// The largest random change of a length, in percent of the length, 0 to 100.
    pub length_variation: f64,
    /// The growth of the modules that the last derivation step made, from 0 to 1 (`Turtle::growth`).
    pub growth: f64,
    /// The seed of all random choices.
    pub seed: u32,
    /// Colours and widths. In scripts their fields stand beside the others, not in an object of their own.
    pub style: Style,
}

impl Definition {
    /// The title, or the name if the title is empty.
    #[must_use]
    pub fn label(&self) -> &str {
        if self.title.is_empty() { &self.name } else { &self.title }
    }

    /// The text of a diagnostic's [`Field`]; `None` for [`Field::File`] and [`Field::Numbers`].
    #[must_use]
    pub fn text(&self, field: Field) -> Option<&str> {
        match field {
            Field::Axiom => Some(&self.axiom),
            Field::Rules => Some(&self.rules),
            Field::Overrides => Some(&self.overrides),
            Field::File | Field::Numbers => None,
        }
    }
}

impl Definition {
    /// A diagnostic for each field that is out of its range, in the order of [`FIELDS`].
    #[must_use]
    pub fn out_of_range(&self) -> Vec<Diagnostic> {
        let wrong = FIELDS.iter().filter(|spec| spec.get(self).is_some_and(|value| !spec.admits(&value)));
        let place = |name: &str| match name {
            "axiom" => Field::Axiom,
            "rules" => Field::Rules,
            "overrides" => Field::Overrides,
            _ => Field::Numbers,
        };
        wrong.map(|spec| spec.out_of_range().at(place(spec.name), 0..0)).collect()
    }
}

/// The page's type of definitions is written from the table of fields: `www/js/tables.js`.
#[cfg(feature = "typescript")]
impl ts_rs::TS for Definition {
    type WithoutGenerics = Self;
    type OptionInnerType = Self;

    fn name(_: &ts_rs::Config) -> String {
        "import('./tables.js').Definition".to_owned()
    }

    fn inline(config: &ts_rs::Config) -> String {
        Self::name(config)
    }
}

impl Serialize for Definition {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(FIELDS.iter().filter_map(|spec| Some((spec.name, spec.get(self)?))))
    }
}

impl<'de> Deserialize<'de> for Definition {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(DefinitionVisitor)
    }
}

/// Reads an object of fields. Missing fields keep their defaults, unknown fields are skipped.
struct DefinitionVisitor;

impl<'de> Visitor<'de> for DefinitionVisitor {
    type Value = Definition;

    fn expecting(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str("an object with the fields of a definition")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Definition, A::Error> {
        let mut definition = Definition::default();
        while let Some(name) = map.next_key::<String>()? {
            let Some(spec) = field(&name).filter(|spec| spec.is_defined()) else {
                map.next_value::<IgnoredAny>()?;
                continue;
            };
            if !spec.set(&mut definition, &map.next_value()?) {
                return Err(de::Error::custom(say!("`{}` must be {}", name, spec.expected_words())));
            }
        }
        Ok(definition)
    }
}

impl Default for Definition {
    fn default() -> Self {
        Self {
            name: String::new(),
            title: String::new(),
            source: String::new(),
            notes: String::new(),
            axiom: String::new(),
            rules: String::new(),
            iterations: 1,
            angle: 0.0,
            right_angle: None,
            pitch_down: None,
            pitch_up: None,
            roll_left: None,
            roll_right: None,
            heading: 90.0,
            step: 1.0,
            start: [0.0, 0.0],
            tropism: [0.0, -1.0, 0.0],
            elasticity: 0.0,
            wind: [0.0, 0.0],
            dialect: Dialect::default(),
            overrides: String::new(),
            surfaces: String::new(),
            length_factor: 1.0,
            angle_variation: 0.0,
            length_variation: 0.0,
            growth: 1.0,
            seed: 0,
            style: Style::default(),
        }
    }
}
