//! A system ready for derivation and drawing.

use crate::space::Tropism;
use crate::{Colouring, Turtle};
use core::ops::Range;
use lsystem_derive::{Letter, Rules};
use lsystem_syntax::decimal;
use lsystem_syntax::notation::{self, Places, Reading};
use lsystem_syntax::notes::Notes;
use lsystem_syntax::sorted::{set, sort};
use lsystem_syntax::{
    Action, ColourBy, Definition, Diagnostic, Dialect, Field, Grammar, Heading, Kind, LimitName, MAX_LETTERS, Module,
    Production, Style, parse_overrides,
};
use std::sync::Arc;

/// A checked and compiled [`Definition`].
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// The parsed axiom and productions.
    pub grammar: Grammar,
    /// The compiled axiom and productions.
    pub rules: Arc<Rules>,
    /// The actions of the symbols.
    pub turtle: Turtle,
    /// Colours and widths.
    pub style: Style,
    /// The seed of all random choices and variations.
    pub seed: u32,
}

impl System {
    /// Checks and compiles `definition`. Returns all errors and warnings at once. The system is `None` if a diagnostic
    /// is an error.
    #[must_use]
    pub fn new(definition: &Definition) -> (Option<Self>, Vec<Diagnostic>) {
        let mut reading = notation::read(&definition.axiom, &definition.rules);
        let (overrides, overrides_diagnostics) = parse_overrides(&definition.overrides);
        let mut diagnostics = core::mem::take(&mut reading.diagnostics);
        diagnostics.extend(overrides_diagnostics);
        diagnostics.extend(definition.out_of_range());
        if diagnostics.iter().any(Diagnostic::is_error) {
            return (None, diagnostics);
        }
        if letters(&reading.grammar) > MAX_LETTERS {
            let kind = Kind::Limit { limit: LimitName::Letters, value: MAX_LETTERS as u64, largest: None };
            diagnostics.push(Diagnostic { kind, field: Field::Rules, span: 0..0 });
            return (None, diagnostics);
        }
        // `parse_overrides` leaves each symbol at most one override.
        let mut order: Vec<(char, usize)> = overrides.iter().enumerate().map(|(at, o)| (o.symbol, at)).collect();
        sort(&mut order);
        let overrides = order.iter().map(|&(symbol, at)| (symbol, overrides[at].actions.as_slice())).collect();
        let images = first_images(&reading.grammar);
        let mut actions = Actions { dialect: definition.dialect, overrides, polygons: false };
        let cuts = |symbol: char| actions.of(symbol).contains(&Action::Cut);
        let grammar = &reading.grammar;
        let places = reading.productions.iter().chain(&reading.images).map(|places| places.predecessor.clone());
        let apart = grammar.images.iter().any(|image| actions.are_many(image));
        // A failure here already has a diagnostic from `notation::read`.
        let Ok(rules) = Rules::new(grammar, places.collect(), cuts, apart) else { return (None, diagnostics) };
        let rules = Arc::new(rules);
        actions.polygons = rules.letters.iter().any(|&Letter { symbol, .. }| {
            let drawn = image_of(&reading.grammar, &images, symbol).map_or(&[][..], |image| &image.successor);
            let opens = |symbol: char| actions.of(symbol).contains(&Action::OpenPolygon);
            opens(symbol) || drawn.iter().any(|module| opens(module.symbol))
        });
        diagnostics.extend(warnings(&reading, &rules, &actions));
        let angle =
            |own: [Option<f64>; 2]| Heading::from_degrees(own.into_iter().flatten().next().unwrap_or(definition.angle));
        let Definition { right_angle, pitch_down, pitch_up, roll_left, roll_right, .. } = *definition;
        let tropism = Tropism { vector: definition.tropism, elasticity: definition.elasticity };
        let style = &definition.style;
        let turtle = Turtle {
            actions: rules
                .letters
                .iter()
                .map(|letter| {
                    actions.drawn(letter.symbol, image_of(grammar, &images, letter.symbol), !rules.is_plain())
                })
                .collect(),
            left: Heading::from_degrees(definition.angle),
            right: angle([right_angle, None]),
            pitch_down: angle([pitch_down, None]),
            pitch_up: angle([pitch_up, pitch_down]),
            roll_left: angle([roll_left, None]),
            roll_right: angle([roll_right, roll_left]),
            tropism: (tropism.elasticity != 0.0 && tropism.vector != [0.0; 3]).then_some(tropism),
            heading: Heading::from_degrees(definition.heading),
            start: definition.start,
            step: definition.step,
            width: style.width,
            width_factor: style.width_factor,
            length_factor: definition.length_factor,
            colouring: match style.colour_by {
                ColourBy::Turn => Colouring::Turns(style.turn_colours),
                ColourBy::Generation => Colouring::Generations,
                _ => Colouring::Symbols,
            },
            angle_variation: definition.angle_variation / 100.0,
            length_variation: definition.length_variation / 100.0,
            growth: definition.growth,
        };
        let grammar = reading.grammar;
        let system = Self { grammar, rules, turtle, style: definition.style.clone(), seed: definition.seed };
        (Some(system), diagnostics)
    }

