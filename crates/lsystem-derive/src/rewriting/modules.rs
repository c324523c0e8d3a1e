//! Words of modules.

use super::room::{held, room_for, while_growing};
use crate::Key;
use crate::rules::{LetterId, Template};
use core::ops::Range;

/// A word of modules.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Modules {
    /// The letters.
    pub letters: Vec<LetterId>,
    /// The arguments of all modules in order. Each module has as many as its letter's arity.
    pub arguments: Vec<f64>,
    /// By module: its random key; empty if the rules have no random choices.
    keys: Vec<Key>,
    /// By module: its age; empty if ages are not wanted.
    ages: Vec<Age>,
}

/// The age of a module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Age {
    /// The derivation step that made the module, or the oldest ancestor in an unbroken line of the same letter; 0 for
    /// the axiom.
    pub since: u16,
    /// The derivation step that made the module, or for a module that continues its predecessor, the predecessor's
    /// value; 0 for the axiom.
    pub made: u16,
}

/// The error for a number that is not finite.
pub(super) struct NotFinite;

/// The source of a production's random numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chance {
    /// The key of the module that is replaced.
    pub(super) key: Key,
    pub(super) seed: u32,
    pub(super) step: u32,
}

impl Chance {
    /// The random number at `place` of the production.
    pub(super) fn number(&self, place: u16) -> f64 {
        self.key.number(self.seed, self.step, place)
    }
}

/// The number this part of the way from one finite number to another.
#[must_use]
pub fn between(from: f64, to: f64, part: f64) -> f64 {
    if from == to { to } else { (1.0 - part) * from + part * to }
}

impl Modules {
    pub(super) fn clear(&mut self) {
        self.letters.clear();
        self.arguments.clear();
        self.keys.clear();
        self.ages.clear();
    }

    /// Starts to keep keys and ages. The word must be the axiom.
    pub(super) fn remember(&mut self, keys: bool, ages: bool) {
        let places = 0..self.letters.len() as u64;
        if keys {
            self.keys = places.clone().map(Key::root).collect();
        }
        if ages {
            self.ages = places.map(|_| Age { since: 0, made: 0 }).collect();
        }
    }

    /// The age of the module at `place`; `None` if ages are not kept.
    pub fn age_of(&self, place: usize) -> Option<Age> {
        self.ages.get(place).copied()
    }

    /// Records the ages of the modules from `from` on, which `step` has just made of a module with this letter and age.
    /// `draws` marks the letters that draw.
    pub(super) fn grow(&mut self, from: usize, letter: LetterId, age: Age, step: u32, draws: &[bool]) {
        let made = &self.letters[from..];
        let same = made.iter().position(|&child| child == letter);
        let drawn = || made.iter().position(|&child| draws[usize::from(child)]).filter(|_| draws[usize::from(letter)]);
        let continuing = same.or_else(drawn);
        self.ages.extend(made.iter().enumerate().map(|(index, &child)| Age {
            since: if child == letter { age.since } else { step as u16 },
            made: if continuing == Some(index) { age.made } else { step as u16 },
        }));
    }

    /// Moves the numbers of the first module of a letter among those from `made` on, a module and an argument, the part
    /// `grown` of the way from `before`.
    pub(super) fn blend(&mut self, made: (usize, usize), letter: LetterId, before: &[f64], grown: f64, arities: &[u8]) {
        let mut argument = made.1;
        for &child in &self.letters[made.0..] {
            if child == letter {
                let own = self.arguments[argument..].iter_mut();
                return own.zip(before).for_each(|(value, before)| *value = between(*before, *value, grown));
            }
            argument += usize::from(arities[usize::from(child)]);
        }
    }

    /// The random key of the module at `place`; meaningless if keys are not kept.
    pub fn key_of(&self, place: usize) -> Key {
        self.keys.get(place).copied().unwrap_or(Key::root(0))
    }

    /// Whether keys are kept.
    pub(super) fn has_keys(&self) -> bool {
        !self.keys.is_empty()
    }

    /// The bytes of its memory.
    pub(super) fn bytes(&self) -> u64 {
        held(&self.letters) + held(&self.arguments) + held(&self.keys) + held(&self.ages)
    }

    /// Whether there is room for this many more modules and arguments, with at most `most` of each in all.
    #[inline]
    pub(super) fn fits(&self, modules: usize, arguments: usize, most: u64) -> bool {
        let fits = |len: usize, more: usize, room: usize| len + more <= room && (len + more) as u64 <= most;
        fits(self.letters.len(), modules, self.letters.capacity())
            && fits(self.arguments.len(), arguments, self.arguments.capacity())
    }

