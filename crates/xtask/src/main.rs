//! The developer's tool. The first word of the command line is the command.

mod bench;
mod bindgen;
mod build;
mod docs;
mod esbuild;
mod exercises;
mod files;
mod fuzz;
mod gallery;
mod include;
mod joined;
mod lint;
mod monkey;
mod mutants;
mod offline;
mod one_file;
mod outside;
mod package;
mod page;
mod report;
mod serve;
mod server;
mod size;
mod test;
mod tools;
mod wasms;
mod workspace;

use anyhow::{Result, bail};
use std::ffi::OsString;
use std::process::ExitCode;
use workspace::{Workspace, run as run_program};

const USAGE: &str = "\
usage: cargo xtask COMMAND

  build                  the page, ready to be put on any static host under any path: dist/
  serve [--port N]       build, then serve dist/ on this machine (port 8080 or the next free one)
  test [--thorough] [PART ...]
                         all checks before a merge; PART is any of lint, native, outside, fuzz, wasm, size,
                         page;
                         --thorough makes the property tests long
  lint                   formatting, clippy and documentation; warnings are errors
  outside                open files of all formats with programs of other people, and compare what they find with
                         what lsys tells
  package                the npm package: target/npm/node_modules/lsystem/; the crates as for the registry: target/package/
  tables                 update www/js/tables.js from the tables of the core; a test fails when the file is out of date
  fuzz [TARGET ...] [--minutes M] [--seed N] [--guided]
                         try random inputs, M minutes (1) for all targets together; --guided lets libFuzzer choose
                         inputs by the code that they reach (needs a C++ compiler)
  fuzz TARGET --input FILE [--shrink]
                         try one input again; --shrink makes the input smaller first
  bench [PART ...]       compare speed with other implementations; PART is any of native, web, pictures,
                         page (how fast the page responds), load (the cost of opening the page and ten embedded
                         drawings), space (times of pictures in space, moving and at rest),
                         shares (times of pictures that several workers share),
                         find (rules of pictures: how many are found, and when),
                         plot (ink, travel and time of plots, beside vpype's linemerge and linesort)
  monkey [--minutes M] [--seed S [--actions N]] [--verbose]
                         random actions on the page and on embedded drawings, M minutes (1); equal seeds give equal
                         actions
  mutants [--all] [ARGS] check that tests detect changes of the core's code: a fixed sample of mutants, all of them, or
                         those that ARGS of cargo-mutants choose, such as --shard 3/40 or --file drawing/hull.rs

Needs: Rust by rustup (the wasm target is added when missing), Node.js 20 or newer with npm; for test, bench and monkey
also Chromium and ChromeDriver (installed when missing where this runs as root on Debian); for test and outside Python
3.11 or newer, and ffmpeg, poppler-utils and LaTeX with TikZ where they are installed.
";

fn main() -> ExitCode {
    let mut words = std::env::args_os();
    let program = words.next().unwrap_or_default();
    let Some(command) = words.next() else {
        print!("{USAGE}");
        return ExitCode::FAILURE;
    };
    match run(&program, &command.to_string_lossy(), words.collect()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(program: &OsString, command: &str, rest: Vec<OsString>) -> Result<()> {
    // Cargo runs this command for every wasm test binary (.cargo/config.toml), in the tested crate's folder.
    if command == "wasm-bindgen-test-runner" {
        return bindgen::test_runner([program.clone()].into_iter().chain(rest));
    }
    let mut words = rest.iter().map(|word| word.to_str().unwrap_or("�"));
    match command {
        "build" => {
            no_more(words)?;
            build::build(&Workspace::find()?)
        }
        "serve" => {
            let port = match (words.next(), words.next()) {
                (None, _) => None,
                (Some("--port"), Some(port)) => Some(port.parse::<u16>().or_else(|_| bail!("`{port}` is not a port"))?),
                _ => bail!("usage: cargo xtask serve [--port N]"),
            };
            no_more(words)?;
            serve::serve(&Workspace::find()?, port)
        }
        "test" => test::test(&Workspace::find()?, &test::TestOptions::read(words)?),
        "lint" => {
            no_more(words)?;
            test::test(&Workspace::find()?, &test::TestOptions::read(["lint"].into_iter())?)
        }
        "tables" => {
            no_more(words)?;
            let tables = ["test", "--package=lsystem", "--test=tables"];
            run_program(Workspace::find()?.cargo(tables).env("UPDATE_EXPECT", "1"))
        }
        "outside" => {
            no_more(words)?;
            outside::check(&Workspace::find()?)
        }
        "package" => {
            no_more(words)?;
            package::package(&Workspace::find()?)
        }
        "mutants" => mutants::mutants(&Workspace::find()?, words),
        "fuzz" => fuzz::fuzz(&Workspace::find()?, words),
        "bench" => bench::bench(&Workspace::find()?, words),
        "monkey" => monkey::monkey(&Workspace::find()?, &monkey::MonkeyOptions::read(words)?),
        "help" | "--help" | "-h" => {
            print!("{USAGE}");
            Ok(())
        }
        _ => bail!("there is no command `{command}`\n\n{USAGE}"),
    }
}

/// Fails if there is another word.
fn no_more<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<()> {
    words.next().map_or(Ok(()), |word| bail!("unexpected `{word}`; `cargo xtask help` lists the commands"))
}
