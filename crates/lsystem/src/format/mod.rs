//! Files.

mod json;
mod json_write;

pub use json::read_json;
pub use json_write::write_json;
