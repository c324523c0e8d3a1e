//! Systems.

use crate::check_interrupt;
use crate::drawing::CoreDrawing;
use crate::problem::{Problem, error, halted, refused};
use lsystem::files::{read_file, text_of, write_json, write_link};
use lsystem::import::{OWN_JSON, import_file};
use lsystem::syntax::{FIELDS, FieldSpec, Halt, Value, run_steps};
use lsystem::{Definition, Diagnostic, Figure, Limits, System, count_segments, count_symbols, expand};
use pyo3::prelude::*;
use std::collections::BTreeMap;

/// A definition that compiles, and its system.
#[pyclass(frozen, name = "System", module = "lsystem_playground._core")]
pub(crate) struct CoreSystem {
    pub(crate) definition: Definition,
    pub(crate) system: System,
    /// The warnings of the text and of the rules.
    #[pyo3(get)]
    warnings: Vec<Problem>,
}

#[pymethods]
impl CoreSystem {
    /// Reads the bytes of a file or of a text in any notation. `name` is for messages; `entry` is the name of a system in
    /// a text with several.
    #[staticmethod]
    fn read(py: Python<'_>, bytes: &[u8], name: &str, entry: Option<&str>) -> PyResult<Self> {
        // Our own JSON is read as a file of ours, so that messages show their places in it.
        let foreign = import_file(bytes).filter(|imported| imported.notation != OWN_JSON);
        let Some(imported) = foreign else {
            let read = read_file(bytes);
            let problems = read.diagnostics.iter().map(|problem| match &read.definition {
                Some(definition) => Problem::of(problem, name, definition.text(problem.field).unwrap_or(&read.json)),
                None => Problem::of(problem, name, &read.json),
            });
            return Self::compile(py, read.definition.as_ref(), problems.collect());
        };
        let names: Vec<_> = imported.entries.iter().map(|entry| entry.name.as_str()).collect();
        let found = match entry {
            Some(wanted) => imported.entries.iter().find(|entry| entry.name == wanted),
            None => imported.entries.first().filter(|_| names.len() == 1),
        };
        let Some(found) = found else {
            let message = format!("{name}: choose one of these systems by `entry`: {}", names.join(", "));
            return Err(error(py, &message, vec![]));
        };
        let text = text_of(bytes).unwrap_or_default();
        let remarks = found.remarks.iter().map(|remark| Problem::of_remark(remark, name, &text));
        Self::compile(py, found.definition.as_ref(), remarks.collect())
    }

    /// The default system with these fields, a JSON object: see [`CoreSystem::replace`].
    #[staticmethod]
    fn of(py: Python<'_>, fields: &str) -> PyResult<Self> {
        changed(py, &Definition::default(), fields)
    }

    /// The same system with other values of fields, a JSON object. A name of a field is that of links (`n`), of files
    /// (`num_iters`) or of the page (`iterations`).
    fn replace(&self, py: Python<'_>, fields: &str) -> PyResult<Self> {
        changed(py, &self.definition, fields)
    }

    /// All fields by their names in links, as JSON.
    fn fields(&self) -> String {
        let fields = FIELDS.iter().filter_map(|spec| Some((spec.link, spec.get(&self.definition)?)));
        serde_json::to_string(&fields.collect::<BTreeMap<_, _>>()).unwrap_or_default()
    }

    /// The name in links of a field with any of its names.
    #[staticmethod]
    fn field(name: &str) -> Option<&'static str> {
        FieldSpec::called(name).map(|spec| spec.link)
    }

    fn json(&self) -> String {
        write_json(&self.definition)
    }

    fn link(&self) -> String {
        write_link(&self.definition)
    }

    /// The string after `n` derivation steps.
    fn expand(&self, py: Python<'_>, n: u32) -> PyResult<String> {
        let made = py.detach(|| expand(&self.system, n, &Limits::default()));
        made.map_err(|limit| halted(py, limit.into()))
    }

    /// The exact numbers of symbols and segments after `n` derivation steps, in decimal digits.
    fn count(&self, py: Python<'_>, n: u32) -> PyResult<(String, String)> {
        py.detach(|| self.counted(n)).map_err(|halt| halted(py, halt))
    }

    /// The drawing after `n` derivation steps.
    fn draw(&self, py: Python<'_>, n: u32) -> PyResult<CoreDrawing> {
        let figure = py.detach(|| self.figure(n)).map_err(|halt| halted(py, halt))?;
        Ok(CoreDrawing { figure, style: self.system.style.clone() })
    }
}

