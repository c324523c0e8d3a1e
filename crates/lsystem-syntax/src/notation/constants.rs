//! Named constants, and the meaning of names in a production.

use super::expression::Names;
use crate::Kind;
use crate::code::Meaning;
use crate::notes::{DiagnosticList, excerpt, similar};
use core::ops::Range;
use lsystem_base::say;
use std::collections::HashMap;

/// A named constant and the place of its value.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantPlace {
    /// The constant's name.
    pub name: String,
    /// The constant's value; `None` if it is wrong.
    pub value: Option<f64>,
    /// The span of the value in the rules, in bytes.
    pub span: Range<usize>,
    /// Whether the value is a literal number, so that a control may replace it.
    pub is_number: bool,
}

/// The constants of a text.
#[derive(Debug, Default)]
pub(crate) struct Constants {
    /// By name: the index in `defined`.
    places: HashMap<String, usize>,
    /// In text order.
    defined: Vec<Defined>,
    /// Shapes and curves.
    others: Vec<DefinedOther>,
}

#[derive(Debug)]
struct DefinedOther {
    name: String,
    meaning: Meaning,
    /// The span of the name, in bytes.
    span: Range<usize>,
    used: bool,
}

#[derive(Debug)]
struct Defined {
    value: f64,
    /// The value as written.
    text: String,
    /// From the name up to the value, in bytes.
    span: Range<usize>,
    place: ConstantPlace,
    used: bool,
}

impl Constants {
    pub(super) fn contains(&self, name: &str) -> bool {
        self.places.contains_key(name) || self.others.iter().any(|other| other.name == name)
    }

    /// Adds a shape or a curve with the span of its name.
    pub(super) fn other(&mut self, name: String, meaning: Meaning, span: Range<usize>) {
        self.others.push(DefinedOther { name, meaning, span, used: false });
    }

    /// Adds a constant with its value as written and the span of its name, and returns its value. A wrong value counts
    /// as 1.
    pub(super) fn define(&mut self, place: ConstantPlace, text: String, span: Range<usize>) -> f64 {
        let value = place.value.unwrap_or(1.0);
        self.places.insert(place.name.clone(), self.defined.len());
        self.defined.push(Defined { value, text, span, place, used: false });
        value
    }

    pub(crate) fn into_places(self) -> Vec<ConstantPlace> {
        self.defined.into_iter().map(|constant| constant.place).collect()
    }

    /// Completes the notes after all lines are read: names that a later line defines, and unused constants.
    pub(super) fn finish(mut self, notes: &mut DiagnosticList) {
        notes.each(|d| {
            if let Kind::UnknownName { name, may_be_parameter } = &d.kind
                && self.meaning(name).is_some()
            {
                if !may_be_parameter {
                    d.message = say!("There is no constant `{}` above this line", name);
                }
                (d.hint, d.fix) = (Some(say!("Move the definition of `{}` up.", name)), None);
            }
        });
        for DefinedOther { name, meaning, span, .. } in self.others.into_iter().filter(|other| !other.used) {
            let (name, is_curve) = (excerpt(&name), matches!(meaning, Meaning::Curve(_)));
            if is_curve {
                notes.warn(span, say!("Nothing uses the curve `{}`", name), say!("Use it as in `{}(x)`.", name));
            } else {
                let hint = say!("Use it as in `inside({}, x, y, z)`.", name);
                notes.warn(span, say!("Nothing uses the shape `{}`", name), hint);
            }
        }
        for Defined { place, text, span, used, .. } in self.defined {
            if !used {
                let name = excerpt(&place.name);
                let hint = match name.as_str() {
                    "angle" | "delta" | "δ" | "n" | "iterations" | "depth" | "generations" | "order" => {
                        say!("The angle and the number of iterations have fields of their own.")
                    }
                    _ if name.chars().nth(1).is_none() => say!("If a rule is meant, write `{} -> {}`.", name, text),
                    _ => say!("Use it in a rule, or remove it."),
                };
                notes.warn(span, say!("Nothing uses the constant `{}`", name), hint);
            }
        }
    }
}

impl Names for Constants {
    fn meaning(&mut self, name: &str) -> Option<Meaning> {
        if let Some(other) = self.others.iter_mut().find(|other| other.name == name) {
            other.used = true;
            return Some(other.meaning.clone());
        }
        let constant = &mut self.defined[*self.places.get(name)?];
        constant.used = true;
        Some(Meaning::Constant(constant.value))
    }

    fn similar(&self, name: &str) -> Option<String> {
        similar(name, self.defined.iter().map(|constant| constant.place.name.as_str())).map(str::to_owned)
    }
}

/// The names in a production. Parameters hide constants of the same name.
pub(super) struct Scope<'a> {
    /// Sorted.
    pub(super) parameters: Vec<&'a str>,
    pub(super) constants: &'a mut Constants,
}

impl Names for Scope<'_> {
    fn meaning(&mut self, name: &str) -> Option<Meaning> {
        if self.parameters.binary_search(&name).is_ok() { Some(Meaning::Slot(0)) } else { self.constants.meaning(name) }
    }

    fn similar(&self, name: &str) -> Option<String> {
        let own = similar(name, self.parameters.iter().copied()).map(str::to_owned);
        own.or_else(|| self.constants.similar(name))
    }
}
