//! What every entry point may cost, in counted work, over unusual systems of all kinds and lengths.
//!
//! `cargo test -p lsystem --test cost -- --nocapture` prints the largest step of each entry point.

mod systems;
