//! The messages between JavaScript and the boundary crates, as types for JavaScript: `www/js/messages.d.ts`. `cargo xtask
//! tables` writes the file.

use crate::course::check::CheckReport;
use crate::course::class::{AboutClass, MarkedAnswer, MistakeReport};
use crate::course::exercise::{AboutExercise, MarkReport, VariantReport};
use crate::course::growth::GrowthReport;
use crate::export::ExportReport;
use crate::film::preset::PresetObject;
use crate::film::script::{ScriptObject, SubjectObject};
use crate::find::{FindQuestion, FindReport};
use crate::import::{ImportReport, WriteReport};
use crate::sound::TuneObject;
use expect_test::expect_file;
use lsystem_course::steps::{Rows, Single, Trace};
use lsystem_course::{Exercise, Varied};
use lsystem_session::{
    Anchor, FileRead, ModulePlace, Outcome, Picked, Report, SharedPane, StepAnswer, StringPage, SymbolFacts,
    TextClasses,
};
use std::collections::BTreeMap;
use ts_rs::{Config, TS, TypeVisitor};

const HEAD: &str = "// The messages between JavaScript and Rust: written by `cargo xtask tables` from the types in Rust, not by hand.\n";

/// Declarations of types, and of the types of their members.
struct Declarations {
    config: Config,
    /// By name: the library visits members in another order after each compilation.
    texts: BTreeMap<String, String>,
}

impl TypeVisitor for Declarations {
    fn visit<T: TS + 'static + ?Sized>(&mut self) {
        // Types without a place for a file are those of JavaScript itself.
        let name = T::ident(&self.config);
        if T::output_path().is_none() || self.texts.contains_key(&name) {
            return;
        }
        let docs = T::docs().unwrap_or_default();
        self.texts.insert(name, format!("\n{docs}export {}\n", T::decl(&self.config)));
        T::visit_dependencies(self);
    }
}

fn declarations() -> String {
    // Counts that may exceed the integers of JavaScript are texts.
    let config = Config::new().with_large_int("number");
    let mut all = Declarations { config, texts: BTreeMap::new() };
    macro_rules! visit {
        ($($name:ty),* $(,)?) => { $(all.visit::<$name>();)* };
    }
    visit!(
        Report,
        StepAnswer<'static>,
        StringPage,
        SymbolFacts,
        Picked,
        Anchor,
        TextClasses,
        ModulePlace,
        FileRead,
        SharedPane,
        Outcome
    );
    visit!(Exercise, AboutExercise<'static>, MarkReport, CheckReport, GrowthReport, Rows, Single, Trace);
    visit!(AboutClass<'static>, MarkedAnswer, MistakeReport, VariantReport, Varied);
    visit!(
        ExportReport,
        ImportReport,
        WriteReport,
        FindQuestion,
        FindReport,
        ScriptObject,
        SubjectObject,
        PresetObject,
        TuneObject
    );
    all.texts.into_values().fold(HEAD.to_owned(), |file, text| file + &text)
}

#[test]
fn the_types_of_messages_are_those_of_rust() {
    expect_file!["../../../www/js/messages.d.ts"].assert_eq(&declarations());
}
