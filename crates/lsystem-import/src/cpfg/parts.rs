//! The parts of a system, as texts of its own notation.

use super::Kind;
use super::arithmetic::{Arithmetic, FUNCTIONS};
use super::companions::NamedFunction;
use super::every_step::EveryStep;
use super::macros::is_part;
use core::ops::Range;
use lsystem_base::number::number;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// A production that is not translated yet.
pub(super) struct Rule<'c> {
    pub(super) place: Range<usize>,
    /// The predecessor and its contexts, without a label.
    pub(super) head: &'c str,
    pub(super) condition: Cow<'c, str>,
    pub(super) successor: Cow<'c, str>,
    pub(super) weight: Option<&'c str>,
}

/// The section of a file whose rules are being read.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Section {
    Productions,
    Decompositions,
    Images,
}

/// The parts of a system.
pub(super) struct Parts<'c> {
    pub(super) arithmetic: Arithmetic,
    pub(super) axiom: Option<&'c str>,
    /// Constants by name, with numbers.
    pub(super) constants: Vec<(String, String)>,
    /// The code that runs at every step.
    pub(super) every_step: EveryStep,
    /// The lists behind `ignore` and `consider`.
    pub(super) seen: Vec<(&'static str, &'c str)>,
    pub(super) rules: Vec<Rule<'c>>,
    pub(super) images: Vec<Rule<'c>>,
    /// The place of the keyword.
    pub(super) decomposed: Option<Range<usize>>,
    pub(super) decompositions: Vec<Rule<'c>>,
    pub(super) decomposition_depth: Option<&'c str>,
    pub(super) depth: Option<&'c str>,
    pub(super) length: Option<&'c str>,
    pub(super) angle: Option<f64>,
    /// Whether several rules that apply are chosen from at random, even without weights.
    pub(super) is_stochastic: bool,
    /// The surfaces: their names in cpfg, and in the definition.
    pub(super) surfaces: Vec<(char, char)>,
    /// Curves by name, as points in our notation.
    pub(super) curves: Vec<(String, String)>,
    /// Names of several characters that the text declares.
    pub(super) names: BTreeSet<String>,
}

impl<'c> Parts<'c> {
    pub(super) fn new(kind: Kind) -> Self {
        Self {
            arithmetic: Arithmetic::new(kind),
            axiom: None,
            constants: Vec::new(),
            every_step: EveryStep::default(),
            seen: Vec::new(),
            rules: Vec::new(),
            images: Vec::new(),
            decomposed: None,
            decompositions: Vec::new(),
            decomposition_depth: None,
            depth: None,
            length: None,
            angle: None,
            is_stochastic: false,
            surfaces: Vec::new(),
            curves: Vec::new(),
            names: BTreeSet::new(),
        }
    }

    /// Sets a number that has a name; a second value replaces the first.
    pub(super) fn set_constant(&mut self, name: &str, value: f64) {
        let text = number(value);
        if self.arithmetic.macros.define(name.to_owned(), None, format!("({text})"), true) {
            self.constants.retain(|(known, _)| known != name);
        }
        self.constants.push((name.to_owned(), text));
    }

    /// Sets the functions of cpfg's files, with names that nothing else has.
    pub(super) fn set_curves(&mut self, functions: Vec<NamedFunction<'_>>) {
        let heads = self.all_rules().flat_map(|rule| rule.head.split(|c: char| !is_part(c)));
        let mut taken: BTreeSet<String> = heads.chain(FUNCTIONS).chain(["and", "or"]).map(str::to_owned).collect();
        taken.extend(self.constants.iter().map(|(name, _)| name.clone()));
        for NamedFunction { name, curve } in functions {
            let mut own: String = name.chars().take(40).map(|c| if is_part(c) { c } else { '_' }).collect();
            if own.starts_with(|c: char| c.is_ascii_digit()) || own.is_empty() {
                own.insert(0, 'f');
            }
            while !taken.insert(own.clone()) {
                own.push('_');
            }
            self.arithmetic.curves.push((name.to_owned(), curve.is_some().then(|| own.clone())));
            self.curves.extend(curve.map(|curve| (own, curve.to_string())));
        }
    }

    /// All rules, in the order of the sections.
    pub(super) fn all_rules(&self) -> impl Iterator<Item = &Rule<'c>> {
        self.rules.iter().chain(&self.decompositions).chain(&self.images)
    }

    pub(super) fn section(&mut self, section: Section) -> &mut Vec<Rule<'c>> {
        match section {
            Section::Productions => &mut self.rules,
            Section::Decompositions => &mut self.decompositions,
            Section::Images => &mut self.images,
        }
    }
}
