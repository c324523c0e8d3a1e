//! The test runner of wasm-bindgen, called as a library: at exactly the version in Cargo.lock, without installation.
//! Cargo runs this program for wasm test binaries, in the tested crate's folder (`.cargo/config.toml`).

fn main() -> anyhow::Result<()> {
    wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(std::env::args_os())
}
