//! What a rewriter computes once from its rules.

use super::context::{ContextRole, roles};
use super::table::Table;
use crate::rules::{Rule, Rules};
use lsystem_base::Limits;
use lsystem_syntax::Code;
use std::sync::Arc;

/// Data that stays the same from step to step.
#[derive(Clone, Debug)]
pub(super) struct RewritePlan {
    pub(super) rules: Arc<Rules>,
    pub(super) roles: Vec<ContextRole>,
    /// By letter: the number of arguments.
    pub(super) arities: Vec<u8>,
    /// By letter: whether it has no production.
    pub(super) inert: Vec<bool>,
    pub(super) seed: u32,
    pub(super) limits: Limits,
    /// By production: the units of work to make its successor.
    pub(super) costs: Vec<u64>,
    pub(super) random: bool,
    /// By letter: whether it draws; empty if ages are not kept.
    pub(super) draws: Vec<bool>,
    /// The step whose modules grow, and the part that has grown.
    pub(super) growing: Option<(u32, f64)>,
    pub(super) contexts: bool,
    pub(super) cutting: bool,
    /// The look-up table by three letters, if the rules allow it.
    pub(super) table: Option<Table>,
}

impl RewritePlan {
    pub(super) fn new(rules: Arc<Rules>, seed: u32, limits: Limits) -> Self {
        let (random, roles) = (rules.is_random(), roles(&rules));
        Self {
            contexts: rules.by_letter.iter().flatten().any(Rule::is_context_sensitive),
            table: if rules.is_parametric() || random { None } else { Table::new(&rules, &roles) },
            inert: rules.by_letter.iter().map(Vec::is_empty).collect(),
            cutting: rules.is_cutting(),
            seed,
            limits,
            random,
            costs: costs(&rules),
            draws: vec![],
            growing: None,
            arities: rules.letters.iter().map(|letter| letter.arity).collect(),
            roles,
            rules,
        }
    }
}

/// By production: the units of work to make its successor once. The longest successor of a text costs at most half of
/// [`Meter::PIECE`].
fn costs(rules: &Rules) -> Vec<u64> {
    let all = || rules.by_letter.iter().chain(&rules.images).flatten();
    let mut costs = vec![0; all().map(|rule| rule.production + 1).max().unwrap_or(0)];
    for rule in all() {
        let computed: u64 = rule.successor.arguments.iter().map(Code::length).sum();
        costs[rule.production] = rule.successor.letters.len() as u64 / 16 + computed / 8;
    }
    costs
}
