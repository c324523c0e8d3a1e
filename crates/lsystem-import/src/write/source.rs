//! A system as writers see it: its symbols with their actions, and what it needs of a notation.

use super::Refusal;
use lsystem_base::sorted;
use lsystem_base::sorted::set;
use lsystem_base::{say, word};
use lsystem_derive::Letter;
use lsystem_drawing::System;
use lsystem_syntax::{Action, Definition, Grammar, Module, Pattern, Production, Query, Style, Vocabulary};
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};

/// A part of a system that some notations lack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Need {
    Contexts,
    Parameters,
    Conditions,
    Chance,
    Variation,
    /// Productions below `draw:` that are more than actions of symbols.
    Images,
    Space,
    BranchLengths,
    /// Actions of symbols, but not steps, turns and branches in the plane, and looks.
    Acts(Vocabulary),
    /// A tropism, or a sway in the wind.
    Tropism,
    Growth,
    /// Branches that begin in one word and end in another, or brackets that are replaced.
    OpenBranches,
    /// Modules that ask about their place.
    Queries,
    /// Modules that ask about neighbours and light.
    Surroundings,
}

impl Need {
    /// All parts, in the order in which they are refused.
    pub(super) const ALL: [Self; 20] = [
        Self::Contexts,
        Self::Parameters,
        Self::Conditions,
        Self::Chance,
        Self::Variation,
        Self::Images,
        Self::Space,
        Self::BranchLengths,
        Self::Acts(Vocabulary::Scaling),
        Self::Acts(Vocabulary::SwappedTurns),
        Self::Acts(Vocabulary::Polygons),
        Self::Acts(Vocabulary::Circles),
        Self::Acts(Vocabulary::Tubes),
        Self::Acts(Vocabulary::Surfaces),
        Self::Acts(Vocabulary::Cuts),
        Self::Tropism,
        Self::Growth,
        Self::OpenBranches,
        Self::Queries,
        Self::Surroundings,
    ];

    /// The part without which this one cannot be.
    pub(super) fn basis(self) -> Option<Self> {
        match self {
            Self::Conditions | Self::Queries => Some(Self::Parameters),
            Self::Surroundings => Some(Self::Queries),
            _ => None,
        }
    }

    /// A noun phrase.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Contexts => word!("contexts"),
            Self::Parameters => word!("parameters"),
            Self::Conditions => word!("conditions"),
            Self::Chance => word!("random rules"),
            Self::Variation => word!("angles and lengths that vary at random"),
            Self::Images => word!("rules for drawing (draw:)"),
            Self::Space | Self::Acts(Vocabulary::Space) => word!("turns in space"),
            Self::BranchLengths => word!("lengths that change with the branch level"),
            Self::Acts(Vocabulary::Scaling) => word!("symbols that change lengths"),
            Self::Acts(Vocabulary::SwappedTurns) => word!("symbols that swap turns"),
            Self::Acts(Vocabulary::Polygons) => word!("polygons"),
            Self::Acts(Vocabulary::Circles) => word!("circles"),
            Self::Acts(Vocabulary::Tubes) => word!("smooth tubes"),
            Self::Acts(Vocabulary::Surfaces) => word!("Bezier surfaces"),
            Self::Acts(Vocabulary::Cuts) => word!("symbols that cut off a branch"),
            Self::Acts(Vocabulary::Basic | Vocabulary::Looks) => word!("symbols"),
            Self::Tropism => word!("tropism and sway"),
            Self::Growth => word!("partial growth"),
            Self::OpenBranches => word!("branches that begin in one word and end in another"),
            Self::Queries => word!("queries"),
            Self::Surroundings => word!("queries of neighbours and light"),
        }
    }
}

/// A symbol that may occur.
#[derive(Clone, Debug)]
pub(super) struct Symbol {
    pub(super) symbol: char,
    /// The actions with their looks. In plain systems, productions for drawing are part of them.
    pub(super) actions: Vec<Action>,
    /// Whether a production replaces the symbol.
    pub(super) is_replaced: bool,
    /// Whether a context has the symbol.
    pub(super) is_matched: bool,
}

impl Symbol {
    /// Whether the symbol stays as it is, and no production looks at it.
    pub(super) fn is_constant(&self) -> bool {
        !self.is_replaced && !self.is_matched
    }

    /// The actions without colours and widths.
    pub(super) fn shape(&self) -> Vec<Action> {
        self.actions.iter().copied().filter(|action| !action.is_look()).collect()
    }
}

/// A successor with its weight, if it has one.
type Choice<'a> = (Option<f64>, &'a [Module]);

/// The productions of a symbol in a system without contexts and parameters.
#[derive(Clone, Debug)]
pub(super) struct PlainRule<'a> {
    pub(super) symbol: char,
    /// One successor, or several with their weights.
    pub(super) successors: Vec<(f64, &'a [Module])>,
}

