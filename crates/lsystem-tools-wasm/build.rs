//! Links the wasm with a maximum of memory.

/// The most bytes of one instance: a backstop. `FileLimits::PAGE` shares out half of this.
const MAX_MEMORY: u32 = 512 << 20;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_ARCH").as_deref() == Ok("wasm32") {
        println!("cargo::rustc-link-arg-cdylib=--max-memory={MAX_MEMORY}");
    }
}
