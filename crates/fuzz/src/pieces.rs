//! What random texts are made of: `pieces.json`, by target.

use std::collections::BTreeMap;
use std::sync::LazyLock;

static ALL: LazyLock<BTreeMap<String, Vec<&'static str>>> = LazyLock::new(|| {
    let all: BTreeMap<String, Vec<String>> =
        serde_json::from_str(include_str!("../pieces.json")).expect("lists of texts");
    all.into_iter().map(|(name, list)| (name, list.into_iter().map(|text| &*text.leak()).collect())).collect()
});

/// The pieces with this name.
pub(crate) fn pieces(name: &str) -> &'static [&'static str] {
    &ALL[name]
}
