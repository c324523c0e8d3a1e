//! Equal input gives equal bits natively and in the browser: the expected values were computed natively, and this
//! file runs on both.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_dedicated_worker);

use lsystem::Key;

#[test]
fn random_choices() {
    let key = Key::root(3).child(1, 2).child(2, 70_000);
    assert_eq!(
        [key.choice(0, 3).to_bits(), key.choice(u32::MAX, 1_000).to_bits()],
        [4_581_066_371_364_772_960, 4_586_746_024_706_360_656]
    );
}
