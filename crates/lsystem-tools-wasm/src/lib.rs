//! The boundary to JavaScript of the tools that few visits need. The page loads a part of this wasm with the first
//! call of each.

mod course;
mod export;
mod film;
mod find;
mod import;
mod invent;
mod sound;
#[cfg(test)]
mod tables;

pub use course::{
    ClassMarking, OpenExercise, check_output, growth, one_by_one, step_rows, turtle_trace, variant_of, variants_of,
    write_exercise,
};
pub use export::{make_file, make_package, make_picture};
pub use film::{FilmPlayer, read_film, subjects, with_preset};
pub use find::{GreyPicture, RuleFinder, outline_of_svg};
pub use import::{import_systems, write_system};
pub use invent::{DescentFilm, breed, surprise};
pub use sound::Listener;

use wasm_bindgen::prelude::*;

/// Sets the function that finds translations, as [`lsystem_js::set_reader`].
#[wasm_bindgen(js_name = setReader)]
pub fn set_reader(reader: js_sys::Function) {
    lsystem_js::set_reader(reader);
}
