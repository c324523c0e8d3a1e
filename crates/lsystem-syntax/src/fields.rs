//! Every field of a definition, of its style and of a view: one table.
//!
//! Files, links, the program's `--set`, the page's state and controls, and the tables of the documents are made from it.
//! A new field is a member of [`Definition`] or [`Style`](crate::Style), a row of [`FIELDS`], and a control of the page.

mod table;

pub use table::FIELDS;

use crate::value::Value;
use crate::{Definition, Expected};

/// A field, and all that its readers and writers know of it.
#[derive(Debug)]
pub struct FieldSpec {
    /// Its name in the page's state and for `--set`.
    pub name: &'static str,
    /// Its key in links.
    pub link: &'static str,
    /// The object that holds it in files, and its key there; `None` for what only links hold.
    pub file: Option<(Section, &'static str)>,
    /// Its values.
    pub expected: Expected,
    /// Whether it may be left out, which is `null` in scripts.
    pub optional: bool,
    /// The values under its slider, where it has one.
    pub slider: Option<Slider>,
    /// The unit of its number, as a word; empty where it has none.
    pub unit: &'static str,
    /// What has to be made anew where it changes.
    pub affects: Affects,
    /// What the page calls it.
    pub label: &'static str,
    /// What it is, as a noun phrase.
    pub help: &'static str,
    /// How to read and write it; `None` for what is no part of a [`Definition`].
    access: Option<Access>,
}

/// An object in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The file's own object.
    File,
    /// `turtle`.
    Turtle,
    /// `style`.
    Style,
}

/// What has to be made anew where a field changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Affects {
    /// The drawing, and with it all else.
    Drawing,
    /// The picture of the same segments.
    Look,
    /// Words beside the picture.
    Caption,
}

impl Affects {
    /// Its name for scripts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Drawing => "drawing",
            Self::Look => "look",
            Self::Caption => "caption",
        }
    }
}

/// The values under a slider: ascending, finer where pictures differ most.
#[derive(Clone, Copy, Debug)]
pub struct Slider {
    /// The first value.
    pub from: f64,
    /// Up to which value the distance from one value to the next is how much.
    pub parts: &'static [(f64, f64)],
    /// What an arrow key adds in the field beside it.
    pub arrow: f64,
}

/// How a field is read from and written to a definition.
#[derive(Debug)]
struct Access {
    get: fn(&Definition) -> Value,
    set: fn(&mut Definition, &Value) -> bool,
}

impl FieldSpec {
    /// Its attribute of the `<l-system>` element: its key in links, unless that means something else in HTML.
    #[must_use]
    pub fn attribute(&self) -> &'static str {
        match self.link {
            "title" => "caption",
            "width" => "stroke",
            key => key,
        }
    }

    /// Whether it is a part of a [`Definition`].
    #[must_use]
    pub fn is_defined(&self) -> bool {
        self.access.is_some()
    }

    /// Its value in a definition; `None` for what is no part of one.
    #[must_use]
    pub fn get(&self, definition: &Definition) -> Option<Value> {
        Some((self.access.as_ref()?.get)(definition))
    }

    /// Sets it in a definition, whether or not the value is within the range; `false` where the value is of another type.
    pub fn set(&self, definition: &mut Definition, value: &Value) -> bool {
        self.access.as_ref().is_some_and(|access| (access.set)(definition, value))
    }

    /// Whether a value is within its range.
    #[must_use]
    pub fn admits(&self, value: &Value) -> bool {
        (self.optional && *value == Value::Nothing) || self.expected.admits_value(value)
    }

    /// What it must be, in words.
    #[must_use]
    pub fn wanted(&self) -> String {
        let words = crate::message::expected_words(self.expected);
        if self.optional { words + " or nothing" } else { words }
    }
}

/// The field with this name.
#[must_use]
pub fn field(name: &str) -> Option<&'static FieldSpec> {
    FIELDS.iter().find(|field| field.name == name)
}