/// A compiled definition.
pub(super) struct Source<'a> {
    pub(super) definition: &'a Definition,
    pub(super) system: System,
    /// The grammar without productions that never apply.
    pub(super) grammar: Grammar,
    /// The symbols that may occur, sorted.
    pub(super) symbols: Vec<Symbol>,
}

impl<'a> Source<'a> {
    /// # Errors
    /// The first error of the definition.
    pub(super) fn new(definition: &'a Definition) -> Result<Self, Refusal> {
        let system = System::new(definition).map_err(|problems| {
            let error = problems.first_error();
            Refusal(error.map_or_else(|| say!("The system is wrong"), |problem| problem.message))
        })?;
        let rules = &system.rules;
        let is_plain = rules.is_plain();
        // Symbols of productions for drawing occur in no generation.
        let reached: Vec<bool> = rules.reachable().into_iter().map(|reached| reached || !is_plain).collect();
        let mut grammar = system.grammar.clone();
        let occurs = |pattern: &Pattern| {
            let letter = Letter { symbol: pattern.symbol, arity: u8::try_from(pattern.parameters.len()).ok()? };
            rules.letters.binary_search(&letter).ok().filter(|at| reached[*at])
        };
        grammar.productions.retain(|rule| occurs(&rule.predecessor).is_some());
        if is_plain {
            // The first production decides: it always applies, or it is one of those with a weight.
            let mut decided: HashMap<char, bool> = HashMap::new();
            grammar.productions.retain(|rule| match decided.entry(rule.predecessor.symbol) {
                Entry::Occupied(first) => *first.get() && rule.weight.is_some(),
                Entry::Vacant(first) => {
                    first.insert(rule.weight.is_some());
                    true
                }
            });
        }
        // Productions with a context come first, as ABOP has it. Other programs take the first that applies.
        sorted::sort_by_key(&mut grammar.productions, |rule| !rule.is_context_sensitive());
        let replaced = set(grammar.productions.iter().map(|rule| rule.predecessor.symbol));
        let contexts =
            |rule: &Production| rule.left.iter().chain(&rule.right).map(|own| own.symbol).collect::<Vec<_>>();
        let matched = set(grammar.productions.iter().flat_map(contexts));
        let mut symbols: Vec<Symbol> = Vec::new();
        for ((letter, actions), _) in
            rules.letters.iter().zip(&system.turtle.actions).zip(&reached).filter(|(_, reached)| **reached)
        {
            let symbol = letter.symbol;
            if symbols.last().is_some_and(|last| last.symbol == symbol) {
                continue;
            }
            symbols.push(Symbol {
                symbol,
                actions: actions.clone(),
                is_replaced: replaced.binary_search(&symbol).is_ok(),
                is_matched: matched.binary_search(&symbol).is_ok(),
            });
        }
        if is_plain {
            grammar.images.clear();
        }
        Ok(Self { definition, system, grammar, symbols })
    }

    /// The symbol `symbol`, if it may occur.
    pub(super) fn symbol(&self, symbol: char) -> Option<&Symbol> {
        self.symbols.binary_search_by_key(&symbol, |own| own.symbol).ok().map(|at| &self.symbols[at])
    }

    /// Whether a symbol has such an action.
    pub(super) fn acts(&self, is: impl Fn(Action) -> bool) -> bool {
        self.symbols.iter().any(|symbol| symbol.actions.iter().any(|action| is(*action)))
    }

    /// Whether the system needs this of a notation.
    pub(super) fn needs(&self, need: Need) -> bool {
        let Self { definition, system, grammar, .. } = self;
        let productions = || grammar.productions.iter().chain(&grammar.images);
        match need {
            Need::Contexts => productions().any(Production::is_context_sensitive),
            Need::Conditions => productions().any(|rule| rule.condition.is_some()),
            Need::Parameters => {
                let made = grammar.made().chain(grammar.images.iter().flat_map(|image| &image.successor));
                self.needs(Need::Conditions)
                    || made.into_iter().any(|module| !module.arguments.is_empty())
                    || productions().flat_map(Production::patterns).any(|own| !own.parameters.is_empty())
            }
            Need::Chance => system.has_choices() || grammar.images.iter().any(|image| image.weight.is_some()),
            Need::Variation => definition.angle_variation != 0.0 || definition.length_variation != 0.0,
            Need::Images => !grammar.images.is_empty(),
            Need::Space => system.is_solid(),
            Need::BranchLengths => definition.length_factor != 1.0 && self.acts(|action| action == Action::Push),
            Need::Acts(part) => self.acts(|action| action.row().part == part),
            Need::Tropism => system.turtle.tropism.is_some() || system.turtle.wind.is_some(),
            Need::Growth => definition.growth != 1.0,
            Need::OpenBranches => self.has_open_branches(),
            Need::Queries => self.asks(|_| true),
            Need::Surroundings => self.asks(|query| matches!(query, Query::Crowd | Query::Sky)),
        }
    }

    /// The first part that the system needs and a notation does not speak.
    pub(super) fn lacking(&self, speaks: &[Need]) -> Option<Need> {
        Need::ALL.into_iter().find(|need| !speaks.contains(need) && self.needs(*need))
    }

