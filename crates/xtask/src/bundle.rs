//! Joins the page's modules into one classic script, for pages that are a single file: modules are refused from
//! file:// and in frames without an origin.
//!
//! Every module becomes a function that returns what it exports, and they run in the order of their imports. That is
//! all that a bundler has to do where modules import each other by relative names, without cycles, and export nothing
//! that changes; anything else is an error here, so that what is joined behaves like what was written.
//!
//! One module may be imported while running: it comes, with what it alone imports, in a script of its own or in the same.

use crate::files;
use anyhow::{Context, Result, bail, ensure};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Component, Path, PathBuf};

/// The script that does what the module `entry` does, with everything it imports.
pub(crate) fn bundle(entry: &Path) -> Result<String> {
    let mut bundle = Bundle::default();
    bundle.add(entry)?;
    Ok(format!("(async () => {{\n'use strict';\n{}}})();\n", bundle.script))
}

/// The same in two scripts: what `entry` imports while running is in the second, which is asked for under this name.
pub(crate) fn bundle_in_two(entry: &Path, second_name: &str) -> Result<[String; 2]> {
    let mut bundle = Bundle { apart: true, ..Bundle::default() };
    bundle.add(entry)?;
    let first = std::mem::take(&mut bundle.script);
    let later = bundle.later.clone().with_context(|| format!("{} imports nothing while running", entry.display()))?;
    let known: Vec<String> = bundle.names.values().cloned().collect();
    let value = bundle.add(&later)?;
    let second = bundle.script;
    // The second has the values of the modules in the first that it imports.
    let shared: Vec<String> = known.into_iter().filter(|name| second.contains(&format!("= {name};"))).collect();
    let shared = shared.join(", ");
    let ask = format!(
        "new Promise((done, fail) => {{\n\
         globalThis.later = {{ shared: {{ {shared} }}, done, fail }};\n\
         const script = document.createElement('script');\n\
         script.onerror = () => fail(new Error('{second_name} does not load'));\n\
         script.onload = () => globalThis.later && script.onerror();\n\
         script.src = '{second_name}';\n\
         document.head.append(script);\n}})"
    );
    Ok([
        format!("(async () => {{\n'use strict';\n{}}})();\n", first.replacen(LATER, &ask, 1)),
        format!(
            "(({{ shared, done, fail }}) => (async () => {{\n'use strict';\nconst {{ {shared} }} = shared;\n\
             {second}return {value};\n}})().then(done, fail))(globalThis.later);\nglobalThis.later = null;\n"
        ),
    ])
}

/// Stands where the second script is asked for, until it is known what that needs of the first.
const LATER: &str = "<later>";

#[derive(Default)]
struct Bundle {
    /// The modules that are written, and the names of their values.
    names: BTreeMap<PathBuf, String>,
    /// Those whose imports are being written, from the entry on.
    open: Vec<PathBuf>,
    script: String,
    /// Whether what is imported while running comes in a script of its own.
    apart: bool,
    /// What that is.
    later: Option<PathBuf>,
}

impl Bundle {
    /// Writes a module behind those it imports, and returns the name of its value.
    fn add(&mut self, path: &Path) -> Result<String> {
        if let Some(name) = self.names.get(path) {
            return Ok(name.clone());
        }
        let shown = path.display();
        ensure!(!self.open.iter().any(|open| open == path), "{shown} imports itself, by way of others");
        self.open.push(path.to_owned());
        let text = files::read_text(path)?;
        let module = self.module(path, &without_comments(&text)).with_context(|| format!("joining {shown}"))?;
        self.open.pop();
        let name = format!("module{}", self.names.len());
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        // Each may await something before it is there, as modules may.
        write!(self.script, "// {file}\nconst {name} = await (async () => {{\n{module}}})();\n")?;
        self.names.insert(path.to_owned(), name.clone());
        Ok(name)
    }

    /// The body of a module's function.
    fn module(&mut self, path: &Path, text: &str) -> Result<String> {
        let mut body = String::new();
        let mut exports = vec![];
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            if line.starts_with("import ") {
                let mut statement = line.to_owned();
                while !statement.ends_with(';') {
                    statement.push_str(lines.next().context("an import does not end")?);
                }
                let (clause, source) = import(&statement)?;
                let name = self.add(&beside(path, source))?;
                match clause {
                    None => {}
                    Some(clause) => writeln!(body, "const {} = {name};", clause.replace(" as ", ": "))?,
                }
            } else if let Some(declaration) = line.strip_prefix("export ") {
                exports.push(exported(declaration)?);
                writeln!(body, "{declaration}")?;
            } else if imports_later(line) {
                writeln!(body, "{}", self.later(path, line)?)?;
            } else {
                ensure!(!line.contains("import.meta"), "a joined script has no import.meta");
                writeln!(body, "{line}")?;
            }
        }
        writeln!(body, "return {{ {} }};", exports.join(", "))?;
        Ok(body)
    }

    /// A line that imports a module while running.
    fn later(&mut self, path: &Path, line: &str) -> Result<String> {
        let read = || {
            let (before, rest) = line.split_once("import('")?;
            let (source, after) = rest.split_once("')")?;
            Some((before, source, after)).filter(|_| source.starts_with('.'))
        };
        let (before, source, after) = read().with_context(|| format!("`{}` is not joined", line.trim()))?;
        ensure!(self.later.is_none(), "`{}`: a second module that is imported while running", line.trim());
        let later = beside(path, source);
        let value = match self.apart {
            true => LATER.to_owned(),
            false => format!("Promise.resolve({})", self.add(&later)?),
        };
        self.later = Some(later);
        Ok(format!("{before}{value}{after}"))
    }
}

