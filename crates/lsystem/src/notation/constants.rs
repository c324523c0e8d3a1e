//! Named constants, and what names mean in a production.

use super::expression::Names;
use crate::Kind;
use crate::expr::Meaning;
use crate::notes::{Notes, excerpt, similar};
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};

/// The constants of a text.
#[derive(Debug, Default)]
pub(crate) struct Constants {
    values: BTreeMap<String, f64>,
    /// In text order.
    defined: Vec<Defined>,
    used: BTreeSet<String>,
}

#[derive(Debug)]
struct Defined {
    name: String,
    value: String,
    span: Range<usize>,
}

impl Constants {
    pub(super) fn contains(&self, name: &str) -> bool {
        self.values.contains_key(name)
    }

    /// Adds a constant: its value, as a number and as written, and where its name stands.
    pub(super) fn define(&mut self, name: String, value: f64, text: String, span: Range<usize>) {
        self.values.insert(name.clone(), value);
        self.defined.push(Defined { name, value: text, span });
    }

    /// Notes what is known at the end only: names that are defined further down, and those that nothing uses.
    pub(super) fn finish(mut self, notes: &mut Notes) {
        notes.each(|d| {
            if let Kind::UnknownConstant { name, below, .. } = &mut d.kind {
                *below = self.meaning(name).is_some();
            }
        });
        for Defined { name, value, span } in self.defined {
            if !self.used.contains(&name) {
                notes.add(Kind::ConstantUnused { name: excerpt(&name), value }, span);
            }
        }
    }
}

impl Names for Constants {
    fn meaning(&mut self, name: &str) -> Option<Meaning> {
        let value = self.values.get(name).copied()?;
        if !self.used.contains(name) {
            self.used.insert(name.to_owned());
        }
        Some(Meaning::Constant(value))
    }

    fn similar(&self, name: &str) -> Option<String> {
        similar(name, self.values.keys().map(String::as_str)).map(str::to_owned)
    }
}

/// The names in a production: its parameters, then constants.
pub(super) struct Scope<'a> {
    pub(super) parameters: BTreeSet<&'a str>,
    pub(super) constants: &'a mut Constants,
}

impl Names for Scope<'_> {
    fn meaning(&mut self, name: &str) -> Option<Meaning> {
        if self.parameters.contains(name) { Some(Meaning::Slot(0)) } else { self.constants.meaning(name) }
    }

    fn similar(&self, name: &str) -> Option<String> {
        let own = similar(name, self.parameters.iter().copied()).map(str::to_owned);
        own.or_else(|| self.constants.similar(name))
    }
}
