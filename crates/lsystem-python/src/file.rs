//! Files of all formats.

use crate::check_interrupt;
use crate::problem::{error, halted};
use crate::system::{CoreSystem, DRAWING};
use lsystem::files::{FORMATS, FileLimits, FileOptions, FileTask, FileView, Format, OptionValue, Owner, PngOptions};
use lsystem::files::{Sink, make};
use lsystem::syntax::Halt;
use lsystem::{Definition, Limits};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::collections::BTreeMap;

/// The most segments of a mesh: some hundred megabytes, and more than most programs open.
const MESH_SEGMENTS: u64 = 500_000;

/// The bytes of a file with the drawing of a system after `n` derivation steps. `format` is a name or an ending; `options`
/// is a JSON object of options by their names.
#[pyfunction]
pub(crate) fn file<'py>(
    py: Python<'py>,
    system: &CoreSystem,
    format: &str,
    n: u32,
    options: &str,
) -> PyResult<Bound<'py, PyBytes>> {
    let Some(found) = FORMATS.iter().find(|own| own.name == format).or_else(|| by_ending(format)) else {
        let known: Vec<_> = FORMATS.iter().map(|format| format.name).collect();
        return Err(error(py, &format!("there is no format `{format}`; the formats are {}", known.join(", ")), vec![]));
    };
    let values: BTreeMap<String, OptionValue> =
        serde_json::from_str(options).map_err(|problem| error(py, &format!("options: {problem}"), vec![]))?;
    let options = FileOptions::from_values(&values).map_err(|problem| error(py, &problem, vec![]))?;
    let limits = Limits::default();
    let task = FileTask {
        definition: &Definition { iterations: n, ..system.definition.clone() },
        system: &system.system,
        format: found,
        options: &options,
        view: FileView { is_described: true, ..FileView::default() },
        limits: FileLimits {
            drawing: DRAWING,
            drawing_bytes: limits.memory,
            string: limits,
            remembers: false,
            segments: limits.segments,
            held: limits.segments,
            mesh: [MESH_SEGMENTS, limits.memory],
            band: PngOptions::default().band,
        },
    };
    let mut file = File(Vec::new());
    let made = py.detach(|| Sink::to(&mut file, |sink| make(&task, sink)));
    made.map_err(|halt| halted(py, halt))?;
    Ok(PyBytes::new(py, &file.0))
}

fn by_ending(ending: &str) -> Option<&'static Format> {
    FORMATS.iter().find(|format| format.ending == ending)
}

/// A file in memory, whose making the user may interrupt.
struct File(Vec<u8>);

impl Owner for File {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.0.extend_from_slice(bytes);
        Ok(())
    }

    fn spent(&mut self, _: u64) -> Result<(), Halt> {
        check_interrupt()
    }
}