    /// The capacities for modules and for arguments.
    pub(super) fn room(&self) -> [usize; 2] {
        [self.letters.capacity(), self.arguments.capacity()]
    }

    /// The most bytes held during growth to this many modules and arguments in all. `keys` and `ages` choose which of
    /// these are kept.
    pub(super) fn bytes_with(&self, modules: usize, arguments: usize, keys: bool, ages: bool) -> u64 {
        let [modules, arguments] = self.wanted(modules, arguments);
        let each =
            size_of::<LetterId>() + if keys { size_of::<Key>() } else { 0 } + if ages { size_of::<Age>() } else { 0 };
        while_growing((modules * each + arguments * size_of::<f64>()) as u64)
    }

    /// Makes room for this many modules and arguments in all.
    pub(super) fn make_room(&mut self, modules: usize, arguments: usize, keys: bool, ages: bool) {
        let [modules, arguments] = self.wanted(modules, arguments);
        let grow = |list: usize, wanted: usize| wanted.saturating_sub(list);
        self.letters.reserve_exact(grow(self.letters.len(), modules));
        self.arguments.reserve_exact(grow(self.arguments.len(), arguments));
        if keys {
            self.keys.reserve_exact(grow(self.keys.len(), modules));
        }
        if ages {
            self.ages.reserve_exact(grow(self.ages.len(), modules));
        }
    }

    fn wanted(&self, modules: usize, arguments: usize) -> [usize; 2] {
        let size = |room: usize, needed: usize| if needed > room { room_for(needed) } else { room };
        [size(self.letters.capacity(), modules), size(self.arguments.capacity(), arguments)]
    }

    /// Appends unchanged modules of another word, with their arguments.
    pub(super) fn keep(&mut self, word: &Self, modules: Range<usize>, arguments: Range<usize>) {
        self.letters.extend_from_slice(&word.letters[modules.clone()]);
        self.arguments.extend_from_slice(&word.arguments[arguments]);
        if !word.keys.is_empty() {
            self.keys.extend_from_slice(&word.keys[modules.clone()]);
        }
        if !word.ages.is_empty() {
            self.ages.extend_from_slice(&word.ages[modules]);
        }
    }

    /// Appends the axiom. Each module takes random numbers by its own key. `arities` is by letter.
    pub(super) fn start(&mut self, axiom: &Template, arities: &[u8], seed: u32, random: bool) -> Result<(), NotFinite> {
        let mut codes = axiom.arguments.iter();
        for (index, &letter) in axiom.letters.iter().enumerate() {
            let key = Key::root(index as u64);
            if random {
                self.keys.push(key);
            }
            self.letters.push(letter);
            let chance = Chance { key, seed, step: 0 };
            let own = codes.by_ref().take(usize::from(arities[usize::from(letter)]));
            self.arguments.extend(own.map(|code| code.value(&[], &|place| chance.number(place))));
        }
        if self.arguments.iter().all(|number| number.is_finite()) { Ok(()) } else { Err(NotFinite) }
    }

    /// Appends the successor of a production with the parameters in `slots`. `random`: keys are kept.
    #[inline]
    pub(super) fn make(
        &mut self,
        template: &Template,
        slots: &[f64],
        chance: &Chance,
        random: bool,
    ) -> Result<(), NotFinite> {
        if random {
            let children = 0..template.letters.len() as u64;
            self.keys.extend(children.map(|index| chance.key.child(chance.step, index)));
        }
        self.letters.extend_from_slice(&template.letters);
        let from = self.arguments.len();
        let random = |place| chance.number(place);
        self.arguments.extend(template.arguments.iter().map(|code| code.value(slots, &random)));
        if self.arguments[from..].iter().all(|number| number.is_finite()) { Ok(()) } else { Err(NotFinite) }
    }

    /// Moves modules, with their arguments, to an earlier place.
    pub(super) fn move_down(&mut self, modules: Range<usize>, to: usize, arguments: Range<usize>, to_argument: usize) {
        self.letters.copy_within(modules.clone(), to);
        self.arguments.copy_within(arguments, to_argument);
        if !self.keys.is_empty() {
            self.keys.copy_within(modules.clone(), to);
        }
        if !self.ages.is_empty() {
            self.ages.copy_within(modules, to);
        }
    }

    /// Removes all modules and arguments after the first ones.
    pub(super) fn truncate(&mut self, modules: usize, arguments: usize) {
        self.letters.truncate(modules);
        self.arguments.truncate(arguments);
        self.keys.truncate(modules);
        self.ages.truncate(modules);
    }
}
