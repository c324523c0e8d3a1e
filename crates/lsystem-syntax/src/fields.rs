//! The table of all fields of a definition, its style and a view.
//!
//! Files, links, the program's `--set`, the page's state and controls, and the tables in the documents are made from
//! the table. A new field needs a member of [`Definition`] or [`Style`](crate::Style), a row of [`FIELDS`], and a
//! control on the page.

mod table;

pub use table::FIELDS;

use crate::value::Value;
use crate::{Definition, Diagnostic, Expected};
use lsystem_base::say;
use lsystem_base::words::said;

/// One field: a row of [`FIELDS`].
#[derive(Debug)]
pub struct FieldSpec {
    /// The field's name in the page's state and for `--set`.
    pub name: &'static str,
    /// The field's key in links.
    pub link: &'static str,
    /// The object that holds the field in files, and the key there; `None` for a field of links only.
    pub file: Option<(Section, &'static str)>,
    /// The field's type and range.
    pub expected: Expected,
    /// Whether the field may be left out; scripts write `null`.
    pub optional: bool,
    /// The values of the slider, if the field has one.
    pub slider: Option<Slider>,
    /// The unit of a number, as a word; empty if there is none.
    pub unit: &'static str,
    /// The output that depends on the field.
    pub affects: Affects,
    /// The field's label on the page.
    pub label: &'static str,
    /// A description, as a noun phrase.
    pub help: &'static str,
    /// Access to the member of a [`Definition`]; `None` for a field of a view.
    access: Option<Access>,
}

/// An object in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The top level of the file.
    File,
    /// `turtle`.
    Turtle,
    /// `style`.
    Style,
}

/// The output that must be remade after a field changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Affects {
    /// The drawing, and all output made from it.
    Drawing,
    /// The picture of the same segments.
    Look,
    /// Text beside the picture.
    Caption,
}

impl Affects {
    /// The name for scripts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Drawing => "drawing",
            Self::Look => "look",
            Self::Caption => "caption",
        }
    }
}

/// The values of a slider: ascending, in smaller steps where pictures differ most.
#[derive(Clone, Copy, Debug)]
pub struct Slider {
    /// The first value.
    pub from: f64,
    /// Pairs of an upper bound and the step between values up to that bound, ascending.
    pub parts: &'static [(f64, f64)],
    /// The step of an arrow key in the number field beside the slider.
    pub arrow: f64,
}

/// Functions that read and write a field of a definition.
#[derive(Debug)]
struct Access {
    get: fn(&Definition) -> Value,
    set: fn(&mut Definition, &Value) -> bool,
}

impl FieldSpec {
    /// The field of a definition with this name: that of the page (`colourBy`), of files (`colour_by`) or of links
    /// (`colour`), in this order.
    #[must_use]
    pub fn called(name: &str) -> Option<&'static Self> {
        let by = |of: fn(&Self) -> &str| FIELDS.iter().find(|spec| spec.is_defined() && of(spec) == name);
        by(|spec| spec.name).or_else(|| by(Self::key)).or_else(|| by(|spec| spec.link))
    }

    /// The field's key in files; empty for a field of links only.
    #[must_use]
    pub fn key(&self) -> &'static str {
        self.file.map_or("", |(_, key)| key)
    }

    /// The field's attribute of the `<l-system>` element: the key in links, unless HTML gives the key another meaning.
    #[must_use]
    pub fn attribute(&self) -> &'static str {
        match self.link {
            "title" => "caption",
            "width" => "stroke",
            key => key,
        }
    }

    /// Whether the field is part of a [`Definition`].
    #[must_use]
    pub fn is_defined(&self) -> bool {
        self.access.is_some()
    }

    /// The field's value in a definition; `None` if the field is not part of a definition.
    #[must_use]
    pub fn get(&self, definition: &Definition) -> Option<Value> {
        Some((self.access.as_ref()?.get)(definition))
    }

    /// Sets the field in a definition without checking its range. Returns `false` if the value has another type or the
    /// field is not part of a definition.
    pub fn set(&self, definition: &mut Definition, value: &Value) -> bool {
        self.access.as_ref().is_some_and(|access| (access.set)(definition, value))
    }

    /// Whether a value has the field's type and is within its range.
    #[must_use]
    pub fn admits(&self, value: &Value) -> bool {
        (self.optional && *value == Value::Nothing) || self.expected.admits_value(value)
    }

    /// The error for a value that the field does not admit.
    #[must_use]
    pub fn out_of_range(&self) -> Diagnostic {
        Diagnostic::error(say!("{} must be {}", said(self.label), self.expected.words()))
    }

    /// The field's type and range in words.
    #[must_use]
    pub fn expected_words(&self) -> String {
        let words = self.expected.words();
        if self.optional { say!("{} or nothing", words) } else { words }
    }
}

/// The field with this name, if any.
#[must_use]
pub fn field(name: &str) -> Option<&'static FieldSpec> {
    FIELDS.iter().find(|field| field.name == name)
}
