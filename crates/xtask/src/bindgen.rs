//! wasm-bindgen's generator, called as a library: at exactly the version in Cargo.lock, without installation. Its options
//! are the defaults of wasm-bindgen's program, which the library does not have by itself.

use anyhow::{Context, Result};
use std::path::Path;
use wasm_bindgen_cli_support::Bindgen;

/// Writes `NAME.js` (a classic script), `NAME_bg.wasm` and `NAME.d.ts` to `out`. With `has_names` the functions keep the
/// names that the linker has given.
pub(crate) fn generate(wasm: &Path, out: &Path, name: &str, has_names: bool) -> Result<()> {
    let mut generator = Bindgen::new();
    generator.no_modules(true)?.demangle(!has_names).remove_name_section(!has_names);
    generate_by(&mut generator, wasm, out, name)
}

/// As [`generate`], with a module in place of the script.
pub(crate) fn generate_module(wasm: &Path, out: &Path, name: &str) -> Result<()> {
    let mut generator = Bindgen::new();
    generator.web(true)?.demangle(true).remove_name_section(true);
    generate_by(&mut generator, wasm, out, name)
}

fn generate_by(generator: &mut Bindgen, wasm: &Path, out: &Path, name: &str) -> Result<()> {
    generator.input_path(wasm).out_name(name).typescript(true).omit_default_module_path(true);
    generator.remove_producers_section(true);
    generator.generate(out).with_context(|| format!("generating JavaScript for {}", wasm.display()))
}
