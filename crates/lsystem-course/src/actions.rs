//! The actions of a definition's symbols.

use lsystem_syntax::overrides::Override;
use lsystem_syntax::{Action, Definition, Dialect, parse_overrides};

pub(crate) struct Actions {
    dialect: Dialect,
    overrides: Vec<Override>,
}

impl Actions {
    pub(crate) fn new(definition: &Definition) -> Self {
        Self { dialect: definition.dialect, overrides: parse_overrides(&definition.overrides).0 }
    }

    pub(crate) fn of(&self, symbol: char) -> &[Action] {
        let own = self.overrides.iter().find(|own| own.symbol == symbol);
        own.map_or_else(|| self.dialect.actions(symbol), |own| &own.actions)
    }
}