    /// Whether the drawing leaves the plane: a symbol that may occur pitches or rolls, or the tropism has a z
    /// component. A [`Figure`](crate::Figure) of such a system is in space; a [`draw`](crate::draw)ing in the plane ignores
    /// rotations out of it.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        // Symbols of images (below `draw:`) occur in no generation, so reachability does not find them.
        let reachable = self.rules.reachable().into_iter().map(|reached| reached || !self.rules.is_plain());
        let leads_out = |actions: &[Action]| actions.iter().any(|action| action.is_solid());
        self.turtle.tropism.is_some_and(|tropism| tropism.vector[2] != 0.0)
            || self.turtle.actions.iter().zip(reachable).any(|(actions, reached)| reached && leads_out(actions))
    }

    /// Whether the drawing depends on the seed.
    #[must_use]
    pub fn is_stochastic(&self) -> bool {
        self.turtle.angle_variation != 0.0 || self.turtle.length_variation != 0.0 || self.has_choices()
    }

    /// Whether the derivation depends on the seed.
    #[must_use]
    pub fn has_choices(&self) -> bool {
        // In plain rules, stochastic productions of unreachable letters do not count.
        if self.rules.is_plain() { !self.rules.is_deterministic() } else { self.rules.is_random() }
    }
}

/// The index of the first image of each symbol, sorted by symbol.
fn first_images(grammar: &Grammar) -> Vec<(char, usize)> {
    let mut images = set(grammar.images.iter().enumerate().map(|(at, image)| (image.predecessor.symbol, at)));
    images.dedup_by_key(|(symbol, _)| *symbol);
    images
}

/// The first image of a symbol, from the sorted list of [`first_images`].
fn image_of<'a>(grammar: &'a Grammar, images: &[(char, usize)], symbol: char) -> Option<&'a Production> {
    let at = images.binary_search_by_key(&symbol, |&(symbol, _)| symbol).ok()?;
    grammar.images.get(images[at].1)
}

/// The number of letters; a letter is a symbol with a number of parameters.
fn letters(grammar: &Grammar) -> usize {
    let productions = || grammar.productions.iter().chain(&grammar.images);
    let made = grammar.axiom.iter().chain(productions().flat_map(|p| &p.successor));
    let made = made.map(|module| (module.symbol, module.arguments.len()));
    let matched = productions().flat_map(Production::patterns).map(|p| (p.symbol, p.parameters.len()));
    set(made.chain(matched)).len()
}

/// The most actions of an image that becomes one letter's actions.
const MOST_OF_A_LETTER: usize = 1 << 14;

/// The actions of symbols, from the overrides and the dialect.
struct Actions<'a> {
    dialect: Dialect,
    /// Sorted by symbol.
    overrides: Vec<(char, &'a [Action])>,
    /// Whether a symbol opens a polygon.
    polygons: bool,
}

impl Actions<'_> {
    /// The actions of a symbol: its override, or else its meaning in the dialect.
    fn of(&self, symbol: char) -> &[Action] {
        self.overridden(symbol).unwrap_or_else(|| self.dialect.actions(symbol))
    }

    fn overridden(&self, symbol: char) -> Option<&[Action]> {
        let place = self.overrides.binary_search_by_key(&symbol, |(symbol, _)| *symbol).ok()?;
        Some(self.overrides[place].1)
    }

    /// Whether an image has too many actions for one step of work. Such an image is drawn module by module.
    fn are_many(&self, image: &Production) -> bool {
        image.successor.iter().map(|module| self.of(module.symbol).len()).sum::<usize>() > MOST_OF_A_LETTER
    }

    /// The actions that draw `symbol`: those of all symbols of its image, unless images are drawn `apart`.
    fn drawn(&self, symbol: char, image: Option<&Production>, apart: bool) -> Vec<Action> {
        match image {
            Some(image) if !apart => image.successor.iter().flat_map(|m| self.marked(m.symbol)).collect(),
            _ => self.marked(symbol).collect(),
        }
    }

    /// The actions of `symbol`. In the ABOP dialect `G` and `g` add no vertex to a polygon; this matters only in
    /// systems with polygons.
    fn marked(&self, symbol: char) -> impl Iterator<Item = Action> {
        let unmarked = self.polygons
            && self.dialect == Dialect::Abop
            && matches!(symbol, 'G' | 'g')
            && self.overridden(symbol).is_none();
        self.of(symbol).iter().map(move |&action| if unmarked { action.unmarked() } else { action })
    }
}

