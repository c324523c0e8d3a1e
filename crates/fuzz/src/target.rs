//! The targets: each tries one part of the core with random inputs and checks its properties.

mod answers;
mod course;
mod derive;
mod drawing;
mod edits;
mod export;
mod expressions;
mod files;
mod films;
mod find;
mod formats;
mod import;
mod meshes;
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
const TARGETS: [Target; 34] = [
    target("exercises", 50, course::exercises),
    target("find", 10, find::pictures_found),
    target("growth", 200, course::growth),
    target("render", 260, render::render),
    target("views", 13, render::views),
    target("notation", 500, notation::notation),
    target("overrides", 2_660, notation::overrides),
    target("expressions", 5_000, expressions::expressions),
    target("json", 1_330, files::json),
    target("pictures", 1_330, files::pictures),
    target("svg", 130, svg::drawn),
    target("bytes", 2_660, files::bytes),
    target("edits", 660, edits::edits),
    target("import", 500, import::import_text),
    target("long-texts", 33, import::long_texts),
    target("links", 500, answers::links),
    target("outputs", 500, answers::outputs),
    target("tables", 100, answers::tables),
    target("meshes", 500, meshes::meshes),
    target("steps", 260, course::steps),
    target("derive", 1_000, derive::derive),
    target("access", 500, derive::access),
    target("drawing", 1_000, drawing::plane),
    target("space", 660, drawing::space),
    target("density", 160, render::density),
    target("solid", 33, solid::solid),
    target("tiles", 130, tiles::tiles),
    target("formats", 260, formats::formats),
    target("pick", 1_000, pick::pick),
    target("export", 660, export::export),
    target("plots", 200, plots::plots),
    target("papers", 200, papers::papers),
    target("films", 67, films::films),
    target("find-strings", 200, find::strings_found),
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
