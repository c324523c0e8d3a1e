//! Bounds the memory of the wasm: no drawing, whatever its definition, takes more from the browser.

/// All of a page's workers together may have this many bytes; a single one never has more.
const MOST_MEMORY: u32 = 512 << 20;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_ARCH").as_deref() == Ok("wasm32") {
        println!("cargo::rustc-link-arg-cdylib=--max-memory={MOST_MEMORY}");
    }
}
