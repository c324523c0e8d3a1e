//! Packages for learning systems.

use lsystem_base::say;
use lsystem_course::{PageWords, Scorm, ScormPages, ScormStandard, scorm_package};
use wasm_bindgen::prelude::*;

/// Makes a package for learning systems, the bytes of a zip. `exercises` are values of `x` in links; none stands for the
/// lesson. `steps`, `exercise` and `program` are the pages `package.html`, `exercise.html` and `program.html` of the site,
/// `standard` is `1.2` or `2004`. `catalogue` has the words of the package's language as JSON.
///
/// # Errors
/// Throws a sentence if an exercise is damaged, if there are too many, or if the pages are not those of this version.
#[wasm_bindgen(js_name = makePackage)]
#[expect(
    clippy::needless_pass_by_value,
    clippy::too_many_arguments,
    reason = "lists of texts cross the boundary by value only, and structs do not cross it"
)]
pub fn make_package(
    exercises: Vec<String>,
    title: &str,
    standard: &str,
    steps: &str,
    exercise: &str,
    program: &str,
    language: &str,
    catalogue: &str,
) -> Result<Vec<u8>, JsValue> {
    let standard = ScormStandard::named(standard).ok_or_else(|| say!("There is no SCORM {}.", standard))?;
    let scorm = Scorm { title, exercises: &exercises, standard };
    let words = (language != "en").then_some(PageWords { language, catalogue });
    scorm_package(&scorm, &ScormPages { steps, exercise, program: Some(program), words }).map_err(JsValue::from)
}
