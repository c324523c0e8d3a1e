//! The cost of every entry point, in counted work, for unusual systems of all kinds and lengths.
//!
//! `cargo test -p lsystem-playground --test cost -- --nocapture` prints the largest step of each entry point.

mod derivation;
mod drawing;
mod files;
mod pictures;
mod record;
mod syntax;
mod systems;
