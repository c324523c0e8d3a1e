//! The targets: parts of the core, what they are given, and what must hold.

mod derive;
mod drawing;
mod export;
mod expressions;
mod files;
mod notation;
mod pick;
mod render;
mod solid;

use crate::{Gauge, Source};

/// A part of the core, and what must hold for it.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name.
    pub name: &'static str,
    /// Reads an input and tries it; panics where something does not hold.
    pub(crate) run: fn(&mut Source<'_>, &mut Gauge),
    /// Executions in the short run that the tests have.
    pub(crate) short: u64,
}

const fn target(name: &'static str, short: u64, run: fn(&mut Source<'_>, &mut Gauge)) -> Target {
    Target { name, run, short }
}

const TARGETS: [Target; 16] = [
    target("notation", 20_000, notation::notation),
    target("overrides", 20_000, notation::overrides),
    target("expressions", 20_000, expressions::expressions),
    target("json", 20_000, files::json),
    target("pictures", 20_000, files::pictures),
    target("bytes", 20_000, files::bytes),
    target("derive", 3_000, derive::derive),
    target("access", 3_000, derive::access),
    target("drawing", 3_000, drawing::plane),
    target("space", 3_000, drawing::space),
    target("render", 500, render::render),
    target("views", 500, render::views),
    target("density", 300, render::density),
    target("solid", 300, solid::solid),
    target("pick", 1_000, pick::pick),
    target("export", 2_000, export::export),
];

impl Target {
    /// All of them.
    pub fn all() -> impl Iterator<Item = &'static Self> {
        TARGETS.iter()
    }

    /// Their names.
    #[must_use]
    pub fn names() -> Vec<&'static str> {
        Self::all().map(|target| target.name).collect()
    }

    /// The one of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::all().find(|target| target.name == name)
    }
}