/// The warnings about a system without errors.
fn warnings(reading: &Reading, rules: &Rules, actions: &Actions<'_>) -> Vec<Diagnostic> {
    let Reading { grammar, .. } = reading;
    let mut axiom_notes = Notes::new(Field::Axiom);
    let mut notes = Notes::new(Field::Rules);

    if grammar.axiom.is_empty() {
        axiom_notes.add(Kind::EmptyAxiom, 0..0);
    } else {
        note_idle(reading, &occurring(rules), &mut notes);
        note_arities(reading, &mut axiom_notes, &mut notes);
    }

    let mut words = vec![(&grammar.axiom, &reading.axiom)];
    for (production, places) in productions(reading) {
        words.push((&production.successor, &places.successor));
    }
    // The number of the word, and the index in it.
    let mut opened: Vec<(usize, usize)> = Vec::new();
    let mut closed: Vec<(usize, usize)> = Vec::new();
    let arrow_is_idle = is_idle('>', reading, actions);
    for (number, (word, spans)) in words.iter().enumerate() {
        let idle = |symbol: char| is_idle(symbol, reading, actions);
        note_foreign(word, spans, idle, if number == 0 { &mut axiom_notes } else { &mut notes });
        let outside = opened.len();
        for (at, module) in word.iter().enumerate() {
            for action in actions.of(module.symbol) {
                match action {
                    Action::Push => opened.push((number, at)),
                    Action::Pop if opened.len() == outside => closed.push((number, at)),
                    Action::Pop => opened.truncate(opened.len() - 1),
                    _ => {}
                }
            }
            if is_arrow(word, spans, at) && (follows_separator(word, at) || arrow_is_idle) {
                let notes = if number == 0 { &mut axiom_notes } else { &mut notes };
                notes.add(Kind::ArrowOfSymbols, spans[at].start..spans[at + 1].end);
            }
        }
    }
    let is_open = closed.is_empty();
    // One word may close a branch that another leaves open, so no single bracket is to blame.
    let lone = match opened.is_empty() {
        true => closed,
        false if is_open => opened,
        false => Vec::new(),
    };
    let mut rest = &lone[..];
    while let Some(&(number, first)) = rest.first() {
        let (word, spans) = words[number];
        let symbol = word[first].symbol;
        // One note covers adjacent unmatched brackets.
        let same = |at: usize| rest.get(at) == Some(&(number, first + at)) && word[first + at].symbol == symbol;
        let mut count = 1;
        while same(count) {
            count += 1;
        }
        rest = &rest[count..];
        let kind = if is_open { Kind::UnmatchedOpen { symbol } } else { Kind::UnmatchedClose { symbol } };
        let notes = if number == 0 { &mut axiom_notes } else { &mut notes };
        notes.add(kind, spans[first].start..spans[first + count - 1].end);
    }
    let mut all = axiom_notes.finish();
    all.extend(notes.finish());
    all
}

/// Notes symbols that mean something else in other notations: digits behind a turn or another mark, and `@` with another
/// character.
fn note_foreign(word: &[Module], spans: &[Range<usize>], idle: impl Fn(char) -> bool, notes: &mut Notes) {
    let mut at = 0;
    while let Some(module) = word.get(at) {
        let first = at + 1;
        at = first;
        let marks = matches!(module.symbol, '+' | '-' | '\\' | '/' | '&' | '^' | '|' | '@' | '~' | '?' | '<' | '>');
        let plain = |i: usize| {
            spans[i].start == spans[i - 1].end && spans[i].len() == word[i].symbol.len_utf8() && idle(word[i].symbol)
        };
        if !marks || !module.arguments.is_empty() {
            continue;
        }
        let digit = |i: usize| plain(i) && matches!(word[i].symbol, '0'..='9' | '.');
        let digits: String = (first..word.len()).take_while(|&i| digit(i)).map(|i| word[i].symbol).collect();
        if decimal::read(&digits).is_some() {
            at += digits.len();
            let kind = Kind::DigitsBehind { symbol: module.symbol, digits };
            notes.add(kind, spans[first].start..spans[at - 1].end);
        } else if module.symbol == '@'
            && spans[first - 1].len() == 1
            && idle('@')
            && let Some(second) = word.get(first)
            && spans[first].start == spans[first - 1].end
            && second.symbol.is_ascii_alphanumeric()
        {
            notes.add(Kind::TwoCharacters { second: second.symbol }, spans[first - 1].start..spans[first].end);
        }
    }
}

