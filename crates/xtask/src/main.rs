//! The developer's tool.

mod bench;
mod bindgen;
mod build;
mod child;
mod esbuild;
mod files;
mod fuzz;
mod html;
mod joined;
mod ledger;
mod lint;
mod monkey;
mod mutants;
mod notices;
mod offline;
mod one_file;
mod outside;
mod package;
mod page;
mod program;
mod python;
mod report;
mod serve;
mod server;
mod split;
mod steps_page;
mod test;
mod tools;
mod wasms;
mod workspace;

use anyhow::Result;
use clap::Parser;
use std::process::ExitCode;
use workspace::{Kind, Workspace};

/// The developer's tool of the L-system playground.
///
/// Needs: Rust by rustup (the wasm target is added when missing), Node.js 20 or newer with npm; for test, bench and
/// monkey also Chromium and ChromeDriver (installed when missing where this runs as root on Debian); for test and outside
/// Python 3.11 or newer, and ffmpeg, poppler-utils and LaTeX with TikZ where they are installed.
///
/// Minutes in brackets are about those of two cores after the first compilation, which takes ten.
#[derive(Parser)]
#[command(name = "cargo xtask")]
enum Command {
    /// The page, ready to be put on any static host under any path: dist/ (3; without changes of the core 1)
    Build(build::BuildOptions),
    /// The page, and the program lsys with pages inside: target/release/lsys (8)
    Program,
    /// Build a draft of the page quickly, and serve it on this machine (1; 2 on a new machine)
    Serve(serve::ServeOptions),
    /// All checks before a merge (12, and less for what has passed); `test quick` while working (2)
    Test(test::TestOptions),
    /// Formatting, clippy and documentation; warnings are errors (2)
    Lint,
    /// What the project costs its users and developers, beside its limits: crates/xtask/ledger.md (0)
    Ledger(ledger::LedgerOptions),
    /// Open files of all formats with programs of other people, and compare what they find with what lsys tells (1)
    Outside,
    /// The npm package: target/npm/node_modules/lsystem/; the crates as for the registry: target/package/; their
    /// interfaces compared with an older revision, and their documentation as docs.rs makes it (6)
    Package(package::PackageOptions),
    /// The page, and the Python package ready for `maturin build`: crates/lsystem-python/ (3)
    Python,
    /// Update the tables in www/js, the JSON Schema of files and the types of the npm package from the tables of the core,
    /// and www/js/messages.d.ts from the messages of the boundary; tests fail when the files are out of date (2)
    Tables,
    /// Try random inputs (as many as asked for; 1)
    Fuzz(fuzz::FuzzOptions),
    /// Compare speed with other implementations (30)
    Bench {
        /// All parts if none is named
        parts: Vec<bench::Part>,
    },
    /// Random actions on the page and on embedded drawings (as many as asked for): `--minutes M`, `--seed S` and with it
    /// `--actions N` for equal actions, `--verbose` to print each
    Monkey {
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        words: Vec<String>,
    },
    /// Check that tests detect changes of the core's code: a fixed sample of mutants (60), `--all` of them, or those that
    /// arguments of cargo-mutants choose, such as `--shard 3/40` or `--file drawing/hull.rs`
    Mutants {
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        words: Vec<String>,
    },
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    let command = Command::parse();
    let workspace = &Workspace::find()?;
    match command {
        Command::Build(options) => build::build(workspace, Kind::Shipped, options.address()?.as_ref()),
        Command::Program => program::program(workspace),
        Command::Serve(options) => serve::serve(workspace, &options),
        Command::Test(options) => test::test(workspace, &options),
        Command::Lint => lint::lint(workspace),
        Command::Ledger(options) => ledger::ledger(workspace, &options),
        Command::Outside => test::test(workspace, &test::TestOptions::only(test::Part::Outside)),
        Command::Package(options) => package::package(workspace, &options),
        Command::Python => python::python(workspace),
        Command::Tables => {
            let packages = ["--package=lsystem-playground", "--package=lsystem-tools-wasm"];
            let tests = ["test", "--lib", "--test=all", "tables::"].into_iter().chain(packages);
            workspace.run(workspace.cargo(tests).env("UPDATE_EXPECT", "1"))
        }
        Command::Fuzz(options) => fuzz::fuzz(workspace, options),
        Command::Bench { parts } => bench::bench(workspace, &parts),
        Command::Monkey { words } => monkey::monkey(workspace, &words),
        Command::Mutants { words } => mutants::mutants(workspace, &words),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_command_line_is_well_formed() {
        Command::command().debug_assert();
        for right in [
            "test quick",
            "test page native --all --thorough",
            "serve --port 80 --watch",
            "mutants --shard 3/9",
            "monkey --seed 3 --actions 3",
            "build --site",
            "build --site https://a.example/l/",
        ] {
            Command::try_parse_from(["xtask"].into_iter().chain(right.split(' '))).unwrap();
        }
        for wrong in ["test pages", "serve now", "fuzz --minutes x"] {
            assert!(Command::try_parse_from(["xtask"].into_iter().chain(wrong.split(' '))).is_err(), "{wrong}");
        }
    }
}
