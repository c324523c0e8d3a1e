//! A system ready for derivation and drawing.

use crate::notation::{self, Reading};
use crate::notes::Notes;
use crate::{
    Action, Definition, Diagnostic, Dialect, Field, Grammar, Heading, Kind, LimitName, MAX_ITERATIONS, MAX_LETTERS,
    MAX_PALETTE, Override, Program, Quantity, Style, Turtle, Undrawn, parse_overrides,
};
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};

/// A checked and compiled [`Definition`].
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// What its texts say.
    pub grammar: Grammar,
    /// The grammar made ready for derivation.
    pub program: Program,
    /// What its symbols do.
    pub turtle: Turtle,
    /// Colours and widths.
    pub style: Style,
    /// Selects among the outcomes of stochastic productions.
    pub seed: u32,
}

impl System {
    /// Checks and compiles `definition`, and tells all that is wrong or doubtful in it at once. There is a system
    /// unless a diagnostic is an error.
    #[must_use]
    pub fn new(definition: &Definition) -> (Option<Self>, Vec<Diagnostic>) {
        let mut reading = notation::read(&definition.axiom, &definition.rules);
        let (overrides, mut diagnostics) = parse_overrides(&definition.overrides);
        diagnostics.splice(0..0, core::mem::take(&mut reading.diagnostics));
        diagnostics.extend(check_numbers(definition));
        if diagnostics.iter().any(Diagnostic::is_error) {
            return (None, diagnostics);
        }
        if letters(&reading.grammar) > MAX_LETTERS {
            let kind = Kind::Limit { limit: LimitName::Letters, value: MAX_LETTERS as u64, largest: None };
            diagnostics.push(Diagnostic { kind, field: Field::Rules, span: 0..0 });
            return (None, diagnostics);
        }
        let program = Program::new(&reading.grammar);
        let overrides = overrides.iter().map(|o: &Override| (o.symbol, o.actions.as_slice())).collect();
        let actions = Actions { dialect: definition.dialect, overrides };
        diagnostics.extend(doubts(&reading, &program, &actions));
        let turtle = Turtle {
            actions: program.alphabet.iter().map(|&symbol| actions.of(symbol).to_vec()).collect(),
            left: Heading::from_degrees(definition.angle),
            right: Heading::from_degrees(definition.right_angle.unwrap_or(definition.angle)),
            heading: Heading::from_degrees(definition.heading),
            start: definition.start,
            step: definition.step,
            width: definition.style.width,
        };
        let grammar = reading.grammar;
        let system = Self { grammar, program, turtle, style: definition.style.clone(), seed: definition.seed };
        (Some(system), diagnostics)
    }
}

fn letters(grammar: &Grammar) -> usize {
    let modules = (grammar.axiom.iter())
        .chain(grammar.productions.iter().flat_map(|p| p.successor.iter().chain([&p.predecessor])));
    modules.map(|m| m.symbol).collect::<BTreeSet<_>>().len()
}

/// What symbols do: an override where there is one, the dialect otherwise.
struct Actions<'a> {
    dialect: Dialect,
    overrides: BTreeMap<char, &'a [Action]>,
}

impl Actions<'_> {
    fn of(&self, symbol: char) -> &[Action] {
        match self.overrides.get(&symbol) {
            Some(actions) => actions,
            None => self.dialect.actions(symbol),
        }
    }

    /// What the dialect means by `symbol` without drawing it.
    fn not_drawn(&self, symbol: char) -> Option<Undrawn> {
        if self.overrides.contains_key(&symbol) {
            return None;
        }
        match (self.dialect, symbol) {
            (Dialect::Abop, '&' | '^' | '\\' | '/' | '$') | (Dialect::Practical, '&' | '^' | '<' | '>') => {
                Some(Undrawn::ThreeD)
            }
            (Dialect::Abop, '{' | '.' | '}') => Some(Undrawn::Polygon),
            (Dialect::Abop, '%') => Some(Undrawn::Cut),
            _ => None,
        }
    }
}

fn check_numbers(definition: &Definition) -> Vec<Diagnostic> {
    let mut notes = Notes::new(Field::Numbers);
    let mut add = |kind| notes.add(kind, 0..0);
    let style = &definition.style;
    let numbers = [
        (Quantity::Angle, definition.angle),
        (Quantity::RightAngle, definition.right_angle.unwrap_or(0.0)),
        (Quantity::Heading, definition.heading),
        (Quantity::Step, definition.step),
        (Quantity::Start, definition.start[0]),
        (Quantity::Start, definition.start[1]),
        (Quantity::Width, style.width),
        (Quantity::MinWidth, style.min_width),
    ];
    for (quantity, value) in numbers {
        let expected = quantity.expected();
        if !expected.admits(value) {
            add(Kind::Number { quantity, expected });
        }
    }
    if definition.iterations > MAX_ITERATIONS {
        add(Kind::Limit { limit: LimitName::Iterations, value: u64::from(MAX_ITERATIONS), largest: None });
    }
    if style.palette.is_empty() {
        add(Kind::EmptyPalette);
    }
    if style.palette.len() > MAX_PALETTE {
        add(Kind::Limit { limit: LimitName::Palette, value: MAX_PALETTE as u64, largest: None });
    }
    notes.finish()
}

/// What works but may not be meant.
fn doubts(reading: &Reading, program: &Program, actions: &Actions<'_>) -> Vec<Diagnostic> {
    let Reading { grammar, axiom_spans, predecessor_spans, successor_spans, .. } = reading;
    let mut axiom_notes = Notes::new(Field::Axiom);
    let mut notes = Notes::new(Field::Rules);

    if grammar.axiom.is_empty() {
        axiom_notes.add(Kind::EmptyAxiom, 0..0);
    }
    let reachable = program.reachable();
    for (production, span) in grammar.productions.iter().zip(predecessor_spans) {
        let symbol = production.predecessor.symbol;
        if !grammar.axiom.is_empty() && !program.alphabet.binary_search(&symbol).is_ok_and(|at| reachable[at]) {
            notes.add(Kind::NeverOccurs { symbol }, span.clone());
        }
    }

    let words = || {
        let rest = grammar.productions.iter().zip(successor_spans).map(|(p, s)| (false, &p.successor[..], &s[..]));
        core::iter::once((true, &grammar.axiom[..], &axiom_spans[..])).chain(rest)
    };
    let mut told = BTreeSet::new();
    let mut unmatched: Vec<(bool, char, Range<usize>)> = Vec::new();
    let mut left_open = false;
    for (is_axiom, word, spans) in words() {
        let mut depth = 0_usize;
        for (module, span) in word.iter().zip(spans) {
            let symbol = module.symbol;
            if let Some(meaning) = actions.not_drawn(symbol)
                && told.insert(symbol)
            {
                let notes = if is_axiom { &mut axiom_notes } else { &mut notes };
                notes.add(Kind::NotDrawn { symbol, meaning }, span.clone());
            }
            for action in actions.of(symbol) {
                match action {
                    Action::Push => depth += 1,
                    Action::Pop if depth == 0 => unmatched.push((is_axiom, symbol, span.clone())),
                    Action::Pop => depth -= 1,
                    _ => {}
                }
            }
        }
        left_open |= depth > 0;
    }
    // A branch that one word leaves open another may close.
    if !left_open {
        for (is_axiom, symbol, span) in unmatched {
            let notes = if is_axiom { &mut axiom_notes } else { &mut notes };
            notes.add(Kind::UnmatchedClose { symbol }, span);
        }
    }
    let mut all = axiom_notes.finish();
    all.extend(notes.finish());
    all
}
