//! The targets: each tries one part of the core with random inputs and checks its properties.

mod answers;
mod course;
mod derive;
mod drawing;
mod export;
mod expressions;
mod files;
mod films;
mod find;
mod formats;
mod import;
mod notation;
mod papers;
mod pick;
mod plots;
mod render;
mod solid;
mod svg;
mod tiles;

use crate::{Gauge, Source};

/// A part of the core with its properties.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The name on the command line.
    pub name: &'static str,
    /// Reads an input and tries it. Panics if a property does not hold.
    pub(crate) run: fn(&mut Source<'_>, &mut Gauge),
    /// The number of random inputs in the short run of the tests.
    pub(crate) short: u64,
}

const fn target(name: &'static str, short: u64, run: fn(&mut Source<'_>, &mut Gauge)) -> Target {
    Target { name, run, short }
}

/// Those that take longest come first, so that jobs at the same time end at about the same time.
const TARGETS: [Target; 31] = [
    target("exercises", 150, course::exercises),
    target("find", 30, find::pictures_found),
    target("growth", 600, course::growth),
    target("render", 800, render::render),
    target("views", 40, render::views),
    target("notation", 1_500, notation::notation),
    target("overrides", 8_000, notation::overrides),
    target("expressions", 15_000, expressions::expressions),
    target("json", 4_000, files::json),
    target("pictures", 4_000, files::pictures),
    target("svg", 400, svg::drawn),
    target("bytes", 8_000, files::bytes),
    target("import", 1_500, import::import_text),
    target("long-texts", 100, import::long_texts),
    target("links", 1_500, answers::links),
    target("outputs", 1_500, answers::outputs),
    target("steps", 800, course::steps),
    target("derive", 3_000, derive::derive),
    target("access", 1_500, derive::access),
    target("drawing", 3_000, drawing::plane),
    target("space", 2_000, drawing::space),
    target("density", 500, render::density),
    target("solid", 100, solid::solid),
    target("tiles", 400, tiles::tiles),
    target("formats", 800, formats::formats),
    target("pick", 3_000, pick::pick),
    target("export", 2_000, export::export),
    target("plots", 600, plots::plots),
    target("papers", 600, papers::papers),
    target("films", 200, films::films),
    target("find-strings", 600, find::strings_found),
];

impl Target {
    /// All targets.
    pub fn all() -> impl Iterator<Item = &'static Self> {
        TARGETS.iter()
    }

    /// The names of all targets.
    #[must_use]
    pub fn names() -> Vec<&'static str> {
        Self::all().map(|target| target.name).collect()
    }

    /// The target with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::all().find(|target| target.name == name)
    }
}
