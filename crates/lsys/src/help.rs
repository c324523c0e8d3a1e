//! The command line's help in the reader's language.

use crate::cli::Cli;
use clap::builder::StyledStr;
use clap::{Arg, Command, CommandFactory};
use lsystem::base::say;
use lsystem::base::words::said;

/// The command line with all its texts in the reader's language.
pub(crate) fn command() -> Command {
    let mut command = Cli::command();
    // Only a built command has the options that all commands share.
    command.build();
    translated(command)
}

/// A command with the texts of itself, its options and its commands in the reader's language.
fn translated(mut command: Command) -> Command {
    let text = |text: Option<&StyledStr>| text.map(|text| said(&text.to_string()));
    if let Some(about) = text(command.get_about()) {
        command = command.about(about);
    }
    if let Some(about) = text(command.get_long_about()) {
        command = command.long_about(about);
    }
    if let Some(notes) = text(command.get_after_help()) {
        command = command.after_help(notes);
    }
    let option = |mut arg: Arg| {
        if let Some(help) = text(arg.get_help()) {
            // The name of the language tells which one it is.
            let is_language = arg.get_id() == "language";
            arg = arg.help(if is_language { format!("{help} ({})", say!("English")) } else { help });
        }
        match text(arg.get_long_help()) {
            Some(help) => arg.long_help(help),
            None => arg,
        }
    };
    command.mut_args(option).mut_subcommands(translated)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn texts(command: &Command, found: &mut BTreeSet<String>) {
        let own = [command.get_about(), command.get_long_about(), command.get_after_help()];
        let options = command.get_arguments().flat_map(|arg| [arg.get_help(), arg.get_long_help()]);
        let texts = own.into_iter().chain(options).flatten().map(ToString::to_string);
        found.extend(texts.filter(|text| !text.is_empty()));
        command.get_subcommands().for_each(|command| self::texts(command, found));
    }

    /// Translations are made from this list. With `UPDATE_EXPECT=1` this writes it anew.
    #[test]
    fn all_texts_of_the_help_are_listed() {
        let mut found = BTreeSet::new();
        let mut command = Cli::command();
        command.build();
        texts(&command, &mut found);
        let list = serde_json::to_string_pretty(&found).unwrap();
        expect_test::expect_file!["../help.json"].assert_eq(&format!("{list}\n"));
    }
}
