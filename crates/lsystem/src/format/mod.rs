//! Files.

mod csv;
mod json;
mod json_write;
mod number;
mod svg;

pub use csv::write_csv;
pub use json::read_json;
pub use json_write::write_json;
pub use svg::{SvgOptions, write_svg};
