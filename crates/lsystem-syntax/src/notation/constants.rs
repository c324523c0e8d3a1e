//! Named constants, and what names mean in a production.

use super::expression::Names;
use crate::Kind;
use crate::code::Meaning;
use crate::notes::{Notes, excerpt, similar};
use core::ops::Range;
use std::collections::HashMap;

/// Where the value of a named constant stands.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantPlace {
    /// Its name.
    pub name: String,
    /// Its value; `None` where that is wrong.
    pub value: Option<f64>,
    /// The value in the rules, in bytes.
    pub span: Range<usize>,
    /// Whether the value is one number, so that another number may stand in its place.
    pub is_number: bool,
}

/// The constants of a text.
#[derive(Debug, Default)]
pub(crate) struct Constants {
    /// By name: places among the defined.
    places: HashMap<String, usize>,
    /// In text order.
    defined: Vec<Defined>,
}

#[derive(Debug)]
struct Defined {
    value: f64,
    /// The value as written.
    text: String,
    /// Of the name and what follows it up to the value.
    span: Range<usize>,
    place: ConstantPlace,
    used: bool,
}

impl Constants {
    pub(super) fn contains(&self, name: &str) -> bool {
        self.places.contains_key(name)
    }

    /// Adds a constant: its value as written, and where its name stands. One whose value is wrong counts as 1.
    pub(super) fn define(&mut self, place: ConstantPlace, text: String, span: Range<usize>) -> f64 {
        let value = place.value.unwrap_or(1.0);
        self.places.insert(place.name.clone(), self.defined.len());
        self.defined.push(Defined { value, text, span, place, used: false });
        value
    }

    pub(crate) fn into_places(self) -> Vec<ConstantPlace> {
        self.defined.into_iter().map(|constant| constant.place).collect()
    }

    /// Notes what is known at the end only: names that are defined further down, and those that nothing uses.
    pub(super) fn finish(mut self, notes: &mut Notes) {
        notes.each(|d| {
            if let Kind::UnknownConstant { name, below, .. } = &mut d.kind {
                *below = self.meaning(name).is_some();
            }
        });
        for Defined { place, text, span, used, .. } in self.defined {
            if !used {
                notes.add(Kind::ConstantUnused { name: excerpt(&place.name), value: text }, span);
            }
        }
    }
}

impl Names for Constants {
    fn meaning(&mut self, name: &str) -> Option<Meaning> {
        let constant = &mut self.defined[*self.places.get(name)?];
        constant.used = true;
        Some(Meaning::Constant(constant.value))
    }

    fn similar(&self, name: &str) -> Option<String> {
        similar(name, self.defined.iter().map(|constant| constant.place.name.as_str())).map(str::to_owned)
    }
}

/// The names in a production: its parameters, then constants.
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