/// The clause of an import as a pattern but for `as`, and where from; there is no clause where only what the module
/// does is wanted.
fn import(statement: &str) -> Result<(Option<String>, &str)> {
    let read = || {
        let rest = statement.strip_prefix("import ")?.strip_suffix("';")?;
        let (clause, source) = rest.rsplit_once('\'')?;
        let clause = clause.trim();
        if clause.is_empty() {
            return Some((None, source));
        }
        let clause = clause.strip_suffix("from")?.trim();
        let names = clause.strip_prefix("* as ");
        let is_list = clause.starts_with('{') && clause.ends_with('}');
        (is_list || names.is_some()).then(|| (Some(names.unwrap_or(clause).to_owned()), source))
    };
    read().filter(|(_, source)| source.starts_with('.')).with_context(|| format!("`{statement}` is not joined"))
}

/// The name that a declaration exports.
fn exported(declaration: &str) -> Result<&str> {
    let mut words = declaration.split(|character: char| !(character.is_alphanumeric() || "_$".contains(character)));
    let mut word = words.next();
    if word == Some("async") {
        word = words.next();
    }
    let name = words.next().unwrap_or_default();
    match word {
        Some("function" | "const" | "class") if !name.is_empty() => Ok(name),
        _ => bail!("`export {declaration}` is not joined: name what is exported as a function, a const or a class"),
    }
}

/// The text without lines that are comments and nothing else, which are many in ours. A template that spans lines may not
/// hold such a line.
pub(crate) fn without_comments(text: &str) -> String {
    let mut result = String::new();
    let mut inside = false;
    for line in text.lines() {
        let code = line.trim();
        let begins = !inside && code.starts_with("/*");
        let behind = code.split_once("*/").map(|(_, behind)| behind);
        match behind {
            _ if !inside && code.starts_with("//") => continue,
            None if begins || inside => {
                inside = true;
                continue;
            }
            Some("") if begins || inside => {
                inside = false;
                continue;
            }
            Some(behind) if inside => {
                inside = false;
                result.push_str(behind);
            }
            _ => result.push_str(line),
        }
        result.push('\n');
    }
    result
}

/// The text without comments, indentation and empty lines, as it is sent. A line that leaves a template open is an
/// error: what follows would be part of it.
pub(crate) fn squeezed(text: &str) -> Result<String> {
    let mut result = String::new();
    for line in without_comments(text).lines().map(str::trim).filter(|line| !line.is_empty()) {
        ensure!(line.matches('`').count() % 2 == 0, "`{line}` leaves a template open");
        result.push_str(&without_casts(line));
        result.push('\n');
    }
    Ok(result)
}

/// The line without comments that only tell its type to the checker.
fn without_casts(line: &str) -> String {
    let (mut result, mut rest) = (String::new(), line);
    while let Some((before, (_, after))) =
        rest.split_once("/** @type {").and_then(|(before, cast)| Some((before, cast.split_once("} */")?)))
    {
        result.push_str(before);
        rest = after.trim_start();
    }
    result + rest
}

/// Whether a line imports while running, other than in a comment's types.
fn imports_later(line: &str) -> bool {
    let code = line.split("/*").next().unwrap_or_default().trim_start();
    let comment = code.starts_with('*') || code.starts_with("//");
    let mut before = code.split("import(");
    let first = before.next().unwrap_or_default();
    !comment && before.next().is_some() && !first.ends_with(|last: char| last.is_alphanumeric() || last == '.')
}

