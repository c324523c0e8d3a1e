//! The core's wasm in two files: the functions that first pictures call, and the rest, which joins later.
//!
//! The parts share memory, tables and globals, so no state moves when the rest joins. The first part calls the rest
//! through slots of its table, which the rest fills when it is instantiated; until then such a call traps. The rest
//! imports what it calls of the first part. No function is in both.
//!
//! Which functions first pictures call is measured: `www/build/first-calls.mjs` runs the worker over the gallery.

use crate::build::Kind;
use crate::files;
use crate::tools;
use crate::wasms;
use crate::workspace::{Workspace, output};
use anyhow::{Context, Result, bail};
use fs_err as fs;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;
use walrus::ir::{Value, Visitor, dfs_in_order};
use walrus::{
    ConstExpr, DataKind, ElementItems, ElementKind, ExportItem, FunctionBuilder, FunctionId, FunctionKind, GlobalKind,
    ImportKind, ImportedFunction, LocalFunction, Module, RefType, TableId, ValType, passes,
};

/// The name of the rest on the site.
pub(crate) const REST: &str = "lsystem-rest.wasm";

/// A wasm without contents.
const EMPTY: &[u8] = b"\0asm\x01\0\0\0";

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
    let made_of = generated.join("lsystem-split.made-of");
    files::once(&[&whole, &worker, &gallery, &script], &made_of, || {
        let wasm = fs::read(&whole)?;
        fs::write(&watched, watch(&wasm)?)?;
        let numbers = output(Command::new(tools::node()?).args([&script, &worker, &watched, &gallery]))?;
        let called = numbers.lines().map(str::parse).collect::<Result<_, _>>()?;
        let parts = split(&wasm, &called)?;
        fs::write(&first, parts.first)?;
        Ok(fs::write(&rest, parts.rest)?)
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

/// The two parts of a wasm.
struct Parts {
    first: Vec<u8>,
    rest: Vec<u8>,
}

/// Splits a wasm. `called` has the numbers of the functions of the first part.
fn split(wasm: &[u8], called: &BTreeSet<usize>) -> Result<Parts> {
    let (mut first, mut rest) = (Module::from_buffer(wasm)?, Module::from_buffer(wasm)?);
    let (here, there) = (functions(&first), functions(&rest));
    let is_local = |id: FunctionId| matches!(first.funcs.get(id).kind, FunctionKind::Local(_));
    let late: BTreeMap<FunctionId, usize> = (here.iter().enumerate())
        .filter(|&(number, &id)| is_local(id) && !called.contains(&number) && first.start != Some(id))
        .map(|(number, &id)| (id, number))
        .collect();
    let early = here.iter().zip(&there).filter(|(id, _)| !late.contains_key(id));
    let items: Vec<(ExportItem, ImportKind)> = early
        .map(|(&here, &there)| (here.into(), there.into()))
        .chain(first.tables.iter().zip(rest.tables.iter()).map(|(here, there)| (here.id().into(), there.id().into())))
        .chain(first.globals.iter().zip(rest.globals.iter()).map(|(here, there)| (here.id().into(), there.id().into())))
        .chain(
            first.memories.iter().zip(rest.memories.iter()).map(|(here, there)| (here.id().into(), there.id().into())),
        )
        .collect();
    let slots = take_out(&mut first, &late)?;
    clear(&mut rest)?;
    fill(&mut rest, slots.into_iter().map(|(slot, number)| (slot, there[number])).collect())?;
    // The memory is named after the whole, so that the parts of two versions do not fit each other.
    let version = &files::hex(&Sha256::digest(wasm))[..16];
    for (item, name) in share(&mut rest, items, version)? {
        first.exports.add(&name, item);
    }
    passes::gc::run(&mut first);
    Ok(Parts { first: first.emit_wasm(), rest: rest.emit_wasm() })
}

/// All functions, by their numbers.
fn functions(module: &Module) -> Vec<FunctionId> {
    module.funcs.iter().map(walrus::Function::id).collect()
}

/// The table of the functions that are called by pointers.
fn table_of(module: &Module) -> Result<TableId> {
    let found = module.tables.iter().find(|table| table.element_ty == RefType::FUNCREF);
    Ok(found.context("a wasm without a table of functions")?.id())
}

/// The functions that functions name.
struct Named(BTreeSet<FunctionId>);

impl Visitor<'_> for Named {
    fn visit_function_id(&mut self, id: &FunctionId) {
        self.0.insert(*id);
    }
}

/// Takes the late functions out of the first part. Returns their numbers by the slots of the table where they are called.
fn take_out(module: &mut Module, late: &BTreeMap<FunctionId, usize>) -> Result<BTreeMap<i32, usize>> {
    let table = table_of(module)?;
    let nobody = nobody(module);
    let mut slots = BTreeMap::new();
    for element in module.elements.iter_mut() {
        let (ElementKind::Active { table: of, offset }, ElementItems::Functions(items)) =
            (&element.kind, &mut element.items)
        else {
            continue;
        };
        let &ConstExpr::Value(Value::I32(offset)) = offset else { bail!("functions at a slot that is computed") };
        for (slot, item) in (offset..).zip(items).filter(|_| *of == table) {
            if let Some(&number) = late.get(item) {
                slots.insert(slot, number);
                *item = nobody;
            }
        }
    }
    let mut named = Named(BTreeSet::new());
    for function in module.funcs.iter().filter(|function| !late.contains_key(&function.id())) {
        if let FunctionKind::Local(local) = &function.kind {
            dfs_in_order(&mut named, local, local.entry_block());
        }
    }
    named.0.extend(module.exports.iter().filter_map(|export| match export.item {
        ExportItem::Function(id) => Some(id),
        _ => None,
    }));
    let mut slot_of: BTreeMap<usize, i32> = slots.iter().map(|(&slot, &number)| (number, slot)).collect();
    for (&id, &number) in late.iter().filter(|(id, _)| named.0.contains(id)) {
        let slot = *slot_of.entry(number).or_insert_with(|| {
            let table = module.tables.get_mut(table);
            let slot = table.initial as i32;
            table.initial += 1;
            table.maximum = table.maximum.map(|most| most.max(table.initial));
            slots.insert(slot, number);
            slot
        });
        module.funcs.get_mut(id).kind = FunctionKind::Local(caller(module, id, table, slot));
    }
    Ok(slots)
}

/// A function of a type that no call has, for slots without their function: calls trap there.
fn nobody(module: &mut Module) -> FunctionId {
    let params = [ValType::Ref(RefType::EXTERNREF); 9];
    let args = params.map(|param| module.locals.add(param)).to_vec();
    FunctionBuilder::new(&mut module.types, &params, &[]).finish(args, &mut module.funcs)
}

/// A function that calls the one in a slot, which has the same type as `id`.
fn caller(module: &mut Module, id: FunctionId, table: TableId, slot: i32) -> LocalFunction {
    let ty = module.funcs.get(id).ty();
    let (params, results) = (module.types.get(ty).params().to_vec(), module.types.get(ty).results().to_vec());
    let args: Vec<_> = params.iter().map(|&param| module.locals.add(param)).collect();
    let mut builder = FunctionBuilder::new(&mut module.types, &params, &results);
    let mut body = builder.func_body();
    for &arg in &args {
        body.local_get(arg);
    }
    body.i32_const(slot).call_indirect(ty, table);
    builder.local_func(args)
}

/// Takes exports, the start, data and elements out of the rest.
fn clear(module: &mut Module) -> Result<()> {
    module.start = None;
    for id in module.exports.iter().map(walrus::Export::id).collect::<Vec<_>>() {
        module.exports.delete(id);
    }
    for id in module.data.iter().map(walrus::Data::id).collect::<Vec<_>>() {
        if !matches!(module.data.get(id).kind, DataKind::Active { .. }) {
            bail!("data that code loads");
        }
        module.data.delete(id);
    }
    for id in module.elements.iter().map(walrus::Element::id).collect::<Vec<_>>() {
        module.elements.delete(id);
    }
    module.tables.iter_mut().for_each(|table| table.elem_segments.clear());
    module.memories.iter_mut().for_each(|memory| memory.data_segments.clear());
    Ok(())
}

/// Fills slots of the table when the rest is instantiated.
fn fill(module: &mut Module, slots: BTreeMap<i32, FunctionId>) -> Result<()> {
    let table = table_of(module)?;
    let mut runs: Vec<(i32, Vec<FunctionId>)> = vec![];
    for (slot, id) in slots {
        match runs.last_mut() {
            Some((start, run)) if *start + run.len() as i32 == slot => run.push(id),
            _ => runs.push((slot, vec![id])),
        }
    }
    for (start, run) in runs {
        let kind = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(start)) };
        let element = module.elements.add(kind, ElementItems::Functions(run));
        module.tables.get_mut(table).elem_segments.insert(element);
    }
    Ok(())
}

