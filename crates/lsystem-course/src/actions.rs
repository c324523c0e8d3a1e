//! The actions of a definition's symbols.

use lsystem_syntax::{Action, Definition, Dialect, parse_overrides};
use std::collections::HashMap;

pub(crate) struct Actions {
    dialect: Dialect,
    overrides: HashMap<char, Vec<Action>>,
}

impl Actions {
    pub(crate) fn new(definition: &Definition) -> Self {
        let overrides = parse_overrides(&definition.overrides).0.into_iter();
        let overrides = overrides.map(|own| (own.symbol, own.actions)).collect();
        Self { dialect: definition.dialect, overrides }
    }

    pub(crate) fn of(&self, symbol: char) -> &[Action] {
        self.overrides.get(&symbol).map_or_else(|| self.dialect.actions(symbol), Vec::as_slice)
    }
}