impl CoreSystem {
    /// # Errors
    /// An exception with all problems if one is an error.
    fn compile(py: Python<'_>, definition: Option<&Definition>, mut warnings: Vec<Problem>) -> PyResult<Self> {
        if let Some(definition) = definition.filter(|_| !warnings.iter().any(Problem::is_error)) {
            let mut problems = vec![];
            let system = System::read(definition, &mut problems);
            warnings.extend(problems.iter().map(|problem| in_text(problem, definition)));
            if let Some(system) = system {
                return Ok(Self { definition: definition.clone(), system, warnings });
            }
        }
        Err(refused(py, warnings))
    }

    fn figure(&self, n: u32) -> Result<Figure, Halt> {
        let mut drawer = Figure::drawer(&self.system, n, DRAWING);
        run_steps(&mut Interrupt, |units| drawer.step(units))?;
        Ok(drawer.finish()?)
    }

    fn counted(&self, n: u32) -> Result<(String, String), Halt> {
        if let (Some(symbols), Some(segments)) = (count_symbols(&self.system, n), count_segments(&self.system, n)) {
            return Ok((symbols.to_string(), segments.to_string()));
        }
        let limits = Limits::default();
        let full = || Diagnostic::limit(lsystem::base::LimitName::Memory, limits.memory, None);
        let mut history = self.system.history(n, &limits).ok_or_else(full)?;
        run_steps(&mut Interrupt, |units| history.step(units as usize))?;
        let symbols = history.symbols(n).ok_or_else(full)?;
        let segments = match history.segments_before(symbols) {
            Some(segments) => segments,
            None => self.figure(n)?.turtle_segments(),
        };
        Ok((symbols.to_string(), segments.to_string()))
    }
}

/// The limits of a drawing, as in the program: its memory limits its segments.
pub(crate) const DRAWING: Limits =
    Limits { symbols: 256 << 20, modules: 32 << 20, segments: u32::MAX as u64, work: 1 << 30, memory: 1 << 30 };

/// Work that ends when the user interrupts Python.
pub(crate) struct Interrupt;

impl lsystem::syntax::Work for Interrupt {
    fn charge(&mut self, _: u64) -> Result<(), Halt> {
        check_interrupt()
    }
}

fn in_text(problem: &Diagnostic, definition: &Definition) -> Problem {
    Problem::of(problem, problem.field.name(), definition.text(problem.field).unwrap_or_default())
}

fn changed(py: Python<'_>, definition: &Definition, fields: &str) -> PyResult<CoreSystem> {
    let mut changed = definition.clone();
    let fields: BTreeMap<String, Value> =
        serde_json::from_str(fields).map_err(|problem| error(py, &format!("fields: {problem}"), vec![]))?;
    for (name, value) in fields {
        let spec = FieldSpec::called(&name).ok_or_else(|| {
            let known: Vec<_> = FIELDS.iter().filter(|spec| spec.is_defined()).map(|spec| spec.link).collect();
            error(py, &format!("there is no field `{name}`; the fields are {}", known.join(", ")), vec![])
        })?;
        if !spec.admits(&value) || !spec.set(&mut changed, &value) {
            return Err(error(py, &format!("{name}: {} must be {}", spec.label, spec.expected_words()), vec![]));
        }
    }
    CoreSystem::compile(py, Some(&changed), vec![])
}
