//! wasm-bindgen's two programs, as the library they are made from: exactly the version that Cargo.lock names, and
//! nothing to install. That library is not documented upstream, so nothing else in this repository names it.

use anyhow::{Context, Result};
use std::ffi::OsString;
use std::path::Path;

/// Writes `name.js` (a classic script), `name_bg.wasm` and `name.d.ts` to `out`.
pub(crate) fn generate(wasm: &Path, out: &Path, name: &str) -> Result<()> {
    let mut words: Vec<OsString> = vec!["wasm-bindgen".into(), wasm.into(), "--out-dir".into(), out.into()];
    let options = ["--target", "no-modules", "--out-name", name, "--omit-default-module-path"];
    words.extend(options.map(OsString::from));
    words.extend(["--remove-name-section", "--remove-producers-section"].map(OsString::from));
    wasm_bindgen_cli::wasm_bindgen::run_cli_with_args(words)
        .with_context(|| format!("generating JavaScript for {}", wasm.display()))
}

/// Runs a wasm test binary in a headless browser. `words` are those of a command line, the program's name included.
pub(crate) fn test_runner(words: impl Iterator<Item = OsString>) -> Result<()> {
    wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(words)
}