/// Productions and images, with their places in the text.
fn productions(reading: &Reading) -> impl Iterator<Item = (&Production, &Places)> {
    let Reading { grammar, productions, images, .. } = reading;
    grammar.productions.iter().zip(productions).chain(grammar.images.iter().zip(images))
}

/// Whether plain characters at `at` look like the arrow `->` or `=>`.
fn is_arrow(word: &[Module], spans: &[Range<usize>], at: usize) -> bool {
    matches!(word[at].symbol, '-' | '=')
        && word.get(at + 1).is_some_and(|next| next.symbol == '>')
        && spans[at].len() == 1
        && spans[at].end == spans[at + 1].start
}

/// Whether `,` or `;` and one symbol stand before the arrow at `at`: other notations separate productions so.
fn follows_separator(word: &[Module], at: usize) -> bool {
    at >= 2 && matches!(word[at - 2].symbol, ',' | ';')
}

/// Whether `symbol` has no action and no production.
fn is_idle(symbol: char, reading: &Reading, actions: &Actions<'_>) -> bool {
    actions.of(symbol).is_empty() && !productions(reading).any(|(p, _)| p.predecessor.symbol == symbol)
}

/// The symbols that may occur in some generation, with their numbers of parameters, sorted.
fn occurring(rules: &Rules) -> Vec<(char, usize)> {
    let letters = rules.letters.iter().zip(rules.reachable()).filter(|(_, reached)| *reached);
    set(letters.map(|(letter, _)| (letter.symbol, usize::from(letter.arity))))
}

/// The most letters that get a note of their own.
const MOST_TOLD: usize = 100;

/// Notes modules whose symbol has productions only for another number of parameters.
fn note_arities(reading: &Reading, axiom_notes: &mut Notes, notes: &mut Notes) {
    let Reading { grammar, axiom, productions, .. } = reading;
    let rules = set(grammar.productions.iter().map(|p| (p.predecessor.symbol, p.predecessor.parameters.len())));
    let made = grammar.productions.iter().zip(productions);
    let made = made.flat_map(|(p, places)| p.successor.iter().zip(&places.successor));
    let words = grammar.axiom.iter().zip(axiom).map(|m| (true, m)).chain(made.map(|m| (false, m)));
    let mut told: Vec<(char, usize)> = Vec::new();
    for (is_axiom, (module, span)) in words {
        let (symbol, parameters) = (module.symbol, module.arguments.len());
        let from = rules.partition_point(|rule| *rule < (symbol, 0));
        if let Some(&(_, found)) = rules.get(from).filter(|rule| rule.0 == symbol)
            && rules.binary_search(&(symbol, parameters)).is_err()
            && !told.contains(&(symbol, parameters))
            && told.len() < MOST_TOLD
        {
            told.push((symbol, parameters));
            let notes = if is_axiom { &mut *axiom_notes } else { &mut *notes };
            notes.add(Kind::NoRuleForArity { symbol, parameters, found }, span.clone());
        }
    }
}

/// Notes productions that never apply, because a symbol of their predecessor or contexts never occurs.
fn note_idle(reading: &Reading, occurring: &[(char, usize)], notes: &mut Notes) {
    let seen = reading.grammar.seen.ready();
    for (production, places) in productions(reading) {
        let spans = places.left.iter().chain([&places.predecessor]).chain(&places.right);
        for (at, (pattern, span)) in production.patterns().zip(spans).enumerate() {
            let (symbol, parameters) = (pattern.symbol, pattern.parameters.len());
            let context = at != production.left.len();
            let bracket = context && matches!(symbol, '[' | ']');
            let from = occurring.partition_point(|letter| *letter < (symbol, 0));
            let found = || occurring.get(from).filter(|letter| letter.0 == symbol);
            let kind = if context && !bracket && !seen.contains(symbol) {
                Kind::ContextUnseen { symbol }
            } else if bracket || occurring.binary_search(&(symbol, parameters)).is_ok() {
                continue;
            } else if let Some(&(_, found)) = found() {
                Kind::OtherArity { symbol, parameters, found }
            } else {
                Kind::NeverOccurs { symbol }
            };
            notes.add(kind, span.clone());
            break;
        }
    }
}
