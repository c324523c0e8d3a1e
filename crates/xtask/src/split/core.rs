//! The core's wasm in two files: the functions that first pictures call with their constants, and the rest, which joins
//! later. A call of the rest before that traps.
//!
//! Which functions first pictures call is measured: `www/build/first-calls.mjs` runs the worker over the gallery.

use super::linked::Linked;
use super::{EMPTY, FIRST, Plan, divide, functions, runs};
use crate::workspace::{Kind, Workspace, output};
use crate::{files, tools, wasms};
use anyhow::Result;
use fs_err as fs;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use walrus::ir::Value;
use walrus::{ConstExpr, FunctionKind, Module, ValType};

/// The name of the rest on the site.
pub(crate) const REST: &str = "lsystem-rest.wasm";

/// Splits the core in the folder of the site, whose worker and gallery are there. A draft's first part is the whole.
pub(crate) fn split_core(workspace: &Workspace, kind: Kind, site: &Path) -> Result<()> {
    if kind == Kind::Draft {
        return files::write(&site.join(REST), EMPTY);
    }
    let generated = wasms::generated(workspace);
    let script = workspace.www().join("build/first-calls.mjs");
    let [whole, worker, gallery] = ["lsystem.wasm", "worker.js", "gallery.json"].map(|name| site.join(name));
    let [first, rest, watched] =
        ["first", "rest", "watched"].map(|part| generated.join(format!("lsystem-{part}.wasm")));
    let (linked, made_of) = (wasms::WASMS[0].linked(workspace, kind), generated.join("lsystem-split.made-of"));
    files::once(&[&whole, &linked, &worker, &gallery, &script], &made_of, || {
        let wasm = fs::read(&whole)?;
        fs::write(&watched, watch(&wasm)?)?;
        let numbers = output(Command::new(tools::node()?).args([&script, &worker, &watched, &gallery]))?;
        let called: BTreeSet<usize> = numbers.lines().map(str::parse).collect::<Result<_, _>>()?;
        let parts = divide(&wasm, &plan(&Module::from_buffer(&wasm)?, &Linked::read(&fs::read(&linked)?)?, &called)?)?;
        [first.clone(), rest.clone()].iter().zip(parts).try_for_each(|(file, part)| fs::write(file, part))?;
        Ok(())
    })?;
    fs::copy(first, whole)?;
    fs::copy(rest, site.join(REST))?;
    Ok(())
}

/// The wasm with an exported global for each function, named by the function's number: 1 after the function's first call.
fn watch(wasm: &[u8]) -> Result<Vec<u8>> {
    let mut module = Module::from_buffer(wasm)?;
    for (number, id) in functions(&module).into_iter().enumerate() {
        let FunctionKind::Local(function) = &mut module.funcs.get_mut(id).kind else { continue };
        let mark = module.globals.add_local(ValType::I32, true, false, ConstExpr::Value(Value::I32(0)));
        function.builder_mut().func_body().const_at(0, Value::I32(1)).global_set_at(1, mark);
        module.exports.add(&number.to_string(), mark);
    }
    Ok(module.emit_wasm())
}

/// `called` has the numbers of the functions of the first part.
fn plan(module: &Module, linked: &Linked, called: &BTreeSet<usize>) -> Result<Plan> {
    let is_local = |id| matches!(module.funcs.get(id).kind, FunctionKind::Local(_));
    let parts: Vec<_> = (functions(module).into_iter().enumerate())
        .map(|(number, id)| match is_local(id) && !called.contains(&number) && module.start != Some(id) {
            true => FIRST << 1,
            false => FIRST,
        })
        .collect();
    let mut open: Vec<usize> = vec![];
    let early = module.funcs.iter().zip(&parts).filter(|(_, parts)| **parts == FIRST);
    for (function, _) in early.filter(|(function, _)| is_local(function.id())) {
        open.extend(linked.of(function)?.into_iter().flat_map(|references| &references.data));
    }
    let mut data = vec![FIRST << 1; linked.data.len()];
    while let Some(datum) = open.pop() {
        if data[datum] != FIRST {
            data[datum] = FIRST;
            open.extend(&linked.data[datum].references.data);
        }
    }
    // The first part has what both use, and the gaps between constants.
    let of = |parts: &u32| if *parts == FIRST << 1 { FIRST << 1 } else { FIRST };
    let constants = runs(linked.constants.start, linked.constants_of(&data).iter().map(of));
    Ok(Plan { parts: 2, functions: parts, constants })
}

#[cfg(test)]
mod tests {
    use super::super::tests::whole;
    use super::*;

    #[test]
    fn each_function_has_a_mark() {
        let watched = Module::from_buffer(&watch(&whole()).unwrap()).unwrap();
        assert_eq!(watched.exports.iter().filter(|export| export.name.parse::<usize>().is_ok()).count(), 3);
    }
}
