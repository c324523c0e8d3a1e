//! The command line's help in the reader's language.

use crate::cli::Cli;
use crate::language;
use clap::builder::{PossibleValue, StyledStr};
use clap::{Arg, Command, CommandFactory};
use lsystem::base::say;
use lsystem::base::words::said;

/// The command line with all its texts in the reader's language.
pub(crate) fn command() -> Command {
    let mut command = Cli::command();
    // Only a built command has the options that all commands share.
    command.build();
    let command = translated(command);
    if language::code() == "en" { command } else { with_own_words(command) }
}

/// A command whose help has the words in the reader's language that clap writes itself.
fn with_own_words(command: Command) -> Command {
    // As clap's own template, but for its first word.
    let template =
        format!("{{before-help}}{{about-with-newline}}\n{} {{usage}}\n\n{{all-args}}{{after-help}}", say!("Usage:"));
    // Clap adds the colon.
    let heading = |text: String| text.trim_end_matches(':').to_owned();
    let command = command.help_template(template).subcommand_help_heading(heading(say!("Commands:")));
    let arg = |arg: Arg| {
        let arg = with_remarks(arg);
        match arg.get_index() {
            Some(place) => arg.display_order(place).help_heading(heading(say!("Arguments:"))),
            None => arg.help_heading(heading(say!("Options:"))),
        }
    };
    command.mut_args(arg).mut_subcommands(with_own_words)
}

/// An option whose help tells default, aliases and possible values itself, laid out as clap does.
fn with_remarks(mut arg: Arg) -> Arg {
    if !arg.get_action().takes_values() {
        return arg;
    }
    let (mut remarks, mut list) = (Vec::new(), String::new());
    if !arg.is_hide_default_value_set() && !arg.get_default_values().is_empty() {
        let values: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
        remarks.push(say!("[default: {}]", values.join(" ")));
    }
    let aliases: Vec<String> = arg.get_visible_aliases().unwrap_or_default().into_iter().map(str::to_owned).collect();
    if !aliases.is_empty() {
        let names: Vec<_> = aliases.iter().map(|name| format!("--{name}")).collect();
        remarks.push(say!("[alias: {}]", names.join(", ")));
        arg = arg.visible_alias(None).aliases(aliases);
    }
    let values = if arg.is_hide_possible_values_set() { vec![] } else { arg.get_possible_values() };
    let names: Vec<_> = values.iter().map(PossibleValue::get_name).collect();
    let is_told = values.iter().any(|value| value.get_help().is_some());
    let choice = (!names.is_empty()).then(|| say!("[possible values: {}]", names.join(", ")));
    if is_told {
        let width = names.iter().map(|name| name.len()).max().unwrap_or_default() + 1;
        list = format!("\n\n{}", say!("Possible values:"));
        for value in &values {
            let help = value.get_help().map_or_else(String::new, |help| said(&help.to_string()));
            list += &format!("\n- {:width$} {help}", format!("{}:", value.get_name()));
        }
    }
    let text = |text: Option<&StyledStr>| text.map_or_else(String::new, ToString::to_string);
    let (short, long) = (text(arg.get_help()), text(arg.get_long_help().or(arg.get_help())));
    let in_short = [&remarks[..], choice.as_slice()].concat().join(" ");
    let in_long = if is_told { remarks } else { [&remarks[..], choice.as_slice()].concat() };
    if in_short.is_empty() {
        return arg;
    }
    let below = if in_long.is_empty() { String::new() } else { format!("\n\n{}", in_long.join("\n")) };
    let (short, long) = (format!("{short} {in_short}"), format!("{long}{list}{below}"));
    let arg = arg.hide_default_value(true).hide_possible_values(true);
    arg.help(short.trim_start().to_owned()).long_help(long.trim_start().to_owned())
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
        let values = command.get_arguments().flat_map(Arg::get_possible_values);
        found.extend(values.filter_map(|value| Some(value.get_help()?.to_string())));
        command.get_subcommands().for_each(|command| self::texts(command, found));
    }

    /// Pages of help, each line without the blanks at its end.
    fn pages(command: &mut Command) -> Vec<String> {
        let pages = [command.render_help().to_string(), command.render_long_help().to_string()];
        let mut pages = pages.map(|page| page.lines().map(|line| line.trim_end().to_owned() + "\n").collect()).to_vec();
        command.get_subcommands_mut().for_each(|command| pages.extend(self::pages(command)));
        pages
    }

    #[test]
    fn the_help_is_laid_out_as_by_clap() {
        let own = pages(&mut with_own_words(command()));
        for (own, of_clap) in own.iter().zip(pages(&mut command())) {
            assert_eq!(*own, of_clap);
        }
        assert!(own.len() > 40, "{}", own.len());
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
