//! The core for Python: the native part of the package `lsystem_playground`, whose Python part is in `python/`.
//!
//! The classes here only translate. Long work runs without Python's lock and ends when the user interrupts it.

mod drawing;
mod file;
mod problem;
mod system;

use drawing::CoreDrawing;
use lsystem::syntax::Halt;
use problem::Problem;
use pyo3::prelude::*;
use system::CoreSystem;

/// The module `lsystem_playground._core`.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<CoreSystem>()?;
    module.add_class::<CoreDrawing>()?;
    module.add_class::<Problem>()?;
    module.add_function(wrap_pyfunction!(file::file, module)?)
}

/// Ends the work if the user has interrupted Python.
pub(crate) fn check_interrupt() -> Result<(), Halt> {
    let is_interrupted = Python::attach(|py| py.check_signals().is_err());
    if is_interrupted { Err(Halt::Stopped) } else { Ok(()) }
}
