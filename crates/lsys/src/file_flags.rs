//! The flags of the choices for files, made from the table that the page's dialog is made from.

use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use lsystem::base::say;
use lsystem::base::words::said;
use lsystem::files::{FILE_OPTIONS, FORMATS, FileOption, FileOptions, Format, OptionKind, OptionValue};
use std::collections::BTreeMap;

/// The values of the flags that were given, by the names of [`FILE_OPTIONS`].
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FileFlags(BTreeMap<String, OptionValue>);

impl FileFlags {
    /// The options for files, with the defaults of flags that were not given.
    pub(crate) fn options(&self) -> FileOptions {
        // Clap has checked the values.
        FileOptions::from_values(&self.0).unwrap_or_default()
    }

    /// Checks that each given flag is read by one of the formats.
    ///
    /// # Errors
    /// The formats that read the first flag that these formats do not.
    pub(crate) fn check(&self, formats: &[&Format]) -> Result<(), String> {
        let reads = |format: &Format, name: &String| format.options.contains(&name.as_str());
        let Some(name) = self.0.keys().find(|name| !formats.iter().any(|format| reads(format, name))) else {
            return Ok(());
        };
        let names: Vec<_> = FORMATS.iter().filter(|format| reads(format, name)).map(|format| format.name).collect();
        Err(match names[..] {
            [] => say!("no format reads --{}", name),
            _ => say!("--{} needs --format {}", name, names.join(" or ")),
        })
    }
}

fn flag(option: &'static FileOption) -> Arg {
    let arg = Arg::new(option.name).long(option.name);
    let (value, default) = match option.kind {
        OptionKind::Flag => return arg.help(said(option.help)).action(ArgAction::SetTrue),
        OptionKind::Number { low, high, default, .. } => {
            (say!("{} to {}", low, high), format!("{default} {}", said(option.unit)).trim_end().to_owned())
        }
        OptionKind::Word { words, default } => {
            (words.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(", "), default.to_owned())
        }
        OptionKind::Sheet { default, .. } => (option.expected_words().replace('`', ""), default.to_owned()),
        OptionKind::Size => (say!("such as 4000x3000"), say!("as suits the drawing")),
    };
    let unit = if option.unit.is_empty() || matches!(option.kind, OptionKind::Sheet { .. }) {
        String::new()
    } else {
        say!(" in {}", said(option.unit))
    };
    let name = match option.kind {
        OptionKind::Size => "WxH",
        OptionKind::Word { .. } => "NAME",
        OptionKind::Sheet { .. } => "SIZE",
        _ => "NUMBER",
    };
    arg.help(say!("{}{}: {} [default: {}]", said(option.help), unit, value, default))
        .value_name(name)
        .allow_hyphen_values(true)
        .value_parser(|text: &str| option.parse(text))
}

impl Args for FileFlags {
    fn augment_args(command: Command) -> Command {
        FILE_OPTIONS.iter().fold(command, |command, option| command.arg(flag(option)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for FileFlags {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let given = |option: &FileOption| match option.kind {
            OptionKind::Flag => matches.get_flag(option.name).then_some(OptionValue::Flag(true)),
            _ => matches.get_one::<OptionValue>(option.name).cloned(),
        };
        let values = FILE_OPTIONS.iter().filter_map(|option| Some((option.name.to_owned(), given(option)?)));
        Ok(Self(values.collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::CommandFactory;

    #[test]
    fn every_choice_of_the_table_is_a_flag() {
        let mut cli = Cli::command();
        cli.build();
        let draw = cli.find_subcommand("draw").unwrap();
        for option in &FILE_OPTIONS {
            let flag = draw.get_arguments().find(|arg| arg.get_long() == Some(option.name)).unwrap();
            assert_eq!(flag.get_action().takes_values(), option.kind != OptionKind::Flag, "{option:?}");
            assert!(flag.get_help().unwrap().to_string().starts_with(option.help), "{option:?}");
        }
    }

    fn read(words: &[&str]) -> FileFlags {
        let command = FileFlags::augment_args(Command::new("lsys")).no_binary_name(true);
        FileFlags::from_arg_matches(&command.try_get_matches_from(words).unwrap()).unwrap()
    }

    #[test]
    fn flags_become_options() {
        assert_eq!(read(&[]).options(), FileOptions::default());
        let options = read(&["--sheet", "a3", "--landscape", "--margin=0", "--size", "30x20", "--bare"]).options();
        assert_eq!((options.sheet.width, options.sheet.height, options.sheet.margin), (420.0, 297.0, 0.0));
        assert_eq!((options.size, options.bare, options.transparent), (Some([30, 20]), true, false));
    }

    #[test]
    fn flags_that_no_chosen_format_reads_are_refused() {
        let formats = ["txt", "svg"].map(|name| Format::named(name).unwrap());
        assert_eq!(read(&["--transparent"]).check(&formats), Ok(()));
        assert!(read(&["--size=9x9"]).check(&formats).unwrap_err().starts_with("--size needs --format png"));
    }
}
