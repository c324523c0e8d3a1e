//! A system ready for derivation and drawing.

use crate::drawing::TurtleInterpreter;
use crate::space::Tropism;
use crate::wind::Wind;
use crate::wireframe::wireframe;
use crate::{Look, Triangle, Turtle};
use lsystem_base::sorted::{set, sort};
use lsystem_base::{LimitName, MAX_LETTERS, say};
use lsystem_derive::{Interpreter, Letter, Rules};
use lsystem_syntax::lint::warnings;
use lsystem_syntax::notation;
use lsystem_syntax::overrides::Override;
use lsystem_syntax::{
    Action, Definition, Diagnostic, Diagnostics, Dialect, Field, Grammar, Heading, Production, Style, Surface,
    parse_overrides, parse_surfaces,
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
    /// The warnings about the definition.
    pub warnings: Vec<Diagnostic>,
}

impl System {
    /// Checks and compiles `definition`.
    ///
    /// # Errors
    /// All errors and warnings at once, if one of them is an error.
    pub fn new(definition: &Definition) -> Result<Self, Diagnostics> {
        let mut reading = notation::read(&definition.axiom, &definition.rules);
        let (overrides, overrides_diagnostics) = parse_overrides(&definition.overrides);
        let mut diagnostics = core::mem::take(&mut reading.diagnostics);
        diagnostics.extend(overrides_diagnostics);
        diagnostics.extend(definition.out_of_range());
        let surfaces = parse_surfaces(&definition.surfaces);
        let surfaces = surfaces.unwrap_or_else(|problem| {
            diagnostics.push(problem);
            vec![]
        });
        if diagnostics.iter().any(Diagnostic::is_error) {
            return Err(Diagnostics(diagnostics));
        }
        if letters(&reading.grammar) > MAX_LETTERS {
            let limit = Diagnostic::limit(LimitName::Letters, MAX_LETTERS as u64, None);
            diagnostics.push(limit.at(Field::Rules, 0..0));
            return Err(Diagnostics(diagnostics));
        }
        diagnostics.extend(missing_surfaces(&overrides, &surfaces));
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
        let Ok(rules) = Rules::new(grammar, places.collect(), cuts, apart) else {
            return Err(Diagnostics(diagnostics));
        };
        let mut rules = Arc::new(rules);
        actions.polygons = rules.letters.iter().any(|&Letter { symbol, .. }| {
            let drawn = image_of(&reading.grammar, &images, symbol).map_or(&[][..], |image| &image.successor);
            let opens = |symbol: char| actions.of(symbol).contains(&Action::OpenPolygon);
            opens(symbol) || drawn.iter().any(|module| opens(module.symbol))
        });
        diagnostics.extend(warnings(&reading, &occurring(&rules), |symbol| actions.of(symbol)));
        let actions: Vec<Vec<Action>> = (rules.letters.iter())
            .map(|letter| actions.drawn(letter.symbol, image_of(grammar, &images, letter.symbol), !rules.is_plain()))
            .collect();
        // Only surfaces that a letter draws are divided into triangles.
        let draws = |name: char| {
            actions.iter().flatten().any(|action| matches!(action, Action::Surface(own, _) if *own == name))
        };
        let drawn = surfaces.iter().filter(|surface| draws(surface.name));
        let drawn = drawn.map(|surface| (surface.name, Arc::from(surface.triangles()))).collect();
        let mut turtle = turtle(definition, actions, drawn);
        turtle.take_style(&definition.style);
        let grammar = reading.grammar;
        if rules.asks()
            && let Some(rules) = Arc::get_mut(&mut rules)
        {
            rules.interpreter = Some(Interpreter(Arc::new(TurtleInterpreter::new(&turtle))));
        }
        let (style, seed) = (definition.style.clone(), definition.seed);
        let mut system = Self { grammar, rules, turtle, style, seed, warnings: diagnostics };
        if system.style.auto {
            let style = system.look().applied(&system.style, &system.acting());
            system.style = style;
            system.turtle.take_style(&system.style);
        }
        if system.style.shapes && !system.grammar.shapes.is_empty() {
            system.turtle.wires = wireframe(&system.grammar.shapes, system.is_solid()).into();
        }
        Ok(system)
    }

