//! wasm-bindgen's two programs, called as a library: at exactly the version in Cargo.lock, without installation. The
//! library is not documented upstream, so only this file uses it.

use anyhow::{Context, Result};
use std::ffi::OsString;
use std::path::Path;

/// Writes `NAME.js` (a classic script), `NAME_bg.wasm` and `NAME.d.ts` to `out`.
pub(crate) fn generate(wasm: &Path, out: &Path, name: &str) -> Result<()> {
    generate_for("no-modules", wasm, out, name)
}

/// As [`generate`], with a module in place of the script.
pub(crate) fn generate_module(wasm: &Path, out: &Path, name: &str) -> Result<()> {
    generate_for("web", wasm, out, name)
}

fn generate_for(target: &str, wasm: &Path, out: &Path, name: &str) -> Result<()> {
    let mut words: Vec<OsString> = vec!["wasm-bindgen".into(), wasm.into(), "--out-dir".into(), out.into()];
    let options = ["--target", target, "--out-name", name, "--omit-default-module-path"];
    words.extend(options.map(OsString::from));
    words.extend(["--remove-name-section", "--remove-producers-section"].map(OsString::from));
    wasm_bindgen_cli::wasm_bindgen::run_cli_with_args(words)
        .with_context(|| format!("generating JavaScript for {}", wasm.display()))
}

/// Runs a wasm test binary in a headless browser. `words` is a command line with the program's name.
pub(crate) fn test_runner(words: impl Iterator<Item = OsString>) -> Result<()> {
    wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(words)
}
