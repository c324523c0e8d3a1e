//! `cargo xtask ledger`: what the project costs its users and developers, beside the limits in `crates/xtask/ledger.md`.
//!
//! A section of the file is a kind of cost, a row one thing that has it. Limits only fall: `--write` lowers them to what
//! is measured and a margin, and the row `all` of a section may not have a higher limit than in the file's last commit.

mod bytes;
mod lines;
mod packages;
pub(crate) mod seconds;
mod table;

use crate::workspace::{Workspace, output};
use anyhow::{Result, bail};
use fs_err as fs;
use std::collections::BTreeMap;
use std::process::Command;
use table::{Row, Table};

/// The file of figures and limits.
const FILE: &str = "crates/xtask/ledger.md";
/// The row with the sum of a section.
const ALL: &str = "all";

/// What was measured in a section, by row. The row [`ALL`] is added.
type Measured = BTreeMap<String, f64>;

/// A kind of cost: the title of its section, the share of a figure by which its limit may be higher, how it is measured.
/// A kind that is not measured, because nothing has been built or run, gives no rows.
struct Kind {
    title: &'static str,
    margin: f64,
    measure: fn(&Workspace) -> Result<Measured>,
}

impl Kind {
    fn is_time(&self) -> bool {
        self.margin > 0.1
    }
}

const KINDS: [Kind; 10] = [
    Kind { title: "Bytes of the site", margin: 0.03, measure: bytes::site },
    Kind { title: "Bytes of single files", margin: 0.03, measure: bytes::single },
    Kind { title: "Bytes before the first picture", margin: 0.03, measure: bytes::first },
    Kind { title: "Lines of Rust that are shipped", margin: 0.03, measure: lines::shipped },
    Kind { title: "Lines of Rust for developers", margin: 0.03, measure: lines::tools },
    Kind { title: "Lines of JavaScript", margin: 0.03, measure: lines::scripts },
    Kind { title: "Packages of others", margin: 0.03, measure: packages::packages },
    Kind { title: "Programs as answers", margin: 0.03, measure: bytes::programs },
    Kind { title: "Processor seconds of the test", margin: 0.25, measure: seconds::of_test },
    Kind { title: "Processor seconds of serve", margin: 0.25, measure: seconds::of_serve },
];

/// The options of the command.
#[derive(clap::Args, Default)]
pub(crate) struct LedgerOptions {
    /// Write what is measured, and lower the limits to it; a limit is raised by hand only, where another one falls
    #[arg(long)]
    write: bool,
    /// First measure what it takes to serve a fresh clone of the last commit: some minutes
    #[arg(long)]
    serve: bool,
}

/// Prints the table of what is measured. An error names what is above its limit.
pub(crate) fn ledger(workspace: &Workspace, options: &LedgerOptions) -> Result<()> {
    compare(workspace, options, true)
}

/// As [`ledger()`], as a step of the test, which no time decides: what took too long is printed.
pub(crate) fn without_times(workspace: &Workspace) -> Result<()> {
    compare(workspace, &LedgerOptions::default(), false)
}

fn compare(workspace: &Workspace, options: &LedgerOptions, times_decide: bool) -> Result<()> {
    if options.serve {
        seconds::serve(workspace)?;
    }
    let file = workspace.root.join(FILE);
    let mut table = Table::read(&fs::read_to_string(&file)?)?;
    let former = Table::read(&former(workspace)?)?;
    let mut wrong = vec![];
    for kind in &KINDS {
        let measured = with_sum((kind.measure)(workspace)?);
        if measured.is_empty() {
            workspace.say(format_args!("{}: not measured", kind.title));
            continue;
        }
        if options.write {
            table.write(kind.title, kind.margin, &measured);
        }
        workspace.say(format_args!("\n{}", kind.title));
        for (name, &figure) in &measured {
            let row = table.row(kind.title, name);
            let before = former.row(kind.title, name);
            workspace.say(line(name, figure, row, before));
            match fault(kind, name, figure, row, before) {
                Some(fault) if kind.is_time() && !times_decide => workspace.say(fault),
                fault => wrong.extend(fault),
            }
        }
        // A row of a time is missing where a step was skipped.
        if !kind.is_time() {
            let gone = table.names(kind.title).filter(|name| !measured.contains_key(*name));
            wrong.extend(gone.map(|name| format!("{name} is gone: `cargo xtask ledger --write`")));
        }
    }
    if options.write {
        fs::write(&file, table.text())?;
    }
    if wrong.is_empty() {
        return Ok(());
    }
    bail!("{FILE}: {}", wrong.join("; "))
}