    /// As [`System::new`], with all errors and warnings added to `problems`.
    pub fn read(definition: &Definition, problems: &mut Vec<Diagnostic>) -> Option<Self> {
        let made = Self::new(definition);
        problems.extend_from_slice(made.as_ref().map_or_else(|problems| &problems.0, |system| &system.warnings));
        made.ok()
    }

    /// All errors and warnings of `definition`.
    #[must_use]
    pub fn problems(definition: &Definition) -> Vec<Diagnostic> {
        let mut problems = vec![];
        Self::read(definition, &mut problems);
        problems
    }

    /// The system whose drawing has no wireframes of shapes.
    #[must_use]
    pub fn without_wires(mut self) -> Self {
        self.turtle.wires = Arc::default();
        self
    }

    /// The look that the system would choose by itself.
    #[must_use]
    pub fn look(&self) -> Look {
        Look::of(&self.acting(), self.is_solid())
    }

    /// The actions of all symbols that may occur; those that modules give a number, with a number.
    // Not inlined, to keep the wasm small.
    #[inline(never)]
    fn acting(&self) -> Vec<Action> {
        let mut acting = vec![];
        for ((letter, actions), drawn) in self.rules.letters.iter().zip(&self.turtle.actions).zip(self.rules.drawn()) {
            let from = acting.len();
            acting.extend_from_slice(if drawn { actions } else { &[] });
            if let Some(first) = acting.get_mut(from).filter(|_| letter.arity > 0) {
                *first = first.with(1.0);
            }
        }
        acting
    }

    /// Whether the drawing leaves the plane: a symbol that may occur pitches or rolls, or the tropism has a z
    /// component. A [`Figure`](crate::Figure) of such a system is in space; a [`draw`](crate::draw)ing in the plane ignores
    /// rotations out of it.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        self.turtle.tropism.is_some_and(|tropism| tropism.vector[2] != 0.0)
            || self.acting().iter().any(|action| action.is_solid())
    }

    /// Whether a symbol opens a branch, so that the drawing can sway.
    #[must_use]
    pub fn has_branches(&self) -> bool {
        branch(&self.turtle.actions)
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

/// Warnings about surfaces that actions name and the system lacks.
fn missing_surfaces(overrides: &[Override], surfaces: &[Surface]) -> Vec<Diagnostic> {
    let drawn = overrides.iter().flat_map(|own| &own.actions);
    let unknown = drawn.filter_map(|action| match action {
        Action::Surface(name, _) if surfaces.iter().all(|surface| surface.name != *name) => Some(*name),
        _ => None,
    });
    let missing = set(unknown).into_iter().map(|name| {
        Diagnostic::warning(say!("There is no surface `{}`", name))
            .hint(say!("Add the line of `{}` to the surfaces.", name))
            .at(Field::Overrides, 0..0)
    });
    missing.collect()
}

/// The turtle of a definition, without its style.
fn turtle(definition: &Definition, actions: Vec<Vec<Action>>, surfaces: Vec<(char, Arc<[Triangle]>)>) -> Turtle {
    let angle =
        |own: [Option<f64>; 2]| Heading::from_degrees(own.into_iter().flatten().next().unwrap_or(definition.angle));
    let Definition { right_angle, pitch_down, pitch_up, roll_left, roll_right, .. } = *definition;
    let tropism = Tropism { vector: definition.tropism, elasticity: definition.elasticity };
    Turtle {
        surfaces,
        // Wind moves branches only.
        wind: Wind::new(definition.wind).filter(|_| branch(&actions)),
        actions,
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
        length_factor: definition.length_factor,
        angle_variation: definition.angle_variation / 100.0,
        length_variation: definition.length_variation / 100.0,
        growth: definition.growth,
        ..Turtle::default()
    }
}

/// Whether an action opens a branch.
fn branch(actions: &[Vec<Action>]) -> bool {
    actions.iter().flatten().any(|action| *action == Action::Push)
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
const MAX_OF_A_LETTER: usize = 1 << 14;

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
        image.successor.iter().map(|module| self.of(module.symbol).len()).sum::<usize>() > MAX_OF_A_LETTER
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

/// The symbols that may occur in some generation, with their numbers of parameters, sorted.
fn occurring(rules: &Rules) -> Vec<(char, usize)> {
    let letters = rules.letters.iter().zip(rules.reachable()).filter(|(_, reached)| *reached);
    set(letters.map(|(letter, _)| (letter.symbol, usize::from(letter.arity))))
}
