//! The classes of a definition's characters, for syntax colours, and its constants, for changing their values.

use lsystem::Definition;
use lsystem::syntax::{Field, byte_offset, classify, site, utf16_letters, utf16_span};
use serde::Serialize;
use ts_rs::TS;

/// The texts as class letters ([`lsystem::syntax::Class`]), one for each UTF-16 unit, and the constants.
#[derive(Debug, Serialize, TS)]
#[ts(rename = "Notation")]
pub struct TextClasses {
    /// The classes of the axiom.
    pub axiom: String,
    /// The classes of the rules.
    pub rules: String,
    /// The classes of the custom symbols.
    pub overrides: String,
    /// The named constants of the rules.
    pub constants: Vec<ConstantSpan>,
}

/// A named constant and the place of its value in the rules, in UTF-16 units.
#[derive(Debug, PartialEq, Serialize, TS)]
pub struct ConstantSpan {
    /// The name.
    pub name: String,
    /// Null if the value is not valid.
    pub value: Option<f64>,
    /// The start of the value's text.
    pub start: usize,
    /// The end of the value's text.
    pub end: usize,
    /// Whether the value is one number, so that another number may replace it.
    pub number: bool,
}

/// The texts and constants of a definition, valid or not.
#[must_use]
pub fn notation(definition: &Definition) -> TextClasses {
    let classes = classify(definition);
    let Definition { axiom, rules, overrides, .. } = definition;
    let constant = |place: lsystem::syntax::ConstantPlace| {
        let span = utf16_span(rules, place.span);
        ConstantSpan { name: place.name, value: place.value, start: span.start, end: span.end, number: place.is_number }
    };
    TextClasses {
        axiom: utf16_letters(axiom, &classes.axiom),
        rules: utf16_letters(rules, &classes.rules),
        overrides: utf16_letters(overrides, &classes.overrides),
        constants: classes.constants.into_iter().map(constant).collect(),
    }
}

/// The place of a written module.
#[derive(Debug, PartialEq, Eq, Serialize, TS)]
#[ts(rename = "Site")]
pub struct ModulePlace {
    /// The number of the production (0-based); null for a module of the axiom.
    pub production: Option<usize>,
    /// The symbol that the production replaces; null for a module of the axiom.
    pub predecessor: Option<char>,
    /// The number of the module in the successor or in the axiom (0-based).
    pub position: usize,
}

/// The module at a UTF-16 offset into a text, [`Field::Axiom`] or [`Field::Rules`]; `None` for other text.
#[must_use]
pub fn site_of(definition: &Definition, field: Field, offset: usize) -> Option<ModulePlace> {
    let Definition { axiom, rules, .. } = definition;
    let text = if field == Field::Axiom { axiom } else { rules };
    let found = site(axiom, rules, field, byte_offset(text, offset))?;
    let (production, predecessor) = found.production.unzip();
    Some(ModulePlace { production, predecessor, position: found.position })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn definition(rules: &str) -> Definition {
        Definition { axiom: "[F".into(), rules: rules.into(), overrides: "G: move".into(), ..Definition::default() }
    }

    #[test]
    fn texts_are_classed_by_utf16_unit() {
        let found = notation(&definition("// 🌿\nr = 0.9\nF = "));
        assert_eq!([&*found.axiom, &*found.rules, &*found.overrides], ["b_", "ccccc_k_m_nnn_k_m_", "pm_____"]);
        let constant = ConstantSpan { name: "r".into(), value: Some(0.9), start: 10, end: 13, number: true };
        assert_eq!(found.constants[0], constant);
    }

    #[test]
    fn modules_are_found_at_utf16_offsets() {
        let definition = definition("// 🌿\nF -> F[+F]G");
        let at = |offset| site_of(&definition, Field::Rules, offset);
        assert_eq!(at(15), Some(ModulePlace { production: Some(0), predecessor: Some('F'), position: 4 }));
        assert_eq!(at(2), None);
        let axiom = site_of(&definition, Field::Axiom, 1);
        assert_eq!(axiom, Some(ModulePlace { production: None, predecessor: None, position: 1 }));
    }
}