/// The rows and their sum.
fn with_sum(mut rows: Measured) -> Measured {
    if rows.len() > 1 {
        rows.insert(ALL.to_owned(), rows.values().sum());
    }
    rows
}

/// A row of the printed table: what, its figure, its limit, and the change of the figure.
fn line(name: &str, figure: f64, row: Option<Row>, before: Option<Row>) -> String {
    let limit = row.map_or("-".to_owned(), |row| format!("{:.0}", row.limit));
    let change = before.map_or("new".to_owned(), |before| format!("{:+.0}", figure - before.figure));
    format!("{name:<40} {figure:>10.0} {limit:>10} {change:>9}")
}

/// What is wrong with a row, if anything is.
fn fault(kind: &Kind, name: &str, figure: f64, row: Option<Row>, before: Option<Row>) -> Option<String> {
    let Some(row) = row else { return Some(format!("{name} has no row: `cargo xtask ledger --write`")) };
    if figure > row.limit {
        return Some(format!("{name} is {figure:.0}, above its limit of {:.0}", row.limit));
    }
    if row.limit > table::limit(row.figure, kind.margin) {
        return Some(format!("the limit of {name} is {:.0}, too far above {:.0}", row.limit, row.figure));
    }
    let rises = before.is_some_and(|before| row.limit > before.limit);
    (name == ALL && rises).then(|| format!("the limit of all in \"{}\" has risen", kind.title))
}

/// The file before its last change: as it was last committed if it has changed since, else as before that commit. Itself
/// where there is no history.
fn former(workspace: &Workspace) -> Result<String> {
    let now = fs::read_to_string(workspace.root.join(FILE))?;
    let git = |words: &[&str]| output(Command::new("git").args(words).current_dir(&workspace.root));
    let Ok(commits) = git(&["log", "--max-count=2", "--format=%H", "--", FILE]) else { return Ok(now) };
    let texts = commits.lines().filter_map(|commit| git(&["show", &format!("{commit}:{FILE}")]).ok());
    Ok(texts.into_iter().find(|text| *text != now).unwrap_or(now))
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: Kind = Kind { title: "Bytes", margin: 0.03, measure: |_| Ok(Measured::new()) };

    fn row(figure: f64, limit: f64) -> Option<Row> {
        Some(Row { figure, limit })
    }

    #[test]
    fn limits_are_kept_and_never_rise() {
        let fault = |figure, now, before| fault(&KIND, ALL, figure, now, before).unwrap_or_default();
        assert_eq!(fault(100.0, row(100.0, 103.0), row(100.0, 103.0)), "");
        assert_eq!(fault(103.0, row(100.0, 103.0), None), "");
        assert!(fault(104.0, row(100.0, 103.0), None).contains("above its limit"));
        assert!(fault(100.0, row(100.0, 104.0), None).contains("too far above"));
        assert!(fault(100.0, row(100.0, 103.0), row(90.0, 93.0)).contains("has risen"));
        assert!(fault(100.0, None, None).contains("has no row"));
    }

    #[test]
    fn the_file_has_the_sections_that_are_measured() {
        let workspace = Workspace::find().unwrap();
        let table = Table::read(&fs::read_to_string(workspace.root.join(FILE)).unwrap()).unwrap();
        let titles: Vec<&str> = table.titles().collect();
        assert_eq!(titles, KINDS.map(|kind| kind.title));
    }

    #[test]
    fn sums_are_rows() {
        let rows = [("a".to_owned(), 1.0), ("b".to_owned(), 2.0)];
        assert_eq!(with_sum(rows.into())[ALL], 3.0);
        assert!(with_sum(Measured::new()).is_empty());
    }
}