    /// Whether such a query occurs.
    pub(super) fn asks(&self, is: impl Fn(Query) -> bool) -> bool {
        self.symbols.iter().any(|own| Query::of_symbol(own.symbol).is_some_and(&is))
    }

    fn has_open_branches(&self) -> bool {
        let change = |symbol: char| -> isize {
            let actions = self.symbol(symbol).map_or(&[][..], |own| &own.actions);
            let change = |action: &Action| match action {
                Action::Push => 1,
                Action::Pop => -1,
                _ => 0,
            };
            actions.iter().map(change).sum()
        };
        let is_open = |word: &[Module]| {
            let mut depth = 0;
            let closes_too_much = word.iter().any(|module| {
                depth += change(module.symbol);
                depth < 0
            });
            closes_too_much || depth != 0
        };
        is_open(&self.grammar.axiom)
            || self.grammar.productions.iter().any(|rule| is_open(&rule.successor))
            || self.symbols.iter().any(|symbol| symbol.is_replaced && change(symbol.symbol) != 0)
    }

    /// The productions of a system without contexts and parameters, by symbol.
    pub(super) fn plain_rules(&self) -> Vec<PlainRule<'_>> {
        let values = self.grammar.values();
        let mut by_symbol: BTreeMap<char, Vec<Choice<'_>>> = BTreeMap::new();
        for rule in &self.grammar.productions {
            let weight = rule.weight.as_ref().and_then(|weight| values.value(weight));
            by_symbol.entry(rule.predecessor.symbol).or_default().push((weight, &rule.successor));
        }
        by_symbol.into_iter().map(|(symbol, all)| PlainRule { symbol, successors: decided(&all) }).collect()
    }

    /// The angle of a turn in the plane: degrees counter-clockwise. `None` for other actions.
    pub(super) fn turn(&self, action: Action) -> Option<f64> {
        let Definition { angle, right_angle, .. } = *self.definition;
        match action {
            Action::TurnLeft(own) => Some(own.unwrap_or(angle)),
            Action::TurnRight(own) => Some(-own.unwrap_or(right_angle.unwrap_or(angle))),
            Action::TurnRound => Some(180.0),
            _ => None,
        }
    }

    /// The angle of a right turn.
    pub(super) fn right_angle(&self) -> f64 {
        self.definition.right_angle.unwrap_or(self.definition.angle)
    }

    /// A length of an action, in steps.
    pub(super) fn length(&self, own: Option<f64>) -> f64 {
        let step = self.definition.step;
        match own {
            None if step == 0.0 => 0.0,
            None => 1.0,
            Some(length) if step == 0.0 => length,
            Some(length) => length / step,
        }
    }

    /// The title in one line, without these characters.
    pub(super) fn title(&self, without: &[char]) -> String {
        let kept = |c: char| if c.is_control() || without.contains(&c) { ' ' } else { c };
        self.definition.label().chars().map(kept).collect::<String>().trim().to_owned()
    }

    /// The parts of the definition that the text does not tell, as sentences.
    pub(super) fn left_out(&self, notation: &str) -> Vec<String> {
        let mut found = Vec::new();
        if (Style { auto: false, ..self.definition.style.clone() }) != Style::default() || self.acts(Action::is_look) {
            found.push(say!("Colours and line widths are left out."));
        }
        if self.definition.start != [0.0, 0.0] && notation != "cpfg" {
            found.push(say!("The place of the start is left out."));
        }
        if !self.system.turtle.wires.is_empty() && notation != "text" && notation != "latex" {
            found.push(say!("The outlines of shapes are left out."));
        }
        if self.needs(Need::Chance) && notation != "text" && notation != "latex" {
            found.push(say!("Random choices differ: other programs have random numbers of their own."));
        }
        if notation == "fractint" {
            found.push(say!("The file has no number of iterations: Fractint asks for the order."));
        }
        let is_fine = |angle: f64| (10.0 * angle - (10.0 * angle).round()).abs() > 1e-9;
        if notation == "inkscape" && (is_fine(self.definition.angle) || is_fine(self.right_angle())) {
            found.push(say!("The dialog of Inkscape rounds angles to one decimal."));
        }
        found
    }
}

/// The successors that a symbol can have, with their weights.
fn decided<'a>(all: &[Choice<'a>]) -> Vec<(f64, &'a [Module])> {
    let weighted = all.iter().filter_map(|(weight, word)| Some((weight.filter(|w| *w > 0.0)?, *word)));
    let weighted: Vec<(f64, &[Module])> = weighted.collect();
    if weighted.len() > 1 {
        return weighted;
    }
    let only = weighted.first().map(|first| first.1).or(all.first().map(|first| first.1));
    only.into_iter().map(|word| (1.0, word)).collect()
}

/// A number without an exponent.
pub(super) fn plain_number(value: f64) -> String {
    format!("{value}")
}
