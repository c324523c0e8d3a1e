//! Only the boundary crates, and the crate that they share, know JavaScript.

use std::fs;
use std::path::Path;

/// Crates of the developer, which are not shipped: measurements and tests in the browser, and the build.
const DEVELOPMENT: [&str; 3] = ["bench", "wasm-test-runner", "xtask"];

#[test]
fn only_boundary_crates_depend_on_wasm_bindgen() {
    let mut boundaries = vec![];
    for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).expect("a folder") {
        let folder = entry.expect("an entry").path();
        let name = folder.file_name().and_then(|name| name.to_str()).expect("UTF-8").to_owned();
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        let knows_javascript = ["wasm-bindgen", "js-sys", "web-sys"].iter().any(|name| manifest.contains(name));
        if knows_javascript && !DEVELOPMENT.contains(&name.as_str()) {
            boundaries.push(name);
        }
    }
    boundaries.sort();
    assert_eq!(boundaries, ["lsystem-js", "lsystem-library-wasm", "lsystem-tools-wasm", "lsystem-wasm"]);
}
