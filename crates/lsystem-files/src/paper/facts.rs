//! The parts of a typeset system beside its grammar: numbers, and the meanings of symbols.

use lsystem_base::number::number;
use lsystem_drawing::System;
use lsystem_syntax::overrides::entries;
use lsystem_syntax::{Definition, Dialect, Grammar, Production, Seen};
use std::collections::HashMap;

/// A quantity with a value.
pub(super) struct Fact {
    /// The name in Markdown.
    pub(super) name: &'static str,
    /// The name in LaTeX's math mode.
    pub(super) tex: &'static str,
    pub(super) values: Vec<f64>,
    pub(super) unit: Unit,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Unit {
    None,
    Degrees,
    Percent,
}

/// The steps, the angles, and what else differs from the usual turtle.
pub(super) fn facts(definition: &Definition, system: &System) -> Vec<Fact> {
    let mut facts = Vec::new();
    let mut add = |name, tex, values: &[f64], unit| facts.push(Fact { name, tex, values: values.to_vec(), unit });
    add("n", "n", &[f64::from(definition.iterations)], Unit::None);
    add("δ", r"\delta", &[definition.angle], Unit::Degrees);
    let angles = [
        ("δ right", r"\delta_{\text{right}}", definition.right_angle),
        ("δ pitch down", r"\delta_{\text{pitch down}}", definition.pitch_down),
        ("δ pitch up", r"\delta_{\text{pitch up}}", definition.pitch_up),
        ("δ roll left", r"\delta_{\text{roll left}}", definition.roll_left),
        ("δ roll right", r"\delta_{\text{roll right}}", definition.roll_right),
    ];
    for (name, tex, angle) in angles {
        if let Some(angle) = angle {
            add(name, tex, &[angle], Unit::Degrees);
        }
    }
    let usual = Definition::default();
    if definition.heading != usual.heading {
        add("start heading", r"\text{start heading}", &[definition.heading], Unit::Degrees);
    }
    if definition.elasticity != 0.0 {
        add("tropism T", r"\vec{T}", &definition.tropism, Unit::None);
        add("elasticity e", "e", &[definition.elasticity], Unit::None);
    }
    if definition.wind[0] != 0.0 {
        add("sway", r"\text{sway}", &definition.wind, Unit::Degrees);
    }
    if definition.length_factor != 1.0 {
        add(
            "length per branch level ×",
            r"\text{length per branch level} \times",
            &[definition.length_factor],
            Unit::None,
        );
    }
    let variations = [
        ("angle variation", r"\text{angle variation}", definition.angle_variation),
        ("length variation", r"\text{length variation}", definition.length_variation),
    ];
    for (name, tex, percent) in variations {
        if percent != 0.0 {
            add(name, tex, &[percent], Unit::Percent);
        }
    }
    if system.is_stochastic() {
        add("seed", r"\text{seed}", &[f64::from(definition.seed)], Unit::None);
    }
    facts
}

impl Fact {
    /// The values as numbers, by `decimal`; several in parentheses.
    pub(super) fn value(&self, decimal: fn(f64) -> String) -> String {
        match &self.values[..] {
            [value] => decimal(*value),
            values => format!("({})", values.iter().map(|value| decimal(*value)).collect::<Vec<_>>().join(", ")),
        }
    }
}

/// The value of a fact in plain text.
pub(super) fn plain(fact: &Fact) -> String {
    let unit = match fact.unit {
        Unit::None => "",
        Unit::Degrees => "°",
        Unit::Percent => " %",
    };
    format!("{}{unit}", fact.value(number))
}

/// Sentences on what symbols mean, if they mean other things than in the book.
pub(super) fn meanings(definition: &Definition) -> Vec<String> {
    let [_, words] = definition.dialect.words();
    let dialect = (definition.dialect != Dialect::Abop).then(|| words.to_owned());
    dialect.into_iter().collect()
}

/// Custom symbols with their actions in words; lines that are not in the usual form are left as one text.
pub(super) fn custom(definition: &Definition) -> Vec<(char, &str)> {
    entries(&definition.overrides).unwrap_or_default()
}

/// The symbols that contexts see, with the word that says so.
pub(super) fn seen(grammar: &Grammar) -> Option<(&'static str, &[char])> {
    match &grammar.seen {
        Seen::All => None,
        Seen::Except(list) => Some(("ignore", list)),
        Seen::Only(list) => Some(("consider", list)),
    }
}

/// Whether the weights of a predecessor do not sum to 1, so that they are no probabilities. Weights that are not
/// constant are left out.
pub(super) fn has_free_weights(grammar: &Grammar) -> bool {
    let values = grammar.values();
    let mut sums: HashMap<_, f64> = HashMap::new();
    for production in &grammar.productions {
        let Production { left, predecessor, right, condition, weight, .. } = production;
        let weight = weight.as_ref().and_then(|weight| values.value(weight));
        if let Some(weight) = weight.filter(|_| condition.is_none()) {
            let names = |patterns: &[lsystem_syntax::Pattern]| -> Vec<_> {
                patterns.iter().map(|pattern| (pattern.symbol, pattern.parameters.len())).collect()
            };
            let own = (predecessor.symbol, predecessor.parameters.len());
            *sums.entry((names(left), own, names(right))).or_default() += weight;
        }
    }
    // Course files with probabilities that do not sum to 1 within this get the remark that they are normalised.
    sums.values().any(|sum| (sum - 1.0).abs() > 1e-5)
}