/// A relative address seen from a file.
fn beside(file: &Path, address: &str) -> PathBuf {
    let mut path = file.to_owned();
    path.pop();
    for part in Path::new(address).components() {
        match part {
            Component::ParentDir => _ = path.pop(),
            Component::Normal(name) => path.push(name),
            _ => {}
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(modules: &[(&str, &str)]) -> Result<String> {
        let folder = tempfile::tempdir()?;
        for (name, text) in modules {
            files::write(&folder.path().join(name), text)?;
        }
        bundle(&folder.path().join("main.js"))
    }

    #[test]
    fn casts_are_not_sent() {
        let line = "const a = /** @type {{x: number}} */ (b(/** @type {any} */ (c)));";
        assert_eq!(without_casts(line), "const a = (b((c)));");
        assert_eq!(without_casts("const type = '/** @type';"), "const type = '/** @type';");
    }

    #[test]
    fn joins_modules_in_the_order_of_their_imports() {
        let script = joined(&[
            ("main.js", "import { a, b as c } from './in/a.js';\nimport {\n    d,\n} from './d.js';\nuse(a, c, d);\n"),
            (
                "in/a.js",
                "import * as all from '../d.js';\nimport '../d.js';\nexport const a = all.d;\nexport function b() {}\n",
            ),
            ("d.js", "/** @type {import('./in/a.js').A} */\nexport const d = 1;\n"),
        ]);
        let expected = "(async () => {\n'use strict';\n\
            // d.js\nconst module0 = await (async () => {\nconst d = 1;\nreturn { d };\n})();\n\
            // a.js\nconst module1 = await (async () => {\nconst all = module0;\nconst a = all.d;\nfunction b() {}\nreturn { a, b };\n})();\n\
            // main.js\nconst module2 = await (async () => {\nconst { a, b: c } = module1;\nconst {    d,} = module0;\nuse(a, c, d);\nreturn {  };\n})();\n\
            })();\n";
        assert_eq!(script.unwrap(), expected);
    }

    #[test]
    fn refuses_what_would_behave_otherwise() {
        for (text, wrong) in [
            ("export let a = 1;\n", "export let"),
            ("export default 1;\n", "export default"),
            ("export * from './a.js';\n", "export *"),
            ("export { a };\n", "export {"),
            ("import a from './a.js';\n", "import a"),
            ("import { a } from 'elsewhere';\n", "elsewhere"),
            ("import { a } from './gone.js';\n", "gone.js"),
            ("const a = await import(name);\n", "import(name)"),
            ("import('./a.js');\nimport('./a.js');\n", "a second"),
            ("use(import.meta.url);\n", "import.meta"),
            ("import './main.js';\n", "imports itself"),
        ] {
            let error = format!("{:#}", joined(&[("main.js", text), ("a.js", "")]).unwrap_err());
            assert!(error.contains(wrong), "{text}: {error}");
        }
    }

    #[test]
    fn puts_off_what_is_imported_while_running() {
        let modules = [
            ("main.js", "import { a } from './a.js';\nimport('./late.js').then(({ b }) => b(a));\n"),
            ("a.js", "export const a = 1;\n"),
            ("late.js", "import { a } from './a.js';\nimport { c } from './c.js';\nexport const b = () => a + c;\n"),
            ("c.js", "export const c = 2;\n"),
        ];
        let whole = joined(&modules).unwrap();
        assert!(whole.contains("\nPromise.resolve(module2).then(({ b }) => b(a));\n"), "{whole}");
        assert!(whole.contains("const b = () => a + c;") && whole.contains("const c = 2;"), "{whole}");

        let folder = tempfile::tempdir().unwrap();
        for (name, text) in modules {
            files::write(&folder.path().join(name), text).unwrap();
        }
        let [first, second] = bundle_in_two(&folder.path().join("main.js"), "later.js").unwrap();
        assert!(first.contains("const a = 1;") && !first.contains("const c = 2;"), "{first}");
        assert!(first.contains("shared: { module0 }") && first.contains("script.src = 'later.js';"), "{first}");
        assert!(second.contains("const { module0 } = shared;") && second.contains("const c = 2;"), "{second}");
        assert!(second.contains("return module3;") && !second.contains("const a = 1;"), "{second}");
        assert!(bundle_in_two(&folder.path().join("a.js"), "later.js").is_err());
    }

    #[test]
    fn leaves_comments_out() {
        let text = "/** What\n * it is. */\nlet a = 1; // why\n// more\n\n/** @type {A} */ (a).b;\n    /* c */\n";
        assert_eq!(without_comments(text), "let a = 1; // why\n\n/** @type {A} */ (a).b;\n");
        assert_eq!(without_comments("/*\n */ a();\n/* b */\nc();"), " a();\nc();\n");
        assert_eq!(squeezed("a {\n    b: `c`;\n\n    /* d */\n}").unwrap(), "a {\nb: `c`;\n}\n");
        assert!(squeezed("a(`\n  b`);").is_err());
    }

    #[test]
    fn tells_types_from_imports() {
        for line in [
            " * @param {import('./a.js').A} a",
            "/** @type {import('./a.js').A} */ (a)",
            "// import('./a.js')",
            "reimport(a)",
        ] {
            assert!(!imports_later(line), "{line}");
        }
        assert!(imports_later("    import('./a.js').then(use);"));
        assert!(imports_later("const a = await import('./a.js'); /** why */"));
    }
}