/// Makes items imports of the rest. Returns the items of the first part that the rest uses, with their names.
fn share(
    module: &mut Module,
    items: Vec<(ExportItem, ImportKind)>,
    version: &str,
) -> Result<Vec<(ExportItem, String)>> {
    let mut names = vec![];
    for (number, (item, kind)) in items.into_iter().enumerate() {
        let is_memory = matches!(kind, ImportKind::Memory(_));
        let name = if is_memory { version.to_owned() } else { number.to_string() };
        let import = module.imports.add("", &name, kind.clone());
        names.push((import, (item, name)));
        match kind {
            ImportKind::Function(id) => {
                let ty = module.funcs.get(id).ty();
                let kind = &mut module.funcs.get_mut(id).kind;
                if let FunctionKind::Import(former) = kind {
                    module.imports.delete(former.import);
                }
                *kind = FunctionKind::Import(ImportedFunction { import, ty });
            }
            ImportKind::Table(id) => {
                let table = module.tables.get_mut(id);
                // The table of the first part is larger.
                (table.import, table.maximum) = (Some(import), None);
            }
            ImportKind::Memory(id) => module.memories.get_mut(id).import = Some(import),
            ImportKind::Global(id) => module.globals.get_mut(id).kind = GlobalKind::Import(import),
            ImportKind::Tag(_) => bail!("a tag"),
        }
    }
    passes::gc::run(module);
    let used: BTreeSet<_> = module.imports.iter().map(walrus::Import::id).collect();
    Ok(names.into_iter().filter(|(import, _)| used.contains(import)).map(|(_, named)| named).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use walrus::ModuleConfig;

    /// Three functions: the first calls the second, which stores 7; the table has the second and the third.
    fn whole() -> Vec<u8> {
        let mut module = Module::with_config(ModuleConfig::new());
        let memory = module.memories.add_local(false, false, 1, None, None);
        let table = module.tables.add_local(false, 2, Some(2), RefType::FUNCREF);
        let mut stores = FunctionBuilder::new(&mut module.types, &[], &[]);
        let arg = walrus::ir::MemArg { align: 4, offset: 0 };
        stores.func_body().i32_const(0).i32_const(7).store(memory, walrus::ir::StoreKind::I32 { atomic: false }, arg);
        let stores = stores.finish(vec![], &mut module.funcs);
        let mut calls = FunctionBuilder::new(&mut module.types, &[], &[]);
        calls.func_body().call(stores);
        let calls = calls.finish(vec![], &mut module.funcs);
        let idle = FunctionBuilder::new(&mut module.types, &[], &[]).finish(vec![], &mut module.funcs);
        let kind = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(0)) };
        let element = module.elements.add(kind, ElementItems::Functions(vec![stores, idle]));
        module.tables.get_mut(table).elem_segments.insert(element);
        module.exports.add("calls", calls);
        module.emit_wasm()
    }

    fn number_of(module: &Module, name: &str) -> usize {
        let id = module.exports.get_func(name).unwrap();
        functions(module).iter().position(|&each| each == id).unwrap()
    }

    #[test]
    fn the_rest_imports_what_the_first_part_exports_and_fills_its_slots() {
        let whole = whole();
        let module = Module::from_buffer(&whole).unwrap();
        let Parts { first, rest } = split(&whole, &BTreeSet::from([number_of(&module, "calls")])).unwrap();
        let [first, rest] = [first, rest].map(|part| Module::from_buffer(&part).unwrap());
        assert!(first.exports.get_func("calls").is_ok() && rest.exports.iter().next().is_none());
        let given: Vec<&str> = first.exports.iter().map(|export| &*export.name).collect();
        assert!(rest.imports.iter().count() >= 2, "memory and table");
        for import in rest.imports.iter() {
            assert!(given.contains(&&*import.name), "{} of {given:?}", import.name);
        }
        let filled: usize = rest
            .elements
            .iter()
            .map(|element| match &element.items {
                ElementItems::Functions(items) => items.len(),
                ElementItems::Expressions(..) => 0,
            })
            .sum();
        assert_eq!(filled, 2, "the function that is named and the one that is only in the table");
        let stores = |module: &Module| module.funcs.iter_local().filter(|(_, it)| it.size() == 3).count();
        assert_eq!((stores(&first), stores(&rest)), (0, 1));
    }

    #[test]
    fn parts_of_two_versions_do_not_fit() {
        let whole = whole();
        let mut other = Module::from_buffer(&whole).unwrap();
        other.exports.remove("calls").unwrap();
        let rest = split(&other.emit_wasm(), &BTreeSet::new()).unwrap().rest;
        let first = Module::from_buffer(&split(&whole, &BTreeSet::new()).unwrap().first).unwrap();
        let fits = |name: &str| first.exports.iter().any(|export| export.name == name);
        assert!(!Module::from_buffer(&rest).unwrap().imports.iter().all(|import| fits(&import.name)));
    }

    #[test]
    fn each_function_has_a_mark() {
        let watched = Module::from_buffer(&watch(&whole()).unwrap()).unwrap();
        assert_eq!(watched.exports.iter().filter(|export| export.name.parse::<usize>().is_ok()).count(), 3);
    }
}
