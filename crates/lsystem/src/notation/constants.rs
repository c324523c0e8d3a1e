//! Named constants, and what names mean in a production.

use super::expression::Names;
use crate::Kind;
use crate::expr::Meaning;
use crate::notes::{Notes, excerpt, similar};
use core::ops::Range;
use std::collections::BTreeMap;

/// The constants of a text.
#[derive(Debug, Default)]
pub(crate) struct Constants {
    /// By name: places among the defined.
    places: BTreeMap<String, usize>,
    /// In text order.
    defined: Vec<Defined>,
}

#[derive(Debug)]
struct Defined {
    name: String,
    value: f64,
    /// The value as written.
    text: String,
    span: Range<usize>,
    used: bool,
}

impl Constants {
    pub(super) fn contains(&self, name: &str) -> bool {
        self.places.contains_key(name)
    }

    /// Adds a constant: its value, as a number and as written, and where its name stands.
    pub(super) fn define(&mut self, name: String, value: f64, text: String, span: Range<usize>) {
        self.places.insert(name.clone(), self.defined.len());
        self.defined.push(Defined { name, value, text, span, used: false });
    }

    /// Notes what is known at the end only: names that are defined further down, and those that nothing uses.
    pub(super) fn finish(mut self, notes: &mut Notes) {
        notes.each(|d| {
            if let Kind::UnknownConstant { name, below, .. } = &mut d.kind {
                *below = self.meaning(name).is_some();
            }
        });
        for Defined { name, text, span, used, .. } in self.defined {
            if !used {
                notes.add(Kind::ConstantUnused { name: excerpt(&name), value: text }, span);
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
        similar(name, self.places.keys().map(String::as_str)).map(str::to_owned)
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
